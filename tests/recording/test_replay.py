"""Replaying: a page of this machine with Rerun's viewer, which can talk to nobody else."""

import contextlib
import http.client
import json
import socket
import stat
import sys
import urllib.error
import urllib.request
from pathlib import Path

import pytest

from workbench.errors import InputError
from workbench.recording import replay as replay_module
from workbench.recording import viewer_files
from workbench.recording.replay import POLICY, ReplayServer, replay_file


@pytest.fixture(scope="module")
def replay(fake_file):
    with ReplayServer(
        {"fake.rrd": fake_file, "bytes.rrd": b"RRF2 and more"}, "A <title>", port=0
    ) as running:
        yield running


def get(address: str) -> tuple[bytes, http.client.HTTPMessage]:
    with urllib.request.urlopen(address) as answer:
        return answer.read(), answer.headers


def test_the_page_names_the_viewer_and_the_recordings(replay):
    page, headers = get(replay.address)
    text = page.decode()
    assert "A &lt;title&gt;" in text
    assert '["/0.rrd", "/1.rrd"]' in text
    assert headers["Content-Type"] == "text/html; charset=utf-8"
    assert "http" not in text.replace("location.href", "")


def test_the_browser_is_told_to_talk_to_nobody_else(replay):
    for name in ("/", "/0.rrd"):
        assert get(replay.address + name)[1]["Content-Security-Policy"] == POLICY
    assert "connect-src 'self'" in POLICY
    assert "unsafe-eval" not in POLICY.replace("wasm-unsafe-eval", "")


def test_recordings_are_handed_out_as_they_are(replay, fake_file):
    assert get(f"{replay.address}/0.rrd")[0] == fake_file.read_bytes()
    assert get(f"{replay.address}/1.rrd?x=1")[0] == b"RRF2 and more"


def test_the_viewer_comes_along(replay):
    folder = f"{replay.address}/viewer-{viewer_files.rerun_version()}"
    script, headers = get(f"{folder}/re_viewer.js")
    assert b"WebHandle" in script
    assert headers["Content-Type"] == "text/javascript; charset=utf-8"
    request = urllib.request.Request(f"{folder}/re_viewer_bg.wasm", method="HEAD")
    with urllib.request.urlopen(request) as answer:
        assert answer.headers["Content-Type"] == "application/wasm"
        assert int(answer.headers["Content-Length"]) > 10_000_000


@pytest.mark.parametrize(
    "name", ["/2.rrd", "/../pyproject.toml", "/%2e%2e/etc/passwd", "//etc/passwd", "/viewer"]
)
def test_nothing_else_is_handed_out(replay, name):
    connection = http.client.HTTPConnection("127.0.0.1", replay.port)
    connection.request("GET", name)
    assert connection.getresponse().status == 404
    connection.close()


def test_only_this_machine_can_reach_it(replay):
    assert replay.address.startswith("http://127.0.0.1:")
    assert replay._listener.getsockname()[0] == "127.0.0.1"


def answered(port: int, name: str, host: str | None) -> int:
    connection = http.client.HTTPConnection("127.0.0.1", port, timeout=60)
    connection.putrequest("GET", name, skip_host=True)
    if host is not None:
        connection.putheader("Host", host)
    connection.endheaders()
    with contextlib.closing(connection):
        return connection.getresponse().status


@pytest.mark.parametrize("name", ["/", "/0.rrd", "/nothing"])
def test_it_answers_to_this_machine_s_names_alone(replay, name):
    """A site that gives its own name this machine's address reads no recording."""
    for host in (
        "127.0.0.1",
        f"127.0.0.1:{replay.port}",
        f"localhost:{replay.port}",
        f"[::1]:{replay.port}",
    ):
        assert answered(replay.port, name, host) == (404 if name == "/nothing" else 200), host
    for host in (
        "evil.example",
        f"evil.example:{replay.port}",
        f"127.0.0.1.evil.example:{replay.port}",
        "",
        None,
        f"192.168.1.7:{replay.port}",
        f"127.0.0.1:{replay.port}@evil.example",
    ):
        assert answered(replay.port, name, host) == (400 if host is None else 403), host


