"""Processes that share out work. They end with it, and with the process that started them, however that ends."""

import multiprocessing
import os
import signal
import sys
import threading
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from multiprocessing.connection import Connection, wait
from typing import Any, TypeVar

T = TypeVar("T")
R = TypeVar("R")


class WorkerLostError(Exception):
    """A process that worked was ended from outside."""


def shared_out(function: Callable[[T], R], tasks: Sequence[T], processes: int) -> Iterator[tuple[T, R]]:
    """Return each task with `function(task)` when it is done, in any order; an exception is raised here.

    Args:
        function: Of a module; it is called in other processes.
        tasks: What pickles.
        processes: How many work at the same time.

    Raises:
        WorkerLostError: If a process ends in the middle of its work.
    """
    context = multiprocessing.get_context("spawn")
    left = list(reversed(tasks))
    busy: dict[Any, T] = {}
    workers = []
    try:
        for _ in range(min(processes, len(tasks))):
            ours, theirs = context.Pipe()
            worker = context.Process(target=_work, args=(theirs, function), daemon=True)
            with _undisturbed():
                worker.start()
            workers.append(worker)
            theirs.close()  # so that ours ends when the worker does
            busy[ours] = left.pop()
            ours.send(busy[ours])
        while busy:
            ready: list[Any] = wait(list(busy))
            for ours in ready:
                task = busy.pop(ours)
                try:
                    result, error = ours.recv()
                except (EOFError, OSError):
                    raise WorkerLostError from None
                if error is not None:
                    raise error
                if left:
                    busy[ours] = left.pop()
                    ours.send(busy[ours])
                yield task, result
    finally:
        for worker in workers:
            worker.kill()
        for worker in workers:
            worker.join()


def _work(pipe: Connection, function: Callable[[Any], Any]) -> None:
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl+C is for the process that shares out
    threading.Thread(target=_end_with_parent, daemon=True).start()
    _be_quiet()
    while True:
        try:
            task = pipe.recv()
        except EOFError:
            return
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


@contextmanager
def _undisturbed() -> Iterator[None]:
    """Let a process that starts in this block be born deaf to Ctrl+C, until it can ignore it itself."""
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)
