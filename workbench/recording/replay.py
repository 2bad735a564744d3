"""Plays recordings in Rerun's viewer: in the browser of this machine, or in its own window."""

import html
import json
import subprocess
import threading
import webbrowser
from collections.abc import Mapping, Sequence
from pathlib import Path
from string import Template

import uvicorn
from starlette.applications import Starlette
from starlette.requests import Request
from starlette.responses import FileResponse, Response
from starlette.routing import Route

from workbench.errors import InputError
from workbench.machinery.hosts import Hosts, listening
from workbench.recording.viewer_files import binary, quiet_environment, rerun_version, web_viewer

POLICY = (
    "default-src 'self'; script-src 'self' 'unsafe-inline' 'wasm-unsafe-eval'; style-src 'self'"
    " 'unsafe-inline'; img-src 'self' data: blob:; font-src 'self' data:; connect-src 'self';"
    " worker-src 'self' blob:"
)
"""Keeps the viewer from talking to anybody but us: no statistics, no fonts from elsewhere."""

KINDS = {".html": "text/html; charset=utf-8", ".js": "text/javascript", ".wasm": "application/wasm"}


def replay_file(path: Path, *, native: bool, host: str, port: int, browser: bool) -> None:
    """Play a recording until interrupted.

    Raises:
        InputError: If the file is no recording of ours, or the port is taken.
    """
    from workbench.recording.read import open_recording

    recording = open_recording(path)
    title = f"{recording.title} · {path.name}"
    play({path.name: path}, title, native=native, host=host, port=port, browser=browser)


def play(
    files: Mapping[str, Path | bytes],
    title: str,
    *,
    native: bool,
    host: str,
    port: int,
    browser: bool,
) -> None:
    """Play recordings, given by file name, until interrupted."""
    if native:
        _play_native([file for file in files.values() if isinstance(file, Path)])
        return
    with ReplayServer(files, title, host=host, port=port) as replay:
        print(replay.address, flush=True)  # noqa: T201
        if browser:
            webbrowser.open(replay.address)
        try:
            threading.Event().wait()
        except KeyboardInterrupt:
            return


def _play_native(paths: Sequence[Path]) -> None:
    process = subprocess.Popen(
        [str(binary()), *map(str, paths)],
        env=quiet_environment(),
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        text=True,
    )
    try:
        _, complaints = process.communicate()
    except KeyboardInterrupt:
        process.terminate()
        process.wait()
        return
    if process.returncode:
        last = (complaints.strip().splitlines() or ["no reason was given"])[-1]
        raise InputError(
            f"Rerun's window could not be opened ({last}); without --native it plays in the browser"
        )


class ReplayServer:
    """A web server, in its own thread, for a page with Rerun's viewer, and recordings.

    Args:
        files: Recordings by file name: a path, or the bytes.
        port: 0 picks a free one.

    Raises:
        InputError: If the port is taken or may not be used.
    """

    def __init__(
        self,
        files: Mapping[str, Path | bytes],
        title: str,
        *,
        host: str = "127.0.0.1",
        port: int = 8080,
    ):
        viewer = {f"/viewer-{rerun_version()}/{name}": file for name, file in web_viewer().items()}
        recordings = {f"/{i}.rrd": content for i, content in enumerate(files.values())}
        self._contents = {"/": _page(title, list(viewer), list(recordings)), **viewer, **recordings}
        self._hosts = Hosts(host)
        self._listener = listening(host, port)
        self.port = self._listener.getsockname()[1]
        self.address = f"http://{f'[{host}]' if ':' in host else host}:{self.port}"
        app = Starlette(routes=[Route("/{path:path}", self._answer)])
        self._server = uvicorn.Server(
            uvicorn.Config(app, http="h11", log_level="critical", timeout_graceful_shutdown=2)
        )
        self._thread = threading.Thread(
            target=self._server.run, args=([self._listener],), daemon=True
        )
        self._thread.start()
        while self._thread.is_alive() and not self._server.started:
            self._thread.join(0.01)

    def __enter__(self) -> "ReplayServer":
        """Return itself."""
        return self

    def __exit__(self, *exc: object) -> None:
        """Stop serving."""
        self._server.should_exit = True
        self._thread.join()

    def _answer(self, request: Request) -> Response:
        """Return one of fixed files, asked for by this machine's name, and nothing else."""
        if not self._hosts.know(request.headers.get("host", "")):
            return Response("This server is not known under that name.", 403)
        name = request.url.path
        content = self._contents.get(name)
        if content is None or (isinstance(content, Path) and not content.is_file()):
            return Response(status_code=404)
        headers = {
            "Content-Security-Policy": POLICY,
            "X-Content-Type-Options": "nosniff",
            "Cache-Control": (
                "public, max-age=31536000, immutable" if name.startswith("/viewer-") else "no-store"
            ),
        }
        kind = KINDS.get(Path(name).suffix or ".html", "application/octet-stream")
        make = FileResponse if isinstance(content, Path) else Response
        return make(content, headers=headers, media_type=kind)


def _page(title: str, viewer: Sequence[str], recordings: Sequence[str]) -> bytes:
    script, program = viewer
    options = {
        "hide_welcome_screen": True,
        "theme": "light",
        "enable_history": False,
        "manifest_url": None,
    }
    page = Template(Path(__file__).with_name("replay.html").read_text(encoding="utf-8"))
    names = {"title": html.escape(title), "script": script, "program": program}
    return page.substitute(
        names, recordings=json.dumps(list(recordings)), options=json.dumps(options)
    ).encode()
