"""What rotation_from_six is graded by besides the checks that a student sees."""

import numpy as np

from lessons.learning.exercises import GRADERS
from lessons.learning.exercises.rotation_from_six import found, numbers
from workbench.exercise import Function, Verdict, check, worst


@check(2, public=False)
def few_and_many(candidate: Function) -> Verdict:
    """One row, three, and a thousand."""
    return worst(found(candidate, numbers(GRADERS() + n, n), f"{n:,} rows: ") for n in (1, 3, 1000))


@check(2, public=False)
def lengths_do_not_matter(candidate: Function) -> Verdict:
    """Vectors a thousand times as long, or a thousandth, give the same rotations."""
    y = numbers(GRADERS(), 12)
    return worst(
        found(candidate, y * np.repeat([a, b], 3), f"a times {a:g}, b times {b:g}: ")
        for a, b in ((1000.0, 0.001), (0.001, 1.0), (1.0, 1000.0))
    )


@check(1, public=False)
def nearly_parallel(candidate: Function) -> Verdict:
    """Two vectors a degree apart still make a rotation."""
    y = numbers(GRADERS() + 5, 8)
    y[:, 3:] = (
        y[:, :3]
        + 0.02
        * np.linalg.norm(y[:, :3], axis=1, keepdims=True)
        * np.eye(3)[[0, 1, 2, 0, 1, 2, 0, 1]]
    )
    return found(candidate, y)
