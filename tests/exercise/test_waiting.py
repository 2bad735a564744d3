"""How long a call is waited for, and for what: told from numbers, not from a clock."""

import os

import pytest

from workbench.exercise.sandbox import CallBudget, SandboxedFunction, function, waiting
from workbench.exercise.sandbox.pipe import Pipe
from workbench.exercise.sandbox.python import _without

SECOND = os.sysconf("SC_CLK_TCK") if hasattr(os, "sysconf") else 100


def process(proc, pid: int, *, ran: float, lost: float, all_ran: float, children: str = ""):
    """Write what Linux says of a process, seconds."""
    task = proc / str(pid) / "task" / str(pid)
    task.mkdir(parents=True)
    (proc / str(pid) / "schedstat").write_text(f"{ran * 1e9:.0f} {lost * 1e9:.0f} 3\n")
    times = f"{int(all_ran * SECOND) - SECOND} {SECOND}"
    (proc / str(pid) / "stat").write_text(f"{pid} (a) b) S 1 2 3 4 5 6 7 8 9 10 {times} 9 9\n")
    (task / "children").write_text(children)


def test_what_a_process_and_those_it_started_waited_for_a_processor(tmp_path, monkeypatch):
    proc = tmp_path / "proc"
    process(proc, 1, ran=2.0, lost=0.5, all_ran=2.0, children="2 3 9")
    process(proc, 2, ran=2.0, lost=5.0, all_ran=4.0)
    process(proc, 3, ran=2.0, lost=0.25, all_ran=9.0)
    process(proc, 4, ran=1.0, lost=7.0, all_ran=1.0, children="1")
    process(proc, 5, ran=1.0, lost=0.0, all_ran=1.0, children="6 6 6 6 4")
    process(proc, 6, ran=1.0, lost=1.5, all_ran=1.0)
    monkeypatch.setattr(waiting, "Path", lambda name: tmp_path / name.lstrip("/"))
    seconds = {pid: waiting.waited(pid) for pid in (1, 2, 3, 4, 5, 99)}
    assert seconds == {1: 3.0, 2: 3.0, 3: 0.0, 4: 7.0, 5: 1.5, 99: 0.0}
    (proc / "2" / "schedstat").write_text("what")
    assert waiting.waited(2) == 0.0


@pytest.mark.parametrize(
    ("calls", "over", "kind"),
    [
        ([], "", "timeout"),
        (["timeout"] * 2, "", "timeout"),
        (["timeout"] * 3, "3 calls already took too long", "timeout"),
        (["died"] * 3, "3 calls already ended its process", "died"),
        (["died", "died", "timeout"], "3 calls already took too long or crashed", "died"),
        (["died", "timeout", "timeout"], "3 calls already took too long or crashed", "timeout"),
        (["raised", ""] * 5, "", "timeout"),
    ],
)
def test_a_budget_is_over_after_three_that_came_to_nothing(calls, over, kind):
    budget = CallBudget(0.5)
    for how in calls:
        budget.took(0.5, how)
    assert (budget.over, budget.kind, budget.seconds) == (over, kind, 0.5)


def test_all_calls_take_twenty_times_the_limit_together():
    budget = CallBudget(0.5)
    budget.took(10.0, "")
    assert budget.over == ""
    budget.took(0.1, "")
    assert budget.over == "its calls together took more than 10 s"


def test_what_a_process_waited_since_it_was_asked_is_taken_off_a_call_that_was_not_short(
    tmp_path, monkeypatch
):
    (tmp_path / "my_f.py").write_text("import time\ndef f(s):\n    time.sleep(s)\n    return s\n")
    took: list[float] = []
    budget = CallBudget(5.0)
    monkeypatch.setattr(budget, "took", lambda seconds, how: took.append(seconds))
    with SandboxedFunction(tmp_path / "my_f.py", "f", budget=budget) as f:
        f.start()
        # since the process began: when it is asked, at the call's end, when it is asked again
        looks = [7.0, 7.2, 9.0]
        monkeypatch.setattr(function, "waited", lambda pid: looks.pop(0))
        assert f(0.5) == 0.5
        assert looks == [9.0]
        monkeypatch.setattr(function, "SHORT", 60.0)
        assert f(0.5) == 0.5
        assert looks == []
    long, short = took
    assert 0.3 <= long < short
    assert short >= 0.5


def test_a_pipe_waits_no_longer_than_it_was_told_and_knows_who_is_gone():
    pipe = Pipe()
    try:
        with pytest.raises(TimeoutError):
            pipe.ask({"do": "nothing"}, 0.01)
        with pytest.raises(TimeoutError):
            pipe.ask({"do": "x" * (1 << 20)}, 0.01)
        pipe.inherited()
        with pytest.raises(OSError, match=r"Broken pipe|gone"):
            pipe.ask({"do": "nothing"}, 1.0)
    finally:
        pipe.close()


def test_of_a_tree_all_is_listed_but_what_is_masked_and_links(tmp_path):
    for name in ("a/b/c.py", "a/d.py", "masked/e.py", "f/g.py", "f/masked/h.py"):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text("")
    (tmp_path / "link").symlink_to("masked")
    (tmp_path / "link.py").symlink_to("masked/e.py")
    masked = (str(tmp_path / "masked"), str(tmp_path / "f" / "masked"))
    paths = sorted(os.path.relpath(path, tmp_path) for path in _without(str(tmp_path), masked))
    assert paths == ["a", "f/g.py"]
    assert list(_without(str(tmp_path / "a"), masked)) == [str(tmp_path / "a")]
    assert list(_without(masked[0], masked)) == []
