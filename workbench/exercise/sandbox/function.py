"""A student's function as the grader calls it: every call crosses to a process that is shut in."""

import contextlib
import os
import secrets
import signal
import subprocess
import tempfile
import threading
import time
from collections.abc import Iterator
from pathlib import Path
from typing import IO, Any

from workbench.exercise.child.wire import WireError
from workbench.exercise.sandbox.budget import CallBudget
from workbench.exercise.sandbox.isolation import START_SECONDS, Wall, anonymous, best
from workbench.exercise.sandbox.pipe import Pipe
from workbench.exercise.sandbox.waiting import waited
from workbench.exercise.student import StudentError, StudentFunction
from workbench.exercise.submission import Submission, read_submission

MEGABYTES = 2048
LOAD_SECONDS = 10.0
"""How long a file may take to load."""
SHORT = 0.02
"""Seconds of a call up to which it is not asked how much of them the process waited."""


@contextlib.contextmanager
def removed_folder() -> Iterator[str]:
    """Yield a folder to start a process in, which stays in it although it is no more: it takes no
    files, and none stays behind.

    On Linux it is gone before the process starts, so that whatever ends this one leaves nothing.
    """
    folder = tempfile.mkdtemp(prefix="exercise-")
    if not os.path.isdir("/proc/self/fd"):
        try:
            yield folder
        finally:
            os.rmdir(folder)
        return
    try:
        opened = os.open(folder, os.O_RDONLY)
    finally:
        os.rmdir(folder)
    try:
        yield f"/proc/self/fd/{opened}"
    finally:
        os.close(opened)


