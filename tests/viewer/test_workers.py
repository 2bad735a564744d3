"""Several processes behind one port: a page and all that is its own meet in one of them, and the others go on without it."""

import asyncio
import contextlib
import json
import signal
import socket
import subprocess
import sys
from collections import Counter
from collections.abc import AsyncIterator, Callable, Iterator
from pathlib import Path
from typing import Any
from urllib.parse import parse_qs, urlsplit

import httpx
import psutil
import pytest

from tests.fake_page import FakePage
from tests.loops import run_apart
from tests.viewer.test_inner import enters
from workbench.cli import main
from workbench.lesson import catalog
from workbench.timeline import Timeline

ROOT = Path(__file__).resolve().parents[2]
HERE = "?lesson=transforms"


@contextlib.contextmanager
def running(*words: str) -> Iterator[tuple[psutil.Popen, str]]:
    command = [sys.executable, "-m", "workbench", "--workers", "2", "--port", "0", "--no-browser", *words]
    with psutil.Popen(command, cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        said = ""
        while not said.startswith("http://127.0.0.1"):
            said = process.stdout.readline()
            assert said, process.stderr.read()
        try:
            yield process, said.strip()
        finally:
            with contextlib.suppress(psutil.NoSuchProcess):
                process.kill()


@pytest.fixture(scope="module")
def several() -> Iterator[tuple[psutil.Popen, str]]:
    with running() as process_and_address:
        yield process_and_address


@pytest.fixture
def served(several) -> str:
    return several[1]


@contextlib.asynccontextmanager
async def visiting(address: str, pages: int) -> AsyncIterator[list[FakePage]]:
    found = [FakePage(address, HERE) for _ in range(pages)]
    try:
        for page in found:
            await page.open()
        for page in found:
            await page.until(lambda page: page.run.get("finished") and page.scene_bytes > 1000)
        yield found
    finally:
        await asyncio.gather(*(page.close() for page in found))


def who(page: FakePage) -> str:
    return page.token[:2]


async def goes_on(page: FakePage) -> None:
    lesson = catalog()["transforms"]
    run = Timeline(lesson, lesson.params()).complete()
    for k in (2, 5, 1):
        await page.seek(k)
        assert page.step["step"]["caption"] == run[k].caption.text


def test_pages_are_shared_out_and_each_meets_its_scene_its_recording_and_its_file(served):
    async def visit() -> None:
        async with visiting(served, 6) as pages:
            assert Counter(who(page) for page in pages) == {"00": 3, "01": 3}
            for page in pages:
                before = page.scene_bytes
                await goes_on(page)
                await page.until(lambda page, before=before: page.scene_bytes > before)
            async with httpx.AsyncClient(base_url=served, timeout=300) as browser:
                for page in (*pages, *pages):  # one after the other over one browser's connections
                    assert (await browser.get("page/page.css")).status_code == 200
                    answer = await browser.post(
                        f"files/{page.token}/nothing?name=x.npy", content=b"x", headers={"Origin": served}
                    )
                    assert (answer.status_code, answer.text) == (422, "this lesson takes no such file")
                for page in pages[:2]:
                    answer = await browser.get(f"recording/{page.token}")
                    assert answer.status_code == 200
                    assert answer.content.startswith(b"RRF2")
                assert (await browser.get("recording/" + "0" * 24)).status_code == 404

    run_apart(visit())


def test_another_host_and_another_origin_are_refused_by_each(served):
    async def visit() -> None:
        for _ in range(4):
            bad = FakePage(served, HERE, {"Host": "evil.example"})
            with pytest.raises(ConnectionError, match="403"):
                await bad.open()
            bad = FakePage(served, HERE, {"Origin": "https://evil.example"})
            with pytest.raises(Exception, match="403"):
                await bad.open()

    run_apart(visit())


def test_none_leaves_its_viser_open(several):
    process, address = several
    own = {
        one.laddr.port
        for part in (process, *process.children(recursive=True))
        for one in part.net_connections("tcp")
        if one.status == psutil.CONN_LISTEN
    }
    own.remove(urlsplit(address).port)
    assert len(own) >= 2, "each has one"
    for port in own:
        assert httpx.get(f"http://127.0.0.1:{port}/").status_code == 403
        assert not run_apart(enters(f"127.0.0.1:{port}", {"Origin": "http://evil.example"}))


def test_one_token_opens_all():
    with running("--host", "0.0.0.0") as (_, address):
        where = urlsplit(address)
        base = f"http://{where.netloc}"
        key = parse_qs(where.query)["key"][0]
        assert all(httpx.get(f"{base}/{HERE}").status_code == 403 for _ in range(4))
        let_in = [httpx.get(f"{base}/{HERE}&key={key}") for _ in range(4)]
        assert {answer.status_code for answer in let_in} == {303}
        cookies = {answer.headers["set-cookie"].partition(";")[0] for answer in let_in}
        assert len(cookies) == 1
        pages = [httpx.get(f"{base}/{HERE}", headers={"Cookie": min(cookies)}) for _ in range(4)]
        assert {page.status_code for page in pages} == {200}


def test_connections_that_say_nothing_or_half_a_line_delay_nobody(served):
    where = urlsplit(served)

    async def visit() -> None:
        async with visiting(served, 2) as pages:
            quiet = [socket.create_connection((where.hostname, where.port), timeout=300) for _ in range(300)]
            for one in quiet[100:]:
                one.sendall(b"GET /?lesson=tr")
            for one in quiet[200:]:
                one.sendall(b"x" * 5000)  # a line that does not end
            for page in pages:
                await goes_on(page)
            one = quiet[100]
            one.sendall(f"ansforms HTTP/1.1\r\nHost: {where.netloc}\r\n\r\n".encode())
            assert (await asyncio.to_thread(one.recv, 15)).startswith(b"HTTP/1.1 200")
            for one in quiet:
                one.close()

    run_apart(visit())


def test_when_one_dies_its_pages_are_told_the_others_go_on_and_another_takes_its_place():
    with running() as (process, address):

        async def visit() -> None:
            async with visiting(address, 4) as pages:
                owners = {page: owner(process, page) for page in pages}
                assert len(set(owners.values())) == 2
                dead = owners[pages[0]]
                dead.kill()
                for page in pages:
                    if owners[page] == dead:
                        await asyncio.wait_for(until(lambda page=page: page.gone), 300)
                    else:
                        await goes_on(page)
            await asyncio.wait_for(until(lambda: len(process.children()) == 2), 300)
            async with asyncio.timeout(300):
                new = ""
                while new != who(pages[0]):  # as soon as the new one is ready
                    async with visiting(address, 1) as (page,):
                        new = who(page)

        run_apart(visit())
        process.send_signal(signal.SIGINT)
        workers = process.children()
        out, said = process.communicate(timeout=300)
        assert (process.returncode, out) == (0, "")
        assert said.count("another takes its place") == 1
        assert not psutil.wait_procs(workers, timeout=300)[1]


async def until(holds: Callable[[], Any]) -> None:
    while not holds():
        await asyncio.sleep(0.02)


def owner(process: psutil.Process, page: FakePage) -> psutil.Process:
    """Return the process at the other end of a page's socket."""
    port = page.live.transport.get_extra_info("sockname")[1]
    found = (child for child in process.children() for one in child.net_connections("tcp") if one.raddr)
    owners = [
        child for child in dict.fromkeys(found)
        if any(one.raddr and one.raddr.port == port for one in child.net_connections("tcp"))
    ]  # fmt: skip
    assert len(owners) == 1
    return owners[0]


@pytest.mark.parametrize("how", [signal.SIGTERM, signal.SIGKILL])
def test_however_it_is_ended_none_is_left(how):
    with running() as (process, _):
        workers = process.children()
        assert len(workers) == 2
        process.send_signal(how)
        assert not psutil.wait_procs(workers, timeout=300)[1]
        assert process.wait(300) == (0 if how == signal.SIGTERM else -signal.SIGKILL)


def test_what_several_cannot_serve_is_said(tmp_path, capsys):
    assert main(["--workers", "0", "--no-browser"]) == 2
    assert "from 1 to 64" in capsys.readouterr().err
    own = tmp_path / "own.py"
    own.write_text("def align_rigid(source, target):\n    raise NotImplementedError\n")
    assert main(["show", "icp", "--with", str(own), "--workers", "2", "--port", "0", "--no-browser"]) == 2
    assert "by one process" in capsys.readouterr().err


def test_what_stops_a_server_from_starting_is_said():
    source = "from workbench.viewer import server, serving\nfrom workbench.cli import main\nimport sys\n"
    source += "server.Server.__init__ = lambda *a, **k: 1 / 0\nsys.exit(main(['--workers', '2', '--port', '0']))"
    done = subprocess.run(
        [sys.executable, "-c", source], cwd=ROOT, capture_output=True, text=True, check=False, timeout=120
    )
    assert done.returncode == 2
    assert "ZeroDivisionError" in done.stderr
    assert json.dumps(done.stdout) == '""'
    assert "ended before it was ready" in done.stderr.splitlines()[-1]
