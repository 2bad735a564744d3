"""Words as pixels: in the page's own letters, with those of formulas for what they lack."""

import functools
import importlib.util
import io
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from fontTools.ttLib import TTFont
from PIL import Image, ImageDraw, ImageFont

from workbench.page.bundles import STATIC

SERIF = "source-serif-4-latin-wght-normal.woff2"
PLAIN = 400
BOLD = 600
"""Weights."""
FINE = 256.0
"""The size at which letters are measured, pixels."""
OVER = 4
"""How many times as large letters are drawn before they are made small."""


@functools.cache
def _files() -> tuple[tuple[bytes, frozenset[int]], ...]:
    """Return the fonts, best first, as files that Pillow reads, each with the characters it
    has.
    """
    package = importlib.util.find_spec("ziamath")
    origin = None if package is None else package.origin
    others = [] if origin is None else sorted(Path(origin).parent.rglob("STIXTwoMath*.ttf"))
    fonts = []
    for path in (STATIC / SERIF, *others[:1]):
        font = TTFont(path)
        font.flavor = None
        file = io.BytesIO()
        font.save(file, reorderTables=None)
        fonts.append((file.getvalue(), frozenset(font.getBestCmap() or ())))
    return tuple(fonts)


@functools.lru_cache(64)
def _font(which: int, size: float, weight: int) -> ImageFont.FreeTypeFont:
    data, _ = _files()[which]
    font = ImageFont.truetype(io.BytesIO(data), size, layout_engine=ImageFont.Layout.BASIC)
    if which == 0:
        font.set_variation_by_axes([weight])
    return font


def _runs(text: str) -> Iterator[tuple[int, str]]:
    """Yield pieces of a text with the number of the font that has them."""
    start = 0
    before = None
    for i, sign in enumerate(text):
        has = (k for k, (_, known) in enumerate(_files()) if ord(sign) in known)
        which = next(has, len(_files()) - 1)
        if before is not None and which != before:
            yield before, text[start:i]
            start = i
        before = which
    if before is not None:
        yield before, text[start:]


def width(text: str, size: float, weight: int = PLAIN) -> float:
    """Return how wide a line of text is, in the unit of its size."""
    wide = sum(_font(which, FINE, weight).getlength(part) for which, part in _runs(text))
    return wide * size / FINE


def write(
    image: Image.Image, place: tuple[float, float], text: str, *, size: float, weight: int, ink: str
) -> None:
    """Write a line of text into an image, its baseline beginning at a place, pixels.

    Pillow sets every letter on a whole pixel. So it is drawn `OVER` times as large and made small:
    else words would stand too close or too far apart, and a long line end elsewhere than measured.
    """
    left, base = (int(OVER * at) for at in place)
    high = OVER * int(np.ceil(2 * size))
    wide = OVER * int(np.ceil(width(text, size, weight) + 2 * size))
    mask = Image.new("L", (wide, 2 * high))
    draw = ImageDraw.Draw(mask)
    x = left % OVER
    for which, part in _runs(text):
        font = _font(which, round(OVER * size, 2), weight)
        draw.text((x, high + base % OVER), part, fill=255, font=font, anchor="ls")
        x += font.getlength(part)
    image.paste(ink, (left // OVER, base // OVER - high // OVER), mask.reduce(OVER))


def lines(text: str, size: float, room: float, *, most: int = 6) -> list[str]:
    """Return a text in lines that fit a width; beyond `most` of them it ends."""
    rows = [""]
    for word in text.split():
        longer = f"{rows[-1]} {word}".strip()
        if rows[-1] and width(longer, size) > room:
            rows.append(word)
        else:
            rows[-1] = longer
    if len(rows) > most:
        rows = [*rows[: most - 1], f"{rows[most - 1]} …"]
    return [line for line in rows if line]
