"""One run as a replay: the 3D scene as viser's own export, and all that stands beside it as plain data."""

import base64
import contextlib
import io
import re
from dataclasses import asdict, replace
from typing import Any

import numpy as np
import viser

from workbench.axis import labelled
from workbench.errors import InputError
from workbench.images import webp
from workbench.scene import PALETTE, Curve, Field, Picture, Scene, Table, in_space
from workbench.timeline import Series, Timeline, plotted_values
from workbench.viewer.charts import axes_of, outline, table_html, titled
from workbench.viewer.sink import ViserSink
from workbench.viewer.stage import add_floor
from workbench.viewer.style import bar_html, css_color, legend_html

_DATA = re.compile(r'window\.__VISER_EMBED_DATA__="([^"]*)"')


class Renderer:
    """A viser server that nobody connects to, through which runs are exported one after the other."""

    def __init__(self) -> None:
        with contextlib.redirect_stdout(io.StringIO()):
            self._server = viser.ViserServer(host="127.0.0.1", port=0, verbose=False)

    def __enter__(self) -> "Renderer":
        return self

    def __exit__(self, *exception: object) -> None:
        """Stop the server."""
        with contextlib.redirect_stdout(io.StringIO()):
            self._server.stop()

    def scene(self, timeline: Timeline) -> tuple[str, str]:
        """Return the 3D scene of a run: viser's page without its data, and the data, base64.

        The page holds the data's place as `window.__VISER_EMBED_DATA__=""`. Step k stands from second k to second k + 1.
        """
        view = timeline.lesson.view
        self._server.scene.reset()
        camera = self._server.initial_camera
        camera.position, camera.look_at, camera.up, camera.fov = (
            view.seen_from(),
            view.target,
            view.up,
            float(np.radians(view.fov_degrees)),
        )
        add_floor(self._server.scene, view)
        sink = ViserSink(self._server.scene)
        sink.show(timeline[0].scene)
        serializer = self._server.get_scene_serializer()
        serializer.insert_sleep(1.0)
        for step in list(timeline.known())[1:]:
            sink.show(step.scene)
            serializer.insert_sleep(1.0)
        page = serializer.as_html()
        found = _DATA.search(page)
        if found is None:
            raise InputError("this version of viser exports another kind of page than the workbench can take apart")
        return page[: found.start(1)] + page[found.end(1) :], found.group(1)


def beside(timeline: Timeline) -> dict[str, Any]:
    """Return what a page shows beside the scene, as plain data: captions, series, and per step its curves and pictures.

    What repeats from step to step is kept once, in `things`, and named by its number.
    """
    things: list[Any] = []
    numbers: dict[Any, int] = {}

    def number(thing: Any, key: Any) -> int:
        if key not in numbers:
            numbers[key] = len(things)
            things.append(thing)
        return numbers[key]

    steps = []
    for step in timeline.known():
        caption = step.caption
        shown = [number(thing, key) for thing, key in _things(step.scene)]
        legend = legend_html(step.scene, timeline.lesson.view.grid)
        steps.append({"caption": caption.text, "tone": caption.tone, "shown": shown, "legend": number(legend, legend)})
    series = [
        {
            "path": path,
            "name": one.scalar.name,
            "chart": one.scalar.chart,
            "unit": one.scalar.unit,
            "color": css_color(PALETTE[one.scalar.color]),
            "log": one.scalar.log,
            "values": [_number(v) for v in one.values],
        }
        for path, one in timeline.series().items()
    ]
    return {"steps": steps, "series": series, "charts": _series_charts(timeline), "things": things}


def _series_charts(timeline: Timeline) -> dict[str, Any]:
    """Return the axes and words of every chart over steps."""
    charts: dict[str, list[Series]] = {}
    for one in timeline.series().values():
        charts.setdefault(one.scalar.chart, []).append(one)
    steps = np.arange(len(timeline), dtype=float)
    found = {}
    for chart, lines in charts.items():
        scalar = lines[0].scalar
        head, label = labelled(chart, scalar.unit, scalar.log)
        across, up = axes_of([steps], [plotted_values(one.scalar, one.values) for one in lines])
        found[chart] = {"head": head, "yLabel": label, "x": asdict(across), "y": asdict(up)}
    return found


def _things(scene: Scene) -> list[tuple[Any, Any]]:
    found: list[tuple[Any, Any]] = []
    charts: dict[str, list[Curve]] = {}
    for primitive in scene.values():
        if isinstance(primitive, Curve):
            charts.setdefault(primitive.chart, []).append(primitive)
        elif isinstance(primitive, Table):
            text = table_html(primitive)
            found.append(({"kind": "html", "html": text}, text))
        elif isinstance(primitive, Picture) and not in_space(primitive):
            image = primitive.rgb() if isinstance(primitive.image, np.ndarray) else _coarse(primitive.image).rgb()
            bar = bar_html(primitive.image) if isinstance(primitive.image, Field) else ""
            found.append((_picture(image, primitive.title, bar), (image.shape, image.tobytes(), primitive.title, bar)))
    for curves in charts.values():
        drawn = _chart(curves)
        found.append((drawn, repr(drawn)))
    return found


def _coarse(field: Field) -> Field:
    """Return a field with 49 levels: the eye sees the same colours, the file is a third smaller."""
    level = (field.values - field.low) / (field.high - field.low)
    return replace(field, values=field.low + np.rint(48 * level) / 48 * (field.high - field.low))


def _picture(image: np.ndarray, title: str, bar: str) -> dict[str, Any]:
    data = base64.b64encode(webp(image)).decode()
    return {
        "kind": "picture",
        "title": title,
        "bar": bar,
        "url": f"data:image/webp;base64,{data}",
        "width": image.shape[1],
        "height": image.shape[0],
    }


def _chart(curves: list[Curve]) -> dict[str, Any]:
    """Return a chart of curves with its axes; bars and all else keep an x of their own."""
    outlines = [outline(curve) for curve in curves]
    across, up = axes_of([x for x, _ in outlines], [y for _, y in outlines])
    title, label = titled(curves)
    drawn = {"kind": "curves", "title": title, "xLabel": curves[0].x_label, "yLabel": label}
    return drawn | {"x": asdict(across), "y": asdict(up), "curves": [_curve(curve) for curve in curves]}


def _curve(curve: Curve) -> dict[str, Any]:
    order = np.argsort(curve.x, kind="stable")
    return {
        "name": curve.name,
        "kind": curve.kind,
        "color": css_color(PALETTE[curve.color]),
        "x": [_number(v) for v in curve.x[order]],
        "y": [_number(v) for v in curve.y[order]],
        "marks": [_number(v) for v in curve.marks],
    }


def _number(value: float) -> float | None:
    """Return a number with the digits that a curve needs; None where there is none."""
    return float(f"{float(value):.6g}") if np.isfinite(value) else None
