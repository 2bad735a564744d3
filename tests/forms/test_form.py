"""The second form of a lesson, what the timeline makes of it, and the first form in it."""

from dataclasses import dataclass, replace
from typing import Annotated, Any

import numpy as np
import pytest

from tests import fake
from tests.forms import dripping
from tests.forms.dripping import Input, lesson
from workbench.errors import AuthorError
from workbench.exercise.driven import driven
from workbench.form import Look
from workbench.knobs import Knob, changed, fields_of, from_json, make, to_json
from workbench.lesson import Lesson, Params, cached, catalog, knob
from workbench.run.questions import answer
from workbench.run.timeline import Timeline, Timelines
from workbench.scene import Caption, caption_of


def whole(lesson: Lesson, params: Any = None, **slots: Any) -> Timeline:
    return Timeline(lesson, lesson.params() if params is None else params, slots).complete()


def test_draw_sees_params_subject_now_and_before():
    seen: list[Look] = []

    def draw(look: Look) -> Any:
        seen.append(look)
        return dripping.draw(look)

    run = whole(replace(lesson, draw=draw), Input(points=20))
    assert run.stopped is None
    assert [look.now for look in seen] == [20, 10, 5]
    assert [look.before for look in seen] == [None, 20, 10]
    assert seen[2].past == (20, 10)
    assert all(look.params == Input(points=20) and len(look.subject.p) == 20 for look in seen)


def test_the_subject_is_made_once_and_cannot_be_written():
    run = whole(lesson, Input(points=20))
    states = run.states()
    assert states.params == Input(points=20)
    assert states.subject is dripping.setup(Input(points=20, leak="some"))
    with pytest.raises(ValueError, match="read-only"):
        states.subject.p[0, 0] = 1


def test_what_is_given_in_a_slot_is_used():
    assert lesson.form.slots == ("halve",)
    assert list(whole(lesson, Input(points=40), halve=lambda count: count // 3).states()) == [
        40,
        13,
    ]


def test_slots_that_run_passes_on_are_named():
    def run(params, bucket, **slots):
        yield from dripping.run(params, bucket, **slots)

    passing = replace(lesson, run=run, slots=("halve",))
    assert passing.form.slots == ("halve",)
    assert list(whole(passing, Input(points=40), halve=lambda count: count // 3).states()) == [
        40,
        13,
    ]


def test_a_question_reads_params_and_subject():
    told = answer(lesson, lesson.questions[0], 0.25, timelines=Timelines())
    assert told.right is False
    assert told.value == 8 / 64
    assert told.why == "8 of 64 points are."


def test_a_knob_that_the_run_does_not_read_is_idle():
    assert whole(lesson).idle() == ("some",)
    assert whole(lesson, Input(leak="some")).idle() == ()
    assert Timeline(lesson, Input()).idle() == ()  # not known yet


def test_what_setup_has_read_counts_when_its_value_is_kept_already():
    dripping.setup(Input(points=33))
    assert whole(lesson, Input(points=33)).idle() == ("some",)


def test_a_student_s_function_drives_it():
    class Contract:
        slot: str = "halve"

        def others(self, value):
            return ()

    class Exercise:
        name: str = "halve"
        contract = Contract()
        reference = staticmethod(dripping.halve)

    student = driven(lesson, Exercise(), lambda count: count // 4)  # type: ignore[arg-type]
    run = whole(student, Input(points=64))
    assert run.stopped is None
    assert [step.state.theirs for step in run.known()] == [64, 16]
    assert "first differs from the reference" in run[1].caption.text
    assert run.idle() == ("some",)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"setup": lambda: 1}, r"setup\(\) takes the params"),
        ({"run": lambda params: iter(())}, r"run\(params\) takes the params, the subject and, by"),
        ({"draw": lambda: {}}, r"draw\(\) takes one Look"),
        ({"run": 3}, "run is a function, not 3"),
    ],
)
def test_functions_that_do_not_fit_are_told_when_the_lesson_is_made(changes, message):
    with pytest.raises(ValueError, match=message):
        replace(lesson, **changes)


