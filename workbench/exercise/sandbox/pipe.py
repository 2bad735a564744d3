"""Messages to a student's process and back, each within its time; whatever comes is read as bytes of somebody else."""

import os
import select
import time
from typing import Any

from workbench.exercise.inside.wire import WireError, lengths, pack, unpack


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

    def ask(self, message: dict[str, Any], seconds: float) -> dict[str, Any]:
        """Send a message and return the answer.

        Raises:
            WireError: If what came is no message.
            TimeoutError: If it took longer than `seconds`.
            OSError: If the process is gone.
        """
        deadline = time.monotonic() + seconds
        self._send(pack(message), deadline)
        header, payload = lengths(self._receive(16, deadline))
        return unpack(self._receive(header, deadline), self._receive(payload, deadline))

    def _send(self, data: bytes, deadline: float) -> None:
        rest = memoryview(data)
        while rest:
            self._wait([], [self._to], deadline)
            rest = rest[os.write(self._to, rest[: 1 << 16]) :]

    def _receive(self, count: int, deadline: float) -> bytes:
        parts = []
        while count:
            self._wait([self._from], [], deadline)
            part = os.read(self._from, min(count, 1 << 20))
            if not part:
                raise ConnectionResetError("the process is gone")
            parts.append(part)
            count -= len(part)
        return b"".join(parts)

    def _wait(self, reading: list[int], writing: list[int], deadline: float) -> None:
        left = deadline - time.monotonic()
        if left <= 0 or not any(select.select(reading, writing, [], left)):
            raise TimeoutError


__all__ = ["Pipe", "WireError"]
