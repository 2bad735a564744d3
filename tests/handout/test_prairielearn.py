"""What is handed out for PrairieLearn, run as PrairieLearn runs it: below a folder laid out as its
own, and held to its documented files.
"""

import base64
import io
import json
import stat
from pathlib import Path

import pytest
from PIL import Image

from tests.exercise.formats import ASSESSMENT, PRAIRIELEARN, QUESTION
from tests.handout.services import (
    WRONG,
    bare_python,  # noqa: F401 (a fixture)
    conforms,
)
from workbench.exercise.finding import exercises
from workbench.handout.assignment import assigned
from workbench.handout.writing import lay_out_prairielearn, run, write


@pytest.fixture(scope="module")
def prairielearn(tmp_path_factory):
    out = tmp_path_factory.mktemp("prairielearn")
    dates = {"release": "2027-03-01", "due": "2027-03-31T18:00"}
    write(
        assigned(["invert_rigid", "match"], service="prairielearn", weights=["match=5"], **dates),
        out,
    )
    return out


def submitted(
    prairielearn: Path, python: str, folder: Path, *, text: str, exercise: str = "invert_rigid"
) -> dict:
    """Return what a submission's results.json says; it is there, and is what PrairieLearn
    documents.
    """
    (folder / "mine.py").write_text(text)
    root = lay_out_prairielearn(folder / "grade", prairielearn, exercise, file=folder / "mine.py")
    report = run(root / "serverFilesCourse" / "geometry-workbench" / "run.sh", root, python)
    conforms(report, PRAIRIELEARN)
    assert (root / "results" / "results.json").stat().st_size < 1_000_000
    return report


def test_a_question_is_what_prairielearn_documents(prairielearn):
    for name in ("invert_rigid", "match"):
        folder = prairielearn / "questions" / "geometry-workbench" / name
        info = json.loads((folder / "info.json").read_text())
        conforms(info, QUESTION)
        grader = info["externalGradingOptions"]
        entry = prairielearn / grader["entrypoint"].removeprefix("/grade/")
        assert entry.stat().st_mode & stat.S_IXUSR
        assert (
            entry.relative_to(prairielearn / "serverFilesCourse").parts[0] + "/"
            in grader["serverFilesCourse"]
        )
        page = (folder / "question.html").read_text()
        assert f'source-file-name="my_{name}.py"' in page
        assert "raise NotImplementedError" in (folder / f"my_{name}.py").read_text()
    (file,) = prairielearn.glob("assessments/*/infoAssessment.json")
    assessment = json.loads(file.read_text())
    conforms(assessment, ASSESSMENT)
    assert assessment["allowAccess"] == [
        {"credit": 100, "startDate": "2027-03-01T00:00:00", "endDate": "2027-03-31T18:00:00"}
    ]
    assert [question["autoPoints"] for question in assessment["zones"][0]["questions"]] == [10, 5]


@pytest.mark.parametrize(("sample", "score"), [("full", 1), ("none", 0)])
def test_prairielearn_gives_the_samples_what_they_deserve(
    prairielearn, bare, tmp_path, *, sample, score
):
    report = submitted(
        prairielearn,
        bare,
        tmp_path,
        text=(prairielearn / "teacher" / sample / "my_invert_rigid.py").read_text(),
    )
    assert report["score"] == score
    assert report["gradable"] is True


def test_prairielearn_shows_the_failing_case_and_nothing_of_hidden_checks(
    prairielearn, bare, tmp_path
):
    report = submitted(prairielearn, bare, tmp_path, text=WRONG)
    assert 0 <= report["score"] < 1
    assert "seen (4, 4)" in report["output"]
    (image,) = report["images"]
    picture = Image.open(io.BytesIO(base64.b64decode(image["url"].partition(",")[2])))
    assert picture.size == (640, 400)
    assert len(picture.getcolors(1 << 20) or []) > 10  # something is drawn
    assert "Step " in image["label"]
    hidden = [check.promise for check in exercises()["invert_rigid"].checks if not check.public]
    assert not [promise for promise in hidden if promise in json.dumps(report)]
    assert report["tests"][-1]["name"] == "Hidden checks"


def test_prairielearn_takes_no_attempt_for_what_cannot_be_graded(prairielearn, bare, tmp_path):
    report = submitted(prairielearn, bare, tmp_path, text="def invert_rigid(T:\n")
    assert report["gradable"] is False
    assert "line 1" in report["format_errors"][0]
