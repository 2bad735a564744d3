"""Browsers that answer nothing, take nothing or send garbage: others go on, and when they have gone
nothing is left.
"""

import asyncio
import contextlib
import gc
import itertools
import json
import socket
import sys
import threading
import time
import weakref
from collections.abc import Iterator

import numpy as np
import pytest
import websockets

from tests import fake
from tests.fake_page import FakePage
from tests.loops import run_apart
from tests.viewer.attacked import HERE, goes_on, meanwhile, until
from workbench.knobs import fields_of
from workbench.lesson import catalog
from workbench.run import links
from workbench.viewer import connection as connection_module
from workbench.viewer import patience
from workbench.viewer import server as server_module
from workbench.viewer.connection import PageConnection
from workbench.viewer.runs import SharedRuns
from workbench.viewer.server import Server


@pytest.fixture(scope="module")
def server() -> Iterator[Server]:
    server = Server(links.Place(fake.lesson, fake.Params()))
    yield server
    server.stop()


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


GARBAGE = (
    "",
    "{",
    "[]",
    "null",
    "7",
    '"open"',
    '{"verb": 1}',
    '{"verb": "__init__"}',
    '{"verb": ["seek"]}',
    "[" * 19_000,
    '{"verb": "click"}',
    '{"verb": "seek"}' + " " * 30_000,
    "\x00",
)
ODD = (
    None,
    True,
    -1,
    2**70,
    -(2**70),
    1e308,
    "x" * 5000,
    "../../etc/passwd",
    [],
    [[]],
    {},
    {"self": 1, "": []},
    [1, 2, 3],
)


@pytest.mark.parametrize("verb", ["open", "seek", "run", "change", "reset", "predict", "click"])
def test_garbage_in_every_wish_is_ignored(server, verb, capfd):
    keys = (
        "query",
        "lesson",
        "k",
        "run",
        "step",
        "values",
        "question",
        "given",
        "p_origin",
        "v_ray",
    )

    async def attack(page: FakePage) -> None:
        bad = await FakePage(f"{server.address}/", HERE).open()
        for text in GARBAGE:
            await bad.live.send(text)
        await bad.live.send(b"\xff\x00")
        for value in ODD:
            await bad.say(verb=verb, **dict.fromkeys(keys, value))
            await bad.say(
                verb=verb, values=dict.fromkeys(("self", *fake.Params.__dataclass_fields__), value)
            )
        for question in fake.lesson.questions:
            for value in ODD:
                await bad.say(verb="predict", question=question.name, given=value)
                await asyncio.sleep(0.005)
        await bad.say(verb="open", query=HERE, lesson="fake")
        await bad.seek(3)
        assert bad.step["step"]["caption"]
        await bad.close()

    meanwhile(server, attack)
    errors = capfd.readouterr().err
    assert "could not be fulfilled" not in errors, errors


def test_a_click_is_three_numbers_and_three_numbers_or_nothing():
    good = {"p_origin": [0, 1.0, 2], "v_ray": [0.0, 0, -1]}
    p_origin, v_ray = connection_module._ray(good) or (None, None)
    np.testing.assert_array_equal(p_origin, [0, 1, 2])  # type: ignore[arg-type]
    np.testing.assert_array_equal(v_ray, [0, 0, -1])  # type: ignore[arg-type]
    lists = (
        [],
        [0, 0],
        [0, 0, 0, 0],
        [0, 0, "1"],
        [True, 0, 0],
        [float("nan")] * 3,
        [2**70, 0, 0],
        [[1, 2, 3]] * 3,
    )
    odd = (None, "x", {}, *lists)
    for key in good:
        for value in odd:
            assert connection_module._ray(good | {key: value}) is None, (key, value)
    assert connection_module._ray(good | {"v_ray": [0, 0, 0]}) is None


def test_a_flood_of_wishes_is_one_of_each_kind(server, monkeypatch):
    runs = []
    get = server.runs.timelines.get
    monkeypatch.setattr(
        server.runs.timelines, "get", lambda *asked: runs.append(asked) or get(*asked)
    )

    async def attack(page: FakePage) -> None:
        bad = await FakePage(f"{server.address}/", HERE).open()
        wishes = [json.dumps({"verb": "change", "values": {"angle": k / 100}}) for k in range(3000)]
        for wish in wishes:
            await bad.live.send(wish)
        await bad.until(
            lambda page: page.run and page.run["params"]["angle"] == 29.99 and page.run["finished"]
        )
        await bad.close()

    meanwhile(server, attack)
    assert 0 < len(runs) < 1500, "the latest of those that wait is what counts"


