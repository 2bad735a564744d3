"""What a run does not read changes nothing, and what it reads changes something: seen broken."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

from tests.forms import dripping
from tests.forms.dripping import Bucket, Input, lesson
from workbench.authoring import knob_promises, promises
from workbench.authoring.promises import Subject
from workbench.cached import plain
from workbench.lesson import Lesson, Preset


def told(function: Callable, lesson: Lesson) -> list[str]:
    return [line for line in function(Subject(lesson)) if line is not None]


unread = knob_promises.a_knob_that_a_run_does_not_read_changes_nothing
to_its_ends = knob_promises.every_knob_goes_to_its_ends
keywords = promises.run_takes_only_keywords_beside_params


def test_a_lesson_that_holds_is_told_nothing():
    for function in (unread, to_its_ends, keywords):
        assert told(function, lesson) == []


def test_what_is_read_round_the_guise_is_told():
    def run(params: Input, bucket: Bucket) -> Any:
        yield from range(10, 4, -min(plain(params).some, 2))

    (line,) = told(unread, replace(lesson, run=run, presets=()))[:1]
    assert "some = 1 changes" in line
    assert "although the default run does not read it" in line


def test_what_no_run_reads_is_told():
    def run(params: Input, bucket: Bucket) -> Any:
        yield from (9, 8, 7)

    lines = told(unread, replace(lesson, run=run))
    assert [line.split("reads ")[1].split(":")[0] for line in lines] == ["leak", "some"]


def test_what_is_read_at_a_choice_alone_is_read():
    assert told(unread, replace(lesson, presets=())) == []


def test_what_is_read_without_effect_is_told():
    def run(params: Input, bucket: Bucket) -> Any:
        _ = params.some
        yield from dripping.run(params, bucket)

    (line,) = told(to_its_ends, replace(lesson, run=run))
    assert "the default run reads some, and nothing in it changes at 1 or 50" in line


def test_an_effect_behind_the_first_steps_counts():
    def run(params: Input, bucket: Bucket) -> Any:
        yield from range(50, 20, -1)
        yield params.some + 4

    assert told(to_its_ends, replace(lesson, run=run, params=Input)) == [
        line for line in told(to_its_ends, replace(lesson, run=run)) if "some" not in line
    ]


def test_slots_are_keywords_or_named():
    def positional(params: Input, bucket: Bucket, halve: Any = dripping.halve) -> Any:
        yield from dripping.run(params, bucket, halve=halve)

    def passing(params: Input, bucket: Bucket, **slots: Any) -> Any:
        yield from dripping.run(params, bucket, **slots)

    assert (
        "run takes 'halve'; beside params and subject"
        in told(keywords, replace(lesson, run=positional))[0]
    )
    assert "passes on **slots; slots=(...)" in told(keywords, replace(lesson, run=passing))[0]
    assert told(keywords, replace(lesson, run=passing, slots=("halve",))) == []


def test_a_preset_s_run_is_looked_at_too():
    def run(params: Input, bucket: Bucket) -> Any:
        if params.leak == "half":
            yield from (params.some + 5, 8, 7)
        else:
            yield from (plain(params).some + 5, 8, 7)

    some = Preset(name="some", title="S", line="Some leave.", params=Input(leak="some"))
    lines = told(unread, replace(lesson, run=run, presets=(some,)))
    assert all("although preset 'some' does not read it" in line for line in lines)
    assert lines


def test_a_run_longer_than_what_is_compared_is_told_nothing():
    """Its ends were compared with those of its first twelve steps."""

    def run(params: Input, bucket: Bucket) -> Any:
        yield from range(10 * params.some, -30, -1)

    lines = told(unread, replace(lesson, run=run, presets=()))
    assert not [line for line in lines if "how the run ends" in line]
