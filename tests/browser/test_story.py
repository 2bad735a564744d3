"""The story in a real browser: what is read stands on the stage, and the hand can take it."""

import re
from itertools import pairwise

import pytest

from tests.browser.homes import barriers
from tests.browser.story_walks import HELPERS, rests, walk

pytestmark = pytest.mark.browser
STANDS = (
    "page.run?.finished && storyStage.arrived === null && storyStage.is(page.run, storyStage.place)"
)

DRAWN = "$('#story-chart').offsetHeight > 0 && $('#story-chart svg').childElementCount > 3"


@pytest.fixture
def told(visit):
    """told(hash, **how): the story of pairs, open in a window, with its first picture."""

    def opened(place: str = "", **how):
        me = visit(f"?lesson=pairs{place}", **how)
        me.page.wait_for_function(STANDS)
        me.page.evaluate(HELPERS)
        return me

    return opened


@pytest.mark.parametrize("seed", range(20))
def test_stage_and_words_are_never_apart(told, seed):
    walk(told().page, seed, acts=14)


def test_an_address_opens_its_scene_and_back_goes_back(told):
    page = told("#mirror").page
    rests(page, "at the mirror")
    assert page.evaluate("story.scene.id") == "mirror"
    page.keyboard.press("]")
    page.wait_for_function("story.scene.id === 'scale' && location.hash === '#scale'")
    page.go_back()
    page.wait_for_function("story.scene.id === 'mirror'")
    rests(page, "back at the mirror")


def test_an_address_with_a_param_opens_the_workbench_and_w_the_story(visit):
    me = visit("?lesson=pairs&preset=mirrored&step=2")
    me.page.wait_for_function("page.run && page.k === 2")
    assert me.page.evaluate("page.face") == "bench"
    assert me.page.locator("#article").is_visible()
    me.page.keyboard.press("w")
    me.page.wait_for_function("page.face === 'story'")
    assert me.page.evaluate("[page.run.name, page.k, story.hand, story.scene.id]") == [
        "mirrored",
        2,
        True,
        "mirror",
    ]
    assert me.page.locator("#back").is_visible()
    me.page.evaluate(
        "document.body.style.overflowAnchor = 'none';"
        " story.here.el.style.marginTop = '2000px';"  # words are still being laid out
        " dispatchEvent(new Event('scroll')); story.measure()"
    )
    me.page.wait_for_timeout(600)
    assert me.page.evaluate("[page.run.name, page.k, story.hand]") == ["mirrored", 2, True]
    me.page.mouse.move(200, 400)
    me.page.mouse.wheel(0, 2500)
    me.page.wait_for_function("!story.hand")


def test_the_workbench_opens_on_the_same_run_and_step_without_a_reload(told):
    page = told().page
    page.evaluate("window.same = true")
    page.keyboard.press("n")
    rests(page, "a step on")
    run, k = page.evaluate("[page.run.id, page.k]")
    page.keyboard.press("w")
    page.wait_for_function("page.face === 'bench' && location.search.includes('step=')")
    assert page.evaluate("[page.run.id, page.k, window.same]") == [run, k, True]
    page.keyboard.press("n")
    page.wait_for_function(f"page.k === {k + 1}")
    page.go_back()
    page.wait_for_function("page.face === 'story'")


def test_a_number_is_a_slider_whose_step_is_seen(told):
    page = told().page
    number = page.locator("#story .num").first
    before = number.inner_text()
    number.focus()
    page.keyboard.press("ArrowRight")
    page.wait_for_function("story.hand && page.k === 41")
    assert number.get_attribute("aria-valuetext") == number.inner_text() != before
    page.keyboard.press("End")
    page.wait_for_function("page.k === page.known() - 1")
    page.keyboard.press("b")
    page.wait_for_function("!story.hand && page.k === 40")


def test_a_dragged_number_shows_its_step_at_once(told):
    page = told().page
    box = page.locator("#story .num").first.bounding_box()
    page.mouse.move(box["x"] + 20, box["y"] + 10)
    page.mouse.down()
    for k in range(1, 31):
        page.mouse.move(box["x"] + 20 + 3 * k, box["y"] + 10)
    page.mouse.up()
    page.wait_for_function("page.k === 70")
    seen = page.evaluate("storyChart.seen.get(storyStage.place.chart)")
    assert len(seen) == 1  # a quick hand leaves no holes in what has been visited
    assert page.locator("#story-chart path.whole").count() == 1


