"""What stands beside the scene: curves over steps, curves of the step, tables and pictures."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import viser

from workbench.axis import Axis, labelled, number
from workbench.page.charts import axes_of, outline, table_html, titled
from workbench.page.legend import bar_html, css_color
from workbench.scene import PALETTE, Curve, Field, Picture, Scene, Table, in_space, same
from workbench.session import Look
from workbench.timeline import Series, plotted_values

HEIGHT = 150


@dataclass(frozen=True, eq=False)
class Line:
    """What is drawn in one colour: y over an x of its own. NaN in y is left out."""

    name: str
    color: str
    x: np.ndarray
    y: np.ndarray
    kind: str = "line"  # or dots, bars, pinned


class Beside:
    """The charts, tables and pictures of one lesson, in a container of a client's interface.

    Args:
        gui: The client's interface.
        container: Where they go; entered as a context.
    """

    def __init__(self, gui: viser.GuiApi, container: Any):
        self.gui, self.container = gui, container
        self._charts: dict[str, Any] = {}
        self._others: dict[str, tuple[Any, Any, Any]] = {}
        self._orders: dict[str, float] = {}
        self._last: tuple | None = None

    def show(self, look: Look) -> None:
        """Make everything beside the scene equal to what `look` says."""
        now = (look.timeline, look.k, look.known, look.finished, look.pinned)
        if now == self._last:
            return
        self._last = now
        with self.container:
            self._show_series(look)
            self._show_curves(look.scene)
            self._show_others(look.scene)

    # curves over steps ----------------------------------------------------------------------------------------------

    def _show_series(self, look: Look) -> None:
        for chart, paths in _groups(look.series).items():
            x = np.arange(look.known, dtype=float)
            lines: list[Line] = []
            said = []
            for path in paths:
                one = look.series[path]
                other = look.pinned_series.get(path)
                scalar = one.scalar
                color = css_color(PALETTE[scalar.color])
                if other is not None:
                    lines.append(Line(f"{scalar.name}, pinned", color + "66", x, _fitted(other, len(x)), "pinned"))
                lines.append(Line(scalar.name, color, x, plotted_values(scalar, one.values)))
                value = one.values[look.k] if look.k < len(one.values) else np.nan
                if np.isfinite(value):
                    said.append(f"{scalar.name} {number(value)} {scalar.unit}".rstrip())
            first = look.series[paths[0]].scalar
            head, label = labelled(chart, first.unit, first.log)
            title = ": ".join(part for part in (head, " · ".join(said)) if part) or chart
            self._chart("series/" + chart, title, lines, label, (float(look.k),), "step")
        self._drop("series/", [f"series/{chart}" for chart in _groups(look.series)])

    # curves of this step --------------------------------------------------------------------------------------------

    def _show_curves(self, scene: Scene) -> None:
        groups: dict[str, list[Curve]] = {}
        for primitive in scene.values():
            if isinstance(primitive, Curve):
                groups.setdefault(primitive.chart, []).append(primitive)
        for chart, curves in groups.items():
            lines = [Line(curve.name, css_color(PALETTE[curve.color]), *outline(curve), curve.kind) for curve in curves]
            marks = tuple(mark for curve in curves for mark in curve.marks)
            title, label = titled(curves)
            self._chart("curve/" + chart, title, lines, label, marks, curves[0].x_label)
        self._drop("curve/", [f"curve/{chart}" for chart in groups])

    def _chart(
        self, key: str, title: str, lines: Sequence[Line], y_label: str, marks: tuple[float, ...], x_label: str
    ) -> None:
        across, up = axes_of([line.x for line in lines], [line.y for line in lines])
        here = [mark for mark in marks if across.low <= mark <= across.high]
        data = joined([*((line.x, line.y) for line in lines), _posts(here, up)])
        series = ({"label": x_label}, *map(_style, lines), _HERE)
        scales = {"x": {"time": False, "range": (across.low, across.high)}, "y": {"range": (up.low, up.high)}}
        axes = (_drawn_axis(across, x_label, labelSize=16, size=26), _drawn_axis(up, y_label, labelSize=18, size=50))
        chart = self._charts.get(key)
        if chart is not None:
            for name, value in {"series": series, "axes": axes, "scales": scales, "title": title}.items():
                if getattr(chart, name) != value:
                    setattr(chart, name, value)
            chart.data = data
            return
        self._charts[key] = self.gui.add_uplot(
            data,
            series,  # type: ignore[arg-type]
            scales=scales,  # type: ignore[arg-type]
            axes=axes,  # type: ignore[arg-type]
            title=title,
            height=HEIGHT,
            legend={"show": len(lines) > 1, "live": False},
            cursor={"drag": {"x": False, "y": False}},  # type: ignore[typeddict-item]
            order=self._order(key),
        )

    def _order(self, key: str) -> float:
        """Pictures first, then tables, curves over steps, curves of the step; within a kind as they first appeared."""
        rank = ("picture", "table", "series", "curve").index(key.split("/", 1)[0])
        return self._orders.setdefault(key, rank + len(self._orders) / 1000.0)

    def _drop(self, prefix: str, kept: list[str]) -> None:
        for key in [key for key in self._charts if key.startswith(prefix) and key not in kept]:
            self._charts.pop(key).remove()

    # tables and pictures --------------------------------------------------------------------------------------------

    def _show_others(self, scene: Scene) -> None:
        wanted = {
            path: primitive
            for path, primitive in scene.items()
            if isinstance(primitive, Table) or (isinstance(primitive, Picture) and not in_space(primitive))
        }
        for path in [path for path in self._others if path not in wanted]:
            _, handle, extra = self._others.pop(path)
            handle.remove()
            if extra is not None:
                extra.remove()
        for path, primitive in wanted.items():
            shown, handle, extra = self._others.get(path, (None, None, None))
            if shown is not None and same(shown, primitive):
                continue
            if isinstance(primitive, Table):
                text = table_html(primitive)
                if handle is None:
                    handle = self.gui.add_html(text, order=self._order("table/" + path))
                else:
                    handle.content = text
            elif isinstance(primitive, Picture):
                image = _enlarged(primitive.rgb())
                if handle is None:
                    handle = self.gui.add_image(
                        image, label=primitive.title, format="png", order=self._order("picture/" + path)
                    )
                else:
                    handle.image, handle.label = image, primitive.title
                if isinstance(primitive.image, Field):
                    bar = f'<div class="wb-legend">{bar_html(primitive.image)}</div>'
                    if extra is None:
                        extra = self.gui.add_html(bar, order=self._order("picture/" + path) + 0.0005)
                    else:
                        extra.content = bar
            self._others[path] = (primitive, handle, extra)


def _groups(series: Mapping[str, Series]) -> dict[str, list[str]]:
    groups: dict[str, list[str]] = {}
    for path, one in series.items():
        groups.setdefault(one.scalar.chart, []).append(path)
    return groups


def _fitted(series: Series, n: int) -> np.ndarray:
    values = np.full(n, np.nan)
    kept = plotted_values(series.scalar, series.values)[:n]
    values[: len(kept)] = kept
    return values


def joined(curves: Sequence[tuple[np.ndarray, np.ndarray]]) -> tuple[np.ndarray, ...]:
    """Return one x for all curves and a column for each, NaN where another curve's point stands.

    The browser draws one x for all, and passes over NaN: every curve goes through its own points and no others. Curves with
    one x in common keep it as it is.
    """
    grids: list[np.ndarray] = []
    for x, _ in curves:
        if not any(x is grid or np.array_equal(x, grid) for grid in grids):
            grids.append(x)
    x = np.concatenate(grids).astype(float)
    order = np.argsort(x, kind="stable")
    starts = np.cumsum([0, *map(len, grids)])
    columns = []
    for own, y in curves:
        column = np.full(len(x), np.nan)
        at = next(i for i, grid in enumerate(grids) if own is grid or np.array_equal(own, grid))
        column[starts[at] : starts[at + 1]] = y
        columns.append(column[order])
    return (x[order], *columns)


def _posts(marks: Sequence[float], up: Axis) -> tuple[np.ndarray, np.ndarray]:
    """Return vertical lines at the marks."""
    return np.repeat(np.array(marks, float), 3), np.tile([up.low, up.high, np.nan], len(marks))


def _style(line: Line) -> dict[str, Any]:
    """Return how the browser draws a line, dots, bars, or the dashed line of a pinned run."""
    few = line.kind == "line" and len(line.x) < 40
    points = {"show": line.kind == "dots" or few, "size": 5, "fill": line.color, "stroke": line.color}
    style: dict[str, Any] = {"label": line.name, "stroke": line.color, "width": 0 if line.kind == "dots" else 2}
    style |= {"spanGaps": False, "points": points}
    if line.kind == "pinned":
        return style | {"dash": [5, 4]}
    return style | {"fill": line.color + "66", "width": 1} if line.kind == "bars" else style


_HERE = {"label": "here", "stroke": css_color(PALETTE["highlight"]), "width": 2, "points": {"show": False}}


def _drawn_axis(along: Axis, label: str, **sizes: int) -> dict[str, Any]:
    """Return how the browser draws an axis, with the ticks and words that every home has."""
    grid = {"stroke": "rgba(128,128,128,.22)", "width": 1}
    ticks = grid | {"size": 4}
    fonts = {"font": "11px sans-serif", "labelFont": "11px sans-serif"}
    words = {"label": label, "splits": along.ticks, "values": along.words}
    return {"stroke": "#808790", "grid": grid, "ticks": ticks, **words, **fonts, **sizes}


def _enlarged(image: np.ndarray, least: int = 300) -> np.ndarray:
    """Repeat the pixels of a small image, so that the browser does not blur what is to be read pixel by pixel."""
    factor = max(1, least // max(image.shape[1], 1)) if image.shape[1] < least // 2 else 1
    return image.repeat(factor, 0).repeat(factor, 1)
