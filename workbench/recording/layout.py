"""The layout a recording opens with: scene, legend and caption left, the rest right."""

from collections.abc import Iterator, Mapping, Sequence
from typing import Any
from uuid import UUID

import numpy as np
import rerun as rr
import rerun.blueprint as rrb

from workbench.lesson import View
from workbench.recording.chart import LEGEND_WIDTH, Canvas
from workbench.recording.contents import Contents
from workbench.recording.glyphs import safe
from workbench.recording.sink import TABLES, entity_of
from workbench.run.series import plotted_values
from workbench.scene import Scalar
from workbench.words.axis import value_axis

RERUN_FOV = 55.0  # degrees, of the viewer's eye, from top to bottom
LEAST_TILT = np.radians(1.0)
"""Angle to the up direction below which the viewer takes no eye: it decides by itself from 0.81
degrees on (cos 0.9999), and puts -y up in the picture of a scene seen from above; the first drag
takes an eye to 0.9 degrees.
"""
LATE = 0.5
"""Share of a run after which what appears for the first time stands behind a tab."""
MOST_ROWS = 5.2
"""Shares of height in the column beside the scene; what is more goes behind a tab."""
HALF_TITLE = 22
"""So many characters of a title can be read in half of that column, 1280 pixels across all."""
CAPTION = 2.2
"""Share of height, where the scene has 7, in which a caption of three lines can be read."""

Values = Mapping[str, np.ndarray]
"""A run's scalars by path, a value per step."""


def one_run(view: View, contents: Contents, values: Values) -> Any:
    """Return the layout of one run, seen as its lesson is first seen."""
    left: list[Any] = [rrb.Tabs(scene_view("", view, "Scene"), page_view(), active_tab=0)]
    shares = [7.0]
    if contents.legend_height:
        left.append(legend_view("", contents))
        shares.append(legend_share(contents))
    left.append(caption_view(""))
    shares.append(CAPTION)
    right = _column(
        _beside(contents, {"": values}), late=_beside(contents, {"": values}, late=True)
    )
    whole = rrb.Vertical(*left, row_shares=shares)
    return finished(
        rrb.Horizontal(whole, right, column_shares=[3, 2]) if right is not None else whole
    )


def two_runs(
    view: View, contents: Contents, runs: Mapping[str, Values], *, names: Mapping[str, str]
) -> Any:
    """Return the layout of two runs by root entities: scenes side by side, curves in one plot."""
    scenes = [
        rrb.Vertical(scene_view(root, view, names[root]), caption_view(root), row_shares=[4, 1.9])
        for root in runs
    ]
    below: list[Any] = [rrb.TextDocumentView(origin="/differences", name="What differs")]
    if contents.legend_height:
        below.append(legend_view(next(iter(runs)), contents))
    left = rrb.Vertical(
        rrb.Horizontal(*scenes), rrb.Tabs(*below, active_tab=0), row_shares=[4.7, 2.6]
    )
    right = _column(_beside(contents, runs), late=_beside(contents, runs, late=True))
    return finished(
        rrb.Horizontal(left, right, column_shares=[3, 2]) if right is not None else left
    )


def scene_view(root: str, view: View, name: str) -> Any:
    """Return the view in space, seen from where the lesson is first seen."""
    x, y, z = view.up
    grid = rrb.LineGrid3D(visible=False)
    if view.grid is not None:
        plane = rr.components.Plane3D(normal=(x, y, z), distance=view.grid_height)
        color = [150, 155, 160, 110]
        grid = rrb.LineGrid3D(
            visible=True, spacing=view.grid, plane=plane, stroke_width=1.0, color=color
        )
    eye = rrb.EyeControls3D(
        kind=rrb.Eye3DKind.Orbital, position=_eye(view), look_target=view.target, eye_up=view.up
    )
    axes = rrb.SpatialInformation(target_frame="tf#/", show_axes=view.axes)
    return rrb.Spatial3DView(
        origin=f"{root}/world",
        name=safe(name),
        line_grid=grid,
        eye_controls=eye,
        spatial_information=axes,
    )


