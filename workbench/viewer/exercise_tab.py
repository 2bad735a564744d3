"""The Exercise tab: what to write, the contract, and what the checks say of the file that is being watched."""

from collections.abc import Callable
from typing import Any

import viser

from workbench.exercise.finding import exercises_of
from workbench.exercise.grading import Report
from workbench.exercise.model import Exercise
from workbench.exercise.reports import MARKS, counted
from workbench.exercise.starter import commands, starter
from workbench.exercise.watching import Watched
from workbench.lesson import Lesson
from workbench.page.legend import escape


class ExerciseTab:
    """A lesson's exercises, in the container that is open.

    Args:
        gui: The client's interface.
        lesson: Whose exercises these are.
        watched: The student's file that drives this lesson, if one does.
        to_difference: Goes to the first step at which the student's run differs.
    """

    def __init__(self, gui: viser.GuiApi, lesson: Lesson, watched: Watched | None, to_difference: Callable[[], None]):
        self._watched = watched
        self._result: Any = None
        if watched is not None:
            gui.add_html(
                f'<div class="wb wb-pad"><h1>{escape(watched.exercise.name)}</h1><p>Your file <code>'
                f"{escape(watched.path.name)}</code> drives this lesson; save it and the run is new. The reference's run is "
                "the faint ghost wherever the two differ.</p></div>"
            )
            button = gui.add_button("Go to the first difference", color=(86, 110, 140))

            @button.on_click
            async def _(event: Any) -> None:
                if event.client is not None:
                    to_difference()

            self._result = gui.add_html("")
            self.show_report()
        exercises = exercises_of(lesson) if watched is None else (watched.exercise,)
        for exercise in exercises:
            gui.add_html(_task(exercise, alone=watched is not None))

    def show_report(self) -> None:
        """Show what the checks say of the file now."""
        if self._watched is not None and self._result is not None:
            self._result.content = _found(self._watched.said)


def _found(said: Report | str) -> str:
    """Return what the checks found as HTML: the same words as in the terminal."""
    if isinstance(said, str):
        return f'<div class="wb wb-pad wb-report" role="status"><p>{escape(said)}</p></div>'
    checks = "".join(
        f'<li class="{outcome.verdict.word}"><b>{MARKS[outcome.verdict.word]}</b> {escape(outcome.check.promise)} '
        f"<i>{outcome.points:g}/{outcome.check.points:g}</i><p>{escape(outcome.verdict.message)}</p></li>"
        for outcome in said.outcomes
    )
    mistake = "" if said.mistake is None else f'<p class="mistake">{escape(said.mistake.sentence)}</p>'
    printed = f"<p>Your code printed:</p><pre>{escape(said.printed[-400:])}</pre>" if said.printed.strip() else ""
    return (
        f'<div class="wb wb-pad wb-report" role="status"><p class="count">{escape(counted(said))}</p>'
        f"{mistake}<ul>{checks}</ul>{printed}</div>"
    )


def _task(exercise: Exercise, *, alone: bool) -> str:
    name = escape(exercise.name)
    begin = "" if alone else f"<pre>{escape(chr(10).join(commands(exercise)))}</pre>"
    promises = "".join(
        f"<li>{escape(check.promise)} ({check.points:g})</li>" for check in exercise.checks if check.public
    )
    hidden = sum(not check.public for check in exercise.checks)
    more = f"<li>{hidden} more that are run where a class is graded</li>" if hidden else ""
    opened = " open" if alone else ""
    return (
        f'<div class="wb wb-pad"><h2>{"The task" if alone else name}</h2><p>{escape(exercise.task)}</p>{begin}'
        f"<details{opened}><summary>The contract</summary><pre>{escape(starter(exercise))}</pre></details>"
        f"<details><summary>What is checked</summary><ul>{promises}{more}</ul></details></div>"
    )
