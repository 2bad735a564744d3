"""No text that a student reads holds a number that is none, rounding in place of a result, or a
typist's signs.
"""

import dataclasses
import re
from collections.abc import Iterator
from typing import Any

import pytest
from hypothesis import HealthCheck, Phase, given, settings
from hypothesis import strategies as st

from workbench.errors import InputError
from workbench.exercise.finding import exercises_of
from workbench.knobs import ParamField as KnobField
from workbench.knobs import fields_of
from workbench.lesson import Lesson, catalog
from workbench.run.timeline import Timeline
from workbench.scene import Caption, Scene, Table

BAD = {
    "a number that is none": re.compile(r"\b(nan|inf|infinity)\b", re.IGNORECASE),
    "an exponent": re.compile(r"\d[eE][-+−]?\d"),
    "a negative zero": re.compile(r"(?<![\d.\w])[-−]0(\.0*)?(?![\d.]*[1-9]|\d)"),
    "a straight quote": re.compile(r'"'),
    "an x for a times sign": re.compile(r"\d ?x ?\d"),
}
MOST_WORDS = 400  # letters of a caption
STEPS = 8  # of one run
# where a run costs little, or much
RUNS = {"transforms": 30, "rotations": 30, "pinhole": 25, "chamfer_emd": 2, "disparity": 3}
FEW = 5  # runs of every other lesson
SMALL = 400  # the largest number of points or samples drawn, so that a run stays short


def texts(scene: Scene) -> Iterator[str]:
    """Every text of a scene: captions, labels, cells of tables, names, titles and units."""
    for primitive in scene.values():
        values = [getattr(primitive, field.name) for field in dataclasses.fields(primitive)]
        color = getattr(primitive, "color", None)
        if dataclasses.is_dataclass(color):
            values += [getattr(color, field.name) for field in dataclasses.fields(color)]
        if isinstance(primitive, Table):
            values += [cell for row in primitive.rows for cell in row]
        for value in values:
            yield from (
                text
                for text in (value if isinstance(value, tuple) else (value,))
                if isinstance(text, str)
            )


def faults(text: str) -> list[str]:
    """What is wrong with a text."""
    return [f"{fault} in: {text}" for fault, pattern in BAD.items() if pattern.search(text)]


def said_of(scene: Scene) -> list[str]:
    """What is wrong with what a scene says."""
    findings = [fault for text in texts(scene) for fault in faults(text)]
    for primitive in scene.values():
        if isinstance(primitive, Caption):
            text = primitive.text
            findings += [f"no full stop: {text}"] * (text[-1] not in ".!?")
            findings += [f"{len(text)} letters: {text}"] * (len(text) > MOST_WORDS)
    return findings


def values_of(field: KnobField) -> st.SearchStrategy:
    """Values that a person can give a knob: anywhere in its range, its ends, zero and what is next
    to zero.
    """
    knob = field.knob
    if field.kind in ("bool", "choice"):
        return st.sampled_from((False, True) if field.kind == "bool" else field.choices)
    low, high = knob.low or 0, knob.high or 0
    if field.kind in ("int", "ints"):
        number = st.integers(int(low), int(max(low, min(high, SMALL))))
    else:
        odd = [
            value
            for value in (low, high, 0.0, 1e-7, -1e-7, 0.5 * (low + high))
            if low <= value <= high
        ]
        number = st.sampled_from(odd) | st.floats(low, high, allow_nan=False).map(
            lambda value: round(value, 4)
        )
    return number if field.length == 0 else st.tuples(*[number] * field.length)


@st.composite
def params_of(draw: st.DrawFn, lesson: Lesson) -> Any:
    """Params with a few knobs turned, from the defaults or from a preset."""
    base = draw(st.sampled_from([lesson.params(), *(preset.params for preset in lesson.presets)]))
    fields = [field for field in fields_of(lesson.params) if field.kind != "path"]
    turned = draw(st.lists(st.sampled_from(fields), max_size=4, unique_by=lambda field: field.name))
    values = {field.name: field.clean(draw(values_of(field))) for field in turned}
    try:
        return dataclasses.replace(base, **values)
    except InputError:  # a pair of values that the lesson refuses
        return base


def hear(lesson: Lesson, params: Any) -> None:
    """Hold the first steps of a run to what may be said."""
    timeline = Timeline(lesson, params)
    while len(timeline) < STEPS and timeline.extend():
        pass
    assert timeline.failure is None, timeline.failure
    findings = [fault for step in timeline.known() for fault in said_of(step.scene)]
    assert not findings, f"{len(findings)} findings, such as:\n" + "\n".join(findings[:5])


@pytest.mark.parametrize("lesson", catalog().values(), ids=catalog())
def test_no_run_says_what_is_no_number(lesson: Lesson):
    @settings(
        max_examples=RUNS.get(lesson.name, FEW),
        derandomize=True,
        deadline=None,
        database=None,
        phases=(Phase.generate,),  # a short example is not worth the time
        suppress_health_check=[HealthCheck.too_slow, HealthCheck.data_too_large],
    )
    @given(params_of(lesson))
    def try_it(params: Any):
        hear(lesson, params)

    try_it()


FOUND: dict[str, dict[str, Any]] = {  # knobs at which lessons once said what is no number
    "curvature": {"surface": "sphere", "jitter": 1e-7},
    "ransac": {
        "model": "homography",
        "noise_pixels": 0.0,
        "sample": (236, 125, 125, 238),
        "seed": 22,
    },
    "icp": {"gate": "max-distance", "max_distance": 1.0, "guess": (0.0, 3.0, 0.0, 0.0, 0.0, 0.0)},
}


@pytest.mark.parametrize("name", FOUND)
def test_what_was_found_is_mended(name: str):
    lesson = catalog()[name]
    hear(lesson, dataclasses.replace(lesson.params(), **FOUND[name]))


def written_of(lesson: Lesson) -> Iterator[str]:
    """Every text of a lesson that is there before it runs."""
    yield from (lesson.title, lesson.summary)
    prose = re.sub(r"```.*?```|`[^`]*`|\$\$.*?\$\$|\$[^$]*\$", "…", lesson.text(), flags=re.S)
    yield from prose.replace('"', "”").splitlines()  # the page sets its quotes itself
    for preset in lesson.presets:
        yield from (preset.title, preset.line)
    for question in lesson.questions:
        yield from (question.text, question.unit, *question.choices)
    for field in fields_of(lesson.params):
        yield from (
            field.label,
            field.knob.hint,
            field.knob.unit,
            *field.knob.parts,
            *field.choices,
        )
    for exercise in exercises_of(lesson):
        yield from (mistake.sentence for mistake in exercise.mistakes)


@pytest.mark.parametrize("lesson", catalog().values(), ids=catalog())
def test_no_text_has_a_typists_signs(lesson: Lesson):
    findings = [
        fault
        for text in written_of(lesson)
        for fault in faults(text)
        if "number that is none" not in fault
    ]
    assert not findings, "\n".join(findings)


def test_a_bad_text_is_found():
    for text in (
        "nan px",
        "3.24e+03 m",
        "off by 1e-10",
        "(-0.00, 1)",
        "−0.0°",
        'the "right" one',
        "a 4x4",
        "inf",
    ):
        assert faults(text), text
    for text in ("−0.5 m", "-0.05", "2 × 2", "finance", "x10", "10-0.5", "informed", "0.0 mm"):
        assert not faults(text), text
