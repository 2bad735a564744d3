"""How many files a server may open, and what it says where it may open no more."""

import asyncio
import os
import select
import socket
import subprocess
import sys
import time
from pathlib import Path

import httpx
import pytest

from tests.fake_page import FakePage
from tests.loops import run_apart
from tests.viewer.attacked import goes_on
from workbench.viewer import patience

resource = pytest.importorskip("resource")
ROOT = Path(__file__).resolve().parents[2]
UNBOUND = resource.RLIM_INFINITY
FULL = """
import os, resource, sys
from tests import fake
from workbench.run import links
from workbench.viewer.server import Server

server = Server(links.Place(fake.lesson, fake.Params()))
print(server.address, flush=True)
for command in sys.stdin:
    _, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    most = max(map(int, os.listdir("/proc/self/fd"))) + 20 if command == "few\\n" else hard
    resource.setrlimit(resource.RLIMIT_NOFILE, (most, hard))
    print(most, flush=True)
"""


@pytest.mark.parametrize(
    ("limits", "asked"),
    [
        ((1024, 4096), [(4096, 4096)]),
        ((1024, 2**20), [(patience.FILES, 2**20)]),
        ((1024, UNBOUND), [(patience.FILES, UNBOUND)]),
        ((2**16, 2**20), []),
        ((4096, 4096), []),
        ((UNBOUND, UNBOUND), []),
    ],
)
def test_a_server_asks_for_the_files_of_a_large_class_and_never_for_fewer_than_it_has(
    monkeypatch, limits, asked
):
    requests = []
    monkeypatch.setattr(resource, "getrlimit", lambda which: limits)
    monkeypatch.setattr(resource, "setrlimit", lambda which, wanted: requests.append(wanted))
    patience.more_files()
    assert requests == asked


def test_where_it_may_have_no_more_it_goes_on(monkeypatch):
    def refuse(which: int, wanted: tuple[int, int]) -> None:
        raise ValueError("not allowed to raise maximum limit")

    monkeypatch.setattr(resource, "getrlimit", lambda which: (1024, 4096))
    monkeypatch.setattr(resource, "setrlimit", refuse)
    patience.more_files()


@pytest.mark.skipif(sys.platform != "linux", reason="looks into /proc")
def test_at_the_limit_of_open_files_it_says_a_line_a_second_and_open_pages_go_on():
    with subprocess.Popen(
        [sys.executable, "-c", FULL],
        cwd=ROOT,
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
    ) as process:
        asked, answers, complaints = process.stdin, process.stdout, process.stderr
        assert asked is not None
        assert answers is not None
        assert complaints is not None
        address = answers.readline().decode().strip()
        port = int(address.rpartition(":")[2])

        def may_open(word: str) -> int:
            asked.write(f"{word}\n".encode())
            asked.flush()
            return int(answers.readline())

        async def visit() -> None:
            page = await FakePage(address, "?lesson=fake").open()
            await page.until(lambda page: page.run.get("finished"))
            await goes_on(page)  # what a picture needs is imported when it is first drawn
            most = may_open("few")
            quiet = [socket.create_connection(("127.0.0.1", port), timeout=60) for _ in range(60)]
            await asyncio.to_thread(select.select, [complaints], [], [], 60)  # the first line
            began = time.monotonic()
            while time.monotonic() - began < 2.2:
                await goes_on(page)
            assert len(os.listdir(f"/proc/{process.pid}/fd")) >= most - 2, "it is full"
            for connection in quiet:
                connection.close()
            may_open("many")
            async with httpx.AsyncClient(timeout=60, trust_env=False) as browser:
                assert (await browser.get(f"{address}/?lesson=fake")).status_code == 200
            await page.close()

        try:
            run_apart(visit())
        finally:
            process.kill()
            lines = complaints.read().decode().splitlines()
        assert 1 <= len(lines) <= 6, "\n".join(lines)
        assert all(
            line.startswith("workbench: ") and "Too many open files" in line for line in lines
        ), lines
