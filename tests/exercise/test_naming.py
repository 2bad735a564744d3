"""A mistake is named where the answers are the mistake's and not right, and not by chance."""

from dataclasses import replace

import numpy as np
import pytest

from tests.exercise.centroid import EXERCISE
from workbench.exercise.candidate import Returned
from workbench.exercise.grading import Report, grade_function
from workbench.exercise.model import Exercise, check, contract, fail, full, mistake
from workbench.exercise.naming import (
    _alike,
    _gap,
    _is_apart,
    _is_beyond,
    _the_most,
    _wrong_entries,
    values_alike,
)

ROWS = np.arange(12.0).reshape(4, 3) ** 2


def mean(p):
    if not len(p):
        raise ValueError("no point")
    return p.mean(axis=0)


def of_sum(p):
    if not len(p):
        raise ValueError("no point")
    return p.sum(axis=0)


def asking(*inputs: np.ndarray):
    """Return a check that asks for the answers to some inputs."""

    def judge(candidate):
        """All is right."""
        right = [values_alike(candidate(p), mean(p)) for p in inputs]
        return full("Right.") if all(right) else fail("Wrong.")

    judge.__name__ = f"asks_{len(inputs)}_of_{int(inputs[0].sum())}"
    return check(1)(judge)


@check(1)
def refuses(candidate):
    """No point is refused."""
    try:
        candidate(np.zeros((0, 3)))
    except Exception as error:
        return full("Refused.") if "ValueError" in getattr(error, "errors", ()) else fail("No.")
    return fail("An answer.")


def report(student, *mistakes, checks=(), either=None, alternatives=()) -> Report:
    exercise = Exercise(
        name="mean",
        lesson="fake",
        task="Mean.",
        contract=contract(slot="turn", either=either)(mean),
        checks=checks or (asking(ROWS), refuses),
        mistakes=mistakes,
        alternatives=alternatives,
    )
    return grade_function(student, exercise)


PLAIN = mistake("You summed.")(of_sum)
SPARING = mistake("All is right but the divisor.")(of_sum)


def test_a_sentence_that_says_that_all_else_is_right_is_told_only_where_it_is():
    def forgets_the_error(p):
        return p.sum(axis=0)

    for student, sparing in ((of_sum, SPARING), (forgets_the_error, None)):
        assert report(student, PLAIN).mistake is PLAIN
        assert report(student, SPARING).mistake is sparing


def test_a_mistake_in_most_of_the_failing_checks_is_named_and_they_are_told():
    def two_mistakes(p):
        return of_sum(p) if p[0, 0] < 5 else p[0] * 0.3

    first, other, third = map(asking, (ROWS, ROWS + 1, ROWS + 9))
    graded = report(two_mistakes, PLAIN, checks=(first, other, third))
    assert graded.mistake is PLAIN
    assert graded.concerned == {first.name, other.name}
    assert report(two_mistakes, PLAIN, checks=(first, third)).mistake is None
    assert report(two_mistakes, SPARING, checks=(first, other, third)).mistake is None


def test_one_answer_is_enough_where_nothing_else_was_answered():
    @mistake("You counted one too many.")
    def one_more(p):
        return len(p) + 1

    @check(1)
    def counts(candidate):
        """The rows are counted."""
        return full("Right.") if candidate(ROWS) == len(ROWS) else fail("Wrong.")

    exercise = replace(
        EXERCISE, contract=contract(slot="turn")(len), checks=(counts,), mistakes=(one_more,)
    )
    assert grade_function(one_more.function, exercise).mistake is one_more
    assert grade_function(lambda p: len(p) + 2, exercise).mistake is None
    assert grade_function(len, exercise).mistake is None


def test_numbers_that_chance_would_hardly_give_speak_louder_than_whole_ones():
    """Where other checks fail otherwise, two are enough, and they are the mistake's, not
    the right ones.
    """
    half = mistake("You halved it.")(lambda p: len(p) / 2)
    one_more = mistake("You counted one too many.")(lambda p: len(p) + 1)

    def counts(n):
        def judge(candidate):
            """The rows are counted."""
            right = candidate(np.zeros((n, 3))) == n
            return full("Right.") if right else fail("Wrong.")

        judge.__name__ = f"counts_{n}"
        return check(1)(judge)

    def named(slip):
        exercise = replace(
            EXERCISE,
            contract=contract(slot="turn")(len),
            checks=(counts(3), counts(5), counts(4)),
            mistakes=(slip,),
        )
        return grade_function(lambda p: slip.function(p) if len(p) % 2 else -1, exercise).mistake

    assert named(half) is half
    assert named(one_more) is None


def test_of_two_mistakes_with_the_same_answers_none_is_named():
    assert report(of_sum, PLAIN, mistake("You did not divide.")(of_sum)).mistake is None


def test_the_other_right_answer_is_no_mistake():
    def turned(p):
        return -mean(p)

    minus = mistake("You turned it round.")(turned)
    assert report(turned, minus).mistake is minus
    assert report(turned, minus, either=lambda value: -value).mistake is None


def test_where_other_answers_are_right_too_a_mistake_is_named_that_is_far_from_all():
    def nearly(p):
        return 1.01 * mean(p)

    def far(p):
        return -mean(p)

    assert report(of_sum, PLAIN, alternatives=(nearly,)).mistake is PLAIN
    assert report(of_sum, PLAIN, alternatives=(far,)).mistake is None


