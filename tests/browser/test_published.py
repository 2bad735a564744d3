"""A published site from disk, in a real browser without any network."""

import functools
import http.server
import re
import threading
from dataclasses import replace

import numpy as np
import pytest
from axe_playwright_python.sync_playwright import Axe

from tests import fake
from workbench.lesson import catalog
from workbench.publish.site import publish
from workbench.timeline import Timeline

pytestmark = pytest.mark.browser


@pytest.fixture(scope="module")
def out(tmp_path_factory):
    """A site of all lessons: ICP and the small one with a preset and their questions, the others with one run each."""
    out = tmp_path_factory.mktemp("site")
    whole = [fake.lesson, catalog()["icp"]]
    alone = [lesson for lesson in catalog().values() if lesson not in whole]
    publish(
        out,
        [replace(lesson, presets=lesson.presets[:1]) for lesson in whole]
        + [replace(lesson, presets=(), questions=()) for lesson in alone],
    )
    return out


@pytest.fixture(scope="module")
def address(out):
    """The site behind a plain static server."""
    handler = functools.partial(QuietHandler, directory=str(out))
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    yield f"http://127.0.0.1:{server.server_port}"
    server.shutdown()
    server.server_close()


class QuietHandler(http.server.SimpleHTTPRequestHandler):
    def log_message(self, format, *args):  # noqa: A002
        pass


@pytest.fixture
def page(chromium):
    page = chromium.new_page(viewport={"width": 1280, "height": 800})
    trouble: list[str] = []
    page.on("console", lambda m: trouble.append(m.text) if m.type == "error" else None)
    page.on("pageerror", lambda error: trouble.append(str(error)))
    page.on("requestfailed", lambda request: trouble.append(f"failed: {request.url[:200]}"))
    page.on(
        "request",
        lambda r: (
            None if r.url.startswith(("file:", "data:", "blob:", "http://127.0.0.1:")) else trouble.append(r.url[:200])
        ),
    )
    yield page
    page.close()
    assert trouble == []


def barriers(page) -> list[tuple[str, str]]:
    """Return what axe calls serious on this page: the rule, and the first place that breaks it."""
    found = Axe().run(page, options={"iframes": False, "preload": False}).response["violations"]
    return [(v["id"], v["nodes"][0]["html"][:120]) for v in found if v["impact"] in ("serious", "critical")]


@pytest.mark.parametrize("file", ["index.html", "fake/index.html"])
def test_no_serious_barrier_for_anybody(page, address, file):
    page.goto(f"{address}/{file}")
    if file != "index.html":
        page.wait_for_function("document.querySelector('#caption').textContent.length > 10")
    assert barriers(page) == []


EVERY_STEP = """() => {
  const slider = document.querySelector("#step");
  return Array.from({length: Number(slider.max) + 1}, (_, k) => {
    slider.value = k;
    slider.dispatchEvent(new Event("input"));
    return [document.querySelector("#caption").textContent,
            [...document.querySelectorAll("#series figcaption")].map((one) => one.textContent)];
  });
}"""


def said(caption: str, head: str = "") -> dict[str, float]:
    """Return the numbers above the curves of a chart, by name."""
    return {
        found["name"]: float(found["value"].replace("−", "-").replace(",", ""))
        for part in caption.removeprefix(f"{head}: ").split(" · ")
        if (found := NAMED.match(part)) is not None
    }


NAMED = re.compile(r"(?P<name>.+?) (?P<value>−?[0-9.,]+(e−?[0-9]+)?)( \S+)?$")


