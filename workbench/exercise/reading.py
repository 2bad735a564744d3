"""Has hand-ins read by a process with limits, so that none can stall the grader."""

import base64
import contextlib
import json
import os
import select
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

from workbench.errors import InputError

READING = Path(__file__).with_name("child") / "reading.py"
MOST_SECONDS = 30.0
"""How long a reply is waited for where the machine is busy; the process itself may compute for
three seconds a file.
"""
MOST_LOST = 3
"""After how many files that could not be read in that time no more of a student's are tried."""


class Reader:
    """Reads files in one process, started when it is needed, and anew after one that hangs."""

    def __init__(self) -> None:
        self._process: subprocess.Popen[bytes] | None = None
        self._lost = 0

    def __enter__(self) -> "Reader":
        """Return itself; leaving the block ends the process."""
        return self

    def __exit__(self, *error: object) -> None:
        """End the process."""
        self._end()

    def read(self, file: str, content: bytes) -> dict[str, Any]:
        """Return what `child.reading.read` finds in a file.

        Raises:
            InputError: If it is no text, or takes too long or too much memory to read; one line.
        """
        if self._lost >= MOST_LOST:
            raise InputError(
                f"{file}: not read, since {self._lost} other files took too long to read"
            )
        asked = (
            json.dumps({"file": file, "content": base64.b64encode(content).decode()}).encode()
            + b"\n"
        )
        try:
            reply = self._asked(asked)
        except (OSError, ValueError):  # it ended, or was ended; what it said is no whole line
            self._end()
            self._lost += 1
            raise InputError(
                f"{file}: takes too long or too much memory to read as Python"
            ) from None
        if "unreadable" in reply:
            raise InputError(reply["unreadable"])
        return reply

    def _asked(self, request: bytes) -> dict[str, Any]:
        if self._process is None:
            command = [sys.executable, "-I", "-S", "-B", "-W", "ignore", str(READING)]
            pipe, silent = subprocess.PIPE, subprocess.DEVNULL
            self._process = subprocess.Popen(
                command, stdin=pipe, stdout=pipe, stderr=silent, start_new_session=True
            )
            os.set_blocking(self._process.stdin.fileno(), False)  # type: ignore[union-attr]
        return json.loads(_answer(self._process, request, time.monotonic() + MOST_SECONDS))

    def _end(self) -> None:
        process = self._process
        self._process = None
        if process is not None:
            process.kill()
            process.wait()
            with contextlib.suppress(OSError):  # what was not sent is not wanted any more
                process.stdin.close()  # type: ignore[union-attr]
            process.stdout.close()  # type: ignore[union-attr]


def _answer(process: subprocess.Popen[bytes], request: bytes, until: float) -> bytes:
    """Send a line to a process and return the line that comes back.

    Raises:
        OSError: If the process is gone, or does not answer in time.
    """
    into, out = process.stdin.fileno(), process.stdout.fileno()  # type: ignore[union-attr]
    rest = memoryview(request)
    parts = list[bytes]()
    while not parts or not parts[-1].endswith(b"\n"):
        readable, writable, _ = select.select(
            [out], [into] if rest else [], [], max(0.0, until - time.monotonic())
        )
        if not readable and not writable:
            raise TimeoutError
        if writable:
            rest = rest[os.write(into, rest[: 1 << 16]) :]
        if readable:
            parts.append(os.read(out, 1 << 20))
            if not parts[-1]:
                raise ConnectionResetError("the process is gone")
    return b"".join(parts)
