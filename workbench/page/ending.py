"""What stands behind a lesson's text: what can be done with the run that is open, and the way to the lessons beside it."""

from collections.abc import Callable
from html import escape

from workbench.lesson import Lesson

Address = Callable[[Lesson], str]
"""address(lesson) -> what a link to a lesson's page leads to."""

RUN = '<section class="s-run" id="this-run" hidden><h2>This run</h2></section>'
"""Where the page puts what its home can do with the run that is open."""


def beside_html(lessons: list[Lesson], lesson: Lesson, address: Address) -> str:
    """Return links to the lessons before and behind one, in course order; nothing where it stands alone."""
    names = [one.name for one in lessons]
    at = names.index(lesson.name) if lesson.name in names else len(lessons)
    before, behind = lessons[max(at - 1, 0) : at], lessons[at + 1 : at + 2]
    links = [_link(one, "prev", "Before this", address) for one in before]
    links += [_link(one, "next", "Next lesson", address) for one in behind]
    return f'<nav class="beside" aria-label="Lessons beside this one">{"".join(links)}</nav>' if links else ""


def _link(lesson: Lesson, rel: str, words: str, address: Address) -> str:
    return (
        f'<a rel="{rel}" href="{escape(address(lesson))}"><small>{words}</small><span>{escape(lesson.title)}</span></a>'
    )