def page_view(root: str = "") -> Any:
    """Return the view of the lesson's page."""
    return rrb.TextDocumentView(origin=f"{root}/page", name="Lesson")


def caption_view(root: str) -> Any:
    """Return the view of what happened in the current step."""
    return rrb.TextDocumentView(origin=f"{root}/caption", name="What happened")


def legend_view(root: str, contents: Contents) -> Any:
    """Return the view of names and colour bars."""
    return _canvas_view(f"{root}/legend", Canvas("Legend", LEGEND_WIDTH, contents.legend_height, 0))


def legend_share(contents: Contents) -> float:
    """Return how much height the legend needs, where the scene has 7."""
    return 0.5 + contents.legend_height / 70.0


def plotted(path: str, scalar: Scalar) -> str:
    """Return the entity whose values are plotted: the scalar's own, or that of its logarithm."""
    return entity_of("log10" if scalar.log else "scalars", path)


def finished(content: Any) -> Any:
    """Return the whole layout: nothing to click away, paused at the first step."""
    for i, part in enumerate(_parts(content), 1):
        part.id = UUID(int=i)  # rerun's own would be another one at each call
    return rrb.Blueprint(
        content,
        rrb.TopPanel(state="hidden"),
        rrb.BlueprintPanel(state="hidden"),
        rrb.SelectionPanel(state="hidden"),
        rrb.TimePanel(
            state="collapsed", timeline="step", play_state="paused", loop_mode="all", fps=2.0
        ),
        auto_layout=False,
        auto_views=False,
    )


def _parts(part: Any) -> Iterator[Any]:
    """Return a view or container and all that it contains."""
    yield part
    if isinstance(part, rrb.Container):
        for inside in part.contents:
            yield from _parts(inside)


def _beside(
    contents: Contents, runs: Mapping[str, Values], *, late: bool = False
) -> list[tuple[Any, float]]:
    """Return rows of pictures, curves, charts and tables, each with its share of the height.

    What appears only in a run's second half is late, and left out or all there is: until then it
    would be empty room.
    """
    steps = max((len(values) for run in runs.values() for values in run.values()), default=0)
    plots = (
        []
        if late
        else [_curve_view(chart, scalars, runs) for chart, scalars in contents.scalars.items()]
    )
    views: dict[str, list[Any]] = {"pictures": [], "charts": [], "tables": []}
    for entity, canvas in contents.canvases.items():
        if (canvas.first > LATE * steps) == late:
            views[entity.split("/")[1]] += [
                _canvas_view(root + entity, canvas, root) for root in runs
            ]
    beside_each_other = len(runs) > 1 or all(
        len(str(view.name)) <= HALF_TITLE for view in views["charts"]
    )
    return [
        *_rows(views["pictures"], 1.4, 2),
        *_rows(plots, 1.0, 1 if len(plots) < 3 else 2),
        *_rows(views["charts"], 1.3, 2 if beside_each_other else 1),
        *_rows(views["tables"], 1.3, 2),
    ]


def _rows(views: Sequence[Any], share: float, at_once: int) -> list[tuple[Any, float]]:
    chunks = [views[i : i + at_once] for i in range(0, len(views), at_once)]
    return [(rrb.Horizontal(*chunk) if len(chunk) > 1 else chunk[0], share) for chunk in chunks]


def _column(rows: Sequence[tuple[Any, float]], late: Sequence[tuple[Any, float]]) -> Any:
    """Return rows below each other, those too many or late behind tabs; None without a row."""
    stacks: list[list[tuple[Any, float]]] = []
    for row in rows:
        if not stacks or sum(share for _, share in stacks[-1]) + row[1] > MOST_ROWS:
            stacks.append([])
        stacks[-1].append(row)
    views = [
        rrb.Vertical(
            *(view for view, _ in stack),
            row_shares=[share for _, share in stack],
            name="More" if i else "Beside the scene",
        )
        for i, stack in enumerate(stacks)
    ]
    if late:
        views.append(rrb.Vertical(*(view for view, _ in late), name="Towards the end"))
    if not views:
        return None
    return views[0] if len(views) == 1 else rrb.Tabs(*views, active_tab=0)


