"""Presets that are clicked faster than they are shown, and then a question's own run: the last one
wins, nothing fails.
"""

from typing import Any

import pytest

from workbench.lesson import Question, catalog
from workbench.run.timeline import Timeline

pytestmark = pytest.mark.browser
ROUNDS = 3
SEEN = """([known, k, caption]) =>
  page.run.finished && page.run.known === known && page.k === k && $("#caption").textContent === caption"""


def alone(lesson: Any) -> list[Question]:
    """Return the questions whose run is no preset's."""
    return [
        question
        for question in lesson.questions
        if question.params != lesson.params() and lesson.preset_of(question.params) is None
    ]


@pytest.mark.parametrize("name", ["epipolar", "fitting"])  # told lessons ask in their story
def test_the_last_of_quick_clicks_wins_and_a_question_s_run_follows(visit, name):
    lesson = catalog()[name]
    last = lesson.presets[len(lesson.presets) // 2]
    question = (alone(lesson) or lesson.questions[-1:])[0]
    clicks = [preset.name for preset in lesson.presets] * ROUNDS + [last.name]
    me = visit(f"?lesson={name}", scene=True)
    messages: list[str] = []
    me.page.on("console", lambda message: messages.append(message.text))
    me.scene()

    def shows(params: Any, step: int) -> None:
        run = Timeline(lesson, params).complete()
        k = step % len(run)
        me.page.wait_for_function(SEEN, arg=[len(run), k, run[k].caption.text])

    click = "(names) => names.forEach((name) => $(`button[data-run='${name}']`).click())"
    me.page.evaluate(click, clicks)
    shows(last.params, lesson.first_step if last.step is None else last.step)
    assert me.page.evaluate("page.run.name") == last.name
    for preset in lesson.presets:  # each in a turn of its own, none waited for
        me.page.evaluate(click, [preset.name])
    me.page.evaluate(
        "(name) => $(`form.question[data-question='${name}'] [value=skip]`).click()", question.name
    )
    shows(question.params, -1 if question.step is None else question.step)
    me.page.evaluate(click, [last.name])
    shows(last.params, lesson.first_step if last.step is None else last.step)
    assert [
        text for text in messages if "non-existent" in text or "Invalid array length" in text
    ] == []
