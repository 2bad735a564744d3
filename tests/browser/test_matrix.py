"""Every lesson in every home it has does what it does there: one visit each, and what it says is what
the Timeline says.

By keyboard alone, but for handles and points of the scene; without motion on the way from step to
step; in a light window of a laptop at first, then in a dark one of a phone.
"""

import functools
import math
from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from playwright.sync_api import TimeoutError as TookTooLong

from tests.browser.hands import click, drag, student
from tests.browser.homes import HOMES, PHONE, Browser, Home, asked, barriers, linked, own_end
from workbench.knobs import Gizmo, Pick, fields_of, text_of
from workbench.lesson import catalog
from workbench.page.code import moment_data
from workbench.run.questions import answer
from workbench.run.timeline import Timeline
from workbench.story import has_story

pytestmark = pytest.mark.browser
EVERYWHERE = ("icp", "pinhole", "fitting", "learning")
"""One page is in all homes: a few lessons tell whether it is whole in each, two that are stories and
two that are not, with pictures, sweeps and code. The others do everything live, and show on a site
what is theirs there: runs, links, questions, sweeps. A notebook shows a site's page in one file.
"""
AGREES = """(captions) => page.run.finished && page.known() === captions.length &&
  $("#caption").textContent === captions[page.k]"""


@pytest.fixture(scope="module")
def browser(chromium, server) -> Iterator[Browser]:
    browser = Browser(chromium, server)
    yield browser
    browser.close()


@pytest.mark.parametrize(
    ("name", "kind"),
    [
        (name, kind)
        for name in catalog()
        for kind in HOMES
        if kind != "notebook" or name in EVERYWHERE
    ],
)
def test_a_lesson_does_everything_in_its_home(browser, tmp_path, name, *, kind):
    with browser.opened(kind, catalog()[name], tmp_path) as home:
        whole = kind == "live" or name in EVERYWHERE
        says_what_the_timeline_says(home)
        if whole:
            is_stepped_and_played_by_keys(home)
            shows_the_line_of_code(home)
        if kind != "site":
            nobody_is_kept_out(home)
        if kind == "live":
            a_knob_leads_to_another_run(home)
            a_handle_and_a_point_are_moved_by_hand(home)
        if kind != "notebook":
            links_run_things(home)
            a_question_is_answered_wrong_and_right(home)
        if kind == "site":
            a_sweep_leads_to_another_run(home)
        if whole:
            a_run_is_pinned(home)
            fits_a_phone_in_the_dark(home)
        if kind == "site" and whole:
            nobody_is_kept_out(home)
        assert home.errors == []


def complete(home: Home, params: Any) -> Timeline:
    """Return a run of the lesson that is open; what the home itself ran is not run again."""
    return home.server.runs.timelines.get(catalog()[home.lesson.name], params).complete()


def here(home: Home) -> Timeline:
    """Return the default run."""
    return complete(home, home.lesson.params())


def opens_at(timeline: Timeline, step: int) -> int:
    return step if step >= 0 else len(timeline) + step


def says_what_the_timeline_says(home: Home) -> None:
    run = here(home)
    home.says(run[opens_at(run, home.lesson.opens)].caption.text)
    home.until(
        "n => page.known() === n && page.run.series.every((one) => one.values.length === n)",
        len(run),
    )
    told = {
        curve["path"]: (curve["name"], curve["unit"], curve["values"])
        for curve in home.ask("page.run.series")
    }
    series = run.series()
    assert told.keys() == series.keys()
    for path, curve in series.items():
        name, unit, values = told[path]
        assert (name, unit) == (curve.scalar.name, curve.scalar.unit)
        known = [math.nan if value is None else value for value in values]
        np.testing.assert_allclose(
            known, np.where(np.isfinite(curve.values), curve.values, np.nan), rtol=1e-5, atol=1e-12
        )
    home.find("#scene iframe").wait_for()
    home.frame.frame_locator("#scene iframe").locator("canvas").first.wait_for()
    home.ask("void (secondsBetweenPictures = 3600)")


