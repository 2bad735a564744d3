"""What runs at a course system when a student hands in: `python -m workbench.handout.service ROOT
ASSIGNMENT`.

Results are written before anything runs and again after every exercise, so
that they are there however this ends.
"""

import json
import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from workbench.errors import InputError, one_line
from workbench.exercise.grading import Report
from workbench.exercise.marking import Asked, chosen, marked, not_handed_in
from workbench.exercise.reports import gradescope, ungraded
from workbench.exercise.sandbox import Wall, best, named
from workbench.exercise.submissions import handed_by
from workbench.handout.assignment import Assignment, read
from workbench.handout.picture import pictured
from workbench.handout.results import prairielearn
from workbench.machinery.atomic import write_atomic

NOT_YET = (
    "was not graded: the grader ended before, or ran out of time. This is not about your code; tell"
    " your teacher."
)
Written = Callable[
    [Sequence[Report], Sequence[dict[str, Any]], Sequence[dict[str, str]]], dict[str, Any]
]


@dataclass(frozen=True)
class ServiceFolders:
    """Where a service puts what is handed in, and looks for the results; below its root."""

    submission: str
    results: str = "results/results.json"


PLACES = {"gradescope": ServiceFolders("submission"), "prairielearn": ServiceFolders("student")}


def grade(assignment: Assignment, root: Path) -> dict[str, Any]:
    """Grade what lies in a service's folder, write its results there, and return them; whatever
    breaks is part of them.
    """
    places = PLACES[assignment.service]
    reports: list[Report] = []
    failed: list[dict[str, Any]] = []
    images: list[dict[str, str]] = []
    notes: list[str] = []
    waiting = list(assignment.exercises)

    def write(why: str = NOT_YET) -> dict[str, Any]:
        left = [ungraded("", exercise, f"{exercise.name} {why}") for exercise in waiting]
        results = _results(assignment, reports, [*failed, *left], images=images, notes=notes)
        path = root / places.results
        path.parent.mkdir(parents=True, exist_ok=True)
        write_atomic(
            path,
            json.dumps(results, ensure_ascii=False, indent=1).encode("utf-8", "backslashreplace"),
        )
        return results

    write()
    try:
        wall = _wall(assignment)
        handed = handed_by("submission", root / places.submission)
        choice = chosen(
            handed, Asked(only=tuple(exercise.name for exercise in assignment.exercises))
        )
        failed += choice.troubles
        notes += choice.notes if handed.files else ["no .py file and no notebook was handed in"]
        notes += [handed.note] if handed.note else []
        parts = {part.exercise.name: part for part in choice.graded}
        while waiting:
            exercise = waiting[0]
            if exercise in choice.missing:
                failed.append(not_handed_in(exercise))
            elif exercise.name in parts:
                graded = marked(parts[exercise.name], wall, assignment.megabytes)
                reports.append(graded) if isinstance(graded, Report) else failed.append(graded)
            if assignment.service == "prairielearn" and reports and not reports[-1].is_full:
                write()
                images += pictured(exercise, handed, reports[-1].file, wall=wall)
            waiting.pop(0)
            write()
    except Exception as error:  # a fault of ours must not leave a student without a word
        message = (
            str(error) if isinstance(error, InputError) else f"{type(error).__name__}: {error}"
        )
        return write(
            f"was not graded. This is not about your code; tell your teacher: {one_line(message)}"
        )
    return write()


def _wall(assignment: Assignment) -> Wall:
    wall = best(alone=True) if assignment.sandbox == "auto" else named(assignment.sandbox)
    if not wall.holds and assignment.sandbox != "none":
        raise InputError(
            f"nothing shuts submissions in here, so marks would not be safe ({wall.why})"
        )
    return wall


def _results(
    assignment: Assignment,
    reports: Sequence[Report],
    failed: Sequence[dict[str, Any]],
    *,
    images: Sequence[dict[str, str]],
    notes: Sequence[str],
) -> dict[str, Any]:
    if assignment.service == "prairielearn":
        return prairielearn(reports, failed, images, notes=notes)
    factors = {exercise.name: assignment.factor(exercise) for exercise in assignment.exercises}
    hidden = "after_published" if assignment.due is None else "after_due_date"
    return gradescope(reports, failed, factors=factors, hidden=hidden, notes=notes)


def main(words: Sequence[str]) -> int:
    """Grade what lies in the folder of a service; `--wall` says what would shut it in, for the log
    of an installation.
    """
    if list(words) == ["--wall"]:
        wall = best(alone=True)
        sys.stdout.write(
            f"Submissions are shut in by: {wall.name}"
            + (f" ({wall.why})" if wall.why else "")
            + "\n"
        )
        return 0
    root, file = map(Path, words)
    assignment = read(file.read_text(encoding="utf-8"))
    results = grade(assignment, root)
    sys.stdout.write(f"{assignment.title}: score {results.get('score', 'none')}\n")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
