"""A new lesson: its folder runs, holds what is promised of all lessons, records, publishes and is
graded as it is.
"""

from pathlib import Path

import pytest

from workbench import open_recording
from workbench.cli import main


@pytest.fixture
def written(tmp_path, monkeypatch, capfd) -> Path:
    monkeypatch.chdir(tmp_path)
    assert main(["new", "beacon"]) == 0
    lines = capfd.readouterr().out.splitlines()
    assert [Path(line) for line in lines[:-1]] == sorted(Path("beacon").rglob("*.*"))
    assert lines[-1] == "Open it: workbench show beacon"
    return tmp_path / "beacon"


def test_it_holds_what_is_promised_of_all_lessons(written, capfd):
    assert main(["validate", "beacon"]) == 0
    assert capfd.readouterr().out.startswith("beacon: holds (")


def test_it_is_recorded_and_published(written, tmp_path):
    assert main(["record", "beacon", "--preset", "ignored", "-o", "ignored.rrd"]) == 0
    recording = open_recording(tmp_path / "ignored.rrd")
    assert (recording.lesson, len(recording)) == ("beacon", 30)
    assert main(["publish", "site", "--lesson", "beacon"]) == 0
    page = (tmp_path / "site" / "beacon" / "index.html").read_text(encoding="utf-8")
    assert "The weighted mean" in page
    assert {path.stem for path in (tmp_path / "site" / "beacon" / "runs").glob("*.js")} == {
        "default",
        "weighted",
        "ignored",
        "stray",
        *(f"weighted_weight.{weight}" for weight in ("0_1", "0_4", "0_55", "0_7", "0_85")),
    }


def test_its_exercise_is_handed_out_and_judged(written, tmp_path, capfd):
    assert main(["exercise", "weighted_centroid", "--lesson", "beacon"]) == 0
    mine = tmp_path / "my_weighted_centroid.py"
    text = mine.read_text(encoding="utf-8")
    for answer, code in (("w @ p / len(p)", 1), ("w @ p / w.sum() if w.any() else [][0]", 1)):
        mine.write_text(
            text.replace("raise NotImplementedError", f"return {answer}"), encoding="utf-8"
        )
        assert main(["check", str(mine), "--lesson", "beacon", "--hidden"]) == code
    assert "Divide it by the sum of the weights" in capfd.readouterr().out
    right = "if not w.any():\n        raise ValueError\n    return w @ p / w.sum()"
    mine.write_text(text.replace("raise NotImplementedError", right), encoding="utf-8")
    assert main(["check", str(mine), "--lesson", "beacon", "--hidden"]) == 0


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("two words", "'two words' is no name for a lesson"),
        ("../up", "'../up' is no name for a lesson"),
        ("class", "'class' is no name for a lesson"),
        ("Icp", "'Icp' is no name for a lesson"),
        ("icp", "a lesson 'icp' is there already"),
        ("taken", "taken is there already: nothing was written"),
    ],
)
def test_what_is_no_name_or_taken_is_refused_and_nothing_is_written(
    tmp_path, monkeypatch, capfd, *, name, message
):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "taken").write_text("mine")
    assert main(["new", name]) == 2
    assert capfd.readouterr().err.startswith(f"workbench: {message}")
    assert [path.name for path in tmp_path.iterdir()] == ["taken"]
    assert (tmp_path / "taken").read_text() == "mine"
