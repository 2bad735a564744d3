"""What people made with an earlier version still works: lessons, handouts, recordings.

All of `old/` was written by `workbench new`, `handout` and `record` at commit 39b9198. The
recording `equal` is of that lesson, `transforms` of the course's own. Nothing in `old/` is to be
edited: what fails here is mended in the workbench.
"""

import csv
import hashlib
import http.client
import json
import shutil
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import zstandard

from tests.fake_page import FakePage
from tests.loops import run_apart
from workbench import open_recording, record
from workbench.cli import main
from workbench.exercise.finding import exercises
from workbench.handout.assignment import read
from workbench.handout.writing import files
from workbench.lesson import Lesson
from workbench.recording.compare import compare_bytes
from workbench.recording.read import reopening
from workbench.recording.replay import ReplayServer
from workbench.run.links import Place
from workbench.run.loading import load
from workbench.run.timeline import Timeline
from workbench.viewer.server import Server

OLD = Path(__file__).parent / "old"
WRITTEN = "32d9a819ec6cde59"
HANDED_OUT = ("folder", "gradescope", "prairielearn/match", "prairielearn/invert_rigid")
WRONG = "def match(p_target, p_source):\n    return None\n"


@pytest.fixture
def beacon(tmp_path) -> Path:
    """A copy of the lesson's folder: running it writes bytecode."""
    return Path(shutil.copytree(OLD / "beacon", tmp_path / "lessons" / "beacon"))


@pytest.fixture
def lesson(beacon) -> Lesson:
    return load(beacon)


def unpacked(name: str, folder: Path) -> Path:
    """Return a recording as it was written."""
    path = folder / f"{name}.rrd"
    path.write_bytes(zstandard.decompress((OLD / f"{name}.rrd.zst").read_bytes()))
    return path


def test_nothing_old_was_edited():
    digest = hashlib.sha256()
    for path in sorted(
        path for path in OLD.rglob("*") if path.suffix in {".py", ".md", ".json", ".zst"}
    ):
        digest.update(path.relative_to(OLD).as_posix().encode() + b"\0" + path.read_bytes())
    assert digest.hexdigest()[:16] == WRITTEN


# a lesson -----------------------------------------------------------------------------------------


def test_an_old_lesson_runs(lesson):
    assert lesson.name == "beacon"
    for params in (lesson.params(), *(preset.params for preset in lesson.presets)):
        timeline = Timeline(lesson, params).complete()
        assert len(timeline) == params.fixes
        assert all(step.caption.text for step in timeline)


def test_an_old_lesson_holds_what_is_promised(beacon, capfd):
    assert main(["validate", str(beacon)]) == 0
    assert capfd.readouterr().out.startswith("beacon: holds (")


def test_an_old_lesson_is_recorded_and_published(beacon, lesson, tmp_path):
    assert main(["record", str(beacon), "--preset", "equal", "-o", str(tmp_path / "new.rrd")]) == 0
    assert len(open_recording(tmp_path / "new.rrd")) == lesson.params().fixes
    assert main(["publish", str(tmp_path / "site"), "--lesson", str(beacon)]) == 0
    page = (tmp_path / "site" / "beacon" / "index.html").read_text(encoding="utf-8")
    assert "The weighted mean" in page
    runs = {path.stem for path in (tmp_path / "site" / "beacon" / "runs").glob("*.js")}
    assert runs == {"default", *(preset.name for preset in lesson.presets)}


def test_an_old_lesson_opens_in_the_live_page(lesson):
    server = Server(Place(lesson, lesson.params()))
    timeline = Timeline(lesson, lesson.params()).complete()

    async def visit() -> None:
        page = await FakePage(f"{server.address}/", "?lesson=beacon").open()
        try:
            await page.until(lambda page: page.run.get("finished"))
            assert page.lesson == "beacon"
            for k in (3, 0, len(timeline) - 1):
                await page.seek(k)
                assert page.step["step"]["caption"] == timeline[k].caption.text
            await page.change("weights", "equal")
            assert page.scene_bytes > 0
        finally:
            await page.close()

    try:
        run_apart(visit())
    finally:
        server.stop()


