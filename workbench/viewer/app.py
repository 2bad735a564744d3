"""The server: one page per browser, all on one port of this machine."""

import asyncio
import contextlib
import io
import socket
import threading
import webbrowser
from collections.abc import Callable
from typing import Any

import viser

from workbench import links
from workbench.authoring.reloading import Edited, carried
from workbench.errors import InputError
from workbench.exercise.watching import RUNNING, Watched
from workbench.lesson import Lesson, catalog
from workbench.timeline import Timelines
from workbench.typeset import math_font_css
from workbench.viewer.page import Page
from workbench.viewer.progress import KEY
from workbench.viewer.style import STYLE
from workbench.viewer.terminal import tell_terminal

_ADDRESS_KEY = "workbench-address"


def _first_words() -> str:
    """Return HTML that puts the style sheet into the document's head, and the browser's address where it can be read.

    The server does not see what stands behind the address; the image that cannot be read runs the script.
    """
    script = (
        "document.head.appendChild(this.previousElementSibling.cloneNode(true));"
        f"localStorage.setItem('viser-user:{_ADDRESS_KEY}', location.search)"
    )
    return f'<style>{STYLE}{math_font_css()}</style><img src="data:,x" alt="" hidden onerror="{script}">'


class App:
    """A running server.

    Args:
        start: Where browsers begin whose address names no lesson; None is the course page.
        host, port: Where it listens; port 0 picks a free one.
        watched: A student's file that drives the lesson of `start`; loaded again whenever it is saved.
        edited: The lesson of `start` where it was given by its path; loaded again whenever one of its files is saved.

    Raises:
        InputError: If the port is taken or may not be used.
    """

    def __init__(
        self,
        start: links.Place | None = None,
        *,
        host: str = "127.0.0.1",
        port: int = 8080,
        watched: Watched | None = None,
        edited: Edited | None = None,
    ):
        port = _free_port(host, port)
        self.lessons = dict(catalog())
        if start is not None:
            self.lessons[start.lesson.name] = start.lesson
        self.timelines, self._start = Timelines(), start
        with contextlib.redirect_stdout(io.StringIO()):  # its banner; the address is printed when all is ready
            self.server = viser.ViserServer(host=host, port=port, verbose=False)
        if self.server.get_port() != port:  # viser takes the next port in silence
            self.server.stop()
            raise InputError(_taken(port))
        self.server.request_share_url = lambda *args, **kwargs: None  # type: ignore[method-assign]
        self.host, self.port = host, port
        self.pages: dict[int, Page] = {}
        self._watched, self._edited = watched, edited
        follow = [self._watch(watched)] if watched is not None else []
        follow += [self._reload(edited)] if edited is not None else []
        self._following = [asyncio.run_coroutine_threadsafe(one, self.server.get_event_loop()) for one in follow]
        self.server.on_client_connect(self._connect)
        self.server.on_client_disconnect(self._disconnect)

    @property
    def address(self) -> str:
        """Where a browser on this machine finds it."""
        host = "127.0.0.1" if self.host in ("0.0.0.0", "::", "") else self.host
        return f"http://{host}:{self.port}"

    def stop(self) -> None:
        """Stop listening and end all pages."""
        for one in self._following:
            one.cancel()
        with contextlib.redirect_stdout(io.StringIO()):
            self.server.stop()
        if self._watched is not None:
            self._watched.close()

    async def _connect(self, client: viser.ClientHandle) -> None:
        page = self.pages[client.client_id] = Page(client, self.lessons, self.timelines, self._start, self._watched)
        with contextlib.suppress(RuntimeError):  # the browser left before it answered
            query = await self._address_of(client)
            kept = await self._kept(client, KEY)
            await page.open(query, kept)
            if self._edited is not None and self._edited.trouble is not None and self._start is not None:
                page.tell(self._start.lesson, self._edited.trouble)

    async def _watch(self, watched: Watched) -> None:
        """Give every page the new run whenever the student's file was saved, and the checks' report when it is there."""
        checking = asyncio.create_task(self._check(watched))
        while True:
            while not await asyncio.to_thread(self._saved, watched):
                await asyncio.sleep(0.3)
            before, after = self._replace(watched.lesson)
            self._for_each(lambda page, before=before, after=after: page.replace_lesson(before, after))
            checking = asyncio.create_task(self._check(watched, checking))

    async def _reload(self, edited: Edited) -> None:
        """Give every page the new lesson whenever one of its files was saved, or what is wrong with it."""
        while True:
            while not await asyncio.to_thread(edited.changed):
                await asyncio.sleep(0.3)
            trouble, lesson = edited.trouble, edited.lesson
            try:
                if trouble is None and self._watched is not None:
                    self._watched.follow(lesson)
                    lesson = self._watched.lesson
            except InputError as error:
                trouble = error
            if trouble is not None:
                tell_terminal(trouble)
                here = self._start.lesson if self._start is not None else lesson
                self._for_each(lambda page, here=here, trouble=trouble: page.tell(here, trouble))
                continue
            before, after = self._replace(lesson)
            self._for_each(lambda page, before=before, after=after: page.rebuild(before, after))
            if self._watched is not None:
                await self._check(self._watched)

    def _for_each(self, show: Callable[[Page], None]) -> None:
        """Do something with every page; what goes wrong with one, such as of a browser that just left, is told only."""
        for page in list(self.pages.values()):
            try:
                show(page)
            except Exception as error:
                tell_terminal(error)

    def _replace(self, after: Lesson) -> tuple[Lesson, Lesson]:
        """Serve another version of the lesson of `start`; return the one before and this one."""
        assert self._start is not None, "a lesson is followed where browsers begin"
        before = self._start.lesson
        if after.name != before.name:
            del self.lessons[before.name]
        self.lessons[after.name] = after
        self._start = links.Place(after, carried(self._start.params, after), self._start.step)
        return before, after

    async def _check(self, watched: Watched, earlier: asyncio.Task | None = None) -> None:
        """Check the file once the checks of an earlier state of it are through, which may have to wait for time-outs."""
        if earlier is not None:
            await earlier
        if watched.said == RUNNING:
            await asyncio.to_thread(watched.check)
        self._for_each(lambda page: page.show_report())

    @staticmethod
    def _saved(watched: Watched) -> bool:
        try:
            return watched.changed()
        except InputError:  # half a file; the next save is looked at again
            return False

    async def _disconnect(self, client: viser.ClientHandle) -> None:
        page = self.pages.pop(client.client_id, None)
        if page is not None:
            page.close()

    async def _address_of(self, client: viser.ClientHandle) -> str:
        """Give a browser the style sheet, and ask for the part of its address behind `?`."""
        client.local_storage.remove_item(_ADDRESS_KEY)
        asking = client.gui.add_html(_first_words())
        client.flush()
        query = None
        for _ in range(60):
            query = await self._kept(client, _ADDRESS_KEY)
            if query is not None:
                break
            await asyncio.sleep(0.05)
        asking.remove()
        client.local_storage.remove_item(_ADDRESS_KEY)
        return query or ""

    @staticmethod
    async def _kept(client: viser.ClientHandle, key: str) -> str | None:
        try:
            return await asyncio.to_thread(client.local_storage.get_item, key, 15.0)
        except (TimeoutError, RuntimeError):
            return None  # a browser that keeps nothing still gets its page


