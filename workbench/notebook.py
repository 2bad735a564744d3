"""A run in a notebook: the page in one frame, with all that it needs inside, so that it plays in a
saved notebook too.

A notebook that is not trusted shows no frames: a still picture stands behind it, with a line that
says what to do.
"""

import base64
import functools
from html import escape
from pathlib import Path
from typing import Any

import numpy as np

from workbench import knobs
from workbench.errors import InputError
from workbench.lesson import Lesson, find
from workbench.moved import moved
from workbench.numerals import brief, length
from workbench.page.document import lesson_document
from workbench.page.thumbnail import still_of
from workbench.publish.runs import Run, client_script, run_script
from workbench.run.links import show_command
from workbench.run.loading import load
from workbench.run.timeline import Timeline

LEAST_HEIGHT = 320
STILL = 640, 400
"""Width and height of the picture where nothing plays, pixels."""
HOW_TO_PLAY = "Nothing plays here. Trust the notebook, or run the cell, to step through this run."


def replay(
    lesson: str | Path | Lesson,
    *,
    preset: str | None = None,
    steps: int | None = None,
    height: int = 640,
    **params: Any,
) -> "Replay":
    """Return a run to be shown as the value of a notebook's cell.

    It plays, steps back, pins and shows its code like any page, without a server and without any
    file or network, also where the notebook was saved or exported as HTML.

        workbench.replay("icp", start_angle=120)
        workbench.replay("icp", preset="far", steps=40, height=500)

    Args:
        lesson: Its name, the path of a lesson of one's own, or the lesson itself.
        preset: What the params start from; without one the lesson's defaults.
        steps: How many steps are kept, from the first; all by default.
        height: Of the frame, pixels.
        params: Fields of the lesson's Params.

    Raises:
        InputError: If there is no such lesson, preset or param, a value is out of range, or the run
            gives no step.
    """
    if isinstance(lesson, str):
        led = moved(lesson, preset, params)
        lesson, preset, params = led.lesson, led.preset, led.values
    if isinstance(lesson, Lesson):
        chosen = lesson
    elif isinstance(lesson, Path):
        chosen = load(lesson)
    else:
        chosen = find(lesson)
    if steps is not None and steps < 1:
        raise InputError(f"steps = {steps}: how many steps are kept, 1 or more")
    if height < LEAST_HEIGHT:
        raise InputError(f"height = {height}: the page needs {LEAST_HEIGHT} pixels or more")
    base = None if preset is None else chosen.preset(preset).params
    return Replay(
        chosen, chosen.validated(knobs.make(chosen.params, params, base=base)), steps, height=height
    )


class Replay:
    """A run that notebooks show.

    Args:
        lesson: What runs.
        params: Its inputs.
        steps: How many steps are kept; None keeps all.
        height: Of the frame, pixels.

    Raises:
        InputError: If the run gives no step.
    """

    def __init__(self, lesson: Lesson, params: Any, steps: int | None, *, height: int):
        self.lesson, self.params, self.height = lesson, params, height
        self.timeline = Timeline(lesson, params)
        while (steps is None or len(self.timeline) < steps) and self.timeline.extend():
            pass
        if not len(self.timeline):
            raise InputError(
                self.timeline.stopped or f"lesson {lesson.name}: the run gives no step"
            )

    def __repr__(self) -> str:
        """Return the run as text: its last caption and numbers, and the command that opens it
        live.
        """
        last = len(self.timeline) - 1
        numbers = [
            f"{series.scalar.name}: {_said(series.values[last], series.scalar.unit)}"
            for series in self.timeline.series().values()
            if np.isfinite(series.values[last])
        ]
        lines = [
            f"{self.lesson.title}, step {last} of {last}: {self.timeline[last].caption.text}",
            *([", ".join(numbers)] if numbers else []),
            f"Live: {show_command(self.lesson, self.params)}",
        ]
        return "\n".join(lines)

    def document(self) -> str:
        """Return the page as one HTML document that needs nothing else."""
        preset = self.lesson.preset_of(self.params)
        run = Run(
            name="default" if preset is None else preset.name,
            title="one run" if preset is None else preset.title,
            line="",
            params=self.params,
            first=self._first(),
            recorded=False,
        )
        known = {
            "root": "",
            "runs": None,
            "open": run.name,
            "files": {run.name: ""},
            "titles": {run.name: run.title},
            "aliases": {},
            "sweeps": [],
            "answers": {},
        }
        document = lesson_document(
            self.lesson,
            "",
            home="notebook",
            root=None,
            more={"RECORDED": known},
            alone=(run.title, ""),
        )
        own = client_script() + run_script(self.lesson, run, self.timeline)
        return document.replace("</body>", f"<script>{own}</script></body>")

    def _first(self) -> int:
        """Return the step where it opens, negative from the end."""
        preset = self.lesson.preset_of(self.params)
        last = len(self.timeline) - 1
        is_default = self.params == self.lesson.params()  # which may be a preset too
        if is_default:
            step = self.lesson.opens
        elif preset is not None and preset.step is not None:
            step = preset.step
        else:
            step = self.lesson.first_step
        return min(max(step, -last - 1), last)

    @functools.cached_property
    def _still(self) -> str:
        step = self.timeline[self._first() % len(self.timeline)]
        png = still_of(step.scene, self.lesson.view_of(self.params), STILL)
        return base64.b64encode(png).decode()

    @functools.cached_property
    def _html(self) -> str:
        title = escape(f"{self.lesson.title}, a run to be played")
        caption = escape(self.timeline[self._first() % len(self.timeline)].caption.text)
        still = (
            f'<img src="data:image/png;base64,{self._still}" alt="{caption}"'
            ' style="max-width:100%">'
        )
        frame = (
            f'<iframe srcdoc="{escape(self.document())}" title="{title}"'
            ' style="position:absolute;inset:0;width:100%;height:100%;border:1px solid'
            ' #ccc;border-radius:6px;background:#fff"></iframe>'
        )
        place = f"position:relative;height:{self.height}px;overflow:hidden"
        return f'<div style="{place}">{still}<p>{HOW_TO_PLAY}</p>{frame}</div>'

    def _repr_html_(self) -> str:
        return self._html

    def _repr_mimebundle_(self, include: Any = None, exclude: Any = None) -> dict[str, str]:
        return {"text/html": self._html, "image/png": self._still, "text/plain": repr(self)}


def _said(value: float, unit: str) -> str:
    return length(value) if unit == "m" else f"{brief(value)} {unit}".rstrip()
