"""The course: all lessons in order, with a tick for what was done."""

from collections.abc import Callable, Iterable

import viser

from workbench.lesson import Lesson
from workbench.page.legend import escape
from workbench.viewer.progress import Progress

WELCOME = (
    '<div class="wb wb-pad" style="padding-bottom:0"><h1>Geometry workbench</h1><p>Every lesson is one algorithm that you '
    "can watch, step back through, break and write yourself. Predict first, then look.</p></div>"
)


def add_course(
    gui: viser.GuiApi,
    lessons: Iterable[Lesson],
    progress: Progress,
    open_lesson: Callable[[Lesson], None],
    current: Lesson | None = None,
) -> None:
    """Add the list of lessons to the container that is open."""
    gui.add_html(WELCOME)
    for number, lesson in enumerate(lessons, 1):
        gui.add_html(
            f'<div class="wb wb-card"><h2>{number}. {escape(lesson.title)}</h2><div>{escape(lesson.summary)}</div>'
            f"{_done(lesson, progress)}</div>"
        )
        here = lesson is current
        button = gui.add_button("You are here" if here else f"Open {lesson.title}", disabled=here)

        @button.on_click
        async def _(event: viser.GuiEvent, lesson: Lesson = lesson) -> None:
            if event.client is not None:
                open_lesson(lesson)


def _done(lesson: Lesson, progress: Progress) -> str:
    if not progress.visited(lesson.name):
        return ""
    total = len(lesson.questions)
    answered = len(progress.answers(lesson.name))
    questions = f", {answered} of {total} questions answered" if total else ""
    tick = "✓ done" if answered >= total else "✓ opened"
    return f'<div class="wb-done">{tick}{questions}</div>'
