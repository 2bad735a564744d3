"""The first failing case as a recording that opens where the student's run leaves the
reference's.
"""

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
    """Write a recording of the student's run beside the reference's, from just before the first
    step that differs.

    Args:
        exercise: What the file is for.
        path: The student's file.
        out: The recording; beside the file, with its name, by default.
        lesson: The exercise's lesson, where the catalogue does not have it.

    Returns:
        The recording's path; None where the lesson's runs show no difference soon, or none could be
        recorded.
    """
    try:
        from workbench.recording import record_bytes
    except ImportError:  # where there is only what grading needs
        return None
    with SandboxedFunction(path, exercise.name, seconds=exercise.contract.seconds) as student:
        found = failing_run(exercise, student, lesson)
        if found is None:
            return None
        timeline, at = found
        states = [step.state for step in timeline.known()][max(0, at - 1) :]
        ended = replace(
            timeline.lesson, run=lambda params, subject: iter(states)
        )  # of the second form: `driven`
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
    """Return a run of the lesson in which a student's function differs from ours, and the first
    step that does.

    Args:
        exercise: What the function is for.
        student: The function.
        lesson: The exercise's lesson, where the catalogue does not have it.

    Returns:
        A few steps beyond the first difference; None where the lesson's runs show none soon.
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
