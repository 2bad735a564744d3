"""What huber_weights is graded by besides the checks that a student sees."""

import numpy as np

from lessons.fitting.exercises import GRADERS
from lessons.fitting.exercises.huber_weights import judged, some_residuals
from workbench.exercise import Function, Verdict, check, worst


@check(2, public=False)
def all_on_one_side(candidate: Function) -> Verdict:
    """Points below the plane are weighed as those above."""
    r = np.abs(some_residuals(GRADERS(), 0.2))
    return worst((judged(candidate, -r, 0.2), judged(candidate, r, 0.2)))


@check(2, public=False)
def other_corners(candidate: Function) -> Verdict:
    """Other corners, single points, points at a corner, on the plane and very far off it have their
    weights too.
    """
    cases = [
        (some_residuals(GRADERS() + 1, 4.685, 30), 4.685),
        (np.array([-2.5]), 1.345),
        (np.array([0.0]), 0.1),
    ]
    cases += [
        (np.array([-0.5, 0.5, 1e-9, -1e-9, 0.0]), 0.5),
        (np.array([4e3, -9e2, 0.0]), 0.2),
        (np.zeros(4), 0.3),
    ]
    cases.append((some_residuals(GRADERS() + 2, 1e-5), 1e-5))
    return worst(judged(candidate, r, corner) for r, corner in cases)
