"""The Exercise tab: what to write, the contract, and what the checks say of the file that is being watched."""

from collections.abc import Callable
from typing import Any

import viser

from workbench.exercise.model import Exercise
from workbench.exercise.starter import starter
from workbench.exercise.watching import Watched
from workbench.lesson import Lesson
from workbench.viewer.style import escape


class ExerciseTab:
    """A lesson's exercises, in the container that is open.

    Args:
        gui: The client's interface.
        lesson: Whose exercises these are.
        watched: The student's file that drives this lesson, if one does.
        to_difference: Goes to the first step at which the student's run differs.
    """

    def __init__(self, gui: viser.GuiApi, lesson: Lesson, watched: Watched | None, to_difference: Callable[[], None]):
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
        exercises = lesson.exercises if watched is None else (watched.exercise,)
        for exercise in exercises:
            gui.add_html(_task(exercise, alone=watched is not None))

    def show(self, report: str) -> None:
        """Show what the checks say."""
        if self._result is not None:
            self._result.content = (
                f'<div class="wb wb-pad" role="status"><pre class="wb-report">{escape(report)}</pre></div>'
            )


def _task(exercise: Exercise, *, alone: bool) -> str:
    name = escape(exercise.name)
    begin = (
        ""
        if alone
        else f"<pre>workbench exercise {name}\nworkbench show {escape(exercise.lesson)} --with my_{name}.py\n"
        f"workbench check my_{name}.py</pre>"
    )
    promises = "".join(
        f"<li>{escape(check.promise)} ({check.points:g})</li>" for check in exercise.checks if check.public
    )
    hidden = sum(not check.public for check in exercise.checks)
    more = f"<li>{hidden} more that are run where a class is graded</li>" if hidden else ""
    opened = " open" if alone else ""
    return (
        f'<div class="wb wb-pad"><h2>{name}</h2><p>{escape(exercise.task)}</p>{begin}'
        f"<details{opened}><summary>The contract</summary><pre>{escape(starter(exercise))}</pre></details>"
        f"<details><summary>What is checked</summary><ul>{promises}{more}</ul></details></div>"
    )
