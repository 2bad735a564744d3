"""Processes that share out work end with it, with an error, and with the process that started
them.
"""

import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

from workbench.machinery.workers import WorkerLostError, parallel_map

ROOT = Path(__file__).resolve().parents[1]
PATIENCE = 120.0
"""Seconds after which a process that should have ended counts as one that never will."""
RUNS_LONG = """
import sys
from tests.test_processes import begin_and_wait
from workbench.machinery.workers import parallel_map
if __name__ == "__main__":
    for task in parallel_map(begin_and_wait, [sys.argv[1] + "/a", sys.argv[1] + "/b"], 2):
        pass
"""


def square(number: int) -> int:
    return number * number


def fail(number: int) -> int:
    raise ValueError(f"{number} is bad")


def vanish(number: int) -> int:
    os._exit(3)


def begin_and_wait(path: str) -> None:
    """Say who works here, then work on for as long as nobody ends it."""
    half = Path(f"{path}.half")
    half.write_text(str(os.getpid()))
    half.rename(path)
    while True:
        sum(range(10_000))


def test_everything_is_done_once():
    assert sorted(parallel_map(square, range(5), 2)) == [(n, n * n) for n in range(5)]
    assert list(parallel_map(square, [], 2)) == []


def test_an_error_is_raised_here():
    with pytest.raises(ValueError, match="3 is bad"):
        list(parallel_map(fail, [3], 2))


def test_a_process_that_is_ended_from_outside_is_noticed():
    with pytest.raises(WorkerLostError):
        list(parallel_map(vanish, [1], 1))


def vanish_or_hang(number: int) -> int:
    if number == 1:
        os._exit(3)
    while number == 2:
        time.sleep(0.1)
    return number


@pytest.mark.parametrize("start", ["spawn", "fork"])
def test_what_is_lost_or_takes_too_long_costs_no_other(start):
    results = parallel_map(
        vanish_or_hang, range(6), 2, seconds=3.0, lost=lambda number: -number, start=start
    )
    assert sorted(results) == [(0, 0), (1, -1), (2, -2), (3, 3), (4, 4), (5, 5)]


@pytest.mark.skipif(sys.platform != "linux", reason="looks for processes in /proc")
@pytest.mark.parametrize("how", [signal.SIGTERM, signal.SIGKILL, signal.SIGINT])
def test_workers_end_with_the_process_that_started_them(tmp_path, how):
    script = tmp_path / "script.py"
    script.write_text(RUNS_LONG)
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    command = [sys.executable, str(script), str(tmp_path)]
    pipe: Any = {"stdout": subprocess.PIPE, "stderr": subprocess.STDOUT, "start_new_session": True}
    process: Any
    with (
        subprocess.Popen(command, env=environment, preexec_fn=heed_ctrl_c, **pipe) as process,
        ended(process),
    ):
        places = [tmp_path / "a", tmp_path / "b"]
        until(lambda: process.poll() is not None or all(place.exists() for place in places))
        workers = [int(place.read_text()) for place in places]
        if how == signal.SIGINT:
            os.killpg(process.pid, how)  # as a terminal does
        else:
            process.send_signal(how)
        log, _ = process.communicate(timeout=PATIENCE)  # ends when nobody holds the pipe any more
        assert log.count(b"Traceback") == (how == signal.SIGINT), log.decode()
        until(lambda: not any(is_alive(worker) for worker in workers))


def heed_ctrl_c() -> None:
    """What runs in a shell's background is started deaf to it."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


@contextmanager
def ended(process: subprocess.Popen) -> Iterator[None]:
    """Leave nothing behind that would be waited for, whatever fails in the block."""
    try:
        yield
    finally:
        process.kill()


def is_alive(process: int) -> bool:
    try:
        return Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


def until(condition) -> None:
    """Wait for a state."""
    end = time.monotonic() + PATIENCE
    while not condition():
        assert time.monotonic() < end, "it never came"
        time.sleep(0.01)
