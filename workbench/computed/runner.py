"""Runs a lesson for a page's worker: a run's steps, what a page lacks of each, a student's
function.
"""

import importlib
import json
import sys
import time
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import scipy

from workbench import knobs
from workbench.computed.lean import is_browser, without_rare_parts
from workbench.errors import InputError
from workbench.lesson import Lesson
from workbench.machinery.images import png_address
from workbench.page.lessons import values_of
from workbench.page.steps import Steps
from workbench.page.updates import RunUpdates
from workbench.run.picking import picked_params
from workbench.run.timeline import Timeline
from workbench.wire.nodes import Maker
from workbench.wire.packing import PageWire
from workbench.wire.stage import Aim
from workbench.wire.writer import Writer, as_png

EXERCISES = Path(__file__).with_name("exercises.json")
"""In an archive: what there is to say of each lesson's exercises before one is begun."""
MOST_BYTES = 128 * 2**20
"""Of a run's arrays: a browser's Python has less room than a server's."""


def open_lesson(name: str) -> "Runner":
    """Return what runs a lesson of the archive, at its default params.

    Examples:
        >>> runner = open_lesson("rotations")
        >>> while runner.more(40.0):
        ...     pass
        >>> runner.told()["finished"], runner.step(0)[0]["k"]
        (True, 0)
    """
    if is_browser():
        without_rare_parts()
    lesson = importlib.import_module(f"lessons.{name}.lesson").lesson
    exercises = json.loads(EXERCISES.read_text()) if EXERCISES.is_file() else {}
    return Runner(lesson, exercises.get(name, ()))


class Runner:
    """One lesson, the run that is wanted of it, and what its page has been sent.

    Args:
        lesson: What is run.
        exercises: What `about` tells of its exercises.
    """

    def __init__(self, lesson: Lesson, exercises: Sequence[Mapping[str, Any]] = ()):
        self.lesson = self._driven = lesson
        self._exercises = list(exercises)
        self._wire = PageWire(Maker(lambda: Writer(as_png)))
        self._aim = Aim()
        self._number = 0
        self._aim.open(lesson, lesson.params())
        self.run({})

    def about(self) -> dict[str, Any]:
        """Return the default params, the exercises, and what computes here."""
        return {
            "params": values_of(self.lesson.params()),
            "exercises": self._exercises,
            "versions": {
                "python": sys.version.split()[0],
                "numpy": np.__version__,
                "scipy": scipy.__version__,
            },
        }

    def run(self, params: Mapping[str, Any]) -> dict[str, Any]:
        """Begin the run of these params, plain values by name; return them as they are then.

        Raises:
            InputError: If one is unknown, or of the wrong kind; nothing has changed then.
        """
        given = {
            name: tuple(value) if isinstance(value, list) else value
            for name, value in params.items()
        }
        private = knobs.paths_of(self.lesson.params)
        if refused := [name for name in given if name in private]:
            raise InputError(
                f"{refused[0]} is a file: own files are read on a computer of one's own"
            )
        made = knobs.make(self.lesson.params, given, clamp=True)
        self._number += 1
        self.timeline = Timeline(self._driven, made, most_bytes=MOST_BYTES)
        self._updates = RunUpdates(self._number, Steps(self.timeline, png_address))
        return {"params": values_of(made), "run": self._number}

    def more(self, milliseconds: float) -> bool:
        """Compute for about so long, one step at least; tell whether there is more to compute."""
        end = time.perf_counter() + milliseconds / 1000.0
        while self.timeline.extend() and time.perf_counter() < end:
            pass
        return not self.timeline.finished

    def told(self) -> dict[str, Any] | None:
        """Return what is new of the run since it was told last; None when nothing is."""
        timeline = self.timeline
        more = {"stopped": timeline.stopped, "mark": None, "called": None}
        if self._driven is not self.lesson:
            from workbench.exercise.driven import calls_it, first_difference

            more |= {"mark": first_difference(timeline.known()), "called": calls_it(timeline)}
        return self._updates.run(
            timeline.params, known=len(timeline), finished=timeline.finished, more=more
        )

    def step(self, index: int) -> tuple[dict[str, Any], bytes]:
        """Return what the page lacks of a known step: a text, and the bytes of its scene.

        Raises:
            IndexError: If the step is not known.
        """
        timeline = self.timeline
        step = timeline[index]
        k = index if index >= 0 else len(timeline) + index
        line = getattr(step.state, "line", 0) if self._driven is not self.lesson else 0
        head = self._updates.step(k, {}, line)
        view = self._aim.view(self.lesson, timeline.params)
        scene_head = {"run": self._number, "k": k}
        return head, self._wire.step(scene_head, step.scene, view, stage=self.lesson.name)

    def click(
        self, index: int, p_origin: Sequence[float], v_ray: Sequence[float]
    ) -> dict[str, Any]:
        """Return what a click in a step's scene sets, by a field's name: nothing where it hits
        nothing that can be picked.
        """
        return picked_params(
            self.timeline.params,
            self.timeline[index].scene,
            np.array(p_origin, float),
            v_ray=np.array(v_ray, float),
        )

    # a student's own function ---------------------------------------------------------------------

    def use(self, exercise: str, text: str) -> dict[str, Any]:
        """Let a student's text drive the lesson from the next run on; an empty one gives it back.

        Returns why it cannot, if so, and the text as the page shows it.
        """
        if not text.strip():
            self._driven = self.lesson
            return {"trouble": "", "name": exercise, "source": None}
        from workbench.exercise.driven import driven
        from workbench.page.code import text_html

        task = self._exercise(exercise)
        source = {"name": task.file, "html": text_html(text)}
        try:
            student = self._student(task, text)
            student.start()
        except InputError as error:
            return {"trouble": str(error), "name": exercise, "source": source}
        self._driven = driven(self.lesson, task, student)
        return {"trouble": "", "name": exercise, "source": source}

    def judge(self, exercise: str, text: str) -> dict[str, Any]:
        """Return what the public checks find of a student's text, as a page takes a report."""
        from workbench.exercise.grading import grade_function
        from workbench.page.exercise import report_data

        task = self._exercise(exercise)
        try:
            student = self._student(task, text)
            report = grade_function(student, task, hidden=False, file=task.file)
        except InputError as error:
            return report_data(str(error))
        return report_data(report)

    def _student(self, task: Any, text: str) -> Any:
        from workbench.computed.student import InPlaceFunction, read_in_place

        return InPlaceFunction(read_in_place(task.file, text), task.name)

    def _exercise(self, name: str) -> Any:
        from workbench.exercise.finding import exercises_in_folder

        exercises = {exercise.name: exercise for exercise in exercises_in_folder(self.lesson)}
        if name not in exercises:
            raise InputError(f"lesson {self.lesson.name} has no exercise {name!r}")
        return exercises[name]
