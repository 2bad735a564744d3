"""Numbers in messages, and what a file must have to be an exercise."""

import re
from types import ModuleType

import numpy as np
import pytest

from tests.exercise import centroid
from workbench.errors import InputError
from workbench.exercise.model import (
    Verdict,
    against,
    alternative,
    band,
    check,
    contract,
    exercise_in,
    full,
    mistake,
    number,
)


@pytest.mark.parametrize(
    ("value", "written"),
    [
        (2.0, "2"),
        (-0.123456, "−0.1235"),
        (np.array([1, 2.5]), "(1, 2.5)"),
        ([(1, 2), (3, 4)], "((1, 2), (3, 4))"),
        (np.nan, "nan"),
        (-np.inf, "−inf"),
        (True, "1"),
        (9900000.0, "9,900,000"),
        (1e7, "1.00 × 10⁷"),
    ],
)
def test_a_number_of_an_answer_is_written_shortly(value, written):
    assert number(value) == written


def test_a_number_and_the_right_one_have_digits_enough_to_differ():
    assert against(1.00001, 1.00002) == "1.00001, right is 1.00002"
    assert against(1.5, 2.5, unit="m") == "1.5 m, right is 2.5 m"
    assert against(1.5, 1.5, unit="m") == "1.5 m, right is 1.5 m"
    assert against(1e-19, 0.0, unit="m") == "0 m, right is 0 m (off by 1e-19 m)"
    assert against(0.123456, 0.2, 2) == "0.12, right is 0.2"
    for pair in ((2e7 + 0.1, 2e7 + 0.4), (2e7 + 0.4, 2e7 + 0.1)):
        assert against(*pair).endswith("(off by 0.3)")


@pytest.mark.parametrize(
    ("value", "share", "message"),
    [
        (0.1, 1.0, "Error 0.1 m, within 0.1 m."),
        (0.2, 0.5, "Error 0.2 m: close, full marks need 0.1 m. Look."),
        (0.3, 0.0, "Error 0.3 m, at most 0.1 m was asked for. Look."),
        (np.inf, 0.0, "Error inf m, which is no number to judge. Look."),
    ],
)
def test_a_band_earns_all_half_or_nothing(value, share, message):
    verdict = band("Error", value, "m", good=0.1, fair=0.2, hint="Look.")
    assert (verdict.share, verdict.message) == (share, message)
    bare = band("Off by", value, "", good=0.1, fair=0.2, hint="Look.")
    assert bare.message == re.sub(r" m\b", "", message).replace("Error", "Off by")


def test_a_verdict_says_something():
    assert [Verdict(share, "x").word for share in (0.0, 0.5, 1.0)] == ["fail", "partial", "pass"]
    for share, message in ((0.0, " "), (1.01, "x"), (-0.01, "x")):
        with pytest.raises(ValueError, match="a verdict has a share"):
            Verdict(share, message)


def module(name: str, **items) -> ModuleType:
    """Return a module whose functions are its own."""
    made = ModuleType(f"lesson.exercises.{name}", "Do   it\nwell.")
    made.__file__ = f"{name}.py"
    for key, item in items.items():
        item = item() if isinstance(item, type) else item
        owner = getattr(item, "function", None) or getattr(item, "judge", None)
        if owner is not None and owner.__module__ == __name__:
            owner.__module__ = made.__name__
        setattr(made, key, item)
    return made


def parts(name: str = "turn") -> dict:
    def turn(x):
        return x

    def judge(candidate):
        """It turns."""
        return full("x")

    def slip(x):
        return -x

    turn.__name__ = name
    return {
        name: contract(slot="turn")(turn),
        "judge": check(2)(judge),
        "slip": mistake("You slipped.")(slip),
        "other": alternative(lambda x: +x),
    }


def test_an_exercise_is_what_its_file_defines_itself():
    borrowed = {
        "centroid": centroid.centroid,
        "total": centroid.total,
        "mean": centroid.is_the_mean,
    }
    made = exercise_in(module("turn", **borrowed, **parts()), "fake", module("turn", **hidden()))
    assert (made.name, made.lesson, made.task) == ("turn", "fake", "Do it well.")
    assert [part.name for part in made.checks] == ["judge", "more"]
    assert [slip.sentence for slip in made.mistakes] == ["You slipped."]
    assert len(made.alternatives) == 1
    assert (made.points, made.file, made.reference(3)) == (5, "my_turn.py", 3)


def hidden() -> dict:
    def more(candidate):
        """It turns more."""
        return full("x")

    return {"more": check(3, public=False)(more)}


@pytest.mark.parametrize("without", ["turn", "judge", "task"])
def test_a_file_that_lacks_a_part_is_named(without):
    given = parts()
    given.pop(without, None)
    made = module("turn", **given)
    if without == "task":
        made.__doc__ = None
    with pytest.raises(InputError, match=r"^turn\.py: it needs "):
        exercise_in(made, "fake")


def test_a_contract_knows_what_else_is_right():
    def made(either):
        return contract(slot="turn", either=either)(abs)

    assert made(None).others(3) == []
    assert made(lambda x: -x).others(3) == [-3]
    assert made(lambda x: [-x, x + 1]).others(3) == [-3, 4]
    assert made(lambda x: x + "a").others(3) == []
    assert made(None)(-3) == 3


def test_an_answer_of_nothing_is_told_beside_nothing():
    assert against((), ()) == "(), right is ()"


def test_an_answer_is_told_with_four_digits_unless_more_tell_it_from_the_right_one():
    assert against(1 / 3, 0.5) == "0.3333, right is 0.5"
    assert against(1 / 3, 0.33334) == "0.33333, right is 0.33334"
