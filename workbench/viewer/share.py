"""The part of one server among several that stand behind one port: connections are handed to it, it tells of its pages."""

import asyncio
import contextlib
import functools
import socket
import threading
from typing import Any

import uvicorn


class Share:
    """What one of several servers has of the whole.

    Args:
        number: Which of them it is; the tokens of its pages begin with it.
        channel: Connections come through it, and how many pages are open goes back; it ends with the whole.
        port: Where the whole listens.
        token: What others than those on this machine bring.
    """

    def __init__(self, number: int, channel: socket.socket, port: int, token: str | None):
        self.number, self.port, self.token = number, port, token
        self.ended = threading.Event()
        self._channel = channel
        self._coming: set[asyncio.Task] = set()
        channel.setblocking(False)

    def begin(self, server: uvicorn.Server) -> None:
        """Take connections from now on; called on the server's event loop."""
        self._server, self._loop = server, asyncio.get_running_loop()
        self._loop.add_reader(self._channel, self._take)
        self.tell(0)

    def tell(self, pages: int) -> None:
        """Tell how many pages are open."""
        with contextlib.suppress(OSError):  # the next number is told soon
            self._channel.send(str(pages).encode())

    def _take(self) -> None:
        try:
            said, files, _, _ = socket.recv_fds(self._channel, 16, 4)
        except BlockingIOError:
            return
        except OSError:
            said, files = b"", []
        if not said:
            self._loop.remove_reader(self._channel)
            self.ended.set()
        for file in files:
            task = self._loop.create_task(self._accept(socket.socket(fileno=file)))
            self._coming.add(task)
            task.add_done_callback(self._coming.discard)

    async def _accept(self, connection: socket.socket) -> None:
        """Go on with a connection as uvicorn does with those that it accepts itself."""
        connection.setblocking(False)
        server = self._server
        make: Any = server.config.http_protocol_class
        make = functools.partial(
            make, config=server.config, server_state=server.server_state, app_state=server.lifespan.state
        )
        try:
            await self._loop.connect_accepted_socket(make, connection)
        except OSError:  # it has gone
            connection.close()
