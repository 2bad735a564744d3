"""What mahalanobis is graded by besides the checks that a student sees."""

import numpy as np

from lessons.distances.exercises import GRADERS
from lessons.distances.exercises.mahalanobis import found, scattered
from workbench.exercise import Function, Verdict, check, worst


@check(2, public=False)
def other_dimensions(candidate: Function) -> Verdict:
    """In 1, 3 and 7 dimensions."""
    return worst(
        found(candidate, scattered(GRADERS() + d, 9, d), f"{d} dimensions: ") for d in (1, 3, 7)
    )


@check(2, public=False)
def units_do_not_matter(candidate: Function) -> Verdict:
    """One axis in millimetres changes no distance, nor do all in kilometres."""
    p, mean, C = scattered(GRADERS() + 20, 8, 2)
    units = np.array([1.0, 1000.0])
    in_millimetres = found(candidate, (p * units, mean * units, C * np.outer(units, units)))
    return worst(
        (in_millimetres, found(candidate, (1e-3 * p, 1e-3 * mean, 1e-6 * C), "In kilometres: "))
    )


@check(1, public=False)
def one_point_and_many(candidate: Function) -> Verdict:
    """One point, two points in two dimensions, and 3,000."""
    return worst(
        found(candidate, scattered(GRADERS() + 30 + n, n, 2), f"{n:,} points: ")
        for n in (1, 2, 3000)
    )
