"""The autograder of a Gradescope assignment: a zip with `setup.sh` and `run_autograder` at its
root.

Source: Gradescope autograder documentation, "Autograder specifications" and "Technical details".
"""

import io
import json
import sys
import zipfile
from collections.abc import Mapping

from workbench.exercise.reports import gradescope, ungraded
from workbench.handout.assignment import Assignment
from workbench.handout.parcel import packages, requirements, static

EXECUTABLE = ("setup.sh", "run_autograder")
LONG_AGO = (1980, 1, 1, 0, 0, 0)
BROKEN = (
    "could not be graded: the grader did not start, or was ended. This is not about your code; tell"
    " your teacher."
)


def files(assignment: Assignment) -> dict[str, bytes]:
    """Return what is handed to Gradescope and stays with the teacher, by its path."""
    return {"autograder.zip": zipped(autograder(assignment))}


def autograder(assignment: Assignment) -> dict[str, bytes]:
    """Return what the zip holds."""
    failed = [
        ungraded("", exercise, f"{exercise.name} {BROKEN}") for exercise in assignment.exercises
    ]
    factors = {exercise.name: assignment.factor(exercise) for exercise in assignment.exercises}
    python = f"{sys.version_info.major}.{sys.version_info.minor}"
    return {
        "setup.sh": static("setup.sh").replace(b"@PYTHON@", python.encode()),
        "run_autograder": static("run_autograder"),
        "requirements.txt": requirements().encode(),
        "assignment.json": assignment.text().encode(),
        "broken.json": json.dumps(gradescope([], failed, factors=factors), indent=1).encode(),
        **{f"packages/{name}": data for name, data in packages(assignment).items()},
    }


def zipped(held: Mapping[str, bytes]) -> bytes:
    """Return a zip, the same for the same files; scripts can be run."""
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in held.items():
            entry = zipfile.ZipInfo(name, LONG_AGO)
            entry.external_attr = (0o100755 if name in EXECUTABLE else 0o100644) << 16
            entry.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(entry, data)
    return file.getvalue()


def steps(assignment: Assignment) -> list[str]:
    """Return what a teacher does with it, in lines of Markdown."""
    return [
        (
            f"1. On Gradescope: a new *Programming Assignment* with {assignment.points:g}"
            " autograder points; upload `autograder.zip` under *Configure Autograder* (base image"
            " Ubuntu)."
        ),
        "2. The smallest container will do (0.5 CPU, 0.75 GB); leave the time-out at 10 minutes.",
        (
            f"3. *Test Autograder* with the files of `teacher/full`: {assignment.points:g} of"
            f" {assignment.points:g} points; with those of `teacher/none`: 0. The end of the"
            " build's log says what shuts submissions in."
        ),
        (
            "4. Give students what is in `student`. They upload a file of any name that ends in"
            " `.py`, a notebook, or several."
        ),
    ]
