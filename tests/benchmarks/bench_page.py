"""Opening a lesson: the time to its text, caption and scene: `python -m
tests.benchmarks.bench_page`.

A new browser window each time, so nothing is kept from the last; the server has run the lesson
before. "text" is the browser's first paint of words, "caption" when a step is told, "scene" the
first picture that is drawn once the step's things have come to viser's client. "drawn" is the same
with the browser's software renderer; for "scene" WebGL takes all calls and does nothing, so that
what is left is the server's time and the scripts'. These are by the clock, so whatever else the
machine does is in them. "page" and "server" are the processor's time that the two have spent until
then (viser's client included, its drawing not), which on a machine with nothing else to do is about
the time to the scene.
"""

import argparse
import contextlib
import os
import time

import numpy as np
import psutil

from tests.browser.chrome import find_chromium, started
from workbench.lesson import catalog
from workbench.viewer.server import Server

COLUMNS = ("text", "caption", "scene", "drawn", "page", "server")
GOALS = {"text": 1000, "scene": 3000}
WATCH = """if (self === parent) {
  window.seen = {};
  new MutationObserver(() => {
    if (document.querySelector("#caption")?.textContent) seen.caption ??= performance.now();
  }).observe(document, { childList: true, subtree: true, characterData: true });
  let feed; // what the page says to viser's client
  Object.defineProperty(window, "feed", { configurable: true, get: () => feed, set(made) {
    feed = made;
    const say = made.say;
    made.say = function (data) {
      window.came ||= Boolean(data.messages?.some((one) => one.name?.startsWith("/scene/") && one.props));
      return say.call(this, data);
    };
  } });
} else if (location.pathname.includes("/scene/")) {
  const context = WebGL2RenderingContext.prototype;
  for (const draw of ["drawArrays", "drawElements", "drawArraysInstanced", "drawElementsInstanced"]) {
    const own = context[draw];
    context[draw] = function (...all) {
      if (parent.came) parent.seen.scene ??= parent.performance.now();
      return own.apply(this, all);
    };
  }
}"""  # noqa: E501
DRAWS_NOTHING = """if (self !== parent) {
  const context = WebGL2RenderingContext.prototype, { LINK_STATUS, COMPILE_STATUS } = WebGL2RenderingContext;
  for (const call of ["drawArrays", "drawElements", "drawArraysInstanced", "drawElementsInstanced", "clear", "compileShader",
    "linkProgram", "useProgram", "readPixels", "finish", "flush", "texImage2D", "texSubImage2D", "generateMipmap"]) {
    context[call] = () => {};
  }
  context.getProgramParameter = (_, what) => (what === LINK_STATUS ? true : 0);
  context.getShaderParameter = (_, what) => what === COMPILE_STATUS;
}"""  # noqa: E501


def opened(chromium, address: str, *, draws: bool) -> dict[str, float]:
    """Return the milliseconds until a page has its text, its caption and its scene."""
    page = chromium.new_page(viewport={"width": 1440, "height": 900})
    try:
        for script in (() if draws else (DRAWS_NOTHING,)) + (WATCH,):
            page.add_init_script(script)
        before = renderers()
        began = time.process_time()
        page.goto(address)
        page.wait_for_function("seen.caption && seen.scene", polling=100)
        server = 1000 * (time.process_time() - began)
        spent = 1000 * sum(seconds - before.get(pid, 0.0) for pid, seconds in renderers().items())
        painted = page.evaluate(
            "performance.getEntriesByName('first-contentful-paint')[0].startTime"
        )
        return {"text": painted, "page": spent, "server": server, **page.evaluate("seen")}
    finally:
        page.context.close()


def renderers() -> dict[int, float]:
    """Return the processor seconds of the browser's processes that run pages; its drawing is done
    by another.
    """
    seconds = {}
    for process in psutil.Process().children(recursive=True):
        with contextlib.suppress(psutil.Error):
            if "--type=renderer" in process.cmdline():
                seconds[process.pid] = sum(process.cpu_times()[:2])
    return seconds


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--times", type=int, default=3)
    parser.add_argument("--only", nargs="*", default=list(catalog()))
    given = parser.parse_args()
    if find_chromium() is None:
        print("no Chromium here: left out")
        return
    server = Server()
    try:
        with started() as chromium:
            opened(chromium, f"{server.address}/?lesson={given.only[0]}", draws=True)
            print(
                f"load of other work {os.getloadavg()[0]:.1f}; medians of {given.times}, ms; goals:"
                f" {GOALS}"
            )
            print(f"{'lesson':16}" + "".join(f"{key:>9}" for key in COLUMNS) + "   load")
            for name in given.only:
                address = f"{server.address}/?lesson={name}"
                opened(chromium, address, draws=False)  # the server has run it from here on
                still = [opened(chromium, address, draws=False) for _ in range(given.times)]
                drawn = [opened(chromium, address, draws=True) for _ in range(given.times)]
                medians = {key: np.median([visit[key] for visit in still]) for key in still[0]}
                medians["drawn"] = np.median([visit["scene"] for visit in drawn])
                print(
                    f"{name:16}"
                    + "".join(f"{medians[key]:9.0f}" for key in COLUMNS)
                    + f"   {os.getloadavg()[0]:.1f}",
                    flush=True,
                )
    finally:
        server.stop()


if __name__ == "__main__":
    main()
