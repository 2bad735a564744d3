"""A lesson with the student's function in the slot, the reference's run beside it as a ghost.

The result is an ordinary lesson, so it is watched live, stepped back through and recorded.
"""

import itertools
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from workbench.exercise.candidate import Candidate
from workbench.exercise.model import Exercise, Function
from workbench.exercise.naming import values_alike
from workbench.exercise.student import StudentError
from workbench.form import Form, Look
from workbench.lesson import Lesson
from workbench.run.timeline import Step, Timeline
from workbench.scene import (
    Caption,
    Mesh,
    Points,
    Primitive,
    Scalar,
    Scene,
    Segments,
    caption_of,
    ghost,
)

TOLERANCE = 1e-6  # of the larger of 1 and the size of what is compared
DIFFERENCE = "exercise/difference"


@dataclass(frozen=True, kw_only=True, eq=False)
class StepPair:
    """One step of both runs, drawn once.

    Attributes:
        ours, theirs: The states; None where the student's function gave nothing.
        trouble: Why there is none.
        line: The student's own line where it went wrong, 0 where it is not known.
        difference: How far the two scenes are apart.
        first: Whether this is the first step at which they differ.
        called: Whether the run has called the student's function, up to this step.
        scene: The student's scene; ours where there is none.
        ghost: What of ours stands elsewhere, faint; empty where the two agree.
    """

    ours: Any
    theirs: Any
    trouble: str
    line: int
    difference: float
    first: bool
    called: bool
    scene: Scene
    ghost: Scene


class _Beside:
    """A student's function as a run calls it; remembers whether it was called, and differed.

    Where it never did, the two runs part by rounding at most: equal costs are told apart by it.
    """

    def __init__(self, function: Function, exercise: Exercise):
        self._candidate = Candidate(function, exercise.reference, remember=False)
        self._contract = exercise.contract
        self.called = self.differed = False

    def __call__(self, *args: Any) -> Any:
        self.called = True
        value = self._candidate(*args)
        right = self._candidate.expected
        alike = any(values_alike(value, form) for form in (right, *self._contract.others(right)))
        self.differed = self.differed or not alike
        return value


def driven(lesson: Lesson, exercise: Exercise, function: Function) -> Lesson:
    """Return the lesson driven by a student's function, with the reference's run as its ghost."""
    form = lesson.form

    def run(params: Any, subject: Any) -> Iterator[StepPair]:
        beside = _Beside(function, exercise)
        ours = form.run(params, subject)
        theirs = form.run(params, subject, **{exercise.contract.slot: beside})
        draw_ours, draw_theirs = _Drawn(form, params, subject), _Drawn(form, params, subject)
        state_ours = None
        scene_ours = {}
        differed = False
        while True:
            for state_ours in itertools.islice(ours, 1):
                scene_ours = draw_ours(state_ours)
            try:
                state = next(theirs)
                scene = draw_theirs(state)
            except StopIteration:
                return
            except Exception as error:
                trouble, line = _trouble(error, exercise)
                yield StepPair(
                    ours=state_ours,
                    theirs=None,
                    trouble=trouble,
                    line=line,
                    difference=float("nan"),
                    first=not differed,
                    called=beside.called,
                    scene=scene_ours,
                    ghost={},
                )
                return
            difference = gap(scene_ours, scene)
            differs = beside.differed and not difference <= TOLERANCE
            behind = ghost(scene_ours, scene) if differs else {}
            first = differs and not differed
            yield StepPair(
                ours=state_ours,
                theirs=state,
                trouble="",
                line=0,
                difference=difference,
                first=first,
                called=beside.called,
                scene=scene,
                ghost=behind,
            )
            differed = differed or differs

    def draw(look: Look[Any, Any, StepPair]) -> Scene:
        pair = look.now
        scene = {**pair.scene, **pair.ghost}
        if pair.theirs is None:
            return scene | {
                "caption": Caption(pair.trouble, "wrong"),
                DIFFERENCE: _difference(float("nan")),
            }
        if pair.first:
            text = caption_of(scene).text
            scene["caption"] = Caption(
                f"Here your run first differs from the reference (its ghost is faint). {text}",
                "wrong",
            )
        return scene | ({DIFFERENCE: _difference(pair.difference)} if pair.called else {})

    return replace(lesson, setup=form.setup, run=run, draw=draw, slots=(), questions=(), tries=None)


class _Drawn:
    """Draws the states of one run in their order."""

    def __init__(self, form: Form, params: Any, subject: Any):
        self._form, self._params, self._subject = form, params, subject
        self._past: tuple[Any, ...] = ()

    def __call__(self, state: Any) -> Scene:
        look = Look(params=self._params, subject=self._subject, now=state, past=self._past)
        self._past = (*self._past, state)
        return self._form.draw(look)


def _trouble(error: Exception, exercise: Exercise) -> tuple[str, int]:
    """Say what went wrong, and in which line: the student's own error, or the lesson's."""
    if isinstance(error, StudentError):
        return str(error), error.line
    message = " ".join(str(error).split())[:200]
    return (
        (
            f"The lesson cannot go on with what {exercise.name} returned ({type(error).__name__}:"
            f" {message})."
        ),
        0,
    )


def _difference(value: float) -> Scalar:
    return Scalar(
        value if np.isfinite(value) else float("nan"),
        "largest difference",
        "Difference to the reference",
        "",
        "wrong",
    )


def gap(a: Scene, b: Scene) -> float:
    """Return how far two scenes are apart: the largest distance of points, or of scalars.

    Scalars are compared relative to their size where that is above 1. Things that one scene lacks,
    or that have another number of points, are infinitely far apart.
    """
    largest = 0.0
    for path in a.keys() | b.keys():
        if path in a and path in b:
            largest = max(largest, _apart(a[path], b[path]))
        elif isinstance(a.get(path, b.get(path)), (Points, Mesh, Segments, Scalar)):
            return float("inf")
    return largest


def _apart(a: Primitive, b: Primitive) -> float:
    if isinstance(a, Scalar) and isinstance(b, Scalar):
        if np.isnan(a.value) and np.isnan(b.value):
            return 0.0
        difference = abs(a.value - b.value) / max(1.0, abs(a.value))
        return difference if np.isfinite(difference) else float("inf")
    if isinstance(a, (Points, Mesh, Segments)) and isinstance(b, (Points, Mesh, Segments)):
        p_a, p_b = _in_world(a), _in_world(b)
        if p_a.shape != p_b.shape:
            return float("inf")
        return float(np.abs(p_a - p_b).max(initial=0.0) / np.abs(p_a).max(initial=1.0))
    return 0.0


def _in_world(primitive: Points | Mesh | Segments) -> np.ndarray:
    p = primitive.ends if isinstance(primitive, Segments) else primitive.p
    T = primitive.T_world_object
    return p if T is None else p @ T[:3, :3].T + T[:3, 3]


def calls_it(timeline: Timeline) -> bool | None:
    """Return whether a student's run calls the function; None where that is not known."""
    steps = timeline.known()
    if not steps or not isinstance(steps[-1].state, StepPair):
        return None
    if steps[-1].state.called:
        return True
    return False if timeline.finished else None


def first_difference(steps: Iterable[Step]) -> int | None:
    """Return the first step at which the student's run differs or fails, or None."""
    for k, step in enumerate(steps):
        if not isinstance(step.state, StepPair):
            return None
        if step.state.first:
            return k
    return None
