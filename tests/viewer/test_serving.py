"""`workbench` and `show` as a shell sees them: the address, one port, a clean end."""

import gc
import signal
import socket
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import httpx
import pytest

from workbench.cli import main
from workbench.errors import InputError
from workbench.machinery.hosts import listening
from workbench.viewer.serving import serve

ROOT = Path(__file__).resolve().parents[2]


@contextmanager
def running(*words: str) -> Iterator[tuple[subprocess.Popen, str]]:
    command = [sys.executable, "-m", "workbench", *words, "--no-browser"]
    with subprocess.Popen(
        command, cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    ) as process:
        assert process.stdout is not None
        address = process.stdout.readline().strip()
        try:
            yield process, address
        finally:
            process.kill()


def test_the_course_is_served_at_the_address_that_is_printed_until_interrupted():
    with running("--port", "0") as (process, address):
        assert address.startswith("http://127.0.0.1:")
        answer = httpx.get(address)
        assert answer.status_code == 200
        assert answer.text.count('<li data-card="') >= 7
        port = address.rpartition(":")[2]
        done = subprocess.run(
            [sys.executable, "-m", "workbench", "show", "icp", "--no-browser", "--port", port],
            cwd=ROOT,
            capture_output=True,
            text=True,
            check=False,
        )
        assert done.returncode == 2
        assert done.stdout == ""
        assert (
            done.stderr
            == f"workbench: port {port} is in use: stop the other program, or choose another with"
            " --port (0 picks a free one)\n"
        )
        process.send_signal(signal.SIGINT)
        out, errors = process.communicate(timeout=300)
        assert (process.returncode, out, errors) == (0, "", "")


def test_a_lesson_opens_at_its_params_and_step_and_the_course_is_one_link_away(tmp_path):
    with running("show", "icp", "--start-angle", "120", "--step", "-1", "--port", "0") as (
        _,
        address,
    ):
        answer = httpx.get(f"{address}/")
        assert answer.headers["location"] == "?lesson=icp&start_angle=120&step=-1"
        assert "no-store" in answer.headers["cache-control"]
        page = httpx.get(f"{address}/?elsewhere=1", follow_redirects=True)
        assert str(page.url) == f"{address}/?lesson=icp&start_angle=120&step=-1&elsewhere=1"
        assert 'data-lesson="icp"' in page.text
        assert "workbench exercise align_rigid" in page.text
        assert 'href="?course"' in page.text
        assert 'data-card="icp"' in httpx.get(f"{address}/?course").text


@pytest.mark.parametrize(
    ("host", "port", "why"),
    [
        ("127.0.0.1", 70_000, "from 0 to 65535"),
        ("no.such.host.invalid", 0, "no address of this machine"),
    ],
)
def test_where_it_cannot_listen_is_said(host, port, why):
    with pytest.raises(InputError, match=why):
        listening(host, port)


def test_a_browser_is_opened_at_the_address_unless_told_otherwise(monkeypatch, capsys):
    opened: list[str] = []
    monkeypatch.setattr("webbrowser.open", opened.append)

    def interrupt() -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("workbench.viewer.serving.until_interrupted", interrupt)
    monkeypatch.setattr("workbench.viewer.serving.settle", lambda: None)  # this process goes on
    serve(port=0)
    assert opened == capsys.readouterr().out.split()
    assert main(["--port", "0", "--no-browser"]) == 0
    assert len(opened) == 1


def test_no_collection_of_garbage_looks_at_what_a_server_is_made_of(monkeypatch):
    left: list[int] = []
    before = gc.get_threshold()

    def interrupt() -> None:
        left.append(len(gc.get_objects()))
        raise KeyboardInterrupt

    monkeypatch.setattr("workbench.viewer.serving.until_interrupted", interrupt)
    try:
        serve(port=0, browser=False)
        assert gc.get_freeze_count() > 50_000 > 5 * left[0]
        assert gc.get_threshold() == (*before[:2], 10 * before[2]), "of the rest, one is rare"
    finally:
        gc.unfreeze()
        gc.set_threshold(*before)


@pytest.mark.parametrize("workers", [0, 2, 16])
def test_more_processes_than_one_are_refused_in_one_line_that_says_where_more_is_told(workers):
    with pytest.raises(
        InputError, match=rf"^--workers {workers}: one process .*docs/classroom.md$"
    ):
        serve(port=0, browser=False, workers=workers)


def test_a_taken_port_is_told_before_anything_is_started():
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        with pytest.raises(InputError, match="is in use"):
            listening("127.0.0.1", taken.getsockname()[1])
