"""How fast a page may speak."""

import asyncio

FIRST_WORD = 20.0
"""Seconds until a socket that has said nothing is closed."""


class Pace:
    """Slows a sender down to so many messages a second, a tenth of a second's worth at once."""

    def __init__(self, most: int):
        self._most = max(1, most // 10)
        self._count = 0
        self._since = 0.0

    async def step(self) -> None:
        """Wait until one more may come."""
        clock = asyncio.get_running_loop().time()
        if clock - self._since >= 0.1:
            self._since = clock
            self._count = 0
        self._count += 1
        if self._count >= self._most:
            await asyncio.sleep(self._since + 0.1 - clock)
