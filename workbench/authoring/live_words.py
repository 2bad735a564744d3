"""Finds in a text what only a live page lets people do: click, drag, hand over a file, turn a knob
that is not published.

A published page, a notebook and a recording have links, steps, a scene to look at from all sides
and, of the knobs, those of `sweeps`. Words are found where they ask somebody to do it; "outliers
drag the line" and "each turn of the frame" are not.
"""

import functools
import re
from collections.abc import Iterator, Mapping

from workbench.knobs import fields_of
from workbench.lesson import Lesson
from workbench.words.typeset import WORDING

_CLAUSE = r"(?:\A|\n\s*\n|\n\s*(?:[-*#|]|\d+\.)|[.:;,!?(|–—…])\s*(?:(?:and|or|then|now|just|simply|please)\s+)?"  # noqa: E501
_ASKED = rf"(?:{_CLAUSE}|\b(?:you|you\s+(?:can|may|must)|or|then)\s+)"
_THING = (
    r"(?:it|them|an?|the|one|two|three|any|its|your|another|this|that|these|those|each|every)\b"
)
_DOING = tuple(
    re.compile(pattern, re.IGNORECASE)
    for pattern in (
        (
            r"(?<!\ba )(?<!\bthe )(?<!\bone )(?<!\bper )(?<!\beach )(?<!\bevery"
            r" )(?P<said>\bclick(?:ed|ing)?\b)"
        ),
        rf"{_ASKED}(?P<said>(?:drag|tap|pinch|hover\s+over)\s+{_THING})",
        r"(?P<said>\b(?:can|may|could|must)\s+be\s+dragged\b)",
        rf"{_CLAUSE}(?P<said>(?:upload|hand\s+over|drop)\s+(?:an?|your)\s+(?:own\s+)?\w+)",
        rf"{_CLAUSE}(?P<said>(?:move|place|put|turn|set|pick|choose|drop)\s[^.;:]{{0,40}}\byourself\b)",
        rf"{_CLAUSE}(?P<said>(?:move|turn|use|set|pull|tick)\s+(?:the|this|that|a)\s+(?:[\w-]+\s+)?"
        r"(?:knob|slider|handle|switch|check\s*box)s?\b)",
    )
)
_TURN = r"(?:turn|raise|lower|increase|reduce|decrease|vary|change|set)"
_COMMANDS = re.compile(r"(?:(?!\n\s*\n).)*`[^`]*--[a-z](?:(?!\n\s*\n).)*", re.DOTALL)
_HIDDEN = re.compile(
    r"```.*?```|\$\$.*?\$\$|\$[^$\n]*\$"  # code and formulas
    # what links, terms and emphasis are written with
    r"|\]\([^)\s]*\)|\[\[(?:[^\]|\n]*\|)?|[\[\]*]",
    re.DOTALL,
)


def live_words(text: str, lesson: Lesson) -> Iterator[tuple[int, str]]:
    """Yield where a text asks for what only a live page can, and the words.

    A paragraph with flags of the command line, `--scan`, speaks of a command and its files, and
    names what it likes.

    Args:
        text: Plain text or a part of a page that every home shows.
        lesson: The lesson, whose knobs are not to be named except those of its sweeps. A knob is
            named in backticks or quotes, by its field or its label, or in words where it is to be
            turned.
    """
    text = _HIDDEN.sub(
        lambda match: _blank(match[0]),
        _COMMANDS.sub(lambda match: match[0].replace("`", " "), text),
    )
    words: dict[int, str] = {}
    for pattern in (*_DOING, *_naming(lesson.params, swept(lesson))):
        words |= {match.start("said"): match["said"] for match in pattern.finditer(text)}
    yield from ((place, " ".join(words[place].split())) for place in sorted(words))


def on_page(lesson: Lesson) -> Iterator[tuple[int, str]]:
    """Yield the lines of a lesson's page that ask for such things where nothing can be computed,
    and the words.
    """
    text = WORDING.sub(_only_of_site, lesson.text())
    yield from (
        (text.count("\n", 0, place) + 1, words) for place, words in live_words(text, lesson)
    )


def elsewhere(lesson: Lesson) -> Mapping[str, str]:
    """Return the other texts that every home shows before a run is seen, by what they are
    called.
    """
    texts = {"its title": lesson.title, "its summary": lesson.summary}
    for preset in lesson.presets:
        texts[f"preset {preset.name!r}"] = f"{preset.title}\n\n{preset.line}"
    for question in lesson.questions:
        texts[f"question {question.name!r}"] = "\n\n".join((question.text, *question.choices))
    published = swept(lesson)
    texts |= {
        f"knob {field.name}": field.knob.hint
        for field in fields_of(lesson.params)
        if field.name in published
    }
    return texts


def swept(lesson: Lesson) -> frozenset[str]:
    """Return the names of the knobs that published pages have too."""
    return frozenset(sweep.knob for sweep in lesson.sweeps)


@functools.lru_cache(maxsize=64)
def _naming(params: type, published: frozenset[str]) -> tuple[re.Pattern[str], ...]:
    fields = [field for field in fields_of(params) if field.name not in published]
    if not fields:
        return ()
    names = "|".join(re.escape(field.name) for field in fields)
    labels = "|".join(re.escape(field.label) for field in fields)
    spoken = "|".join(
        re.escape(word) for field in fields for word in (field.name.replace("_", " "), field.label)
    )
    end = r"(?=\s*(?:[.,:;!?)|]|\Z|\n\s*\n)|\s+(?:to\s+[-−\d]|up\b|down\b|and\s+(?:see|look|watch)\b))"  # noqa: E501
    return tuple(
        re.compile(pattern, re.IGNORECASE)
        for pattern in (
            rf"(?P<said>`(?:{names})`)",
            rf"(?P<said>[\"“](?:{labels})[\"”])",
            rf"{_CLAUSE}(?P<said>{_TURN}\s+(?:the\s+|its\s+)?(?:{spoken})){end}",
        )
    )


def _only_of_site(match: re.Match[str]) -> str:
    """Leave of two wordings the one for pages that cannot compute; all that stays keeps its
    line.
    """
    whole = match[0]
    words = match[2] if match[1] == "site" else ""
    before, _, after = whole.partition(words) if words else (whole, "", "")
    return _blank(before) + words + _blank(after)


def _blank(text: str) -> str:
    return re.sub(r"[^\n]", " ", text)
