"""The layout a recording opens with: the scene with its legend and caption left, curves, charts and pictures right."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import rerun as rr
import rerun.blueprint as rrb

from workbench.lesson import Lesson, View
from workbench.recording.chart import HEIGHT, LEGEND_WIDTH, WIDTH, legend_height
from workbench.recording.glyphs import safe
from workbench.recording.sink import chart_entity, entity_of, legend_of
from workbench.scene import Curve, Field, Picture, Scalar, Scene, Table, in_space

RERUN_FOV = 55.0  # degrees, of the viewer's eye, from top to bottom
MOST_ROWS = 5.0
"""Shares of height in the column beside the scene; what is more goes behind a tab."""


@dataclass
class Contents:
    """What a run shows beside its scene, in order of appearance."""

    scalars: dict[str, dict[str, Scalar]] = field(default_factory=dict)  # chart -> path -> the first of them
    values: dict[str, list[tuple[int, float]]] = field(default_factory=dict)  # chart -> what is plotted, by step
    charts: dict[str, int] = field(default_factory=dict)  # title -> the step at which it appears
    pictures: dict[str, tuple[int, Picture]] = field(default_factory=dict)  # path -> the same, and the first of them
    tables: bool = False
    legend_height: float = 0.0


def contents_of(scenes: Sequence[Scene]) -> Contents:
    """Return what all scenes of a run show."""
    found = Contents()
    for k, scene in enumerate(scenes):
        for path, primitive in scene.items():
            if isinstance(primitive, Scalar):
                found.scalars.setdefault(primitive.chart, {}).setdefault(path, primitive)
                found.values.setdefault(primitive.chart, []).append((k, plotted_value(primitive)))
            elif isinstance(primitive, Curve):
                found.charts.setdefault(primitive.chart, k)
            elif isinstance(primitive, Picture) and not in_space(primitive):
                found.pictures.setdefault(path, (k, primitive))
            elif isinstance(primitive, Table):
                found.tables = True
        entries, fields = legend_of(scene)
        found.legend_height = max(found.legend_height, legend_height(entries, len(fields)))
    return found


def later(contents: Contents) -> dict[str, tuple[int, tuple[float, float]]]:
    """Return the canvases that are empty at first: at which step something appears, and where their middle is."""
    charts = {chart_entity(title): (k, (WIDTH / 2, HEIGHT / 2)) for title, k in contents.charts.items()}
    pictures = {
        entity_of("pictures", path): (k, (_shape(picture)[1] / 2, _shape(picture)[0] / 2))
        for path, (k, picture) in contents.pictures.items()
    }
    return {entity: found for entity, found in (charts | pictures).items() if found[0] > 0}


def plotted_value(scalar: Scalar) -> float:
    """Return what is plotted: the value or its logarithm; NaN where there is none."""
    value = float(scalar.value)
    if not scalar.log:
        return value
    return float(np.log10(value)) if value > 0 else float("nan")


def blueprint(lesson: Lesson, contents: Contents, steps: int) -> Any:
    """Return the layout of one run of a lesson."""
    left: list[Any] = [rrb.Tabs(scene_view("/", lesson.view), page_view(), active_tab=0)]
    shares = [7.0]
    if contents.legend_height:
        left.append(_canvas("/legend", "Legend", LEGEND_WIDTH, contents.legend_height, top=-2.0))
        shares.append(0.5 + contents.legend_height / 70.0)
    left.append(rrb.TextDocumentView(origin="/caption", name="What happened"))
    shares.append(1.7)
    right = beside(contents, steps, ("",))
    whole = rrb.Vertical(*left, row_shares=shares)
    return finished(rrb.Horizontal(whole, right, column_shares=[3, 2]) if right is not None else whole)


def beside(contents: Contents, steps: int, roots: Sequence[str]) -> Any:
    """Return the column of curves, charts, pictures and tables; curves of several runs (their roots) share a plot."""
    plots = [curve_view(contents, title, steps, roots) for title in contents.scalars]
    charts = [
        _canvas(root + chart_entity(title), title, WIDTH, HEIGHT, root) for title in contents.charts for root in roots
    ]
    pictures = [
        _picture_view(root, path, picture) for path, (_, picture) in contents.pictures.items() for root in roots
    ]
    tables = [
        rrb.TextDocumentView(origin=f"{root}/tables", name=_titled("Numbers", root))
        for root in roots
        if contents.tables
    ]
    rows = [
        *_rows(plots, 1.0, 1 if len(plots) < 3 else 2),
        *_rows(charts, 1.3, 2),
        *_rows(pictures, 1.4, 2),
        *_rows(tables, 1.0, 2),
    ]
    columns: list[list[tuple[Any, float]]] = [[]]
    for row in rows:
        if columns[-1] and sum(share for _, share in columns[-1]) + row[1] > MOST_ROWS:
            columns.append([])
        columns[-1].append(row)
    if not rows:
        return None
    names = ("Beside the scene", *["More"] * (len(columns) - 1))
    stacks = [
        rrb.Vertical(*(view for view, _ in column), row_shares=[share for _, share in column], name=name)
        for name, column in zip(names, columns, strict=True)
    ]
    return stacks[0] if len(stacks) == 1 else rrb.Tabs(*stacks, active_tab=0)


def _rows(views: Sequence[Any], share: float, at_once: int) -> list[tuple[Any, float]]:
    """Return views in rows of so many, each with its share of the height."""
    chunks = [views[i : i + at_once] for i in range(0, len(views), at_once)]
    return [(rrb.Horizontal(*chunk) if len(chunk) > 1 else chunk[0], share) for chunk in chunks]


def scene_view(root: str, view: View, name: str = "Scene") -> Any:
    """Return the view in space, seen from where the lesson is first seen."""
    origin = f"{root.rstrip('/')}/world"
    x, y, z = view.up
    grid = (
        rrb.LineGrid3D(visible=False)
        if view.grid is None
        else rrb.LineGrid3D(
            visible=True,
            spacing=view.grid,
            plane=rr.components.Plane3D(normal=(x, y, z), distance=view.grid_height),
            stroke_width=1.0,
            color=[150, 155, 160, 110],
        )
    )
    return rrb.Spatial3DView(
        origin=origin,
        name=name,
        line_grid=grid,
        eye_controls=rrb.EyeControls3D(
            kind=rrb.Eye3DKind.Orbital, position=_eye(view), look_target=view.target, eye_up=view.up
        ),
    )


def _eye(view: View) -> np.ndarray:
    """Return the eye as near as Rerun's own field of view needs it to show as much as the lesson's does."""
    target = np.array(view.target)
    share = np.tan(np.radians(view.fov_degrees) / 2) / np.tan(np.radians(RERUN_FOV) / 2)
    return target + (np.array(view.eye) - target) * share


def page_view(root: str = "") -> Any:
    """Return the view of the lesson's page."""
    return rrb.TextDocumentView(origin=f"{root}/page", name="Lesson")


