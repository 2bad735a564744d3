"""The front door in a real browser: the first toy by mouse, finger and keys, the way back to
where one was, the map.
"""

import json
import re
from dataclasses import replace

import pytest

from tests.browser.homes import PHONE, barriers
from tests.publish.conftest import TINY
from workbench.chapters import CHAPTERS, NAMES
from workbench.lesson import course
from workbench.page.course import LOOP_OF
from workbench.publish import site

pytestmark = pytest.mark.browser
HOME = ["1.00", "0.00", "0.00", "0.00", "1.00", "0.00"]
MOST = 0.05  # metres, where orange is put by hand


@pytest.fixture
def front(visit):
    """front(**how): the front door, open; its pictures are not asked for."""

    def opened(**how):
        me = visit("?course", **how)
        me.page.wait_for_function(
            "typeof toy !== 'undefined' && document.fonts.status === 'loaded'"
        )
        return me

    return opened


def numbers(page) -> list[str]:
    return page.locator("#toy td").all_inner_texts()[:6]


def on_screen(page, x: float, y: float) -> tuple[float, float]:
    """Return where a point of the toy is on the screen; metres, y upwards."""
    where = (
        "([x, y]) => { const p = new DOMPoint(x, -y).matrixTransform(toy.svg.getScreenCTM());"
        " return [p.x, p.y]; }"
    )
    return tuple(page.evaluate(where, [x, y]))


def test_orange_is_laid_on_blue_by_mouse_and_the_matrix_becomes_ones_and_zeros(front):
    page = front().page
    x, y = page.evaluate("[toy.x, toy.y]")
    assert numbers(page)[2::3] == [f"{x:.2f}", f"{y:.2f}".replace("-", "−")]
    page.mouse.move(*on_screen(page, x, y))
    page.mouse.down()
    page.mouse.move(*on_screen(page, 0.0, 0.0), steps=4)
    page.mouse.up()
    assert page.evaluate("Math.hypot(toy.x, toy.y)") < MOST
    turn = page.evaluate("toy.turn")
    assert turn == pytest.approx(0.89, abs=0.01), "moved, not turned"
    cos, sin = page.evaluate("[Math.cos(toy.turn), Math.sin(toy.turn)]")
    page.mouse.move(*on_screen(page, -0.6 * sin, 0.6 * cos))
    page.mouse.down()
    page.mouse.move(*on_screen(page, -0.3, 0.52), steps=4)
    page.mouse.move(*on_screen(page, 0.01, 0.6), steps=4)
    assert page.locator("#toy .home").is_hidden()
    page.mouse.up()
    assert numbers(page) == HOME
    assert page.locator("#toy .home").is_visible()
    assert (
        page.locator("#toy [role=status]").inner_text()
        == "Orange lies on blue. The matrix is ones and zeros."
    )


def test_keys_move_and_turn_it_and_home_starts_again(front):
    page = front().page
    toy = page.locator("#toy svg")
    before = page.evaluate("[toy.x, toy.y, toy.turn]")
    start = numbers(page)
    toy.focus()
    for key in ("ArrowLeft", "ArrowUp", ","):
        page.keyboard.press(key)
    after = page.evaluate("[toy.x, toy.y, toy.turn]")
    assert [b - a for a, b in zip(before, after, strict=True)] == pytest.approx(
        [-0.02, 0.02, 0.05236], abs=1e-4
    )
    page.locator(
        "#toy [role=status]", has_text="Turned by 54°, 0.32 to the right, 0.10 down."
    ).wait_for(state="attached")
    for key in ("ArrowRight", "ArrowDown", "."):
        page.keyboard.press(key)
    assert numbers(page) == start
    for _ in range(17):
        page.keyboard.press("ArrowLeft")
        page.keyboard.press(".")
    for _ in range(6):
        page.keyboard.press("ArrowUp")
    page.wait_for_function("toy.isHome(1e-6)")
    assert numbers(page) == HOME
    page.keyboard.press("Home")
    assert numbers(page) == start
    assert page.evaluate("scrollY") == 0, "its keys do not scroll the page"


