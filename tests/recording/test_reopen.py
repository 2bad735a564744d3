"""Re-opening a recording that somebody else made: names in it are looked up, never run; its files
are not read unasked.
"""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from tests import fake
from workbench import record
from workbench.cli import main
from workbench.errors import InputError
from workbench.lesson import Lesson, catalog, find
from workbench.recording.read import FORMAT, reopening

EVIL = (
    "from pathlib import Path\nPath(__file__).with_name('was-run').touch()\nfrom tests.fake import"
    " lesson\n"
)
MINE = (
    "from dataclasses import replace\nfrom tests.fake import lesson\nlesson = replace(lesson,"
    " name='mine')\n"
)


def recorded(folder: Path, name: str, **params) -> Path:
    """A recording that says it is of the lesson `name`."""
    return record(
        replace(fake.lesson, name=name), folder / "run.rrd", fake.Params(steps=2, **params)
    )


@pytest.fixture
def opened(monkeypatch) -> list[tuple[Lesson, object]]:
    """What the live page is opened at, instead of opening it."""
    calls: list[tuple[Lesson, object]] = []
    monkeypatch.setattr(
        "workbench.viewer.serving.serve",
        lambda lesson, params, step, **_: calls.append((lesson, params)),
    )
    return calls


@pytest.mark.parametrize(
    "name", ["evil.py", "./evil.py", "../evil.py", "ABSOLUTE", "evil", "evil:lesson", "tests.fake"]
)
def test_a_name_in_a_recording_is_never_run(capsys, tmp_path, monkeypatch, *, opened, name):
    here = tmp_path / "here"
    here.mkdir()
    for folder in (tmp_path, here):
        (folder / "evil.py").write_text(EVIL)
    path = recorded(here, str(tmp_path / "evil.py") if name == "ABSOLUTE" else name)
    monkeypatch.chdir(here)
    monkeypatch.syspath_prepend(here)
    assert main(["reopen", str(path), "--no-browser"]) == 2
    line = capsys.readouterr().err
    assert "which is not installed" in line
    assert "--lesson FILE.py" in line
    assert line.count("\n") == 1
    assert opened == []
    assert not list(tmp_path.rglob("was-run"))


@pytest.mark.parametrize("name", ["evil.py", "../evil.py", "tests.fake", ""])
def test_looking_a_name_up_runs_nothing(tmp_path, monkeypatch, name):
    (tmp_path / "evil.py").write_text(EVIL)
    monkeypatch.chdir(tmp_path)
    for look_up in (find, lambda name: record(name, tmp_path / "a.rrd")):
        with pytest.raises(InputError, match=f"no lesson is named '{name}'"):
            look_up(name)
    assert [path.name for path in tmp_path.iterdir()] == ["evil.py"]


def test_a_single_file_lesson_is_reopened_where_the_person_names_its_file(tmp_path, opened):
    (tmp_path / "my_lesson.py").write_text(MINE)
    path = recorded(tmp_path, "mine", angle=30.0)
    assert main(["reopen", str(path), "--lesson", str(tmp_path / "my_lesson.py")]) == 0
    ((lesson, params),) = opened
    assert lesson.name == "mine"
    assert params == fake.Params(steps=2, angle=30.0)


def test_the_lesson_that_is_given_has_to_be_the_recording_s(capsys, tmp_path, opened):
    (tmp_path / "my_lesson.py").write_text(MINE)
    path = recorded(tmp_path, "yours")
    for given, name in ((str(tmp_path / "my_lesson.py"), "mine"), ("icp", "icp")):
        assert main(["reopen", str(path), "--lesson", given]) == 2
        assert (
            f"is a run of the lesson 'yours', and the lesson given is '{name}'"
            in capsys.readouterr().err
        )
    assert main(["reopen", str(path), "--lesson", str(tmp_path / "no.py")]) == 2
    assert "no.py: no such file" in capsys.readouterr().err
    assert opened == []


def test_files_that_a_recording_names_are_read_only_where_the_person_says_so(
    capsys, tmp_path, opened
):
    (tmp_path / "fake.py").write_text("from tests.fake import lesson\n")
    np.save(tmp_path / "scan.npy", np.zeros((4, 3)))
    words = [
        "reopen",
        str(recorded(tmp_path, "fake", scan=tmp_path / "scan.npy")),
        "--lesson",
        str(tmp_path / "fake.py"),
    ]
    assert main(words) == 2
    line = capsys.readouterr().err
    assert f"was made from files (scan {tmp_path / 'scan.npy'})" in line
    assert "--files" in line
    assert opened == []
    assert main([*words, "--files"]) == 0
    assert opened == [(fake.lesson, fake.Params(steps=2, scan=tmp_path / "scan.npy"))]


def test_what_a_recording_says_cannot_drive_the_terminal(capsys, tmp_path):
    path = recorded(tmp_path, "\x1b[2J\x1b]0;owned\x07")
    assert main(["reopen", str(path)]) == 2
    line = capsys.readouterr().err
    assert line.removesuffix("\n").isprintable()
    assert "owned" in line


def test_another_version_is_warned_of_and_tried(tmp_path, monkeypatch):
    monkeypatch.setattr("workbench.recording.write.__version__", "9.9")
    monkeypatch.setattr("workbench.recording.write.FORMAT", FORMAT + 1)
    odd = '{"angle": 30.0, "steps": 999999, "gone": 1}'
    monkeypatch.setattr("workbench.recording.write.knobs.to_json", lambda params: odd)
    lesson, params, lines = reopening(record(fake.lesson, tmp_path / "a.rrd"), fake.lesson)
    assert (lesson, params) == (fake.lesson, fake.Params(angle=30.0))
    assert len(lines) == 4
    for line, word in zip(
        lines, ("version 9.9", f"format {FORMAT + 1}", "steps", "gone"), strict=True
    ):
        assert word in line


@pytest.mark.parametrize("odd", ["[]", "3", '"x"', "[" * 5000])
def test_params_that_are_none_are_damage(capsys, tmp_path, monkeypatch, *, odd):
    monkeypatch.setattr("workbench.recording.write.knobs.to_json", lambda params: odd)
    path = record(fake.lesson, tmp_path / "a.rrd")
    assert main(["reopen", str(path)]) == 2
    assert "is damaged" in capsys.readouterr().err


def test_a_lesson_of_the_catalogue_is_found_by_its_name(tmp_path):
    lesson = catalog()["transforms"]
    path = record(lesson, tmp_path / "a.rrd")
    assert reopening(path) == (lesson, lesson.params(), [])