def test_the_chart_is_dragged_as_the_number_is(told):
    page = told().page
    box = page.locator("#story-chart").bounding_box()
    page.mouse.move(box["x"] + 100, box["y"] + 60)
    page.mouse.down()
    page.mouse.move(box["x"] + box["width"] - 16, box["y"] + 60)
    page.mouse.up()
    page.wait_for_function("story.hand && page.k >= page.known() - 2")


def test_a_question_is_asked_played_and_answered_and_stays_so(told):
    page = told().page
    form = page.locator("#story .ask").first
    later = page.locator("#story .scene").first.locator(".later").first
    assert not later.is_visible()
    assert form.locator(".go").is_disabled()
    form.locator("input").last.check()
    form.locator(".go").click()
    form.locator(".reply:not(:empty)").wait_for()
    assert form.locator("label.right").count() == 1
    assert later.is_visible()
    reply = form.locator(".reply").inner_text()
    page.reload()
    page.wait_for_function(STANDS)
    assert form.locator(".reply").inner_text() == reply
    assert later.is_visible()


def test_an_answer_plays_to_the_runs_own_end_and_other_starts_have_their_chart(visit):
    page = visit("?lesson=icp#space").page
    page.wait_for_function(STANDS)
    page.evaluate(HELPERS)
    form = page.locator("#space .ask")
    form.locator("[data-skip]").click()
    form.locator(".reply:not(:empty)").wait_for()
    rests(page, "the answer")
    assert page.evaluate("[page.run.name, page.k === page.run.end]") == ["far", True]
    assert "comes to rest" in page.locator("#caption").inner_text()
    page.locator("#space .later").last.scroll_into_view_if_needed()
    page.evaluate("scrollBy(0, 400)")
    page.wait_for_function("page.run?.finished && page.k === page.known() - 1")
    rests(page, "other starts")
    assert "error of the end (°)" in page.locator("#story-chart svg").inner_html()


@pytest.mark.parametrize(
    ("scene", "seen"),
    [
        ("curvature#paper", ["paper", 10]),  # back from a flat ring to an overlap
        ("curvature#area", ["double", 8]),  # another run's picture
        ("pinhole#divide", ["dolly", 4]),
    ],
)
def test_an_answer_is_seen_where_its_own_run_shows_it(visit, scene, seen):
    page = visit(f"?lesson={scene}").page
    page.wait_for_function(STANDS)
    page.evaluate(HELPERS)
    form = page.locator(f"#{scene.split('#')[1]} .ask").first
    before = page.evaluate("[page.run.name, page.k]")
    form.locator("[data-skip]").click()
    form.locator(".reply:not(:empty)").wait_for()
    rests(page, "the answer")
    after = page.evaluate("[canonical(page.run.name), page.k]")
    assert after == seen
    assert after != before


def test_a_pick_says_on_the_stage_what_it_is_and_b_gives_it_back(told):
    page = told("#mirror").page
    assert not page.locator("#mirror .pick").first.is_visible()  # it would show the answer
    page.locator("#mirror [data-skip]").click()
    page.locator("#mirror .pick").first.click()
    page.wait_for_function("story.hand && $('#plate b').textContent")
    assert (
        page.locator("#plate b")
        .inner_text()
        .startswith(page.locator("#mirror .what-if h3").first.inner_text())
    )
    assert page.locator("#mirror .pick[aria-pressed=true]").count() == 1
    page.keyboard.press("b")
    page.wait_for_function("!story.hand && !$('#plate b').textContent")
    assert page.locator("#mirror .pick[aria-pressed=true]").count() == 0


def test_nothing_is_wider_than_a_phone_and_the_stage_stays_in_view(told):
    page = told(width=390, height=844).page
    for _ in range(page.evaluate("story.scenes.length")):
        assert page.evaluate("document.documentElement.scrollWidth") <= 390
        stage = page.locator("#side").bounding_box()
        assert (stage["y"], round(stage["height"])) == (0, round(0.52 * 844))
        page.keyboard.press("]")
        rests(page, "on a phone")


@pytest.mark.parametrize("dark", [False, True])
def test_nobody_is_kept_out(told, dark):
    me = told()
    me.page.evaluate("dark => page.theme(dark)", dark)
    assert barriers(me.page.main_frame) == []


