"""The page of the course: a card with a picture for each lesson, the same in every home."""

from collections.abc import Mapping, Sequence
from html import escape

from workbench.page.document import document_head

WELCOME = (
    "Every lesson is one algorithm that you can watch, step back through, break and write yourself. "
    "Predict first, then look."
)


def course_document(lessons: Sequence[Mapping[str, str]], *, root: str, head: str = "") -> str:
    """Return the document of the course.

    Args:
        lessons: In order; of each its name, title, summary, and the addresses of its page and its picture.
        root: The relative address of the folder with the page's own files.
        head: More HTML for the head.
    """
    cards = "".join(_card(number, lesson) for number, lesson in enumerate(lessons, 1))
    return (
        f"{document_head('Geometry workbench', 'Algorithms of 3D vision, step by step', root, head)}"
        '<body class="course"><a class="skip" href="#course">To the lessons</a><main id="course">'
        f'<h1>Geometry workbench</h1><p>{WELCOME}</p><ol class="cards">{cards}</ol></main>'
        f'<script src="{root}tools.js"></script><script src="{root}course.js"></script></body></html>\n'
    )


def _card(number: int, lesson: Mapping[str, str]) -> str:
    told = {key: escape(value) for key, value in lesson.items()}
    return (
        f'<li data-card="{told["name"]}"><a href="{told["address"]}">'
        f'<img src="{told["picture"]}" alt="" width="320" height="200" loading="lazy">'
        f"<h2>{number}. {told['title']}</h2></a><p>{told['summary']}</p><p class="
        '"done"></p></li>'
    )
