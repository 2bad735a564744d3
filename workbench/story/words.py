"""The words of a block: numbers under the hand, numbers of a run, links that lead somewhere, words
in a thing's colour.

`[75°]{knob=start_angle}` · `[−66°]{steps=angle}` · `[25 mm]{value=rmse run=flat@stop}` ·
`[here](run:flat@1)` · `[orange points]{.source}`.
"""

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from html import escape
from typing import Any

from workbench.story.markdown import Block
from workbench.story.model import StagePlace, Told, Value
from workbench.story.names import Names


@dataclass
class Found:
    """What the words of a scene name, as it is found."""

    values: list[Value] = field(default_factory=list)
    series: list[tuple[str, str, int]] = field(default_factory=list)
    knobs: list[tuple[str, str, int]] = field(default_factory=list)
    places: list[tuple[StagePlace, int]] = field(default_factory=list)

    def told(self) -> Told:
        """Return it all, as nothing changes any more."""
        return Told(tuple(self.values), tuple(self.series), tuple(self.knobs), tuple(self.places))


class Words:
    """Makes elements of what the words of a scene name.

    Args:
        names: What there is to be named.
        scene: The name of the scene.
        found: Where it is noted.
    """

    def __init__(self, names: Names, scene: str, found: Found):
        self._names, self._scene, self._found = names, scene, found

    def resolve(self, block: Block, here: StagePlace) -> None:
        """Change the tokens of a block in place: each span and each link to a run becomes its
        element.
        """
        for token in block.tokens:
            if token.type != "inline" or not token.children:
                continue
            line = block.line + (token.map or [0])[0] - (block.tokens[0].map or [0])[0]
            token.children = list(self._children(token.children, line, here))

    def _children(self, tokens: list[Any], line: int, here: StagePlace) -> Iterator[Any]:
        plain: list[bool] = []  # of the spans that are open, whether they leave their words alone
        for i, token in enumerate(tokens):
            line += token.type in ("softbreak", "hardbreak")
            if token.type == "span_open":
                plain.append(not self._span(token, _text(tokens, i), line, here=here))
                if plain[-1]:
                    continue
            elif token.type == "span_close":
                if plain.pop():
                    continue
            elif token.type == "link_open" and str(token.attrs.get("href", "")).startswith("run:"):
                self._link(token, line)
            yield token

    def _link(self, token: Any, line: int) -> None:
        run, step = self._names.moment(str(token.attrs["href"]).removeprefix("run:"), line)
        step = self._names.opening(run) if step is None else step
        self._found.places.append((StagePlace(run=run, step=step), line))
        token.attrs = {"class": "run", "data-go": f"{run}@{step}", "href": f"#{self._scene}"}

    def _span(self, token: Any, words: str, line: int, *, here: StagePlace) -> bool:
        """Change the opening of a span; False where nothing but its words is to stay."""
        given = {key: str(value) for key, value in token.attrs.items()}
        roles = given.pop("class", "").split()
        if "knob" in given:
            return self._knob(token, given, words, line=line, here=here)
        if "steps" in given:
            self._found.series.append((here.run, given["steps"], line))
            token.attrs = {
                "class": "num",
                "data-steps": given["steps"],
                "data-unit": unit_in(words),
            }
            return True
        if "value" in given:
            self._value(token, given, words, line=line, here=here)
            return True
        token.attrs = {"class": " ".join(self._names.role(role, line) for role in roles)}
        return bool(roles)

    def _knob(
        self, token: Any, given: dict[str, str], words: str, *, line: int, here: StagePlace
    ) -> bool:
        name = given["knob"]
        ends = self._names.ends(name, given, line)
        self._found.knobs.append((here.run, name, line))
        token.attrs = {"class": "num", "data-knob": name, "data-unit": unit_in(words), **ends}
        return self._names.can_turn(name, here.run)

    def _value(
        self, token: Any, given: dict[str, str], words: str, *, line: int, here: StagePlace
    ) -> None:
        run, step = here.run, here.step
        if "run" in given:
            run, at = self._names.moment(given["run"], line)
            step = "stop" if at is None else at
        self._found.values.append(Value(words, given["value"], run, step, line))
        token.attrs = {"class": "value", "data-value": given["value"], "data-at": f"{run}@{step}"}


def _text(tokens: list[Any], start: int) -> str:
    """Return the text between a span's opening and its end."""
    depth = 0
    parts = list[str]()
    for token in tokens[start:]:
        depth += (token.type == "span_open") - (token.type == "span_close")
        if depth == 0:
            break
        parts.append(token.content if token.type in ("text", "code_inline") else "")
    return "".join(parts)


def unit_in(words: str) -> str:
    """Return what stands behind a number in words: `−66°` has `°`, `25 mm` has ` mm`."""
    return re.sub(r"^[\s−+-]*[\d.,]*", "", words)


def count(block: Block) -> int:
    """Return how many words a block has, formulas left out."""
    text = " ".join(
        child.content
        for token in block.tokens
        if token.type == "inline"
        for child in token.children or ()
        if child.type in ("text", "code_inline")
    )
    return len(re.findall(r"\S*\w\S*", text))


def element(tag: str, attributes: Mapping[str, object], html: str) -> str:
    """Return an element; attributes that are None or empty are left out."""
    given = "".join(
        f' {key}="{escape(str(value))}"'
        for key, value in attributes.items()
        if value not in (None, "")
    )
    return f"<{tag}{given}>{html}</{tag}>"
