"""The course page: every lesson as a card, in course order, with ticks for what was done in this browser."""

from collections.abc import Callable, Iterable
from html import escape

from workbench.lesson import Lesson
from workbench.page.ending import Address

WELCOME = (
    "Every lesson is one algorithm that you can watch, step back through, break and write yourself. "
    "Predict first, then look."
)


def course_document(
    lessons: Iterable[Lesson],
    address: Address,
    *,
    root: str,
    trouble: str | None = None,
    picture: Callable[[Lesson], str] = lambda lesson: "",
) -> str:
    """Return the document of the course.

    Args:
        lessons: In course order.
        address: What the card of a lesson leads to.
        root: The relative address of the folder with the page's own files.
        trouble: Why the page that was asked for is not shown, in one line.
        picture: The HTML of a lesson's picture.
    """
    cards = "".join(_card(number, lesson, address, picture(lesson)) for number, lesson in enumerate(lessons, 1))
    said = f'<p class="trouble" role="alert">{escape(trouble)}</p>' if trouble else ""
    return (
        '<!doctype html><html lang="en"><head><meta charset="utf-8">'
        '<meta name="viewport" content="width=device-width, initial-scale=1"><title>Geometry workbench</title>'
        f'<meta name="description" content="{WELCOME}"><link rel="icon" href="data:,">'
        f'<link rel="stylesheet" href="{root}page.css"><link rel="stylesheet" href="{root}course.css"></head>'
        f'<body class="course"><header><h1>Geometry workbench</h1><p>{WELCOME}</p>{said}</header>'
        f'<main><ol class="cards">{cards}</ol></main>'
        f'<script src="{root}tools.js"></script><script src="{root}progress.js"></script></body></html>\n'
    )


def _card(number: int, lesson: Lesson, address: Address, picture: str) -> str:
    return (
        f'<li data-lesson="{escape(lesson.name)}" data-questions="{len(lesson.questions)}">'
        f'<a href="{escape(address(lesson))}"><span class="picture" aria-hidden="true">{picture or number}</span>'
        f"<strong>{number}. {escape(lesson.title)}</strong><span>{escape(lesson.summary)}</span></a>"
        '<small class="done"></small></li>'
    )