def is_stepped_and_played_by_keys(home: Home) -> None:
    run = here(home)
    last = len(run) - 1

    def shows(k: int) -> None:
        home.says(run[k].caption.text, k)
        home.until("said => $('#count').innerText === said", f"{k} / {last}")

    home.press("Tab")
    assert home.ask("document.activeElement.className") == "skip"
    end = own_end(run)
    # tries of other starts follow the run's own end
    ends = (("End", end), *([("End", last)] if end < last else []))
    for key, k in (
        ("Home", 0),
        ("n", 1),
        ("ArrowRight", 2),
        ("p", 1),
        *ends,
        ("ArrowLeft", last - 1),
    ):
        home.press(key)
        shows(min(k, last))
    home.find("[data-act=back]").press("Enter")
    shows(max(0, last - 2))
    home.find("#speed").select_option("8")
    home.find("[data-act=play]").press("Enter")
    shows(last)
    home.until("!transport.playing")
    home.press("?")
    home.find("#large").get_by_text("play or pause").wait_for()
    home.ask("page.draw()")  # such as when more of the run comes
    assert home.find("#large").is_visible()
    home.press("Escape")
    home.find("#large").wait_for(state="hidden")


def shows_the_line_of_code(home: Home) -> None:
    run = here(home)
    moments = [(k, step.moment) for k, step in enumerate(run.known()) if step.moment is not None]
    if not moments:
        return
    k, moment = moments[-1]
    home.ask("k => page.seek(k)", k)
    home.says(run[k].caption.text, k)
    home.find(".tile", has_text="Code").focus()
    home.ask("page.draw()")  # such as when more of the run comes
    assert home.ask("document.activeElement.dataset.key") == "code"
    home.press("Enter")
    line = home.find("#large .here")
    line.first.wait_for()
    assert line.count() == 1
    assert line.get_attribute("data-line") == str(moment_data(moment)["line"])


def nobody_is_kept_out(home: Home, *rules: str) -> None:
    """Ask axe what is serious, with whatever is open; of some rules only, if any are named."""
    assert barriers(home.frame, *rules) == []
    home.press("Escape")


def a_knob_leads_to_another_run(home: Home) -> None:
    home.press("s")
    slider = home.find("#drawer fieldset:not(:disabled) input[type=range]").first
    name = slider.locator("xpath=ancestor::fieldset").get_attribute("data-knob")
    before = home.ask("name => page.run.params[name]", name)
    slider.press(
        "ArrowLeft" if slider.input_value() == slider.get_attribute("max") else "ArrowRight"
    )
    home.until("([name, was]) => String(page.run.params[name]) !== was", [name, text_of(before)])
    agrees_with_its_params(home)
    home.find("#drawer").get_by_role("button", name="Reset").press("Enter")
    home.until("page.run.name === 'default'")
    home.press("s")
    home.find("#drawer").wait_for(state="hidden")


def agrees_with_its_params(home: Home) -> None:
    """See to it that what is said is what the run with these params says."""
    session = student(home).session
    assert session is not None
    run = complete(home, session.params)
    home.until(AGREES, [step.caption.text for step in run.known()])


def a_handle_and_a_point_are_moved_by_hand(home: Home) -> None:
    idle = set(home.ask("page.run.idle ?? []"))  # what a run does not read has no handle
    used = [field for field in fields_of(home.lesson.params) if field.name not in idle]
    by = {kind: [f for f in used if isinstance(f.knob.by, kind)] for kind in (Gizmo, Pick)}
    home.ask("void (secondsBetweenPictures = 0.2)")
    for field in by[Gizmo][:1]:
        home.press("h")
        home.find("#move[aria-pressed=true]").wait_for()
        home.until("() => [...feed.shown.keys()].some((name) => name.startsWith('/handle/'))")
        is_drawn(home)
        moved(home, field.name, functools.partial(drag, home, field))
        home.press("h")
    for field in by[Pick][:1]:
        assert isinstance(field.knob.by, Pick)
        is_drawn(home)
        moved(home, field.name, functools.partial(click, home, field.knob.by.path))
    home.ask("void (secondsBetweenPictures = 3600)")
    home.press("r")
    home.until("page.run.name === 'default'")


def is_drawn(home: Home) -> None:
    """Wait until viser's client has drawn what there is now: only then it has the scene's camera."""
    home.until("before => pictures > before + 1", home.ask("pictures"))


def moved(home: Home, name: str, act: Callable[[int], None]) -> None:
    """Do something in the scene until a param has changed by it to what can be run: what is drawn
    comes a little later than what is said.
    """
    before = home.ask("name => String(page.run.params[name])", name)
    for turn in range(60):
        act(turn)
        try:
            home.frame.wait_for_function(
                "([name, was]) => String(page.run.params[name]) !== was",
                arg=[name, before],
                timeout=3000,
            )
        except TookTooLong:
            continue
        if not is_refused(home):
            return agrees_with_its_params(home)
        before = home.ask("name => String(page.run.params[name])", name)
    raise AssertionError(f"{name} stays {before}")


