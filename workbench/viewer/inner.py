"""viser, as the workbench uses it: on loopback, without its banner, and for nobody who does not know its key.

viser lets in whoever reaches its port, from any web page in a browser of this machine too, and keeps what it is sent for
whoever comes next. So each is made with a key of its own, and whatever comes without it is refused before viser sees it.
"""

import contextlib
import hmac
import http.client
import secrets
import threading
import unittest.mock
from collections.abc import Callable, Iterator
from typing import Any

import viser
import websockets.asyncio.server
from websockets.asyncio.server import ServerConnection
from websockets.http11 import Request, Response

from workbench.errors import InputError

HEADER = "X-Workbench-Key"
_making = threading.Lock()


class Inner:
    """A viser server that only this process talks to.

    Attributes:
        viser: The server.
        where: Host and port where it listens.
        key: The header without which it answers nothing but 403.

    Raises:
        InputError: If this version of viser cannot be closed to others.
    """

    def __init__(self) -> None:
        self.key = {HEADER: secrets.token_urlsafe(24)}
        with _making, _served_only(self.key[HEADER]), _silent():
            self.viser = viser.ViserServer(host="127.0.0.1", port=0, verbose=False)
        self.viser.request_share_url = lambda *args, **kwargs: None  # type: ignore[method-assign]
        self.where = f"127.0.0.1:{self.viser.get_port()}"
        if (self._answer({}), self._answer(self.key)) != (http.HTTPStatus.FORBIDDEN, http.HTTPStatus.NOT_FOUND):
            self.stop()
            raise InputError(f"viser {viser.__version__} cannot be closed to others: install viser 1.1.1")

    def stop(self) -> None:
        """Stop listening."""
        with _silent():
            self.viser.stop()

    def _answer(self, headers: dict[str, str]) -> int:
        """Return what is answered to who asks for a file that is not there."""
        with contextlib.closing(http.client.HTTPConnection(self.where, timeout=60)) as asked:
            asked.request("GET", "/none", headers=headers)
            return asked.getresponse().status


def _silent() -> Any:
    """Keep viser's banners to itself: in a notebook they would become part of the cell, with an address that dies."""
    return unittest.mock.patch("rich.print")


@contextlib.contextmanager
def _served_only(key: str) -> Iterator[None]:
    """Let whatever `websockets` begins to serve meanwhile answer only to whoever brings a key."""
    serve = websockets.asyncio.server.serve

    def serve_some(*args: Any, process_request: Callable[..., Any], **more: Any) -> Any:
        def answer(connection: ServerConnection, request: Request) -> Response | None:
            given = request.headers.get_all(HEADER)
            if len(given) == 1 and hmac.compare_digest(given[0].encode("ascii", "surrogateescape"), key.encode()):
                return process_request(connection, request)
            return connection.respond(http.HTTPStatus.FORBIDDEN, "Nobody but the workbench itself is let in here.\n")

        return serve(*args, process_request=answer, **more)

    websockets.asyncio.server.serve = serve_some  # type: ignore[assignment,misc]
    try:
        yield
    finally:
        websockets.asyncio.server.serve = serve
