"""Processes that share out work; they end with it, and with the process that started them."""

import contextlib
import multiprocessing
import os
import signal
import sys
import threading
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from multiprocessing.connection import Connection, wait
from multiprocessing.process import BaseProcess
from typing import Any, Literal, TypeVar

T = TypeVar("T")
R = TypeVar("R")


class WorkerLostError(Exception):
    """A process that worked was ended from outside."""


@dataclass
class _Worker:
    process: BaseProcess
    pipe: Connection
    task: Any = None
    since: float = 0.0

    def take(self, task: Any) -> None:
        self.task = task
        self.since = time.monotonic()
        with contextlib.suppress(OSError):  # it has died; that is seen when it is asked
            self.pipe.send(task)

    def answer(self) -> tuple[Any, Exception | None] | None:
        """Return the result or the error; None where the process has ended."""
        try:
            return self.pipe.recv()
        except (EOFError, OSError):
            return None


def parallel_map(
    function: Callable[[T], R],
    tasks: Sequence[T],
    processes: int,
    *,
    seconds: float | None = None,
    lost: Callable[[T], R] | None = None,
    start: Literal["spawn", "fork"] = "spawn",
) -> Iterator[tuple[T, R]]:
    """Yield each task with `function(task)` when it is done, in any order.

    When the loop over them is left, for whatever reason, the processes are ended.

    Args:
        function: Of a module; it is called in other processes.
        tasks: What pickles.
        seconds: How long a task may take until its process is ended; None waits.
        lost: What comes of a task whose process ended in the middle of it; another one goes on.
        start: How processes start: anew, or as copies of this one.

    Raises:
        WorkerLostError: If a process ends in the middle of its work, and `lost` is not given.
    """
    left = list(reversed(tasks))
    idle: list[_Worker] = []
    busy: dict[Any, _Worker] = {}

    def hand_out() -> None:
        while left and len(busy) < processes:
            worker = idle.pop() if idle else _started(function, start)
            busy[worker.pipe] = worker
            worker.take(left.pop())

    try:
        hand_out()
        while busy:
            ready: list[Any] = wait(list(busy), timeout=None if seconds is None else 1.0)
            late = (
                []
                if seconds is None
                else [p for p, worker in busy.items() if time.monotonic() - worker.since > seconds]
            )
            done: list[tuple[T, R]] = []
            for pipe in dict.fromkeys((*ready, *late)):
                worker = busy.pop(pipe)
                answer = worker.answer() if pipe in ready else None
                if answer is None:
                    _end([worker])
                    if lost is None:
                        raise WorkerLostError
                    done.append((worker.task, lost(worker.task)))
                    continue
                idle.append(worker)
                result, error = answer
                if error is not None:
                    raise error
                done.append((worker.task, result))
            hand_out()
            yield from done
    finally:
        _end([*idle, *busy.values()])


def _started(function: Callable[[Any], Any], start: str) -> _Worker:
    context: Any = multiprocessing.get_context(start)
    ours, theirs = context.Pipe()
    process = context.Process(target=_work, args=(theirs, function), daemon=True)
    with _undisturbed():
        process.start()
    theirs.close()  # so that ours ends when the worker does
    return _Worker(process, ours)


def _end(workers: Sequence[_Worker]) -> None:
    for worker in workers:
        worker.process.terminate()
    until = time.monotonic() + 1.0
    for worker in workers:
        worker.process.join(max(0.0, until - time.monotonic()))
        worker.process.kill()
        worker.process.join()
        worker.pipe.close()


def _work(pipe: Connection, function: Callable[[Any], Any]) -> None:
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl+C is for the process that shares out
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))  # what a task has open is closed
    threading.Thread(target=_end_with_parent, daemon=True).start()
    _be_quiet()
    with contextlib.suppress(EOFError, OSError):  # nobody waits any more
        while True:
            task = pipe.recv()
            try:
                answer = function(task), None
            except Exception as error:
                answer = None, error
            pipe.send(answer)


def _end_with_parent() -> None:
    parent = multiprocessing.parent_process()
    if parent is not None:
        parent.join()  # also when it was killed: the system closes a pipe that only it holds
        os._exit(1)


def _be_quiet() -> None:
    """Say nothing on the caller's standard output, and do not hold it open."""
    silent = os.open(os.devnull, os.O_WRONLY)
    os.dup2(silent, 1)
    os.close(silent)
    sys.stdout = open(1, "w", closefd=False)  # noqa: SIM115


@contextlib.contextmanager
def _undisturbed() -> Iterator[None]:
    """Let a process that starts in this block be born deaf to Ctrl+C."""
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)
