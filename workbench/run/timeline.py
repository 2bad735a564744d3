"""One run as random access: its states, scenes and moments, computed when first asked for, kept,
read-only, shared.
"""

import threading
import weakref
from collections import OrderedDict
from collections.abc import Callable, Hashable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from workbench.apart import told
from workbench.cached import watched
from workbench.errors import AuthorError, InputError
from workbench.form import Look, States
from workbench.knobs import ParamField, Pick, fields_of, in_words, paths_of
from workbench.lesson import Lesson
from workbench.machinery.authors import Blaming, at
from workbench.run.picking import pickable
from workbench.run.series import ScalarColumns, Series
from workbench.scene import PRIMITIVES, Caption, Primitive, Scene, arrays, caption_of
from workbench.tracing import Moment, listening, moment_of

MOST_STEPS = 5000
MOST_BYTES = 512 * 2**20


@dataclass(frozen=True, eq=False)
class Step:
    """One step of a run: what the algorithm yielded, what it looks like, and where in the code it
    was yielded.
    """

    state: Any
    scene: Scene
    moment: Moment | None

    @property
    def caption(self) -> Caption:
        """What happened in this step."""
        return caption_of(self.scene)


class Timeline:
    """The steps of one run, by index.

    Steps are computed in order, each once, by whoever asks first; going back is a look-up. Every
    array that a state or a scene holds becomes read-only, so a state that is changed after it was
    yielded raises where it is changed.

    Args:
        lesson: What is run.
        params: With these; out of range they raise InputError.
        slots: Functions that replace keyword arguments of the lesson's run.
        most_steps: Where the run is cut; `stopped` then says so.
        most_bytes: Likewise, by the size of its arrays.
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
        self.lesson, self.params = lesson, lesson.validated(params)
        self.finished = False
        # why the run ended before its end, in one line for a person
        self.stopped: str | None = None
        self.failure: str | None = None  # the traceback of an error in the lesson's own code
        self.bytes = 0
        self._steps: list[Step] = []
        self._series = ScalarColumns()
        self._slots = dict(slots or {})
        self._form = lesson.form
        self._read: set[str] = set()  # the fields of the params that the run has read
        self._watched = watched(self.params, self._read.add)
        self._subject: Any = None
        self._states: list[Any] = []
        # made with the first step: whatever `run` raises is told there
        self._generator: Iterator[Any] | None = None
        self._shown: dict[str, Primitive] = {}  # by path, what a step showed last
        self._lock = threading.Lock()
        self._owners: dict[int, np.ndarray] = {}
        self._most_steps, self._most_bytes = most_steps, most_bytes

    def __len__(self) -> int:
        """Return how many steps are known so far; all of them once `finished`."""
        return len(self._steps)

    def __getitem__(self, k: int) -> Step:
        """Return a step that is already known; negative counts from the last known one."""
        return self._steps[k]

    def known(self) -> Sequence[Step]:
        """Return the steps known so far."""
        return tuple(self._steps)

    def extend(self) -> bool:
        """Compute one more step; False when the run is at its end. Safe from any thread."""
        with self._lock:
            if self.finished:
                return False
            try:
                state, moment = self._next()
                scene = self._drawn(state)
                self._freeze(state)
                self._freeze(scene)
            except StopIteration:
                return self._end(self._incomplete())
            except InputError as error:
                self.failure = error.trace if isinstance(error, AuthorError) else None
                return self._end(in_words(str(error), self.lesson.params))
            self._shown |= scene
            self._series.add(scene)
            self._states.append(state)
            self._steps.append(Step(state, scene, moment))
            if len(self._steps) >= self._most_steps:
                self._end(f"The run was cut after {self._most_steps:,} steps.")
            elif self.bytes > self._most_bytes:
                self._end(
                    f"The run was cut after {len(self._steps):,} steps: it holds over"
                    f" {self._most_bytes >> 20} MB."
                )
            return True

    def complete(self, progress: Callable[[int], object] | None = None) -> "Timeline":
        """Compute the whole run; `progress` is told the number of known steps. Returns itself."""
        while self.extend():
            if progress is not None:
                progress(len(self))
        return self

    def give_up(self, why: str, failure: str | None = None) -> None:
        """End the run at the steps that are known, and say why; nothing happens where it has ended
        already.
        """
        with self._lock:
            if not self.finished:
                self.failure = failure
                self._end(why)

    def owned(self) -> dict[int, int]:
        """Return the bytes of every array that the run holds, by the array's id."""
        return {key: array.nbytes for key, array in tuple(self._owners.items())}

    @property
    def read(self) -> frozenset[str]:
        """The fields of the params that the run has read so far."""
        return frozenset(self._read)

    def idle(self) -> tuple[str, ...]:
        """Return the fields of the params that the run does not read, so that they have no effect
        on it.

        None is known before the run is finished.
        """
        names = (field.name for field in fields_of(self.lesson.params))
        return tuple(name for name in names if name not in self._read) if self.finished else ()

    def states(self) -> States:
        """Return all states, with the params and the subject of the run, computing what is missing.

        Raises:
            InputError: If the run could not be carried to its end, with the reason.
        """
        self.complete()
        if self.stopped is not None:
            raise InputError(self.stopped)
        return States.of(self._states, params=self.params, subject=self._subject)

    def opening(self, owner: str, step: int) -> int:
        """Return the index of the step where a run opens, as an author gave it: negative counts
        from the end.

        Args:
            owner: Who asks for the step, in words that begin the line, such as "lesson icp, preset
                far".
            step: An index.

        Raises:
            AuthorError: If the run, computed to its end, has no such step.
        """
        n = len(self)
        if self.finished and self.stopped is None and not -n <= step < n:
            raise AuthorError(
                f"{owner} opens at step {step}, but its run has {n} steps: 0 to {n - 1}, or -1 to"
                f" -{n}"
            )
        return step if step >= 0 else max(0, n + step)

    def series(self, steps: int | None = None) -> dict[str, Series]:
        """Return every scalar of the first known steps, by path, in order of appearance; costs no
        look at the steps.
        """
        return self._series.until(len(self._steps) if steps is None else steps)

    def _next(self) -> tuple[Any, Moment | None]:
        run = self.lesson.run
        with Blaming(f"lesson {self.lesson.name}", run), listening() as last:
            if self._generator is None:
                self._subject = self._form.setup(self._watched)
                self._freeze(self._subject)
                made = self._form.run(self._watched, self._subject, **self._slots)
                if not isinstance(made, Iterator):
                    wrong = f"run returned {_kind(made)}; it is a generator: `yield` each state"
                    raise AuthorError(f"lesson {self.lesson.name}: {at(run)}{wrong}")
                self._generator = made
            state = next(self._generator)
            return state, last() or moment_of(self._generator, run)

    def _drawn(self, state: Any) -> dict[str, Primitive]:
        """Return the scene of a state.

        Raises:
            AuthorError: If it is none: what is no primitive is named by its path.
        """
        draw = self.lesson.draw
        with Blaming(f"lesson {self.lesson.name}", draw):
            past = tuple(self._states)
            shown = self._form.draw(
                Look(params=self._watched, subject=self._subject, now=state, past=past)
            )
            wrong = _no_scene(shown)
            if wrong:
                raise AuthorError(f"lesson {self.lesson.name}: {at(draw)}{wrong}")
            caption = caption_of(shown)
            preset = self.lesson.preset_of(self.params) if caption.tone == "wrong" else None
            if preset is not None and preset.breaks:
                caption = replace(caption, tone="info")
            if not self._steps and (notes := self._notes()):
                caption = replace(caption, text=f"{caption.text} {notes}".strip())
            return {**shown, "caption": caption} if caption is not caption_of(shown) else {**shown}

    def _notes(self) -> str:
        """Return what is to be said of the person's own files, such as how many rows of them were
        left out.
        """
        own = [
            path
            for name in paths_of(type(self.params))
            if (path := getattr(self.params, name)) is not None
        ]
        return " ".join(words for path in own for words in told(path))

    def _incomplete(self) -> str | None:
        """Say what a run that came to its end lacks, None when nothing: a step, and what the
        default run is to show.
        """
        lesson = self.lesson
        if not self._steps:
            return (
                f"lesson {lesson.name}: {at(lesson.run)}run ended without a step; it yields at"
                " least one state"
            )
        if self._slots or self.params != lesson.params():
            return None
        picked = (_not_picked(field, self._shown) for field in fields_of(lesson.params))
        return next(
            (
                f"lesson {lesson.name}: {lesson.params.__name__}.{wrong}"
                for wrong in picked
                if wrong
            ),
            None,
        )

    def _end(self, why: str | None = None) -> bool:
        self.finished = True
        self.stopped = why
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


