"""viser's client: one file that draws scenes, and takes the page for the worker through which it
would reach a server.
"""

import functools
import importlib.util
from importlib.metadata import version
from pathlib import Path

from workbench.errors import InputError

_WORKER = (  # what the client starts to open a websocket; the page (`feed.js`) takes its place
    "<script>window.Worker=class{constructor(){this.postMessage=(said)=>said.type==='set_server'?parent.feed.connect(this)"
    ":said.type==='send'&&parent.feed.hear(said.message)}terminate(){}}</script>"
)


def viser_version() -> str:
    """Return which viser is installed; it is not imported, which takes half a second."""
    return version("viser")


def viser_folder() -> Path:
    """Return the folder of the viser that is installed."""
    spec = importlib.util.find_spec("viser")
    return Path(spec.origin if spec and spec.origin else "viser").parent


@functools.cache
def client_html() -> str:
    """Return viser's client as a page puts it into a frame.

    Raises:
        InputError: If this version of viser has no such file.
    """
    file = viser_folder() / "client" / "build" / "index.html"
    try:
        html = file.read_text(encoding="utf-8")
    except OSError:
        html = ""
    if "<head>" not in html:
        raise InputError(
            f"viser {viser_version()} has no client that a page can feed: install viser 1.1.1"
        )
    return html.replace("<head>", f"<head>{_WORKER}", 1)
