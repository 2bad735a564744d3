"""page.md as blocks: sections by their headings, and each block of a section with the attributes
before it.
"""

import functools
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from workbench.story.attributes import HEADING, Attributes, quoted
from workbench.words.typeset import WORDING, new_parser, with_terms

CARD = "card"
"""What a block between `:::` is called among the parser's tokens."""


@dataclass(frozen=True)
class Section:
    """A part of page.md under a heading of the first or second level; the first part may have none.

    Args:
        level: 1 or 2; 0 where there is no heading.
        title: The heading's words, Markdown.
        attributes: What stands in braces behind it.
        text: What follows the heading.
        line: The line of the heading, from 1.
    """

    level: int
    title: str
    attributes: Attributes
    text: str
    line: int


@dataclass(frozen=True)
class Block:
    """A block of a section: a paragraph, a list, a formula, or a card between `:::`.

    Args:
        kind: The parser's name of it, such as `paragraph_open`.
        attributes: Those of the line before it; of a card, its own.
        tokens: What it consists of.
        line: Its first line in page.md, from 1.
    """

    kind: str
    attributes: Attributes
    tokens: Sequence[Any]
    line: int

    def html(self) -> str:
        """Return the block as HTML, with the terms in it."""
        parser = story_parser()
        return with_terms(parser.renderer.render(self.tokens, parser.options, {}))

    def text(self) -> str:
        """Return the Markdown of its words."""
        return " ".join(token.content for token in self.tokens if token.type == "inline")

    def inside(self) -> "tuple[Block, ...]":
        """Return the blocks of a card."""
        return tuple(_blocks(self.tokens[1:-1], self.line - (self.tokens[0].map or [0])[0], 1))


@functools.cache
def story_parser() -> Any:
    """Return the parser of stories: that of pages, with attributes and cards."""
    from mdit_py_plugins.attrs import attrs_block_plugin, attrs_plugin
    from mdit_py_plugins.container import container_plugin

    parser = new_parser().use(attrs_plugin, spans=True).use(attrs_block_plugin)
    return parser.use(
        container_plugin, CARD, validate=lambda info, *_: info.strip().startswith("{")
    )


def in_home(markdown: str, home: str) -> str:
    """Return page.md as one home has it, every line where it stood."""

    def kept(match: re.Match[str]) -> str:
        words = match[2] if match[1] == home else ""
        return words + "\n" * (match[0].count("\n") - words.count("\n"))

    return WORDING.sub(kept, markdown)


def sections(markdown: str) -> list[Section]:
    """Return the parts of page.md; a line within a block of code is no heading."""
    closed: list[Section] = []
    level = 0
    title = ""
    attributes = Attributes()
    first = 1
    lines: list[str] = []
    fenced = False
    for number, line in enumerate(markdown.splitlines(), 1):
        fenced ^= line.lstrip().startswith(("```", "~~~"))
        heading = None if fenced else re.match(r"(#{1,2})\s+(.*)", line)
        if heading is None:
            lines.append(line)
            continue
        closed.append(Section(level, title, attributes, "\n".join(lines), first))
        parts = HEADING.match(heading[2])
        level = len(heading[1])
        title = parts["words"] if parts else heading[2]
        attributes = Attributes.read(parts["attributes"] or "") if parts else Attributes()
        first = number
        lines = []
    closed.append(Section(level, title, attributes, "\n".join(lines), first))
    return [section for section in closed if section.level or section.text.strip()]


def blocks(section: Section) -> list[Block]:
    """Return the blocks of a section; call it, and whatever renders them, inside `typesetting`."""
    tokens = story_parser().parse(_with_whole_terms(quoted(section.text)))
    return list(_blocks(tokens, section.line + bool(section.level), 0))


def _with_whole_terms(text: str) -> str:
    """Keep the bar of a term out of tables, which would be cut there."""
    return re.sub(r"\[\[[^\]\n]*\]\]", lambda term: term[0].replace("|", r"\|"), text)


def _blocks(tokens: Sequence[Any], offset: int, level: int) -> Iterator[Block]:
    start = 0
    for i, token in enumerate(tokens):
        if token.level != level or token.nesting == 1:
            continue
        first = tokens[start]
        line = (first.map or [0])[0] + offset
        yield Block(first.type, _taken(first), tokens[start : i + 1], line)
        start = i + 1


def _taken(token: Any) -> Attributes:
    """Return the attributes of a block, and take them off it; those of a card stand behind its
    colons.
    """
    if token.type.startswith(f"container_{CARD}"):
        return Attributes.read(token.info)
    attributes = dict(token.attrs)
    classes = tuple(str(attributes.pop("class", "")).split())
    name = str(attributes.pop("id", ""))
    kept = {key: value for key, value in token.attrs.items() if key in ("start", "style")}
    token.attrs = kept
    return Attributes(
        name, classes, {key: str(value) for key, value in attributes.items() if key not in kept}
    )