def _no_scene(shown: Any) -> str | None:
    """Say why what `draw` returned is no scene, None when it is one."""
    if not isinstance(shown, Mapping):
        return f"draw returned {_kind(shown)}; it returns a dict from path to primitive"
    for path, primitive in shown.items():
        if not isinstance(path, str):
            return f"draw returned a scene with the path {path!r}; a path is a text"
        if not isinstance(primitive, PRIMITIVES):
            names = ", ".join(kind.__name__ for kind in PRIMITIVES)
            return f"the scene holds {_kind(primitive)} at {path!r}; wanted is one of {names}"
    return None


def _not_picked(field: ParamField, shown: Mapping[str, Primitive]) -> str | None:
    """Say why no click can set a field that is picked, None when one can."""
    pick = field.knob.by
    if not isinstance(pick, Pick) or (pick.path in shown and pickable(shown[pick.path])):
        return None
    can = ", ".join(path for path, primitive in shown.items() if pickable(primitive)) or "nothing"
    shows = f"shows {_kind(shown[pick.path])} at" if pick.path in shown else "shows nothing at"
    return (
        f"{field.name} is picked at {pick.path!r}, but the default run {shows} {pick.path!r}; what"
        f" can be picked: {can}"
    )


def _kind(value: object) -> str:
    if value is None:
        return "None"
    name = type(value).__name__
    return f"an {name}" if name[0].lower() in "aeiou" else f"a {name}"


