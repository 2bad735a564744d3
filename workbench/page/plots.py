"""The large chart of a story as plain data: a whole curve, marks that move, second curves,
bands; its axes laid out.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import asdict, replace
from typing import Any

import numpy as np

from workbench.page.charts import in_order, numbers, slug
from workbench.scene import Chart, Curve
from workbench.words.axis import Axis, axis, number, of_powers, ticks, value_axis

HEADROOM = 0.12
"""How much room stays above what a chart shows from near, as a share of its height: a second
curve is seen to rise.
"""
TICKS = 5
"""At most so many ticks stand at the y axis."""
DEGREES = (15.0, 30.0, 45.0, 60.0, 90.0, 180.0)
"""Steps between the ticks of angles, where those of ten would look odd."""


def plot_of(parts: Sequence[Curve], keep: Callable[[Curve], int]) -> dict[str, Any]:
    """Return the large chart of a step.

    Args:
        parts: What `draw` made with the verbs of one Chart.
        keep: Keeps the `line_of` a curve, which may come again with another step, and returns its
            number.
    """
    chart = parts[0].plot
    assert chart is not None, "the verbs of a Chart name it"
    if chart.log:
        parts = [_logarithm(curve, chart) for curve in parts]
    by_part: dict[str, list[Curve]] = {part: [] for part in ("whole", "second", "mark", "band")}
    for curve in parts:
        by_part[curve.part].append(curve)
    label = chart.title
    if chart.unit:
        label = f"{label} ({'°' if chart.unit == 'deg' else chart.unit})"
    return {
        "kind": "plot",
        "name": slug(chart.title),
        "title": chart.title,
        "x_label": chart.x_label,
        "y_label": label,
        "unit": chart.unit,
        "x": asdict(x_axis(chart, parts, chart.x_range)),
        "y": asdict(y_axis(chart, by_part, None)),
        **({"log": True} if chart.log else {}),
        "near": None if chart.near is None else _near(chart, parts, by_part),
        "whole": [keep(curve) for curve in by_part["whole"]],
        "seconds": [keep(curve) for curve in by_part["second"]],
        "marks": [_mark(curve) for curve in by_part["mark"]],
        "bands": [
            {
                "name": band.name,
                "color": band.color,
                **dict(zip(("low", "high"), numbers(band.x), strict=True)),
            }
            for band in by_part["band"]
        ],
    }


def _near(chart: Chart, parts: Sequence[Curve], by_part: dict[str, list[Curve]]) -> dict[str, Any]:
    return {
        "x": asdict(x_axis(chart, parts, chart.near)),
        "y": asdict(y_axis(chart, by_part, chart.near)),
    }


def x_axis(chart: Chart, parts: Sequence[Curve], ends: tuple[float, float] | None) -> Axis:
    """Return the x axis between two ends, or around all that is drawn; its words have the unit
    behind them.
    """
    if ends is None:
        x = np.concatenate([curve.x for curve in parts])
        ends = float(x.min()), float(x.max())
    scale = axis(*ends)
    if chart.x_unit in ("deg", "°"):
        return _of_degrees(scale)
    unit = f" {chart.x_unit}" if chart.x_unit else ""
    return replace(scale, words=tuple(f"{word}{unit}" for word in scale.words))


def _of_degrees(scale: Axis) -> Axis:
    span = scale.high - scale.low
    places = ticks(scale.low, scale.high)
    if span > 60.0:
        step = next((step for step in DEGREES if span / step <= 5.0), 180.0)
        places = np.arange(np.ceil(scale.low / step), np.floor(scale.high / step) + 1) * step
    return replace(
        scale, ticks=tuple(places.tolist()), words=tuple(f"{number(x)}°" for x in places)
    )


def y_axis(chart: Chart, by_part: dict[str, list[Curve]], near: tuple[float, float] | None) -> Axis:
    """Return the y axis of the whole curve and the marks, of those within two ends of x where
    they are given.
    """
    if chart.log:
        return of_powers(
            _y_axis(replace(chart, y_range=_powers(chart.y_range), log=False), by_part, near)
        )
    return _y_axis(chart, by_part, near)


def _y_axis(
    chart: Chart, by_part: dict[str, list[Curve]], near: tuple[float, float] | None
) -> Axis:
    if chart.y_range is not None and near is None:
        return axis(*chart.y_range, TICKS)
    shown = [*by_part["whole"], *by_part["mark"]] or by_part["second"]
    low, high = near or (-np.inf, np.inf)
    values = [curve.y[(curve.x >= low) & (curve.x <= high)].astype(float) for curve in shown]
    if near is None:
        return value_axis(values, most=TICKS)
    known = np.concatenate([np.zeros(0), *(y[np.isfinite(y)] for y in values)])
    if not len(known):
        return value_axis(values, most=TICKS)
    room = HEADROOM * (float(known.max() - known.min()) or 1.0)
    return axis(float(known.min()) - room, float(known.max()) + room, TICKS)


def _powers(ends: tuple[float, float] | None) -> tuple[float, float] | None:
    return None if ends is None else (math.log10(ends[0]), math.log10(ends[1]))


def _logarithm(curve: Curve, chart: Chart) -> Curve:
    """Return a curve of logarithms; a mark below the axis stands at its lower end."""
    if curve.part == "band":
        return curve
    y = curve.y
    if curve.part == "mark" and chart.y_range is not None:
        y = np.maximum(y, chart.y_range[0])
    return replace(curve, y=np.log10(np.where(y > 0.0, y, np.nan)))


def line_of(curve: Curve) -> dict[str, Any]:
    """Return a line of a large chart."""
    return {"kind": "line", "name": curve.name, "color": curve.color, **in_order(curve)}


def _mark(curve: Curve) -> dict[str, Any]:
    place = {"x": numbers(curve.x)[0], "y": numbers(curve.y)[0]}
    return (
        {"name": curve.name, "color": curve.color}
        | place
        | {"knob": curve.knob, "steps": curve.steps}
    )
