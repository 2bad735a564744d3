"""A class at one live server: how long a student waits, and what the server spends.

    python -m tests.benchmarks.bench_class [--students 100] [--seconds 15] [--only mixed] [--threads
    2] [--lesson icp]

The server runs in processes of its own, the students, each a page and its scene, in this one.
"words" is from the wish to the last byte of the step's words, "scene" to the last byte of its
scene. CPU and memory are the server's (memory that its processes share is counted once). The
machine is the same for both, so the students' own work is in all times; the load average says what
else it did. "cost" is what one wish costs the server, one after the other: CPU time, which a busy
machine hardly changes.
"""

import argparse
import asyncio
import os
import subprocess
import sys
import time
from collections.abc import Awaitable, Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import psutil

from tests.fake_page import FakePage
from workbench.viewer.server import EMPTY

ROOT = Path(__file__).parents[2]
LESSONS = ("transforms", "pinhole", "icp", "ransac", "curvature", "disparity")
GOALS = {
    "one lesson": "p95 below 50 ms",
    "mixed, knobs": "median below 100 ms, p95 below 1 s",
    "mixed, their steps": "",
    "mixed, steps": "p95 below 50 ms",
    "mixed, new page": "below 500 ms",
    "alone, steps": "",
    "attacked, steps": "p95 below 100 ms",
    "attacked, new page": "",
    "alone, new page": "",
    "silent, steps": "as alone",
    "silent, new page": "as alone",
}
SERVE = """
import sys
from workbench.viewer import server
from workbench.viewer.serving import serve
made = server.SharedRuns
server.SharedRuns = lambda most_bytes: made(most_bytes, threads=int(sys.argv[1]))
serve(port=0, browser=False)
"""


@dataclass
class Waits:
    """What students waited, in ms."""

    words: list[float] = field(default_factory=list)
    scene: list[float] = field(default_factory=list)

    def add(self, words: float, scene: float = float("nan")) -> None:
        self.words.append(1000 * words)
        self.scene.append(1000 * scene)


class Served:
    """The server in processes of its own."""

    def __init__(self, threads: int):
        environment = os.environ | {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}
        self._process = psutil.Popen(
            [sys.executable, "-c", SERVE, str(threads)],
            cwd=ROOT,
            env=environment,
            text=True,
            stdout=subprocess.PIPE,
        )
        self.address = self._process.stdout.readline().strip()
        self.threads, self.memory = self.held()

    def held(self) -> tuple[int, float]:
        """Return threads, and MB in memory."""
        all_of_it = self._all()
        return (
            sum(process.num_threads() for process in all_of_it),
            sum(process.memory_full_info().pss for process in all_of_it) / 2**20,
        )

    def spent(self) -> tuple[float, float]:
        """Return seconds of a clock, and seconds of CPU."""
        times = [process.cpu_times() for process in self._all()]
        return time.perf_counter(), sum(used.user + used.system for used in times)

    def stop(self) -> None:
        self._process.terminate()
        self._process.wait(30)

    def _all(self) -> list[psutil.Process]:
        return [self._process, *self._process.children()]


async def arrived(server: Served, query: str) -> tuple[FakePage, float]:
    """Open a page; return it and the seconds until its first step."""
    began = time.perf_counter()
    page = await FakePage(server.address, query).open()
    await page.until(lambda page: bool(page.step))
    return page, page.came - began


async def class_of(server: Served, queries: list[str]) -> list[FakePage]:
    """Open many pages, ten at a time."""
    pages: list[FakePage] = []
    for i in range(0, len(queries), 10):
        came = await asyncio.gather(*(arrived(server, query) for query in queries[i : i + 10]))
        pages += [page for page, _ in came]
    return pages


async def stepping(page: FakePage, until: float, waits: Waits, *, every: float = 1.0) -> None:
    """Step on once in a while, from the first again at the end."""
    await asyncio.sleep(every * np.random.default_rng(id(page) % 2**31).uniform())
    while time.perf_counter() < until:
        began = time.perf_counter()
        k = page.step.get("k", 0) + 1
        waits.add(*await page.seek(k if k < page.run["known"] else 0))
        await asyncio.sleep(max(0.0, every - (time.perf_counter() - began)))


async def learning(
    page: FakePage, until: float, waits: tuple[Waits, Waits], *, rng: np.random.Generator
) -> None:
    """Once a second move one knob near its default, or, two times of three, step on; wait for what
    comes of it.
    """
    await asyncio.sleep(rng.uniform())
    while time.perf_counter() < until:
        began = time.perf_counter()
        if rng.uniform() < 2 / 3:
            k = page.step.get("k", 0) + 1
            waits[1].add(*await page.seek(k if k < page.run["known"] else 0))
        elif await one_knob(page, rng):
            waits[0].add(page.came - began, max(0.0, page.scene_came - began))
        await asyncio.sleep(max(0.0, 1.0 - (time.perf_counter() - began)))