def test_the_exercise_of_an_old_lesson_is_handed_out_and_judged(beacon, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert main(["exercise", "weighted_centroid", "--lesson", str(beacon)]) == 0
    mine = tmp_path / "my_weighted_centroid.py"
    starter = mine.read_text(encoding="utf-8")
    right = "if not w.any():\n        raise ValueError\n    return w @ p / w.sum()"
    for answer, code in ((right, 0), ("return w @ p / len(p)", 1)):
        mine.write_text(starter.replace("raise NotImplementedError", answer), encoding="utf-8")
        assert main(["check", str(mine), "--lesson", str(beacon), "--hidden"]) == code


# handouts -----------------------------------------------------------------------------------------


def graded(came: Path, assignment: Path) -> dict[str, dict[str, str]]:
    """Return the table of a class that was graded by an assignment: its rows by student."""
    main(["grade", str(came), "--assignment", str(assignment), "--jobs", "1"])
    text = (came / "graded" / "class.csv").read_text(encoding="utf-8")
    return {row["student"]: row for row in csv.DictReader(text.splitlines())}


@pytest.mark.parametrize("service", ["folder", "gradescope"])
def test_an_old_handout_is_graded_by_its_weights(tmp_path, service):
    came = tmp_path / "came"
    shutil.copytree(OLD / "handouts" / "folder" / "teacher" / "full", came / "full")
    shutil.copytree(OLD / "handouts" / service / "student", came / "untouched")
    shutil.copytree(came / "full", came / "half")
    (came / "half" / "my_match.py").write_text(WRONG, encoding="utf-8")
    rows = graded(came, OLD / "handouts" / service / "assignment.json")
    assert {name: (float(row["points"]), float(row["possible"])) for name, row in rows.items()} == {
        "full": (50, 50),
        "untouched": (0, 50),
        "half": (10, 50),
    }


@pytest.mark.parametrize("name", ["match", "invert_rigid"])
def test_old_questions_are_graded(tmp_path, name):
    question = OLD / "handouts" / "prairielearn" / name
    came = tmp_path / "came"
    starter = (question / f"my_{name}.py").read_text(encoding="utf-8")
    sample = (OLD / "handouts" / "folder" / "teacher" / "full" / f"my_{name}.py").read_text(
        encoding="utf-8"
    )
    for student, text in (("nothing", starter), ("full", f"{starter}\n\n{sample}")):
        (came / student).mkdir(parents=True)
        (came / student / f"my_{name}.py").write_text(text, encoding="utf-8")
    rows = graded(came, question / "assignment.json")
    shares = {
        student: float(row["points"]) / float(row["possible"]) for student, row in rows.items()
    }
    assert shares == {"nothing": 0, "full": 1}


@pytest.mark.parametrize("place", HANDED_OUT)
def test_an_old_assignment_is_handed_out_anew(place):
    text = (OLD / "handouts" / place / "assignment.json").read_text(encoding="utf-8")
    assignment = read(text)
    assert json.loads(assignment.text()) == json.loads(text)
    assert set(json.loads(text)["weights"]) <= set(exercises())
    assert files(assignment)


# recordings ---------------------------------------------------------------------------------------


def test_an_old_recording_says_what_it_said(tmp_path, lesson):
    recording = open_recording(unpacked("equal", tmp_path))
    assert (recording.lesson, len(recording), recording.complete) == ("beacon", 3, True)
    timeline = Timeline(lesson, recording.typed_params(lesson)).complete()
    assert list(recording.captions) == [step.caption.text for step in timeline]


def test_an_old_recording_goes_on_from_its_place(tmp_path, lesson):
    opened, params, lines = reopening(unpacked("equal", tmp_path), lesson)
    assert opened is lesson
    assert params == replace(lesson.presets[1].params, fixes=3)
    assert [line for line in lines if "format" not in line] == []


def test_a_new_recording_of_an_old_run_has_the_same_content(tmp_path, lesson):
    before = open_recording(unpacked("equal", tmp_path))
    after = open_recording(record(lesson, tmp_path / "after.rrd", before.typed_params(lesson)))
    assert before.captions == after.captions
    assert set(before.scalars) == set(after.scalars)
    for name in before.scalars:
        # the last bit hangs on which instructions the processor's linear algebra takes
        np.testing.assert_array_max_ulp(before.scalars[name], after.scalars[name], maxulp=4)


@pytest.mark.parametrize("name", ["equal", "transforms"])
def test_old_recordings_are_replayed_and_compared(tmp_path, lesson, name):
    path = unpacked(name, tmp_path)
    with ReplayServer({path.name: path}, "Old", port=0) as replay:
        asked = http.client.HTTPConnection("127.0.0.1", replay.port, timeout=30)
        asked.request("GET", "/0.rrd")
        assert asked.getresponse().read() == path.read_bytes()
        asked.close()
    new = record(lesson if name == "equal" else name, tmp_path / "new.rrd")
    assert compare_bytes(path, new)