@pytest.mark.parametrize(
    ("value", "shown"), [(426.0, "426"), (1250.0, "1,250"), (0.0123456, "0.012"), (-35.7, "−36")]
)
def test_the_end_of_a_series_keeps_its_whole_number(told, value, shown):
    y = {"low": -40, "high": 1300, "ticks": [0], "words": ["0"]}
    series = {"chart": "a", "name": "a", "values": [0, value], "color": "source", "unit": ""}
    drawn = told().page.evaluate(
        "([run, room]) => seriesRow(run, 'a', room).join('')",
        [
            {"series": [series], "charts": {"a": {"y": y, "yLabel": ""}}},
            {"w": 600, "top": 10, "height": 120, "k": 1, "end": 1, "last": True},
        ],
    )
    assert shown in re.findall(r'class="value over"[^>]*>([^<]*)<', drawn)


def test_the_ends_of_series_stand_in_the_chart_and_apart(told):
    y = {"low": 0, "high": 0.4, "ticks": [0], "words": ["0"]}
    pair = [("dots", 0.0001), ("places", 0.0066)]
    series = [
        {"chart": "a", "name": name, "values": [0.3, end], "color": "source", "unit": "m²"}
        for name, end in pair
    ]
    boxes = told().page.evaluate(
        """([run, room]) => {
          const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
          svg.innerHTML = seriesRow(run, "a", room).join("");
          $("#story-chart").replaceChildren(svg);
          return [...svg.querySelectorAll(".value")].map((word) => word.getBBox())
            .map(({ x, y, width, height }) => [x + width, y, y + height]);
        }""",
        [
            {"series": series, "charts": {"a": {"y": y, "yLabel": ""}}},
            {"w": 600, "top": 10, "height": 120, "k": 1, "end": 1, "last": True},
        ],
    )
    (right, top, low), (other_right, other_top, other_low) = boxes
    assert max(right, other_right) <= 600
    assert other_low <= top + 3 or low <= other_top + 3


def test_a_chart_is_never_named_by_a_unit_alone(told):
    page = told().page
    titles = page.evaluate(
        "['rad', 'm', 'error (%)', ''].map((yLabel) => named({ title: 'Sum', yLabel }))"
    )
    assert titles == ["Sum (rad)", "Sum (m)", "error (%)", "Sum"]


def test_every_chart_that_is_named_is_drawn_and_answers_end_where_the_run_does(visit):
    """ICP tries other starts behind its own end: what is told of these is seen there only."""
    page = visit("?lesson=icp").page
    page.wait_for_function(STANDS)
    places = page.evaluate("story.beats.map((beat) => beat.place)")
    starts = page.evaluate("Object.values(STORY.starts)")
    answers = [start["seen"] for start in starts]
    seen = []
    for place in {repr(spot): spot for spot in (*places, *answers)}.values():
        page.evaluate("place => storyStage.go({ ...place, from: undefined })", place)
        page.wait_for_function(STANDS)
        if place.get("chart"):
            page.wait_for_function(DRAWN)
            seen.append(place["chart"])
    assert {"final-rotation-error", "error-of-the-turn"} <= set(seen)
    for answer in answers:
        page.evaluate("place => storyStage.go(place)", answer)
        page.wait_for_function(STANDS)
        if answer["step"] == "stop":
            assert page.evaluate("page.k === (page.run.end ?? page.known() - 1)"), answer


def test_the_places_of_a_slider_stand_apart_and_a_comma_stays_with_its_number(visit):
    page = visit("?lesson=chamfer_emd#price").page
    page.wait_for_function(STANDS)
    page.wait_for_function("$('#marks').childElementCount > 1")
    boxes = page.evaluate(
        "$$('#marks button').map((e) => e.getBoundingClientRect()).map((r) => [r.left, r.right])"
    )
    assert len(boxes) >= 3
    assert all(end <= start for (_, end), (start, _) in pairwise(boxes))
    assert page.evaluate(
        "$$('#story .num[role=slider]').filter((e) => /^[,.;:]/.test(e.nextSibling?.data ?? ''))"
        ".every((e) => getComputedStyle(e.parentElement).whiteSpace === 'nowrap')"
    )
    assert page.locator("#story .together").count() > 0
