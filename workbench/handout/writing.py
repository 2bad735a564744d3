"""Writes a handout to the disk, and tries it: the sample that is right, and the empty one, as the
service would run them.
"""

import json
import os
import shutil
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path

from workbench.errors import InputError
from workbench.exercise.sandbox.function import MEGABYTES
from workbench.exercise.starter import commands, sample, starter
from workbench.handout import gradescope, prairielearn
from workbench.handout.assignment import Assignment
from workbench.machinery.atomic import write_atomic
from workbench.machinery.licence import NOTICE

SECONDS = 560.0
KINDS = {"full": sample, "none": starter}
"""What each folder of the teacher's holds: a file that earns everything, and one that earns
nothing.
"""


def files(assignment: Assignment) -> dict[str, bytes]:
    """Return everything that is handed out, by its path."""
    held = {"README.md": readme(assignment).encode(), "student/TASK.md": task(assignment).encode()}
    for exercise in assignment.exercises:
        name = exercise.file
        room = assignment.megabytes or MEGABYTES
        held[f"student/{name}"] = starter(exercise, room).encode()
        held |= {
            f"teacher/{kind}/{name}": written(exercise).encode() for kind, written in KINDS.items()
        }
    if assignment.service == "gradescope":
        return held | gradescope.files(assignment)
    if assignment.service == "prairielearn":
        return held | prairielearn.files(assignment)
    return held | {"assignment.json": assignment.text().encode()}


def write(assignment: Assignment, out: Path, *, force: bool = False) -> None:
    """Write a handout into a folder.

    Args:
        assignment: What is handed out.
        out: Made where it is not there; it must be empty.
        force: Replace files that are there.

    Raises:
        InputError: If there is something else, or it cannot be written.
    """
    if out.exists() and not out.is_dir():
        raise InputError(f"{out}: is no folder")
    if not force and out.is_dir() and any(out.iterdir()):
        raise InputError(
            f"{out}: is not empty; name another folder, or replace what is there with --force"
        )
    for name, data in files(assignment).items():
        path = out / name
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
            write_atomic(path, data)
            path.chmod(0o755 if path.suffix == ".sh" else 0o644)
        except OSError as error:
            raise InputError(f"{path}: {error.strerror or 'cannot be written'}") from None


def tried(assignment: Assignment, out: Path) -> str:
    """Run what was handed out on its own samples, in a folder laid out as the service lays it out;
    say what they score.

    Raises:
        InputError: If the right sample has not full marks there, or the empty one any.
    """
    if assignment.service == "folder":
        return (
            f"Grade what comes back: workbench grade FOLDER --assignment {out / 'assignment.json'}"
        )
    shares = {kind: share_of(assignment, out, out / "teacher" / kind) for kind in KINDS}
    if shares != {"full": 1.0, "none": 0.0}:
        raise InputError(
            f"{out}: on this machine the samples score {shares}, not 1 and 0: see what results say"
            " there"
        )
    return "Tried here: the sample in teacher/full has full marks, the one in teacher/none has none"


def share_of(assignment: Assignment, out: Path, submission: Path) -> float:
    """Return the share of the points that a folder of files has, graded by what was handed out."""
    if assignment.service == "gradescope":
        with tempfile.TemporaryDirectory(prefix="handout-") as folder:
            root = lay_out_gradescope(Path(folder), out, submission)
            return run(root / "run_autograder", root)["score"] / assignment.points
    shares = []
    for exercise in assignment.exercises:
        with tempfile.TemporaryDirectory(prefix="handout-") as folder:
            root = lay_out_prairielearn(
                Path(folder), out, exercise.name, file=submission / exercise.file
            )
            result = run(root / "serverFilesCourse" / prairielearn.GRADER / "run.sh", root)
            shares.append(result.get("score", 0.0))
    return sum(shares) / len(shares)


