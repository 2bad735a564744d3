"""The course in a real browser: cards, ticks, the way from lesson to lesson, and links that cannot
be used.
"""

import re

import pytest

from tests.browser.homes import own_end
from tests.browser.visits import Visit
from workbench.lesson import catalog
from workbench.run.timeline import Timeline

pytestmark = pytest.mark.browser
LESSONS = list(catalog().values())


def first_words(lesson) -> str:
    return Timeline(lesson, lesson.params()).complete()[lesson.opens].caption.text


def test_the_course_leads_from_lesson_to_lesson_and_what_was_left_is_closed(visit, server):
    me = visit(scene=True)
    cards = me.page.locator(".cards li")
    assert [card.get_attribute("data-card") for card in cards.all()] == [
        lesson.name for lesson in LESSONS
    ]
    assert cards.locator(".done").all_inner_texts() == [""] * len(LESSONS)
    before, last = LESSONS[-2:]
    assert me.page.locator("[data-card] a").last.get_attribute("href") == f"?lesson={last.name}"
    me.page.locator(f"[data-card={before.name}] a").click()
    for lesson, rel in ((before, "next"), (last, None)):
        me.page.wait_for_url(re.compile(f"lesson={lesson.name}"))
        me.says(first_words(lesson))
        me.scene()
        assert me.page.locator("#around [rel=next]").count() == int(lesson is before)
        assert me.page.locator("#around [rel=prev]").count() == 1
        if rel is not None:
            me.page.locator(f"#around [rel={rel}]").click()
    assert me.page.evaluate("COURSE.map((one) => one.name)") == [lesson.name for lesson in LESSONS]
    until(
        me,
        lambda: len(server.students) == 1,
        "pages that were left are closed",
    )
    me.page.locator("nav.top a").first.click()
    me.page.locator(".done", has_text="✓ opened").nth(1).wait_for()
    until(me, lambda: not server.students, "the last one too")


def until(me: Visit, holds, why: str) -> None:
    for _ in range(600):
        if holds():
            return
        me.page.wait_for_timeout(100)
    raise AssertionError(why)


def test_a_lesson_is_done_when_all_its_questions_are_answered_in_this_browser(visit):
    lesson = catalog()["fitting"]
    me = visit(f"?lesson={lesson.name}")
    outputs = me.page.locator("form.question output")
    count = len(lesson.questions)
    for answered in (1, count):
        for k in range(answered):
            me.page.get_by_role("button", name="Skip and show me").nth(k).click()
            outputs.nth(k).get_by_text("The answer: ").wait_for()
        me.go("?course")
        done = f"{answered} of {count} questions"
        me.page.locator(f"[data-card={lesson.name}] .done", has_text=done).wait_for()
        assert me.page.locator("li.all").count() == int(answered == count)
        me.go(f"?lesson={lesson.name}")
    other = visit("?course")
    assert other.page.locator(".done:not(:empty)").count() == 0


def test_two_browsers_have_a_place_each(visit):
    run = Timeline(catalog()["icp"], catalog()["icp"].params()).complete()
    me, two = visit("?lesson=icp&step=1"), visit("?lesson=icp&step=3")
    me.says(run[1].caption.text)
    two.says(run[3].caption.text)
    me.act("last")
    me.says(run[own_end(run)].caption.text)
    two.says(run[3].caption.text)


def test_the_theme_is_kept_on_every_page(visit):
    me = visit("?lesson=fitting", scene=True)
    me.says(first_words(catalog()["fitting"]))
    me.page.keyboard.press("t")
    me.page.wait_for_selector("[data-theme=dark]")
    me.go("?course")
    me.page.wait_for_selector("[data-theme=dark]")
    me.go("?lesson=pinhole")
    me.page.wait_for_selector("[data-theme=dark]")
    me.page.frame_locator("#scene iframe").locator("[data-mantine-color-scheme=dark]").wait_for(
        state="attached"
    )


def test_a_link_to_no_lesson_is_told_on_the_course_page(visit):
    me = visit("?lesson=nope")
    me.page.get_by_role("alert").get_by_text(
        "this link names the lesson 'nope', which is not here"
    ).wait_for()
    assert me.page.locator(".cards li").count() == len(LESSONS)
