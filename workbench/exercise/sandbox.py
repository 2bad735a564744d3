"""Runs a student's function in a child process with limits; what comes back is plain values or a reason.

The threat model: accidents and simple cheating. The child has a clean environment, an empty working folder, bounds on
memory, time, files and output, and an audit hook (`child.py`). For marks against determined cheating, run the grader
inside a container without network.
"""

import contextlib
import os
import secrets
import select
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path
from typing import Any

from workbench.errors import InputError
from workbench.exercise.wire import MOST_BYTES, WireError, lengths, pack, unpack

MEGABYTES = 2048
START_SECONDS = 30.0
CHILD = Path(__file__).with_name("child.py")


class StudentError(InputError):
    """The student's function gave no result; the message says what happened and where in the student's file.

    Args:
        message: One line for the student.
        kind: `raised`, `timeout`, `died`, `result` (what came back is no value) or `load`.
        error: The name of the exception that was raised, if one was.
        line: The student's own line, 0 where it is not known.
    """

    def __init__(self, message: str, kind: str, error: str = "", line: int = 0):
        super().__init__(message)
        self.kind, self.error, self.line = kind, error, line


class Student:
    """A student's function, callable; every call crosses to a child process, which is started when it is needed.

    Args:
        path: The student's file.
        name: The function's name in it.
        seconds: The longest one call may take, wall time; the process is killed then.
        megabytes: Address space of the child.

    Raises:
        InputError: If the file cannot be read.
    """

    def __init__(self, path: Path, name: str, *, seconds: float = 5.0, megabytes: int = MEGABYTES):
        try:
            self.source = path.read_text(encoding="utf-8")
        except (OSError, UnicodeDecodeError) as error:
            raise InputError(
                f"{path}: cannot be read as text ({getattr(error, 'strerror', None) or 'not UTF-8'})"
            ) from None
        self.path, self.name, self.__name__ = path, name, name
        self.changed_inputs = False  # whether the last call changed what it was given
        self._seconds, self._megabytes = seconds, megabytes
        self._lock = threading.Lock()  # one call at a time: several runs may share a function
        self._process: subprocess.Popen | None = None
        self._folder: str | None = None

    def __call__(self, *args: Any, **options: Any) -> Any:
        """Return what the student's function returns for these arguments, as plain values.

        Raises:
            StudentError: If it raised, took too long, ended its process, or returned what is no value.
        """
        with self._lock:
            if self._process is None or self._process.poll() is not None:
                self.start()
            reply = self._ask({"do": "call", "args": list(args), "options": list(options.items())}, self._seconds)
            self.changed_inputs = bool(reply.get("changed"))
            return reply.get("value")

    def start(self) -> None:
        """Start the child and load the student's file.

        Raises:
            StudentError: If the file does not load or lacks the function.
        """
        self.close()
        self._folder = tempfile.mkdtemp(prefix="exercise-")
        to_child, self._to = os.pipe()
        self._from, from_child = os.pipe()
        cpu_seconds = str(int(60 + 20 * self._seconds))
        python = [
            sys.executable,
            "-I",
            "-B",
            "-u",  # what was printed can be read while the process lives
            "-W",
            "ignore::RuntimeWarning",
        ]  # numpy's are not what the student printed
        command = [*python, str(CHILD), str(to_child), str(from_child), self._folder]
        environment = {"PATH": "/usr/bin:/bin", "HOME": self._folder, "LANG": "C.UTF-8"}
        environment |= {f"{library}_NUM_THREADS": "1" for library in ("OPENBLAS", "OMP", "MKL")}
        with open(os.path.join(self._folder, "printed.txt"), "wb") as printed:
            self._process = subprocess.Popen(
                [*command, str(self._megabytes), cpu_seconds],
                stdin=subprocess.DEVNULL,
                stdout=printed,
                stderr=printed,
                pass_fds=(to_child, from_child),
                cwd=self._folder,
                env=environment,
                start_new_session=True,
            )
        os.close(to_child)
        os.close(from_child)
        os.set_blocking(self._to, False)
        os.set_blocking(self._from, False)
        self._ask({"do": "load", "source": self.source, "name": self.name}, START_SECONDS)

    def printed(self, most: int = 2000) -> str:
        """Return the end of what the student's code printed since the child was started."""
        if self._folder is None:
            return ""
        try:
            with open(os.path.join(self._folder, "printed.txt"), "rb") as printed:
                printed.seek(max(0, os.fstat(printed.fileno()).st_size - most))
                return printed.read(most).decode("utf-8", "replace")
        except OSError:
            return ""

    def close(self) -> None:
        """End the child and everything it started, and remove its folder."""
        process, self._process = self._process, None
        if process is not None:
            with contextlib.suppress(ProcessLookupError):
                os.killpg(process.pid, signal.SIGKILL)
            process.wait()
            os.close(self._to)
            os.close(self._from)
        if self._folder is not None:
            shutil.rmtree(self._folder, ignore_errors=True)
            self._folder = None

    def __enter__(self) -> "Student":
        """Return itself; leaving the block ends the child."""
        return self

    def __exit__(self, *error: object) -> None:
        """End the child."""
        self.close()

    # the pipe -------------------------------------------------------------------------------------------------------

    def _ask(self, request: dict[str, Any], seconds: float) -> dict[str, Any]:
        nonce = secrets.token_hex(8)
        deadline = time.monotonic() + seconds
        try:
            self._send(pack(request | {"nonce": nonce, "file": self.path.name}), deadline)
            header, payload = lengths(self._receive(16, deadline))
            reply = unpack(self._receive(header, deadline), self._receive(payload, deadline))
        except WireError as error:
            self.close()
            raise StudentError(f"{self.name}: what came back is no result ({error})", "result") from None
        except (TimeoutError, OSError) as error:
            raise self._lost(error, seconds) from None
        if reply.get("nonce") != nonce:
            self.close()
            raise StudentError(f"{self.name}: something else than the result was written to the grader", "result")
        if "error" in reply:
            raise self._raised(reply, loading=request["do"] == "load")
        return reply

    def _raised(self, reply: dict[str, Any], loading: bool) -> StudentError:
        error, said, line = str(reply["error"])[:80], str(reply.get("message", ""))[:500], reply.get("line")
        line = line if isinstance(line, int) and not isinstance(line, bool) else 0
        where = f"{self.path.name}, line {line}: " if line else f"{self.path.name}: "
        if loading:
            self.close()
            return StudentError(f"{where}the file does not load: {error}: {said}", "load", error, line)
        if error == "WireError":
            return StudentError(f"{where}{self.name} returned what is no result: {said}", "result", "", line)
        if error == "NotImplementedError":
            return StudentError(f"{where}{self.name} is not written yet", "raised", error, line)
        return StudentError(f"{where}{self.name} raised {error}" + (f": {said}" if said else ""), "raised", error, line)

    def _lost(self, error: OSError, seconds: float) -> StudentError:
        process = self._process
        self.close()
        if isinstance(error, TimeoutError):
            return StudentError(
                f"{self.name} took more than {seconds:g} s and was stopped: is there an endless loop?", "timeout"
            )
        code = process.returncode if process is not None else None
        how = {-signal.SIGKILL: "was killed: too much memory?", -signal.SIGXCPU: "used too much processor time"}.get(
            code or 0, f"ended (exit code {code}): does it call exit, or crash a library?"
        )
        return StudentError(f"{self.name}: its process {how}", "died")

    def _send(self, data: bytes, deadline: float) -> None:
        rest = memoryview(data)
        while rest:
            self._wait([], [self._to], deadline)
            rest = rest[os.write(self._to, rest[: 1 << 20]) :]

    def _receive(self, count: int, deadline: float) -> bytes:
        if count > MOST_BYTES:
            raise WireError("too long")
        parts = []
        while count:
            self._wait([self._from], [], deadline)
            part = os.read(self._from, min(count, 1 << 20))
            if not part:
                raise ConnectionResetError("the child is gone")
            parts.append(part)
            count -= len(part)
        return b"".join(parts)

    def _wait(self, reading: list[int], writing: list[int], deadline: float) -> None:
        left = deadline - time.monotonic()
        if left <= 0 or not any(select.select(reading, writing, [], left)):
            raise TimeoutError