def serve(
    lesson: Lesson | None = None,
    params: Any = None,
    step: int | None = None,
    *,
    host: str = "127.0.0.1",
    port: int = 8080,
    browser: bool = True,
    watched: Watched | None = None,
    edited: Edited | None = None,
) -> None:
    """Serve the course, or one lesson at a place, until interrupted; print the address when ready.

    Raises:
        InputError: If the port is taken or may not be used.
    """
    start = None if lesson is None else links.Place(lesson, params if params is not None else lesson.params(), step)
    app = App(start, host=host, port=port, watched=watched, edited=edited)
    print(app.address, flush=True)  # noqa: T201
    if browser:
        webbrowser.open(app.address)
    try:
        threading.Event().wait()
    except KeyboardInterrupt:
        pass
    finally:
        app.stop()


def _free_port(host: str, port: int) -> int:
    if not 0 <= port < 65536:
        raise InputError(f"port {port}: a port is a whole number from 0 to 65535")
    try:
        with socket.socket(socket.AF_INET6 if ":" in host else socket.AF_INET) as probe:
            probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            probe.bind((host, port))
            return probe.getsockname()[1]
    except PermissionError:
        raise InputError(f"port {port} needs more rights than this user has: choose one above 1023") from None
    except socket.gaierror:
        raise InputError(f"host {host!r} is no address of this machine") from None
    except OSError as error:
        if error.errno == 98 or "in use" in str(error):
            raise InputError(_taken(port)) from None
        raise InputError(f"cannot listen on {host}:{port}: {error.strerror or error}") from None


def _taken(port: int) -> str:
    return f"port {port} is in use: stop the other program, or choose another with --port (0 picks a free one)"
