"""A page without a browser: what one would say to the live server, and what comes back, with its
time.
"""

import asyncio
import contextlib
import json
import re
import time
from collections.abc import Callable
from typing import Any
from urllib.parse import urlsplit

import websockets


class FakePage:
    """One visit: the page is asked for, and its websocket opened. Scenes come as bytes and are
    counted.

    Args:
        address: Where the server is, up to the last slash, without a query.
        query: What stands behind it, with its `?`.
        headers: Of all requests, such as Host, Origin or Cookie; Origin is the server's own unless
            given.
    """

    def __init__(self, address: str, query: str = "", headers: dict[str, str] | None = None):
        self.address = address.rstrip("/") + "/"
        self.query = query
        self.headers = {"Origin": re.sub(r"^(https?://[^/]+).*", r"\1", address), **(headers or {})}
        self.run: dict[str, Any] = {}
        self.step: dict[str, Any] = {}
        self.told: list[dict[str, Any]] = []
        self.came = self.scene_came = 0.0  # when the last step came, and the last of the scene
        self.scene_bytes = self.bytes = 0
        self.gone = False
        self._news = asyncio.Event()
        self._reading: list[asyncio.Task] = []

    async def open(self, *, read: bool = True) -> "FakePage":
        """Open it as a browser does."""
        page = await self._page()
        self.lesson = re.findall(r'data-lesson="([^"]+)"', page)[0]
        self.knobs = json.JSONDecoder().raw_decode(page.partition("const LESSON = ")[2])[0]["knobs"]
        self.token = re.findall(r'data-token="([^"]+)"', page)[0]
        self.live = await self.socket(f"live?token={self.token}")
        await self.say(verb="open", query=self.query, lesson=self.lesson)
        if read:
            self._reading.append(asyncio.create_task(self._read_page()))
        return self

    async def _page(self) -> str:
        """Return the page; by hand, since a client that could do more would cost more than a
        page.
        """
        where = urlsplit(self.address)
        headers = {"Host": where.netloc, "Connection": "close"}
        headers |= {
            name: value for name, value in self.headers.items() if name in ("Host", "Cookie")
        }
        reader, writer = await asyncio.open_connection(where.hostname, where.port)
        lines = [
            f"GET {where.path}{self.query} HTTP/1.1",
            *(f"{k}: {v}" for k, v in headers.items()),
            "",
            "",
        ]
        writer.write("\r\n".join(lines).encode())
        head, _, body = (await reader.read()).partition(b"\r\n\r\n")
        writer.close()
        with contextlib.suppress(OSError):
            await writer.wait_closed()
        if head.split()[1] != b"200":
            raise ConnectionError(head.split(b"\r\n")[0].decode())
        return body.decode()

    async def socket(self, path: str, **options: Any) -> Any:
        """Open a websocket of this page."""
        headers = {
            name: value for name, value in self.headers.items() if name not in ("Origin", "Host")
        }
        server = urlsplit(self.address)
        address = f"ws{self.address.removeprefix('http')}{path}"
        if "Host" in self.headers:
            address = re.sub(r"//[^/]+", f"//{self.headers['Host']}", address)
        return await websockets.connect(
            address,
            host=server.hostname,
            port=server.port,
            origin=self.headers["Origin"] or None,  # type: ignore[arg-type]
            additional_headers=headers,
            max_size=None,
            compression=None,
            ping_interval=None,
            open_timeout=60,
            proxy=None,
            **options,
        )

    async def say(self, **message: Any) -> None:
        """Wish for something."""
        await self.live.send(json.dumps(message))

    async def until(self, holds: Callable[["FakePage"], object], seconds: float = 60.0) -> None:
        """Wait until something holds of this page; looked at whenever a message has come."""
        async with asyncio.timeout(seconds):
            while not holds(self):
                if self.gone:
                    raise ConnectionError("the server has closed this page's socket")
                self._news.clear()
                await self._news.wait()

    async def seek(self, k: int) -> tuple[float, float]:
        """Go to a step; return the seconds until its words had come, and until its scene had."""
        began = time.perf_counter()
        self.step = {}
        await self.say(verb="seek", k=k)
        await self.until(lambda page: page.step.get("k") == k)
        return self.came - began, max(self.scene_came - began, 0.0)

    async def change(self, name: str, value: Any, seconds: float = 300.0) -> None:
        """Move a knob, and wait for the first picture of the run that it asks for."""
        before = self.run["run"]
        await self.say(verb="change", values={name: value})
        await self.until(
            lambda page: page.run["run"] != before and page.step.get("run") == page.run["run"],
            seconds,
        )

    async def close(self) -> None:
        """Leave."""
        for task in self._reading:
            task.cancel()
        if hasattr(self, "live"):
            with contextlib.suppress(Exception):
                await self.live.close()

    async def _read_page(self) -> None:
        with contextlib.suppress(websockets.ConnectionClosed):
            async for part in self.live:
                if isinstance(part, bytes):
                    self.scene_bytes = self.scene_bytes + len(part)
                    self.scene_came = time.perf_counter()
                else:
                    self.bytes += len(part)
                    self._hear(json.loads(part))
                self._news.set()
        self.gone = True
        self._news.set()

    def _hear(self, message: dict[str, Any]) -> None:
        if message["tell"] == "run":
            self.run |= message
        elif message["tell"] == "step":
            self.step = message
            self.came = time.perf_counter()
        else:
            self.told.append(message)
