"""The commands that read recordings or publish, as a shell sees them: exit codes, one line for
whatever goes wrong, nothing lost.
"""

import json
import subprocess
import sys
import urllib.request
from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np
import pytest

from tests import fake
from tests.shell import (
    HIDDEN,
    ROOT,
    command,
    nothing_is_served,  # noqa: F401 (a fixture)
    refused,
)
from workbench import record
from workbench.cli import main
from workbench.lesson import catalog
from workbench.recording.read import read_chunks

QUICK = "transforms"  # a lesson of the catalogue whose run is short


@pytest.fixture(scope="module")
def good(tmp_path_factory) -> Path:
    """A recording of a lesson of the catalogue."""
    return record(QUICK, tmp_path_factory.mktemp("cli") / "good.rrd")


def missing(path: Path, good: bytes) -> None:
    pass


def folder(path: Path, good: bytes) -> None:
    path.mkdir()


def empty(path: Path, good: bytes) -> None:
    path.touch()


def text(path: Path, good: bytes) -> None:
    path.write_text("No recording.")


def cut(path: Path, good: bytes) -> None:
    path.write_bytes(good[: len(good) // 2])


def flipped(path: Path, good: bytes) -> None:
    rng = np.random.default_rng(0)
    content = np.frombuffer(good, np.uint8).copy()
    places = rng.integers(16, len(content), 50)
    content[places] ^= rng.integers(1, 256, 50).astype(np.uint8)
    path.write_bytes(content.tobytes())


def foreign(path: Path, good: bytes) -> None:
    import rerun as rr

    stream = rr.RecordingStream("somebody-else")
    memory = stream.memory_recording()
    stream.log("points", rr.Points3D([[0, 0, 0]]))
    path.write_bytes(memory.drain_as_bytes())
    stream.disconnect()


BAD: dict[Callable[[Path, bytes], None], str] = {
    missing: "no such file",
    folder: "no such file",
    empty: "is empty",
    text: "no Rerun recording",
    cut: "no Rerun recording, or is damaged",
    flipped: "no Rerun recording, or is damaged",
    foreign: "not of a run of the workbench",
}


@pytest.mark.parametrize("make", BAD, ids=lambda make: make.__name__)
@pytest.mark.parametrize(
    "words", [["replay"], ["reopen"], ["compare", "good"]], ids=lambda words: words[0]
)
def test_a_bad_file_is_refused_in_one_line_and_left_as_it_is(
    capsys, good, tmp_path, *, words, make
):
    bad = tmp_path / "bad.rrd"
    make(bad, good.read_bytes())
    before = bad.read_bytes() if bad.is_file() else None
    line = refused(capsys, *(good if word == "good" else word for word in words), bad, *HIDDEN)
    assert line.startswith(f"workbench: {bad}: ")
    assert BAD[make] in line
    assert (bad.read_bytes() if bad.is_file() else None) == before


class TestReplay:
    def test_the_recording_is_served_to_this_machine_at_the_address_told_last(self, good):
        words = command("replay", str(good), *HIDDEN)
        with subprocess.Popen(words, cwd=ROOT, stdout=subprocess.PIPE, text=True) as process:
            assert process.stdout is not None
            address = process.stdout.readline().strip()
            try:
                assert address.startswith("http://127.0.0.1:")
                with urllib.request.urlopen(address) as answer:
                    assert "good.rrd" in answer.read().decode()
                with urllib.request.urlopen(f"{address}/0.rrd") as answer:
                    assert answer.read() == good.read_bytes()
            finally:
                process.terminate()

    def test_a_taken_port_is_said(self, capsys, good):
        import socket

        with socket.socket() as taken:
            taken.bind(("127.0.0.1", 0))
            taken.listen()
            port = taken.getsockname()[1]
            assert f"port {port} is in use" in refused(
                capsys, "replay", good, "--port", port, "--no-browser"
            )

    @pytest.mark.skipif(sys.platform == "win32", reason="the stand-in is a script")
    @pytest.mark.parametrize("code", [0, 1])
    def test_native_opens_reruns_own_window_without_statistics(
        self, capsys, good, tmp_path, *, monkeypatch, code
    ):
        window = tmp_path / "window"
        window.write_text(
            f"#!{sys.executable}\nimport json, os, sys\n"
            "json.dump([sys.argv[1:], os.environ.get('CI')], open(sys.argv[0] + '.json', 'w'))\n"
            f"sys.stderr.write('no display'); sys.exit({code})\n"
        )
        window.chmod(0o755)
        monkeypatch.setattr("workbench.recording.replay.binary", lambda: window)
        monkeypatch.delenv("RERUN_ANALYTICS", raising=False)
        monkeypatch.delenv("CI", raising=False)
        if code:
            assert "(no display); without --native it plays in the browser" in refused(
                capsys, "replay", good, "--native"
            )
        else:
            assert main(["replay", str(good), "--native"]) == 0
        assert json.loads((tmp_path / "window.json").read_text()) == [[str(good)], "1"]


@pytest.fixture
def opened(monkeypatch) -> list[tuple]:
    """What the live page is opened at, instead of opening it."""
    calls: list[tuple] = []
    monkeypatch.setattr(
        "workbench.viewer.serving.serve", lambda *place, **server: calls.append((*place, server))
    )
    return calls


class TestReopen:
    def test_the_lesson_opens_at_the_recorded_params(self, capsys, tmp_path, opened):
        lesson = catalog()[QUICK]
        preset = lesson.presets[-1]
        out = str(tmp_path / "a.rrd")
        assert main(["record", QUICK, "--preset", preset.name, "-o", out]) == 0
        assert main(["reopen", out, "--host", "127.0.0.1", *HIDDEN]) == 0
        [(*place, server)] = opened
        assert place == [lesson, preset.params, None]
        assert (server["host"], server["port"], server["browser"], server["open_to_all"]) == (
            "127.0.0.1",
            0,
            False,
            False,
        )
        assert capsys.readouterr().err == ""

    def test_another_version_is_a_warning_and_an_attempt(
        self, capsys, tmp_path, opened, *, monkeypatch
    ):
        monkeypatch.setattr("workbench.recording.write.__version__", "9.9")
        assert main(["reopen", str(record(QUICK, tmp_path / "a.rrd")), *HIDDEN]) == 0
        assert "recorded by version 9.9" in capsys.readouterr().err
        assert opened[0][1] == catalog()[QUICK].params()

    def test_a_lesson_that_is_not_here_is_said(self, capsys, tmp_path, opened):
        path = record(fake.lesson, tmp_path / "a.rrd")
        line = refused(capsys, "reopen", path, *HIDDEN)
        assert f"{path}: is a run of the lesson 'fake', which is not installed" in line
        assert opened == []


class TestCompare:
    def test_both_runs_are_played_as_one(self, good, tmp_path, monkeypatch):
        played: list[Sequence] = []

        def play(files, title, **where):
            (content,) = (file.read_bytes() for file in files.values())
            played.append((title, content, where))

        monkeypatch.setattr("workbench.recording.compare.play", play)
        other = record(QUICK, tmp_path / "other.rrd", preset=catalog()[QUICK].presets[0].name)
        assert main(["compare", str(good), str(other), *HIDDEN]) == 0
        ((title, content, where),) = played
        assert title == "good.rrd · other.rrd"
        assert where == {"native": False, "host": "127.0.0.1", "port": 0, "browser": False}
        (tmp_path / "both.rrd").write_bytes(content)
        entities = {chunk.entity_path for chunk in read_chunks(tmp_path / "both.rrd")}
        assert {"/a/caption", "/b/caption", "/differences"} <= entities

    def test_runs_of_two_lessons_are_refused(self, capsys, good, tmp_path):
        other = record(fake.lesson, tmp_path / "other.rrd")
        line = refused(capsys, "compare", good, other, *HIDDEN)
        assert f"{good} is a run of {QUICK}, {other} of fake" in line


class TestPublish:
    @pytest.mark.parametrize(
        "words",
        [
            ["--lesson", "icp", "ransac"],
            ["--lesson", "icp", "--lesson=ransac"],
            ["--lesson", "icp,ransac,icp"],
        ],
    )
    def test_lessons_are_named_as_anybody_would(self, tmp_path, monkeypatch, words):
        asked = []
        monkeypatch.setattr(
            "workbench.publish.site.publish", lambda out, lessons, **_: asked.extend(lessons) or []
        )
        main(["publish", str(tmp_path), *words, "--base-url", "https://example.org/"])
        assert [lesson.name for lesson in asked] == ["icp", "ransac"]

    @pytest.mark.parametrize(
        "words", [["--lesson"], ["--lesson", "--base-url", "https://example.org/"]]
    )
    def test_a_flag_without_its_names_is_said(self, capsys, tmp_path, words):
        assert "--lesson: expected at least one argument" in refused(
            capsys, "publish", tmp_path, *words
        )


def test_unknown_commands_and_flags_are_said(capsys):
    assert "no command is named 'recrod'; did you mean record?" in refused(capsys, "recrod")
    assert "unrecognized: --natve; did you mean --native?" in refused(
        capsys, "replay", "a.rrd", "--natve"
    )


@pytest.mark.parametrize("name", ["record", "replay", "reopen", "compare"])
def test_help_is_there(capsys, name):
    assert main([name, "--help"]) == 0
    assert f"usage: workbench {name}" in capsys.readouterr().out
