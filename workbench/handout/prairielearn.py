"""Questions of a PrairieLearn course: a folder each, the grader that they share, and an assessment
of them.

Source: PrairieLearn documentation, "External grading", "Question configuration", "pl-file-editor",
"Access control".
"""

import json
from html import escape
from typing import Any

from workbench.exercise.model import Exercise
from workbench.exercise.starter import starter
from workbench.handout.assignment import Assignment
from workbench.handout.parcel import packages, static

GRADER = "geometry-workbench"
IMAGE = "prairielearn/grader-python"
SECONDS = 180
BROKEN = "The grader did not start, or was ended. This is not about your code; tell your teacher."


def files(assignment: Assignment) -> dict[str, bytes]:
    """Return what is laid into the folder of a course, by its path there."""
    grader = {
        "run.sh": static("run.sh"),
        "broken.json": _json({"gradable": False, "message": BROKEN, "format_errors": [BROKEN]}),
        **{f"packages/{name}": data for name, data in packages(assignment).items()},
    }
    held = {f"serverFilesCourse/{GRADER}/{name}": data for name, data in grader.items()}
    for exercise, weight in zip(assignment.exercises, assignment.weights, strict=True):
        alone = Assignment(
            service=assignment.service,
            exercises=(exercise,),
            weights=(weight,),
            sandbox=assignment.sandbox,
        )
        folder = f"questions/{question(exercise)}"
        held[f"{folder}/info.json"] = _json(info(assignment, exercise))
        held[f"{folder}/question.html"] = page(exercise).encode()
        held[f"{folder}/{exercise.file}"] = starter(exercise).encode()
        held[f"{folder}/tests/assignment.json"] = alone.text().encode()
    held[f"assessments/{assignment.name}/infoAssessment.json"] = _json(assessment(assignment))
    return held


def question(exercise: Exercise) -> str:
    """Return the id of the question."""
    return f"{GRADER}/{exercise.name}"


def info(assignment: Assignment, exercise: Exercise) -> dict[str, Any]:
    """Return the question's info.json."""
    return {
        "uuid": assignment.identity(f"question/{exercise.name}"),
        "title": exercise.name.replace("_", " ").capitalize(),
        "topic": "Geometry",
        "tags": [exercise.lesson],
        "type": "v3",
        "singleVariant": True,
        "gradingMethod": "External",
        "externalGradingOptions": {
            "enabled": True,
            "image": IMAGE,
            "serverFilesCourse": [f"{GRADER}/"],
            "entrypoint": f"/grade/serverFilesCourse/{GRADER}/run.sh",
            "timeout": SECONDS,
        },
    }


def page(exercise: Exercise) -> str:
    """Return the question's question.html: the task, an editor that begins with the starter, and
    the results.
    """
    name = exercise.file
    task = escape(exercise.task).replace("{", "&#123;")
    return f"""<pl-question-panel>
  <p>{task}</p>
  <pl-file-editor file-name="{name}" ace-mode="ace/mode/python" source-file-name="{name}"></pl-file-editor>
</pl-question-panel>
<pl-submission-panel>
  <pl-external-grader-results></pl-external-grader-results>
  <pl-file-preview></pl-file-preview>
</pl-submission-panel>
"""  # noqa: E501


def assessment(assignment: Assignment) -> dict[str, Any]:
    """Return an infoAssessment.json: the questions with their points, and the dates."""
    rule: dict[str, Any] = {"credit": 100}
    if assignment.release is not None:
        rule["startDate"] = assignment.release.isoformat(timespec="seconds")
    if assignment.due is not None:
        rule["endDate"] = assignment.due.isoformat(timespec="seconds")
    pairs = zip(assignment.exercises, assignment.weights, strict=True)
    return {
        "uuid": assignment.identity(f"assessment/{assignment.name}"),
        "type": "Homework",
        "title": assignment.title,
        "set": "Homework",
        "number": "1",
        "allowAccess": [rule],
        "zones": [
            {
                "questions": [
                    {"id": question(exercise), "autoPoints": weight} for exercise, weight in pairs
                ]
            }
        ],
    }


def steps(assignment: Assignment) -> list[str]:
    """Return what a teacher does with it, in lines of Markdown."""
    return [
        (
            "1. Copy `questions` and `serverFilesCourse` into the folder of your course, and the"
            " folder in `assessments` into `courseInstances/YOURS/assessments`: it has the points"
            " and the dates. Synchronise."
        ),
        f"2. The questions run in the image `{IMAGE}`, without a network, for at most {SECONDS} s.",
        (
            "3. Submit a file of `teacher/full` to its question: 100 %; one of `teacher/none`: 0 %."
            " A file that is not Python is *invalid, not gradable* and costs no attempt."
        ),
    ]


def _json(value: Any) -> bytes:
    return (json.dumps(value, indent=2, ensure_ascii=False) + "\n").encode()
