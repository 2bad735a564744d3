"""Judges one file for every exercise that it is handed in for."""

from pathlib import Path
from typing import Any

from workbench.errors import InputError
from workbench.exercise.finding import exercises_in, said_for
from workbench.exercise.grading import Report, grade_file
from workbench.exercise.model import Exercise
from workbench.exercise.reports import ungraded
from workbench.exercise.sandbox import Wall
from workbench.exercise.submission import read_submission
from workbench.lesson import Lesson


def check_file(
    file: Path, lesson: Lesson | None = None, *, hidden: bool, wall: Wall
) -> tuple[list[Report], list[dict[str, Any]]]:
    """Return the reports on a file, and what could not be graded, as `ungraded` says it.

    Exercises are those of the lesson, or of the whole catalogue.
    """
    reports: list[Report] = []
    failed: list[dict[str, Any]] = []
    wanted: tuple[Exercise | None, ...] = (None,)
    try:
        given = read_submission(file)
        wanted = said_for(given, lesson) or (None,)
        wanted = exercises_in(given, lesson)
    except InputError as error:
        return [], [ungraded(file.name, exercise, str(error)) for exercise in wanted]
    for exercise in wanted:
        try:
            reports.append(grade_file(given, exercise, hidden=hidden, wall=wall))
        except InputError as error:
            failed.append(ungraded(file.name, exercise, str(error)))
    return reports, failed