async def one_knob(page: FakePage, rng: np.random.Generator) -> bool:
    """Move one knob near its default and wait for what comes of it; tell whether it moved."""
    knobs = [
        knob for knob in page.knobs if knob["kind"] in ("float", "int") and not knob["parts"][1:]
    ]
    knob = knobs[rng.integers(len(knobs))]
    near = float(knob["default"]) + 0.1 * (knob["high"] - knob["low"]) * rng.uniform(-1, 1)
    value = float(np.clip(near, knob["low"], knob["high"]))
    if knob["kind"] == "int":
        value = int(knob["low"] + knob["step"] * round((value - knob["low"]) / knob["step"]))
    if value == page.run["params"][knob["name"]]:
        return False
    await page.change(knob["name"], value)
    return True


async def one_lesson(server: Served, given: argparse.Namespace) -> dict[str, Waits]:
    """All on one lesson, stepping once a second."""
    waits = {"one lesson": Waits()}
    pages = await class_of(server, [f"?lesson={given.lesson}"] * given.students)
    await asyncio.gather(*(page.until(lambda page: page.run["finished"]) for page in pages))
    await measured(
        server,
        given,
        [lambda end, page=page: stepping(page, end, waits["one lesson"]) for page in pages],
    )
    await asyncio.gather(*(page.close() for page in pages))
    return waits


async def mixed(server: Served, given: argparse.Namespace) -> dict[str, Waits]:
    """All on mixed lessons, doing something once a second; beside them one who only steps, and new
    pages.
    """
    waits = {
        name: Waits()
        for name in ("mixed, knobs", "mixed, their steps", "mixed, steps", "mixed, new page")
    }
    learned = waits["mixed, knobs"], waits["mixed, their steps"]
    names = given.lessons
    pages = await class_of(
        server, [f"?lesson={names[i % len(names)]}" for i in range(given.students)]
    )
    walker = (await arrived(server, "?lesson=transforms"))[0]
    await walker.until(lambda page: page.run["finished"])
    tasks: list[Callable[[float], Awaitable[None]]] = [
        lambda end, page=page, i=i: learning(page, end, learned, rng=np.random.default_rng(i))
        for i, page in enumerate(pages)
    ]
    tasks += [lambda end: stepping(walker, end, waits["mixed, steps"], every=0.25)]
    tasks += [lambda end: coming(server, "?lesson=transforms", end, waits=waits["mixed, new page"])]
    await measured(server, given, tasks)
    await asyncio.gather(*(page.close() for page in (*pages, walker)))
    return waits


async def silent(server: Served, given: argparse.Namespace) -> dict[str, Waits]:
    """One who steps, alone; then beside 30 browsers that say nothing and 30 that reload all the
    time.
    """
    waits = {
        name: Waits()
        for name in ("alone, steps", "alone, new page", "silent, steps", "silent, new page")
    }
    walker = (await arrived(server, "?lesson=transforms"))[0]
    await walker.until(lambda page: page.run["finished"])

    def walking(which: str) -> list[Callable[[float], Awaitable[None]]]:
        return [
            lambda end: stepping(walker, end, waits[f"{which}, steps"], every=0.25),
            lambda end: coming(
                server, "?lesson=transforms", end, waits=waits[f"{which}, new page"]
            ),
        ]

    await measured(server, given, walking("alone"))
    quiet = [await walker.socket(f"live?token={i:024x}") for i in range(30)]

    async def reloading(end: float) -> None:
        while time.perf_counter() < end:
            page = await FakePage(server.address, "?lesson=icp").open(read=False)
            await asyncio.sleep(2.0)
            page.live.transport.abort()

    await measured(server, given, [*(reloading for _ in range(30)), *walking("silent")])
    await asyncio.gather(*(socket.close() for socket in quiet), walker.close())
    return waits


async def attacked(server: Served, given: argparse.Namespace) -> dict[str, Waits]:
    """One who steps, alone; then beside the attackers, who have a process of their own."""
    waits = {name: Waits() for name in ("alone, steps", "attacked, steps", "attacked, new page")}
    walker = (await arrived(server, "?lesson=transforms"))[0]
    await walker.until(lambda page: page.run["finished"])
    await measured(
        server, given, [lambda end: stepping(walker, end, waits["alone, steps"], every=0.25)]
    )
    command = [
        sys.executable,
        "-m",
        "tests.benchmarks.attackers",
        server.address,
        str(given.seconds + 20),
    ]
    with psutil.Popen(command, cwd=ROOT, text=True, stdout=subprocess.PIPE) as attackers:
        while await asyncio.to_thread(attackers.stdout.readline) != "here\n":
            assert attackers.is_running()
        tasks: list[Callable[[float], Awaitable[None]]] = [
            lambda end: stepping(walker, end, waits["attacked, steps"], every=0.25),
            lambda end: coming(
                server, "?lesson=transforms", end, waits=waits["attacked, new page"]
            ),
        ]
        await measured(server, given, tasks)
        attackers.terminate()
        print(f"  sent in all: {(attackers.stdout.read().strip().splitlines() or [''])[-1]}")
    await walker.close()
    return waits


