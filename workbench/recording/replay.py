"""Plays recordings in Rerun's viewer: in the browser, under the names of this machine only, or in Rerun's own window."""

import contextlib
import errno
import html
import json
import shutil
import socket
import subprocess
import sys
import threading
import webbrowser
from collections.abc import Mapping, Sequence
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import ClassVar

from workbench.errors import InputError
from workbench.hosts import Hosts
from workbench.recording.viewer_files import binary, quiet_environment, rerun_version, web_viewer

POLICY = (
    "default-src 'self'; script-src 'self' 'unsafe-inline' 'wasm-unsafe-eval'; style-src 'self' 'unsafe-inline'; "
    "img-src 'self' data: blob:; font-src 'self' data:; connect-src 'self'; worker-src 'self' blob:"
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


def play(files: Mapping[str, Path | bytes], title: str, *, native: bool, host: str, port: int, browser: bool) -> None:
    """Play recordings, given by file name, until interrupted."""
    if native:
        _play_native([file for file in files.values() if isinstance(file, Path)])
        return
    with Replay(files, title, host=host, port=port) as replay:
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
        raise InputError(f"Rerun's window could not be opened ({last}); without --native it plays in the browser")


class Replay:
    """A web server that hands out a page with Rerun's viewer, and recordings. Serves from its own threads.

    Args:
        files: Recordings by file name: a path, or the bytes.
        title: The page's title.
        host, port: Where it listens; port 0 picks a free one.

    Raises:
        InputError: If the port is taken or may not be used.
    """

    def __init__(self, files: Mapping[str, Path | bytes], title: str, *, host: str = "127.0.0.1", port: int = 8080):
        viewer = {f"/viewer-{rerun_version()}/{name}": file for name, file in web_viewer().items()}
        recordings = {f"/{i}.rrd": content for i, content in enumerate(files.values())}
        page = _page(title, list(viewer), list(recordings))
        contents: dict[str, Path | bytes] = {"/": page.encode(), **viewer, **recordings}
        handler = type("Handler", (_Handler,), {"contents": contents, "hosts": Hosts(host)})
        try:
            self._server = _server_class(host)((host, port), handler)
        except OSError as error:
            raise InputError(_why_not(error, host, port)) from None
        self.port = self._server.server_address[1]
        self.address = f"http://{f'[{host}]' if ':' in host else host}:{self.port}"
        self._thread = threading.Thread(target=self._server.serve_forever, daemon=True)
        self._thread.start()

    def __enter__(self) -> "Replay":
        """Return itself."""
        return self

    def __exit__(self, *exc: object) -> None:
        """Stop serving."""
        self._server.shutdown()
        self._server.server_close()
        self._thread.join()


class _Handler(BaseHTTPRequestHandler):
    """Answers with one of a fixed set of files, and nothing else, where it is asked by this machine's name."""

    contents: ClassVar[Mapping[str, Path | bytes]] = {}
    hosts: ClassVar[Hosts] = Hosts("localhost")
    protocol_version = "HTTP/1.1"

    def do_GET(self) -> None:
        """Send a file."""
        self._answer(body=True)

    def do_HEAD(self) -> None:
        """Say how large a file is."""
        self._answer(body=False)

    def _answer(self, *, body: bool) -> None:
        if not self.hosts.know(self.headers.get("Host", "")):
            self.send_error(403, explain="This server is not known under that name.")
            return
        name = self.path.partition("?")[0]
        content = self.contents.get(name)
        try:
            size = len(content) if isinstance(content, bytes) else content.stat().st_size if content else None
        except OSError:
            size = None
        if content is None or size is None:
            self.send_error(404)
            return
        self.send_response(200)
        self.send_header("Content-Type", KINDS.get(Path(name).suffix or ".html", "application/octet-stream"))
        self.send_header("Content-Length", str(size))
        self.send_header("Content-Security-Policy", POLICY)
        self.send_header("X-Content-Type-Options", "nosniff")
        forever = name.startswith("/viewer-")
        self.send_header("Cache-Control", "public, max-age=31536000, immutable" if forever else "no-store")
        self.end_headers()
        if not body:
            return
        with contextlib.suppress(BrokenPipeError, ConnectionResetError):  # the browser went away
            if isinstance(content, bytes):
                self.wfile.write(content)
            else:
                with content.open("rb") as file:
                    shutil.copyfileobj(file, self.wfile)

    def log_message(self, format: str, *args: object) -> None:  # noqa: A002
        """Keep quiet: the terminal belongs to the command."""


def _server_class(host: str) -> type[ThreadingHTTPServer]:
    family = socket.AF_INET6 if ":" in host else socket.AF_INET
    options = {"address_family": family, "daemon_threads": True, "allow_reuse_address": sys.platform != "win32"}
    return type("Server", (ThreadingHTTPServer,), options)


def _why_not(error: OSError, host: str, port: int) -> str:
    if error.errno == errno.EADDRINUSE:
        return f"port {port} is in use: stop the other program, or choose another with --port (0 picks a free one)"
    if isinstance(error, PermissionError):
        return f"port {port} needs more rights than this user has: choose one above 1023"
    if isinstance(error, socket.gaierror):
        return f"host {host!r} is no address of this machine"
    return f"cannot listen on {host}:{port}: {error.strerror or error}"


def _page(title: str, viewer: Sequence[str], recordings: Sequence[str]) -> str:
    script, program = viewer
    options = {"hide_welcome_screen": True, "theme": "light", "enable_history": False, "manifest_url": None}
    return f"""<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>{html.escape(title)}</title>
<link rel="icon" href="data:,">
<style>
html, body {{ margin: 0; height: 100%; overflow: hidden; background: #fff; color: #24292f;
  font: 16px/1.5 system-ui, sans-serif; }}
canvas {{ position: absolute; width: 100%; height: 100%; }}
#note {{ position: absolute; inset: 0; display: grid; place-content: center; text-align: center; padding: 1rem; }}
</style>
</head>
<body>
<canvas id="canvas"></canvas>
<div id="note" role="status"><p><b>{html.escape(title)}</b></p><p id="words">Starting the viewer …</p>
<noscript>The viewer needs JavaScript.</noscript></div>
<script src="{script}"></script>
<script>
const note = document.getElementById("note"), words = document.getElementById("words");
const recordings = {json.dumps(list(recordings))}.map((name) => new URL(name, location.href).href);
(async () => {{
  await wasm_bindgen({{ module_or_path: fetch("{program}") }});
  window.viewer = new wasm_bindgen.WebHandle({{ ...{json.dumps(options)}, url: recordings }});
  await viewer.start(document.getElementById("canvas"));
  note.remove();
}})().catch((error) => {{
  words.textContent = "The viewer could not start in this browser (it needs WebGL 2 or WebGPU): " + error;
}});
</script>
</body>
</html>
"""
