"""Charts, colour bars and the legend, drawn with Rerun's lines and words in two dimensions.

Rerun plots numbers over time only, so a `Curve` is drawn here: frame, ticks, curves and marks, on a canvas of
`WIDTH` x `HEIGHT` with y down. The colours are the palette's; everything else is a grey that can be read on white and
on black.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import rerun as rr

from workbench.axis import Axis, axis, number, value_axis
from workbench.recording.glyphs import safe
from workbench.scene import PALETTE, Curve, Field, color_map

WIDTH, HEIGHT = 300.0, 186.0
LEFT, RIGHT, TOP, BOTTOM = 40.0, 290.0, 24.0, 138.0  # the frame of a chart on its canvas
LEGEND_WIDTH, LEGEND_ROW = 760.0, 38.0
DASH = 26.0  # how long a colour is in the legend
GREY = (115, 121, 129)


@dataclass(frozen=True)
class _Scale:
    """An axis laid onto `start` to `end` of the canvas."""

    axis: Axis
    start: float
    end: float

    def __call__(self, value: Any) -> Any:
        share = (np.asarray(value) - self.axis.low) / (self.axis.high - self.axis.low)
        return self.start + share * (self.end - self.start)


def frame_key(curves: Sequence[Curve]) -> tuple[object, ...]:
    """Return what the frame of a chart depends on."""
    names = [(curve.name, curve.color, curve.x_label) for curve in curves]
    return (_scales(curves), names)


def chart_frame(curves: Sequence[Curve]) -> list[Any]:
    """Return the axes, ticks and words of a chart of all curves that share it."""
    x, y = _scales(curves)
    return [_frame(x, y), _words(x, y, curves)]


def chart_curves(curves: Sequence[Curve]) -> list[Any]:
    """Return what stands inside the frame: lines, bars, dots and marks."""
    x, y = _scales(curves)
    strips: list[np.ndarray] = []
    colors: list[tuple[int, int, int]] = []
    dots: list[np.ndarray] = [np.empty((0, 2))]
    dot_colors: list[tuple[int, int, int]] = []
    for curve in curves:
        known = np.isfinite(curve.y)
        at = np.column_stack([x(curve.x), y(np.where(known, curve.y, 0.0))])
        lonely = known & ~np.r_[False, known[:-1]] & ~np.r_[known[1:], False]  # a line of one point is a dot
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
        rr.Points2D(np.concatenate(dots), colors=dot_colors, radii=rr.Radius.ui_points(2.5), draw_order=21.0),
    ]


def color_bar(field: Field, x: float, y: float, width: float, height: float = 10.0) -> list[Any]:
    """Return a colour bar from (x, y) to the right and down, with its ends, title and unit below it."""
    n = 64
    left = x + np.arange(n) * width / n
    middle = np.full(n, y + height / 2)
    strips = np.stack([np.column_stack([left, middle]), np.column_stack([left + width / n, middle])], 1)
    colors = color_map(field.map, np.linspace(0, 1, n))
    below = y + 1.4 * height
    words = [number(field.low), _with_unit(field.title, field.unit), number(field.high)]
    places = np.array([[x, below], [x + width / 2, below], [x + width, below]])
    return [rr.LineStrips2D(strips, colors=colors, radii=height / 2, draw_order=20.0), _text(places, words)]


def legend_names(entries: Sequence[tuple[str, tuple[int, int, int]]]) -> list[Any]:
    """Return coloured dashes with names below them, in rows of `LEGEND_WIDTH`."""
    places = np.array(_legend_places(entries)[0])
    half = np.array([DASH / 2, 0.0])
    dashes = np.stack([places - half, places + half], axis=1)
    words, colors = [name for name, _ in entries], [color for _, color in entries]
    lines = rr.LineStrips2D(dashes, colors=colors, radii=rr.Radius.ui_points(2.5), draw_order=20.0)
    return [lines, _text(places + np.array([0.0, 4.0]), words, colors)]  # Rerun begins a word right below its place


def legend_bar(field: Field, i: int, bars: int, entries: Sequence[tuple[str, tuple[int, int, int]]]) -> list[Any]:
    """Return the i-th of so many colour bars, below the names."""
    room = LEGEND_WIDTH / max(bars, 2)
    return color_bar(field, 30.0 + i * room, _legend_places(entries)[1] * LEGEND_ROW, room - 60.0)


def legend_height(entries: Sequence[tuple[str, tuple[int, int, int]]], bars: int) -> float:
    """Return how high a legend is on its canvas."""
    return LEGEND_ROW * (_legend_places(entries)[1] + (1 if bars else 0))


def _legend_places(entries: Sequence[tuple[str, tuple[int, int, int]]]) -> tuple[list[tuple[float, float]], int]:
    places: list[tuple[float, float]] = []
    x, row = 0.0, 0
    for name, _ in entries:
        room = 30.0 + 7.5 * len(name)
        if x > 0 and x + room > LEGEND_WIDTH:
            x, row = 0.0, row + 1
        places.append((x + room / 2, row * LEGEND_ROW + 5.0))
        x += room
    return places, row + 1 if places else 0


def _scales(curves: Sequence[Curve]) -> tuple[_Scale, _Scale]:
    xs = np.concatenate([*(curve.x for curve in curves), *(np.array(curve.marks) for curve in curves)]).astype(float)
    widths = [_bar_width(curve) / 2 for curve in curves if curve.kind == "bars"]
    half = max(widths, default=0.0)
    along = axis(xs.min() - half, xs.max() + half)
    up = value_axis([curve.y.astype(float) for curve in curves], from_zero=bool(widths), most=4)
    return _Scale(along, LEFT, RIGHT), _Scale(up, BOTTOM, TOP)


def _bar_width(curve: Curve) -> float:
    gaps = np.diff(np.sort(curve.x))
    gaps = gaps[gaps > 0]
    return float(gaps.min()) if len(gaps) else 1.0


def _bars(curve: Curve, x: _Scale, y: _Scale) -> list[np.ndarray]:
    """Return outlines of bars, hatched by one line down their middle, so that they read as solid."""
    half, pieces = 0.45 * _bar_width(curve), []
    for at, value in zip(curve.x, curve.y, strict=True):
        if np.isfinite(value):
            left, right, top, foot = x(at - half), x(at + half), y(value), y(max(min(0.0, y.axis.high), y.axis.low))
            pieces.append(np.array([[left, foot], [left, top], [right, top], [right, foot], [left, foot]]))
    return pieces


def _pieces(at: np.ndarray, known: np.ndarray) -> list[np.ndarray]:
    """Return the stretches of a line between gaps."""
    starts = np.flatnonzero(known & ~np.r_[False, known[:-1]])
    ends = np.flatnonzero(known & ~np.r_[known[1:], False]) + 1
    return [at[start:end] for start, end in zip(starts, ends, strict=True) if end - start > 1]


def _frame(x: _Scale, y: _Scale) -> Any:
    strips = [np.array([[LEFT, TOP], [LEFT, BOTTOM], [RIGHT, BOTTOM]])]
    strips += [np.array([[x(tick), BOTTOM], [x(tick), BOTTOM + 4]]) for tick in x.axis.ticks]
    strips += [np.array([[LEFT - 4, y(tick)], [LEFT, y(tick)]]) for tick in y.axis.ticks]
    return rr.LineStrips2D(strips, colors=GREY, radii=rr.Radius.ui_points(0.5), draw_order=10.0)


def _words(x: _Scale, y: _Scale, curves: Sequence[Curve]) -> Any:
    along, up = x.axis.ticks, y.axis.ticks
    places = [(x(tick), BOTTOM + 3) for tick in along] + [(LEFT - 20, y(tick) - 8) for tick in up]
    words = [*x.axis.words, *y.axis.words]
    places.append(((LEFT + RIGHT) / 2, BOTTOM + 24))
    words.append(curves[0].x_label)
    colors: list[tuple[int, int, int]] = [GREY] * len(places)
    rooms = np.array([18.0 + 6.6 * len(curve.name) for curve in curves])
    rooms *= min(1.0, WIDTH / rooms.sum())  # closer together where they would leave the canvas
    at = min(LEFT, WIDTH - rooms.sum())
    for curve, room in zip(curves, rooms, strict=True):
        places.append((at + room / 2, 0.0))
        words.append(curve.name)
        colors.append(PALETTE[curve.color])
        at += room
    return _text(np.array(places), words, colors)


def _text(places: np.ndarray, words: Sequence[str], colors: Any = GREY) -> Any:
    """Return words, each centred below its place."""
    keep = [i for i, word in enumerate(words) if word]
    return rr.Points2D(
        places[keep],
        labels=[safe(words[i]) for i in keep],
        colors=[colors[i] for i in keep] if isinstance(colors, list) else colors,
        radii=0.01,
        show_labels=True,
    )


def _with_unit(title: str, unit: str) -> str:
    return f"{title} ({unit})" if unit else title
