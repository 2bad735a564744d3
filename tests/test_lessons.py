"""Holds every lesson of the catalogue to the same promises; a new lesson is covered without an edit here."""

import dataclasses
import inspect
import itertools
import re
from pathlib import Path

import numpy as np
import pytest

from tests.runs import whole_run
from workbench.knobs import fields_of, from_json, to_json
from workbench.lesson import Lesson, catalog
from workbench.scene import Caption, caption_of, in_space, same
from workbench.timeline import Timeline
from workbench.typeset import inline_html, page_html

ROOT = Path(__file__).resolve().parents[1]
LESSONS = list(catalog().values())
MOST = 12  # steps looked at where a run at the end of a range would take long


def test_every_folder_is_in_the_catalogue():
    folders = {path.parent.name for path in (ROOT / "lessons").glob("*/__init__.py")}
    assert folders <= set(catalog())


def first_steps(lesson: Lesson, params, n: int = MOST) -> Timeline:
    timeline = Timeline(lesson, params)
    while len(timeline) < n and timeline.extend():
        pass
    return timeline


def ends(lesson: Lesson):
    """Every knob at each end of its range or at each of its choices, the others at their defaults."""
    for field in fields_of(lesson.params):
        knob = field.knob
        if field.kind in ("float", "int"):
            values = [field.clean(knob.low), field.clean(knob.high)]
        elif field.kind in ("floats", "ints"):
            values = [field.clean([end] * field.length) for end in (knob.low, knob.high)]
        elif field.kind == "bool":
            values = [False, True]
        else:
            values = list(field.choices)
        for value in values:
            yield pytest.param(lesson, field.name, value, id=f"{lesson.name}-{field.name}={value}")


@pytest.fixture(scope="module", params=LESSONS, ids=lambda lesson: lesson.name)
def lesson(request) -> Lesson:
    return request.param


@pytest.fixture(scope="module")
def default_run(lesson) -> Timeline:
    return whole_run(lesson.name, lesson.params())


def test_the_default_run_ends_well(lesson, default_run):
    assert default_run.stopped is None, default_run.failure
    assert len(default_run) >= 2
    assert -len(default_run) <= lesson.first_step < len(default_run)


def test_every_step_says_what_happened(default_run):
    for step in default_run.known():
        assert isinstance(caption_of(step.scene), Caption)
        assert 10 <= len(step.caption.text) <= 400, step.caption.text
    assert len({step.caption.text for step in default_run.known()}) > 1


def test_every_step_shows_something_in_space_and_keeps_its_kinds(default_run):
    kinds: dict[str, type] = {}
    for step in default_run.known():
        assert any(in_space(primitive) for primitive in step.scene.values())
        for path, primitive in step.scene.items():
            assert kinds.setdefault(path, type(primitive)) is type(primitive), f"{path} changes its kind"


def test_a_run_is_reproducible(lesson, default_run):
    again = Timeline(lesson, lesson.params()).complete()
    assert len(again) == len(default_run)
    for one, two in zip(default_run.known(), again.known(), strict=True):
        assert same(one.scene, two.scene)


def test_the_code_of_every_step_can_be_shown(default_run):
    for step in default_run.known():
        assert step.moment is not None
        lines, first = step.moment.source
        assert first <= step.moment.line < first + len(lines)


@pytest.mark.parametrize(("lesson", "name", "value"), itertools.chain.from_iterable(map(ends, LESSONS)))
def test_every_knob_at_its_ends(lesson, name, value):
    timeline = first_steps(lesson, dataclasses.replace(lesson.params(), **{name: value}))
    assert timeline.failure is None, timeline.failure
    if timeline.stopped is None:
        assert len(timeline) > 0


def test_params_survive_the_way_through_text(lesson):
    for params in (lesson.params(), *(preset.params for preset in lesson.presets)):
        assert from_json(lesson.params, to_json(params)) == params
        assert hash(params) == hash(from_json(lesson.params, to_json(params)))


def test_every_preset_runs_and_promises_something(lesson):
    assert len(lesson.presets) >= 3
    for preset in lesson.presets:
        timeline = whole_run(lesson.name, preset.params)
        assert timeline.stopped is None, f"{preset.name}: {timeline.failure}"
        assert 20 <= len(preset.line) <= 220, preset.line
        assert preset.step is None or -len(timeline) <= preset.step < len(timeline)


def test_every_question_is_answered_by_its_run(lesson):
    assert lesson.questions
    for question in lesson.questions:
        states = whole_run(lesson.name, question.params).states()
        answer = question.answer(states)
        assert np.isfinite(answer)
        assert question.why(states).strip()
        if question.choices:
            assert answer == int(answer)
            assert 0 <= answer < len(question.choices)
        else:
            assert question.tolerance > 0


def test_the_page_has_its_parts(lesson):
    text = lesson.text()
    assert 350 <= len(text.split()) <= 1100, len(text.split())
    for part in ("Conventions", "Watch", "Predict", "Break it", "Your turn", "Pitfalls", "References"):
        assert part.lower() in text.lower(), f"{lesson.name}/page.md has no part {part!r}"


def test_every_formula_of_the_page_is_read(lesson):
    formulas = re.findall(r"<math.*?</math>", page_html(lesson.text()), re.DOTALL)
    assert formulas
    for formula in formulas:
        assert chr(92) not in formula, f"an unknown TeX command in {formula}"
    assert all(inline_html(question.text) for question in lesson.questions)


def test_run_takes_only_keywords_beside_params(lesson):
    params, *slots = inspect.signature(lesson.run).parameters.values()
    assert params.name == "params"
    assert all(slot.kind is slot.KEYWORD_ONLY and slot.default is not slot.empty for slot in slots)