def test_where_others_may_reach_it_it_answers_to_addresses_and_to_its_own_name(fake_file):
    with ReplayServer({"a.rrd": fake_file}, "t", host="0.0.0.0", port=0) as public:
        for host in (
            "127.0.0.1",
            f"192.168.1.7:{public.port}",
            f"{socket.gethostname()}:{public.port}",
            "0.0.0.0",
        ):
            assert answered(public.port, "/0.rrd", host) == 200, host
        assert answered(public.port, "/0.rrd", "evil.example") == 403


def test_a_taken_port_is_said(fake_file):
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        port = taken.getsockname()[1]
        with pytest.raises(InputError, match=f"port {port} is in use"):
            ReplayServer({"a.rrd": fake_file}, "t", port=port)


def test_a_host_that_is_not_ours_is_said(fake_file):
    with pytest.raises(InputError, match=r"host 'no\.such\.host\.invalid'|cannot listen"):
        ReplayServer({"a.rrd": fake_file}, "t", host="no.such.host.invalid", port=0)


def test_after_the_end_nobody_answers(fake_file):
    with ReplayServer({"a.rrd": fake_file}, "t", port=0) as short:
        address = short.address
    with pytest.raises(urllib.error.URLError):
        get(address)


def test_damaged_files_are_refused_before_anything_is_served(tmp_path):
    (tmp_path / "a.rrd").write_text("no")
    with pytest.raises(InputError, match="no Rerun recording"):
        replay_file(tmp_path / "a.rrd", native=False, host="127.0.0.1", port=0, browser=False)


def test_statistics_are_off_unless_asked_for(monkeypatch):
    monkeypatch.delenv("CI", raising=False)
    monkeypatch.delenv("RERUN_ANALYTICS", raising=False)
    assert viewer_files.quiet_environment()["CI"] == "1"
    monkeypatch.setenv("RERUN_ANALYTICS", "1")
    assert "CI" not in viewer_files.quiet_environment()


@pytest.fixture
def stand_in(tmp_path, monkeypatch) -> Path:
    """A program in the place of Rerun's window that writes down how it was called, and ends with
    code CODE.
    """
    program = tmp_path / "viewer"
    program.write_text(
        f"#!{sys.executable}\nimport json, os, sys\n"
        "json.dump([sys.argv[1:], os.environ.get('CI')], open(sys.argv[0] + '.json', 'w'))\n"
        "sys.stderr.write('first\\nno display')\nsys.exit(int(os.environ.get('CODE', '0')))\n"
    )
    program.chmod(program.stat().st_mode | stat.S_IXUSR)
    monkeypatch.setattr(replay_module, "binary", lambda: program)
    monkeypatch.delenv("RERUN_ANALYTICS", raising=False)
    return program


@pytest.mark.skipif(sys.platform == "win32", reason="the stand-in is a script")
def test_native_opens_reruns_own_window_without_statistics(stand_in, fake_file):
    replay_file(fake_file, native=True, host="127.0.0.1", port=0, browser=False)
    assert json.loads((stand_in.parent / "viewer.json").read_text()) == [[str(fake_file)], "1"]


@pytest.mark.skipif(sys.platform == "win32", reason="the stand-in is a script")
def test_a_window_that_cannot_open_is_said(stand_in, fake_file, monkeypatch):
    monkeypatch.setenv("CODE", "1")
    with pytest.raises(InputError, match=r"could not be opened \(no display\); without --native"):
        replay_file(fake_file, native=True, host="127.0.0.1", port=0, browser=False)


def test_a_viewer_that_does_not_start_is_said(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    monkeypatch.setattr(viewer_files, "binary", lambda: Path(sys.executable))
    with pytest.raises(InputError, match="could not be unpacked"):
        viewer_files.web_viewer()
