"""Browsers that say nothing, take nothing, wait or have gone: others go on, and when nobody is
there nothing is left.
"""

import asyncio
import contextlib
import gc
import json
import socket
import threading
import time
import weakref

from tests import fake
from tests.fake_page import FakePage
from tests.loops import run_apart
from tests.viewer.attacked import (
    HERE,
    attacked_server,  # noqa: F401 (a fixture)
    goes_on,
    meanwhile,
    until,
)
from workbench.run import links
from workbench.viewer import patience
from workbench.viewer import server as server_module
from workbench.viewer.connection import PageConnection
from workbench.viewer.runs import SharedRuns
from workbench.viewer.server import Server


def test_silent_sockets_delay_nobody_and_are_closed_after_a_while(server, monkeypatch):
    monkeypatch.setattr(server_module, "FIRST_WORD", 1.0)

    async def attack(page: FakePage) -> None:
        quiet = [await page.socket(f"live?token={k:024x}") for k in range(300)]
        await goes_on(page)
        async with asyncio.timeout(300):
            await asyncio.gather(*(connection.wait_closed() for connection in quiet))

    meanwhile(server, attack)


def test_connections_that_say_nothing_are_closed(monkeypatch):
    monkeypatch.setattr(patience, "PATIENCE", 1.0)
    monkeypatch.setattr(patience.Patience.__init__, "__defaults__", (1.0,))
    server = Server(links.Place(fake.lesson, fake.Params()))
    try:
        quiet = [
            socket.create_connection(("127.0.0.1", server.port), timeout=30) for _ in range(20)
        ]
        for connection in quiet[10:]:
            connection.sendall(b"GET / HTTP/1.1\r\nHost: 127.0")
        for connection in quiet:
            with contextlib.suppress(ConnectionResetError):
                assert connection.recv(1) == b""
            connection.close()
    finally:
        server.stop()


def test_a_page_that_takes_nothing_is_sent_the_latest_when_it_takes_again():
    took = []

    async def attack() -> None:
        takes = asyncio.Event()
        runs = SharedRuns()

        async def send(part: str | bytes) -> None:
            if isinstance(part, bytes):
                return
            took.append(json.loads(part))
            await takes.wait()

        student = PageConnection({"fake": fake.lesson}, runs, send)
        working = asyncio.create_task(student.work())
        student.hear('{"verb": "open", "query": "?lesson=fake", "lesson": "fake"}')
        await until(lambda: bool(took))
        for k in range(5000):
            student.hear(json.dumps({"verb": "change", "values": {"angle": k / 100}}))
            student.hear(json.dumps({"verb": "seek", "k": k % 6}))
            student.hear(json.dumps({"verb": "predict", "question": f"{k}"}))
        assert len(student._requests) <= 12
        assert len(took) == 1
        takes.set()
        await until(lambda: any(told.get("k") == 4999 % 6 for told in took))
        assert [told["params"]["angle"] for told in took if told["tell"] == "run"][-1] == 49.99
        assert len(took) < 20
        working.cancel()
        runs.close()

    run_apart(attack())


def test_a_connection_that_takes_nothing_is_closed_after_a_while(monkeypatch):
    monkeypatch.setattr(patience.Patience.__init__, "__defaults__", (1.0,))
    server = Server(links.Place(fake.lesson, fake.Params()))
    try:
        slow = socket.create_connection(("127.0.0.1", server.port), timeout=300)
        asking = f"GET /scene/ HTTP/1.1\r\nHost: 127.0.0.1:{server.port}\r\n\r\n".encode()
        slow.sendall(asking * 30)  # 25 MB to come
        connections = server._uvicorn.server_state.connections
        deadline = time.monotonic() + 60
        while not connections:
            assert time.monotonic() < deadline
        most = 0
        while connections:
            assert time.monotonic() < deadline, "it is still open"
            most = max(
                [
                    most,
                    *(
                        connection.transport.get_write_buffer_size()
                        for connection in tuple(connections)
                    ),
                ]
            )
            time.sleep(0.01)
        assert most < 4e6, "no more waits than one answer"
        slow.close()
    finally:
        server.stop()