def curve_view(contents: Contents, title: str, steps: int, roots: Sequence[str]) -> Any:
    """Return a plot of scalars over all steps, with a cursor at the current one."""
    scalars = contents.scalars[title]
    values = [(k, value) for k, value in contents.values[title] if np.isfinite(value)] or [(0, 0.0), (0, 1.0)]
    low, high = min(value for _, value in values), max(value for _, value in values)
    room = 0.06 * (high - low) or 0.5 * abs(high) or 0.5
    paths = [root + plotted(path, scalar) for root in roots for path, scalar in scalars.items()]
    unit = next((scalar.unit for scalar in scalars.values() if scalar.unit), "")
    infinite = rrb.TimeRangeBoundary.infinite()
    return rrb.TimeSeriesView(
        origin="/",
        contents=paths,
        name=safe(f"{title} ({unit})" if unit else title),
        axis_x=rrb.TimeAxis(
            view_range=rr.TimeRange(
                start=rrb.TimeRangeBoundary.absolute(seq=0), end=rrb.TimeRangeBoundary.absolute(seq=max(steps - 1, 1))
            )
        ),
        axis_y=rrb.ScalarAxis(range=(low - room, high + room)),
        time_ranges=[rrb.VisibleTimeRange("step", start=infinite, end=infinite)],
        plot_legend=rrb.PlotLegend(visible=True, corner=_emptiest(values, steps, low, high)),
    )


def _emptiest(values: Sequence[tuple[int, float]], steps: int, low: float, high: float) -> Any:
    """Return the corner of a plot in which the fewest values lie, so that the legend covers none."""
    x = np.array([k for k, _ in values]) / max(steps - 1, 1)
    y = (np.array([value for _, value in values]) - low) / ((high - low) or 1.0)
    corners = {
        rrb.Corner2D.RightTop: (x > 0.5) & (y > 0.6),
        rrb.Corner2D.LeftTop: (x < 0.5) & (y > 0.6),
        rrb.Corner2D.RightBottom: (x > 0.5) & (y < 0.4),
        rrb.Corner2D.LeftBottom: (x < 0.5) & (y < 0.4),
    }
    return min(corners, key=lambda corner: int(np.count_nonzero(corners[corner])))


def plotted(path: str, scalar: Scalar) -> str:
    """Return the entity whose values are plotted: the scalar's own, or that of its logarithm."""
    return entity_of("log10" if scalar.log else "scalars", path)


def finished(content: Any) -> Any:
    """Return the whole layout: nothing to click away, paused at the first step."""
    return rrb.Blueprint(
        content,
        rrb.TopPanel(state="hidden"),
        rrb.BlueprintPanel(state="hidden"),
        rrb.SelectionPanel(state="hidden"),
        rrb.TimePanel(state="collapsed", timeline="step", play_state="paused", loop_mode="all", fps=2.0),
        auto_layout=False,
        auto_views=False,
    )


def _canvas(entity: str, name: str, width: float, height: float, root: str = "", top: float = 0.0) -> Any:
    return rrb.Spatial2DView(
        origin=entity,
        name=_titled(name, root),
        visual_bounds=rrb.VisualBounds2D(x_range=[-0.01 * width, 1.01 * width], y_range=[top, height]),
    )


def _picture_view(root: str, path: str, picture: Picture) -> Any:
    h, w = _shape(picture)
    height = h + 0.17 * w if isinstance(picture.image, Field) else h
    return _canvas(root + entity_of("pictures", path), picture.title or path, w, height, root)


def _shape(picture: Picture) -> tuple[float, float]:
    h, w = (picture.image.values if isinstance(picture.image, Field) else picture.image).shape[:2]
    return float(h), float(w)


def _titled(name: str, root: str) -> str:
    return safe(f"{name} · {root.strip('/').upper()}" if root else name)