def lay_out_gradescope(root: Path, out: Path, submission: Path) -> Path:
    """Lay an autograder and a submission out below a folder as Gradescope does below
    /autograder.
    """
    with zipfile.ZipFile(out / "autograder.zip") as archive:
        archive.extractall(root / "source")
    shutil.copy(root / "source" / "run_autograder", root / "run_autograder")
    (root / "run_autograder").chmod(0o755)
    shutil.copytree(submission, root / "submission")
    (root / "results").mkdir()
    return root


def lay_out_prairielearn(root: Path, out: Path, exercise: str, *, file: Path) -> Path:
    """Lay a question and a submitted file out below a folder as PrairieLearn does below /grade."""
    shutil.copytree(out / "serverFilesCourse", root / "serverFilesCourse")
    shutil.copytree(out / "questions" / prairielearn.GRADER / exercise / "tests", root / "tests")
    (root / "student").mkdir()
    shutil.copy(file, root / "student" / f"my_{exercise}.py")
    (root / "data").mkdir()
    (root / "data" / "data.json").write_text("{}")
    return root


def run(script: Path, root: Path, python: str = sys.executable) -> dict:
    """Run the script of a service in its folder with a Python, and return the results that it wrote
    there.
    """
    environment = os.environ | {"GRADER_PYTHON": python}
    subprocess.run(
        [script, root], env=environment, capture_output=True, timeout=SECONDS, check=False
    )
    return json.loads((root / "results" / "results.json").read_text(encoding="utf-8"))


def readme(assignment: Assignment) -> str:
    """Return what a teacher reads first."""
    steps = {"gradescope": gradescope.steps, "prairielearn": prairielearn.steps, "folder": _steps}[
        assignment.service
    ]
    dates = [
        f"{word} {day:%Y-%m-%d %H:%M}"
        for word, day in (("opens", assignment.release), ("is due", assignment.due))
        if day
    ]
    told = f" It {' and '.join(dates)}." if dates else ""
    where = (
        " Set these dates there too: the zip cannot."
        if dates and assignment.service == "gradescope"
        else ""
    )
    table = [f"| {name} | {points:g} |" for name, points in assignment.worth.items()]
    lines = [f"# {assignment.title}", "", f"{assignment.points:g} points.{told}{where}", ""]
    lines += ["| exercise | points |", "|---|---|", *table, "", *steps(assignment), ""]
    lines += [
        "`teacher` holds solutions, and so do the files of the grader: neither is for students."
    ]
    if assignment.sandbox == "none":
        lines += [
            "Submissions are not shut in (`--sandbox none`): marks are not safe, and every result"
            " says so."
        ]
    elif assignment.service != "folder":
        lines += [
            "Where nothing there can shut a submission in, nothing is graded and the results say"
            " so; then hand out again with `--sandbox none`, which grades all the same and says"
            " that marks are not safe."
        ]
    lines += ["", NOTICE]
    return "\n".join(lines) + "\n"


def _steps(assignment: Assignment) -> list[str]:
    return [
        "1. Give students what is in `student`.",
        (
            "2. Put what they hand in into one folder, a folder or a file per student, and grade"
            " it: `workbench grade FOLDER --assignment assignment.json`. `class.csv` counts the"
            " points of this assignment; what was not handed in counts nothing out of its points."
        ),
        (
            "3. `workbench check --hidden` on a file of `teacher/full` gives full marks, on one of"
            " `teacher/none` none."
        ),
    ]


def task(assignment: Assignment) -> str:
    """Return the sheet for students."""
    lines = [f"# {assignment.title}", ""]
    if assignment.due is not None:
        lines += [f"Due {assignment.due:%Y-%m-%d %H:%M}.", ""]
    for exercise, weight in zip(assignment.exercises, assignment.weights, strict=True):
        _, watching, judging = commands(exercise)
        lines += [f"## {exercise.name} ({weight:g} points)", "", exercise.task, ""]
        lines += [
            (
                f"Write it in `{exercise.file}`. Watch it live with `{watching}`; try it with"
                f" `{judging}`."
            ),
            "",
        ]
    return "\n".join(lines)