@pytest.mark.parametrize(
    ("a", "b", "gap"),
    [
        ([1.0, 2.0], [1.0, 2.5], 0.5),
        ([1.0, np.inf, np.nan], [1.0, np.inf, np.nan], 0.0),
        ([1.0, np.nan], [1.0, 2.0], np.inf),
        ([np.inf], [-np.inf], np.inf),
        ([], [], 0.0),
        ("a", "b", np.inf),
        ([1.0, [2.0]], [1.0, [2.0]], np.inf),
    ],
)
def test_a_gap_is_the_largest_difference(a, b, gap):
    assert _gap(Returned(a, ""), Returned(b, "")) == gap


def test_errors_differ_by_their_names_alone():
    no, other = (Returned(None, name) for name in ("ValueError", "IndexError"))
    assert _gap(no, no) == 0.0
    assert _gap(no, other) == _gap(no, Returned(1.0, "")) == np.inf


@pytest.mark.parametrize(
    ("a", "b", "alike"),
    [
        (1.0, 1.0 + 1e-8, True),
        (1.0, 1.0001, False),
        (np.float32(1.0), 1.00003, True),
        (np.float32(1.0), 1.001, False),
        (1e-9, 2e-9, False),
        (np.array([1.0, 1e-9]), np.array([1.0, 0.0]), True),
        ([1.0, 1e-9], [1.0, 0.0], False),
        ([1.0, np.nan, np.inf], [1.0, np.nan, np.inf], True),
        ([1.0, 2.0], [1.0, 2.0, 3.0], False),
        ((np.ones(2), 1), [np.ones(2), 1.0], True),
        ((np.ones(2), 1), [np.ones(2), 2.0], False),
        ((np.ones(2), 1), (np.ones(2),), False),
        (np.ones(2), (1.0, 1.0), True),
        (None, None, True),
        ("a", None, False),
        ("a", "a", False),
    ],
)
def test_answers_are_alike_within_rounding(a, b, alike):
    assert values_alike(a, b) is alike


def test_a_forgotten_error_is_named_only_where_it_is_forgotten_everywhere():
    def forgets(p):
        return p.mean(axis=0) if len(p) else np.zeros(p.shape[1])

    def forgets_once(p):
        return mean(p) if p.shape[1] == 3 else forgets(p)

    @check(1)
    def refuses_both(candidate):
        """No point is refused."""
        answers = 0
        for width in (2, 3):
            try:
                candidate(np.zeros((0, width)))
                answers += 1
            except Exception:
                continue
        return fail("An answer.") if answers else full("Refused.")

    forgotten = mistake("You forgot the error.")(forgets)
    checks = (asking(ROWS), refuses_both)
    assert report(forgets, forgotten, checks=checks).mistake is forgotten
    assert report(forgets_once, forgotten, checks=checks).mistake is None


def test_answers_are_alike_in_any_right_form_and_errors_by_their_names():
    exercise = replace(EXERCISE, contract=contract(slot="turn", either=lambda value: -value)(mean))
    right = Returned(1.0, "")
    alike = [_alike(Returned(value, ""), right, exercise) for value in (1.0, -1.0, 2.0)]
    assert alike == [True, True, False]
    no, other = (Returned(None, name) for name in ("ValueError", "IndexError"))
    assert _alike(no, no, exercise)
    assert not _alike(no, other, exercise)
    assert not _alike(right, no, exercise)


@pytest.mark.parametrize(
    ("argument", "beyond"),
    [
        (1e51, True),
        (-1e51, True),
        (1e-51, True),
        (0.0, False),
        (np.inf, False),
        (1.0, False),
        (10**60, False),
        ("1e60", False),
        (np.array([1.0, 1e51]), True),
        (np.array(["1e51"]), False),
        (np.array([1.0, np.nan, 0.0]), False),
        (np.array([10**18]), False),
    ],
)
def test_ours_are_not_asked_with_numbers_too_large_or_too_small(argument, beyond):
    assert _is_beyond(argument) is beyond


def test_of_mistakes_the_one_that_most_speaks_for_is_named_and_of_two_alike_none():
    little = EXERCISE.mistakes[0]
    much = replace(little, sentence="Much.")
    as_much = replace(little, sentence="As much.")
    assert _the_most({little: 1, much: 5}, 2) is much
    assert _the_most({little: 1, much: 5, as_much: 5}, 2) is None
    assert _the_most({little: 1}, 2) is None
    assert _the_most({}, 0) is None


@pytest.mark.parametrize(
    ("mistaken", "right", "apart"),
    [
        (100.0, [1.0, 1.0495, 0.96], True),  # 0.0495 is near for a size of 1, not of 0.96
        (100.0, [0.96, 1.04, 1.0], False),  # 0.08 is not
        (1.045, [1.0, 1.04, 0.96], False),  # nearer to one than a fifth of what they differ by
    ],
)
def test_a_mistake_is_apart_where_it_is_far_from_right_answers_that_are_near_each_other(
    mistaken, right, apart
):
    answers = [Returned(np.array([value]), "") for value in right]
    assert _is_apart(Returned(np.array([mistaken]), ""), answers) is apart


def test_wrong_entries_are_counted_and_a_single_number_is_noted():
    numbers = set[float]()
    assert _wrong_entries([1.0, np.nan, 2.0], [1.0, np.nan, 3.0], numbers) == 1
    assert numbers == set()
    assert _wrong_entries(2.5, 3.0, numbers) == 0
    assert numbers == {2.5}
