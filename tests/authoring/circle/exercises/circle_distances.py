"""Write how far points are from a circle: positive outside, negative inside. The fit runs on it."""

import numpy as np

from workbench.exercise import alternative, band, beside, check, contract, left_alone, mistake

CIRCLE = np.array([2.0, -1.0, 0.5])
POINTS = np.array([[2.0, 0.0], [2.2, -1.1], [7.0, 11.0]])


def judged(candidate, p, xyr):
    got, right = candidate(p, xyr), circle_distances(p, xyr)
    hint = beside(got, right, "Subtract the radius.")
    off = 1000 * np.abs(got - right).max(initial=0.0)
    return band("Largest error", off, "mm", good=0.001, fair=0.1, hint=hint)


@contract(
    slot="circle_distances",
    examples=(
        ("circle_distances(array([[3., 0.]]), array([0., 0., 1.]))", "[2]"),
        ("circle_distances(array([[1., 1.]]), array([1., 1., 4.]))", "[-4]"),
    ),
)
def circle_distances(p: np.ndarray, xyr: np.ndarray) -> np.ndarray:
    """Return the distances (n,) of points (n, 2) to a circle x, y, r, metres; negative inside."""
    return np.linalg.norm(p - xyr[:2], axis=1) - xyr[2]


@check(2)
def points_outside_and_inside(candidate):
    """Points outside and inside have the right distance and sign."""
    return judged(candidate, POINTS, CIRCLE)


@check(1)
def points_are_left_alone(candidate):
    """The points that come in are not changed."""
    return left_alone(candidate, judged(candidate, POINTS + 1, CIRCLE))


@check(2, public=False)
def a_circle_about_the_origin(candidate):
    """A circle about the origin is no special case."""
    return judged(candidate, POINTS, np.array([0.0, 0.0, 3.0]))


@check(1, public=False)
def no_points(candidate):
    """No points have no distances."""
    return judged(candidate, POINTS[:0], CIRCLE)


@mistake("You left out the radius: the distance to the centre is not the distance to the circle.")
def to_the_centre(p, xyr):
    return np.linalg.norm(p - xyr[:2], axis=1)


@mistake("Your distances have no sign: a point inside the circle has a negative one.")
def without_a_sign(p, xyr):
    return np.abs(circle_distances(p, xyr))


@mistake("You compare squares: take the square root of the distance to the centre before.")
def of_squares(p, xyr):
    return ((p - xyr[:2]) ** 2).sum(axis=1) - xyr[2] ** 2


@alternative
def by_hypot(p, xyr):
    return np.hypot(*(p - xyr[:2]).T) - xyr[2]
