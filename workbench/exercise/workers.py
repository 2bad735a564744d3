"""Work in other processes of this machine, each of which may die or hang at its own cost; with this one, all end."""

import contextlib
import ctypes
import multiprocessing
import os
import signal
import sys
import time
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from multiprocessing.connection import Connection, wait
from multiprocessing.process import BaseProcess
from typing import Any

LONGEST_SECONDS = 900.0
"""How long one piece of work may take: far beyond what its own limits allow."""
PR_SET_PDEATHSIG = 1


@dataclass
class _Worker:
    process: BaseProcess
    pipe: Connection
    doing: str | None = None
    since: float = 0.0


def worked(work: Callable[..., Any], waiting: Mapping[str, tuple[Any, ...]], count: int) -> Iterator[tuple[str, Any]]:
    """Yield the name and the result of each piece of work, as they come; None where its process died or hung.

    When the loop over them is left, for whatever reason, the processes are ended.

    Args:
        work: Called with the arguments in a process.
        waiting: Arguments by name.
        count: How many processes there are.
    """
    left = list(waiting.items())
    workers: list[_Worker] = []
    try:
        while left or any(worker.doing is not None for worker in workers):
            while left and len(workers) < count:
                workers.append(_started(work))
            for worker in workers:
                if worker.doing is None and left:
                    worker.doing, arguments = left.pop(0)
                    worker.since = time.monotonic()
                    with contextlib.suppress(OSError):  # it has died; that is seen below
                        worker.pipe.send(arguments)
            ready = wait([worker.pipe for worker in workers], timeout=1.0)
            for worker in list(workers):
                name, late = worker.doing, time.monotonic() - worker.since > LONGEST_SECONDS
                if name is None or (worker.pipe not in ready and not late):
                    continue
                try:
                    if late:
                        raise EOFError
                    result = worker.pipe.recv()
                except (EOFError, OSError):
                    workers.remove(worker)
                    _end([worker])
                    result = None
                worker.doing = None
                yield name, result
    finally:
        _end(workers)


def _started(work: Callable[..., Any]) -> _Worker:
    ours, theirs = multiprocessing.Pipe()
    process = multiprocessing.Process(target=_serve, args=(theirs, work, os.getpid()), daemon=True)
    process.start()
    theirs.close()
    return _Worker(process, ours)


def _serve(pipe: Connection, work: Callable[..., Any], parent: int) -> None:
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # whoever started us ends us
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))
    if sys.platform == "linux":
        ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGKILL)
        if multiprocessing.get_start_method() == "fork" and os.getppid() != parent:
            return
    with contextlib.suppress(EOFError, OSError):
        while True:
            pipe.send(work(*pipe.recv()))


def _end(workers: list[_Worker]) -> None:
    for worker in workers:
        worker.process.terminate()
    until = time.monotonic() + 1.0
    for worker in workers:
        worker.process.join(max(0.0, until - time.monotonic()))
        if worker.process.is_alive():
            worker.process.kill()
            worker.process.join()
        worker.pipe.close()
