"""Where a session is after opening, changing, letting go, and what it shows meanwhile."""

import dataclasses
from collections.abc import Iterator

import pytest

from tests.fake import Params, lesson, turn_about_z
from workbench.errors import InputError
from workbench.lesson import Lesson
from workbench.run.session import Session, Shown
from workbench.scene import Caption

OTHER = dataclasses.replace(lesson, name="other")
LAST_FIRST = dataclasses.replace(lesson, first_step=-1)
THIRD_FIRST = dataclasses.replace(lesson, first_step=2)


def looked(session: Session) -> Shown:
    while session.pending:
        session.compute(0.01)
    look = session.look()
    assert look is not None
    return look


@pytest.mark.parametrize(
    ("of", "params", "step", "k"),
    [
        (lesson, None, None, 0),
        (THIRD_FIRST, None, None, 2),
        (LAST_FIRST, None, None, 5),
        (THIRD_FIRST, Params(angle=20.0), None, 2),
        (LAST_FIRST, Params(angle=20.0, steps=9), None, 8),
        (THIRD_FIRST, None, 4, 4),
        (THIRD_FIRST, None, 0, 0),
        (lesson, Params(steps=9), -2, 7),
        (lesson, Params(steps=3), 8, 2),
    ],
)
def test_a_run_opens_at_the_step_that_is_asked_for_or_where_its_lesson_opens(
    of, params, step, *, k
):
    session = Session(lesson)
    session.open(of, params, step)
    assert looked(session).k == k


@pytest.mark.parametrize("step", [6, -7])
def test_a_lesson_that_opens_at_no_step_is_told_so(step):
    wrong = dataclasses.replace(lesson, first_step=step)
    for session in (Session(wrong), Session(lesson)):
        session.open(wrong)
        assert looked(session).caption.tone == "wrong"
        assert f"opens at step {step}" in looked(session).caption.text
        session.seek(1)
        assert "opens at" not in looked(session).caption.text


@pytest.mark.parametrize("step", [5, -6])
def test_the_farthest_steps_that_there_are_may_be_opened(step):
    session = Session(dataclasses.replace(lesson, first_step=step))
    assert "opens at" not in looked(session).caption.text
    assert looked(session).k == step % 6


def test_a_preset_without_a_step_opens_where_its_lesson_does():
    preset = dataclasses.replace(lesson.presets[0], step=None)
    session = Session(dataclasses.replace(lesson, presets=(preset,), first_step=3))
    session.use_preset(preset.name)
    assert looked(session).k == 3


def test_another_lesson_takes_no_student_s_function_along():
    calls = []

    def turn(angle: float):
        calls.append(angle)
        return turn_about_z(angle)

    session = Session(lesson, slots={"turn": turn})
    looked(session)
    session.open(lesson, Params(angle=30.0))
    before = len(calls)
    looked(session)
    assert len(calls) > before > 0
    session.open(OTHER)
    before = len(calls)
    looked(session)
    assert (len(calls), session.slots) == (before, {})


def test_the_picture_of_another_lesson_does_not_stay():
    session = Session(lesson)
    looked(session)
    session.open(OTHER, Params(angle=12.0))
    assert session.look() is None


def test_the_picture_that_stays_is_the_one_that_was_seen():
    session = Session(lesson)
    looked(session)
    session.seek(3)
    assert looked(session).k == 3
    session.change(angle=12.0)
    shown = session.look()
    assert shown is not None
    assert (shown.k, shown.timeline.params, shown.params.angle) == (3, Params(), 12.0)


def test_a_run_that_is_let_go_is_taken_up_where_it_was():
    session = Session(lesson)
    looked(session)
    session.seek(4)
    run = session.timeline
    session.let_go()
    assert session.timeline is not run
    assert session.look() is None
    session.take_up()
    assert session.timeline is run
    assert looked(session).k == 4


def test_what_cannot_be_used_is_told_before_there_is_a_step():
    session = Session(lesson)
    session.change(nothing=3)
    blank = session.look()
    assert blank is not None
    assert (blank.k, blank.known, blank.finished, dict(blank.scene)) == (0, 0, True, {})
    assert (blank.caption.tone, "nothing" in blank.caption.text) == ("wrong", True)


def failing(at: int) -> Lesson:
    def run(params: Params) -> Iterator[int]:
        for k in range(params.steps):
            if k == at:
                raise InputError("the file is empty")
            yield k

    def draw(k: int) -> dict:
        return {"caption": Caption(f"step {k}")}

    return dataclasses.replace(lesson, run=run, draw=draw, presets=(), questions=())


def test_a_run_says_why_it_ended_at_its_last_step_alone():
    session = Session(failing(3))
    looked(session)
    for k, text in ((0, "step 0"), (1, "step 1"), (2, "the file is empty")):
        session.seek(k)
        assert (looked(session).k, looked(session).caption.text) == (k, text)


def test_a_run_that_ends_before_its_first_step_says_why():
    session = Session(failing(0))
    look = looked(session)
    assert (look.k, look.known, look.finished) == (0, 0, True)
    assert (look.caption.text, look.caption.tone) == ("the file is empty", "wrong")
