"""The commands' side of the live page: listens on the one port that is printed, until interrupted."""

import threading
import webbrowser
from typing import Any

from workbench import links
from workbench.authoring.reloading import Edited
from workbench.exercise.watching import Watched
from workbench.lesson import Lesson
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
    watched: Watched | None = None,
    edited: Edited | None = None,
) -> None:
    """Serve the course, or one lesson at a place, until interrupted; print the address when ready.

    Raises:
        InputError: If the port is taken or may not be used.
    """
    start = None if lesson is None else links.Place(lesson, params if params is not None else lesson.params(), step)
    server = Server(start, host=host, port=port, open_to_all=open_to_all, behind=behind, watched=watched, edited=edited)
    print(server.welcome(), flush=True)  # noqa: T201
    if browser:
        webbrowser.open(server.address)
    try:
        until_interrupted()
    except KeyboardInterrupt:
        pass
    finally:
        server.stop()


def until_interrupted() -> None:
    """Wait for ever; Ctrl+C ends it."""
    threading.Event().wait()