async def coming(server: Served, query: str, end: float, *, waits: Waits) -> None:
    """Open a new page now and then."""
    while time.perf_counter() < end:
        page, seconds = await arrived(server, query)
        waits.add(seconds)
        await page.close()
        await asyncio.sleep(1.0)


async def measured(
    server: Served, given: argparse.Namespace, tasks: list[Callable[[float], Awaitable[None]]]
) -> None:
    """Let all do their work at once, and note what the server spent."""
    began, cpu = server.spent()
    own = time.process_time()
    await asyncio.gather(*(task(began + given.seconds) for task in tasks))
    ended, spent = server.spent()
    seconds = ended - began
    given.spent = (
        (spent - cpu) / seconds,
        (time.process_time() - own) / seconds,
        server.held()[1],
        seconds,
    )


async def costs(server: Served, given: argparse.Namespace) -> None:
    """Print what one wish of each kind costs the server, one after the other."""
    steps_of, knobs_of = [], []
    for name in given.lessons:
        page, _ = await arrived(server, f"?lesson={name}")
        await page.until(lambda page: page.run["finished"], 300)
        rng = np.random.default_rng(0)
        known = min(page.run["known"], 20)
        began = server.spent()[1]
        for k in range(40):
            await page.seek((k + 1) % known)
        stepped = server.spent()[1]
        moved = sum([await one_knob(page, rng) for _ in range(20)])
        steps_of.append(1000 * (stepped - began) / 40)
        knobs_of.append(1000 * (server.spent()[1] - stepped) / max(1, moved))
        print(f"{name:<18} step {steps_of[-1]:6.1f} ms, moved knob {knobs_of[-1]:6.1f} ms of CPU")
        await page.close()
    began = server.spent()[1]
    for _ in range(10):
        await (await arrived(server, "?lesson=transforms"))[0].close()
    page_of = 100 * (server.spent()[1] - began)
    print(
        f"{'mean':<18} step {np.mean(steps_of):6.1f} ms, moved knob {np.mean(knobs_of):6.1f} ms; a"
        f" visit {page_of:.1f} ms\n"
    )


SCENARIOS: dict[str, Any] = {
    "cost": costs,
    "one": one_lesson,
    "mixed": mixed,
    "silent": silent,
    "attacked": attacked,
}


def afterwards(server: Served, at_work: float) -> tuple[int, float]:
    """Return threads and MB of the server when all have gone, and it has let go of what it held for
    them.
    """
    held = server.held()
    until = time.monotonic() + 3 * EMPTY
    while time.monotonic() < until and not (held[0] <= server.threads and held[1] < 0.9 * at_work):
        time.sleep(1.0)
        held = server.held()
    return held


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--students", type=int, default=100)
    parser.add_argument("--seconds", type=float, default=15.0)
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--lesson", default="icp", help="of those who are all on one")
    parser.add_argument("--only", nargs="+", choices=sorted(SCENARIOS), default=list(SCENARIOS))
    parser.add_argument(
        "--lessons",
        nargs="+",
        default=["transforms", "pinhole", "icp", "ransac", "curvature", "disparity"],
    )
    given = parser.parse_args()
    parts = f"one process with {given.threads} threads that compute each"
    print(f"{given.students} students, {parts}, {os.cpu_count()} cores\n")
    print(f"{'':<18} {'n':>6}   words ms: median    p95    max   scene p95   goal (words)")
    for name in given.only:
        before = os.getloadavg()[0]
        server = Served(given.threads)
        try:
            results = asyncio.run(SCENARIOS[name](server, given)) or {}
            threads, memory_after = afterwards(server, given.spent[2]) if results else (0, 0.0)
        finally:
            server.stop()
        for label, waits in results.items():
            words, scene = np.array(waits.words or [np.nan]), np.array(waits.scene or [np.nan])
            print(
                f"{label:<18} {len(waits.words):6d} {np.median(words):18.0f}"
                f" {np.quantile(words, 0.95):6.0f} {words.max():6.0f}"
                f" {np.quantile(scene, 0.95):11.0f}   {GOALS[label]}"
            )
        if not results:
            continue
        cores, ours, memory, seconds = given.spent
        each = 1000 * cores * seconds / max(1, sum(len(waits.words) for waits in results.values()))
        print(
            f"  server: {cores:.2f} cores, {each:.1f} ms for each wish; students: {ours:.2f} cores;"
            f" load before {before:.1f}, after {os.getloadavg()[0]:.1f}\n  memory:"
            f" {server.memory:,.0f} MB at the start, {memory:,.0f} at work, {memory_after:,.0f}"
            f" when all had gone; threads: {server.threads}, then {threads}\n",
            flush=True,
        )


if __name__ == "__main__":
    main()
