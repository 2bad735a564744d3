"""Whatever ends the grader, nothing of a submission goes on: no process, no folder, and the results
so far are kept.
"""

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from tests.exercise.processes import family
from workbench.exercise.sandbox import best

HANGS = "import time\ndef invert_rigid(T):\n    while True: time.sleep(0.01)\n"
RIGHT = "import numpy as np\ndef invert_rigid(T):\n    return np.linalg.inv(T)\n"

pytestmark = pytest.mark.skipif(
    sys.platform != "linux" or not best().holds,
    reason=f"nothing shuts submissions in here: {best().why}",
)


def until(seen, seconds: float = 300.0):
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        result = seen()
        if result:
            return result
        time.sleep(0.05)
    raise AssertionError("it did not come to that")


def sandboxed(first: int) -> set[int]:
    """Return all processes under the grader, once one of them is a student's that was started."""
    pids = family(first) - {first}
    return pids if any(b"/main.py" in _command(pid) for pid in pids) else set()


def _command(pid: int) -> bytes:
    try:
        return Path(f"/proc/{pid}/cmdline").read_bytes()
    except OSError:
        return b""


def there(pids: set[int]) -> set[int]:
    return {pid for pid in pids if family(pid)}


@pytest.fixture
def grading(tmp_path):
    """A class that hangs but for the first student, being graded, and all processes of it."""
    (tmp_path / "in").mkdir()
    (tmp_path / "in" / "a.py").write_text(RIGHT)
    for name in "bcdefgh":
        (tmp_path / "in" / f"{name}.py").write_text(HANGS)
    (tmp_path / "tmp").mkdir()
    process = subprocess.Popen(
        [
            sys.executable,
            "-m",
            "workbench",
            "grade",
            str(tmp_path / "in"),
            "--only",
            "invert_rigid",
            "--jobs",
            "2",
        ],
        stderr=subprocess.PIPE,
        stdout=subprocess.PIPE,
        env=os.environ | {"TMPDIR": str(tmp_path / "tmp")},
        start_new_session=True,
    )
    first = tmp_path / "in" / "graded" / "students" / "a.json"
    until(lambda: first.exists() or process.poll() is not None)
    pids = until(lambda: sandboxed(process.pid))
    yield process, pids | sandboxed(process.pid), tmp_path
    process.kill()
    process.communicate()


@pytest.mark.parametrize("how", [signal.SIGINT, signal.SIGTERM])
def test_interrupted_it_ends_with_a_word_and_goes_on_later(grading, how):
    process, pids, folder = grading
    process.send_signal(how)
    _, stderr = process.communicate(timeout=300)  # 1.1 s on a machine with nothing else to do
    assert process.returncode == 130
    assert b"Interrupted" in stderr
    assert b"Traceback" not in stderr
    until(lambda: not there(pids))
    assert list((folder / "tmp").iterdir()) == []
    assert (
        json.loads((folder / "in" / "graded" / "students" / "a.json").read_text())["reports"][0][
            "points"
        ]
        > 0
    )
    assert not (folder / "in" / "graded" / "class.csv").exists()


def test_killed_it_leaves_no_process_and_no_folder(grading):
    process, pids, folder = grading
    process.kill()
    process.wait()
    until(lambda: not there(pids))
    assert list((folder / "tmp").iterdir()) == []


def test_a_worker_that_is_killed_takes_its_submission_along_and_costs_no_other(grading):
    process, _, _ = grading
    worker = min(
        pid for pid in family(process.pid) - {process.pid} if b"/main.py" not in _command(pid)
    )
    its = family(worker) - {worker}
    os.kill(worker, signal.SIGKILL)
    until(lambda: not there(its))
    assert process.poll() is None
    until(lambda: sandboxed(process.pid))


@pytest.mark.parametrize(
    ("how", "sandbox"),
    [
        (signal.SIGINT, "auto"),
        (signal.SIGTERM, "auto"),
        (signal.SIGKILL, "auto"),
        (signal.SIGKILL, "none"),
    ],
)
def test_a_check_that_is_ended_leaves_nothing(tmp_path, how, sandbox):
    (tmp_path / "my_invert_rigid.py").write_text(HANGS)
    (tmp_path / "tmp").mkdir()
    process = subprocess.Popen(
        [
            sys.executable,
            "-m",
            "workbench",
            "check",
            str(tmp_path / "my_invert_rigid.py"),
            "--sandbox",
            sandbox,
        ],
        stdout=subprocess.DEVNULL,
        env=os.environ | {"TMPDIR": str(tmp_path / "tmp")},
        start_new_session=True,
    )
    pids = until(lambda: sandboxed(process.pid))
    process.send_signal(how)
    process.wait(300)
    until(lambda: not there(pids))
    assert list((tmp_path / "tmp").iterdir()) == []
