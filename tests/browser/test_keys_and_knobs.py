"""Keys that go to a run's own end and to every experiment, and a drawer of knobs in which no label
is covered.
"""

import pytest

from workbench.lesson import catalog

pytestmark = pytest.mark.browser
LABELS = """() => [...$$("#drawer .knobs > div fieldset legend")].map((legend) => {
  const { left, top, width, height } = legend.getBoundingClientRect();
  const there = document.elementsFromPoint(left + width / 2, top + height / 2);
  return [legend.textContent, top + height < innerHeight - 80, there.some((one) => one.matches(".hint"))];
})"""


def test_end_goes_on_to_the_run_s_own_end_while_it_is_computed_and_then_to_the_tries_of_other_starts(
    visit,
):
    me = visit("?lesson=icp&step=0")
    me.page.wait_for_function("page.run && page.step()")
    me.page.keyboard.press("End")
    me.page.wait_for_function("page.run.finished && page.run.end > 0 && page.k === page.run.end")
    assert me.page.evaluate("page.known() - 1 - page.run.end") == 13  # starts from 0° to 180°
    me.page.keyboard.press("End")
    me.page.wait_for_function("page.k === page.known() - 1")
    me.page.keyboard.press("End")
    assert me.page.evaluate("page.k === page.known() - 1")


def test_keys_work_with_caps_lock_and_reach_twenty_experiments(visit):
    presets = [preset.name for preset in catalog()["disparity"].presets]
    me = visit("?lesson=disparity&step=3")
    me.page.wait_for_function("page.run && page.k === 3")
    me.page.keyboard.press("N")  # as Caps Lock says it
    me.page.wait_for_function("page.k === 4")
    for key, at in (("0", 9), ("Shift+Digit1", 10), ("Shift+Digit8", 17), ("2", 1)):
        me.page.keyboard.press(key)
        me.page.wait_for_function("(name) => page.run.name === name", arg=presets[at])
    me.page.keyboard.press("?")
    text = me.page.locator("#large").inner_text()
    assert "experiments 1 to 10" in text
    assert f"experiments 11 to {min(len(presets), 20)}" in text


def test_what_has_an_effect_stands_first_and_no_hint_covers_a_label(visit):
    me = visit("?lesson=learning&task=mesh")
    me.page.wait_for_function("page.run && page.step()")
    me.page.keyboard.press("s")
    first = me.page.locator("#drawer .knobs > div fieldset")
    names = first.evaluate_all("(all) => all.map((one) => one.dataset.knob)")
    assert "laplacian" in names
    assert "pool" not in names
    assert me.page.locator("#drawer details fieldset:not(:disabled)").count() == 0
    assert not me.page.locator("#drawer details").evaluate("(one) => one.open")
    me.page.locator("[data-knob=laplacian] input[type=range]").focus()
    assert me.page.locator("#hint-laplacian").is_visible()
    assert not any(covered for _, high_enough, covered in me.page.evaluate(LABELS) if high_enough)
    me.page.locator("[data-knob=task] select").select_option("classify")
    me.page.locator("#drawer .knobs > div [data-knob=pool]").wait_for()
    assert me.page.locator("#drawer details [data-knob=laplacian]").count() == 1
