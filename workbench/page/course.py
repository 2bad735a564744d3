"""The course page: every lesson as a card with a picture, in course order, with ticks for what was
done in this browser.
"""

from collections.abc import Iterable
from dataclasses import dataclass
from html import escape

from workbench.page.document import THIRD_PARTIES, document_head
from workbench.page.map import course_map

WELCOME = (
    "Every lesson is one algorithm that you can watch, step back through, break and write yourself."
    " Predict first, then look."
)


@dataclass(frozen=True, kw_only=True)
class Card:
    """A lesson on the course page: name, title, summary, what it builds on, and where its page and
    picture are.
    """

    name: str
    title: str
    summary: str
    needs: tuple[str, ...]
    address: str
    picture: str


def course_document(
    cards: Iterable[Card], *, root: str, trouble: str | None = None, head: str = ""
) -> str:
    """Return the document of the course.

    Args:
        cards: In course order.
        root: The relative address of the folder with the page's own files.
        trouble: Why the page that was asked for is not shown, in one line.
        head: More HTML for the head.
    """
    cards = list(cards)
    shown = "".join(_card(number, card) for number, card in enumerate(cards, 1))
    said = f'<p class="trouble" role="alert">{escape(trouble)}</p>' if trouble else ""
    return (
        f"{document_head('Geometry workbench', WELCOME, root, more=head)}"
        '<body class="course"><a class="skip" href="#course">To the lessons</a><main id="course">'
        f"<h1>Geometry workbench</h1><p>{WELCOME}</p>{said}<ol"
        f' class="cards">{shown}</ol>{_map(cards)}'
        f'<p><a href="{root}{THIRD_PARTIES}">Work of others in these pages, and its'
        " licences</a></p></main>"
        f'<script src="{root}tools.js"></script><script'
        f' src="{root}progress.js"></script></body></html>\n'
    )


def _map(cards: list[Card]) -> str:
    return course_map(
        {card.name: card.title for card in cards},
        {card.name: card.needs for card in cards},
        {card.name: card.address for card in cards},
    )


def _card(number: int, card: Card) -> str:
    return (
        f'<li data-card="{escape(card.name)}"><a href="{escape(card.address)}">'
        f'<img src="{escape(card.picture)}" alt="" width="320" height="200" loading="lazy">'
        f"<h2>{number}. {escape(card.title)}</h2><p>{escape(card.summary)}</p></a>"
        '<small class="done"></small></li>'
    )
