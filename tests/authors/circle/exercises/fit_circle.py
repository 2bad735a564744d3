"""Write the algebraic fit of a circle: x² + y² = 2ax + 2by + c is linear in a, b and c. The lesson
refines your circle.
"""

import numpy as np

from workbench.exercise import (
    alternative,
    band,
    beside,
    check,
    contract,
    left_alone,
    mistake,
    refused,
    worst,
)

CIRCLE = np.array([2.0, -1.0, 0.5])
HINT = "Solve [2x 2y 1] (a, b, c) = x² + y²; then r² = c + a² + b²."


def on_circle(circle: np.ndarray, degrees: float = 300.0, noise: float = 0.0) -> np.ndarray:
    angles = np.radians(np.linspace(10, 10 + degrees, 12))
    p = circle[:2] + circle[2] * np.column_stack([np.cos(angles), np.sin(angles)])
    return p + noise * np.random.default_rng(7).standard_normal(p.shape)


def judged(candidate, p):
    got, right = candidate(p), fit_circle(p)
    off = 1000 * float(np.abs(got - right).max())
    return band(
        "Largest error of x, y or r", off, "mm", good=0.01, fair=1.0, hint=beside(got, right, HINT)
    )


@contract(
    slot="fit_circle",
    examples=(
        ("fit_circle(array([[1., 0.], [0., 1.], [-1., 0.], [0., -1.]]))", "[0, 0, 1]"),
        ("fit_circle(array([[0., 0.], [2., 0.], [0., 2.]]))", "[1, 1, 1.4142]"),
    ),
)
def fit_circle(p: np.ndarray) -> np.ndarray:
    """Return the circle x, y, r, metres, that solves x² + y² = 2ax + 2by + c best for the points,
    one row (x, y) each.

    Raises:
        ValueError: If the points, or all but one, coincide or lie on one line.
    """
    A = np.column_stack([2 * p, np.ones(len(p))])
    (a, b, c), _, rank, _ = np.linalg.lstsq(A, (p**2).sum(axis=1), rcond=1e-9)
    if rank < 3:
        raise ValueError("the points do not say which circle")
    return np.array([a, b, np.sqrt(c + a**2 + b**2)])


@check(2)
def points_on_a_circle(candidate):
    """Points on a circle give this circle."""
    return judged(candidate, on_circle(CIRCLE))


@check(1)
def points_are_left_alone(candidate):
    """The points that come in are not changed."""
    return left_alone(candidate, judged(candidate, on_circle(CIRCLE)))


@check(2, public=False)
def points_with_noise(candidate):
    """Points with noise on arcs give the least-squares solution of the linear system."""
    return worst(
        judged(candidate, on_circle(CIRCLE, degrees, 0.02)) for degrees in (40.0, 120.0, 350.0)
    )


@check(1, public=False)
def points_on_a_line(candidate):
    """Points on one line are refused."""
    return refused(candidate, np.outer(np.arange(6.0), [1.0, 2.0]), what="Six points on a line")


@mistake(
    "You took the mean of the points for the centre. It lies inside the arc: solve the linear"
    " system for the centre."
)
def mean_for_centre(p: np.ndarray) -> np.ndarray:
    return np.array([*p.mean(axis=0), np.linalg.norm(p - p.mean(axis=0), axis=1).mean()])


@mistake("Your radius is r², not r: take the square root of c + a² + b².")
def squared_radius(p: np.ndarray) -> np.ndarray:
    return fit_circle(p) ** np.array([1, 1, 2])


@mistake(
    "Your centre is twice as far out as it should be: the unknowns are a and b, and the columns are"
    " 2x and 2y."
)
def doubled_centre(p: np.ndarray) -> np.ndarray:
    return fit_circle(p) * np.array([2, 2, 1])


@alternative
def by_normal_equations(p: np.ndarray) -> np.ndarray:
    A = np.column_stack([2 * p, np.ones(len(p))])
    if np.linalg.matrix_rank(A, tol=1e-9) < 3:
        raise ValueError("on a line")
    a, b, c = np.linalg.solve(A.T @ A, A.T @ (p**2).sum(axis=1))
    return np.array([a, b, np.sqrt(c + a**2 + b**2)])