class Timelines:
    """Runs kept for whoever wants them again: by lesson and params, least recently used ones
    dropped.

    A run that is dropped while somebody still holds it is found again as long as they do, and
    counts as long.
    """

    def __init__(self, most_bytes: int = 2 * 2**30, most_runs: int = 256):
        self._kept: OrderedDict[Hashable, Timeline] = OrderedDict()
        self._alive: weakref.WeakValueDictionary[Hashable, Timeline] = weakref.WeakValueDictionary()
        self._lock = threading.Lock()
        self._most_bytes, self._most_runs = most_bytes, most_runs

    def get(self, lesson: Lesson, params: Any) -> Timeline:
        """Return the run of a lesson at these params, made when there is none.

        Raises:
            InputError: If the params are not the lesson's or out of range.
        """
        key = (lesson.name, id(lesson), params)
        with self._lock:
            timeline = self._alive.get(key)
            if timeline is None:
                timeline = self._alive[key] = Timeline(lesson, params)
            self._kept[key] = timeline
            self._kept.move_to_end(key)
            while len(self._kept) > 1 and (
                len(self._kept) > self._most_runs or self.bytes > self._most_bytes
            ):
                self._kept.popitem(last=False)
            return timeline

    def drop(self) -> bool:
        """Keep the least recently used run no longer; False when none is kept."""
        with self._lock:
            return bool(self._kept) and bool(self._kept.popitem(last=False))

    def alive(self) -> list[Timeline]:
        """Return every run that is kept here or held by somebody."""
        return list(self._alive.values())

    @property
    def bytes(self) -> int:
        """What all runs hold that are kept here or held by somebody, arrays that two runs share
        counted twice.
        """
        return sum(timeline.bytes for timeline in self.alive())

    def __len__(self) -> int:
        """Return how many runs are kept."""
        return len(self._kept)


def stop_of(timeline: Timeline) -> int:
    """Return the last step of a run itself, before those that only try other starts."""
    tries = timeline.lesson.tries
    if tries is None:
        return len(timeline) - 1
    first = next((k for k, step in enumerate(timeline.known()) if tries(step.state)), len(timeline))
    return first - 1 if first else len(timeline) - 1
