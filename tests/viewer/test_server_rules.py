"""Who is let in by the live server: Host, Origin, token, and what answers carry."""

import http.client
from collections.abc import Iterator
from contextlib import closing

import pytest
import websockets

from tests.fake_page import FakePage
from tests.loops import run_apart
from workbench.errors import InputError
from workbench.machinery.hosts import Hosts, is_loopback
from workbench.viewer.addresses import addresses
from workbench.viewer.rules import Rules
from workbench.viewer.server import Server

TOKEN = "0123456789abcdef01234567"


@pytest.fixture(scope="module")
def local() -> Iterator[Server]:
    server = Server()
    yield server
    server.stop()


@pytest.fixture(scope="module")
def public() -> Iterator[Server]:
    """A server that other machines could reach; nobody does."""
    server = Server(host="0.0.0.0")
    yield server
    server.stop()


def get(server: Server, path: str = "/", **headers: str) -> tuple[int, dict[str, str], str]:
    with closing(http.client.HTTPConnection("127.0.0.1", server.port, timeout=30)) as asked:
        asked.putrequest("GET", path, skip_host=True)
        for name, value in ({"Host": f"127.0.0.1:{server.port}"} | headers).items():
            asked.putheader(name.replace("_", "-"), value)
        asked.endheaders()
        answer = asked.getresponse()
        return (
            answer.status,
            {k.lower(): v for k, v in answer.getheaders()},
            answer.read().decode(errors="replace"),
        )


def enters(server: Server, path: str, **headers: str) -> bool:
    """Whether a websocket is accepted."""

    async def attempt() -> bool:
        page = FakePage(
            f"http://127.0.0.1:{server.port}/",
            headers={k.replace("_", "-"): v for k, v in headers.items()},
        )
        options = {"subprotocols": ["viser-v1.1.1"]} if path.startswith("scene") else {}
        try:
            socket = await page.socket(path, **options)
        except websockets.InvalidStatus:
            return False
        await socket.close()
        return True

    return run_apart(attempt())


SOCKETS = (f"live?token={TOKEN}",)


def hosts(server: Server) -> dict[str, bool]:
    port = server.port
    return {
        "127.0.0.1": True,
        f"127.0.0.1:{port}": True,
        f"localhost:{port}": True,
        f"LOCALHOST:{port}": True,
        f"[::1]:{port}": True,
        f"evil.example:{port}": False,
        "evil.example": False,
        f"127.0.0.1.evil.example:{port}": False,
        f"localhost.evil.example:{port}": False,
        f"192.168.1.7:{port}": False,
        "": False,
        f"127.0.0.1:{port}@evil.example": False,
    }


def test_on_loopback_only_names_of_this_machine_are_answered(local):
    for host, known in hosts(local).items():
        assert get(local, Host=host)[0] == (200 if known else 403), host
        assert enters(local, SOCKETS[0], Host=host or "-", Origin=f"http://{host}") == known, host


@pytest.mark.parametrize("path", SOCKETS)
def test_a_page_of_another_origin_opens_no_websocket(local, path):
    own = f"http://127.0.0.1:{local.port}"
    assert enters(local, path, Origin=own)
    for origin in (
        "http://evil.example",
        "null",
        "http://127.0.0.1:1",
        f"{own}.evil.example",
        "http://localhost",
        "",
        f"https://evil.example:{local.port}",
        f"file://127.0.0.1:{local.port}",
    ):
        assert not enters(local, path, Origin=origin), origin


def test_a_page_of_another_origin_reads_nothing(local):
    assert get(local, Origin="http://evil.example")[0] == 403
    assert get(local, Sec_Fetch_Site="cross-site", Sec_Fetch_Mode="no-cors")[0] == 403
    assert get(local, Sec_Fetch_Site="cross-site", Sec_Fetch_Mode="navigate")[0] == 200, (
        "a link leads here"
    )


def test_the_token_lets_in_and_is_kept_in_a_cookie(public):
    token = public.rules.token
    assert token is not None
    assert len(token) >= 16
    status, _, body = get(public)
    assert (status, token in body) == (403, False)
    for path in (
        "/",
        "/page/story-page.css",
        "/page/math.woff2",
        "/scene/",
        "/?key=",
        "/?key=wrong",
        "/?key=%00%ff%C3%A4",
    ):
        assert get(public, path)[0] == 403, path
    status, headers, _ = get(public, f"/?lesson=icp&key={token}&step=3")
    assert (status, headers["location"]) == (303, "?lesson=icp&step=3")
    assert "httponly" in headers["set-cookie"].lower()
    assert "samesite=lax" in headers["set-cookie"].lower()
    assert "path" not in headers["set-cookie"].lower(), (
        "the browser's own default is right behind any prefix"
    )
    cookie = headers["set-cookie"].split(";")[0]
    status, _, body = get(public, "/?lesson=icp", Cookie=cookie)
    assert (status, token in body) == (200, False)
    for path in SOCKETS:
        assert enters(public, path, Cookie=cookie)
        assert not enters(public, path)
        assert not enters(public, path, Cookie=cookie.replace(token, token[::-1]))
        assert not enters(public, path, Cookie=cookie, Origin="http://evil.example")


