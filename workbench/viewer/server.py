"""The live home of the page: the only thing that listens.

One port, one origin: `/` is the page, `/live` its websocket, `/scene/` viser's client, one file,
which the page puts into a frame and feeds. A page has a token; it is made here, and says nothing of
anybody.
"""

import asyncio
import contextlib
import functools
import re
import secrets
import sys
import threading
from collections.abc import AsyncIterator

import uvicorn
from starlette.applications import Starlette
from starlette.requests import Request
from starlette.responses import FileResponse, PlainTextResponse, RedirectResponse, Response
from starlette.routing import Route, WebSocketRoute
from starlette.websockets import WebSocket, WebSocketDisconnect

from workbench.authoring.reloading import Edited, carried
from workbench.errors import InputError
from workbench.exercise.watching import WatchedFile
from workbench.lesson import Lesson, catalog
from workbench.machinery.hosts import listening
from workbench.machinery.warming import load_parts
from workbench.page.bundles import (
    FONTS,
    ICON,
    LIVE_FILES,
    MATH_FONT,
    STATIC,
    THIRD_PARTIES,
    UNSCRIPTED,
)
from workbench.page.code import source_html
from workbench.page.course import FRONT_PICTURES
from workbench.page.thumbnail import thumbnail
from workbench.run import links
from workbench.viewer.addresses import Doors
from workbench.viewer.connection import PageConnection
from workbench.viewer.documents import LessonPages, course_page, lesson_page, start_address
from workbench.viewer.following import Following
from workbench.viewer.pace import FIRST_WORD, Pace
from workbench.viewer.patience import Patience, more_files
from workbench.viewer.rules import RequestGate, Rules, page_response
from workbench.viewer.runs import MOST_BYTES, SharedRuns, tidy
from workbench.viewer.transfers import (
    bundle_served,
    client_served,
    receive,
    recording,
    text_response,
)
from workbench.words.typeset import math_font

FILES = (*FONTS, *FRONT_PICTURES, ICON, UNSCRIPTED, THIRD_PARTIES)
"""What is served as it is; styles and scripts come as bundles."""
MOST_PAGES = 400
"""Pages at once; whoever comes later is told so."""
MOST_A_SECOND = 200
"""Requests of a page; what is more waits, and of its kind the latest is what counts."""
ROOM = 3.0
"""Seconds between two looks at what is held in memory."""
EMPTY = 30.0
"""Seconds without a page after which nothing is held any more."""
SWITCH = 0.001
"""Seconds that a thread which computes holds up another, such as the one that hears and tells;
Python's own is 0.005.
"""
_TOKEN = re.compile(r"[0-9a-f]{24}")


