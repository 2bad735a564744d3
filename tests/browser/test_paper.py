"""A published page on paper, and where no script runs: what can do nothing is not there, and what
the stage would show is.
"""

import io
import re
from dataclasses import replace

import numpy as np
import pytest
from PIL import Image

from tests import fake
from tests.browser.folders import served
from tests.browser.homes import barriers
from tests.browser.visits import SELDOM
from tests.story.hill import lesson as hill
from workbench.publish.site import publish

pytestmark = pytest.mark.browser
FAKE = replace(fake.lesson, presets=fake.lesson.presets[:1])
PAGES = ("fake/index.html", "hill/index.html")
CONTROLS = "button, input, select, textarea, [role=slider]"
THERE = "source.open_ !== null"


@pytest.fixture(scope="module")
def address(tmp_path_factory):
    out = tmp_path_factory.mktemp("paper")
    publish(out, [FAKE, hill], recordings="none")
    with served(out) as address:
        yield address


@pytest.fixture
def opened(chromium, address):
    """opened(page, **how): a page of the site."""
    pages = []

    def new(name: str, until: str = "", **how):
        page = chromium.new_page(viewport={"width": 1280, "height": 800}, **how)
        pages.append(page)
        if until:
            page.add_init_script(SELDOM)
        page.goto(f"{address}/{name}")
        if until:
            page.wait_for_function(until)
        return page

    yield new
    for page in pages:
        page.close()


def seen(page, selector: str) -> list[str]:
    """Return the parts under a selector that are seen."""
    parts = page.locator(selector).all()
    return [
        part.evaluate("one => one.outerHTML.slice(0, 90)") for part in parts if part.is_visible()
    ]


@pytest.mark.parametrize("name", PAGES)
def test_paper_has_a_picture_and_a_chart_of_every_scene_dark_on_white(opened, name):
    page = opened(name, THERE, color_scheme="dark")
    assert page.locator("html[data-theme=dark]").count() == 1
    assert not page.locator(".still").first.is_visible()
    page.emulate_media(media="print")
    stills = page.locator(".still img")
    assert stills.count() >= 2
    for still in stills.all():
        still.scroll_into_view_if_needed()
        page.wait_for_function(
            "one => one.complete && one.naturalWidth > 0", arg=still.element_handle()
        )
        box = still.bounding_box()
        assert box["height"] > 0.5 * box["width"] > 100
    assert seen(page, "#side button, #side input, #side select, form button, form input") == []
    assert seen(page, "nav.top, #story-top, #dots, .picks, #bar, #scene, #tools") == []
    paper = page.evaluate("getComputedStyle(document.body).backgroundColor")
    ink = page.locator("h1:visible").first.evaluate("one => getComputedStyle(one).color")
    assert paper == "rgb(255, 255, 255)"
    assert max(map(int, re.findall(r"\d+", ink)[:3])) < 60
    shot = page.locator(".still img").first.screenshot()
    picture = np.asarray(Image.open(io.BytesIO(shot)).convert("RGB")).astype(int)
    high = picture.shape[0]
    for part in (picture[: high // 2], picture[int(0.78 * high) :]):  # the picture, and the chart
        assert (part.min(-1) > 240).mean() > 0.5, "white"
        assert (np.ptp(part, axis=-1) > 60).sum() > 40, "drawn in colours"


def test_a_story_is_printed_whole(opened):
    page = opened("hill/index.html", THERE)
    data = page.pdf(format="A4", print_background=True)
    assert data.startswith(b"%PDF")
    assert len(re.findall(rb"/Subtype\s*/Image", data)) >= 2, "pictures that were not looked at yet"


@pytest.mark.parametrize("name", [*PAGES, "index.html", "fake/runs/half.html"])
def test_without_a_script_nothing_dead_is_shown_and_a_sentence_says_why(opened, name):
    page = opened(name, java_script_enabled=False)
    assert seen(page, CONTROLS) == []
    words = page.locator("noscript .unscripted")
    assert words.count() == 1
    assert words.is_visible()
    assert "JavaScript" in words.inner_text()
    assert page.locator("h1:visible").count() == 1
    assert page.locator("img:visible, svg:visible").count() >= 1
    links = [
        anchor for anchor in page.locator("a:visible").all() if anchor.get_attribute("data-run")
    ]
    for link in links:
        assert link.evaluate("one => getComputedStyle(one).pointerEvents") == "none"


@pytest.mark.parametrize("name", PAGES)
def test_without_a_script_the_pictures_of_the_text_are_there(opened, name):
    page = opened(name, java_script_enabled=False)
    first = page.locator(".still img").first
    assert first.is_visible()
    first.scroll_into_view_if_needed()
    assert first.bounding_box()["height"] > 100
    assert page.locator("#view img").is_visible()


@pytest.mark.parametrize("missing", ["nope.html", "fake/nope", "fake/runs/deep/er/nope"])
def test_a_page_that_is_missing_looks_like_the_course_and_leads_home(opened, address, missing):
    page = opened(missing)
    assert page.locator("h1").inner_text() == "This page is not here"
    family = page.locator("h1").evaluate("one => getComputedStyle(one).fontFamily")
    assert "Story Serif" in family
    page.get_by_role("link", name="To the course").click()
    page.wait_for_url(f"{address}/index.html")
    assert page.locator("[data-card]").count() == 2


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("name", ["notices.html", "404.html"])
def test_no_barrier_in_pages_of_words(opened, name, scheme):
    page = opened(name, "document.documentElement.dataset.theme", color_scheme=scheme)
    assert barriers(page) == []
