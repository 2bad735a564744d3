"""A dragged number in the words of a story: the time until its step is shown, live and on a site.

    python -m tests.benchmarks.bench_story [--only icp pairs] [--moves 20]

Every number of a story that a hand can move is moved, a place at a time, as by its arrow keys.
The time is by the clock, from the key to what viser's client is handed; its drawing is not in it.
Each number of the live page is moved over ground that the server has not computed before, so that
computing is in it. `ratio` is live by site.
"""

import argparse
import contextlib
import functools
import http.server
import os
import tempfile
import threading
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np

from tests.browser.chrome import find_chromium, started
from workbench.lesson import catalog
from workbench.publish.site import publish
from workbench.story import has_story
from workbench.viewer.server import Server

GOALS = {"live": 100, "site": 30}
MOVED = """async ([index, moves]) => {
  const one = storyWords.numbers[index], go = storyStage.go, taken = [];
  let shown = null;
  storyStage.go = function (...given) { return (shown = go.apply(this, given)); };
  const within = (promise, ms) => Promise.race([promise, pausing(ms).then(() => null)]);
  try {
    one.el.scrollIntoView({ block: "center", behavior: "instant" });
    await pausing(1500);
    for (let i = 0; i < moves; i++) {
      const { at, count } = storyWords.dial(one), to = Math.round(at) + 1;
      const start = performance.now();
      shown = null;
      storyWords.go(one, to < count ? to : 0);
      const came = shown && await within(shown, 5000);
      if (came) taken.push(performance.now() - start);
      await pausing(30);
    }
  } finally { storyStage.go = go; }
  return [`${one.name} (${one.kind})`, taken];
}"""


def moved(chromium, address: str, moves: int) -> dict[str, list[float]]:
    """Return of each number of a story the milliseconds that its moves took."""
    page = chromium.new_page(viewport={"width": 1440, "height": 900})
    times: dict[str, list[float]] = {}
    try:
        page.goto(address)
        page.wait_for_function("storyStage.place && storyStage.arrived === null && page.step()")
        for index in range(page.evaluate("storyWords.numbers.length")):
            name, taken = page.evaluate(MOVED, [index, moves])
            times.setdefault(name, []).extend(taken)
    finally:
        page.context.close()
    return times


@contextlib.contextmanager
def sites(names: Sequence[str], python: str | None = None) -> Iterator[str]:
    """Publish lessons and serve them on this machine; yield the address.

    They compute where a folder with Python is named.
    """
    with tempfile.TemporaryDirectory() as folder:
        lessons = [catalog()[name] for name in names]
        publish(Path(folder), lessons, recordings="none", python=python)
        handler = functools.partial(Quiet, directory=folder)
        with http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler) as server:
            threading.Thread(target=server.serve_forever, daemon=True).start()
            yield f"http://127.0.0.1:{server.server_address[1]}"
            server.shutdown()


class Quiet(http.server.SimpleHTTPRequestHandler):
    """A file server that says nothing."""

    def log_message(self, format: str, *args: object) -> None:  # noqa: A002
        pass


def main() -> None:
    """Print the table."""
    told = [name for name, lesson in catalog().items() if has_story(lesson)]
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--moves", type=int, default=20)
    parser.add_argument("--only", nargs="*", default=told)
    given = parser.parse_args()
    if find_chromium() is None:
        print("no Chromium here: left out")
        return
    print(f"load of other work {os.getloadavg()[0]:.1f}; ms; goals for the median: {GOALS}")
    print(f"{'lesson':14}{'number':34}{'live':>7}{'p95':>7}{'site':>7}{'p95':>7}{'ratio':>7}")
    server = Server()
    try:
        with sites(given.only) as site, started() as chromium:
            for name in given.only:
                live = moved(chromium, f"{server.address}/?lesson={name}", given.moves)
                still = moved(chromium, f"{site}/{name}/", given.moves)
                for number, taken in live.items():
                    show(f"{name:14}{number:34}", taken, still.get(number, []))
    finally:
        server.stop()


def show(title: str, live: list[float], site: list[float]) -> None:
    """Print a row."""
    columns = [
        np.percentile(times, at) if times else np.nan for times in (live, site) for at in (50, 95)
    ]
    row = "".join(f"{column:7.0f}" for column in columns)
    print(f"{title}{row}{columns[0] / columns[2]:7.1f}", flush=True)


if __name__ == "__main__":
    main()
