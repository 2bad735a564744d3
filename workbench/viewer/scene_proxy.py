"""Hands a scene through between a browser and viser: all that viser sends, and of what comes in what a scene needs.

viser lets in nobody but this proxy (`workbench.viewer.inner`), and trusts what it is sent: it would keep forms, take files
and open a public tunnel. So a browser's messages are read here, and those of the few kinds that turn, click or drag a
scene are written anew.
"""

import asyncio
import contextlib
import math
from collections.abc import AsyncIterator, Iterator
from typing import Any, Literal

import httpx
import msgspec
import websockets
from starlette.requests import Request
from starlette.responses import Response
from starlette.websockets import WebSocket, WebSocketDisconnect

from workbench.viewer.inner import Inner

Vector = tuple[float, float, float]
Quaternion = tuple[float, float, float, float]
Name = str
MOST_A_SECOND = 300
"""Messages of a browser's scene; what is more waits."""
FIRST_WORD = 20.0
"""Seconds until a socket that has said nothing is closed."""


class _Camera(msgspec.Struct, tag="ViewerCameraMessage"):
    wxyz: Quaternion
    position: Vector
    fov: float
    near: float
    far: float
    image_height: int
    image_width: int
    look_at: Vector
    up_direction: Vector


class _Pointer(msgspec.Struct, tag="ScenePointerMessage"):
    event_type: Literal["click", "rect-select"]
    ray_origin: Vector | None
    ray_direction: Vector | None
    screen_pos: tuple[tuple[float, float], ...]
    modifier: str | None = None


class _Dragged(msgspec.Struct, tag="TransformControlsUpdateMessage"):
    name: Name
    wxyz: Quaternion
    position: Vector
    owner: str = ""


class _DragStart(msgspec.Struct, tag="TransformControlsDragStartMessage"):
    name: Name
    owner: str = ""


class _DragEnd(msgspec.Struct, tag="TransformControlsDragEndMessage"):
    name: Name
    owner: str = ""


_DECODER = msgspec.msgpack.Decoder(_Camera | _Pointer | _Dragged | _DragStart | _DragEnd)
_ENCODER = msgspec.msgpack.Encoder()
MOST_BYTES = 4000


def clean(frame: bytes) -> bytes | None:
    """Return a browser's frame as viser may get it, None where it is not one that a scene needs."""
    if len(frame) > MOST_BYTES:
        return None
    try:
        message = _DECODER.decode(frame)
    except (msgspec.MsgspecError, RecursionError, ValueError):
        return None
    return _ENCODER.encode(message) if all(math.isfinite(number) for number in _numbers(message)) else None


def _numbers(value: Any) -> Iterator[float]:
    if isinstance(value, float | int):
        yield value
    elif isinstance(value, tuple):
        for item in value:
            yield from _numbers(item)
    elif isinstance(value, msgspec.Struct):
        for name in value.__struct_fields__:
            yield from _numbers(getattr(value, name))


class SceneProxy:
    """Passes scenes through.

    Args:
        inner: viser.
    """

    def __init__(self, inner: Inner):
        self._inner = inner
        self._page: tuple[int, bytes, dict[str, str]] | None = None
        self.open = 0  # sockets

    @contextlib.asynccontextmanager
    async def running(self) -> AsyncIterator[None]:
        """Hold what is needed as long as the server runs."""
        async with httpx.AsyncClient(
            base_url=f"http://{self._inner.where}", headers=self._inner.key, trust_env=False
        ) as self._http:
            yield

    async def fetch(self) -> tuple[int, bytes, dict[str, str]]:
        """Return viser's client as it sends it: status, compressed body, headers; asked for once."""
        if self._page is None:
            asked = self._http.build_request("GET", "/", headers={"accept-encoding": "gzip"})
            answer = await self._http.send(asked, stream=True)
            body = b"".join([part async for part in answer.aiter_raw()])
            names = ("content-type", "content-encoding")
            self._page = answer.status_code, body, {n: answer.headers[n] for n in names if n in answer.headers}
        return self._page

    async def page(self, request: Request) -> Response:
        """Return viser's client, compressed where the browser can read that."""
        status, body, headers = await self.fetch()
        if headers.get("content-encoding") == "gzip" and "gzip" not in request.headers.get("accept-encoding", ""):
            import gzip

            body, headers = await asyncio.to_thread(gzip.decompress, body), {"content-type": headers["content-type"]}
        return Response(body, status, headers | {"cache-control": "no-cache"})

    async def socket(self, socket: WebSocket) -> None:
        """Pass on what viser and a browser tell each other, until one of them leaves."""
        self.open += 1
        try:
            await self._pass(socket)
        except (websockets.WebSocketException, WebSocketDisconnect, OSError, RuntimeError, TimeoutError):
            pass  # one of them has left
        finally:
            self.open -= 1

    async def _pass(self, socket: WebSocket) -> None:
        wanted = [websockets.Subprotocol(name) for name in socket.scope.get("subprotocols") or ()][:3]
        address = f"ws://{self._inner.where}/{socket.path_params['token']}"
        async with websockets.connect(
            address,
            additional_headers=self._inner.key,
            subprotocols=wanted or None,
            max_size=None,
            max_queue=2,
            compression=None,
            ping_interval=None,
            proxy=None,
        ) as inner:
            await socket.accept(inner.subprotocol)
            coming = asyncio.create_task(self._inwards(socket, inner))
            going = asyncio.create_task(self._outwards(inner, socket))
            done, left = await asyncio.wait((coming, going), return_when=asyncio.FIRST_COMPLETED)
            for task in left:
                task.cancel()
            await asyncio.gather(*done, *left, return_exceptions=True)
        with contextlib.suppress(RuntimeError):
            await socket.close()

    async def _inwards(self, socket: WebSocket, inner: Any) -> None:
        pace, said = Pace(MOST_A_SECOND), False
        while True:
            message = await asyncio.wait_for(socket.receive(), None if said else FIRST_WORD)
            if message["type"] == "websocket.disconnect":
                return
            frame = clean(message.get("bytes") or b"")
            if frame is not None:
                said = True
                await inner.send(frame)
            await pace.step()

    @staticmethod
    async def _outwards(inner: Any, socket: WebSocket) -> None:
        async for message in inner:
            await socket.send_bytes(message if isinstance(message, bytes) else message.encode())


class Pace:
    """Slows a sender down to so many messages a second, a tenth of a second's worth at once."""

    def __init__(self, most: int):
        self._most, self._count, self._since = max(1, most // 10), 0, 0.0

    async def step(self) -> None:
        """Wait until one more may come."""
        now = asyncio.get_running_loop().time()
        if now - self._since >= 0.1:
            self._since, self._count = now, 0
        self._count += 1
        if self._count >= self._most:
            await asyncio.sleep(self._since + 0.1 - now)
