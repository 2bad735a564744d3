"""A published site from disk, in a real browser without any network."""

import io
from dataclasses import replace

import numpy as np
import pytest
from PIL import Image

from tests import fake
from tests.browser.folders import served
from tests.browser.homes import barriers
from tests.browser.visits import SELDOM
from workbench.lesson import Sweep, catalog
from workbench.publish.site import publish
from workbench.run.timeline import Timeline
from workbench.scene import Points

pytestmark = pytest.mark.browser
FAKE = replace(
    fake.lesson,
    presets=(
        *fake.lesson.presets[:2],
        replace(fake.lesson.presets[0], name="still", params=fake.Params(angle=0.0, colors="role")),
    ),
    sweeps=(Sweep("angle", (0.0, 90.0, 180.0)),),
)
SCENE_IS_THERE = (
    "typeof source !== 'undefined' && source.open_ !== null"
    " && !document.querySelector('#scene').hasAttribute('aria-busy')"
)


@pytest.fixture(scope="module")
def out(tmp_path_factory):
    """A site of two lessons: the small one with presets, questions and a sweep, and ICP with one
    run.
    """
    out = tmp_path_factory.mktemp("site")
    icp = replace(catalog()["icp"], presets=(), questions=(), sweeps=(), page=None)
    publish(out, [FAKE, icp], recordings="all")
    return out


@pytest.fixture(scope="module")
def address(out):
    """The site behind a plain static server."""
    with served(out) as address:
        yield address


@pytest.fixture
def opened(chromium):
    """Opens pages; at the end none of them may have said an error, or asked another host."""
    pages, trouble = [], []

    def new(
        url: str,
        *,
        width: int = 640,
        height: int = 640,
        until: str = SCENE_IS_THERE,
        drawn: bool = False,
        **options,
    ):
        page = chromium.new_page(viewport={"width": width, "height": height}, **options)
        pages.append(page)
        if not drawn:
            page.add_init_script(SELDOM)
        page.on("console", lambda m: trouble.append(m.text) if m.type == "error" else None)
        page.on("pageerror", lambda error: trouble.append(str(error)))
        page.on(
            "requestfailed",
            lambda r: None if r.url.endswith(".rrd") else trouble.append(f"failed: {r.url[:200]}"),
        )
        ours = ("file:", "data:", "blob:", "http://127.0.0.1:")
        page.on(
            "request", lambda r: None if r.url.startswith(ours) else trouble.append(r.url[:200])
        )
        page.goto(url)
        if until:
            page.wait_for_function(until)
        return page

    yield new
    for page in pages:
        page.close()
    assert trouble == []


def caption(page) -> str:
    return page.locator("#caption").inner_text()


FRAMES = """() => new Promise((drawn) => {
  const { contentWindow } = stage.frame;
  let left = 6;
  const frame = () => left-- ? contentWindow.requestAnimationFrame(frame) : drawn();
  frame();
})"""