class Server:
    """A running server.

    Args:
        start: Where browsers begin whose address names no lesson; None is the course page.
        host, port: Where it listens; port 0 picks a free one.
        watched: A student's file that drives the lesson of `start`; loaded again whenever it is
            saved.
        edited: The lesson of `start` where it was given by its path; loaded again whenever one of
            its files is saved.
        open_to_all: Let everybody in who reaches it; else whoever is not on this machine brings the
            token of `links`.
        behind: The name under which browsers find it, where it stands behind a proxy.
        most_bytes: What runs and all that belongs to them may hold.
        most_pages: How many pages may be open.

    Attributes:
        doors: Where browsers find it.

    Raises:
        InputError: If the port is taken or may not be used.
    """

    def __init__(
        self,
        start: links.Place | None = None,
        *,
        host: str = "127.0.0.1",
        port: int = 0,
        watched: WatchedFile | None = None,
        edited: Edited | None = None,
        open_to_all: bool = False,
        behind: str | None = None,
        most_bytes: int = MOST_BYTES,
        most_pages: int = MOST_PAGES,
    ):
        self.lessons: dict[str, Lesson] = dict(catalog()) | (
            {start.lesson.name: start.lesson} if start else {}
        )
        self.rules = Rules(host, open_to_all=open_to_all, behind=behind)
        listener = listening(host, port)
        more_files()
        sys.setswitchinterval(SWITCH)
        self.port = listener.getsockname()[1]
        self.doors = Doors(host, self.port, self.rules.token)
        self.runs = SharedRuns(most_bytes)
        self._start = start
        self._most_pages = most_pages
        self._lesson_pages = LessonPages()
        self.students: dict[str, PageConnection] = {}
        self._pictures: dict[str, tuple[Lesson, asyncio.Task[bytes]]] = {}
        self.following = start and Following(
            start.lesson, watched, edited, replace=self._replace, pages=self._pages
        )
        config = uvicorn.Config(
            RequestGate(self._app(), self.rules, f"workbench-{self.port}"),
            http="h11",
            ws="websockets-sansio",
            log_level="critical",
            ws_max_size=2**16,
            ws_per_message_deflate=False,
            server_header=False,
            proxy_headers=False,
            timeout_graceful_shutdown=2,
        )
        self._uvicorn = uvicorn.Server(config)
        self._thread = threading.Thread(target=self._uvicorn.run, args=([listener],), daemon=True)
        self._thread.start()
        while not self._uvicorn.started:
            if not self._thread.is_alive():
                raise InputError(f"cannot listen on {host}:{port}")
            self._thread.join(0.01)

    @property
    def address(self) -> str:
        """Where a browser on this machine finds it."""
        return self.doors.address

    def stop(self) -> None:
        """Stop listening and end all pages."""
        if self.following is not None:
            self.following.close()
        self._uvicorn.should_exit = True
        self._thread.join(10)
        self.runs.close()

    # the page -------------------------------------------------------------------------------------

    def _app(self) -> Starlette:
        return Starlette(
            routes=[
                Route("/", self._page),
                Route(f"/page/{MATH_FONT}", self._math_font),
                Route("/page/{file}", self._file),
                Route("/picture/{lesson}", self._picture),
                WebSocketRoute("/live", self._live),
                Route("/recording/{token}", self._recording),
                Route("/files/{token}/{field}", self._receive, methods=["POST"]),
                Route("/scene/", self._scene),
            ],
            lifespan=self._lifespan,
        )

    @contextlib.asynccontextmanager
    async def _lifespan(self, app: Starlette) -> AsyncIterator[None]:
        self._loop = asyncio.get_running_loop()
        keeping = [
            asyncio.create_task(work)
            for work in (Patience(self._uvicorn).keep(), self._warm_up(), self._keep_room())
        ]
        yield
        for task in keeping:
            task.cancel()

    async def _warm_up(self) -> None:
        """Make what every page needs before the first one asks."""
        await self.runs.asking.do(client_served)
        for name in LIVE_FILES:
            await self.runs.asking.do(bundle_served, name)
        await self.runs.asking.do(source_html, lesson_page)
        await self.runs.asking.do(load_parts)

    async def _keep_room(self) -> None:
        """Hold what is kept within its bound, and see to it that what is stuck holds nobody up."""
        empty_for = 0.0
        while True:
            await asyncio.sleep(ROOM)
            self.runs.scheduler.relieve()
            before = empty_for
            empty_for = 0.0 if self.students else empty_for + ROOM
            if before < EMPTY <= empty_for:
                self._pictures.clear()
                await self.runs.asking.do(self.runs.let_go, list(self.lessons.values()))
            if self._is_at_rest():
                await self.runs.asking.do(tidy)
            longest_ago = sorted(self.students.values(), key=lambda student: student.acted)
            await self.runs.asking.do(
                self.runs.make_room,
                list(self.lessons.values()),
                [student.sleep for student in longest_ago],
            )

    def _is_at_rest(self) -> bool:
        """Tell whether nothing is computed, and nobody wished for anything lately."""
        since = self._loop.time() - ROOM
        acted = (student.acted for student in self.students.values())
        return len(self.runs.scheduler) == 0 and all(when < since for when in acted)

    async def _page(self, request: Request) -> Response:
        if len(self.students) >= self._most_pages:
            return PlainTextResponse(
                "As many pages are open as this server can bear. Try again in a while.", 503
            )
        named = request.query_params.get("lesson")
        trouble = None
        if named is None and self._start is not None and "course" not in request.query_params:
            return RedirectResponse(
                start_address(self._start, request.url.query), headers={"cache-control": "no-store"}
            )
        lesson = self.lessons.get(named or "")
        try:
            place = links.read(request.url.query, here=lesson)
            lesson = place.lesson if place else None
        except InputError as error:
            trouble = str(error)  # of a lesson that is here, the page's websocket tells it
        if lesson is None:
            return page_response(
                request, await self.runs.opening.do(course_page, self.lessons, trouble)
            )
        watched = self.following.watched if self.following else None
        page = await self.runs.opening.do(self._lesson_pages.page, lesson, self.lessons, watched)
        return page_response(
            request, page.replace("<body ", f'<body data-token="{self._new_token()}" ', 1)
        )

    def _new_token(self) -> str:
        return secrets.token_hex(12)

    def _pages(self) -> list[PageConnection]:
        return list(self.students.values())

    def _replace(self, before: Lesson, after: Lesson) -> None:
        """Serve another version of the lesson of `start`."""
        assert self._start is not None, "a lesson is followed where browsers begin"
        if after.name != before.name:
            del self.lessons[before.name]
        self.lessons[after.name] = after
        self._start = links.Place(after, carried(self._start.params, after), self._start.step)

    async def _recording(self, request: Request) -> Response:
        return await recording(self.students.get(request.path_params["token"]))

    async def _receive(self, request: Request) -> Response:
        return await receive(request, self.students.get(request.path_params["token"]))

    async def _math_font(self, request: Request) -> Response:
        return Response(await self.runs.asking.do(math_font), media_type="font/woff2")

    async def _picture(self, request: Request) -> Response:
        lesson = self.lessons.get(request.path_params["lesson"])
        if lesson is None:
            return PlainTextResponse("no such picture", 404)
        kept, making = self._pictures.get(lesson.name, (None, None))
        if making is None or kept is not lesson:  # made once for all who ask
            making = asyncio.create_task(
                self.runs.keeping.do(thumbnail, lesson, self.runs.timelines)
            )
            self._pictures[lesson.name] = lesson, making
        try:
            picture = await asyncio.shield(making)
        except Exception:  # what is wrong with a lesson is told on its page
            return PlainTextResponse("this lesson has no picture", 404)
        return Response(picture, media_type="image/webp", headers={"cache-control": "max-age=600"})

    async def _file(self, request: Request) -> Response:
        name = request.path_params["file"]
        if name in LIVE_FILES:
            return text_response(request, await self.runs.opening.do(bundle_served, name))
        if name in FILES:
            return FileResponse(STATIC / name)
        return PlainTextResponse("no such file", 404)

    async def _live(self, socket: WebSocket) -> None:
        await socket.accept()
        token = socket.query_params.get("token", "")
        if (
            not _TOKEN.fullmatch(token)
            or token in self.students
            or len(self.students) >= self._most_pages
        ):
            await socket.close(4409)
            return
        student = self.students[token] = PageConnection(
            self.lessons, self.runs, functools.partial(_send, socket)
        )
        student.start, student.following = self._start, self.following
        working = asyncio.create_task(student.work())
        try:
            await self._listen(socket, student)
        except (WebSocketDisconnect, RuntimeError, TimeoutError):
            pass
        finally:
            working.cancel()
            self.students.pop(token, None)
            student.close()
            student.leave()
        with contextlib.suppress(RuntimeError):
            await socket.close()

    @staticmethod
    async def _listen(socket: WebSocket, student: PageConnection) -> None:
        pace = Pace(MOST_A_SECOND)
        heard = False
        while True:
            message = await asyncio.wait_for(socket.receive(), None if heard else FIRST_WORD)
            if message["type"] == "websocket.disconnect":
                return
            heard |= student.hear(message.get("text") or "")
            await pace.step()

    async def _scene(self, request: Request) -> Response:
        return text_response(request, await self.runs.opening.do(client_served))


async def _send(socket: WebSocket, part: str | bytes) -> None:
    with contextlib.suppress(WebSocketDisconnect, RuntimeError):  # it has left
        await (socket.send_text(part) if isinstance(part, str) else socket.send_bytes(part))