class SandboxedFunction(StudentFunction):
    """A student's function; every call crosses to a process of its own, started when it is needed.

    Args:
        given: The student's file, or what was read of it.
        seconds: The longest one call may take, wall time; the process is killed then.
        megabytes: Address space of the process.
        wall: What shuts it in; the best of this machine by default.
        budget: How long all its calls are waited for; None waits `seconds` for each.

    Raises:
        InputError: If the file cannot be read.
    """

    def __init__(
        self,
        given: Path | Submission,
        name: str,
        *,
        seconds: float = 5.0,
        megabytes: int = MEGABYTES,
        wall: Wall | None = None,
        budget: CallBudget | None = None,
    ):
        super().__init__(given if isinstance(given, Submission) else read_submission(given), name)
        self.wall: Wall = best() if wall is None else wall
        self._seconds, self._megabytes = seconds, megabytes
        self._budget = budget
        self._lock = threading.Lock()  # one call at a time: several runs may share a function
        self._process: subprocess.Popen | None = None
        self._pipe: Pipe | None = None
        self._printed: IO[bytes] | None = None
        self._closed = False
        self._waited = 0.0  # seconds for a processor, when the process was last asked

    def __call__(self, *args: Any, **options: Any) -> Any:
        """Return what the student's function returns for these arguments, as plain values.

        Raises:
            StudentError: If it raised, took too long, ended its process, or returned no value.
        """
        with self._lock:
            if self._budget is not None and self._budget.over:
                raise StudentError(
                    f"{self.name} was not called: {self._budget.over}", self._budget.kind
                )
            if self._process is None or self._process.poll() is not None:
                self.start()
            reply = self._called(
                {"do": "call", "args": list(args), "options": list(options.items())}
            )
            self.changed_inputs = reply.get("changed") is True
            return reply.get("value")

    def _called(self, request: dict[str, Any]) -> dict[str, Any]:
        seconds = self._budget.seconds if self._budget else self._seconds
        how = ""
        began = time.monotonic()
        try:
            return self._ask(request, seconds)
        except StudentError as error:
            how = error.kind
            raise
        finally:
            if self._budget is not None:
                took = time.monotonic() - began
                self._budget.took(took if took < SHORT else took - self._lost(), how)

    def start(self) -> None:
        """Start the process and load the student's file.

        Raises:
            StudentError: If the file does not load or lacks the function, or all was closed.
        """
        self._end()
        self._must_be_open()
        self._pipe = Pipe()
        self._printed = self._printed or anonymous()
        pipe_in, pipe_out = self._pipe.theirs
        try:
            with contextlib.nullcontext("/") if self.wall.holds else removed_folder() as folder:
                self._process = self.wall.start(
                    pipe_in=pipe_in,
                    pipe_out=pipe_out,
                    printed=self._printed,
                    folder=folder,
                    megabytes=self._megabytes,
                    cpu_seconds=int(60 + 20 * self._seconds),
                )
        finally:
            self._pipe.inherited()
        if self._closed:  # by another thread just now: nobody would end the process
            self.close()
        self._must_be_open()
        self._ask({"do": "start"}, START_SECONDS)
        modules = [list(pair) for pair in self.submission.modules.items()]
        self._ask(
            {"do": "load", "source": self.source, "name": self.name, "modules": modules},
            LOAD_SECONDS,
        )

    def printed(self, most: int = 8000) -> str:
        """Return the beginning of what the student's code printed."""
        try:
            return (
                ""
                if self._printed is None
                else os.pread(self._printed.fileno(), most, 0).decode("utf-8", "replace")
            )
        except (ValueError, AttributeError):  # another thread closed it just now
            return ""

    def close(self) -> None:
        """End the process and all it started; a run that goes on cannot restart it."""
        self._closed = True
        self._end()
        if self._printed is not None:
            self._printed.close()
            self._printed = None

    def _must_be_open(self) -> None:
        if self._closed:
            raise StudentError(f"{self.name} was not called: its file is no longer in use", "died")

    def __enter__(self) -> "SandboxedFunction":
        """Return itself; leaving the block ends the process."""
        return self

    def __exit__(self, *error: object) -> None:
        """End the process."""
        self.close()

    def _end(self) -> int | None:
        """End the process; its exit code, where it ended by itself."""
        process = self._process
        self._process = None
        pipe = self._pipe
        self._pipe = None
        code = None
        if process is not None:
            code = process.poll()
            with contextlib.suppress(ProcessLookupError):
                os.killpg(process.pid, signal.SIGKILL)
            process.wait()
        if pipe is not None:
            pipe.close()
        return code

    def _ask(self, request: dict[str, Any], seconds: float) -> dict[str, Any]:
        assert self._pipe is not None
        nonce = secrets.token_hex(8)
        self._waited = self._waiting()
        try:
            reply = self._pipe.ask(
                request | {"nonce": nonce, "file": self.submission.file}, seconds, self._lost
            )
        except WireError as error:
            self._end()
            raise StudentError(
                f"{self.name}: what came back is no result ({error})", "result"
            ) from None
        except TimeoutError:
            self._end()
            raise self._too_long(request["do"], seconds) from None
        except OSError:
            raise self._gone(request["do"]) from None
        if reply.get("nonce") != nonce:
            self._end()
            raise StudentError(
                f"{self.name}: something else than the result was written to the grader", "result"
            )
        if "error" in reply:
            loading = request["do"] == "load"
            if loading:
                self._end()
            raise self.raised(reply, loading=loading)
        return reply

    def _lost(self) -> float:
        """Return how long the process has waited for a processor since it was asked: not its
        fault.
        """
        return max(0.0, self._waiting() - self._waited)

    def _waiting(self) -> float:
        return 0.0 if self._process is None else waited(self._process.pid)

    def _too_long(self, doing: str, seconds: float) -> StudentError:
        if doing == "start":
            return StudentError(
                f"Python did not start within {seconds:g} s: is this machine too busy?", "died"
            )
        task = self.name if doing == "call" else f"{self.submission.file}: loading the file"
        return StudentError(
            f"{task} took more than {seconds:g} s, the limit, and was stopped: an endless loop, or"
            " too slow?",
            "timeout",
        )

    def _gone(self, doing: str) -> StudentError:
        process = self._process
        if process is not None:
            with contextlib.suppress(subprocess.TimeoutExpired):
                # its pipe is closed: it is about to end, and its exit code tells why
                process.wait(2.0)
        code = self._end()
        if doing == "start":
            return StudentError(
                f"Python did not start: {self.printed().strip()[-200:] or f'exit code {code}'}",
                "died",
            )
        number = None
        if code is not None:
            # bubblewrap says 128 and the signal
            number = -code if code < 0 else code - 128
        how = f"ended (exit code {code}): does it call exit, or crash a library?"
        if number in (signal.SIGKILL, signal.SIGXCPU):
            how = "was killed: too much memory, or processor time?"
        return StudentError(f"{self.name}: its process {how}", "died")
