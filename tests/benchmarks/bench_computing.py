"""A published page that computes: Python's coming, a knob's first step, Stop and a second visit.

    python -m tests.benchmarks.bench_computing [--lessons icp:start_angle:20:120] [--moves 20]

Processor time is that of all processes of the browser, by the system; memory is that of its largest
renderer. The site is served on this machine, so that the net costs nothing. A move is from the
value that changes to the step that the page has; its drawing is not in it. WORKBENCH_PYODIDE
names the folder of a Pyodide release; ../shared/pyodide without it.
"""

import argparse
import os
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from tests.benchmarks.bench_story import sites
from tests.browser.chrome import started

ROOT = Path(__file__).resolve().parents[2]
GOALS = {"first picture, CPU s": 13, "knob ms": 150, "stop s": 1, "MB": 700}
FIRST = """(async () => {
  const before = page.run?.id;
  source.change({});
  while (page.run?.id === before || !page.step()) await pausing(5);
})()"""
MOVED = """(async ([knob, values]) => {
  const taken = [];
  for (const value of values) {
    const start = performance.now(), before = page.run.id;
    source.change({ [knob]: value });
    while (page.run.id === before || !page.step()) await pausing(1);
    taken.push(performance.now() - start);
    await pausing(600);
  }
  return taken;
})"""


def children() -> Iterator[tuple[str, str]]:
    """Yield number and command line of every process that this one started, and theirs."""
    above = {}
    for name in filter(str.isdigit, os.listdir("/proc")):
        try:
            stat = Path(f"/proc/{name}/stat").read_text()
            above[name] = stat[stat.rindex(")") + 2 :].split()[1]
        except OSError:
            continue
    for name in above:
        ancestor = name
        while ancestor in above and ancestor != str(os.getpid()):
            ancestor = above[ancestor]
        if ancestor == str(os.getpid()) and name != ancestor:
            try:
                yield name, Path(f"/proc/{name}/cmdline").read_text()
            except OSError:
                continue


def processor() -> float:
    """Return the seconds of processor time of the browser so far."""
    spent = 0
    for name, command in children():
        if "chrom" in command:
            stat = Path(f"/proc/{name}/stat").read_text()
            fields = stat[stat.rindex(")") + 2 :].split()
            spent += int(fields[11]) + int(fields[12])
    return spent / os.sysconf("SC_CLK_TCK")


def memory() -> float:
    """Return the megabytes of the largest renderer."""
    sizes = [0.0]
    for name, command in children():
        if "type=renderer" in command:
            status = Path(f"/proc/{name}/status").read_text()
            sizes += [int(line.split()[1]) / 1024 for line in status.split("\n") if "VmRSS" in line]
    return max(sizes)


def began(page: Any) -> None:
    """Wait until Python has come that was asked for."""
    page.locator("button.compute:visible", has_text="Python 3.").wait_for()


def visited(context: Any, address: str, *, knob: str, values: list[float]) -> dict[str, float]:
    """Return what one visit took."""
    page = context.new_page()
    page.goto(address)
    page.wait_for_timeout(5000)
    spent = processor()
    start = time.monotonic()
    page.locator("button.compute:visible").click()
    began(page)
    page.evaluate(FIRST)
    figures = {"first picture, s": time.monotonic() - start}
    figures["first picture, CPU s"] = processor() - spent
    page.wait_for_timeout(4000)
    taken = page.evaluate(MOVED, [knob, values])
    figures["knob ms"] = float(np.median(taken))
    figures["95 %"] = float(np.quantile(taken, 0.95))
    figures["MB"] = memory()
    start = time.monotonic()
    page.evaluate("compute.stop()")
    figures["stop s"] = time.monotonic() - start
    began(page)
    figures["back s"] = time.monotonic() - start
    page.close()
    return figures


def main() -> None:
    """Visit each lesson twice with one browser and print what it took."""
    words = argparse.ArgumentParser(description=__doc__)
    words.add_argument("--lessons", nargs="*", default=["icp:start_angle:20:120"])
    words.add_argument("--moves", type=int, default=20)
    given = words.parse_args()
    python = os.environ.get("WORKBENCH_PYODIDE", str(ROOT.parent / "shared" / "pyodide"))
    named = [lesson.split(":") for lesson in given.lessons]
    print(f"load of other work {os.getloadavg()[0]:.1f}; goals: {GOALS}")
    with sites([name for name, *_ in named], python) as address, started() as chromium:
        for name, knob, low, high in named:
            context = chromium.new_context(viewport={"width": 1280, "height": 800})
            values = np.linspace(float(low), float(high), given.moves).tolist()
            for visit in ("first", "second"):
                figures = visited(context, f"{address}/{name}/index.html", knob=knob, values=values)
                told = ", ".join(f"{label} {value:.3g}" for label, value in figures.items())
                print(f"{name}, {visit} visit: {told}")
            context.close()


if __name__ == "__main__":
    main()
