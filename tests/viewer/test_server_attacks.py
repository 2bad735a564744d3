"""Browsers that send garbage, a flood or a name of a file, or come as too many or as somebody else:
others go on, and no file is opened.
"""

import asyncio
import itertools
import json
import sys

import numpy as np
import pytest
import websockets

from tests import fake
from tests.fake_page import FakePage
from tests.viewer.attacked import (
    HERE,
    attacked_server,  # noqa: F401 (a fixture)
    meanwhile,
    until,
)
from workbench.knobs import fields_of
from workbench.lesson import catalog
from workbench.viewer import connection as connection_module

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
                # one by one: else the next takes its place
                await bad.say(verb="change", values={name: path})
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
