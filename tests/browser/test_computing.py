"""A published page that computes, in a real browser held to the page's own policy: a knob, a
student's functions, a loop without end, and what it says where it cannot.
"""

import functools
import http
import http.server
import itertools
import threading
from collections.abc import Callable, Iterator
from typing import Any

import pytest

from tests.browser.folders import QuietHandler
from tests.computed.solutions import tasks_of
from workbench.exercise.finding import exercises_of
from workbench.lesson import catalog
from workbench.publish.site import publish
from workbench.run.timeline import Timeline

pytestmark = pytest.mark.browser
LESSON = catalog()["transforms"]
(TASK,) = exercises_of(LESSON)
TEXTS = {name: text for _, exercise, name, text in tasks_of(LESSON)}
FOREVER = "def invert_rigid(T_a_b):\n    while True:\n        pass\n"
ASKS = """\
from js import Object
import js

def invert_rigid(T_a_b):
    named = ("fetch", "WebSocket", "BroadcastChannel", "caches", "indexedDB", "Worker", "XMLHttpRequest")
    raise ValueError("reached: " + " ".join(n for n in named if hasattr(js, n)) + ".")
"""


class Handler(QuietHandler):
    """A static server that knows what it has sent."""

    def __init__(self, *args: Any, asked: list[str], **more: Any):
        self.asked = asked
        super().__init__(*args, **more)

    def log_request(self, code: Any = "-", size: Any = "-") -> None:
        if code == http.HTTPStatus.OK:
            self.asked.append(self.path)


@pytest.fixture(scope="module")
def out(tmp_path_factory, pyodide):
    """The folder above a site of one lesson that can compute."""
    out = tmp_path_factory.mktemp("computing")
    publish(out / "on" / "site", [LESSON], recordings="none", python=str(pyodide))
    return out


@pytest.fixture(scope="module")
def site(out) -> Iterator[tuple[str, list[str]]]:
    """Its address, under a path, and what it has sent."""
    asked: list[str] = []
    handler = functools.partial(Handler, directory=str(out), asked=asked)
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    yield f"http://127.0.0.1:{server.server_port}/on/site/transforms/index.html", asked
    server.shutdown()
    server.server_close()


@pytest.fixture(scope="module")
def context(chromium) -> Iterator[Any]:
    """One browser for all visits: what it keeps, it keeps from one to the next."""
    context = chromium.new_context(viewport={"width": 1280, "height": 800}, bypass_csp=False)
    yield context
    context.close()


@pytest.fixture(scope="module")
def page(context, site):
    """The lesson's workbench, and Python has come."""
    page = context.new_page()
    page.errors = errors = []
    page.on("pageerror", lambda error: errors.append(str(error)))
    page.goto(site[0])
    assert not any("/python/" in path for path in site[1]), "nothing comes by itself"
    began(page)
    page.keyboard.press("w")
    return page


@pytest.fixture
def bench(page):
    """The place where a student writes."""
    bench = page.locator(".bench")
    bench.wait_for()
    return bench


def began(page: Any) -> None:
    button = page.locator("button.compute:visible >> nth=0")
    button.get_by_text("Compute here: 28 MB once").click()
    page.locator("button.compute:visible >> nth=0", has_text="Python 3.").wait_for()


def run(page: Any, bench: Any, text: str) -> str:
    """Run a text as a student does, and return what the checks say."""
    written(page, bench, text)
    bench.get_by_role("button", name="Run").click()
    bench.locator(".report .count").wait_for()
    return bench.locator(".report").inner_text()


def written(page: Any, bench: Any, text: str) -> None:
    bench.locator(".cm-content").click()
    page.keyboard.press("Control+a")
    page.keyboard.insert_text(text)


def until(page: Any, true: Callable[[], bool]) -> None:
    """Wait for a state, as long as a slow machine needs: the page's policy lets Playwright watch
    nothing in it.
    """
    for _ in itertools.repeat(None, 3000):
        if true():
            return
        page.wait_for_timeout(50)
    raise AssertionError(page.locator("#caption").inner_text())


def test_a_knob_moves_to_any_value_and_says_what_python_says(page):
    page.keyboard.press("s")
    slider = page.locator("#drawer fieldset:not(:disabled) input[type=range]").first
    name = slider.locator("xpath=ancestor::fieldset").get_attribute("data-knob")
    slider.press("ArrowLeft")
    slider.press("ArrowLeft")
    until(
        page, lambda: page.evaluate("String(page.run.id).startsWith('here') && page.run.finished")
    )
    page.locator("[data-act=last]").click()
    params = LESSON.validated(LESSON.params(**page.evaluate("page.run.params")))
    assert getattr(params, name) != getattr(LESSON.params(), name)
    steps = Timeline(LESSON, params).complete()
    until(page, lambda: page.locator("#caption").inner_text() == steps[-1].caption.text)
    assert page.locator("#count").inner_text() == f"{len(steps) - 1} / {len(steps) - 1}"
    page.keyboard.press("s")


