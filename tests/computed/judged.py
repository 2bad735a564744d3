"""What the checks find of solutions, compared between this machine and Pyodide: also run there as a
script, which writes a line of JSON per solution.
"""

import importlib
import json
import sys
from pathlib import Path
from typing import Any

from workbench.computed.student import InPlaceFunction, read_in_place
from workbench.errors import InputError
from workbench.exercise.finding import exercises_in_folder
from workbench.exercise.grading import grade_function

TASKS = Path("/app/tasks.json")
"""In the archive of a test: [lesson, exercise, what the text is, its text] of each solution."""


def judged(lesson: str, exercise: str, text: str) -> list[Any]:
    """Return what all checks that are here find: of each its name, its share and its message, and
    the mistake that was recognised.
    """
    exercises = exercises_in_folder(importlib.import_module(f"lessons.{lesson}.lesson").lesson)
    task = next(candidate for candidate in exercises if candidate.name == exercise)
    try:
        student = InPlaceFunction(read_in_place(task.file, text), exercise)
        report = grade_function(student, task)
    except InputError as error:
        return [str(error)]
    mistake = None if report.mistake is None else report.mistake.name
    verdicts = [(outcome.check.name, outcome.verdict) for outcome in report.outcomes]
    return [mistake, *([name, made.share, made.message] for name, made in verdicts)]


def main() -> None:
    """Judge all tasks."""
    for lesson, exercise, solution, text in json.loads(TASKS.read_text()):
        judgement = judged(lesson, exercise, text)
        sys.stdout.write(f"{json.dumps([lesson, exercise, solution, judgement])}\n")


if "given" in globals():
    main()
