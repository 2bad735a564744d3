"""The commands' side of the live page: listens on the one port that is printed, until interrupted."""

import socket
import threading
import webbrowser
from typing import Any

from workbench import links
from workbench.authoring.reloading import Edited
from workbench.errors import InputError
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
    watched: Watched | None = None,
    edited: Edited | None = None,
) -> None:
    """Serve the course, or one lesson at a place, until interrupted; print the address when ready.

    Raises:
        InputError: If the port is taken or may not be used.
    """
    start = None if lesson is None else links.Place(lesson, params if params is not None else lesson.params(), step)
    server = Server(start, host=host, port=free_port(host, port), watched=watched, edited=edited)
    print(server.address, flush=True)  # noqa: T201
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


def free_port(host: str, port: int) -> int:
    """Return the port, or a free one for 0.

    Raises:
        InputError: If it is taken or may not be used, or if the host is not of this machine.
    """
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
            raise InputError(
                f"port {port} is in use: stop the other program, or choose another with --port (0 picks a free one)"
            ) from None
        raise InputError(f"cannot listen on {host}:{port}: {error.strerror or error}") from None
