"""What stands beside the scene: curves over steps, curves of the step, tables and pictures."""

from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np
import viser

from workbench.scene import PALETTE, Curve, Field, Picture, Scene, Table, in_space, same
from workbench.session import Look
from workbench.timeline import Series
from workbench.viewer.style import bar_html, css_color, escape

HEIGHT = 150


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
            lines: list[tuple[str, str, np.ndarray, bool]] = []
            said = []
            for path in paths:
                one = look.series[path]
                other = look.pinned_series.get(path)
                scalar = one.scalar
                color = css_color(PALETTE[scalar.color])
                if other is not None:
                    lines.append((f"{scalar.name}, pinned", color + "66", _fitted(other, len(x)), True))
                lines.append((scalar.name, color, _scaled(one), False))
                value = one.values[look.k] if look.k < len(one.values) else np.nan
                if np.isfinite(value):
                    said.append(f"{scalar.name} {value:.3g} {scalar.unit}".rstrip())
            first = look.series[paths[0]].scalar
            y_label = ("log₁₀ " if first.log else "") + chart + (f" ({first.unit})" if first.unit else "")
            title = " · ".join(said) if said else chart
            self._chart("series/" + chart, title, x, lines, y_label, (float(look.k),), "step")
        self._drop("series/", [f"series/{chart}" for chart in _groups(look.series)])

    # curves of this step --------------------------------------------------------------------------------------------

    def _show_curves(self, scene: Scene) -> None:
        groups: dict[str, list[Curve]] = {}
        for primitive in scene.values():
            if isinstance(primitive, Curve):
                groups.setdefault(primitive.chart, []).append(primitive)
        for chart, curves in groups.items():
            drawn = [(curve, *_outline(curve)) for curve in curves]
            x = np.unique(np.concatenate([xs for _, xs, _ in drawn])) if len(drawn) > 1 else drawn[0][1]
            lines = []
            for curve, xs, ys in drawn:
                y = ys if len(drawn) == 1 else _at(x, xs, ys)
                lines.append((curve.name, css_color(PALETTE[curve.color]), y, curve.kind == "dots"))
            marks = tuple(mark for curve in curves for mark in curve.marks)
            self._chart("curve/" + chart, chart, x, lines, curves[0].y_label, marks, curves[0].x_label)
        self._drop("curve/", [f"curve/{chart}" for chart in groups])

    def _chart(
        self,
        key: str,
        title: str,
        x: np.ndarray,
        lines: list[tuple[str, str, np.ndarray, bool]],
        y_label: str,
        marks: tuple[float, ...],
        x_label: str,
    ) -> None:
        low, high = _range(line[2] for line in lines)
        x, columns = _with_marks(x, [line[2] for line in lines], [m for m in marks if x[0] <= m <= x[-1]], low, high)
        series: list[Any] = [{"label": x_label}]
        for name, color, _, thin in lines:
            dots = thin and "pinned" not in name
            style: dict[str, Any] = {"label": name, "stroke": color, "width": 0 if dots else 2, "spanGaps": False}
            style["points"] = {"show": dots or len(x) < 40, "size": 5, "fill": color, "stroke": color}
            if thin and not dots:
                style |= {"dash": [5, 4], "points": {"show": False}}
            series.append(style)
        series.append(
            {"label": "here", "stroke": css_color(PALETTE["highlight"]), "width": 2, "points": {"show": False}}
        )
        span = (float(x[0]), float(x[-1]) if x[-1] > x[0] else float(x[0]) + 1.0)
        scales = {"x": {"time": False, "range": span}, "y": {"range": (low, high)}}
        grey = {"stroke": "#8a8f98", "width": 1}
        axis = {"stroke": "#808790", "grid": grey | {"stroke": "rgba(128,128,128,.22)"}, "font": "11px sans-serif"}
        axes = (
            axis | {"label": x_label, "labelSize": 16, "size": 26, "labelFont": "11px sans-serif"},
            axis | {"label": y_label, "labelSize": 18, "size": 46, "labelFont": "11px sans-serif"},
        )
        data = (x, *columns)
        chart = self._charts.get(key)
        if chart is not None:
            if list(chart.series) != series:
                chart.series = tuple(series)
            chart.title, chart.data, chart.scales = title, data, scales
            return
        self._charts[key] = self.gui.add_uplot(
            data,
            tuple(series),
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


def table_html(table: Table) -> str:
    """Return a table as HTML, its text escaped."""
    head = "".join(f"<th>{escape(cell)}</th>" for cell in table.header)
    rows = "".join("<tr>" + "".join(f"<td>{escape(cell)}</td>" for cell in row) + "</tr>" for row in table.rows)
    title = f"<strong>{escape(table.title)}</strong>" if table.title else ""
    return f'<div class="wb wb-pad">{title}<table><thead><tr>{head}</tr></thead><tbody>{rows}</tbody></table></div>'


def _groups(series: Mapping[str, Series]) -> dict[str, list[str]]:
    groups: dict[str, list[str]] = {}
    for path, one in series.items():
        groups.setdefault(one.scalar.chart, []).append(path)
    return groups


def _scaled(series: Series) -> np.ndarray:
    if not series.scalar.log:
        return series.values
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.where(series.values > 0, np.log10(series.values), np.nan)


def _fitted(series: Series, n: int) -> np.ndarray:
    values = np.full(n, np.nan)
    kept = _scaled(series)[:n]
    values[: len(kept)] = kept
    return values


def _range(columns: Iterable[np.ndarray]) -> tuple[float, float]:
    known = [column[np.isfinite(column)] for column in columns]
    values = np.concatenate([k for k in known if len(k)]) if any(len(k) for k in known) else np.array([0.0, 1.0])
    low, high = float(values.min()), float(values.max())
    if low >= 0 and low < 0.5 * high:
        low = 0.0  # magnitudes are read against zero
    pad = 0.06 * (high - low) if high > low else 0.5 * abs(high) or 1.0
    return (low if low == 0.0 else low - pad), high + pad


def _with_marks(x: np.ndarray, columns: list[np.ndarray], marks: list[float], low: float, high: float) -> tuple:
    """Insert every mark twice into x, the curves passing through it, and one column that is a vertical line there."""
    xs = np.concatenate([x, np.repeat(marks, 2)]) if marks else x
    order = np.argsort(xs, kind="stable")
    line = np.full(len(xs), np.nan)
    line[len(x) :] = np.tile([low, high], len(marks))
    full = [np.concatenate([c, np.repeat([_nearest(x, c, m) for m in marks], 2)]) if marks else c for c in columns]
    return xs[order].astype(float), [*(c[order] for c in full), line[order]]


def _nearest(x: np.ndarray, y: np.ndarray, mark: float) -> float:
    known = np.isfinite(y)
    at = int(np.argmin(np.abs(x - mark)))
    if x[at] == mark or known.sum() < 2:
        return float(y[at])
    return float(np.interp(mark, x[known], y[known], left=np.nan, right=np.nan))


def _at(x: np.ndarray, xs: np.ndarray, ys: np.ndarray) -> np.ndarray:
    known = np.isfinite(ys)
    return np.interp(x, xs[known], ys[known], left=np.nan, right=np.nan) if known.sum() > 1 else np.full(len(x), np.nan)


def _outline(curve: Curve) -> tuple[np.ndarray, np.ndarray]:
    """Return x and y sorted by x; bars become their outline."""
    order = np.argsort(curve.x, kind="stable")
    x, y = curve.x[order].astype(float), curve.y[order].astype(float)
    if curve.kind != "bars" or len(x) < 2:
        return x, y
    half = 0.5 * np.diff(x).min() * 0.96
    return np.column_stack([x - half, x - half, x + half, x + half]).ravel(), np.column_stack(
        [0 * y, y, y, 0 * y]
    ).ravel()


def _enlarged(image: np.ndarray, least: int = 300) -> np.ndarray:
    """Repeat the pixels of a small image, so that the browser does not blur what is to be read pixel by pixel."""
    factor = max(1, least // max(image.shape[1], 1)) if image.shape[1] < least // 2 else 1
    return image.repeat(factor, 0).repeat(factor, 1)
