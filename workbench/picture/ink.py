"""The words, charts and legends of a picture as pixels: what little of SVG they are made of."""

import re
from typing import Any
from xml.etree import ElementTree

import numpy as np
from PIL import Image, ImageColor, ImageDraw

from workbench.picture import letters

FINER = 4
"""Shapes are drawn so many times as large, then made smaller: their edges are smooth."""
SIZE = 12.0
"""Pixels of text that says no size of its own."""


def inked(image: Image.Image, svg: str, scale: float) -> None:
    """Draw the inside of an SVG over an image.

    Args:
        image: RGB; changed.
        svg: Elements `g`, `rect`, `line`, `polyline`, `circle`, `text`, `tspan`,
            `linearGradient`.
        scale: Pixels of the image to one of the SVG.
    """
    root = ElementTree.fromstring(f"<g>{svg}</g>")
    pen = _Pen(image, scale)
    pen.group(root, 0.0, 0.0)
    pen.finish()


class _Pen:
    """Draws shapes on a finer layer, and notes the words, which come on top."""

    def __init__(self, image: Image.Image, scale: float):
        self._image = image
        self._scale = scale
        self._ramps: dict[str, list[str]] = {}
        self._words: list[tuple[Any, float, float]] = []

    def group(self, group: ElementTree.Element, x: float, y: float) -> None:
        for element in group:
            if element.tag == "g":
                dx, dy = _shift(element.get("transform", ""))
                self.group(element, x + dx, y + dy)
            elif element.tag == "text":
                self._words.append((element, x, y))
            elif element.tag == "linearGradient":
                self._ramps[element.get("id", "")] = [
                    stop.get("stop-color", "") for stop in element
                ]
            else:
                self._shape(element, x, y)

    def finish(self) -> None:
        for element, x, y in self._words:
            self._text(element, x, y)

    def _shape(self, element: ElementTree.Element, x: float, y: float) -> None:
        """Draw one shape in the part of the picture that it needs."""
        points = _outline(element) + np.array([x, y])
        wide = float(element.get("stroke-width", 1)) * (element.get("stroke", "none") != "none")
        low = np.floor((points.min(0) - wide / 2) * self._scale - 1).astype(int)
        high = np.ceil((points.max(0) + wide / 2) * self._scale + 1).astype(int)
        low = np.clip(low, 0, self._image.size)
        high = np.clip(high, 0, self._image.size)
        size = high - low
        if (size <= 0).any():
            return
        fill = element.get("fill", "none")
        if fill.startswith("url("):
            self._ramp(self._ramps[fill[5:-1]], points)
            return
        mask = Image.new("L", (FINER * int(size[0]), FINER * int(size[1])))
        place = FINER * (points * self._scale - low)
        _drawn(ImageDraw.Draw(mask), element, place, scale=FINER * self._scale)
        opacity = float(element.get("fill-opacity", 1)) * float(element.get("opacity", 1))
        small = mask.reduce(FINER).point([round(opacity * i) for i in range(256)])
        color = ImageColor.getrgb(fill if wide == 0 else element.get("stroke", fill))
        self._image.paste(color, tuple(low.tolist()), small)

    def _ramp(self, colors: list[str], points: np.ndarray) -> None:
        left, top = np.rint(points.min(0) * self._scale).astype(int).tolist()
        right, low = np.rint(points.max(0) * self._scale).astype(int).tolist()
        stops = np.array([ImageColor.getrgb(color) for color in colors])
        at = np.linspace(0, len(stops) - 1, max(1, right - left))
        row = [np.interp(at, np.arange(len(stops)), stops[:, i]) for i in range(3)]
        rows = np.broadcast_to(
            np.rint(np.stack(row, -1)).astype(np.uint8), (max(1, low - top), len(at), 3)
        )
        self._image.paste(Image.fromarray(np.ascontiguousarray(rows)), (left, top))

    def _text(self, element: ElementTree.Element, x: float, y: float) -> None:
        size = float(element.get("font-size", SIZE))
        weight = int(element.get("font-weight", letters.PLAIN))
        ink = element.get("fill", "#000000")
        parts = [(element.text or "", ink, 0.0)]
        for part in element:
            parts.append((part.text or "", part.get("fill", ink), float(part.get("dx", 0))))
            parts.append((part.tail or "", ink, 0.0))
        parts = [part for part in parts if part[0]]
        wide = sum(letters.width(text, size, weight) + dx for text, _, dx in parts)
        share = {"middle": 0.5, "end": 1.0}.get(element.get("text-anchor", ""), 0.0)
        left = x + float(element.get("x", 0)) - share * wide
        base = y + float(element.get("y", 0))
        for text, color, dx in parts:
            left += dx
            letters.write(
                self._image,
                (left * self._scale, base * self._scale),
                text,
                size=size * self._scale,
                weight=weight,
                ink=color,
            )
            left += letters.width(text, size, weight)


def _shift(transform: str) -> tuple[float, float]:
    match = re.fullmatch(r"translate\((\S+) (\S+)\)", transform)
    return (float(match[1]), float(match[2])) if match else (0.0, 0.0)


def _outline(element: ElementTree.Element) -> np.ndarray:
    """Return the points (n, 2) of a shape; two corners of what is round or a rectangle."""

    def number(name: str) -> float:
        return float(element.get(name, 0))

    if element.tag == "line":
        return np.array([[number("x1"), number("y1")], [number("x2"), number("y2")]])
    if element.tag == "polyline":
        return np.array([pair.split(",") for pair in element.get("points", "").split()], float)
    if element.tag == "circle":
        center = np.array([number("cx"), number("cy")])
        return np.stack([center - number("r"), center + number("r")])
    if element.tag == "rect":
        corner = np.array([number("x"), number("y")])
        return np.stack([corner, corner + np.array([number("width"), number("height")])])
    raise ValueError(f"a picture has no <{element.tag}>")


def _drawn(draw: Any, element: ElementTree.Element, place: np.ndarray, *, scale: float) -> None:
    if element.tag == "rect":
        draw.rectangle(place.ravel().tolist(), fill=255)
        return
    if element.tag == "circle":
        draw.ellipse(place.ravel().tolist(), fill=255)
        return
    wide = max(1, round(float(element.get("stroke-width", 1)) * scale))
    dashes = [float(n) * scale for n in element.get("stroke-dasharray", "").split()]
    for piece in _dashed(place, *dashes) if dashes else [place]:
        draw.line([tuple(p) for p in piece.tolist()], fill=255, width=wide, joint="curve")
        if element.get("stroke-linecap") == "round":
            for u, v in (piece[0], piece[-1]):
                draw.ellipse([u - wide / 2, v - wide / 2, u + wide / 2, v + wide / 2], fill=255)


def _dashed(place: np.ndarray, on: float, off: float) -> list[np.ndarray]:
    """Return the dashes of a line as lines of their own."""
    steps = np.linalg.norm(np.diff(place, axis=0), axis=1)
    at = np.concatenate([[0.0], np.cumsum(steps)])
    starts = np.arange(0.0, at[-1], on + off)
    dashes = []
    for start in starts:
        stop = min(start + on, at[-1])
        inner = at[(at > start) & (at < stop)]
        along = np.concatenate([[start], inner, [stop]])
        dashes.append(np.column_stack([np.interp(along, at, place[:, i]) for i in range(2)]))
    return dashes