def _curve_view(chart: str, scalars: Mapping[str, Scalar], runs: Mapping[str, Values]) -> Any:
    """Return a plot of scalars over all steps, with a cursor at the current one."""
    unit = next((scalar.unit for scalar in scalars.values() if scalar.unit), "")
    if any(scalar.log for scalar in scalars.values()):
        unit = f"{unit or 'value'}, as a power of ten"
    curves = [
        plotted_values(scalar, values[path])
        for values in runs.values()
        for path, scalar in scalars.items()
        if path in values
    ]
    steps = max(map(len, curves))
    x = np.concatenate([np.arange(len(curve)) for curve in curves])
    y = np.concatenate(curves)
    x, y = (
        (x[np.isfinite(y)], y[np.isfinite(y)])
        if np.isfinite(y).any()
        else (np.zeros(1), np.zeros(1))
    )
    up = value_axis([y])
    # else the lowest number and the first step overprint
    low = up.low - 0.1 * (up.high - up.low)
    high = up.high
    beyond = 1 + steps // 40  # so that the cursor can be seen at the last step too
    end = rrb.TimeRangeBoundary.absolute(seq=steps - 1 + beyond)
    infinite = rrb.TimeRangeBoundary.infinite()
    return rrb.TimeSeriesView(
        origin="/",
        contents=[
            root + plotted(path, scalar) for root in runs for path, scalar in scalars.items()
        ],
        name=safe(f"{chart} ({unit})" if unit else chart),
        axis_x=rrb.TimeAxis(
            view_range=rr.TimeRange(start=rrb.TimeRangeBoundary.absolute(seq=0), end=end)
        ),
        axis_y=rrb.ScalarAxis(range=(low, high)),
        time_ranges=[rrb.VisibleTimeRange("step", start=infinite, end=infinite)],
        plot_legend=rrb.PlotLegend(
            visible=True, corner=_emptiest(x / max(steps - 1, 1), (y - low) / (high - low))
        ),
    )


def _emptiest(x: np.ndarray, y: np.ndarray) -> Any:
    """Return the corner of a plot, 0 to 1 both ways, in which the fewest values lie."""
    corners = {
        rrb.Corner2D.RightTop: (x > 0.5) & (y > 0.6),
        rrb.Corner2D.LeftTop: (x < 0.5) & (y > 0.6),
        rrb.Corner2D.RightBottom: (x > 0.5) & (y < 0.4),
        rrb.Corner2D.LeftBottom: (x < 0.5) & (y < 0.4),
    }
    return min(corners, key=lambda corner: int(np.count_nonzero(corners[corner])))


def _eye(view: View) -> np.ndarray:
    """Return the eye as near as Rerun's own field of view needs it; never right along up."""
    target = np.array(view.target)
    up = np.array(view.up) / np.linalg.norm(view.up)
    share = np.tan(np.radians(view.fov_degrees) / 2) / np.tan(np.radians(RERUN_FOV) / 2)
    away = (view.seen_from() - target) * share
    along = (away @ up) * up
    aside = away - along
    least = np.tan(LEAST_TILT) * np.linalg.norm(along) / np.linalg.norm(aside)
    return target + along + max(1.0, least) * aside


def _canvas_view(entity: str, canvas: Canvas, root: str = "") -> Any:
    name = safe(f"{root.strip('/').upper()} · {canvas.title}" if root else canvas.title)
    if entity == root + TABLES:
        return rrb.TextDocumentView(origin=entity, name=name)
    bounds = rrb.VisualBounds2D(
        x_range=[-0.01 * canvas.width, 1.01 * canvas.width],
        y_range=[-0.01 * canvas.height, canvas.height],
    )
    return rrb.Spatial2DView(origin=entity, name=name, visual_bounds=bounds)
