"""One run as random access: its states, scenes and moments, computed when first asked for, kept, read-only, shared."""

import threading
import traceback
from collections import OrderedDict
from collections.abc import Callable, Hashable, Iterable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from workbench.axis import settled
from workbench.errors import InputError
from workbench.lesson import Lesson
from workbench.scene import Caption, Scalar, Scene, arrays, caption_of
from workbench.watch import Moment, listening, moment_of

MOST_STEPS = 5000
MOST_BYTES = 512 * 2**20


@dataclass(frozen=True, eq=False)
class Step:
    """One step of a run: what the algorithm yielded, what it looks like, and where in the code it was yielded."""

    state: Any
    scene: Scene
    moment: Moment | None

    @property
    def caption(self) -> Caption:
        """What happened in this step."""
        return caption_of(self.scene)


@dataclass(frozen=True, eq=False)
class Series:
    """A scalar over the steps of a run: how it is drawn, and its value per step, NaN where a step has none.

    What is below round-off is zero.
    """

    scalar: Scalar
    values: np.ndarray


class Timeline:
    """The steps of one run, by index.

    Steps are computed in order, each once, by whoever asks first; going back is a look-up. Every array that a state or a
    scene holds becomes read-only, so a state that is changed after it was yielded raises where it is changed.

    Args:
        lesson, params: What is run. Params that are out of range raise InputError.
        slots: Functions that replace keyword arguments of the lesson's run.
        most_steps, most_bytes: Where the run is cut; `stopped` then says so.
    """

    def __init__(
        self,
        lesson: Lesson,
        params: Any,
        slots: Mapping[str, Callable] | None = None,
        *,
        most_steps: int = MOST_STEPS,
        most_bytes: int = MOST_BYTES,
    ):
        self.lesson, self.params = lesson, lesson.check(params)
        self.finished = False
        self.stopped: str | None = None  # why the run ended before its end, in one line for a person
        self.failure: str | None = None  # the traceback of an error that is not the person's
        self.bytes = 0
        self._steps: list[Step] = []
        self._generator = lesson.run(params, **(slots or {}))
        self._lock = threading.Lock()
        self._owners: dict[int, np.ndarray] = {}
        self._most_steps, self._most_bytes = most_steps, most_bytes

    def __len__(self) -> int:
        """Return how many steps are known so far; all of them once `finished`."""
        return len(self._steps)

    def __getitem__(self, k: int) -> Step:
        """Return a step that is already known; negative counts from the last known one."""
        return self._steps[k]

    def known(self) -> Iterable[Step]:
        """Return the steps known so far."""
        return tuple(self._steps)

    def extend(self) -> bool:
        """Compute one more step; False when the run is at its end. Safe from any thread."""
        with self._lock:
            if self.finished:
                return False
            try:
                with listening() as last:
                    state = next(self._generator)
                    moment = last() or moment_of(self._generator, self.lesson.run)
                scene = dict(self.lesson.draw(state))
                caption_of(scene)
                self._freeze(state)
                self._freeze(scene)
            except StopIteration:
                return self._end()
            except InputError as error:
                return self._end(str(error))
            except Exception as error:
                self.failure = traceback.format_exc()
                return self._end(f"The run failed: {type(error).__name__}: {' '.join(str(error).split())}")
            self._steps.append(Step(state, scene, moment))
            if len(self._steps) >= self._most_steps:
                self._end(f"The run was cut after {self._most_steps:,} steps.")
            elif self.bytes > self._most_bytes:
                self._end(
                    f"The run was cut after {len(self._steps):,} steps: it holds over {self._most_bytes >> 20} MB."
                )
            return True

    def complete(self, progress: Callable[[int], object] | None = None) -> "Timeline":
        """Compute the whole run; `progress` is told the number of known steps. Returns itself."""
        while self.extend():
            if progress is not None:
                progress(len(self))
        return self

    def states(self) -> tuple[Any, ...]:
        """Return all states, computing what is missing.

        Raises:
            InputError: If the run could not be carried to its end, with the reason.
        """
        self.complete()
        if self.stopped is not None:
            raise InputError(self.stopped)
        return tuple(step.state for step in self._steps)

    def series(self) -> dict[str, Series]:
        """Return every scalar of the steps known so far, by path, in order of appearance."""
        steps = self.known()
        first: dict[str, Scalar] = {}
        for step in steps:
            for path, primitive in step.scene.items():
                if isinstance(primitive, Scalar):
                    first.setdefault(path, primitive)
        return {
            path: Series(scalar, settled(np.array([_value(s.scene, path) for s in steps])))
            for path, scalar in first.items()
        }

    def _end(self, why: str | None = None) -> bool:
        self.finished, self.stopped = True, why
        return False

    def _freeze(self, value: Any) -> None:
        for array in arrays(value):
            while True:  # a view is frozen together with the array that owns its memory
                array.setflags(write=False)
                if not isinstance(array.base, np.ndarray):
                    break
                array = array.base
            if id(array) not in self._owners:
                self._owners[id(array)] = array
                self.bytes += array.nbytes


def plotted_values(scalar: Scalar, values: np.ndarray) -> np.ndarray:
    """Return what is plotted of a scalar's values: they or their logarithm; NaN where there is none."""
    values = np.asarray(values, float)
    return np.log10(np.where(values > 0, values, np.nan)) if scalar.log else values


def _value(scene: Scene, path: str) -> float:
    primitive = scene.get(path)
    return float(primitive.value) if isinstance(primitive, Scalar) else float("nan")


class Timelines:
    """Runs kept for whoever wants them again: by lesson and params, least recently used ones dropped."""

    def __init__(self, most_bytes: int = 2 * 2**30, most_runs: int = 256):
        self._kept: OrderedDict[Hashable, Timeline] = OrderedDict()
        self._lock = threading.Lock()
        self._most_bytes, self._most_runs = most_bytes, most_runs

    def get(self, lesson: Lesson, params: Any) -> Timeline:
        """Return the run of a lesson at these params, made when it is not kept.

        Raises:
            InputError: If the params are not the lesson's or out of range.
        """
        key = (lesson.name, id(lesson), params)
        with self._lock:
            timeline = self._kept.get(key)
            if timeline is None:
                timeline = self._kept[key] = Timeline(lesson, params)
            self._kept.move_to_end(key)
            while len(self._kept) > 1 and (len(self._kept) > self._most_runs or self.bytes > self._most_bytes):
                self._kept.popitem(last=False)
            return timeline

    @property
    def bytes(self) -> int:
        """What all kept runs hold, arrays that two runs share counted twice."""
        return sum(timeline.bytes for timeline in self._kept.values())

    def __len__(self) -> int:
        """Return how many runs are kept."""
        return len(self._kept)
