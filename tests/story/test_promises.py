"""What validating says of a story: each promise holds for a good one, and tells what is wrong
with a spoiled one.
"""

from dataclasses import replace

import pytest

from tests.story.hill import lesson
from workbench.authoring import story_promises as promises
from workbench.authoring.promises import Subject

WHOLE = Subject(lesson)
ALL = (
    promises.the_story_is_read,
    promises.a_scene_keeps_its_form,
    promises.every_question_has_its_scene,
    promises.every_place_of_the_story_is_in_its_run,
    promises.the_numbers_of_the_story_are_those_of_its_runs,
    promises.what_is_under_the_hand_moves,
    promises.a_knob_of_the_story_is_published,
)


def said(promise, tmp_path, old, *, new):
    """Return the lines of a promise where a text of page.md is another."""
    text = lesson.text()
    assert old in text
    page = tmp_path / "page.md"
    page.write_text(text.replace(old, new, 1), encoding="utf-8")
    spoiled = Subject(replace(lesson, page=page), lambda params: WHOLE.whole(params, "a run"))
    return [line for line in promise(spoiled) if line is not None]


@pytest.mark.parametrize("promise", ALL, ids=lambda promise: promise.__name__)
def test_a_good_story_holds(promise):
    lines = list(promise(WHOLE))
    assert lines
    assert [line for line in lines if line] == []


@pytest.mark.parametrize(
    ("promise", "old", "new", "wrong"),
    [
        (
            promises.the_story_is_read,
            "run=far",
            "run=fra",
            "there is no run 'fra'; did you mean far?",
        ),
        (promises.a_scene_keeps_its_form, "Nothing tells", "word " * 120 + "x", "words, over 140"),
        (
            promises.a_scene_keeps_its_form,
            "## Where it starts decides {#starts run=far chart=height camera=side}",
            "{run=far chart=height camera=side}",
            "asks 2 questions; one at most",
        ),
        (
            promises.a_scene_keeps_its_form,
            "It comes to rest",
            "From [−0.5 m]{knob=start}. It comes",
            "2 numbers under the hand (share, start)",
        ),
        (promises.a_scene_keeps_its_form, "{.turn ", "{#last ", "has no ## Your turn"),
        (
            promises.every_question_has_its_scene,
            "::: {.ask #second}\n:::\n",
            "",
            "question 'second': no scene asks it",
        ),
        (
            promises.every_place_of_the_story_is_in_its_run,
            "{step=60 hide=}",
            "{step=160 hide=}",
            "line 8: the run 'hand' has no step 160; it has 121 steps",
        ),
        (
            promises.every_place_of_the_story_is_in_its_run,
            "chart=height",
            "chart=hieght",
            "has no chart 'hieght'; it has: cost, height, place",
        ),
        (
            promises.every_place_of_the_story_is_in_its_run,
            "hide=curve",
            "hide=ring",
            "hide=ring names nothing that hand@40 shows",
        ),
        (
            promises.the_numbers_of_the_story_are_those_of_its_runs,
            "[2.14 m]",
            "[2.15 m]",
            "it says '2.15 m', and height at default@1 is 2.13908 m",
        ),
        (
            promises.the_numbers_of_the_story_are_those_of_its_runs,
            "[2.14 m]",
            "[2.14 kg]",
            "is in 'kg', and height in 'm'",
        ),
        (
            promises.what_is_under_the_hand_moves,
            "steps=place",
            "steps=height",
            "height does not grow or fall at every step",
        ),
        (
            promises.a_knob_of_the_story_is_published,
            "knob=share",
            "knob=start",
            "the knob 'start' is plain text on a site",
        ),
    ],
)
def test_a_spoiled_one_is_told(tmp_path, promise, old, *, new, wrong):
    assert any(wrong in line for line in said(promise, tmp_path, old, new=new))


def test_a_number_may_be_written_in_another_unit(tmp_path):
    numbers = promises.the_numbers_of_the_story_are_those_of_its_runs
    assert said(numbers, tmp_path, "[2.14 m]", new="[2,139 mm]") == []
    assert said(numbers, tmp_path, "[2.14 m]", new="[214 cm]") == []
    assert said(numbers, tmp_path, "[2.14 m]", new="[2,14 m]")
