"""What ray_weights is graded by besides the checks that a student sees."""

import numpy as np

from lessons.learning.exercises import GRADERS
from lessons.learning.exercises.ray_weights import found, media
from workbench.exercise import Function, Verdict, check, worst


@check(2, public=False)
def few_and_many(candidate: Function) -> Verdict:
    """One ray with one sample, one with 50, and 30 rays with 12."""
    return worst(
        found(candidate, media(GRADERS() + r, r, s), 0.15, f"{r} by {s}: ")
        for r, s in ((1, 1), (1, 50), (30, 12), (7, 7))
    )


@check(2, public=False)
def thick_and_thin(candidate: Function) -> Verdict:
    """A wall, fog, nothing at all, and other spacings."""
    density = media(GRADERS(), 4, 15)
    cases = (
        (density * 1e4, 0.1, "A wall: "),
        (density * 1e-3, 0.1, "Fog: "),
        (density, 2.0, "Spacing 2 m: "),
        (density, 0.01, "Spacing 1 cm: "),
    )
    return worst(found(candidate, *case) for case in cases)


@check(1, public=False)
def empty_space(candidate: Function) -> Verdict:
    """Where nothing is, nothing counts."""
    return found(candidate, np.zeros((2, 9)), 0.3)