def test_too_many_pages_are_told_so_and_disturb_nobody(server, monkeypatch):
    monkeypatch.setattr(server, "_most_pages", 3)

    async def attack(page: FakePage) -> None:
        others = [await FakePage(f"{server.address}/", HERE).open() for _ in range(2)]
        with pytest.raises(Exception, match="503"):
            await FakePage(f"{server.address}/", HERE).open()
        for other in others:
            await other.close()
        await until(lambda: len(server.students) == 1)
        last = await FakePage(f"{server.address}/", HERE).open()
        await last.until(lambda page: page.step)
        await last.close()

    meanwhile(server, attack)


def test_a_page_is_not_taken_over_by_its_token(server):
    async def attack(page: FakePage) -> None:
        thief = await page.socket(f"live?token={page.token}")
        with pytest.raises(websockets.ConnectionClosed):
            await thief.recv()
        for token in ("", "x", "../../etc/passwd", "0" * 23, "A" * 24):
            other = await page.socket(f"live?token={token}")
            with pytest.raises(websockets.ConnectionClosed):
                await other.recv()

    meanwhile(server, attack)


def test_large_frames_close_only_the_socket_they_came_from(server):
    async def attack(page: FakePage) -> None:
        bad = await FakePage(f"{server.address}/", HERE).open()
        await bad.live.send("x" * 2**20)
        await until(lambda: bad.gone)
        await bad.close()

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
    held, made = threading.Event(), threading.Semaphore(0)

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


def test_no_wish_link_or_knob_opens_a_file(server):
    """Thirteen fields by nine paths, through every verb and link, while an audit hook notes what is
    opened.
    """
    names = [
        "scan",
        "query",
        "lesson",
        "run",
        "step",
        "question",
        "given",
        "k",
        "on",
        "dark",
        "verb",
        "preset",
        "file",
    ]
    lessons = (fake.lesson, *catalog().values())
    names += sorted(
        {field.name for lesson in lessons for field in fields_of(lesson.params) if field.sensitive}
        - {"scan"}
    )
    paths = [
        "/etc/passwd",
        "../../../etc/passwd",
        "file:///etc/passwd",
        "/proc/self/environ",
        "~/.ssh/id_rsa",
        "/dev/zero",
        "..%2f..%2fetc%2fpasswd",
        "/etc/passwd\x00.npy",
        "http://127.0.0.1:1/x.npy",
    ]
    marks = ("passwd", "environ", "id_rsa", "/dev/zero", "127.0.0.1:1")
    opened: list[str] = []
    watching = True

    def hook(event: str, args: tuple) -> None:
        if watching and event == "open" and any(mark in str(args[0]) for mark in marks):
            opened.append(str(args[0]))

    sys.addaudithook(hook)
    open("/etc/passwd").close()
    assert opened, "the hook sees what is opened"
    opened.clear()
    assert len(names) >= 13

    async def attack(page: FakePage) -> None:
        bad = await FakePage(f"{server.address}/", HERE).open()
        await bad.until(lambda page: page.step)
        for path in paths:
            for name in names:
                for verb in ("open", "run", "change", "predict", "seek"):
                    await bad.say(**{"verb": verb, name: path})
                await bad.say(verb="change", values={name: path})
                await bad.say(verb="open", query=f"?lesson=fake&{name}={path}", lesson="fake")
                await bad.say(verb="open", query=f"?lesson=icp&{name}={path}", lesson=path)
        for lesson in lessons:
            await bad.say(verb="open", query=f"?lesson={lesson.name}", lesson=lesson.name)
            for name, path in itertools.product(
                [field.name for field in fields_of(lesson.params) if field.sensitive], paths
            ):
                await bad.say(
                    verb="change", values={name: path}
                )  # one by one: else the next takes its place
                await bad.seek(0)
        await bad.say(verb="open", query=HERE, lesson="fake")
        await bad.seek(1)
        assert "/etc" not in json.dumps(bad.run)
        await bad.close()
        reader, writer = await asyncio.open_connection("127.0.0.1", server.port)
        for path in (
            *paths,
            "/page/../../../etc/passwd",
            "/page/..%2f..%2fpage.css",
            "/scene/x/../../etc/passwd",
        ):
            asked = path.replace("\x00", "%00")
            writer.write(
                f"GET /{asked.lstrip('/')} HTTP/1.1\r\nHost: 127.0.0.1:{server.port}\r\n\r\n".encode()  # noqa: E501
            )
            assert (await reader.readuntil(b"\r\n")).split()[1] in (b"404", b"200", b"307")
            head = await reader.readuntil(b"\r\n\r\n")
            length = int(head.lower().partition(b"content-length: ")[2].partition(b"\r\n")[0])
            assert b"root:" not in await reader.readexactly(length)
        writer.close()

    try:
        meanwhile(server, attack)
    finally:
        watching = False
    assert opened == []
