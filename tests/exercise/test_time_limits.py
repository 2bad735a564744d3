"""How long a student's function may take, in one call and in all: who is late loses that call, who
waits for a processor loses nothing.
"""

import signal
import subprocess
import sys
import time
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.exercise.written import POINTS, written
from workbench.exercise.model import contract
from workbench.exercise.sandbox import CallBudget, SandboxedFunction, StudentError, Wall, isolation
from workbench.exercise.sandbox.pipe import _Deadline
from workbench.exercise.sandbox.waiting import waited


@pytest.mark.parametrize(
    ("body", "kind", "reason"),
    [
        ("while True: pass", "timeout", "took too long"),
        ("import os; os._exit(1)", "died", "ended its process"),
    ],
)
def test_an_endless_loop_costs_its_limit_three_times(tmp_path, body, kind, *, reason):
    given = written(tmp_path, body).submission
    with SandboxedFunction(given, "centroid", seconds=5.0, budget=CallBudget(5.0)) as student:
        began = time.monotonic()
        errors = []
        for _ in range(20):
            with pytest.raises(StudentError) as caught:
                student(POINTS)
            errors.append(caught.value)
    assert {error.kind for error in errors} == {kind}
    assert [f"not called: 3 calls already {reason}" in str(error) for error in errors] == [
        False
    ] * 3 + [True] * 17
    # 15 s of waiting, and starting three times; 100 s without a bound
    assert time.monotonic() - began < 75


def test_one_late_call_takes_no_time_from_the_next(tmp_path):
    """Who was promised a second has it in every call: a slow right function keeps its points."""
    body = "import time; time.sleep(3.0 if p.max() > 100 else 0.7); return p.mean(axis=0)"
    given = written(tmp_path, body).submission
    with SandboxedFunction(given, "centroid", seconds=1.5, budget=CallBudget(1.5)) as student:
        for _ in range(2):
            with pytest.raises(
                StudentError, match=r"took more than 1\.5 s, the limit, .* too slow"
            ):
                student(1000 * POINTS)
            np.testing.assert_allclose(student(POINTS), [4.5, 5.5, 6.5])


@pytest.mark.skipif(sys.platform != "linux", reason="Linux counts it")
def test_threads_of_one_s_own_do_not_stretch_the_time():
    """Threads that crowd one processor wait for each other; what the others ran is the function's
    own time.
    """
    busy = """
import os, threading, time
import numpy as np
os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})
A = np.random.default_rng(0).normal(size=(400, 400))
def work():
    until = time.monotonic() + 3
    while time.monotonic() < until: np.sort(A, axis=None)
threads = [threading.Thread(target=work) for _ in range(4)]
for one in threads: one.start()
work()
for one in threads: one.join()
print(time.process_time() - time.thread_time(), flush=True)
time.sleep(60)
"""
    with subprocess.Popen([sys.executable, "-c", busy], stdout=subprocess.PIPE) as process:
        try:
            assert process.stdout is not None
            others = float(process.stdout.readline())
            raw = int(Path(f"/proc/{process.pid}/schedstat").read_text().split()[1]) / 1e9
            counted = waited(process.pid)
        finally:
            process.kill()
    assert min(raw, others) > 0.3
    assert counted <= raw - min(raw, others) + 0.1


def test_who_hangs_in_one_place_is_called_in_all_others(tmp_path):
    given = written(tmp_path, "while p.max() > 100: pass\nreturn p.mean(axis=0)").submission
    with SandboxedFunction(given, "centroid", seconds=1.0, budget=CallBudget(1.0)) as student:
        with pytest.raises(StudentError, match="took more than"):
            student(1000 * POINTS)
        for _ in range(5):
            np.testing.assert_allclose(student(POINTS), [4.5, 5.5, 6.5])


def test_a_call_may_take_five_seconds_unless_a_contract_says_otherwise(tmp_path):
    function = SandboxedFunction(written(tmp_path, "return p").submission, "centroid")
    assert function._seconds == contract(slot="turn")(lambda p: p).seconds == 5.0


def test_a_process_may_use_a_minute_and_twenty_times_a_call_of_the_processor(tmp_path):
    @dataclass(frozen=True)
    class Noting(Wall):
        asked: dict[str, Any] = field(default_factory=dict)

        def start(self, **how: Any) -> subprocess.Popen:
            self.asked.update(how)
            raise OSError("nothing starts here")

    wall = Noting("none")
    given = written(tmp_path, "return p").submission
    with (
        SandboxedFunction(given, "centroid", seconds=3.0, megabytes=512, wall=wall) as student,
        pytest.raises(OSError, match="nothing starts"),
    ):
        student(POINTS)
    assert (wall.asked["cpu_seconds"], wall.asked["megabytes"]) == (60 + 20 * 3, 512)


def test_all_calls_together_have_a_bound():
    patience = CallBudget(0.5)
    for _ in range(30):
        patience.took(0.4, "")
    assert "together" in patience.over


def test_waiting_for_a_processor_is_not_the_function_s_time():
    clock, lost = [0.0], [0.0]
    with pytest.MonkeyPatch.context() as patched:
        patched.setattr("workbench.exercise.sandbox.pipe.time.monotonic", lambda: clock[0])
        deadline = _Deadline(5.0, lambda: lost[0])
        clock[0] = 6.0
        assert deadline.left() == pytest.approx(-1)
        lost[0] = 4.0
        assert deadline.left() == pytest.approx(3)
        clock[0], lost[0] = 51.0, 50.0
        assert deadline.left() == pytest.approx(-1)  # ten times as long at most


@pytest.mark.skipif(sys.platform != "linux", reason="Linux counts it")
def test_a_process_that_shares_one_processor_has_waited_for_it():
    busy = "import os; os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})\nwhile True: pass"
    pair = [subprocess.Popen([sys.executable, "-c", busy]) for _ in range(2)]
    try:
        end = time.monotonic() + 60
        while min(waited(process.pid) for process in pair) < 0.3 and time.monotonic() < end:
            time.sleep(0.05)
        assert min(waited(process.pid) for process in pair) >= 0.3
        assert waited(1 << 30) == 0.0
    finally:
        for process in pair:
            process.kill()
            process.wait()


class Trying:
    """A wall whose process is a few lines of Python, for a child to run in."""

    name = "trying"

    def __init__(self, code: str):
        self.code = code

    def start(self, *, printed: Any, **_: Any) -> subprocess.Popen:
        self.process = subprocess.Popen([sys.executable, "-c", self.code], stdout=printed)
        return self.process


def test_a_wall_that_does_not_start_in_time_is_told_and_its_process_ended(monkeypatch):
    wall = Trying("import time; time.sleep(60)")
    monkeypatch.setattr(isolation, "START_SECONDS", 0.2)
    assert isolation._tried.__wrapped__(wall) == "trying does not start within 0.2 s"
    assert wall.process.returncode == -signal.SIGKILL


@pytest.mark.parametrize(
    ("code", "why"),
    [
        ("exit()", ""),
        ("print(1); print('no namespaces'); exit(3)", "no namespaces"),
        ("exit(3)", "exit code 3"),
    ],
)
def test_a_wall_that_cannot_do_its_work_is_told_with_the_last_line_that_it_printed(code, why):
    told = isolation._tried.__wrapped__(Trying(code))
    assert told == (why and f"trying cannot do its work here ({why})")
