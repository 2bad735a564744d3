"""Captions that carry their values: `say("Turned by {turned}.", turned=degrees(0.2))`.

The numbers of a caption are what its run has found; a test compares `caption.values` with what is
true, and the wording stays free. A quantity is a number with the words for it; plain numbers are
written with three significant digits.
"""

import math
import string
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from workbench import numerals
from workbench.scene import Caption


@dataclass(frozen=True)
class Quantity:
    """A number and how a sentence writes it."""

    value: float
    text: str

    def __str__(self) -> str:
        return self.text


def degrees(value: float, digits: int = 3) -> Quantity:
    """Return an angle in degrees: "0.2°"."""
    return Quantity(float(value), numerals.angle(value, digits))


def metres(value: float, digits: int = 3) -> Quantity:
    """Return a length in metres, written in the unit that suits it: "25 mm"."""
    return Quantity(float(value), numerals.length(value, digits))


def square_metres(value: float, digits: int = 3) -> Quantity:
    """Return an area or a sum of squared lengths in m²."""
    return Quantity(float(value), numerals.area(value, digits))


def pixels(value: float, digits: int = 3) -> Quantity:
    """Return a distance in an image."""
    return Quantity(float(value), numerals.pixels(value, digits))


def share(value: float, places: int | None = None) -> Quantity:
    """Return a share of 1, written in per cent: "35 %"."""
    return Quantity(float(value), numerals.percent(value, places))


def number(value: float, digits: int = 3) -> Quantity:
    """Return a number without a unit, with so many significant digits."""
    return Quantity(float(value), numerals.brief(value, digits))


def fixed(value: float, places: int) -> Quantity:
    """Return a number without a unit, with so many decimals."""
    return Quantity(float(value), numerals.fixed(value, places))


def counted(count: int, one: str, more: str = "") -> Quantity:
    """Return how many there are of what: "1 sample", "2 samples"."""
    return Quantity(count, numerals.counted(count, one, more))


def say(
    sentence: str,
    /,
    *,
    tone: Literal["info", "good", "wrong"] = "info",
    right: bool | None = None,
    settled: bool = True,
    place: str = "",
    **values: "float | str | Quantity",
) -> Caption:
    """Return a caption whose names in braces are written out, and which keeps their values.

    Args:
        sentence: What happened, with `{name}` where a value belongs.
        tone: `info`, `good` or `wrong`.
        right: For an end whose truth is known, in place of a tone: see `Caption.verdict`.
        settled: Likewise.
        place: What a story's slider calls this step: "match", "fit".
        values: A Quantity, a number or a text for each name.

    Raises:
        ValueError: If a name has no value, a value no name, or a number is not finite: say in words
            what is missing.
    """
    parts = list(string.Formatter().parse(sentence))
    names = [name for _, name, _, _ in parts if name is not None]
    if set(names) != set(values):
        apart = ", ".join(sorted(set(names) ^ set(values)))
        raise ValueError(f"the caption {sentence!r} and its values differ in: {apart}")
    if any(spec or conversion for _, _, spec, conversion in parts):
        raise ValueError(
            f"the caption {sentence!r} formats a number itself; hand it a quantity in place of that"
        )
    texts = {name: _text(sentence, name, value) for name, value in values.items()}
    told = "".join(
        before + (texts[name] if name is not None else "") for before, name, _, _ in parts
    )
    numbers = {name: _number(value) for name, value in values.items() if not isinstance(value, str)}
    if right is None:
        caption = Caption(told, tone, values=numbers)
    else:
        caption = Caption.verdict(told, right=right, settled=settled, values=numbers)
    return replace(caption, place=place) if place else caption


def _text(sentence: str, name: str, value: "float | str | Quantity") -> str:
    if isinstance(value, str):
        return value
    if not math.isfinite(_number(value)):
        raise ValueError(
            f"the caption {sentence!r}: {name} is {_number(value)}; say in words what is missing"
        )
    if isinstance(value, Quantity):
        return value.text
    return (
        numerals.fixed(value, 0) if isinstance(value, int | np.integer) else numerals.brief(value)
    )


def _number(value: "float | Quantity") -> float:
    return value.value if isinstance(value, Quantity) else float(value)
