"""The recipes of docs/serving, as they stand there: nginx before one server and before several, and
the container's.
"""

import asyncio
import contextlib
import json
import os
import re
import shutil
import socket
import subprocess
import sys
import time
import tomllib
from collections.abc import Iterator
from pathlib import Path
from urllib.parse import urlsplit

import httpx
import numpy as np
import pytest

from tests.fake_page import FakePage
from tests.loops import run_apart
from workbench.commands import watching
from workbench.lesson import catalog
from workbench.run import flags
from workbench.run.timeline import Timeline
from workbench.viewer.server import Server

ROOT = Path(__file__).parents[2]
RECIPES = ROOT / "docs" / "serving"
NGINX = shutil.which("nginx") or shutil.which("nginx", path="/usr/sbin")
NAME = "class.example.org"

needs_nginx = pytest.mark.skipif(
    NGINX is None, reason="no nginx here (Debian: apt-get install nginx-light)"
)


@contextlib.contextmanager
def nginx(folder: Path, http: str, location: str) -> Iterator[int]:
    """Run nginx with these parts of its configuration; the value is its port."""
    with socket.create_server(("127.0.0.1", 0)) as free:
        port = free.getsockname()[1]
    places = "".join(
        f"{kind}_temp_path {folder}/{kind};"
        for kind in ("client_body", "proxy", "fastcgi", "uwsgi", "scgi")
    )
    (folder / "nginx.conf").write_text(
        f"daemon off; pid {folder}/pid; error_log stderr; events {{}}\nhttp {{ access_log off;"
        f" {places}\n{http}\nserver {{ listen 127.0.0.1:{port};\n{location}\n}} }}\n"
    )
    assert NGINX is not None
    process = subprocess.Popen(
        [NGINX, "-p", str(folder), "-c", str(folder / "nginx.conf")], stderr=subprocess.PIPE
    )
    try:
        deadline = time.monotonic() + 30
        while True:
            assert process.poll() is None, process.stderr.read() if process.stderr else ""
            with contextlib.suppress(OSError), socket.create_connection(("127.0.0.1", port)):
                break
            assert time.monotonic() < deadline
            time.sleep(0.02)
        yield port
    finally:
        process.terminate()
        process.wait(30)
        if process.stderr:
            process.stderr.close()


@pytest.fixture(scope="module")
def server() -> Iterator[Server]:
    server = Server(behind=NAME)
    yield server
    server.stop()


@pytest.fixture
def site(server, tmp_path) -> Iterator[int]:
    location = (
        (RECIPES / "nginx.conf").read_text().replace("127.0.0.1:8080", f"127.0.0.1:{server.port}")
    )
    with nginx(tmp_path, "", location) as port:
        yield port


async def asked(port: int, path: str, host: str = NAME) -> tuple[int, dict[str, str], str]:
    reader, writer = await asyncio.open_connection("127.0.0.1", port)
    writer.write(f"GET {path} HTTP/1.1\r\nHost: {host}\r\nConnection: close\r\n\r\n".encode())
    head, _, body = (await reader.read()).partition(b"\r\n\r\n")
    writer.close()
    with contextlib.suppress(OSError):
        await writer.wait_closed()
    lines = head.decode().split("\r\n")
    headers = {
        name.lower(): value for name, _, value in (line.partition(": ") for line in lines[1:])
    }
    return int(lines[0].split()[1]), headers, body.decode(errors="replace")


def visitor(port: int, query: str = "") -> FakePage:
    headers = {"Host": NAME, "Origin": f"https://{NAME}"}
    return FakePage(f"http://127.0.0.1:{port}/workbench/", query, headers)


@needs_nginx
def test_behind_a_prefix_a_page_runs_and_a_link_leads_to_its_moment(site):
    lesson = catalog()["icp"]
    run = Timeline(lesson, lesson.params(start_angle=120.0))
    while len(run) < 6:
        run.extend()

    async def visit() -> None:
        page = await visitor(site, "?lesson=icp&start_angle=120&step=3").open()
        await page.until(lambda page: page.step.get("k") == 3 and page.scene_bytes > 0)
        assert page.step["step"]["caption"] == run[3].caption.text
        await page.seek(5)
        assert page.step["step"]["caption"] == run[5].caption.text
        await page.close()

    run_apart(visit())