def is_refused(home: Home) -> bool:
    """Tell whether what the page asked for cannot be run, such as a source in a wall; the page says
    why.
    """
    session = student(home).session
    assert session is not None
    run = complete(home, session.params)
    if len(run) == 0:
        home.says(run.stopped or "")
    return len(run) == 0


def links_run_things(home: Home) -> None:
    moment = home.find("a.run[data-run=default][data-step], a.run[data-run=''][data-step]").first
    if moment.count():
        run = here(home)
        step = int(moment.get_attribute("data-step"))
        moment.press("Enter")
        home.says(run[opens_at(run, step)].caption.text, opens_at(run, step))
        home.find("a.run[data-step][aria-current=true]").first.wait_for()
    name = linked(home.lesson)
    if name is not None:
        preset = home.lesson.preset(name)
        link = home.find(f"a.run[data-run='{name}']").first
        step = link.get_attribute("data-step")
        run = complete(home, preset.params)
        opens = home.lesson.first_step if preset.step is None else preset.step
        at = opens if step is None else int(step)
        link.press("Enter")
        home.says(run[opens_at(run, at)].caption.text, opens_at(run, at))
        chosen = home.find(f"button[data-run='{name}'][aria-pressed=true]")
        # where the text speaks of all experiments, their list is folded
        chosen.wait_for(state="attached")


def a_question_is_answered_wrong_and_right(home: Home) -> None:
    if not home.lesson.questions or has_story(home.lesson):  # asked in its scenes: test_story
        return
    question = asked(home.lesson)
    expected = answer(
        catalog()[home.lesson.name], question, None, timelines=home.server.runs.timelines
    )
    form = home.find(f"form[data-question='{question.name}']")
    if question.choices:
        wrong = next(choice for choice in question.choices if choice != expected.truth)
        right = expected.truth
    else:
        wrong = f"{expected.value + 2 * question.tolerance + 1:.9g}"
        right = f"{expected.value:.9g}"
    for given, reply in ((wrong, "You said "), (right, "Right: ")):
        if question.choices:
            form.get_by_label(given, exact=True).press("Space")
        else:
            form.locator("input").fill(given)
        form.get_by_role("button", name="Answer", exact=True).press("Enter")
        form.locator("output", has_text=reply).wait_for()
        assert form.locator("output").inner_text().endswith(expected.why)
    home.says(complete(home, question.params)[expected.step].caption.text)


def a_sweep_leads_to_another_run(home: Home) -> None:
    if not home.lesson.sweeps:
        return
    lesson = catalog()[home.lesson.name]
    knob = home.lesson.sweeps[0].knob
    usual = getattr(lesson.params(), knob)
    values = {text_of(value): value for value in (*home.lesson.sweeps[0].values, usual)}
    home.press("s")
    dial = home.find("#drawer input[type=range]").first
    for key in ("Home", "End"):
        dial.press(key)
        value = values[
            home.ask("at => RECORDED.sweeps[0].values.at(at)", 0 if key == "Home" else -1)
        ]
        run = complete(home, lesson.validated(replace(lesson.params(), **{knob: value})))
        home.until("() => source.open_.name === page.run.name")
        home.until(AGREES, [step.caption.text for step in run.known()])
        assert dial.get_attribute("aria-valuetext").startswith(text_of(value))
    home.press("s")


def a_run_is_pinned(home: Home) -> None:
    home.find("#pin").press("Enter")
    home.until("Boolean(page.run.pinned)")
    assert home.find("#pin").get_attribute("aria-pressed") == "true"
    home.find("#pin").press("Enter")
    home.until("!page.run.pinned")


def fits_a_phone_in_the_dark(home: Home) -> None:
    home.shown_as(**PHONE)
    home.press("t")
    home.find("html[data-theme=dark]").wait_for(state="attached")
    assert home.ask("document.documentElement.scrollWidth") <= PHONE["width"]
    if home.ask("page.k") == 0:
        home.press("n")
        home.until("page.k > 0")
    k = home.ask("page.k")
    home.find("[data-act=back]").press("Enter")
    home.until("k => page.k === k", k - 1)
    for place in ("#scene", "#caption", "[data-act=play]"):
        box = home.find(place).bounding_box()
        assert box is not None
        assert box["y"] >= 0
        assert box["y"] + box["height"] <= PHONE["height"]