def test_a_finger_moves_it_and_scrolls_beside_it(front, chromium, server):
    page = chromium.new_page(viewport={"width": 390, "height": 844}, has_touch=True, is_mobile=True)
    page.goto(f"{server.address}/?course")
    page.wait_for_function("typeof toy !== 'undefined'")
    assert page.evaluate("document.documentElement.scrollWidth") == 390
    assert page.locator("#begin").bounding_box()["y"] < 400
    session = page.context.new_cdp_session(page)

    def drag(start: tuple[float, float], by: tuple[float, float]) -> None:
        def touch(kind: str, *points: tuple[float, float]) -> None:
            session.send(
                "Input.dispatchTouchEvent",
                {"type": kind, "touchPoints": [{"x": x, "y": y} for x, y in points]},
            )

        touch("touchStart", start)
        for k in range(1, 6):
            touch("touchMove", (start[0] + by[0] * k / 5, start[1] + by[1] * k / 5))
        touch("touchEnd")

    x, y = page.evaluate("[toy.x, toy.y]")
    drag(on_screen(page, x, y), (-30, -40))
    page.wait_for_function("([x, y]) => toy.x < x - 0.1 && toy.y > y + 0.1", arg=[x, y])
    assert page.evaluate("scrollY") == 0
    box = page.locator("#toy svg").bounding_box()
    drag((box["x"] + 12, box["y"] + 200), (0, -120))
    page.wait_for_function("scrollY > 40")
    page.close()


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("phone", [False, True], ids=["wide", "phone"])
def test_no_barriers(front, chromium, server, *, scheme, phone):
    size = (PHONE["width"], PHONE["height"]) if phone else (1440, 900)
    me = front(width=size[0], height=size[1])
    me.page.evaluate("dark => theme.set(dark)", scheme == "dark")
    me.page.evaluate(
        "kept.set('last', 'icp'), kept.set('scenes icp', {seen: ['a', 'b'], at: 'b', title: 'Fit',"
        " of: 7}), progress.tick()"
    )
    assert barriers(me.page) == []
    assert me.page.evaluate("document.documentElement.scrollWidth <= innerWidth")


def test_it_leads_back_to_where_one_was(front):
    me = front()
    page = me.page
    first = next(iter(course()))
    assert page.locator("#begin").get_attribute("href") == f"?lesson={first}"
    assert page.locator("#again").is_hidden()
    seen = {"seen": ["bands", "springs", "one"], "at": "springs", "title": "Springs", "of": 7}
    page.evaluate("seen => (kept.set('scenes pairs', seen), kept.set('last', 'pairs'))", seen)
    page.reload()
    again = page.locator("#again")
    assert again.inner_text() == "Continue: Pairs and rubber bands, Springs →"
    assert again.get_attribute("href") == "?lesson=pairs#springs"
    card = page.locator("[data-card=pairs]")
    assert card.locator(".done").inner_text() == "3 of 7 scenes"
    box, bar = card.locator(".bar span").bounding_box(), card.locator(".bar").bounding_box()
    assert box["width"] / bar["width"] == pytest.approx(3 / 7, abs=0.01)
    page.evaluate("seen => kept.set('scenes pairs', seen)", {**seen, "seen": list("abcdefg")})
    page.reload()
    assert card.locator(".done").inner_text() == "✓ all 7 scenes"
    assert again.inner_text() == "Next: Iterative closest point →"
    assert again.get_attribute("href") == "?lesson=icp"


def test_the_line_of_chapters_leads_to_each_and_stays_in_view(front):
    page = front().page
    links = page.locator(".line a")
    assert [re.sub(r"\W*\d+", "", text) for text in links.all_inner_texts()] == list(NAMES)
    page.evaluate("document.documentElement.style.scrollBehavior = 'auto'")
    for i in (3, 1):
        links.nth(i).click()
        page.wait_for_function(
            "i => $$('.line a')[i].getAttribute('aria-current') === 'true'", arg=i
        )
        assert page.locator(".line").bounding_box()["y"] == pytest.approx(0, abs=1)
        head = page.locator(f"#{CHAPTERS[i].address} h2").bounding_box()
        assert 50 < head["y"] < 200, "no line lies over it"


