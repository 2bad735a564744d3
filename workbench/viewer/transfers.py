"""What goes over HTTP beside a page: viser's client, and, asked for by its token, the recording of
its run and own files.
"""

import functools
import gzip
import hashlib
from dataclasses import dataclass
from urllib.parse import quote

from starlette.requests import ClientDisconnect, Request
from starlette.responses import PlainTextResponse, Response

from workbench.errors import InputError
from workbench.page.bundles import bundle
from workbench.run.timeline import Timeline
from workbench.viewer.connection import PageConnection
from workbench.viewer.terminal import tell_terminal
from workbench.wire.client import client_html


@dataclass(frozen=True)
class Served:
    """A text that all pages ask for: as it is, compressed by gzip, and what stands for its content.

    Attributes:
        media_type: What kind of text it is.
    """

    plain: bytes
    compressed: bytes
    etag: str
    media_type: str


@functools.cache
def client_served() -> Served:
    """Return viser's client."""
    return _served(client_html(), "text/html")


@functools.cache
def bundle_served(name: str) -> Served:
    """Return a bundle of our own scripts or styles."""
    return _served(bundle(name), "text/css" if name.endswith(".css") else "text/javascript")


def _served(text: str, media_type: str) -> Served:
    plain = text.encode()
    etag = f'"{hashlib.blake2b(plain, digest_size=12).hexdigest()}"'
    return Served(plain, gzip.compress(plain, 9, mtime=0), etag, media_type)


def text_response(request: Request, text: Served) -> Response:
    """Return a text: nothing where the browser has it already, else compressed where it can read
    that.
    """
    headers = {"etag": text.etag, "cache-control": "no-cache", "vary": "accept-encoding"}
    if text.etag in (
        tag.strip().removeprefix("W/")
        for tag in request.headers.get("if-none-match", "").split(",")
    ):
        return Response(status_code=304, headers=headers)
    if "gzip" in request.headers.get("accept-encoding", ""):
        headers["content-encoding"] = "gzip"
        return Response(text.compressed, headers=headers, media_type=text.media_type)
    return Response(text.plain, headers=headers, media_type=text.media_type)


async def recording(student: PageConnection | None) -> Response:
    """Return the run that a page shows as a recording."""
    if student is None or student.session is None:
        return PlainTextResponse("This page is not open any more; reload it.", 404)
    timeline = student.session.timeline
    try:
        name, content = await student.runs.keeping.do(_recorded, timeline)
    except InputError as error:
        tell_terminal(error)
        return PlainTextResponse(str(error), 422)
    headers = {
        "content-disposition": f"attachment; filename*=utf-8''{quote(name)}",
        "cache-control": "no-store",
    }
    return Response(content, media_type="application/octet-stream", headers=headers)


def _recorded(timeline: Timeline) -> tuple[str, bytes]:
    from workbench.recording import file_name, record_bytes

    preset = timeline.lesson.preset_of(timeline.params)
    name = None if preset is None else preset.name
    return file_name(timeline.lesson, name), record_bytes(timeline.complete(), preset=name)


async def receive(request: Request, student: PageConnection | None) -> Response:
    """Take a person's own file for a field of Params of the lesson that their page shows."""
    if student is None or "origin" not in request.headers:
        return PlainTextResponse("This page is not open any more; reload it.", 404)
    try:
        name = request.query_params.get("name", "")
        await student.take_file(request.path_params["field"], name, request.stream())
    except InputError as error:
        return PlainTextResponse(str(error), 422)
    except ClientDisconnect:
        return Response(status_code=400)
    return Response(status_code=204)