def seen(page) -> np.ndarray:
    """Return what the scene looks like at rest, in boxes of 8 x 8 pixels: where frames are slow
    viser draws coarsely.
    """
    before = None
    while True:
        page.evaluate(FRAMES)
        picture = np.asarray(
            Image.open(io.BytesIO(page.locator("#scene").screenshot())).convert("RGB")
        ).astype(int)
        if before is not None and np.array_equal(before, picture):
            height, width = (8 * (n // 8) for n in picture.shape[:2])
            return picture[:height, :width].reshape(height // 8, 8, width // 8, 8, 3).mean((1, 3))
        before = picture


def differs(a: np.ndarray, b: np.ndarray) -> bool:
    """Tell whether a box of two pictures is clearly another."""
    return bool(np.abs(a - b).max() > 40)


@pytest.mark.parametrize(
    ("file", "scheme"),
    [("index.html", "light"), ("index.html", "dark"), ("fake/index.html", "light")],
)
def test_no_serious_barrier_for_anybody(opened, address, file, *, scheme):
    page = opened(
        f"{address}/{file}",
        until="" if file == "index.html" else SCENE_IS_THERE,
        color_scheme=scheme,
    )
    assert barriers(page) == []


def test_any_step_looks_the_same_wherever_one_comes_from(opened, out):
    page = opened(
        f"{(out / 'fake' / 'index.html').as_uri()}#run=default&step=0",
        drawn=True,
        reduced_motion="reduce",
    )
    forward = []
    for k in range(6):
        page.evaluate("k => page.seek(k)", k)
        forward.append(seen(page))
    assert differs(forward[0], forward[5])
    for k in (5, 2, 4, 0, 1, 0, 3, 2, 5, 1):
        page.evaluate("k => page.seek(k)", k)
        assert not differs(seen(page), forward[k]), k
    page.evaluate("page.open('still', 0)")
    page.wait_for_function("source.open_.name === 'still'")
    assert differs(seen(page), forward[0])  # its cloud has another colour
    page.evaluate("page.open('default', 2)")
    page.wait_for_function("source.open_.name === 'default'")
    assert not differs(seen(page), forward[2])


MOVES = """() => {
  const turned = [], send = feed.send;
  let time = 0; // a frame every 50 ms, on however slow a machine
  performance.now = () => time;
  window.requestAnimationFrame = (draw) => setTimeout(() => draw(time += 50));
  window.cancelAnimationFrame = clearTimeout;
  feed.send = (messages) => {
    const turns = messages.filter((one) => one.type === "SetOrientationMessage" && one.name === "/scene/box");
    turned.push(...turns.map((one) => one.wxyz[3]));
    send.call(feed, messages);
  };
  return turned;
}"""


@pytest.mark.parametrize("motion", ["no-preference", "reduce"])
def test_what_only_moves_glides_unless_that_is_unwanted(opened, out, motion):
    page = opened(
        f"{(out / 'fake' / 'index.html').as_uri()}#run=default&step=1", reduced_motion=motion
    )
    turned = page.evaluate_handle(MOVES)
    page.locator("[data-act=next]").click()
    timeline = Timeline(FAKE, FAKE.params()).complete()
    T = [timeline[k].scene["box"].T_world_object for k in (1, 2)]  # type: ignore[union-attr]
    start, end = (np.sin(np.arctan2(t[1, 0], t[0, 0]) / 2) for t in T)  # type: ignore[index]
    page.wait_for_function(
        "([turned, end]) => Math.abs(turned.at(-1) - end) < 1e-6", arg=[turned, float(end)]
    )
    ways = np.array(turned.json_value())
    between = ways[(ways > start + 1e-6) & (ways < end - 1e-6)]
    assert (len(between) > 0) == (motion == "no-preference")
    assert (np.diff(ways) >= 0).all()
    page.evaluate("turned => { turned.length = 0; page.seek(5) }", turned)  # a jump
    page.wait_for_function("turned => turned.length > 0", arg=turned)
    assert len(turned.json_value()) == 1


def test_the_scene_is_really_drawn_and_follows_the_theme(opened, out):
    page = opened(
        (out / "icp" / "index.html").as_uri(), width=1280, drawn=True, color_scheme="dark"
    )
    target = Timeline(catalog()["icp"], catalog()["icp"].params())
    target.extend()
    assert any(isinstance(thing, Points) for thing in target[0].scene.values())
    notices = page.frame_locator("#scene iframe").get_by_text("Software WebGL")
    notices.first.wait_for(state="attached")  # viser says it wherever there is no graphics card
    assert not any(notice.is_visible() for notice in notices.all())
    dark = seen(page)
    assert (np.abs(dark - [20, 21, 23]).max(-1) < 12).mean() > 0.5  # most of it is backdrop
    assert ((dark[..., 0] - dark[..., 2]) > 60).sum() > 20  # orange points
    page.keyboard.press("t")
    light = seen(page)
    assert (light.min(-1) > 245).mean() > 0.5
    assert ((light[..., 2] - light[..., 0]) > 30).sum() > 20  # blue points, drawn paler


def test_runs_load_when_they_are_opened_and_not_before(opened, out):
    page = opened("about:blank", until="")
    loaded: list[str] = []
    page.on("request", lambda request: loaded.append(request.url.rsplit("/", 1)[-1]))
    page.goto((out / "fake" / "index.html").as_uri())
    page.wait_for_function(SCENE_IS_THERE)
    assert "default.js" in loaded
    assert "half.js" not in loaded
    page.locator("button[data-run=half]").click()
    page.wait_for_function("source.open_.name === 'half'")
    assert page.locator("button[data-run=half]").get_attribute("aria-pressed") == "true"
    assert "half.js" in loaded
    assert loaded.count("viser.js") == 1


def test_the_last_click_wins_also_when_an_earlier_run_comes_later(opened, address):
    page = opened(f"{address}/fake/index.html")
    held: list = []
    page.route("**/half.js", lambda route: held.append(route))
    page.locator("button[data-run=half]").click()
    while not held:
        page.wait_for_timeout(50)
    # a sign that it is on its way
    assert page.locator("#scene").get_attribute("aria-busy") == "true"
    page.locator("button[data-run=short]").click()
    page.wait_for_function("source.open_.name === 'short'")
    held[0].continue_()
    page.wait_for_function("shelf.runs.has('half')")
    page.wait_for_function(SCENE_IS_THERE)
    assert page.evaluate("[page.run.name, source.open_.name]") == ["short", "short"]


def test_the_address_is_the_place(opened, out):
    timeline = Timeline(FAKE, FAKE.presets[0].params).complete()
    page = opened(f"{(out / 'fake' / 'index.html').as_uri()}#run=half&step=4")
    assert caption(page) == timeline[4].caption.text
    page.locator("[data-act=back]").click()
    page.wait_for_function("location.hash === '#run=half&step=3'")
    page.reload()
    page.wait_for_function(SCENE_IS_THERE)
    assert caption(page) == timeline[3].caption.text
    page.evaluate("location.hash = '#run=angle:180&step=-1'")  # the same run under its other name
    page.wait_for_function("page.k === 5")
    assert page.evaluate("page.run.name") == "half"
    for wrong in ("#run=nope", "#run=__proto__", "#run=../../x"):
        page.evaluate("hash => location.hash = hash", wrong)
        page.locator("#caption.wrong", has_text="no run named").wait_for()
        page.evaluate("page.open('half', 2)")
        page.wait_for_function(
            "page.k === 2 && document.querySelector('#caption').className !== 'wrong'"
        )


def test_a_sweep_is_a_knob_and_keeps_the_step(opened, out):
    page = opened((out / "fake" / "index.html").as_uri())
    page.locator("[data-act=next]").click()
    page.locator("#set").click()
    knob = page.get_by_label("Angle (deg)")
    assert knob.get_attribute("aria-valuetext") == "90 deg"
    knob.focus()
    page.keyboard.press("ArrowLeft")
    page.wait_for_function("source.open_.name === 'angle:0' && page.k === 1")
    assert knob.get_attribute("aria-valuetext") == "0 deg"
    page.wait_for_function("location.hash === '#run=angle:0&step=1'")
    assert caption(page) == Timeline(FAKE, fake.Params(angle=0.0)).complete()[1].caption.text
    # a knob that a static page cannot turn is not shown
    assert page.locator("#drawer fieldset").count() == 1
    page.get_by_role("button", name="Reset").click()
    page.wait_for_function("source.open_.name === 'default'")
    assert knob.get_attribute("aria-valuetext") == "90 deg"


def test_a_pinned_run_stands_behind_the_next_in_its_curves_and_its_scene(opened, out):
    page = opened(f"{(out / 'fake' / 'index.html').as_uri()}#run=default&step=5")
    page.locator("#pin").click()
    page.evaluate("page.open('half', 1)")
    page.wait_for_function("source.open_.name === 'half'")
    ghosts = page.evaluate("[...feed.shown.keys()].filter((name) => name.startsWith('/ghost/'))")
    assert {"/ghost/source", "/ghost/box"} <= set(ghosts)
    assert "/ghost/target" not in ghosts  # it is where it was
    assert page.evaluate("page.run.pinned.length") > 0
    page.locator("#pin").click()
    page.wait_for_function("![...feed.shown.keys()].some((name) => name.startsWith('/ghost/'))")


def test_one_run_alone_plays_and_takes_neither_focus_nor_scrolls_its_host(opened, out, address):
    host = out / "host.html"
    host.write_text(
        '<link rel="icon" href="data:,"><input id="mine"><div style="height:3000px"></div>'
    )
    page = opened(f"{address}/host.html", until="")
    page.locator("#mine").focus()
    page.evaluate("""() => {
      const frame = document.createElement("iframe");
      document.body.append(Object.assign(frame, { src: "icp/runs/default.html", width: 800, height: 500 }));
    }""")
    page.frame_locator("iframe").locator("#caption").wait_for()
    embedded = next(frame for frame in page.frames if "/default.html" in frame.url)
    embedded.wait_for_function(SCENE_IS_THERE)
    page.frame_locator("iframe").frame_locator("#scene iframe").locator("canvas").first.wait_for()
    embedded.evaluate(FRAMES)  # what mounts late would take the focus by now
    assert page.evaluate("[document.activeElement.id, scrollY]") == ["mine", 0]
    embedded.locator("[data-act=play]").click()
    embedded.wait_for_function("page.k >= 2")
    embedded.locator("[data-act=play]").click()
    assert not embedded.evaluate("transport.playing")
    assert embedded.evaluate("document.documentElement.scrollHeight <= innerHeight")
    host.unlink()


def test_what_can_be_taken_along_is_there(opened, out):
    page = opened(f"{(out / 'fake' / 'index.html').as_uri()}#run=half&step=2")
    mine = page.locator("#this-run")
    shown = {
        name: page.locator(name).first
        for name in ("h1", "#caption", "#bar", "#view", "#this-run", "#theme")
    }
    assert all(part.is_visible() for part in shown.values())
    page.emulate_media(media="print")
    assert [name for name, part in shown.items() if part.is_visible()] == ["h1", "#caption"]
    assert not any(
        control.is_visible()
        for control in page.locator("#side button, #side input, #side select, form button").all()
    )
    page.emulate_media(media="screen")
    with page.expect_download() as download:
        mine.get_by_role("link", name="Download recording").click()
    assert download.value.suggested_filename == "fake-half.rrd"
    page.evaluate(
        "navigator.clipboard.writeText = (text) => { window.copied = text; return"
        " Promise.resolve(); }"
    )
    site = (out / "fake").as_uri()
    for words, text in {
        "Copy link": f"{site}/index.html#run=half&step=2",
        "Copy command": "workbench show fake.py --angle=180",
        "Copy for a page of your own": f'<iframe src="{site}/runs/half.html#step=2"',
    }.items():
        mine.get_by_role("button", name=words).click()
        mine.locator("output", has_text="is copied").wait_for()
        assert text in page.evaluate("copied")


def test_where_no_script_runs_a_picture_and_the_text_stand(chromium, out):
    page = chromium.new_page(java_script_enabled=False, viewport={"width": 1280, "height": 800})
    page.goto((out / "fake" / "index.html").as_uri())
    picture = page.locator("#view img")
    picture.wait_for()
    box = picture.bounding_box()
    assert box is not None
    assert box["width"] > 200
    assert page.get_by_role("heading", name="Every primitive").is_visible()
    page.close()


def test_the_course_has_pictures_ticks_and_leads_from_lesson_to_lesson(opened, out):
    page = opened((out / "index.html").as_uri(), until="")
    assert page.locator("[data-card]").count() == 2
    page.wait_for_function(
        "$$('.cards img').every((one) => one.complete && one.naturalWidth === 480)"
    )
    page.get_by_role("link", name="Every primitive").click()
    page.wait_for_function(SCENE_IS_THERE)
    for i in range(2):
        page.locator("form.question").nth(i).get_by_role("button", name="Skip and show me").click()
        page.locator("form.question.answered").nth(i).wait_for()
    first, second = page.evaluate("COURSE.slice(0, 2).map((one) => one.name)")
    assert second == "fake"
    page.locator("#around a[rel=prev]").click()
    page.wait_for_function(
        "name => typeof LESSON !== 'undefined' && LESSON.name === name", arg=first
    )
    page.locator("a[rel=next]:visible").wait_for()
    page.locator("a:visible", has_text="Geometry workbench").first.click()
    page.locator("[data-card=fake].all", has_text="✓ 2 of 2 questions").wait_for()
