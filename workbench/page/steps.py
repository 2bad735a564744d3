"""The steps of a run as plain data: captions, what stands beside the scene, and where the code stood."""

import base64
import threading
from dataclasses import replace
from typing import Any

import numpy as np

from workbench.images import webp
from workbench.page.charts import chart_of, series_charts, series_of, table_html
from workbench.page.code import moment_data, source_html
from workbench.page.legend import bar_html, legend_html
from workbench.scene import Curve, Field, Picture, Scene, Table, in_space
from workbench.timeline import Step, Timeline


class Steps:
    """Makes the data of a run's steps. What repeats from step to step is kept once, in `things`, and named by its number.

    Each step is made once and shared by all who ask; any thread may ask.
    """

    def __init__(self, timeline: Timeline):
        self.timeline = timeline
        self.things: list[Any] = []
        self._numbers: dict[Any, int] = {}
        self._steps: dict[int, dict[str, Any]] = {}
        self._lock = threading.Lock()

    def step(self, k: int) -> dict[str, Any]:
        """Return a known step: caption and tone, and the numbers of what is `shown` and of the legend."""
        with self._lock:
            if k not in self._steps:
                self._steps[k] = self._made(self.timeline[k])
            return self._steps[k]

    def code(self, k: int) -> dict[str, Any] | None:
        """Return where the code stood at a known step, with the number of its source; None where nobody was asked."""
        moment = self.timeline[k].moment
        if moment is None:
            return None
        name = f"{moment.function.__module__}.{moment.function.__qualname__}"
        with self._lock:
            source = self._number({"kind": "source", "name": name, "html": source_html(moment.function)}, name)
        return {"source": source, **moment_data(moment)}

    def series(self) -> dict[str, Any]:
        """Return every scalar over the steps that are known, and the axes of their charts."""
        series = self.timeline.series()
        return {"series": series_of(series), "charts": series_charts(series, len(self.timeline))}

    def whole(self) -> dict[str, Any]:
        """Return all of a finished run."""
        steps = [self.step(k) for k in range(len(self.timeline))]
        return {"steps": steps, **self.series(), "things": self.things}

    def _made(self, step: Step) -> dict[str, Any]:
        legend = legend_html(step.scene, self.timeline.lesson.view_of(self.timeline.params).grid)
        return {
            "caption": step.caption.text,
            "tone": step.caption.tone,
            "shown": [self._number(thing, key) for thing, key in things_of(step.scene)],
            "legend": self._number(legend, legend),
        }

    def _number(self, thing: Any, key: Any) -> int:
        if key not in self._numbers:
            self._numbers[key] = len(self.things)
            self.things.append(thing)
        return self._numbers[key]


def things_of(scene: Scene) -> list[tuple[Any, Any]]:
    """Return what stands beside a scene (pictures, tables, charts), each with a key that tells it from all others."""
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
        drawn = chart_of(curves)
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
