"""The page in a real browser, fed by the live server: what it says is what the Timeline says."""

import re

import pytest

from workbench.lesson import catalog
from workbench.run.questions import answer
from workbench.run.timeline import Timeline, Timelines

pytestmark = pytest.mark.browser


def test_a_reload_comes_back_to_the_place_and_what_was_answered_stays(visit):
    lesson = catalog()["fitting"]
    line = Timeline(lesson, lesson.preset("line").params).complete()
    me = visit("?lesson=fitting&theirs=1")
    question = next(candidate for candidate in lesson.questions if not candidate.choices)
    expected = answer(lesson, question, None, timelines=Timelines())
    form = me.page.locator(f"form[data-question={question.name}]")
    form.locator("input").first.fill("50")
    form.get_by_role("button", name="Answer").click()
    form.get_by_text(expected.truth).wait_for()
    me.says(Timeline(lesson, question.params).complete()[expected.step].caption.text)
    me.page.get_by_text("All experiments").click()
    me.page.locator("button[data-run=line]").click()
    me.says(line[0].caption.text)
    me.act("next")
    me.says(line[1].caption.text)
    me.page.wait_for_function(
        "location.search.includes('stage=line') && location.search.includes('step=1')"
    )
    # keys that are not ours are left alone
    assert "theirs=1" in me.page.evaluate("location.search")
    me.page.reload()
    me.says(line[1].caption.text)
    assert expected.why in form.locator("output").inner_text()


def test_the_scene_is_large_and_the_controls_do_not_move(visit):
    me = visit("?lesson=disparity&step=3", width=1440, height=900)
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
        places.add(
            str(
                [
                    me.page.locator(f"[data-act={verb}]").bounding_box()
                    for verb in ("first", "play", "last")
                ]
            )
        )
    assert len(places) == 1


def test_a_chart_stands_beside_the_scene_once_it_has_a_point(visit):
    """The Fiedler vector, where the club opens, has cut nothing yet; the cuts come after it."""
    me = visit("?lesson=graphs&preset=club")
    me.page.wait_for_function("page.run?.finished && page.k === 1 && page.step()")
    titles = "panels.of(page.run, page.step()).map((tile) => tile.key)"
    assert "series Conductance" not in me.page.evaluate(titles)
    me.act("last")
    me.page.wait_for_function(f"{titles}.includes('series Conductance')")
    texts = me.page.evaluate(
        "[measured(1.14e12, ''), measured(-7.59e-4, '%'), measured(1e-9, 'deg'), measured(12.5,"
        " '%')]"
    )
    assert texts == ["1.14 × 10¹²", "−7.59 × 10⁻⁴ %", "1 × 10⁻⁹°", "12.5 %"]


def test_the_stage_says_which_experiment_is_open_has_one_large_chart_and_named_places(visit):
    lesson = catalog()["fitting"]
    line = lesson.preset("line")
    states = Timeline(lesson, line.params).complete()
    me = visit("?lesson=fitting", width=1440, height=900)
    me.says(Timeline(lesson, lesson.params()).complete()[0].caption.text)
    usual = next(preset for preset in lesson.presets if preset.params == lesson.params())
    assert me.page.locator("#open").inner_text().split("\n") == [usual.title, usual.line]
    me.act("last")
    me.page.locator("#main-chart svg").wait_for()
    chart = me.page.locator("#main-chart").bounding_box()
    tiles = me.page.locator("#tiles").bounding_box()
    assert chart is not None
    assert tiles is not None
    assert chart["height"] > 2 * tiles["height"]
    me.page.get_by_text("All experiments").click()
    me.page.locator("button[data-run=line]").click()
    me.says(states[line.step if line.step is not None else 0].caption.text)
    assert me.page.locator("#open").inner_text().split("\n") == [line.title, line.line]
    me.act("last")
    me.says(states[-1].caption.text)
    me.page.locator("#places button.first").click()
    me.says(states[0].caption.text)


def test_a_link_that_cannot_be_used_is_told_and_the_page_lives(visit):
    me = visit("?lesson=icp&start_angle=abc")
    me.page.locator("#caption.wrong", has_text=re.compile("start_angle")).wait_for()
    me.act("next")
    assert me.page.locator("button[data-run=far]").is_enabled()


def test_what_one_points_at_in_the_text_stands_out(visit, server):
    me = visit("?lesson=fitting", scene=True)
    me.scene()
    me.page.locator("#legend [data-things]").first.wait_for()
    term = me.page.locator(".term").first
    path = term.get_attribute("data-thing")
    for point, away in ((term.hover, me.page.locator("h1").hover), (term.focus, term.blur)):
        point()
        me.page.locator("#legend .lit").first.wait_for()
        me.page.wait_for_function("path => sceneView.path === path", arg=path)
        away()
        me.page.wait_for_function("sceneView.path === ''")
        assert me.page.locator("#legend .lit").count() == 0


def test_news_of_a_run_ends_no_glide_unless_handles_follow_it(visit):
    me = visit("?lesson=icp")
    me.page.wait_for_function("page.run?.finished")
    shown = """() => {
      let count = 0;
      const show = feed.show;
      feed.show = (...all) => { count += 1; show.apply(feed, all); };
      source.heard({ tell: "run", run: page.run.id, known: page.run.known });
      feed.show = show;
      return count;
    }"""
    assert me.page.evaluate(shown) == 0
    me.page.evaluate("handles.on = true")
    assert me.page.evaluate(shown) == 1
