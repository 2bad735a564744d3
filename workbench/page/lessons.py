"""What a page knows of a lesson before anything runs: knobs, presets and questions, without their
answers.
"""

from typing import Any

from workbench.knobs import Gizmo, Knob, ParamField, Pick, changed, fields_of
from workbench.lesson import Lesson, Preset, Question
from workbench.moved import asked_before
from workbench.words.typeset import inline_html


def lesson_data(lesson: Lesson) -> dict[str, Any]:
    """Return a lesson as plain data: nothing in it gives an answer away."""
    return {
        "name": lesson.name,
        "title": lesson.title,
        "summary": lesson.summary,
        "telling": lesson.telling,
        "knobs": [knob_data(field) for field in fields_of(lesson.params) if field.kind != "path"],
        "files": [
            {"name": field.name, "label": field.label, "hint": field.knob.hint}
            for field in fields_of(lesson.params)
            if field.kind == "path"
        ],
        "presets": [preset_data(lesson, preset) for preset in lesson.presets],
        "questions": [question_data(question) for question in lesson.questions],
        "was": {name: list(before) for name, before in asked_before(lesson.name).items()},
    }


def knob_data(field: ParamField) -> dict[str, Any]:
    """Return how a field of Params is set: its name as formulas write it, hint, unit, range and
    kind.
    """
    knob = field.knob
    data: dict[str, Any] = {
        "name": field.name,
        "label": field.label,
        "hint": knob.hint,
        "unit": knob.unit,
        "kind": field.kind,
        **({"size": knob.by.size} if isinstance(knob.by, Gizmo) else {}),
        "by": _set_by(knob),
        "needs": {name: list(wanted) for name, wanted in knob.needs.items()},
        "default": list(field.default) if isinstance(field.default, tuple) else field.default,
    }
    if field.kind == "choice":
        return data | {"choices": field.choices}
    if field.kind == "bool":
        return data
    return data | {
        "low": knob.low,
        "high": knob.high,
        "step": field.step,
        "parts": part_names(field),
    }


def _set_by(knob: Knob) -> str:
    """Return the word for what sets a knob in the page."""
    if isinstance(knob.by, Gizmo):
        return "gizmo"
    return "pick" if isinstance(knob.by, Pick) else "slider"


def values_of(params: Any) -> dict[str, Any]:
    """Return params as a page gets them: without files."""
    named = {
        field.name: getattr(params, field.name)
        for field in fields_of(type(params))
        if not field.sensitive
    }
    return {
        name: list(value) if isinstance(value, tuple) else value for name, value in named.items()
    }


def files_of(params: Any) -> dict[str, str]:
    """Return what the files that are open are called, by field; not where they are."""
    paths = {
        field.name: getattr(params, field.name)
        for field in fields_of(type(params))
        if field.sensitive
    }
    return {name: path.name for name, path in paths.items() if path is not None}


def part_names(field: ParamField) -> tuple[str, ...]:
    """Return the names of a vector's entries; of a single number one empty name."""
    if not field.length:
        return ("",)
    known = {2: ("x", "y"), 3: ("x", "y", "z"), 6: ("x", "y", "z", "turn x", "turn y", "turn z")}
    return (
        tuple(field.knob.parts)
        or known.get(field.length)
        or tuple(str(i + 1) for i in range(field.length))
    )


def preset_data(lesson: Lesson, preset: Preset) -> dict[str, Any]:
    """Return a preset: what a person reads of it, and the params that differ from the defaults."""
    return {
        "name": preset.name,
        "title": preset.title,
        "line": preset.line,
        "params": changed(preset.params),
        "step": lesson.first_step if preset.step is None else preset.step,
    }


def question_data(question: Question) -> dict[str, Any]:
    """Return a question without its answer."""
    return {
        "name": question.name,
        "html": inline_html(question.text),
        "choices": question.choices,
        "unit": question.unit,
    }
