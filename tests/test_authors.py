"""What an author may get wrong: each mistake is one line that names the lesson, the place, and what
is wanted.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import pytest

from workbench.errors import InputError
from workbench.knobs import Gizmo, Knob, Pick
from workbench.lesson import Lesson, Preset, Question
from workbench.run.loading import load
from workbench.run.session import Session
from workbench.run.timeline import Timeline, Timelines
from workbench.scene import Caption, Curve, Points, Scalar, Scene, Table

HERE = Path(__file__)
P = np.zeros((3, 3))


@dataclass(frozen=True)
class Params:
    steps: Annotated[int, Knob("How many", 0, 100)] = 3


def run(params):
    yield from range(params.steps)


def draw(state) -> Scene:
    return {"cloud": Points(P), "caption": Caption("A step happened")}


def lesson(**values: Any) -> Lesson:
    fields: dict[str, Any] = {
        "name": "mine",
        "title": "Mine",
        "summary": "",
        "page": HERE,
        "params": Params,
        "order": 1,
    }
    return Lesson(**(fields | {"run": run, "draw": draw} | values))


def question(
    answer: Any = lambda states: 1.0, why: Any = lambda states: "So.", **values: Any
) -> Question:
    return Question("how-many", "How many?", answer, why, values.pop("params", Params()), **values)


def showing(**primitives: Callable[[], Any]) -> Callable:
    def draw(state):
        return {path: make() for path, make in primitives.items()} | {"caption": Caption("A step")}

    return draw


# told where the lesson is made --------------------------------------------------------------------


def run_without_params():
    yield 0


def run_with_more(params, points, seed):
    yield 0


def draw_two(state, params):
    return draw(state)


@pytest.mark.parametrize(
    ("values", "words"),
    [
        ({"page": "page.md"}, ["page is a Path", "'page.md'", "with_name"]),
        ({"run": run_without_params}, ["test_authors.py, line ", "run() takes the params"]),
        ({"run": run_with_more}, ["run(params, points, seed) takes the params and, by keyword,"]),
        ({"run": None}, ["run is a function, not None"]),
        ({"draw": draw_two}, ["test_authors.py, line ", "draw(state, params) takes one state"]),
        (
            {"presets": (Preset("far", "Far", "", Params(steps=101)),)},
            ["preset 'far'", "steps = 101", "from 0 to 100"],
        ),
        ({"presets": (Preset("far", "Far", "", 3),)}, ["preset 'far'", "takes Params, not int"]),
        (
            {"presets": (Preset("a", "A", "", Params()),) * 2},
            ["preset 1 and preset 2 share the name 'a'"],
        ),
        (
            {"questions": (question(), question())},
            ["question 1 and question 2 share the name 'how-many'"],
        ),
        (
            {"presets": (Preset("how-many", "A", "", Params()),), "questions": (question(),)},
            ["preset 1 and question 1 share the name 'how-many'"],
        ),
        (
            {"questions": (question(params=Params(steps=-1)),)},
            ["question 'how-many'", "steps = -1", "from 0 to 100"],
        ),
    ],
)
def test_what_a_lesson_cannot_be_made_of_is_said_when_it_is_made(values, words):
    with pytest.raises(ValueError, match=r"^lesson mine[:,] ") as told:
        lesson(**values)
    one_line(str(told.value), *words)


@dataclass(frozen=True)
class FourGizmo:
    place: Annotated[tuple[float, float, float, float], Knob("Where", -1, 1, by=Gizmo())] = (
        0.0,
        0.0,
        0.0,
        0.0,
    )


@dataclass(frozen=True)
class PickedFloat:
    size: Annotated[float, Knob("Which", 0, 1, by=Pick("cloud"))] = 0.0


@pytest.mark.parametrize(
    ("params", "words"),
    [
        (FourGizmo, ["lesson mine: FourGizmo.place", "2 floats", "3 (", "or 6"]),
        (PickedFloat, ["lesson mine: PickedFloat.size", "an int or a tuple of ints"]),
    ],
)
def test_a_field_that_no_handle_or_click_can_set_is_said_when_the_lesson_is_made(params, words):
    with pytest.raises(TypeError) as told:
        lesson(params=params)
    one_line(str(told.value), *words)


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: Points([[0, 0, 0]]), ["Points.p is an array", "type list", "np.asarray"]),  # type: ignore[arg-type]
        (lambda: Points(P, color=3), ["a colour is a role", "type int"]),  # type: ignore[arg-type]
        (
            lambda: Curve(np.arange(3.0), np.arange(4.0), "a", "b", "c"),
            ["Curve.x and y", "(3,) and (4,)"],
        ),
        (lambda: Curve([1.0], [2.0], "a", "b", "c"), ["Curve.x is an array"]),  # type: ignore[arg-type]
        (lambda: Scalar("0.5", "a", "b"), ["Scalar.value", "'0.5'", "float(...)"]),  # type: ignore[arg-type]
        (lambda: Scalar(P, "a", "b"), ["Scalar.value", "type ndarray"]),  # type: ignore[arg-type]
        (lambda: Table("Map", ("a",), ((0.5,),)), ["cell of the Table 'Map'", "type float"]),  # type: ignore[arg-type]
        (lambda: Caption(3), ["Caption.text is a text"]),  # type: ignore[arg-type]
    ],
)
def test_what_a_primitive_cannot_hold_is_said_where_it_is_made_and_with_the_line_of_the_scene(
    make, words
):
    with pytest.raises(ValueError, match=r"\w") as told:
        make()
    one_line(str(told.value), *words)
    one_line(
        stopped(lesson(draw=showing(thing=make))),
        "lesson mine: tests/test_authors.py, line ",
        *words,
    )


def test_the_path_of_a_primitive_that_cannot_be_made_is_in_the_line_that_is_shown():
    def draw(state):
        return {
            "caption": Caption("A step"),
            "wall/points": Points([[0, 0, 0]]),  # type: ignore[arg-type]
        }

    one_line(stopped(lesson(draw=draw)), '`"wall/points": Points([[0, 0, 0]])')


# told when the run is made ------------------------------------------------------------------------


def one_line(text: str, *words: str) -> None:
    assert "\n" not in text
    assert "Traceback" not in text
    for word in words:
        assert word in text, text


def stopped(made: Lesson, params: Any = None) -> str:
    timeline = Timeline(made, made.params() if params is None else params).complete()
    assert timeline.stopped is not None
    return timeline.stopped


def nothing(params):
    yield from ()


def failing(params):
    yield 0
    yield 1 / 0


@pytest.mark.parametrize(
    ("values", "words"),
    [
        ({"run": nothing}, ["run ended without a step", "at least one state"]),
        ({"run": lambda params: [1, 2]}, ["run returned a list", "`yield` each state"]),
        ({"run": lambda params: None}, ["run returned None", "`yield` each state"]),
        ({"run": failing}, ["ZeroDivisionError", "`yield 1 / 0`"]),
        ({"draw": lambda state: None}, ["draw returned None", "a dict from path to primitive"]),
        (
            {"draw": lambda state: [Points(P)]},
            ["draw returned a list", "a dict from path to primitive"],
        ),
        (
            {"draw": lambda state: {"caption": Caption("A"), "a/b": "text"}},
            ["a str at 'a/b'", "Points"],
        ),
        (
            {"draw": lambda state: {"caption": Caption("A"), "a/b": P}},
            ["a ndarray at 'a/b'", "Points"],
        ),
        (
            {"draw": lambda state: {"caption": Caption("A"), 3: Points(P)}},
            ["the path 3", "a path is a text"],
        ),
        ({"draw": lambda state: {"cloud": Points(P)}}, ["needs a Caption"]),
    ],
)
def test_a_run_that_cannot_be_shown_says_why_and_where(values, words):
    one_line(stopped(lesson(**values)), "lesson mine: tests/test_authors.py, line ", *words)


@dataclass(frozen=True)
class Picked:
    one: Annotated[int, Knob("Which", 0, 9, by=Pick("clouds"))] = 0


def test_a_pick_of_what_no_step_shows_or_nobody_can_hit_is_said_at_the_end_of_the_default_run():
    one_line(
        stopped(lesson(params=Picked, run=lambda params: iter([0]))),
        "lesson mine: Picked.one is picked at 'clouds'",
        "shows nothing at 'clouds'",
        "can be picked: cloud",
    )
    one_line(
        stopped(
            lesson(
                params=Picked,
                run=lambda params: iter([0]),
                draw=showing(clouds=lambda: Scalar(1.0, "a", "b")),
            )
        ),
        "lesson mine: Picked.one",
        "shows a Scalar at 'clouds'",
        "can be picked: nothing",
    )
    other = lesson(
        params=Picked, run=lambda params: iter([0]), draw=showing(clouds=lambda: Points(P))
    )
    assert Timeline(other, Picked()).complete().stopped is None


@pytest.mark.parametrize("step", [3, -4])
def test_a_preset_that_opens_beyond_its_run_says_so(step):
    session = Session(lesson(presets=(Preset("short", "Short", "", Params(steps=2), step),)))
    session.use_preset("short")
    while session.pending:
        session.compute(0.01)
    look = session.look()
    assert look is not None
    one_line(
        look.caption.text,
        "lesson mine, preset 'short'",
        f"step {step}",
        "its run has 2 steps: 0 to 1",
    )
    assert look.caption.tone == "wrong"
    session.first()
    look = session.look()
    assert look is not None
    assert look.caption.text == "A step happened"


@pytest.mark.parametrize(
    ("asked", "words"),
    [
        (question(lambda states: 1 / 0), ["ZeroDivisionError", "line "]),
        (question(lambda states: float("nan")), ["its answer is nan", "finite"]),
        (question(lambda states: None), ["TypeError"]),
        (question(lambda states: 2, choices=("a", "b")), ["its answer is 2", "0 to 1"]),
        (question(lambda states: 0.5, choices=("a", "b")), ["its answer is 0.5", "0 to 1"]),
        (question(why=lambda states: states[9]), ["IndexError"]),
        (question(step=7), ["opens at step 7", "0 to 2"]),
    ],
)
def test_a_question_that_its_run_does_not_answer_says_so(asked, words):
    from workbench.run.questions import answer

    with pytest.raises(InputError) as told:
        answer(lesson(questions=(asked,)), asked, None, timelines=Timelines())
    one_line(str(told.value), "lesson mine, question 'how-many'", *words)


# commands -----------------------------------------------------------------------------------------

FILE = """
from pathlib import Path
from tests.test_authors import Params, draw, lesson, question
from workbench.lesson import Preset
def run(params):
    yield 0
    yield [][3]
