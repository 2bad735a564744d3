"""Messages to a student's process and back, each in its time, read as foreign bytes."""

import os
import select
import time
from collections.abc import Callable
from typing import Any

from workbench.exercise.child.wire import WireError, lengths, pack, unpack

MOST_TIMES = 10.0
"""How many times as long a busy machine may make anything take."""


class _Deadline:
    """Moves on by what a process waits for a processor."""

    def __init__(self, seconds: float, lost: Callable[[], float]):
        self._seconds, self._lost = seconds, lost
        self._began = time.monotonic()

    def left(self) -> float:
        """Return the seconds that are left."""
        left = self._seconds - (time.monotonic() - self._began)
        return left if left > 0 else left + min(self._lost(), (MOST_TIMES - 1) * self._seconds)


class Pipe:
    """The grader's ends of two pipes; the other ends are descriptors for the process to inherit.

    Attributes:
        theirs: Where the process reads and where it writes; `inherited` closes them here.
    """

    def __init__(self) -> None:
        to_process, self._to = os.pipe()
        self._from, from_process = os.pipe()
        self.theirs = (to_process, from_process)
        os.set_blocking(self._to, False)
        os.set_blocking(self._from, False)

    def inherited(self) -> None:
        """Close the process's ends here: when the process is gone, reading ends."""
        for end in self.theirs:
            os.close(end)

    def close(self) -> None:
        """Close our ends."""
        os.close(self._to)
        os.close(self._from)

    def ask(
        self, message: dict[str, Any], seconds: float, lost: Callable[[], float] = lambda: 0.0
    ) -> dict[str, Any]:
        """Send a message and return the answer, waited for `seconds`.

        What `lost` says, the seconds that the process has waited for a processor since it was
        asked, is not its own time.

        Raises:
            WireError: If what came is no message.
            TimeoutError: If it took longer than `seconds`.
            OSError: If the process is gone.
        """
        deadline = _Deadline(seconds, lost)
        self._send(pack(message), deadline)
        header, payload = lengths(self._receive(16, deadline))
        return unpack(self._receive(header, deadline), self._receive(payload, deadline))

    def _send(self, data: bytes, deadline: _Deadline) -> None:
        rest = memoryview(data)
        while rest:
            self._wait([], [self._to], deadline)
            rest = rest[os.write(self._to, rest[: 1 << 16]) :]

    def _receive(self, count: int, deadline: _Deadline) -> bytes:
        parts = []
        while count:
            self._wait([self._from], [], deadline)
            part = os.read(self._from, min(count, 1 << 20))
            if not part:
                raise ConnectionResetError("the process is gone")
            parts.append(part)
            count -= len(part)
        return b"".join(parts)

    def _wait(self, reading: list[int], writing: list[int], deadline: _Deadline) -> None:
        while not any(select.select(reading, writing, [], max(0.0, deadline.left()))):
            if deadline.left() <= 0:
                raise TimeoutError


__all__ = ["Pipe", "WireError"]
