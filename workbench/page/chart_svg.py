"""The charts of a step as SVG, for paper and for where no script runs: made of the same plain data
that the page's scripts draw from, whole, with a line where the step is.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from html import escape
from typing import Any

import numpy as np

from workbench.page.charts import slug
from workbench.page.legend import css_color
from workbench.scene import PALETTE

WIDTH = 640
HIGH = 170
"""Pixels of a chart; one of several rows has ROW."""
ROW = 112
LEFT = 58
RIGHT = 16
TOP = 30
BOTTOM = 24
"""What is left free around its curves."""
SOFT = "#5d646d"
GRID = "#e3e5e8"
INK = "#1b1d20"
MARK = "#b8528f"
MOST_CURVES = 12
"""Curves of a chart that have a name above it."""

Run = Mapping[str, Any]
"""A run as plain data: steps, things, series, charts, end."""
Size = tuple[int, int]
"""Width and height of a chart, pixels."""


def charts_svg(
    run: Run, k: int, names: Sequence[str], *, hide: Sequence[str] = (), wide: int = WIDTH
) -> tuple[str, int]:
    """Return the charts of a step, one below the other, as the inside of an SVG, and their height.

    Args:
        run: All of a run, as `Steps.whole` returns it.
        k: The step.
        names: What is drawn, by the names of page.md; what the step does not have is left out.
        hide: Names of parts that are left out.
        wide: Pixels of the SVG's width.
    """
    charts = [draw for draw in (_named(run, k, name) for name in names) if draw is not None]
    room = HIGH if len(charts) == 1 else ROW
    parts = [
        f'<g transform="translate(0 {i * room})">{"".join(draw((wide, room), hide))}</g>'
        for i, draw in enumerate(charts)
    ]
    return "".join(parts), room * len(charts)


def telling_chart(run: Run, k: int, telling: str) -> str:
    """Return the name of the chart that tells most of a step; empty where it has none.

    Args:
        run: All of a run.
        k: The step.
        telling: The title of what tells most, as the lesson says it; empty for the first chart.
    """
    shown = [thing for thing in _things(run, k) if thing["kind"] in ("plot", "curves")]
    titles = {chart["title"]: chart["name"] for chart in shown}
    titles = {title: chart["name"] for title, chart in run["charts"].items()} | titles
    own = next((name for title, name in titles.items() if telling and title == telling), "")
    own = own or next(
        (n for title, n in titles.items() if telling and title.startswith(telling)), ""
    )
    return own or next(iter(titles.values()), "")


def _things(run: Run, k: int) -> list[dict[str, Any]]:
    things = (run["things"][n] for n in run["steps"][k]["shown"])
    return [thing for thing in things if isinstance(thing, dict)]


def _named(run: Run, k: int, name: str) -> Callable[[Size, Sequence[str]], Iterator[str]] | None:
    """Return what draws a chart of a name; None where the step has none."""
    base, _, near = name.partition("@")
    for thing in _things(run, k):
        if thing["kind"] == "plot" and thing["name"] == base:
            axes = thing["near"] if near and thing["near"] else thing
            return lambda size, hide: _plot(
                run, thing | {"x": axes["x"], "y": axes["y"]}, size, hide=hide
            )
    by_name = {about["name"]: title for title, about in run["charts"].items()}
    by_name |= {
        slug(series[key]): series["chart"] for series in run["series"] for key in ("path", "name")
    }
    if base in by_name:
        return lambda size, hide: _over_steps(run, by_name[base], k=k, size=size)
    for thing in _things(run, k):
        if thing["kind"] == "curves" and base in (
            thing["name"],
            slug(thing["title"].split(":")[0]),
        ):
            return lambda size, hide: _curves(thing, size)
    return None


def _plot(run: Run, plot: Mapping[str, Any], size: Size, *, hide: Sequence[str]) -> Iterator[str]:
    def kept(kind: str) -> list[Any]:
        parts = [run["things"][part] if isinstance(part, int) else part for part in plot[kind]]
        role = kind.rstrip("s")
        return [part for part in parts if role not in hide and slug(part["name"]) not in hide]

    whole = kept("whole")
    seconds = kept("seconds")
    box = _Box(plot["x"], plot["y"], size)
    yield from box.axes(plot["x_label"], plot["y_label"])
    yield from _names([*whole, *seconds], size)
    for band in kept("bands"):
        low = box.px(band["low"])
        end = box.px(band["high"])
        yield (
            f'<rect x="{low:.1f}" y="{size[1] - BOTTOM - 3}" width="{max(0.0, end - low):.1f}"'
            f' height="6" fill="{_ink(band["color"])}"/>'
        )
    for part in whole:
        yield from box.line(part)
    for part in seconds:
        yield from box.line(part, "6 5")
    for part in kept("marks"):
        y = None if part["y"] is None else min(part["y"], plot["y"]["high"])
        yield from box.dots({"x": [part["x"]], "y": [y], "color": part["color"]}, 6)


def _over_steps(run: Run, chart: str, *, k: int, size: Size) -> Iterator[str]:
    lines = [line for line in run["series"] if line["chart"] == chart]
    about = run["charts"][chart]
    end = run["end"] if run["end"] is not None and k <= run["end"] else len(run["steps"]) - 1
    across = {"low": 0, "high": max(1, end), "ticks": [0, end], "words": ["0", f"{end} steps"]}
    box = _Box(across, about["y"], size)
    label = about["yLabel"]
    head = (
        label
        if label.lower().startswith(chart.lower())
        else ", ".join(filter(None, (chart, label)))
    )
    yield from box.axes("", head)
    yield box.upright(k)
    yield from _names(lines, size)
    for line in lines:
        values = [_plotted(value, line["log"]) for value in line["values"][: end + 1]]
        yield from box.line({"x": range(len(values)), "y": values, "color": line["color"]})


def _plotted(value: float | None, log: bool) -> float | None:
    if value is None or not log:
        return value
    return float(np.log10(value)) if value > 0 else None


def _curves(chart: Mapping[str, Any], size: Size) -> Iterator[str]:
    box = _Box(chart["x"], chart["y"], size)
    yield from box.axes(chart["xLabel"], chart["yLabel"] or chart["title"])
    yield from _names(chart["curves"], size)
    for curve in chart["curves"]:
        if curve["kind"] == "dots":
            yield from box.dots(curve, 2.5)
        elif curve["kind"] == "bars":
            yield from box.bars(curve)
        else:
            yield from box.line(curve)
        yield from map(box.upright, curve["marks"])


def _names(curves: Sequence[Mapping[str, Any]], size: Size) -> Iterator[str]:
    """Return the names of several curves, in their colours, in the upper right corner."""
    if len(curves) < 2:
        return
    words = "".join(
        f'<tspan fill="{_ink(c["color"])}" dx="10">● </tspan><tspan>{escape(c["name"])}</tspan>'
        for c in curves[:MOST_CURVES]
    )
    yield f'<text x="{size[0] - RIGHT}" y="{TOP - 2}" text-anchor="end">{words}</text>'


def _ink(color: str) -> str:
    return css_color(PALETTE[color]) if color in PALETTE else escape(color)  # type: ignore[index]


class _Box:
    """Where the values of two axes are in a chart of a size, pixels."""

    def __init__(self, x: Mapping[str, Any], y: Mapping[str, Any], size: Size):
        self._x = x
        self._y = y
        self._wide, self._high = size

    def px(self, x: float) -> float:
        """Return the column of a value."""
        share = (x - self._x["low"]) / (self._x["high"] - self._x["low"])
        return LEFT + share * (self._wide - LEFT - RIGHT)

    def py(self, y: float) -> float:
        """Return the row of a value."""
        share = (y - self._y["low"]) / (self._y["high"] - self._y["low"])
        return self._high - BOTTOM - share * (self._high - TOP - BOTTOM)

    def axes(self, across: str, up: str) -> Iterator[str]:
        """Return the ticks, their words, and the words of both axes."""
        room = max(1, (self._high - TOP - BOTTOM) // 18)
        ticks = list(zip(self._y["ticks"], self._y["words"], strict=True))
        for tick, word in ticks[:: -(-len(ticks) // room)]:
            y = self.py(tick)
            yield (
                f'<line x1="{LEFT}" x2="{self._wide - RIGHT}" y1="{y:.1f}" y2="{y:.1f}"'
                f' stroke="{GRID}"/><text x="{LEFT - 7}" y="{y + 4:.1f}"'
                f' text-anchor="end">{escape(word)}</text>'
            )
        low = self._high - BOTTOM + 17
        for tick, word in zip(self._x["ticks"], self._x["words"], strict=True):
            x = self.px(tick)
            anchor = "middle" if x + 4 * len(word) < self._wide else "end"
            place = x if anchor == "middle" else self._wide - 4
            yield f'<text x="{place:.1f}" y="{low}" text-anchor="{anchor}">{escape(word)}</text>'
        label = f"{up}, over {across}" if across.strip() else up
        yield f'<text x="4" y="12" fill="{INK}" font-weight="600">{escape(label)}</text>'

    def upright(self, x: float) -> str:
        """Return a line from below to above at a value of x."""
        at = f"{self.px(x):.1f}"
        low = self._high - BOTTOM
        return f'<line x1="{at}" x2="{at}" y1="{TOP}" y2="{low}" stroke="{MARK}"/>'

    def line(self, curve: Mapping[str, Any], dashes: str = "") -> Iterator[str]:
        """Return a curve in pieces: without what has no value, or lies beyond the axes."""
        pieces: list[list[str]] = [[]]
        for x, y in zip(curve["x"], curve["y"], strict=True):
            if y is None or not (self._inside(x, self._x) and self._inside(y, self._y)):
                pieces.append([])
            else:
                pieces[-1].append(f"{self.px(x):.1f},{self.py(y):.1f}")
        dash = f' stroke-dasharray="{dashes}"' if dashes else ""
        for piece in pieces:
            if piece:
                points = " ".join(piece if len(piece) > 1 else 2 * piece)
                yield (
                    f'<polyline points="{points}" fill="none" stroke="{_ink(curve["color"])}"'
                    f' stroke-width="2.2" stroke-linecap="round"{dash}/>'
                )

    def dots(self, curve: Mapping[str, Any], radius: float) -> Iterator[str]:
        """Return a dot for each point that has a value."""
        for x, y in zip(curve["x"], curve["y"], strict=True):
            if y is not None:
                yield (
                    f'<circle cx="{self.px(x):.1f}" cy="{self.py(y):.1f}" r="{radius}"'
                    f' fill="{_ink(curve["color"])}"/>'
                )

    def bars(self, curve: Mapping[str, Any]) -> Iterator[str]:
        """Return bars that stand on zero, as wide as the nearest two are apart."""
        gaps = np.diff(np.array(curve["x"], float))
        half = 0.48 * (gaps[gaps > 0].min() if (gaps > 0).any() else 1.0)
        for x, y in zip(curve["x"], curve["y"], strict=True):
            if y is not None:
                left = self.px(x - half)
                ground = self.py(0)
                top = self.py(y)
                yield (
                    f'<rect x="{left:.1f}" width="{self.px(x + half) - left:.1f}"'
                    f' y="{min(top, ground):.1f}" height="{abs(ground - top):.1f}"'
                    f' fill="{_ink(curve["color"])}" fill-opacity=".6"/>'
                )

    @staticmethod
    def _inside(value: float, axis: Mapping[str, Any]) -> bool:
        room = 1e-9 * (axis["high"] - axis["low"])
        return axis["low"] - room <= value <= axis["high"] + room
