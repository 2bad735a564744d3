"""What circle_linearised is graded by besides the checks that a student sees."""

import numpy as np

from lessons.fitting.exercises import GRADERS, entries
from lessons.fitting.exercises.circle_linearised import (
    RESIDUAL_HINT,
    SLOPE_HINT,
    judged,
    some_points,
)
from workbench.exercise import Function, Verdict, check, worst
from workbench.geometry.shapes.circles_spheres import linearise_sphere


@check(2, public=False)
def iterated_it_finds_the_circle(candidate: Function) -> Verdict:
    """Six steps of Gauss-Newton with it end at the circle with the least squared distances."""
    rng = np.random.default_rng(GRADERS())
    turn = rng.uniform(0.0, 4.0, 50)
    p = (
        np.column_stack([np.cos(turn), np.sin(turn)])
        + 0.03 * rng.normal(size=(50, 2))
        + [3.0, -2.0]
    )
    circle, right = np.array([3.2, -1.9, 0.8]), np.array([3.2, -1.9, 0.8])
    for _ in range(6):
        residuals, jacobian = candidate(circle, p)
        circle = circle - np.linalg.lstsq(jacobian, residuals, rcond=None)[0]
        residuals, jacobian = linearise_sphere(right, p)
        right = right - np.linalg.lstsq(jacobian, residuals, rcond=None)[0]
    return entries("Circle after six steps", circle, right, f"{RESIDUAL_HINT} {SLOPE_HINT}")


@check(2, public=False)
def other_circles(candidate: Function) -> Verdict:
    """Large, small and far circles, and single points, have theirs."""
    verdicts = [
        judged(candidate, *some_points(GRADERS() + 1, 1)),
        judged(candidate, *some_points(GRADERS() + 2, 40)),
    ]
    circle, p = some_points(GRADERS() + 3)
    verdicts += [
        judged(candidate, 100.0 * circle, 100.0 * p),
        judged(candidate, 0.01 * circle, 0.01 * p),
    ]
    return worst(verdicts)


@check(1, public=False)
def a_point_at_the_centre(candidate: Function) -> Verdict:
    """A point at the centre has no direction, and slopes 0, 0, −1; a micrometre from it there is
    one.
    """
    circle = np.array([0.5, -0.25, 2.0])
    near = np.array([[0.5 + 1e-6, -0.25], [0.5, -0.25 - 2e-6], [0.5 - 3e-6, -0.25 + 4e-6]])
    here = judged(candidate, circle, np.array([[0.5, -0.25], [2.5, -0.25], [0.5, 3.0]]))
    return worst((here, judged(candidate, circle, near)))
