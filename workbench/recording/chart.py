"""Charts, colour bars and the legend, drawn with Rerun's lines and words in two dimensions.

Rerun plots numbers over time only, so a `Curve` is drawn here: frame, ticks, curves and marks, on a
canvas of `WIDTH` x `HEIGHT` with y down. The colours are the palette's; everything else is a grey
that can be read on white and on black.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np
import rerun as rr

from workbench.recording.glyphs import safe
from workbench.scene import PALETTE, Curve, Field, color_map
from workbench.words.axis import Axis, axis, number, value_axis

WIDTH, HEIGHT = 300.0, 186.0
LEFT, RIGHT, TOP, BOTTOM = 40.0, 290.0, 24.0, 138.0  # the frame of a chart on its canvas
LEGEND_WIDTH, LEGEND_ROW = 760.0, 38.0
DASH = 26.0  # how long a colour is in the legend
GREY = (115, 121, 129)


Rgb: TypeAlias = tuple[int, int, int]
Legend: TypeAlias = tuple[tuple[str, Rgb], ...]


@dataclass(frozen=True)
class Canvas:
    """A view in two dimensions: title, size, and the step at which something appears on it."""

    title: str
    width: float
    height: float
    first: int


@dataclass(frozen=True)
class Scale:
    """An axis laid onto `start` to `end` of the canvas."""

    axis: Axis
    start: float
    end: float

    def __call__(self, value: Any) -> Any:
        """Return where values lie on the canvas."""
        share = (np.asarray(value) - self.axis.low) / (self.axis.high - self.axis.low)
        return self.start + share * (self.end - self.start)


def scales(curves: Sequence[Curve]) -> tuple[Scale, Scale]:
    """Return the axes of a chart of all curves that share it."""
    xs = np.concatenate(
        [*(curve.x for curve in curves), *(np.array(curve.marks) for curve in curves)]
    ).astype(float)
    widths = [_bar_width(curve) / 2 for curve in curves if curve.kind == "bars"]
    half = max(widths, default=0.0)
    up = value_axis([curve.y.astype(float) for curve in curves], from_zero=bool(widths), most=4)
    return Scale(axis(xs.min() - half, xs.max() + half), LEFT, RIGHT), Scale(up, BOTTOM, TOP)


def chart_frame(x: Scale, y: Scale, x_label: str, *, names: Sequence[tuple[str, Rgb]]) -> list[Any]:
    """Return the axes, ticks and words of a chart."""
    strips = [np.array([[LEFT, TOP], [LEFT, BOTTOM], [RIGHT, BOTTOM]])]
    strips += [np.array([[x(tick), BOTTOM], [x(tick), BOTTOM + 4]]) for tick in x.axis.ticks]
    strips += [np.array([[LEFT - 4, y(tick)], [LEFT, y(tick)]]) for tick in y.axis.ticks]
    lines = rr.LineStrips2D(strips, colors=GREY, radii=rr.Radius.ui_points(0.5), draw_order=10.0)
    places = [(x(tick), BOTTOM + 3) for tick in x.axis.ticks] + [
        (LEFT - 20, y(tick) - 8) for tick in y.axis.ticks
    ]
    places.append(((LEFT + RIGHT) / 2, BOTTOM + 24))
    words = [*x.axis.words, *y.axis.words, x_label]
    colors = [GREY] * len(places)
    rooms = np.array([18.0 + 6.6 * len(name) for name, _ in names])
    rooms *= min(1.0, WIDTH / rooms.sum())  # closer together where they would leave the canvas
    ends = min(LEFT, WIDTH - rooms.sum()) + np.cumsum(rooms)
    places += [(end - room / 2, 0.0) for end, room in zip(ends, rooms, strict=True)]
    return [
        lines,
        _text(
            places,
            [*words, *(name for name, _ in names)],
            [*colors, *(color for _, color in names)],
        ),
    ]


def chart_curves(x: Scale, y: Scale, curves: Mapping[int, Curve]) -> list[Any]:
    """Return what stands inside the frame: lines, bars, dots and marks."""
    strips: list[np.ndarray] = []
    colors: list[tuple[int, int, int]] = []
    dots: list[np.ndarray] = [np.empty((0, 2))]
    dot_colors: list[tuple[int, int, int]] = []
    for curve in curves.values():
        known = np.isfinite(curve.y)
        at = np.column_stack([x(curve.x), y(np.where(known, curve.y, 0.0))])
        # a line of one point is a dot
        lonely = known & ~np.r_[False, known[:-1]] & ~np.r_[known[1:], False]
        if curve.kind == "dots" or (curve.kind == "line" and lonely.any()):
            shown = known if curve.kind == "dots" else lonely
            dots.append(at[shown])
            dot_colors += [PALETTE[curve.color]] * int(shown.sum())
        if curve.kind != "dots":
            pieces = _bars(curve, x, y) if curve.kind == "bars" else _pieces(at, known)
            strips += pieces
            colors += [PALETTE[curve.color]] * len(pieces)
        for mark in curve.marks:
            strips.append(np.array([[x(mark), TOP], [x(mark), BOTTOM]]))
            colors.append(PALETTE["highlight"])
    return [
        rr.LineStrips2D(strips, colors=colors, radii=rr.Radius.ui_points(0.9), draw_order=20.0),
        rr.Points2D(
            np.concatenate(dots), colors=dot_colors, radii=rr.Radius.ui_points(2.5), draw_order=21.0
        ),
    ]


def absence(word: str, canvas: Canvas) -> Any:
    """Return the words where something is shown at other steps."""
    return _text([(canvas.width / 2, canvas.height / 2)], [word], [GREY])


def bar_of(field: Field) -> dict[str, Any]:
    """Return what the colour bar of a field depends on."""
    title = f"{field.title} ({field.unit})" if field.unit else field.title
    return {"low": field.low, "high": field.high, "title": title, "colors": field.map}


def color_bar(
    *,
    low: float,
    high: float,
    title: str,
    colors: Any,
    at: tuple[float, float],
    width: float,
    height: float = 10.0,
) -> list[Any]:
    """Return a colour bar from `at` to the right and down, with its ends, title and unit."""
    n = 64
    x, y = at
    left = x + np.arange(n) * width / n
    middle = np.full(n, y + height / 2)
    strips = np.stack(
        [np.column_stack([left, middle]), np.column_stack([left + width / n, middle])], 1
    )
    bar = rr.LineStrips2D(
        strips, colors=color_map(colors, np.linspace(0, 1, n)), radii=height / 2, draw_order=20.0
    )
    places = [(x + share * width, y + 1.4 * height) for share in (0.0, 0.5, 1.0)]
    return [bar, _text(places, [number(low), title, number(high)], [GREY] * 3)]


def legend_names(entries: Legend) -> list[Any]:
    """Return coloured dashes with names below them, in rows of `LEGEND_WIDTH`."""
    places = np.array(_legend_places(entries)[0])
    colors = [color for _, color in entries]
    half = np.array([DASH / 2, 0.0])
    dashes = np.stack([places - half, places + half], axis=1)
    lines = rr.LineStrips2D(dashes, colors=colors, radii=rr.Radius.ui_points(2.5), draw_order=20.0)
    below = places + np.array([0.0, 4.0])  # Rerun begins a word right below its place
    return [lines, _text(below, [name for name, _ in entries], colors)]


def legend_bar(i: int, bars: int, entries: Legend, *, bar: Mapping[str, Any]) -> list[Any]:
    """Return the i-th of so many colour bars, below the names."""
    room = LEGEND_WIDTH / max(bars, 2)
    return color_bar(
        **bar, at=(30.0 + i * room, _legend_places(entries)[1] * LEGEND_ROW), width=room - 60.0
    )


def legend_height(entries: Legend, bars: int) -> float:
    """Return how high a legend is on its canvas."""
    return LEGEND_ROW * (_legend_places(entries)[1] + (1 if bars else 0))


def _legend_places(entries: Legend) -> tuple[list[tuple[float, float]], int]:
    places: list[tuple[float, float]] = []
    x = 0.0
    row = 0
    for name, _ in entries:
        room = 30.0 + 7.5 * len(name)
        if x > 0 and x + room > LEGEND_WIDTH:
            x = 0.0
            row = row + 1
        places.append((x + room / 2, row * LEGEND_ROW + 5.0))
        x += room
    return places, row + 1 if places else 0


def _bar_width(curve: Curve) -> float:
    gaps = np.diff(np.sort(curve.x))
    gaps = gaps[gaps > 0]
    return float(gaps.min()) if len(gaps) else 1.0


def _bars(curve: Curve, x: Scale, y: Scale) -> list[np.ndarray]:
    """Return outlines of bars, hatched by one line down their middle to read as solid."""
    half = 0.45 * _bar_width(curve)
    pieces = []
    for at, value in zip(curve.x, curve.y, strict=True):
        if np.isfinite(value):
            left = x(at - half)
            right = x(at + half)
            top = y(value)
            foot = y(max(min(0.0, y.axis.high), y.axis.low))
            pieces.append(
                np.array([[left, foot], [left, top], [right, top], [right, foot], [left, foot]])
            )
    return pieces


def _pieces(at: np.ndarray, known: np.ndarray) -> list[np.ndarray]:
    """Return the stretches of a line between gaps."""
    starts = np.flatnonzero(known & ~np.r_[False, known[:-1]])
    ends = np.flatnonzero(known & ~np.r_[known[1:], False]) + 1
    return [at[start:end] for start, end in zip(starts, ends, strict=True) if end - start > 1]


def _text(places: Any, words: Sequence[str], colors: Sequence[Rgb]) -> Any:
    """Return words, each centred below its place."""
    shown = [
        (place, safe(word), color)
        for place, word, color in zip(places, words, colors, strict=True)
        if word
    ]
    at, labels, paints = zip(*shown, strict=True)
    return rr.Points2D(at, labels=labels, colors=paints, radii=0.01, show_labels=True)
