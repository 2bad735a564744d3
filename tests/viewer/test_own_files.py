"""A person's own files on a page, over HTTP: bounded, under names of ours, gone with the page; no
path from outside.
"""

import contextlib
import json
import re
import shutil
import tempfile
import time
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import httpx
import numpy as np
import pytest
from websockets.sync.client import connect
from websockets.sync.connection import Connection

from tests import fake
from workbench.run import links
from workbench.viewer import own_files
from workbench.viewer.server import Server

HOSTILE = (
    "../../../etc/passwd",
    "..",
    ".",
    "",
    "/etc/passwd",
    "a/b.npy",
    "..\\..\\x.npy",
    "x.npy\0.txt",
    "x." + "a" * 300,
    "~/.ssh/id",
    "con.npy ",
    "‮ypn.exe",
    "x.n/../../y",
)


@pytest.fixture
def server(tmp_path, monkeypatch) -> Iterator[Server]:
    """A server of the fake lesson, whose pages keep files below the test's folder."""
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    server = Server(links.Place(fake.lesson, fake.Params(steps=2)))
    yield server
    server.stop()


class Page:
    """A page as the server sees one: its websocket, and what goes over HTTP beside it."""

    def __init__(self, server: Server, socket: Connection, token: str):
        self.server, self.socket, self.token = server, socket, token

    def say(self, **message) -> None:
        self.socket.send(json.dumps(message))

    def until(self, wanted) -> dict:
        while True:
            part = self.socket.recv(timeout=300)
            told = {} if isinstance(part, bytes) else json.loads(part)  # a scene comes as bytes
            if told and wanted(told):
                return told

    def give(
        self,
        content: bytes,
        name: str = "mine.npy",
        field: str = "scan",
        *,
        origin: str | None = None,
    ):
        return httpx.post(
            f"{self.server.address}/files/{self.token}/{field}",
            params={"name": name},
            content=content,
            headers={"origin": origin or self.server.address},
        )


@contextlib.contextmanager
def opened(server: Server, query: str = "") -> Iterator[Page]:
    answer = httpx.get(f"{server.address}/{query}", follow_redirects=True)
    token = re.findall('data-token="(.*?)"', answer.text)[0]
    address = f"ws://127.0.0.1:{server.port}/live?token={token}"
    with connect(address, origin=server.address) as socket:  # type: ignore[arg-type]
        page = Page(server, socket, token)
        page.say(verb="open", query="?" + answer.url.query.decode(), lesson="fake")
        page.until(lambda told: told["tell"] == "run" and told["finished"])
        yield page


def points(n: int) -> bytes:
    path = Path(tempfile.mkdtemp()) / "a.npy"
    np.save(path, np.eye(3)[np.arange(n) % 3])
    content = path.read_bytes()
    shutil.rmtree(path.parent)
    return content


def test_a_file_sets_its_field_stays_through_reset_and_goes_with_its_page(server, tmp_path):
    with opened(server) as page:
        assert page.give(points(7), "../scan of mine.npy").status_code == 204
        page.until(lambda told: told["tell"] == "run" and told["files"] == {"scan": "scan.npy"})
        page.until(lambda told: told["tell"] == "step" and "7 points" in told["step"]["caption"])
        page.say(verb="run", run="half")
        half = page.until(lambda told: told["tell"] == "run" and told["params"]["angle"] == 180.0)
        assert half["files"] == {"scan": "scan.npy"}
        page.say(verb="reset")
        assert page.until(lambda told: told["tell"] == "run" and told["name"] != "half")["files"]
        assert page.give(points(9)).status_code == 204  # in place of the one before
        page.until(lambda told: told["tell"] == "step" and "9 points" in told["step"]["caption"])
        assert [path.name for path in tmp_path.rglob("*.npy")] == ["scan.npy"]
        page.say(verb="forget", field="scan")
        page.until(lambda told: told["tell"] == "run" and told["files"] == {})
        page.until(lambda told: told["tell"] == "step" and "200 points" in told["step"]["caption"])
    gone(tmp_path)


def test_a_question_s_run_puts_a_file_aside_until_the_next_preset_or_reset(server, tmp_path):
    for verb, more in (
        ("reset", {}),
        ("run", {"run": "half"}),
        ("run", {"run": "default", "step": 0}),
    ):
        with opened(server) as page:
            assert page.give(points(7)).status_code == 204
            page.until(
                lambda told: told["tell"] == "step" and "7 points" in told["step"]["caption"]
            )
            page.say(verb="predict", question="end", given=None)
            aside = page.until(lambda told: told["tell"] == "run" and told["aside"])
            assert aside["files"] == {"scan": "scan.npy"}
            page.until(
                lambda told: told["tell"] == "step" and "200 points" in told["step"]["caption"]
            )
            page.say(verb=verb, **more)
            assert not page.until(lambda told: told["tell"] == "run")["aside"]
            page.until(
                lambda told: told["tell"] == "step" and "7 points" in told["step"]["caption"]
            )
    with opened(server) as page:
        assert page.give(points(7)).status_code == 204
        page.say(verb="predict", question="end", given=None)
        page.until(lambda told: told["tell"] == "run" and told["aside"])
        page.say(verb="forget", field="scan")  # for good
        assert not page.until(lambda told: told["tell"] == "run" and told["files"] == {})["aside"]
        page.say(verb="run", run="half")
        half = page.until(lambda told: told["tell"] == "run" and told["params"]["angle"] == 180.0)
        assert half["files"] == {}
        page.until(lambda told: told["tell"] == "step" and "200 points" in told["step"]["caption"])
    gone(tmp_path)


