"""The course page: a first toy, where to begin, lessons as cards in their chapters, and the map."""

from collections.abc import Iterable
from dataclasses import dataclass
from html import escape
from itertools import groupby

from workbench.chapters import MINUTES, Chapter, chapter_of
from workbench.page.bundles import FRONT_SCRIPTS, FRONT_STYLES, THIRD_PARTIES
from workbench.page.document import COURSE, document_head, scripts_html
from workbench.page.map import course_map
from workbench.page.toy import toy_html

WELCOME = (
    "Geometry and 3D vision, one algorithm at a time: see it work, move it with your hands, and"
    " write it yourself."
)
STANDS_STILL = (
    "These pages need JavaScript to move. Without it the rabbits stand still, and a lesson shows"
    " its text and pictures."
)
FRONT_LIGHT = ("front-still.webp", "front-loop.webp")
FRONT_DARK = ("front-still-dark.webp", "front-loop-dark.webp")
FRONT_PICTURES = (*FRONT_LIGHT, *FRONT_DARK)
"""A picture of a run, and the run as a loop, light and dark: `python -m assets.make_pictures` makes
them.
"""
LOOP_OF = "icp"
"""The lesson that the loop is of."""
SHORT = 2
"""Lessons of a chapter that leaves room for another beside it."""


@dataclass(frozen=True, kw_only=True)
class Card:
    """A lesson on the course page: what it says of itself, and where its page and picture are."""

    name: str
    title: str
    summary: str
    needs: tuple[str, ...]
    address: str
    picture: str
    chapter: str = ""
    minutes: int = MINUTES


def course_document(
    cards: Iterable[Card],
    *,
    root: str,
    trouble: str | None = None,
    head: str = "",
    footer: str | None = None,
) -> str:
    """Return the document of the course.

    Args:
        cards: In course order: those of a chapter stand together.
        root: The relative address of the folder with the page's own files.
        trouble: Why the page that was asked for is not shown, in one line.
        head: More HTML for the head.
        footer: What stands under it all, as HTML; None is a link to the work of others.
    """
    if footer is None:
        footer = (
            f'<footer><a href="{root}{THIRD_PARTIES}">Work of others in these pages, and its'
            " licences</a></footer>"
        )
    cards = list(cards)
    titles = {card.name: card.title for card in cards}
    chapters = [
        (chapter, list(own))
        for chapter, own in groupby(cards, key=lambda card: chapter_of(card.chapter))
    ]
    alert = f'<p class="trouble" role="alert">{escape(trouble)}</p>' if trouble else ""
    skip = (
        f'<a class="skip" href="#{chapters[0][0].address}">To the lessons</a>' if chapters else ""
    )
    return (
        f"{document_head(COURSE, WELCOME, root, styles=FRONT_STYLES, more=head)}"
        f'<body class="front">{skip}{_hero(cards, alert)}{_line(chapters)}<main id="course">'
        + _loop(cards, root)
        + "".join(_chapter(chapter, own, titles) for chapter, own in chapters)
        + f"{_map(chapters)}</main>"
        f"{footer}{scripts_html(root, FRONT_SCRIPTS)}</body></html>\n"
    )


def _hero(cards: list[Card], alert: str) -> str:
    begin = ""
    if cards:
        address, title = escape(cards[0].address), escape(cards[0].title)
        begin = (
            f'<p class="begin"><a class="button" id="begin" href="{address}">Start here:'
            f' {title}</a><a id="again" hidden></a></p>'
        )
    return (
        '<header class="hero"><div class="top"><p class="brand">Geometry workbench</p><button'
        ' type="button" id="theme" title="Light or dark (T)" aria-label="Light or'
        f' dark">◐</button></div><div class="words">{alert}<h1>Geometry you can take in your'
        ' hands</h1><p class="lead">Lay <b class="source">orange</b> on <b'
        ' class="target">blue</b>: drag it to move it, drag its ring to turn it. Six numbers are'
        f" all that a computer knows of what you do.</p>{begin}</div>{toy_html()}</header>"
        f'<noscript><p class="unscripted">{STANDS_STILL}</p></noscript>'
    )


def _loop(cards: list[Card], root: str) -> str:
    """Return a run as a loop, which the page's script shows, light or dark, and starts where the
    reader allows motion.
    """
    card = next((card for card in cards if card.name == LOOP_OF), None)
    if card is None:
        return ""
    light, dark = (" ".join(root + name for name in names) for names in (FRONT_LIGHT, FRONT_DARK))
    return (
        f'<figure id="loop" data-light="{light}" data-dark="{dark}"><noscript><img'
        f' src="{root}{FRONT_LIGHT[0]}" width="400" height="281" alt="An orange rabbit turns step'
        ' by step onto a blue one."></noscript><figcaption>Every lesson is a'
        f' run, step by step. This one: <a href="{escape(card.address)}">{escape(card.title)}</a>.'
        ' <button type="button" hidden>Pause</button></figcaption></figure>'
    )


def _line(chapters: list[tuple[Chapter, list[Card]]]) -> str:
    links = "".join(
        f'<a href="#{chapter.address}">{chapter.name} <span>{len(own)}</span></a>'
        for chapter, own in chapters
    )
    return f'<nav class="line" aria-label="Chapters"><div>{links}</div></nav>' if links else ""


def _chapter(chapter: Chapter, cards: list[Card], titles: dict[str, str]) -> str:
    shown = "".join(_card(card, titles) for card in cards)
    short = " short" if len(cards) <= SHORT else ""
    return (
        f'<section class="chapter{short}" id="{chapter.address}"'
        f' tabindex="-1"><header><h2>{chapter.name}</h2><p>{escape(chapter.line)}</p></header><ul'
        f' class="cards">{shown}</ul></section>'
    )


def _card(card: Card, titles: dict[str, str]) -> str:
    before = [_in_sentence(titles[name]) for name in card.needs if name in titles]
    facts = f"{card.minutes} min" + (f" · after {escape(', '.join(before))}" if before else "")
    return (
        f'<li data-card="{escape(card.name)}"><img src="{escape(card.picture)}" alt="" width="480"'
        ' height="300" loading="lazy">'
        f'<h3><a href="{escape(card.address)}">{escape(card.title)}</a></h3>'
        f"<p>{escape(card.summary)}</p>"
        f'<p class="facts">{facts}<span class="done"></span></p>'
        '<div class="bar" hidden><span></span></div></li>'
    )


def _in_sentence(title: str) -> str:
    """Return a title as it stands within a sentence: RANSAC stays as it is."""
    return title if title[1:2].isupper() else title[:1].lower() + title[1:]


def _map(chapters: list[tuple[Chapter, list[Card]]]) -> str:
    cards = [card for _, own in chapters for card in own]
    return course_map(
        {card.name: card.title for card in cards},
        {card.name: card.needs for card in cards},
        {card.name: card.address for card in cards},
        chapters={chapter.name: [card.name for card in own] for chapter, own in chapters},
    )
