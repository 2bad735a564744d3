"""The Lesson tab: the page, and the questions that are answered before the run is shown."""

import math
from collections.abc import Callable
from typing import Any

import viser

from workbench.errors import InputError
from workbench.lesson import Lesson, Question
from workbench.page.legend import escape
from workbench.questions import Answer
from workbench.typeset import inline_html, page_of
from workbench.viewer.terminal import tell_terminal

Predict = Callable[[Question, Any], None]


class Reading:
    """A lesson's text and questions, in the container that is open.

    Args:
        gui: The client's interface.
        lesson: What is read.
        predict: Called with a question and the answer given, None to skip it and see.
        answers: What this browser answered before, by question name.
    """

    def __init__(self, gui: viser.GuiApi, lesson: Lesson, predict: Predict, answers: dict[str, Any]):
        self.gui, self._predict = gui, predict
        self._results: dict[str, Any] = {}
        try:
            page = page_of(lesson.text(), lesson.page)
        except InputError as error:
            tell_terminal(error)
            page = f'<div class="wb-result">{escape(str(error))}</div>'
        before, break_, after = _around_questions(page)
        gui.add_html(f'<div class="wb wb-pad">{before}</div>')
        for number, question in enumerate(lesson.questions, 1):
            self._ask(number, question, answers.get(question.name))
        gui.add_html(f'<div class="wb wb-pad">{break_}{after}</div>')

    def show(self, question: Question, given: Any, answer: Answer) -> None:
        """Show what came of a prediction."""
        if given is None:
            verdict = f"The answer: {escape(answer.truth)}."
        elif answer.right:
            verdict = f'<span class="wb-done">Right: {escape(answer.truth)}.</span>'
        else:
            verdict = f"You said {escape(str(given))}; the run says <strong>{escape(answer.truth)}</strong>."
        self._results[
            question.name
        ].content = f'<div class="wb-result" role="status">{verdict} {escape(answer.why)}</div>'

    def say(self, question: Question, text: str) -> None:
        """Show a line under a question."""
        self._results[question.name].content = f'<div class="wb-result">{escape(text)}</div>'

    def _ask(self, number: int, question: Question, before: Any) -> None:
        with self.gui.add_folder(f"Predict {number}"):
            self.gui.add_html(f'<div class="wb wb-pad" style="padding-bottom:4px">{inline_html(question.text)}</div>')
            if question.choices:
                for choice in question.choices:
                    self._button(choice, question, lambda choice=choice: choice, color=(86, 110, 140))
            else:
                unit = f" ({question.unit})" if question.unit else ""
                typed = self.gui.add_text("Your prediction" + unit, "")
                self._button("Answer", question, lambda: number_in(typed.value), color=(86, 110, 140))
            self._button("Skip and show me", question, lambda: None, color=(150, 155, 163))
            said = f'<div class="wb-result">You answered: {escape(str(before))}.</div>' if before is not None else ""
            self._results[question.name] = self.gui.add_html(said)

    def _button(self, label: str, question: Question, value: Callable[[], Any], color: tuple[int, int, int]) -> None:
        button = self.gui.add_button(label, color=color)

        @button.on_click
        async def _(event: Any) -> None:
            if event.client is None:
                return
            try:
                given = value()
            except InputError as error:
                self.say(question, str(error))
            else:
                self._predict(question, given)


def number_in(text: Any) -> float:
    """Return the number that a person typed, with a point or a comma before its decimals.

    Raises:
        InputError: If it is none; the line is for the person.
    """
    try:
        number = float(str(text).strip().replace("−", "-").replace(",", "."))
    except ValueError:
        number = math.nan
    if not math.isfinite(number):
        raise InputError("Type a number first, or skip.")
    return number


def _around_questions(html: str) -> tuple[str, str, str]:
    """Split a page where its questions belong: behind the section that asks to predict, else at the end."""
    start = html.find('<section class="s-predict')
    if start < 0:
        return html, "", ""
    end = html.find("</section>", start) + len("</section>")
    return html[:end], "", html[end:]