def test_the_map_shows_all_that_a_lesson_builds_on(front):
    page = front(width=1440, height=900).page
    page.locator(".map a[data-name=disparity]").focus()
    lit = page.locator(".map a.on").evaluate_all("boxes => boxes.map((box) => box.dataset.name)")
    needed = set()
    waiting = ["disparity"]
    while waiting:
        needed.add(name := waiting.pop())
        waiting += course()[name].needs
    assert set(lit) == needed
    assert page.evaluate(
        "$('.map svg').getBoundingClientRect().width <= $('.map > div').clientWidth + 1"
    )
    page.locator("#begin").focus()
    assert page.locator(".map a.on").count() == 0


def test_it_plays_without_a_server_and_keeps_its_theme(chromium, tmp_path):
    site.publish(tmp_path, [TINY])
    page = chromium.new_page(color_scheme="dark")
    errors = []
    page.on("pageerror", lambda error: errors.append(str(error)))
    page.on(
        "requestfailed",
        lambda request: (
            None if "ERR_ABORTED" in (request.failure or "") else errors.append(request.url)
        ),  # a page that is left loads nothing more
    )
    page.goto((tmp_path / "index.html").as_uri())
    assert page.evaluate("document.documentElement.dataset.theme") == "dark"
    page.keyboard.press("t")
    page.reload()
    assert page.evaluate("document.documentElement.dataset.theme") == "light"
    page.locator("#toy svg").focus()
    before = numbers(page)
    page.keyboard.press(".")
    assert numbers(page) != before
    assert page.locator("#begin").get_attribute("href") == f"{TINY.name}/index.html"
    page.locator("#begin").click()
    page.wait_for_function(
        "name => typeof kept !== 'undefined' && kept.get('last') === name", arg=TINY.name
    )
    page.go_back()
    page.locator(f"[data-card={TINY.name}] .done", has_text="✓ opened").wait_for()
    published = json.loads((tmp_path / ".published.json").read_text())["lessons"][TINY.name]
    assert (published["chapter"], published["minutes"]) == (TINY.chapter, TINY.minutes)
    assert errors == []
    page.close()


def test_a_run_loops_where_motion_is_allowed_and_stops_when_asked_to(front):
    page = front().page
    source = "$('#loop img').getAttribute('src').split('/').at(-1)"
    assert page.evaluate(source) == "front-still.webp", "the reader asks for less motion"
    page.emulate_media(reduced_motion="no-preference")
    page.wait_for_function(f"{source} === 'front-loop.webp'")
    page.locator("#loop button").click()
    assert page.evaluate(source) == "front-still.webp"
    assert page.locator("#loop button").inner_text() == "Play"
    page.locator("#loop button").click()
    assert page.evaluate(source) == "front-loop.webp"
    page.emulate_media(reduced_motion="reduce")
    page.wait_for_function(f"{source} === 'front-still.webp'")


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_the_loop_is_as_light_or_dark_as_the_page_and_no_other_is_loaded(
    chromium, tmp_path, scheme
):
    site.publish(tmp_path, [replace(TINY, name=LOOP_OF)])
    page = chromium.new_page(color_scheme=scheme, reduced_motion="no-preference")
    asked = []
    page.on("request", lambda request: asked.append(request.url.split("/")[-1]))
    page.goto((tmp_path / "index.html").as_uri())
    page.wait_for_function("$('#loop img').complete && $('#loop img').naturalWidth === 400")
    names = {"light": "front-loop.webp", "dark": "front-loop-dark.webp"}
    assert [name for name in asked if name.startswith("front-") and ".webp" in name] == [
        names[scheme]
    ]
    page.keyboard.press("t")
    (other,) = (name for theme, name in names.items() if theme != scheme)
    page.wait_for_function(f"$('#loop img').src.endsWith('/{other}')")
    page.locator("#loop button").click()
    assert page.evaluate("$('#loop img').src.split('/').at(-1)") == other.replace("loop", "still")
    page.close()


def test_without_a_script_the_loop_is_a_picture(chromium, tmp_path):
    site.publish(tmp_path, [replace(TINY, name=LOOP_OF)])
    page = chromium.new_context(java_script_enabled=False, color_scheme="dark").new_page()
    page.goto((tmp_path / "index.html").as_uri())
    (image,) = page.locator("#loop img").all()
    assert image.get_attribute("src") == "page/front-still.webp"
    assert image.get_attribute("alt")
    page.context.close()
