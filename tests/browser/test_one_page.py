"""The page in a real browser, fed by the live server: what it says is what the Timeline says."""

import re

import pytest

from workbench.lesson import catalog
from workbench.questions import answer
from workbench.timeline import Timeline, Timelines

pytestmark = pytest.mark.browser


def test_a_lesson_plays_steps_back_runs_a_preset_and_comes_back_by_its_address(visit):
    lesson = catalog()["icp"]
    here, far = (Timeline(lesson, params).complete() for params in (lesson.params(), lesson.preset("far").params))
    me = visit("?lesson=icp")
    me.says(here[0].caption.text)
    me.page.locator("#count").get_by_text(f"0 / {len(here) - 1}", exact=True).wait_for()
    for k in (1, 2, 3):
        me.act("next")
        me.says(here[k].caption.text)
    me.act("back")
    me.says(here[2].caption.text)
    me.act("last")
    me.says(here[-1].caption.text)
    me.page.locator("#speed").select_option("8")
    me.act("play")  # from the start, when at the end
    me.page.wait_for_function("page.k >= 5 && page.k < 100")
    me.act("play")
    at = me.page.evaluate("page.k")
    me.says(here[at].caption.text)
    me.page.locator("button[data-run=far]").click()
    me.says(far[0].caption.text)
    assert me.page.locator("button[data-run=far]").get_attribute("aria-pressed") == "true"
    me.act("next")
    me.says(far[1].caption.text)
    me.page.wait_for_function("location.search.includes('start_angle=120') && location.search.endsWith('step=1')")
    me.page.reload()
    me.says(far[1].caption.text)


def test_a_knob_a_question_and_the_code(visit):
    lesson = catalog()["icp"]
    turned = Timeline(lesson, lesson.params(start_angle=90.0)).complete()
    me = visit("?lesson=icp")
    me.page.get_by_role("button", name="Knobs").click()
    me.page.get_by_label("Start angle (deg)", exact=True).fill("90")
    me.says(turned[0].caption.text)
    question = lesson.questions[0]
    found = answer(lesson, question, None, Timelines())
    form = me.page.locator(f"form[data-question={question.name}]")
    form.locator("input").first.fill("50")
    form.get_by_role("button", name="Answer").click()
    form.get_by_text(found.truth).wait_for()
    assert found.why in form.locator("output").inner_text()
    me.page.reload()
    assert found.why in form.locator("output").inner_text()  # it stays answered in this browser
    me.says(Timeline(lesson, question.params).complete()[found.step].caption.text)
    me.page.locator(".tile", has_text="Code").click()
    assert me.page.locator("#large .here").count() == 1
    me.page.keyboard.press("Escape")
    me.page.locator("#large").wait_for(state="hidden")
    me.page.keyboard.press("?")
    me.page.locator("#large").get_by_text("play or pause").wait_for()


def test_the_scene_is_large_and_the_controls_do_not_move(visit):
    me = visit("?lesson=disparity")
    me.page.wait_for_function("document.querySelectorAll('.tile').length > 1")
    view = me.page.locator("#view").bounding_box()
    assert view is not None
    assert view["width"] * view["height"] >= 0.55 * 1440 * 900
    places = set()
    me.page.wait_for_function("page.step() && page.known() > page.k + 8")
    first = me.page.evaluate("page.k")
    for k in range(1, 9):
        me.act("next")
        me.page.wait_for_function(f"page.k === {first + k}")
        places.add(str([me.page.locator(f"[data-act={verb}]").bounding_box() for verb in ("first", "play", "last")]))
    assert len(places) == 1
    frame = me.page.frame_locator("#scene iframe")
    frame.locator("canvas").first.wait_for()


def test_a_link_that_cannot_be_used_is_told_and_the_page_lives(visit):
    me = visit("?lesson=icp&start_angle=abc")
    me.page.locator("#caption.wrong", has_text=re.compile("start_angle")).wait_for()
    me.act("next")
    assert me.page.locator("button[data-run=far]").is_enabled()


def test_a_phone_shows_caption_and_controls(visit):
    run = Timeline(catalog()["icp"], catalog()["icp"].params()).complete()
    me = visit("?lesson=icp&step=2", width=390, height=844)
    me.says(run[2].caption.text)
    box = me.page.locator("#caption").bounding_box()
    assert box is not None
    assert box["x"] >= 0
    assert box["width"] > 300
    me.act("next")
    me.says(run[3].caption.text)


def test_what_one_points_at_in_the_text_stands_out(visit, server):
    me = visit("?lesson=icp")
    me.scene()
    me.page.locator("#legend [data-things]").first.wait_for()
    term = me.page.locator(".term").first
    path = term.get_attribute("data-thing")
    for point, away in ((term.hover, me.page.locator("h1").hover), (term.focus, term.blur)):
        point()
        me.page.locator("#legend .lit").first.wait_for()
        until(me, lambda: path in [one._scene.path for one in server.students.values()])
        away()
        until(me, lambda: {one._scene.path for one in server.students.values()} == {""})
        assert me.page.locator("#legend .lit").count() == 0


def until(me, holds) -> None:
    for _ in range(600):
        if holds():
            return
        me.page.wait_for_timeout(100)
    raise AssertionError