def test_a_right_function_has_all_points_and_the_lesson_s_own_run(page, bench):
    right = next(text for name, text in TEXTS.items() if name.startswith("right_"))
    points = sum(check.points for check in TASK.checks if check.public)
    report = run(page, bench, right)
    assert f"{points:g} of {points:g} points" in report
    assert "✗" not in report
    until(page, lambda: page.evaluate("page.run.called === true && page.run.finished"))
    assert page.evaluate("page.run.mark") is None


def test_a_wrong_function_is_told_why_and_shows_its_first_difference(page, bench):
    wrong = next(text for name, text in TEXTS.items() if name.startswith("wrong_"))
    report = run(page, bench, wrong)
    assert "✗" in report
    assert any(mistake.sentence in report for mistake in TASK.mistakes)
    until(page, lambda: page.evaluate("page.run.mark !== null"))
    bench.get_by_role("button", name="Go to the first difference").click()
    until(page, lambda: page.evaluate("page.k === page.run.mark"))


def test_what_is_no_python_is_named_with_its_line(page, bench):
    assert "line 2" in run(page, bench, "def invert_rigid(T_a_b):\n    return (\n")


def test_a_student_s_code_reaches_neither_the_net_nor_what_a_browser_keeps(page, bench):
    assert "reached: ." in run(page, bench, ASKS)


def test_a_loop_without_end_is_ended_and_the_text_stays(page, bench):
    written(page, bench, FOREVER)
    bench.get_by_role("button", name="Run").click()
    bench.get_by_text("Still running.").wait_for()
    bench.get_by_role("button", name="Stop").click()
    bench.get_by_text("Stopped.").wait_for()
    page.locator("button.compute:visible >> nth=0", has_text="Python 3.").wait_for()
    until(page, lambda: page.evaluate("page.run.finished && page.run.called === null"))
    assert "while True" in bench.locator(".cm-content").inner_text()
    assert page.errors == []


def test_a_second_visit_loads_nothing_and_has_the_text(page, bench, site):
    written(page, bench, FOREVER)
    until(page, lambda: page.evaluate("kept.get(bench.key('invert_rigid'))") == FOREVER)
    address, asked = site
    del asked[:]
    again = page.context.new_page()
    again.goto(address)
    began(again)
    assert not [path for path in asked if "/python/" in path], "at most: still the same?"
    again.keyboard.press("w")
    assert "while True" in again.locator(".bench .cm-content").inner_text()
    again.close()


def test_a_page_from_a_disk_says_why_it_cannot_and_plays_on(context, out):
    page = context.new_page()
    page.goto((out / "on" / "site" / "transforms" / "index.html").as_uri())
    page.locator("button.compute:visible >> nth=0").click()
    page.locator(
        "output.why:visible >> nth=0", has_text="A browser lets no page compute"
    ).wait_for()
    assert page.locator("button.compute:visible >> nth=0").inner_text().startswith("Try again")
    page.close()


def test_a_browser_without_webassembly_is_told_so(chromium, site):
    page = chromium.new_page(bypass_csp=False)
    page.add_init_script("delete globalThis.WebAssembly")
    page.goto(site[0])
    page.locator("button.compute:visible >> nth=0").click()
    page.locator("output.why:visible >> nth=0", has_text="has no WebAssembly").wait_for()
    page.close()


def test_where_python_is_not_the_page_says_so_and_tries_again(chromium, out, site):
    (wasm,) = (out / "on" / "site" / "python").rglob("pyodide.asm.wasm")
    aside = wasm.rename(wasm.with_suffix(".aside"))
    page = chromium.new_page(bypass_csp=False)
    page.goto(site[0])
    page.locator("button.compute:visible >> nth=0").click()
    page.locator(
        "output.why:visible >> nth=0", has_text="pyodide.asm.wasm cannot be loaded (404)"
    ).wait_for()
    aside.rename(wasm)
    page.locator("button.compute:visible >> nth=0", has_text="Try again").click()
    page.locator("button.compute:visible >> nth=0", has_text="Python 3.").wait_for()
    assert not page.locator("output.why:visible >> nth=0").count()
    page.close()
