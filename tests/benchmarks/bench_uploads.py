"""Files that are made to cost much, handed to every knob that takes one, while somebody else steps.

    python -m tests.benchmarks.bench_uploads [--lessons icp ransac] [--files rows.xyz.gz]

Goals, on an idle machine: each is refused or shown within 3 s; a step of the other page takes below
200 ms; the server, with what it starts, grows by less than 500 MB.
"""

import argparse
import asyncio
import time
from collections.abc import Callable
from typing import Any

import httpx
import numpy as np

from tests.benchmarks.bench_class import Served, Waits, arrived, stepping
from tests.fake_page import FakePage
from tests.test_apart import LARGE
from workbench.knobs import paths_of
from workbench.lesson import course


def scattered() -> bytes:
    """Return as many points as a page takes, as text: read, and handed on to the lesson."""
    p = np.random.default_rng(0).normal(size=(500_000, 3))
    return b"".join(b"%.5f %.5f %.5f\n" % tuple(row) for row in p.tolist())


FILES: dict[str, Callable[[], bytes]] = {
    "rows.xyz.gz": LARGE["rows.xyz.gz"][0],
    "rows.csv": LARGE["rows.csv"][0],
    "scattered.xyz": scattered,
}
"""By name what is handed over."""


async def handed(page: FakePage, field: str, name: str, *, content: bytes) -> None:
    """Hand a file to a field of a page, and wait for what comes of it."""
    before = page.run["run"]
    page.step = {}
    async with httpx.AsyncClient(timeout=120) as client:
        address = f"{page.address}files/{page.token}/{field}"
        origin = {"Origin": page.headers["Origin"]}
        answer = await client.post(address, params={"name": name}, content=content, headers=origin)
        assert answer.status_code == 204, answer.text

    def shown(page: FakePage) -> bool:
        new = page.run["run"] != before or page.step.get("step", {}).get("tone") == "wrong"
        return bool(page.run["files"].get(field) and page.step) and new

    await page.until(shown, 20)


async def watched(server: Served, given: argparse.Namespace) -> None:
    """Print for each lesson and file what it cost."""
    contents = {name: FILES[name]() for name in given.files}
    walker = (await arrived(server, "?lesson=transforms"))[0]
    await walker.until(lambda page: page.run["finished"])
    print(f"{'lesson':16}{'file':16}{'seconds':>9}{'step ms':>9}{'grown MB':>10}  said")
    for name in given.lessons:
        fields = paths_of(course()[name].params)
        for file, content in contents.items():
            page = (await arrived(server, f"?lesson={name}"))[0]
            await page.until(lambda page: page.run["finished"], 300)
            for field in fields:
                waits = Waits()
                grown = [server.held()[1]]
                done = asyncio.Event()

                async def looking(grown: list[float] = grown, done: asyncio.Event = done) -> None:
                    while not done.is_set():
                        grown.append(await asyncio.to_thread(lambda: server.held()[1]))
                        await asyncio.sleep(0.3)

                look = asyncio.create_task(looking())
                step = asyncio.create_task(
                    stepping(walker, time.perf_counter() + 1e4, waits, every=0.05)
                )
                began = time.perf_counter()
                told: Any = "?"
                try:
                    await handed(page, field, file, content=content)
                    told = page.step.get("step", {}).get("caption", page.run.get("stopped", ""))
                except TimeoutError:
                    told = "nothing within 20 s"
                took = time.perf_counter() - began
                done.set()
                step.cancel()
                await look
                worst = max(waits.words, default=float("nan"))
                print(
                    f"{name:16}{file:16}{took:9.2f}{worst:9.0f}{max(grown) - grown[0]:10.0f} "
                    f" {field}: {str(told)[:90]}"
                )
            await page.close()
    await walker.close()


def main() -> None:
    """Run it."""
    with_files = [name for name, lesson in course().items() if paths_of(lesson.params)]
    parser = argparse.ArgumentParser(
        prog="python -m tests.benchmarks.bench_uploads", description=__doc__
    )
    parser.add_argument(
        "--lessons", nargs="+", default=with_files, choices=with_files, metavar="NAME"
    )
    parser.add_argument(
        "--files", nargs="+", default=list(FILES), choices=list(FILES), metavar="NAME"
    )
    given = parser.parse_args()
    server = Served(threads=2)
    try:
        asyncio.run(watched(server, given))
    finally:
        server.stop()


if __name__ == "__main__":
    main()
