"""The commands about recordings, as a shell sees them: exit codes, one line for whatever goes
wrong, nothing lost.
"""

import json
import os
import subprocess
import sys
import urllib.request
from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np
import pytest

from tests import fake
from workbench import open_recording, record
from workbench.cli import main
from workbench.lesson import catalog
from workbench.recording.read import read_chunks

ROOT = Path(__file__).resolve().parents[1]
FAKE = str(ROOT / "tests" / "fake.py")
HIDDEN = ("--port", "0", "--no-browser")
QUICK = "transforms"  # a lesson of the catalogue whose run is short


@pytest.fixture(scope="module")
def good(tmp_path_factory) -> Path:
    """A recording of a lesson of the catalogue."""
    return record(QUICK, tmp_path_factory.mktemp("cli") / "good.rrd")


@pytest.fixture(autouse=True)
def nothing_is_served(monkeypatch) -> None:
    """Let a command that should not serve fail instead of waiting for ever; those in a process of
    their own do serve.
    """

    def enter(server):
        raise AssertionError(f"served at {server.address}")

    monkeypatch.setattr("workbench.recording.replay.ReplayServer.__enter__", enter)


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
    rng, content = np.random.default_rng(0), np.frombuffer(good, np.uint8).copy()
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


def refused(capsys, *words: object) -> str:
    """Carry out a command that must fail, and return its one line."""
    assert main([str(word) for word in words]) == 2
    out, line = capsys.readouterr()
    assert out == ""
    assert line.startswith("workbench: ")
    assert line.count("\n") == 1
    assert line.endswith("\n")
    return line


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


