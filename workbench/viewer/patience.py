"""How long the server waits for a browser: connections that say nothing or take nothing are closed
after a while.
"""

import asyncio
import contextlib
import sys
from typing import Any

import uvicorn
from uvicorn.protocols.http.h11_impl import H11Protocol

PATIENCE = 20.0
"""Seconds that a connection may say nothing before its request, or take nothing of what it is sent.
"""
LOOK = 2.0
FILES = 8192


class Patience:
    """Closes connections that wait too long, and says in one line what an event loop would say in a
    hundred.

    Args:
        server: Whose connections these are.
        seconds: How long it waits.
    """

    def __init__(self, server: uvicorn.Server, seconds: float = PATIENCE):
        self._server, self._seconds = server, seconds
        self._since: dict[Any, tuple[Any, float]] = {}
        self._said = 0.0

    async def keep(self) -> None:
        """Look at the connections now and then, for ever."""
        asyncio.get_running_loop().set_exception_handler(self._say)
        while True:
            await asyncio.sleep(min(LOOK, self._seconds / 2))
            self.look(asyncio.get_running_loop().time())

    def look(self, clock: float) -> None:
        """Close what has waited too long."""
        connections = list(self._server.server_state.connections)
        self._since = {
            connection: self._since.get(connection, (None, clock)) for connection in connections
        }
        for connection in connections:
            state = _waits_for(connection)
            since = self._since[connection][1]
            if state is None or state != self._since[connection][0]:
                self._since[connection] = state, clock
            elif clock - since >= self._seconds:
                connection.transport.abort()

    def _say(self, loop: asyncio.AbstractEventLoop, context: dict[str, Any]) -> None:
        error = context.get("exception")
        if isinstance(error, ConnectionError) or loop.time() - self._said < 1.0:
            return
        self._said = loop.time()
        sys.stderr.write(f"workbench: {context.get('message', 'trouble')}: {error!r}\n")


def _waits_for(connection: Any) -> Any:
    """Return what a connection waits for, equal as long as nothing comes of it; None where it waits
    for nothing.
    """
    unsent = connection.transport.get_write_buffer_size()
    if unsent:
        return "reader", unsent
    if isinstance(connection, H11Protocol):
        idle = connection.cycle is None or connection.cycle.response_complete
        return "request" if idle else None
    return None if getattr(connection, "handshake_complete", True) else "handshake"


def more_files() -> None:
    """Let this process open as many files as it may, up to what a large class needs: each page has
    a socket or two.
    """
    with contextlib.suppress(ImportError, ValueError, OSError):  # not on every machine
        import resource

        soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
        wanted = FILES if hard == resource.RLIM_INFINITY else min(FILES, hard)
        if soft != resource.RLIM_INFINITY and soft < wanted:
            resource.setrlimit(resource.RLIMIT_NOFILE, (wanted, hard))
