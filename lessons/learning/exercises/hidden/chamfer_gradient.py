"""What chamfer_gradient is graded by besides the checks that a student sees."""

import numpy as np

from lessons.learning.exercises import GRADERS, entries_verdict
from lessons.learning.exercises.chamfer_gradient import HINT, clouds, found
from workbench.exercise import Function, Verdict, check, worst


@check(2, public=False)
def of_any_size(candidate: Function) -> Verdict:
    """1 and 30 points, 30 and 1, 200 and 150, one and one."""
    sizes = ((1, 30), (30, 1), (200, 150), (1, 1))
    return worst(
        found(candidate, *clouds(GRADERS() + n, n, m), f"{n} and {m} points: ") for n, m in sizes
    )


@check(1, public=False)
def far_from_the_origin(candidate: Function) -> Verdict:
    """A kilometre away the gradient is the same."""
    p, q = clouds(GRADERS(), 15, 20)
    return found(candidate, p + 1000.0, q + 1000.0)


@check(1, public=False)
def nothing_where_they_are_equal(candidate: Function) -> Verdict:
    """Of a cloud to itself, in another order, the gradient is 0 everywhere."""
    p, _ = clouds(GRADERS() + 3, 25, 1)
    got = candidate(p, p[::-1].copy())
    return entries_verdict(1 + got, np.ones_like(p), HINT, "Plus 1: ")