def test_what_goes_wrong_in_setup_is_told_with_its_place():
    def setup(params: Input) -> Any:
        raise ZeroDivisionError("no points")

    run = whole(replace(lesson, setup=setup))
    assert run.stopped is not None
    assert "test_form.py, line" in run.stopped
    assert "ZeroDivisionError: no points" in run.stopped


class TestInputs:
    def test_they_are_a_frozen_dataclass_of_keywords(self):
        with pytest.raises(AttributeError):
            Input().points = 3  # type: ignore[misc]
        with pytest.raises(TypeError):
            Input(3)  # type: ignore[misc]
        assert Input(points=9) == Input(points=9)
        assert hash(Input(points=9)) == hash(Input(points=9))

    def test_they_are_read_as_those_of_the_first_form(self):
        @dataclass(frozen=True)
        class First:
            far: Annotated[float, Knob("How far", 0, 9, unit="m", step=0.5)] = 2.0

        class Second(Params):
            far: float = knob(2.0, "How far", 0, 9, unit="m", step=0.5)

        assert fields_of(Second) == fields_of(First)

    def test_they_go_through_text_and_links(self):
        params = Input(points=12, leak="some")
        assert from_json(Input, to_json(params)) == params
        assert make(Input, changed(params)) == params

    def test_a_field_without_a_knob_is_told(self):
        class Bare(Params):
            far: float = 2.0

        with pytest.raises(TypeError, match=r"Bare.far: has no knob; write far: type = knob\("):
            fields_of(Bare)


class TestFirstForm:
    def test_every_lesson_has_the_second_form(self):
        for entry in [*catalog().values(), fake.lesson]:
            params = entry.params()
            form = entry.form
            subject = form.setup(params)
            state = next(form.run(params, subject))
            look = Look(params=params, subject=subject, now=state)
            assert isinstance(caption_of(form.draw(look)), Caption), entry.name

    def test_its_slots_are_the_keywords_of_run(self):
        assert fake.lesson.form.slots == ("turn",)

    def test_its_run_gets_the_params_themselves(self):
        given = []

        def run(params):
            given.append(params)
            yield from fake.run(params)

        params = fake.Params(steps=2)
        whole(replace(fake.lesson, run=run), params)
        assert type(given[0]) is fake.Params

    def test_its_knobs_are_idle_where_their_needs_are_not_met(self):
        @dataclass(frozen=True)
        class First:
            way: Annotated[bool, Knob("Whether")] = False
            far: Annotated[float, Knob("How far", 0, 9, needs={"way": (True,)})] = 2.0

        def run(params):
            yield params.way
            yield params.way

        shown = {"caption": Caption("A step of it.")}
        first_form = Lesson(
            name="a", title="A", summary="A", params=First, run=run, draw=lambda s: shown, order=1
        )
        assert whole(first_form).idle() == ("far",)
        assert whole(first_form, First(way=True)).idle() == ()
        assert whole(
            replace(
                first_form,
                setup=lambda params: None,
                run=lambda p, s: run(p),
                draw=lambda look: shown,
            )
        ).idle() == ("far",)


def test_nothing_outside_says_which_form_a_lesson_has():
    """`setup is None` is asked in lesson.py alone."""
    from pathlib import Path

    import workbench

    files = sorted(Path(workbench.__file__).parent.rglob("*.py"))
    asking = [
        path.name for path in files if "setup is" in path.read_text() or "form1" in path.read_text()
    ]
    assert asking == ["form1.py", "lesson.py"] or asking == ["lesson.py"]
    assert len((Path(workbench.__file__).parent / "form1.py").read_text().splitlines()) <= 150


def test_a_value_that_holds_on_to_params_is_refused():
    @cached
    def keeping(params: Input) -> Any:
        return params, np.full(3, params.seed)

    with pytest.raises(AuthorError, match="keeping is cached, and its value holds on to params"):
        keeping(Input(seed=4))