def test_a_scene_that_is_not_taken_is_not_buffered_without_bound(server):
    async def attack(page: FakePage) -> None:
        slow = await FakePage(f"{server.address}/", HERE).open(read=False)
        slow.live.transport.pause_reading()
        await slow.say(verb="change", values={"points": 20_000, "wobble": True})
        await until(lambda: slow.token in server.students)
        student = server.students[slow.token]
        await until(lambda: student.session is not None and student.session.params.points == 20_000)
        waiting = []
        for _ in range(20):
            for k in range(6):
                await slow.say(verb="seek", k=k)
            await goes_on(page)
            connections = server._uvicorn.server_state.connections
            waiting.append(
                max(
                    connection.transport.get_write_buffer_size()
                    for connection in tuple(connections)
                )
            )
        assert max(waiting) < 4e6, "no more waits than a few steps"
        assert len(student._requests) <= 3
        await slow.close()

    meanwhile(server, attack)


def test_reloading_browsers_leave_nothing(server):
    async def attack(page: FakePage) -> None:
        async def reload() -> None:
            browser = await FakePage(f"{server.address}/", HERE).open(read=False)
            browser.live.transport.abort()

        await asyncio.gather(*(reload() for _ in range(30)))

    meanwhile(server, attack)


def test_when_all_have_gone_threads_and_runs_are_back():
    before = threading.active_count()
    server = Server(links.Place(fake.lesson, fake.Params()), most_bytes=1)
    students: list[weakref.ref] = []

    async def attack(page: FakePage) -> None:
        students.extend(weakref.ref(student) for student in server.students.values())
        for angle in (10, 20, 30):
            await page.say(verb="change", values={"angle": angle})
            await page.until(
                lambda page, angle=angle: (
                    page.run["params"]["angle"] == angle and page.run["finished"]
                )
            )
        await page.say(verb="change", values={"angle": 90.0})

    meanwhile(server, attack)
    deadline = time.monotonic() + 60
    while time.monotonic() < deadline and (
        any(ref() for ref in students) or server.runs.timelines.alive()
    ):
        server.runs.make_room([], [])
        gc.collect()
        time.sleep(0.05)
    assert not any(ref() for ref in students)
    assert not server.runs.timelines.alive()
    server.stop()
    while time.monotonic() < deadline and threading.active_count() > before:
        time.sleep(0.05)
    assert threading.active_count() <= before


def test_when_nobody_is_there_for_a_while_nothing_is_held(monkeypatch):
    monkeypatch.setattr(server_module, "ROOM", 0.1)
    monkeypatch.setattr(server_module, "EMPTY", 0.3)
    server = Server(links.Place(fake.lesson, fake.Params()))
    try:
        meanwhile(server, goes_on)
        deadline = time.monotonic() + 60
        while server.runs.timelines.alive() and time.monotonic() < deadline:
            time.sleep(0.05)
        assert not server.runs.timelines.alive()
        meanwhile(server, goes_on)
    finally:
        server.stop()


def test_pages_that_are_being_made_delay_no_step(server, monkeypatch):
    held = threading.Event()
    made = threading.Semaphore(0)

    def making(*_) -> str:
        made.release()
        held.wait(60)
        return "<body >"

    async def attack(page: FakePage) -> None:
        monkeypatch.setattr(server._lesson_pages, "page", making)
        others = [
            asyncio.create_task(FakePage(f"{server.address}/", HERE)._page()) for _ in range(4)
        ]
        await until(lambda: made.acquire(blocking=False))
        try:
            async with asyncio.timeout(10):
                await goes_on(page)
        finally:
            held.set()
        await asyncio.gather(*others)

    meanwhile(server, attack)


def test_garbage_is_collected_while_nobody_waits(monkeypatch):
    monkeypatch.setattr(server_module, "ROOM", 0.1)
    tidied = []
    server = Server(links.Place(fake.lesson, fake.Params()))

    async def attack(page: FakePage) -> None:
        student = server.students[page.token]
        student.acted += 3600.0
        assert not server._is_at_rest(), "somebody did something just now"
        monkeypatch.setattr(server_module, "tidy", lambda: tidied.append(student.acted))
        student.acted -= 3600.0
        await until(lambda: bool(tidied))

    try:
        meanwhile(server, attack)
    finally:
        server.stop()