@pytest.mark.parametrize("name", catalog())
def test_a_replay_plays_steps_back_and_shows_the_numbers_of_the_run(page, out, name):
    lesson = catalog()[name]
    timeline = Timeline(lesson, lesson.params()).complete()
    last = len(timeline) - 1
    page.set_viewport_size({"width": 640, "height": 400})  # fewer pixels are drawn sooner
    page.goto((out / name / "index.html").as_uri())
    page.frame_locator("#scene iframe").locator("canvas").first.wait_for()

    def shows(k: int) -> None:
        page.wait_for_function(
            "k => document.querySelector('#scene iframe').contentDocument.querySelector('input')?.value == k + 0.5",
            arg=k,
            polling=50,  # milliseconds; frames are slow without a graphics card
        )
        assert page.locator("#caption").inner_text() == timeline[k].caption.text

    page.get_by_role("button", name="First", exact=True).click()
    shows(0)
    page.keyboard.press("n")
    shows(1)
    page.keyboard.press("ArrowRight")
    shows(2)
    page.keyboard.press("p")
    shows(1)
    page.keyboard.press("End")
    shows(last)
    page.get_by_role("button", name="Back", exact=True).click()
    shows(last - 1)
    page.keyboard.press("p")
    shows(last - 2)
    page.locator("#speed").select_option("8")
    page.get_by_role("button", name="Play", exact=True).click()
    shows(last)
    page.get_by_role("button", name="Play", exact=True).wait_for()  # it stops at the end

    shown = page.evaluate(EVERY_STEP)
    assert [caption for caption, _ in shown] == [step.caption.text for step in timeline.known()]
    for k, (_, captions) in enumerate(shown):
        charts: dict[str, dict[str, float]] = {}
        for one in timeline.series().values():
            known = {one.scalar.name: one.values[k]} if np.isfinite(one.values[k]) else {}
            charts.setdefault(one.scalar.chart, {}).update(known)
        assert [said(caption, chart) for caption, chart in zip(captions, charts, strict=True)] == [
            pytest.approx(c, rel=0.0051) for c in charts.values()
        ]
    assert barriers(page) == []


@pytest.mark.parametrize("width", [1440, 390])
def test_a_run_further_down_is_brought_into_view_and_keeps_the_keys(page, out, width):
    page.set_viewport_size({"width": width, "height": 700})
    page.goto((out / "icp" / "index.html").as_uri())
    page.frame_locator("#scene iframe").locator("canvas").first.wait_for()
    page.locator("[data-run]").last.click()
    page.locator("[data-run][aria-pressed=true]").last.wait_for()
    page.wait_for_function("document.querySelector('#scene').getBoundingClientRect().top >= -1")
    page.frame_locator("#scene iframe").locator("canvas").first.wait_for()
    page.wait_for_function("document.activeElement.dataset.run !== undefined")
    before = page.evaluate("scrollY")
    page.keyboard.press("End")
    page.wait_for_function("document.querySelector('#step').value === document.querySelector('#step').max")
    assert page.evaluate("scrollY") == before


def test_a_question_is_answered_and_its_run_shown(page, out):
    page.goto((out / "fake" / "index.html").as_uri())
    form = page.locator("form.question").nth(1)
    form.get_by_label("the first").check()
    form.get_by_role("button", name="Answer", exact=True).click()
    form.locator("output", has_text="You said the first; the run says the second. The second is.").wait_for()
    number = page.locator("form.question").first
    number.get_by_role("button", name="Answer", exact=True).click()
    number.locator("output", has_text="type an answer first").wait_for()
    number.locator("input[type=number]").fill("0")
    number.get_by_role("button", name="Answer", exact=True).click()
    number.locator("output", has_text="Right").wait_for()


def test_replays_load_when_they_are_opened_and_not_before(page, out):
    loaded: list[str] = []
    page.on("request", lambda request: loaded.append(request.url.rsplit("/", 1)[-1]))
    page.goto((out / "fake" / "index.html").as_uri())
    page.locator("#caption", has_text="points turned").wait_for()
    assert "default.js" in loaded
    assert "half.js" not in loaded
    page.get_by_role("button", name="Half a turn").click()
    page.wait_for_function("document.querySelector('[data-run=half]').ariaPressed == 'true'")
    assert "half.js" in loaded
    assert loaded.count("viser.js") == 1


def test_one_run_alone_plays_too_and_pauses(page, out):
    page.goto((out / "icp" / "runs" / "default.html").as_uri())
    page.frame_locator("#scene iframe").locator("canvas").first.wait_for()
    page.keyboard.press("Home")
    page.get_by_role("button", name="Play", exact=True).click()
    page.get_by_role("button", name="Pause", exact=True).wait_for()
    page.wait_for_function("document.querySelector('#step').value >= 2", polling=50)
    page.get_by_role("button", name="Pause", exact=True).click()
    page.get_by_role("button", name="Play", exact=True).wait_for()
    paused = page.locator("#step").input_value()
    page.wait_for_timeout(1500)  # milliseconds; a step a second
    assert page.locator("#step").input_value() == paused


def test_a_phone_sees_the_scene_and_the_caption_without_scrolling_sideways(chromium, out):
    phone = chromium.new_page(viewport={"width": 390, "height": 844})
    phone.goto((out / "icp" / "index.html").as_uri())
    phone.wait_for_function("document.querySelector('#caption').textContent.length > 10")
    assert phone.evaluate("document.documentElement.scrollWidth") <= 390
    box = phone.locator("#caption").bounding_box()
    assert box is not None
    assert box["y"] < 844
    phone.close()