lesson = lesson(run=run)
"""


@pytest.mark.parametrize(
    ("source", "place"),
    [
        (FILE, "line 7: IndexError: list index out of range in `yield [][3]`"),
        (FILE + "1 / 0\n", "line 9: ZeroDivisionError: division by zero in `1 / 0`"),
        (FILE + "def (:\n", "line 9: SyntaxError"),
    ],
)
@pytest.mark.parametrize("command", ["record", "publish"])
def test_a_lesson_in_a_file_that_fails_is_one_line_with_file_and_line_and_exit_code_2(
    source, place, command, *, tmp_path, capsys
):
    from workbench.cli import main

    file = tmp_path / "my_lesson.py"
    file.write_text(source)
    words = {
        "record": ["record", str(file), "-o", str(tmp_path / "my.rrd")],
        "publish": ["publish", str(tmp_path / "site"), "--lesson", str(file)],
    }[command]
    assert main(words) == 2
    lines = capsys.readouterr().err.strip().splitlines()
    one_line(lines[-1], "my_lesson.py, " + place)
    assert len([line for line in lines if "workbench:" in line]) == 1


def test_an_error_deep_in_our_code_is_told_by_the_line_of_the_lesson_that_led_there():
    def draw(state):
        return {"caption": Caption("A"), "cloud": replace(Points(P), radius=-1.0)}

    one_line(
        stopped(lesson(draw=draw)),
        "Points.radius is positive",
        "`return {",
        "tests/test_authors.py, line ",
    )


def test_the_traceback_is_kept_for_the_terminal():
    timeline = Timeline(lesson(run=failing), Params()).complete()
    assert "Traceback" in (timeline.failure or "")
    assert "yield 1 / 0" in (timeline.failure or "")


def test_a_file_that_is_no_lesson_keeps_its_own_line(tmp_path):
    (tmp_path / "empty.py").write_text("x = 1\n")
    with pytest.raises(InputError, match="defines no value `lesson`"):
        load(tmp_path / "empty.py")