def test_an_open_server_lets_everybody_in_but_no_other_origin_and_says_what_that_means():
    server = Server(host="0.0.0.0", open_to_all=True)
    try:
        assert server.rules.token is None
        assert "Everybody" in server.doors.welcome()
        assert get(server, Host=f"192.168.1.7:{server.port}")[0] == 200
        assert get(server, Host="evil.example")[0] == 403, (
            "a name can be given any address by whoever owns it"
        )
        assert not enters(server, SOCKETS[0], Origin="http://evil.example")
    finally:
        server.stop()


def test_a_server_for_others_says_where_it_is_and_a_local_one_only_its_address(local, public):
    assert local.doors.welcome() == local.address
    assert public.rules.token in public.doors.welcome()
    assert all(str(public.port) in link and "0.0.0.0" not in link for link in public.doors.links)
    assert public.doors.links


def test_behind_a_proxy_its_public_name_is_known():
    rules = Rules("127.0.0.1", behind="class.example.org")
    assert rules.knows("class.example.org")
    assert rules.knows("class.example.org:8443")
    assert rules.knows("127.0.0.1:8080")
    assert not rules.knows("evil.example")
    assert rules.same_origin("https://class.example.org", "127.0.0.1:8080")
    assert rules.same_origin("https://class.example.org:8443", "class.example.org:8443")
    assert not rules.same_origin("https://class.example.org.evil.example", "127.0.0.1:8080")
    assert not Rules("127.0.0.1", behind="class.example.org:8443").knows("class.example.org")
    for wrong in ("https://class.example.org", "a b", "class.example.org/workbench", ""):
        with pytest.raises(InputError, match="--behind"):
            Rules("127.0.0.1", behind=wrong)


def test_answers_say_what_keeps_a_browser_safe(local):
    for path in ("/", "/page/story-page.css", "/nothing", "/scene/"):
        _, headers, _ = get(local, path)
        assert headers["x-content-type-options"] == "nosniff"
        assert headers["referrer-policy"] == "same-origin"
        assert "frame-ancestors 'self'" in headers["content-security-policy"]
        assert "default-src 'none'" in headers["content-security-policy"]
        assert "server" not in headers
    _, headers, body = get(local, "/?lesson=icp")
    nonce = headers["content-security-policy"].partition("'nonce-")[2].partition("'")[0]
    assert body.count("<script") == body.count(f'<script nonce="{nonce}"') > 3
    assert get(local)[1]["content-security-policy"] != headers["content-security-policy"]
    assert (
        "unsafe"
        not in headers["content-security-policy"].partition("script-src")[2].partition(";")[0]
    )


def test_all_addresses_of_a_page_are_relative(local):
    _, _, page = get(local, "/?lesson=icp")
    assert 'src="/' not in page
    assert 'href="/' not in page
    assert 'location.pathname += "/"' in page


def test_which_hosts_are_of_this_machine():
    assert all(
        is_loopback(host) for host in ("127.0.0.1", "127.1.2.3", "localhost", "::1", "[::1]")
    )
    assert not any(
        is_loopback(host) for host in ("0.0.0.0", "::", "", "192.168.1.7", "example.org")
    )
    assert Hosts("127.1.2.3").know("127.1.2.3:8080"), "where it listens is where it is"
    assert Hosts("::1").know("[::1]:8080")
    assert Hosts("class.example.org").know("Class.Example.org")
    assert not Hosts("127.1.2.3").know("127.1.2.4")
    assert not Hosts("class.example.org").know("evil.example")
    assert addresses("192.168.1.7") == ["192.168.1.7"]
    assert addresses("fe80::7") == ["[fe80::7]"]


def test_a_port_that_is_taken_is_one_line(local):
    with pytest.raises(InputError, match=f"port {local.port} is in use"):
        Server(port=local.port)
    with pytest.raises(InputError, match="no address of this machine"):
        Server(host="192.0.2.1")
