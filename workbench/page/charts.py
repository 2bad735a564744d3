"""Charts as plain data: axes with their ticks and words, curves of a step, and scalars over the
steps of a run.
"""

import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import asdict
from typing import Any

import numpy as np

from workbench.page.legend import css_color, escape
from workbench.run.series import Series, plotted_values
from workbench.scene import PALETTE, Curve, Table
from workbench.words.axis import LOGARITHM, Axis, axis, labelled, of_powers, value_axis

NARROW_BAR = 0.96
"""How much of the room between two bars a bar takes."""


def slug(title: str) -> str:
    """Return the name of a chart, as page.md writes it: `Rotation error` is `rotation-error`."""
    return re.sub(r"[^a-z0-9]+", "-", title.lower()).strip("-")


def axes_of(
    xs: Sequence[np.ndarray], ys: Sequence[np.ndarray], *, whole: bool
) -> tuple[Axis, Axis]:
    """Return the axes of a chart in which all these points are; `whole` as for `axis`."""
    x = np.concatenate(xs)
    return axis(float(x.min()), float(x.max()), whole=whole), value_axis(ys, most=4)


def of_logarithms(label: str, scale: Axis) -> tuple[str, Axis]:
    """Return what an axis is of, and the axis; logarithms are said as the numbers they are of."""
    name = label.removeprefix(LOGARITHM)
    return (label, scale) if name == label else (name.removeprefix("of "), of_powers(scale))


def titled(curves: Sequence[Curve]) -> tuple[str, str]:
    """Return the title of a chart of curves and the label of its values."""
    chart = curves[0].chart
    above, label = labelled(curves[0].y_label.removeprefix(LOGARITHM).removeprefix("of "), "")
    return f"{chart}: {above}" if above and above != chart else chart, label


def outline(curve: Curve) -> tuple[np.ndarray, np.ndarray]:
    """Return x and y sorted by x; bars become their outline, each on the ground at both ends."""
    order = np.argsort(curve.x, kind="stable")
    x, y = curve.x[order].astype(float), curve.y[order].astype(float)
    if curve.kind != "bars":
        return x, y
    gaps = np.diff(x)
    half = 0.5 * NARROW_BAR * (gaps[gaps > 0].min() if (gaps > 0).any() else 1.0)
    x, y = x[np.isfinite(y)], y[np.isfinite(y)]
    sides = np.column_stack([x - half, x - half, x + half, x + half])
    return sides.ravel(), np.column_stack([0 * y, y, y, 0 * y]).ravel()


def table_html(table: Table) -> str:
    """Return a table as HTML, its text escaped."""
    head = "".join(f"<th>{escape(cell)}</th>" for cell in table.header)
    rows = "".join(
        "<tr>" + "".join(f"<td>{escape(cell)}</td>" for cell in row) + "</tr>" for row in table.rows
    )
    title = f"<strong>{escape(table.title)}</strong>" if table.title else ""
    return (
        '<div class="wb'
        f' wb-pad">{title}<table><thead><tr>{head}</tr></thead><tbody>{rows}</tbody></table></div>'
    )


def chart_of(curves: Sequence[Curve]) -> dict[str, Any]:
    """Return a chart of curves of a step, with its axes."""
    outlines = [outline(curve) for curve in curves]
    whole = all(np.array_equal(curve.x, np.rint(curve.x)) for curve in curves)
    across, up = axes_of([x for x, _ in outlines], [y for _, y in outlines], whole=whole)
    title, label = titled(curves)
    x_label, across = of_logarithms(curves[0].x_label, across)
    _, up = of_logarithms(curves[0].y_label, up)
    drawn = {
        "kind": "curves",
        "name": slug(curves[0].chart),
        "title": title,
        "xLabel": x_label,
        "yLabel": label,
    }
    return drawn | {
        "x": asdict(across),
        "y": asdict(up),
        "curves": [_curve(curve) for curve in curves],
    }


def series_of(series: Mapping[str, Series], start: int = 0) -> list[dict[str, Any]]:
    """Return every scalar over the steps of a run that are known, from a step on."""
    return [
        {
            "path": path,
            "name": line.scalar.name,
            "chart": line.scalar.chart,
            "unit": line.scalar.unit,
            "color": css_color(PALETTE[line.scalar.color]),
            "log": line.scalar.log,
            "values": [
                float(value) if np.isfinite(value) else None for value in line.values[start:]
            ],
        }
        for path, line in series.items()
    ]


def series_charts(series: Mapping[str, Series], known: int) -> dict[str, Any]:
    """Return the axes and words of every chart over steps."""
    charts: dict[str, list[Series]] = {}
    for line in series.values():
        charts.setdefault(line.scalar.chart, []).append(line)
    steps = np.arange(known, dtype=float)
    data = {}
    for chart, lines in charts.items():
        scalar = lines[0].scalar
        head, label = labelled(chart, scalar.unit)
        values = [plotted_values(line.scalar, line.values) for line in lines]
        across, up = axes_of([steps], values, whole=True)
        up = of_powers(up) if scalar.log else up
        data[chart] = {
            "name": slug(chart),
            "head": head,
            "yLabel": label,
            "x": asdict(across),
            "y": asdict(up),
        }
    return data


def _curve(curve: Curve) -> dict[str, Any]:
    return {
        "name": curve.name,
        "kind": curve.kind,
        "color": css_color(PALETTE[curve.color]),
        **in_order(curve),
        "marks": numbers(curve.marks),
    }


def in_order(curve: Curve) -> dict[str, list[float | None]]:
    """Return the numbers of a curve from left to right."""
    order = np.argsort(curve.x, kind="stable")
    return {"x": numbers(curve.x[order]), "y": numbers(curve.y[order])}


def numbers(values: np.ndarray | Sequence[float]) -> list[float | None]:
    """Return numbers with the digits that a curve needs; None where there is none."""
    plain = np.asarray(values, float).tolist()
    return [float(f"{value:.6g}") if math.isfinite(value) else None for value in plain]
