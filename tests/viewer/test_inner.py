"""viser's own port is closed to everybody but the server before it: no page, no program, no other user gets in there."""

import asyncio
import contextlib
import http.client
import socket
from collections.abc import Iterator

import msgspec
import pytest
import viser
import websockets

from tests import fake
from tests.fake_page import CAMERA, FakePage
from tests.loops import run_apart
from tests.viewer.attacked import meanwhile, visiting
from workbench import links
from workbench.errors import InputError
from workbench.publish.replay import Renderer
from workbench.viewer import inner
from workbench.viewer.inner import HEADER, Inner
from workbench.viewer.server import Server

NAME = websockets.Subprotocol(f"viser-v{viser.__version__}")
FORM = {"type": "GuiFormDirtyMessage", "uuid": "x"}
KEYS = (None, "", "x" * 32, "\xff")


@pytest.fixture(scope="module")
def server() -> Iterator[Server]:
    server = Server(links.Place(fake.lesson, fake.Params()))
    yield server
    server.stop()


def status(where: str, **headers: str) -> int:
    with contextlib.closing(http.client.HTTPConnection(where, timeout=60)) as asked:
        asked.request("GET", "/", headers=headers)
        return asked.getresponse().status


async def enters(where: str, headers: dict[str, str]) -> bool:
    """Whether a websocket is opened; if so, a form is sent by it."""
    try:
        socket = await websockets.connect(
            f"ws://{where}/{'0' * 24}", subprotocols=[NAME], additional_headers=headers, compression=None
        )
    except websockets.InvalidStatus:
        return False
    for message in (CAMERA, FORM):
        await socket.send(msgspec.msgpack.encode(message))
    await asyncio.sleep(0.2)
    await socket.close()
    return True


def test_nobody_gets_into_visers_own_port_and_nothing_sent_there_stays(server, capfd):
    where, buffer = server._inner.where, server._inner.viser._websock_server.get_message_buffer()
    before = len(buffer.message_from_id)

    async def attack(page: FakePage) -> None:
        for origin in ("http://evil.example", "null", server.address, f"http://{where}", None):
            for key in KEYS:
                headers = {} if key is None else {HEADER: key}
                assert not await enters(where, headers | ({} if origin is None else {"Origin": origin})), (origin, key)
        assert len(server._inner.viser.get_clients()) == 1, "the page's own"

    meanwhile(server, attack)
    assert status(where) == status(where, Host="evil.example") == status(where, **{HEADER: "x"}) == 403
    for garbage in (b"\x00" * 99 + b"\r\n\r\n", b"GET / HTTP/1.1\r\n\r\n", b"POST / HTTP/1.1\r\nHost: a\r\n\r\n"):
        with socket.create_connection(where.split(":"), timeout=60) as one:
            one.sendall(garbage)
            assert b" 200 " not in one.recv(99)
    assert len(buffer.message_from_id) == before
    said = capfd.readouterr()
    assert (said.out, said.err) == ("", "")


def test_with_its_key_it_is_the_viser_it_was(server):
    """And so what is refused above is refused for want of the key."""
    alone = Inner()
    try:
        assert status(alone.where, **alone.key) == 200
        assert status(alone.where, **server._inner.key) == 403, "each has a key of its own"
        buffer = alone.viser._websock_server.get_message_buffer()
        before = len(buffer.message_from_id)
        assert run_apart(enters(alone.where, alone.key))
        assert len(buffer.message_from_id) > before, "what viser keeps of a form that it is sent"
    finally:
        alone.stop()


def test_the_key_goes_to_viser_alone(server, monkeypatch):
    """No proxy that the environment names is asked for what stands on this machine."""
    for name in ("http_proxy", "all_proxy"):
        monkeypatch.setenv(name, "http://127.0.0.1:9")
    for name in ("no_proxy", "NO_PROXY"):
        monkeypatch.delenv(name, raising=False)
    proxied = Server(links.Place(fake.lesson, fake.Params()))

    async def visit() -> None:
        async with visiting(proxied) as page:
            assert (await proxied.scenes.fetch())[0] == 200
            await page.until(lambda page: page.scene_bytes > 1000)

    try:
        run_apart(visit())
    finally:
        proxied.stop()


def test_what_is_published_is_seen_by_nobody_meanwhile():
    with Renderer() as renderer:
        assert status(renderer._inner.where) == 403
        assert not run_apart(enters(renderer._inner.where, {}))


def test_a_viser_that_cannot_be_closed_is_refused(monkeypatch):
    before = inner.websockets.asyncio.server.serve
    monkeypatch.setattr(inner, "_served_only", lambda key: contextlib.nullcontext())
    with pytest.raises(InputError, match=f"viser {viser.__version__}.* cannot be closed"):
        Inner()
    assert inner.websockets.asyncio.server.serve is before
