"""The steps of a run as plain data: captions, what stands beside the scene, and where the code
stood.
"""

import hashlib
import threading
import weakref
from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from workbench.machinery.images import webp_address
from workbench.page.charts import chart_of, series_charts, series_of, table_html
from workbench.page.code import moment_data, source_html
from workbench.page.legend import bar_html, legend_html
from workbench.page.plots import line_of, plot_of
from workbench.run.timeline import Step, Timeline
from workbench.scene import Curve, Field, Picture, Scene, Table, in_space


class Steps:
    """Makes the data of a run's steps. What repeats from step to step is kept once, in `things`,
    and named by its number.

    Each step is made once and shared by all who ask; any thread may ask.

    Args:
        timeline: The run.
        address: Makes a picture's address of its pixels.

    Attributes:
        things: What repeats, by its number.
        bytes: What all data hold, about.
    """

    def __init__(
        self, timeline: Timeline, address: Callable[[np.ndarray], str] = webp_address
    ) -> None:
        self._address = address
        self._run: Callable[[], Timeline | None] = lambda: timeline
        self.bytes = 0
        self.things: list[Any] = []
        self._numbers: dict[Any, int] = {}
        self._steps: dict[int, dict[str, Any]] = {}
        self._series: dict[tuple[int, int], dict[str, Any]] = {}
        self._lock = threading.Lock()

    @classmethod
    def weakly(cls, timeline: Timeline) -> "Steps":
        """Return the data of a run that somebody else holds: kept beside it, they do not keep
        it.
        """
        made = cls(timeline)
        made._run = weakref.ref(timeline)
        return made

    @property
    def timeline(self) -> Timeline:
        """The run."""
        timeline = self._run()
        if timeline is None:
            raise ReferenceError(
                "the run is gone: hold it as long as the steps beside it are asked for"
            )
        return timeline

    def step(self, k: int) -> dict[str, Any]:
        """Return a known step: caption and tone, and the numbers of what is `shown` and of the
        legend.
        """
        with self._lock:
            if k not in self._steps:
                self._steps[k] = made = self._made(self.timeline[k])
                self.bytes += 500 + 2 * len(made["caption"])
            return self._steps[k]

    def code(self, k: int) -> dict[str, Any] | None:
        """Return where the code stood at a known step, with the number of its source; None where
        nobody was asked.
        """
        moment = self.timeline[k].moment
        if moment is None:
            return None
        name = f"{moment.function.__module__}.{moment.function.__qualname__}"
        with self._lock:
            source = self._number(
                {"kind": "source", "name": name, "html": source_html(moment.function)}, name
            )
        return {"source": source, **moment_data(moment)}

    def series(self, start: int = 0, end: int | None = None) -> dict[str, Any]:
        """Return every scalar from step `start` to before `end` (None: all that are known), and the
        axes of all to there.
        """
        timeline = self.timeline
        known = len(timeline) if end is None else end
        series = timeline.series(known)
        key = (start, known)
        with self._lock:
            if key not in self._series:
                # of those who follow a run as it grows
                self._series = dict(tuple(self._series.items())[-7:])
                self._series[key] = {
                    "from": start,
                    "series": series_of(series, start),
                    "charts": series_charts(series, known),
                }
            return self._series[key]

    def whole(self) -> dict[str, Any]:
        """Return all of a finished run."""
        steps = [self.step(k) for k in range(len(self.timeline))]
        return {
            "steps": steps,
            **self.series(),
            "things": self.things,
            "end": self.end(),
            "places": self.places(),
            "idle": self.timeline.idle(),
        }

    def end(self) -> int | None:
        """Return the last step of the run itself where tries of other starts follow it; None where
        none are known.
        """
        tries = self.timeline.lesson.tries
        if tries is None:
            return None
        first = next((k for k, step in enumerate(self.timeline.known()) if tries(step.state)), 0)
        return first - 1 if first else None

    def _made(self, step: Step) -> dict[str, Any]:
        view = self.timeline.lesson.view_of(self.timeline.params)
        legend = legend_html(step.scene, view.grid)
        return {
            "caption": step.caption.text,
            "tone": step.caption.tone,
            "shown": self._shown(step.scene),
            "legend": self._number(legend, legend),
        }

    def _shown(self, scene: Scene) -> list[int]:
        """Return the numbers of what stands beside a scene: pictures and tables, then charts."""
        numbers: list[int] = []
        charts: dict[str, list[Curve]] = {}
        plots: dict[str, list[Curve]] = {}
        for primitive in scene.values():
            if isinstance(primitive, Curve):
                where = plots if primitive.part else charts
                where.setdefault(primitive.chart, []).append(primitive)
            elif isinstance(primitive, Table):
                text = table_html(primitive)
                numbers.append(self._number({"kind": "html", "html": text}, text))
            elif isinstance(primitive, Picture) and not in_space(primitive):
                numbers.append(self._picture(primitive))
        for curves in charts.values():
            drawn = chart_of(curves)
            numbers.append(self._number(drawn, repr(drawn)))
        for parts in plots.values():
            drawn = plot_of(parts, self._line)
            numbers.append(self._number(drawn, repr(drawn)))
        return numbers

    def wanted(self, step: Mapping[str, Any]) -> list[int]:
        """Return the numbers of all things that a step needs, those that its things name before
        these.
        """
        numbers: list[int] = []
        for n in step["shown"]:
            thing = self.things[n]
            if isinstance(thing, dict) and thing["kind"] == "plot":
                numbers += [*thing["whole"], *thing["seconds"]]
            numbers.append(n)
        return [*numbers, step["legend"]]

    def places(self) -> list[tuple[int, str]]:
        """Return the steps known so far that have a name for the slider: `start`, those that
        captions name, `stop`.

        `stop` is the end of the run itself, known once something follows it or the run is finished.
        """
        timeline = self.timeline
        named = [
            (k, step.caption.place) for k, step in enumerate(timeline.known()) if step.caption.place
        ]
        end = self.end()
        if end is None and timeline.finished:
            end = len(timeline) - 1
        places = (
            dict([(0, "start"), *named])
            if named and named[0][0] == 0
            else {0: "start", **dict(named)}
        )
        return sorted((places | ({} if end is None else {end: "stop"})).items())

    def _picture(self, picture: Picture) -> int:
        """Return the number of a picture: one with the arrays of an earlier step is not looked at
        again.
        """
        image = picture.image
        field = (
            (id(image.values), image.low, image.high, image.map)
            if isinstance(image, Field)
            else id(image)
        )
        same = picture.title, field  # the run keeps its arrays: no other has these numbers
        if same not in self._numbers:
            rgb = picture.rgb() if isinstance(image, np.ndarray) else _coarse(image).rgb()
            bar = bar_html(image) if isinstance(image, Field) else ""
            content = rgb.shape, hashlib.sha256(rgb.tobytes()).digest(), picture.title, bar
            if content not in self._numbers:
                self._number(
                    {
                        "kind": "picture",
                        "title": picture.title,
                        "bar": bar,
                        "url": self._address(rgb),
                        "width": rgb.shape[1],
                        "height": rgb.shape[0],
                    },
                    content,
                )
            self._numbers[same] = self._numbers[content]
        return self._numbers[same]

    def _line(self, curve: Curve) -> int:
        """Return the number of a line: one that came with another step is not written again."""
        values = np.stack([curve.x, curve.y]).astype(float)
        same = curve.name, curve.color, hashlib.sha256(values.tobytes()).digest()
        if same not in self._numbers:
            line = line_of(curve)
            self._numbers[same] = self._number(line, repr(line))
        return self._numbers[same]

    def _number(self, thing: Any, key: Any) -> int:
        if key not in self._numbers:
            self._numbers[key] = len(self.things)
            self.things.append(thing)
            self.bytes += 2 * _size(thing) + (len(key) if isinstance(key, str) else 0)
        return self._numbers[key]


def _size(thing: Any) -> int:
    """Return the characters that a thing has as plain data, about."""
    if isinstance(thing, str):
        return len(thing)
    if isinstance(thing, dict):
        return sum(_size(value) for value in thing.values())
    return sum(_size(value) for value in thing) if isinstance(thing, list | tuple) else 12


def _coarse(field: Field) -> Field:
    """Return a field with 49 levels: the eye sees the same colours, the file is a third smaller."""
    level = (field.values - field.low) / (field.high - field.low)
    return replace(field, values=field.low + np.rint(48 * level) / 48 * (field.high - field.low))