def gone(folder: Path) -> None:
    for _ in range(200):
        if not list(folder.iterdir()):
            return
        time.sleep(0.05)
    raise AssertionError(list(folder.rglob("*")))


@pytest.mark.parametrize("name", HOSTILE)
def test_a_name_is_never_a_path(server, tmp_path, name):
    with opened(server) as page:
        assert page.give(points(3), name).status_code in (204, 422)
        kept = [path for path in tmp_path.rglob("*") if path.is_file()]
        assert len(kept) == 1
        assert re.fullmatch(
            r"workbench-\w+/\d+/scan(\.[a-z0-9]{1,6}){0,2}", str(kept[0].relative_to(tmp_path))
        )


@pytest.mark.parametrize("field", ["angle", "nope", "__class__", "..", "%2e%2e%2fscan"])
def test_only_a_field_that_names_a_file_takes_one(server, tmp_path, field):
    with opened(server) as page:
        assert page.give(points(3), field=field).status_code in (404, 405, 422)
        assert not [path for path in tmp_path.rglob("*") if path.is_file()]


@pytest.mark.parametrize("with_length", [True, False])
def test_what_is_too_large_or_empty_is_refused_and_nothing_is_kept(
    server, tmp_path, monkeypatch, *, with_length
):
    monkeypatch.setattr(own_files, "MOST_BYTES", 100_000)
    content = bytes(150_000)
    with opened(server) as page:
        assert page.give(points(7)).status_code == 204
        answer = page.give(content if with_length else (content[i::10] for i in range(10)))  # type: ignore[arg-type]
        assert (answer.status_code, answer.text[:24]) == (422, "this file is larger than")
        assert page.give(b"").status_code == 422
        assert [path.stat().st_size < 1000 for path in tmp_path.rglob("*") if path.is_file()] == [
            True
        ]
        student = next(iter(server.students.values()))
        assert student.session is not None
        assert student.session.params.scan.read_bytes() == points(7)  # the one before stays


def test_another_origin_and_another_token_hand_over_nothing(server, tmp_path):
    with opened(server) as page:
        assert page.give(points(3), origin="http://evil.example").status_code in (403, 404)
        page.token = "0" * 24
        assert page.give(points(3)).status_code == 404
        assert not [path for path in tmp_path.rglob("*") if path.is_file()]


def test_files_of_the_command_line_stay_whatever_the_address_says(server, tmp_path):
    (tmp_path / "mine").mkdir()
    mine = tmp_path / "mine" / "cloud.npy"
    mine.write_bytes(points(11))
    own = Server(links.Place(fake.lesson, replace(fake.Params(steps=2), scan=mine)))
    try:
        for query in ("", "?lesson=fake&angle=30&step=1", "?lesson=fake&preset=half"):
            with opened(own, query) as page:
                student = own.students[page.token]
                assert student.session is not None
                assert student.session.params.scan == mine
                page.say(verb="change", values={"scan": "/etc/passwd", "angle": 31})
                told = page.until(
                    lambda told: told["tell"] == "run" and told["params"]["angle"] == 31
                )
                assert told["files"] == {"scan": "cloud.npy"}
                assert str(tmp_path) not in json.dumps(told)
        assert mine.exists()
    finally:
        own.stop()


@pytest.mark.parametrize("path", ["/etc/passwd", "../scan.npy", "", None, 7, ["a"], {"a": 1}])
@pytest.mark.parametrize(
    "verb", ["change", "open", "run", "predict", "forget", "seek", "reset", "pin"]
)
def test_no_verb_takes_a_path(server, verb, path):
    with opened(server) as page:
        page.say(
            verb=verb,
            values={"scan": path},
            scan=path,
            field="scan",
            run=path,
            k=path,
            question=path,
            query=f"?lesson=fake&scan={path}",
            lesson="fake",
            given=path,
        )
        page.say(verb="seek", k=1)
        page.until(lambda told: told["tell"] == "step" and told["k"] == 1)
        student = server.students[page.token]
        assert student.session is not None
        assert student.session.params.scan is None