class TestRecord:
    def test_a_run_is_recorded_at_its_preset_and_knobs(self, capsys, tmp_path):
        out = tmp_path / "a.rrd"
        assert (
            main(
                ["record", FAKE, "--preset", "half", "--steps", "3", "--seed", "7", "-o", str(out)]
            )
            == 0
        )
        printed, complaints = capsys.readouterr()
        assert printed == f"{out}: 3 steps, {out.stat().st_size / 1e6:.1f} MB\n"
        assert complaints == ""  # a bar is for terminals only
        recording = open_recording(out)
        assert (recording.lesson, recording.seed, len(recording)) == ("fake", 7, 3)
        assert recording.params["angle"] == fake.lesson.preset("half").params.angle

    @pytest.mark.parametrize(
        ("words", "kept"),
        [
            ([], "short"),
            (["--steps", "2"], "short"),
            (["--steps", "3"], None),
            (["--wobble"], None),
        ],
    )
    def test_a_preset_s_name_is_kept_only_where_the_params_are_the_preset_s(
        self, tmp_path, words, kept
    ):
        out = tmp_path / "a.rrd"
        assert main(["record", FAKE, "--preset", "short", *words, "-o", str(out)]) == 0
        assert open_recording(out).preset == kept

    def test_a_terminal_sees_how_far_it_is(self, capsys, tmp_path, monkeypatch):
        monkeypatch.setattr(sys.stderr, "isatty", lambda: True, raising=False)
        assert main(["record", FAKE, "--steps", "3", "-o", str(tmp_path / "a.rrd")]) == 0
        told = capsys.readouterr().err
        assert "Recording" in told
        assert "3/3 recorded" in told
        assert told.endswith("\r\x1b[2K")  # wiped at the end

    def test_a_pipe_gets_the_recording_and_nothing_else(self, capsysbinary, tmp_path):
        assert main(["record", FAKE, "-o", "-"]) == 0
        data, complaints = capsysbinary.readouterr()
        assert complaints == b""
        (tmp_path / "a.rrd").write_bytes(data)
        assert open_recording(tmp_path / "a.rrd").complete

    def test_a_terminal_gets_no_bytes(self, capsys, monkeypatch):
        monkeypatch.setattr(sys.stdout, "isatty", lambda: True, raising=False)
        assert "is a terminal" in refused(capsys, "record", FAKE, "-o", "-")

    def test_a_closed_output_is_said(self, capsys, monkeypatch):
        monkeypatch.setattr(sys, "stdout", None)
        assert main(["record", FAKE, "-o", "-"]) == 2
        assert "standard output is closed" in capsys.readouterr().err

    @pytest.mark.parametrize(
        ("words", "why"),
        [
            (["nothing"], "no lesson is named 'nothing'"),
            ([FAKE, "--preset", "nope"], "no preset 'nope'; there are: "),
            ([FAKE, "--steps", "0"], "a whole number from 1 to 5000"),
            ([FAKE, "--stepps", "2"], "did you mean --steps?"),
            (
                [FAKE, "--trouble", "crash"],
                r'a bug in `raise RuntimeError("a\nbug")` (at step 2); nothing was written',
            ),
            ([FAKE, "--scan", "/nowhere.npy"], "/nowhere.npy"),
        ],
    )
    def test_what_cannot_be_run_is_said_and_nothing_is_written(
        self, capsys, tmp_path, words, *, why
    ):
        assert why in refused(capsys, "record", *words, "-o", tmp_path / "a.rrd")
        assert os.listdir(tmp_path) == []

    def test_the_file_has_to_be_named(self, capsys):
        assert "-o FILE.rrd" in refused(capsys, "record", FAKE)

    def test_a_file_that_is_there_stays_unless_forced(self, capsys, tmp_path):
        out = tmp_path / "a.rrd"
        out.write_text("precious")
        assert "exists already; --force replaces it" in refused(capsys, "record", FAKE, "-o", out)
        assert out.read_text() == "precious"
        refused(capsys, "record", FAKE, "--trouble", "crash", "-o", out, "--force")
        assert out.read_text() == "precious"
        assert main(["record", FAKE, "-o", str(out), "--force"]) == 0
        assert open_recording(out).complete

    @pytest.mark.parametrize(
        ("place", "why"),
        [
            ("none/a.rrd", "none: no such folder"),
            ("file/a.rrd", "file: no such folder"),
            (".", "is not a file"),
        ],
    )
    def test_a_place_that_takes_no_file_is_said(self, capsys, tmp_path, place, *, why):
        (tmp_path / "file").touch()
        assert why in refused(capsys, "record", FAKE, "-o", tmp_path / place)

    def test_a_folder_of_somebody_else_is_said(self, capsys, tmp_path, monkeypatch):
        monkeypatch.setattr(
            "workbench.machinery.atomic.os.access", lambda path, mode: False
        )  # root may write anywhere
        assert "cannot be written to" in refused(capsys, "record", FAKE, "-o", tmp_path / "a.rrd")

    @pytest.mark.parametrize("target", ["file", "pipe", "unbuffered pipe"])
    def test_a_full_disk_costs_nothing_that_was_there(self, tmp_path, target):
        resource = pytest.importorskip(
            "resource", reason="limits of processes are not set like this here"
        )
        out = tmp_path / "a.rrd"
        limit = (
            record(fake.lesson, out).stat().st_size - 4000
        )  # it fits but for what a buffer keeps to the end
        out.write_text("precious")
        words = [FAKE, "-o", str(out) if target == "file" else "-", "--force"]
        with (tmp_path / "pipe").open("wb") as pipe:
            done = subprocess.run(
                command("record", *words),
                cwd=ROOT,
                env=os.environ | {"PYTHONUNBUFFERED": "1" if target == "unbuffered pipe" else ""},
                stdout=pipe,
                stderr=subprocess.PIPE,
                text=True,
                check=False,
                preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit)),
            )
        where = str(out) if target == "file" else "standard output"
        assert (done.returncode, done.stderr) == (
            2,
            f"workbench: {where}: cannot be written: File too large\n",
        )
        assert out.read_text() == "precious"
        assert sorted(os.listdir(tmp_path)) == ["a.rrd", "pipe"]

    def test_a_recorder_that_is_killed_leaves_what_was_there(self, tmp_path):
        out, lesson = tmp_path / "out", tmp_path / "lesson.py"
        out.mkdir()
        (out / "old.rrd").write_text("precious")
        lesson.write_text(WAITING)
        for name in ("old.rrd", "new.rrd"):
            words = command("record", str(lesson), "-o", str(out / name), "--force")
            with subprocess.Popen(
                words, cwd=ROOT, stdin=subprocess.PIPE, stdout=subprocess.PIPE
            ) as process:
                assert process.stdout is not None
                assert process.stdout.readline() == b"in the middle\n"
                process.kill()
        assert os.listdir(out) == ["old.rrd"]
        assert (out / "old.rrd").read_text() == "precious"


WAITING = """
import sys
from dataclasses import replace
from tests import fake

def run(params):
    for k, state in enumerate(fake.run(params)):
        if k == 2:
            print("in the middle", flush=True)
            sys.stdin.read()
        yield state

lesson = replace(fake.lesson, name="waiting", run=run)
"""


def command(*words: str) -> list[str]:
    return [sys.executable, "-m", "workbench", *words]


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
