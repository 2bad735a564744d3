"""A small lesson of the second form for tests: a bucket of points that loses some at each step."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Literal

import numpy as np

from workbench.captions import counted, metres
from workbench.lesson import Lesson, Look, Params, Preset, Question, States, cached, knob, say
from workbench.scene import Points, Scalar, Scene


class Input(Params):
    """What is in the bucket, and how it leaks."""

    points: int = knob(64, "How many points there are", 8, 500)
    leak: Literal["half", "some"] = knob("half", "How many leave at a step")
    some: int = knob(5, "How many leave where it is some", 1, 50)
    spread: float = knob(1.0, "How far they lie apart", 0.1, 5, unit="m")
    seed: int = knob(0, "Which points", 0, 9)


@dataclass(frozen=True, eq=False)
class Bucket:
    """The points, and where their middle is."""

    p: np.ndarray
    centre: np.ndarray


@cached
def setup(params: Input) -> Bucket:
    """Return the full bucket."""
    rng = np.random.default_rng(params.seed)
    p = rng.normal(size=(params.points, 3)) * params.spread
    return Bucket(p, p.mean(axis=0))


Halve = Callable[[int], int]


def halve(count: int) -> int:
    """Return half of a number, rounded down."""
    return count // 2


def run(params: Input, bucket: Bucket, *, halve: Halve = halve) -> Iterator[int]:
    """Yield how many points are left."""
    left = len(bucket.p)
    while left > 4:
        yield left
        left = halve(left) if params.leak == "half" else left - params.some


def draw(look: Look[Input, Bucket, int]) -> Scene:
    """Show the points that are left."""
    p = look.subject.p[: look.now]
    lost = (look.before or look.now) - look.now
    reach = float(np.linalg.norm(p - look.subject.centre, axis=1).max())
    return {
        "points": Points(p, "target", 0.02, name="points"),
        "left": Scalar(float(look.now), "left", "Points left"),
        "caption": say(
            "{left} are left, {lost} fewer than {steps} steps ago; they reach {reach}.",
            left=counted(look.now, "point"),
            lost=lost,
            steps=len(look.past),
            reach=metres(reach),
        ),
    }


def fewest(states: States[Input, Bucket, int]) -> float:
    """Return the share of the points that is left at the end."""
    return states[-1] / len(states.subject.p)


lesson = Lesson(
    name="dripping",
    title="A bucket",
    summary="It leaks.",
    params=Input,
    setup=setup,
    run=run,
    draw=draw,
    order=1,
    presets=(
        Preset(
            name="some", title="Some", line="A few leave at each step.", params=Input(leak="some")
        ),
    ),
    questions=(
        Question(
            name="share",
            text="How much is left?",
            answer=fewest,
            why=lambda states: f"{states[-1]} of {states.params.points} points are.",
            params=Input(),
            tolerance=0.01,
        ),
    ),
)
