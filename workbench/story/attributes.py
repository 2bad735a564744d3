"""Attributes in braces, as Pandoc writes them: `{#name .class key=value key="some words"}`."""

import re
from collections.abc import Mapping
from dataclasses import dataclass, field

_VALUE = r'(?:"[^"\n]*"|[^\s"{}]*)'
_ONE = rf"(?:#[\w-]+|\.[\w-]+|[\w-]+={_VALUE})"
BRACES = re.compile(rf"\{{\s*({_ONE}(?:\s+{_ONE})*)\s*\}}")
"""Attributes in braces; what stands in them is the first group."""
HEADING = re.compile(
    rf"^(?P<words>.*?)\s*(?:\{{\s*(?P<attributes>{_ONE}(?:\s+{_ONE})*)\s*\}})?\s*$"
)
"""A heading's words, and the attributes behind them, if it has any."""


@dataclass(frozen=True)
class Attributes:
    """What stands in braces: a name, classes, and values by their keys."""

    name: str = ""
    classes: tuple[str, ...] = ()
    values: Mapping[str, str] = field(default_factory=dict)

    @classmethod
    def read(cls, text: str) -> "Attributes":
        """Return what a text says, with its braces or without; what is no attribute is left out."""
        name = ""
        classes = list[str]()
        values = dict[str, str]()
        for attribute in re.findall(_ONE, text):
            if attribute.startswith("#"):
                name = attribute[1:]
            elif attribute.startswith("."):
                classes.append(attribute[1:])
            else:
                key, value = attribute.split("=", 1)
                values[key] = value.strip('"')
        return cls(name, tuple(classes), values)


def quoted(markdown: str) -> str:
    """Return Markdown with every value in braces quoted, so that any sign may stand in it."""

    def with_quotes(match: re.Match[str]) -> str:
        inside = re.sub(
            rf"([\w-]+)=({_VALUE})",
            lambda pair: pair[0] if pair[2].startswith('"') else f'{pair[1]}="{pair[2]}"',
            match[1],
        )
        return "{" + inside + "}"

    return BRACES.sub(with_quotes, markdown)
