"""Files that are damaged or foreign, and places that cannot be written to: one line, and nothing
lost.
"""

import errno
import os
import re
import signal
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import rerun as rr

from tests import fake
from workbench.errors import InputError
from workbench.recording.read import digest, open_recording
from workbench.recording.write import record, record_file

ROOT = Path(__file__).resolve().parents[2]


def refuse(path: Path) -> str:
    """Return the one line with which a file is refused."""
    with pytest.raises(InputError) as caught:
        open_recording(path)
    line = str(caught.value)
    assert line.startswith(str(path))
    assert "\n" not in line
    return line


@pytest.mark.parametrize("share", [0.02, 0.3, 0.6, 0.9, 0.99, 0.999])
def test_a_file_that_is_cut_short_is_refused(fake_file, tmp_path, share):
    data = fake_file.read_bytes()
    short = tmp_path / "short.rrd"
    short.write_bytes(data[: int(len(data) * share)])
    refuse(short)


def test_a_changed_byte_is_noticed_or_changes_nothing_that_is_read(fake_file, tmp_path):
    data = fake_file.read_bytes()
    whole = open_recording(fake_file)
    for place in range(40, len(data), len(data) // 25):
        damaged = tmp_path / "damaged.rrd"
        damaged.write_bytes(data[:place] + bytes([data[place] ^ 0x55]) + data[place + 1 :])
        try:
            recording = open_recording(damaged)
        except InputError:
            continue
        assert (recording.captions, recording.params) == (whole.captions, whole.params)


def test_content_that_does_not_fit_its_fingerprint_is_noticed(tmp_path, monkeypatch):
    monkeypatch.setattr("workbench.recording.write.digest", lambda *content: "0" * 64)
    record(fake.lesson, tmp_path / "a.rrd")
    assert "fingerprint" in refuse(tmp_path / "a.rrd")


def test_the_fingerprint_sees_every_value():
    values = {"a": np.array([1.0, np.nan]), "b": np.array([2.0])}
    assert digest("{}", ["x"], values) == digest("{}", ["x"], dict(values))
    changed = {"a": np.array([1.0, np.nan]), "b": np.array([2.0000001])}
    others = [
        digest("{1}", ["x"], values),
        digest("{}", ["y"], values),
        digest("{}", ["x"], changed),
    ]
    assert len({digest("{}", ["x"], values), *others}) == 4


def test_empty_missing_and_other_files_are_refused(tmp_path):
    empty, text, image = tmp_path / "empty.rrd", tmp_path / "text.rrd", tmp_path / "image.rrd"
    empty.touch()
    text.write_text("This is no recording.")
    image.write_bytes(bytes(range(256)) * 50)
    assert "empty" in refuse(empty)
    assert "no such file" in refuse(tmp_path / "missing.rrd")
    assert "no such file" in refuse(tmp_path)
    for path in (text, image):
        assert "no Rerun recording" in refuse(path)


def test_recordings_of_other_programs_are_refused(tmp_path):
    stream = rr.RecordingStream("somebody-else")
    memory = stream.memory_recording()
    stream.log("points", rr.Points3D([[0, 0, 0]]))
    (tmp_path / "other.rrd").write_bytes(memory.drain_as_bytes())
    stream.disconnect()
    assert "not of a run of the workbench" in refuse(tmp_path / "other.rrd")


def test_bytes_behind_the_end_are_left_alone_without_a_word(fake_file, tmp_path):
    longer = tmp_path / "longer.rrd"
    longer.write_bytes(fake_file.read_bytes() + b"junk and more junk")
    code = f"from workbench import open_recording; print(len(open_recording({str(longer)!r})))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert (done.stdout, done.stderr) == (f"{len(open_recording(fake_file))}\n", "")


def test_two_recordings_in_one_file_are_refused(fake_file, tmp_path):
    from workbench.recording.viewer_files import binary

    other = record(fake.lesson, tmp_path / "b.rrd", fake.Params(steps=2))
    both = tmp_path / "both.rrd"
    subprocess.run(
        [str(binary()), "rrd", "merge", str(fake_file), str(other), "-o", str(both)], check=True
    )
    assert "2 recordings" in refuse(both)


def test_an_existing_file_is_replaced_only_by_force(tmp_path):
    path = tmp_path / "a.rrd"
    path.write_bytes(b"precious")
    with pytest.raises(InputError, match=r"exists already; force=True"):
        record(fake.lesson, path)
    assert path.read_bytes() == b"precious"
    record(fake.lesson, path, force=True)
    assert open_recording(path).complete


def test_a_failing_run_leaves_what_was_there(tmp_path):
    path = tmp_path / "a.rrd"
    path.write_bytes(b"precious")
    with pytest.raises(
        InputError,
        match=r"fake.py, line \d+: RuntimeError: a bug .*\(at step 2\); nothing was written",
    ):
        record(fake.lesson, path, fake.Params(trouble="crash"), force=True)
    assert os.listdir(tmp_path) == ["a.rrd"]
    assert path.read_bytes() == b"precious"


def test_a_run_that_is_interrupted_leaves_nothing(tmp_path, monkeypatch):
    def interrupted(*args, **kwargs):
        raise KeyboardInterrupt

    monkeypatch.setattr("workbench.machinery.atomic.os.fsync", interrupted)
    with pytest.raises(KeyboardInterrupt):
        record(fake.lesson, tmp_path / "a.rrd")
    assert os.listdir(tmp_path) == []


def test_what_a_killed_record_left_is_removed_by_the_next(tmp_path):
    code = (
        "import os, signal, sys; from pathlib import Path; from workbench.machinery import atomic;"
        "atomic.os.fsync = lambda file: os.kill(os.getpid(), signal.SIGKILL);"
        "atomic.write_atomic(Path(sys.argv[1]), b'half')"
    )
    killed = subprocess.run(
        [sys.executable, "-c", code, str(tmp_path / "other.rrd")], cwd=ROOT, check=False
    )
    assert killed.returncode == -signal.SIGKILL
    (left,) = os.listdir(tmp_path)
    # of a process that lives
    ours = left.replace(f"-{re.findall('-([0-9]+)-', left)[0]}-", f"-{os.getpid()}-")
    for name in (ours, ".mine.part", "a.rrd.part"):
        (tmp_path / name).touch()
    record(fake.lesson, tmp_path / "a.rrd")
    assert sorted(os.listdir(tmp_path)) == sorted(["a.rrd", ours, ".mine.part", "a.rrd.part"])


def test_a_full_disk_leaves_nothing_half_written(tmp_path, monkeypatch):
    def full(file):
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr("workbench.machinery.atomic.os.fsync", full)
    with pytest.raises(InputError, match=r"a\.rrd: cannot be written: No space left"):
        record(fake.lesson, tmp_path / "a.rrd")
    assert os.listdir(tmp_path) == []


def test_a_file_that_may_not_be_read_is_not_called_damaged(fake_file, monkeypatch):
    def forbidden(*args):
        raise PermissionError(errno.EACCES, "Permission denied")

    monkeypatch.setattr(Path, "open", forbidden)
    assert refuse(fake_file) == f"{fake_file}: cannot be read: Permission denied"


@pytest.mark.parametrize("place", ["missing/a.rrd", "file/a.rrd", "."])
def test_a_place_that_cannot_be_written_is_said_before_the_run(tmp_path, place):
    (tmp_path / "file").touch()
    with pytest.raises(InputError, match=r"no such folder|is not a file"):
        record_file(fake.lesson, fake.Params(trouble="crash"), tmp_path / place)


def test_a_folder_that_takes_no_files_is_said(tmp_path, monkeypatch):
    monkeypatch.setattr("workbench.machinery.atomic.os.access", lambda path, mode: False)
    with pytest.raises(InputError, match="cannot be written to"):
        record(fake.lesson, tmp_path / "a.rrd")


def test_a_link_is_followed(tmp_path):
    target = record(fake.lesson, tmp_path / "target.rrd")
    link = tmp_path / "link.rrd"
    link.symlink_to(target)
    record(fake.lesson, link, fake.Params(steps=2), force=True)
    assert link.is_symlink()
    assert len(open_recording(target)) == 2
