"""A run of a published site in a page of somebody else: its step, a part of it, again and again,
the picture alone, and a small frame.
"""

from dataclasses import replace

import pytest

from tests import fake
from tests.browser.folders import served
from tests.browser.visits import SELDOM
from workbench.publish.site import publish
from workbench.run.timeline import Timeline
from workbench.scene import Caption

pytestmark = pytest.mark.browser
WORDY = "Every word of this sentence is to be read in a small frame, up to the last of them. " * 3


def draw(state):
    """Say something long at the third step, and something short at the others."""
    scene = fake.draw(state)
    caption = scene["caption"]
    assert isinstance(caption, Caption)
    return {**scene, "caption": Caption(WORDY.strip())} if state.k == 2 else scene


LESSON = replace(fake.lesson, draw=draw, presets=fake.lesson.presets[:1], questions=())
THERE = (
    "source.open_ !== null && page.step()"
    " && !document.querySelector('#scene').hasAttribute('aria-busy')"
)


@pytest.fixture(scope="module")
def out(tmp_path_factory):
    out = tmp_path_factory.mktemp("embedded")
    publish(out, [LESSON], recordings="none")
    return out


@pytest.fixture(scope="module")
def address(out):
    with served(out) as address:
        yield address


@pytest.fixture
def opened(chromium, out, address):
    """opened(hash, **how): the run `half`, alone in a frame of a page."""
    pages, trouble = [], []

    def new(place: str = "", *, width: int = 480, height: int = 360, **how):
        page = chromium.new_page(**({"reduced_motion": "reduce"} | how))
        pages.append(page)
        page.add_init_script(SELDOM)
        page.on("pageerror", lambda error: trouble.append(str(error)))
        host = out / "host.html"
        host.write_text(
            f'<link rel="icon" href="data:,"><body style="margin:0"><iframe src="fake/runs/half.html{place}"'
            f' width="{width}" height="{height}" style="border:0"></iframe>'
        )
        page.goto(f"{address}/host.html")
        frame = page.main_frame.child_frames[0]
        frame.wait_for_function(THERE)
        return frame

    yield new
    for page in pages:
        page.close()
    assert trouble == []


RUN = Timeline(LESSON, LESSON.presets[0].params).complete()
LAST = len(RUN) - 1


@pytest.mark.parametrize(
    ("place", "step"),
    [
        ("#step=4", 4),
        ("#step=-1", LAST),
        ("#step=-2", LAST - 1),
        ("#step=9999999", LAST),
        ("#from=3&to=4", 3),
        ("#step=1&from=3&to=4", 3),
        ("#from=4&to=2", 4),
        ("#run=default&step=2", 2),
        *((f"#{wrong}", 0) for wrong in ("step=x", "step=1e3", "step=", "to=x", "to=1")),
    ],
)
def test_the_address_says_at_which_step_it_opens(opened, place, step):
    frame = opened(place)
    assert frame.evaluate("page.k") == (step or LESSON.presets[0].step or 0)
    assert int(frame.locator("#step").input_value()) == frame.evaluate("page.k")


def test_a_part_of_a_run_is_all_that_is_stepped_through(opened):
    frame = opened("#from=1&to=3")
    step = frame.locator("#step")
    assert (step.get_attribute("min"), step.get_attribute("max")) == ("1", "3")
    for act, k in (("last", 3), ("next", 3), ("first", 1), ("back", 1), ("next", 2)):
        frame.locator(f"[data-act={act}]").click()
        assert frame.evaluate("page.k") == k
    frame.locator("#speed").select_option("8")
    frame.locator("[data-act=play]").click()
    frame.wait_for_function("page.k === 3 && !transport.playing")
    frame.evaluate("page.seek(5)")
    assert frame.evaluate("page.k") == 3
    frame.evaluate("location.hash = 'from=0&to=2&step=2'")
    frame.wait_for_function("page.k === 2 && $('#step').max === '2'")


def test_a_loop_plays_by_itself_and_begins_anew_and_is_stopped(opened):
    frame = opened("#from=1&to=3&loop=1", reduced_motion="no-preference")
    frame.evaluate(
        "() => { window.seen = []; page.listeners.push({ drawn: () => seen.push(page.k) }); }"
    )
    frame.locator("#speed").select_option("8")
    frame.wait_for_function("seen.join().includes('3,1,2')")
    assert set(frame.evaluate("seen")) == {1, 2, 3}
    frame.locator("[data-act=play]").click()
    assert not frame.evaluate("transport.playing")


def test_a_loop_waits_to_be_started_where_motion_is_not_wanted(opened):
    frame = opened("#loop=1")
    assert not frame.evaluate("transport.playing")
    frame.locator("[data-act=play]").click()
    assert frame.evaluate("transport.playing")


@pytest.mark.parametrize(("place", "play"), [("#show=picture", 0), ("#show=picture&loop=1", 1)])
def test_the_picture_alone_has_nothing_around_it(opened, place, play):
    frame = opened(place)
    box = frame.locator("#scene").bounding_box()
    assert (box["width"], round(box["height"])) == (480, 360)
    for name in ("h1", "#tools", "#tiles", "#legend", "#step", "#count", "[data-act=next]"):
        assert not frame.locator(name).is_visible(), name
    assert frame.locator("[data-act=play]").is_visible() == bool(play)
    assert frame.locator("#caption").inner_text() == RUN[frame.evaluate("page.k")].caption.text
    assert frame.evaluate("document.documentElement.scrollHeight <= innerHeight")


def test_in_a_small_frame_no_word_is_cut_and_the_scene_keeps_its_size(opened):
    frame = opened("#step=0")
    heights = []
    for k in range(LAST + 1):
        frame.evaluate("k => page.seek(k)", k)
        words = frame.locator("#caption")
        assert words.inner_text() == RUN[k].caption.text
        box = words.bounding_box()
        assert box["y"] + box["height"] <= 360, k
        assert frame.evaluate("$('#caption').scrollHeight <= $('#caption').clientHeight"), k
        heights.append(frame.locator("#scene").bounding_box()["height"])
    assert min(heights) > 120
    assert max(heights) - min(heights) < 1
    assert frame.evaluate("document.documentElement.scrollHeight <= innerHeight")


def test_a_reload_finds_the_same_part_again(opened):
    frame = opened("#from=1&to=3&show=picture")
    frame.evaluate("page.seek(2)")
    assert frame.evaluate("location.hash") == "#run=half&from=1&to=3&show=picture&step=2"
    frame.evaluate("before = true, location.reload()")
    anew = "typeof before === 'undefined' && typeof page !== 'undefined'"
    frame.wait_for_function(f"{anew} && page.k === 2 && {THERE}")
    assert frame.evaluate("[page.from, page.to, document.body.className]") == [
        1,
        3,
        "alone picture",
    ]