@needs_nginx
def test_behind_a_prefix_every_address_of_a_page_leads_somewhere(site):
    async def visit() -> None:
        status, headers, _ = await asked(site, "/workbench?lesson=icp&step=3")
        assert (status, headers["location"]) == (301, "workbench/?lesson=icp&step=3")
        status, _, page = await asked(site, "/workbench/?lesson=icp")
        assert status == 200
        addresses = [
            address
            for address in re.findall(r'(?:src|href)="([^"]+)"', page)
            if not urlsplit(address).scheme
        ]
        files = {
            address.replace("&amp;", "&") for address in addresses if not address.startswith("#")
        }
        assert {"page/story-page.css", "page/live-story.js"} <= files
        for address in files:
            assert not address.startswith("/")
            assert (await asked(site, f"/workbench/{address}"))[0] == 200, address
        assert (await asked(site, "/workbench/scene/"))[0] == 200

    run_apart(visit())


@pytest.fixture(scope="module")
def jupyter(tmp_path_factory) -> Iterator[str]:
    """A Jupyter server with jupyter-server-proxy; the value is its address."""
    pytest.importorskip("jupyter_server_proxy")
    folder = tmp_path_factory.mktemp("jupyter")
    with socket.create_server(("127.0.0.1", 0)) as free:
        port = free.getsockname()[1]
    words = [
        "--no-browser",
        "--allow-root",
        "--ServerApp.ip=127.0.0.1",
        f"--ServerApp.port={port}",
        "--ServerApp.port_retries=0",
        f"--ServerApp.root_dir={folder}",
        "--IdentityProvider.token=",
        "--ServerApp.jpserver_extensions={'jupyter_server_proxy': True}",
    ]
    homes = {
        name: str(folder)
        for name in ("JUPYTER_CONFIG_DIR", "JUPYTER_RUNTIME_DIR", "JUPYTER_DATA_DIR", "IPYTHONDIR")
    }
    with subprocess.Popen(
        [sys.executable, "-m", "jupyter_server", *words],
        cwd=folder,
        env=os.environ | homes,
        stderr=subprocess.DEVNULL,
    ) as process:
        try:
            deadline = time.monotonic() + 120
            while True:
                assert process.poll() is None
                with contextlib.suppress(OSError), socket.create_connection(("127.0.0.1", port)):
                    break
                assert time.monotonic() < deadline
                time.sleep(0.1)
            yield f"http://127.0.0.1:{port}"
        finally:
            process.kill()


def test_behind_jupyter_a_page_runs_takes_a_file_and_gives_its_recording(jupyter, server):
    folder = f"{jupyter}/proxy/{server.port}/"
    lesson = catalog()["icp"]
    run = Timeline(lesson, lesson.params(start_angle=120.0))
    while len(run) < 6:
        run.extend()
    scan = b"\n".join(
        b"%f %f %f" % tuple(p) for p in np.random.default_rng(0).normal(size=(200, 3))
    )

    async def visit() -> None:
        page = await FakePage(folder, "?lesson=icp&start_angle=120&step=3").open()
        await page.until(lambda page: page.step.get("k") == 3 and page.scene_bytes > 1000)
        assert page.step["step"]["caption"] == run[3].caption.text
        await page.seek(5)
        assert page.step["step"]["caption"] == run[5].caption.text
        async with httpx.AsyncClient(base_url=folder, timeout=300) as browser:
            answer = await browser.get(f"recording/{page.token}")
            assert (answer.status_code, answer.content[:4]) == (200, b"RRF2")
            assert "icp" in answer.headers["content-disposition"]
            for field in ("source", "target"):
                sent = await browser.post(
                    f"files/{page.token}/{field}?name=scan.xyz",
                    content=scan,
                    headers={"Origin": jupyter},
                )
                assert sent.status_code == 204, sent.text
            await page.until(lambda page: {"source", "target"} <= set(page.run["files"]))
            document = (await browser.get("?lesson=icp")).text
            addresses = [
                address
                for address in re.findall(r'(?:src|href)="([^"]+)"', document)
                if not urlsplit(address).scheme
            ]
            for address in {
                address.replace("&amp;", "&")
                for address in addresses
                if not address.startswith("#")
            }:
                assert (await browser.get(address)).status_code == 200, address
            assert (await browser.get("scene/")).status_code == 200
        await page.close()

    run_apart(visit())


