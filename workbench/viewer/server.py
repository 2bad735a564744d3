"""The live home of the page: the only thing that listens where people can reach it. viser stands behind it, on loopback.

One port, one origin: `/` is the page, `/live` its websocket of JSON, `/scene/TOKEN/` is viser's client and its websocket,
handed through. The token ties a scene to the page that shows it; it is made here, and says nothing of anybody.
"""

import asyncio
import contextlib
import functools
import io
import secrets
import threading
from collections.abc import AsyncIterator, Mapping
from typing import Any

import httpx
import uvicorn
import viser
import websockets
from starlette.applications import Starlette
from starlette.requests import Request
from starlette.responses import FileResponse, HTMLResponse, PlainTextResponse, Response
from starlette.routing import Route, WebSocketRoute
from starlette.websockets import WebSocket, WebSocketDisconnect

from workbench import links
from workbench.errors import InputError
from workbench.lesson import Lesson, catalog
from workbench.page.article import article_html
from workbench.page.document import SCRIPTS, STATIC, STYLES, lesson_document
from workbench.timeline import Timelines
from workbench.typeset import math_font_css
from workbench.viewer.student import Student

FILES = (*STYLES, "live.js", *SCRIPTS)
LONGEST = 20_000  # characters of a message from a browser


class Server:
    """A running server.

    Args:
        start: Where browsers begin whose address names no lesson; None is the first lesson.
        host, port: Where it listens; port 0 picks a free one.
    """

    def __init__(self, start: links.Place | None = None, *, host: str = "127.0.0.1", port: int = 0):
        self.lessons: Mapping[str, Lesson] = dict(catalog()) | ({start.lesson.name: start.lesson} if start else {})
        self.timelines, self._start = Timelines(), start
        self.students: dict[str, Student] = {}
        self._scenes: dict[str, viser.ClientHandle] = {}
        with contextlib.redirect_stdout(io.StringIO()):  # its banner
            self._viser = viser.ViserServer(host="127.0.0.1", port=0, verbose=False)
        self._viser.request_share_url = lambda *args, **kwargs: None  # type: ignore[method-assign]
        self._viser.on_client_connect(self._joined)
        self._viser.on_client_disconnect(self._left)
        self._inner = f"127.0.0.1:{self._viser.get_port()}"
        config = uvicorn.Config(self._app(), host=host, port=port, log_level="warning", ws_max_size=2**20)
        self._uvicorn = uvicorn.Server(config)
        self._thread = threading.Thread(target=self._uvicorn.run, daemon=True)
        self._thread.start()
        while not self._uvicorn.started:
            if not self._thread.is_alive():
                raise InputError(f"cannot listen on {host}:{port}")
            self._thread.join(0.01)
        self.port = self._uvicorn.servers[0].sockets[0].getsockname()[1]
        self.address = f"http://{'127.0.0.1' if host in ('0.0.0.0', '::', '') else host}:{self.port}"

    def stop(self) -> None:
        """Stop listening and end all pages."""
        self._uvicorn.should_exit = True
        self._thread.join()
        with contextlib.redirect_stdout(io.StringIO()):
            self._viser.stop()

    # the page -------------------------------------------------------------------------------------------------------

    def _app(self) -> Starlette:
        return Starlette(
            routes=[
                Route("/", self._page),
                Route("/page/math.css", self._math),
                Route("/page/{file}", self._file),
                WebSocketRoute("/live", self._live),
                Route("/scene/{token}/", self._scene),
                WebSocketRoute("/scene/{token}", self._scene_socket),
                WebSocketRoute("/scene/{token}/", self._scene_socket),
            ],
            lifespan=self._lifespan,
        )

    @contextlib.asynccontextmanager
    async def _lifespan(self, app: Starlette) -> AsyncIterator[None]:
        async with httpx.AsyncClient(base_url=f"http://{self._inner}") as self._http:
            yield

    async def _page(self, request: Request) -> Response:
        try:
            place = links.read(request.url.query, here=self._start.lesson if self._start else None) or self._start
        except InputError:
            place = None  # the page's websocket tells what is wrong
        name = request.query_params.get("lesson", "")
        lesson = place.lesson if place else self.lessons.get(name) or next(iter(self.lessons.values()))
        article = await asyncio.to_thread(article_html, lesson, lambda run, step: _address(lesson, run, step))
        page = lesson_document(lesson, article, home="live", root="page/", source="live.js")
        return HTMLResponse(page.replace("<body ", f'<body data-token="{secrets.token_hex(12)}" ', 1))

    async def _math(self, request: Request) -> Response:
        return PlainTextResponse(await asyncio.to_thread(math_font_css), media_type="text/css")

    async def _file(self, request: Request) -> Response:
        name = request.path_params["file"]
        return FileResponse(STATIC / name) if name in FILES else PlainTextResponse("no such file", 404)

    async def _live(self, socket: WebSocket) -> None:
        if not _same_origin(socket):
            await socket.close(4403)
            return
        await socket.accept()
        token = socket.query_params.get("token", "")
        student = Student(self.lessons, self.timelines, functools.partial(_send, socket))
        if not token or token in self.students:
            await socket.close(4409)
            return
        self.students[token] = student
        if token in self._scenes:
            student.join(self._scenes[token])
        working = asyncio.create_task(student.work())
        try:
            async for text in socket.iter_text():
                if len(text) <= LONGEST:
                    student.hear(text)
        except (WebSocketDisconnect, RuntimeError):
            pass
        finally:
            working.cancel()
            self.students.pop(token, None)

    # the scene ------------------------------------------------------------------------------------------------------

    async def _scene(self, request: Request) -> Response:
        kept = {name: value for name, value in request.headers.items() if name in ("accept-encoding", "if-none-match")}
        sent = self._http.build_request("GET", "/", headers=kept)
        answer = await self._http.send(sent, stream=True)
        body = b"".join([part async for part in answer.aiter_raw()])
        names = ("content-type", "content-encoding", "etag", "last-modified")
        headers = {name: answer.headers[name] for name in names if name in answer.headers}
        return Response(body, answer.status_code, headers | {"cache-control": "no-cache"})

    async def _scene_socket(self, socket: WebSocket) -> None:
        if not _same_origin(socket):
            await socket.close(4403)
            return
        wanted = [websockets.Subprotocol(name) for name in socket.scope.get("subprotocols") or ()]
        address = f"ws://{self._inner}/{socket.path_params['token']}"
        async with websockets.connect(address, subprotocols=wanted or None, max_size=None, compression=None) as inner:
            await socket.accept(inner.subprotocol)
            passing = asyncio.create_task(_pass_on(inner, socket))
            try:
                while True:
                    message = await socket.receive()
                    if message["type"] == "websocket.disconnect":
                        break
                    await inner.send(message.get("bytes") or message.get("text") or b"")
            except (websockets.ConnectionClosed, RuntimeError):
                pass
            finally:
                passing.cancel()

    async def _joined(self, client: viser.ClientHandle) -> None:
        connection = self._viser._websock_server._live_connections.get(client.client_id)  # nothing public tells it
        request = None if connection is None else connection.request
        token = "" if request is None else request.path.strip("/")
        self._scenes[token] = client
        if token in self.students:
            self.students[token].join(client)

    async def _left(self, client: viser.ClientHandle) -> None:
        for token in [token for token, other in self._scenes.items() if other is client]:
            del self._scenes[token]


async def _send(socket: WebSocket, text: str) -> None:
    with contextlib.suppress(WebSocketDisconnect, RuntimeError):  # it has left
        await socket.send_text(text)


async def _pass_on(inner: Any, socket: WebSocket) -> None:
    with contextlib.suppress(websockets.ConnectionClosed, RuntimeError):
        async for message in inner:
            await (socket.send_bytes(message) if isinstance(message, bytes) else socket.send_text(message))


def _same_origin(socket: WebSocket) -> bool:
    origin = socket.headers.get("origin")
    return origin is not None and origin.partition("//")[2] == socket.headers.get("host")


def _address(lesson: Lesson, run: str, step: int | None) -> str:
    preset = f"&preset={run}" if run not in ("", "default") else ""
    return f"?lesson={lesson.name}{preset}" + ("" if step is None else f"&step={step}")
