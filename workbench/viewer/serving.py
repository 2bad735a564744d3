"""The commands' side of the live page: listens on the one port that is printed, until
interrupted.
"""

import contextlib
import signal
import threading
import webbrowser
from collections.abc import Iterator
from typing import Any

from workbench.authoring.reloading import Edited
from workbench.errors import InputError
from workbench.exercise.watching import WatchedFile
from workbench.lesson import Lesson
from workbench.run import links
from workbench.viewer.addresses import Doors
from workbench.viewer.runs import settle
from workbench.viewer.server import Server


def serve(
    lesson: Lesson | None = None,
    params: Any = None,
    step: int | None = None,
    *,
    host: str = "127.0.0.1",
    port: int = 8080,
    browser: bool = True,
    open_to_all: bool = False,
    behind: str | None = None,
    workers: int = 1,
    watched: WatchedFile | None = None,
    edited: Edited | None = None,
) -> None:
    """Serve the course, or one lesson at a place, until interrupted; print the address when ready.

    Raises:
        InputError: If the port is taken or may not be used, or several processes are wanted.
    """
    start = None
    if lesson is not None:
        start = links.Place(lesson, params if params is not None else lesson.params(), step)
    if workers != 1:
        raise InputError(
            f"--workers {workers}: one process serves a hundred students; more servers:"
            " docs/classroom.md"
        )
    with _ended_as_by_ctrl_c():
        server = Server(
            start,
            host=host,
            port=port,
            open_to_all=open_to_all,
            behind=behind,
            watched=watched,
            edited=edited,
        )
        settle()
        try:
            _announce(server.doors, browser)
            until_interrupted()
        except KeyboardInterrupt:
            pass
        finally:
            server.stop()


def _announce(doors: Doors, browser: bool) -> None:
    print(doors.welcome(), flush=True)  # noqa: T201
    if browser:
        webbrowser.open(doors.address)


def until_interrupted() -> None:
    """Wait for ever; Ctrl+C ends it."""
    threading.Event().wait()


@contextlib.contextmanager
def _ended_as_by_ctrl_c() -> Iterator[None]:
    """Let whoever stops a service, or a container, end it as gently as Ctrl+C does."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    before = signal.signal(signal.SIGTERM, signal.default_int_handler)
    try:
        yield
    finally:
        signal.signal(signal.SIGTERM, before)