@needs_nginx
def test_behind_a_proxy_another_name_is_still_refused(site):
    async def visit() -> None:
        assert (await asked(site, "/workbench/", host="evil.example"))[0] == 403
        page = visitor(site, "?lesson=icp")
        page.headers["Origin"] = "https://evil.example"
        with pytest.raises(Exception, match="403"):
            await page.open()

    run_apart(visit())


@needs_nginx
def test_before_several_servers_a_page_and_its_scene_meet(tmp_path):
    servers = [Server(behind=NAME) for _ in range(2)]
    http = (RECIPES / "nginx-several.conf").read_text()
    for number, server in zip((8080, 8081), servers, strict=True):
        http = http.replace(f"127.0.0.1:{number}", f"127.0.0.1:{server.port}")
    location = (RECIPES / "nginx.conf").read_text().replace("127.0.0.1:8080", "workbench")

    async def visit(port: int) -> list[int]:
        pages = await asyncio.gather(
            *(visitor(port, "?lesson=transforms").open() for _ in range(12))
        )
        for page in pages:
            # a scene that nobody met is empty
            await page.until(lambda page: page.step and page.scene_bytes > 1000)
        shares = [len(server.students) for server in servers]
        await asyncio.gather(*(page.close() for page in pages))
        return shares

    try:
        with nginx(tmp_path, http, location) as port:
            shares = run_apart(visit(port))
    finally:
        for server in servers:
            server.stop()
    assert sum(shares) == 12
    assert min(shares) > 0


def test_a_page_that_is_only_read_stays_open():
    recipe = (RECIPES / "nginx.conf").read_text()
    assert "proxy_read_timeout 1h" in recipe
    assert "proxy_http_version 1.1" in recipe


def test_the_container_s_recipe_agrees_with_the_project():
    lines = [
        line
        for line in (RECIPES / "Dockerfile").read_text().splitlines()
        if line and not line.startswith("#")
    ]
    steps = [(line.split()[0], line.partition(" ")[2]) for line in lines]
    declared = tomllib.loads((ROOT / "pyproject.toml").read_text())
    project = declared["project"]
    build = declared["tool"]["hatch"]
    image = dict(steps)["FROM"]
    least = project["requires-python"].removeprefix(">=")
    version = re.fullmatch(r"python:(\d+\.\d+)-slim", image)
    assert version is not None
    assert tuple(map(int, version[1].split("."))) >= tuple(map(int, least.split(".")))
    copied = [word for kind, words in steps if kind == "COPY" for word in words.split()[:-1]]
    assert all((ROOT / name).exists() for name in copied)
    carried = build["build"]["targets"]["wheel"]
    assert {
        *carried["packages"],
        *carried["force-include"],
        *(name for name in project["license-files"] if "/" not in name),
        build["metadata"]["hooks"]["custom"]["path"],
        "pyproject.toml",
        "README.md",
    } <= set(copied)
    sent = {
        line.removeprefix("!")
        for line in (ROOT / ".dockerignore").read_text().splitlines()
        if line.startswith("!")
    }
    assert sent == set(copied)
    kinds = [kind for kind, _ in steps]
    user = dict(steps)["USER"]
    assert int(user) > 0, "not root, and a number, which a cluster can check"
    assert any(
        kind == "RUN" and words.startswith("useradd") and f"--uid {user} " in words
        for kind, words in steps
    )
    assert kinds.index("USER") < kinds.index("ENTRYPOINT")
    command = json.loads(dict(steps)["ENTRYPOINT"])
    assert command[0] in project["scripts"]
    called = flags.parse(watching.serve, command[1:], "workbench", description="")
    assert callable(called)
    assert command[command.index("--port") + 1] == dict(steps)["EXPOSE"]


def test_the_container_s_health_is_that_the_server_answers():
    line = next(
        line
        for line in (RECIPES / "Dockerfile").read_text().splitlines()
        if line.startswith("HEALTHCHECK")
    )
    words = json.loads(line.partition("CMD ")[2])
    assert words[:2] == ["python", "-c"]
    server = Server(host="0.0.0.0")
    try:
        assert server.rules.token is not None
        look = [sys.executable, "-c", words[2].replace("8080", str(server.port))]
        assert subprocess.run(look, check=False).returncode == 0
    finally:
        server.stop()
    assert subprocess.run(look, check=False, stderr=subprocess.DEVNULL).returncode == 1
