"""The first failing case as a recording, open where the student's run leaves ours."""

import time
from dataclasses import replace
from pathlib import Path

from workbench.errors import InputError
from workbench.exercise.driven import driven, first_difference
from workbench.exercise.model import Exercise
from workbench.exercise.sandbox import SandboxedFunction
from workbench.lesson import Lesson, catalog
from workbench.run.timeline import Timeline

SECONDS = 8.0
"""How long a difference is looked for; the checks have told what is wrong already."""
AFTER = 12
"""How many steps beyond the first difference are recorded."""


def record_failing(
    exercise: Exercise, path: Path, out: Path | None = None, *, lesson: Lesson | None = None
) -> Path | None:
    """Write a recording of the student's run beside ours, from just before the first difference.

    `out` is beside the file by default; None is returned where runs show no difference soon, or
    none could be recorded.
    """
    try:
        from workbench.recording import record_bytes
    except ImportError:  # where there is only what grading needs
        return None
    with SandboxedFunction(path, exercise.name, seconds=exercise.contract.seconds) as student:
        failing = failing_run(exercise, student, lesson)
        if failing is None:
            return None
        timeline, at = failing
        states = [step.state for step in timeline.known()][max(0, at - 1) :]
        # of the second form: `driven`
        ended = replace(timeline.lesson, run=lambda params, subject: iter(states))
        shown = Timeline(ended, timeline.params).complete()
    out = path.with_suffix(".rrd") if out is None else out
    try:
        out.write_bytes(record_bytes(shown))
    except (OSError, InputError):
        return None
    return out


def failing_run(
    exercise: Exercise, student: SandboxedFunction, lesson: Lesson | None = None
) -> tuple[Timeline, int] | None:
    """Return a run in which a student's function differs from ours, and its first step that does.

    It ends a few steps beyond; None where the lesson's runs show no difference soon.
    """
    lesson = catalog()[exercise.lesson] if lesson is None else lesson
    end = time.monotonic() + SECONDS
    paired = driven(lesson, exercise, student)
    first = (
        [] if exercise.contract.preset is None else [lesson.preset(exercise.contract.preset).params]
    )
    for params in (*first, lesson.params(), *(preset.params for preset in lesson.presets)):
        timeline = Timeline(paired, params)
        at = None
        while (
            time.monotonic() < end
            and (at is None or len(timeline) <= at + AFTER)
            and timeline.extend()
        ):
            if at is None:
                at = first_difference(timeline.known())
        if at is not None:
            return timeline, at
    return None
