"""The command that records, as a shell sees it: what it writes and tells, and that nothing is lost
where it cannot write or is killed.
"""

import os
import subprocess
import sys

import pytest

from tests import fake
from tests.shell import (
    ROOT,
    command,
    nothing_is_served,  # noqa: F401 (a fixture)
    refused,
)
from workbench import open_recording, record
from workbench.cli import main

FAKE = str(ROOT / "tests" / "fake.py")


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
        # root may write anywhere
        monkeypatch.setattr("workbench.machinery.atomic.os.access", lambda path, mode: False)
        assert "cannot be written to" in refused(capsys, "record", FAKE, "-o", tmp_path / "a.rrd")

    @pytest.mark.parametrize("target", ["file", "pipe", "unbuffered pipe"])
    def test_a_full_disk_costs_nothing_that_was_there(self, tmp_path, target):
        resource = pytest.importorskip(
            "resource", reason="limits of processes are not set like this here"
        )
        out = tmp_path / "a.rrd"
        # it fits but for what a buffer keeps to the end
        limit = record(fake.lesson, out).stat().st_size - 4000
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
