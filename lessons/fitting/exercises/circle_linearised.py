"""Write the linear problem of a circle: how far each point is from it, and how that changes with
its centre and radius. The lesson's descent takes both from you at every step.
"""

import numpy as np
from jaxtyping import Float

from lessons.fitting.exercises import STUDENTS, entries
from workbench.exercise import (
    Function,
    Verdict,
    alternative,
    check,
    contract,
    left_alone,
    mistake,
    worst,
)
from workbench.geometry.shapes.circles_spheres import linearise_sphere


@contract(
    slot="circle_linearised",
    examples=(
        ("circle_linearised(array([0., 0., 1.]), array([[3., 0.]]))", "([2], [[-1, 0, -1]])"),
        (
            "circle_linearised(array([1., 0., 2.]), array([[1., 1.], [4., 4.]]))",
            "([-1, 3], [[0, -1, -1], [-0.6, -0.8, -1]])",
        ),
    ),
)
def circle_linearised(
    circle: Float[np.ndarray, "3"], p: Float[np.ndarray, "n 2"]
) -> tuple[Float[np.ndarray, " n"], Float[np.ndarray, "n 3"]]:
    """Return the residuals and their Jacobian, by which a circle is fitted.

    Args:
        circle: Its centre and radius (x, y, R), metres.
        p: The points, one row (x, y) each, metres.

    Returns:
        The residuals (n,), each point's distance from the centre less R: positive outside, negative
        inside. And the Jacobian (n, 3), by how much each residual changes per metre of x, of y and
        of R. A point at the centre itself has the slopes 0, 0, -1.
    """
    return linearise_sphere(circle, p)


RESIDUAL_HINT = "A residual is the distance from the centre less R: not squared, and with its sign."
SLOPE_HINT = (
    "Moving the centre towards a point brings it nearer: the row is −(p − c) / |p − c|, and then −1"
    " for R."
)


def some_points(seed: int, n: int = 12) -> tuple[np.ndarray, np.ndarray]:
    """Return a circle aside from the origin, and points on both sides of it."""
    rng = np.random.default_rng(seed)
    circle = np.append(rng.uniform(-2.0, 2.0, 2), rng.uniform(0.8, 1.6))
    return circle, circle[:2] + rng.normal(size=(n, 2)) * circle[2]


def judged(candidate: Function, circle: np.ndarray, p: np.ndarray) -> Verdict:
    """Judge residuals and Jacobian."""
    got, right = candidate(circle, p), linearise_sphere(circle, p)
    return worst(
        (
            entries("Residuals", got[0], right[0], RESIDUAL_HINT),
            entries("Jacobian", got[1], right[1], SLOPE_HINT),
        )
    )


@check(2)
def distances_have_signs(candidate: Function) -> Verdict:
    """Points outside are at positive distances, points inside at negative ones."""
    circle, p = some_points(STUDENTS)
    return entries(
        "Residuals", candidate(circle, p)[0], linearise_sphere(circle, p)[0], RESIDUAL_HINT
    )


@check(3)
def slopes_are_those_of_the_distances(candidate: Function) -> Verdict:
    """The Jacobian says how the residuals change with x, y and R."""
    circle, p = some_points(STUDENTS + 1)
    return entries("Jacobian", candidate(circle, p)[1], linearise_sphere(circle, p)[1], SLOPE_HINT)


@check(1)
def inputs_are_left_alone(candidate: Function) -> Verdict:
    """The circle and the points that come in are not changed."""
    return left_alone(candidate, judged(candidate, *some_points(STUDENTS + 2)))


def parts(circle: np.ndarray, p: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return the vectors from the centre, their lengths, and lengths to divide by."""
    v = p - circle[:2]
    length = np.linalg.norm(v, axis=1)
    return v, length, np.where(length > 0, length, np.inf)[:, None]


def minus_ones(p: np.ndarray) -> np.ndarray:
    """Return the column of the radius."""
    return -np.ones(len(p))


@mistake(
    "You squared: |p − c|² − R² is the algebraic distance of Kåsa's fit, which makes short arcs too"
    " small. Take |p − c| − R."
)
def squared_distances(circle: np.ndarray, p: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Linearises the algebraic distance."""
    v, length, _ = parts(circle, p)
    return length**2 - circle[2] ** 2, np.column_stack([-2 * v, -2 * circle[2] * np.ones(len(p))])


@mistake(
    "Your Jacobian has the wrong sign: a centre that moves towards a point brings it nearer. Steps"
    " with it go uphill."
)
def sign_of_the_jacobian(circle: np.ndarray, p: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Returns -J."""
    residuals, jacobian = linearise_sphere(circle, p)
    return residuals, -jacobian


@mistake(
    "Your Jacobian is that of the squared distance, or not divided by |p − c|: the slopes by x and"
    " y are those of a unit vector."
)
def not_divided(circle: np.ndarray, p: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Leaves the direction long."""
    v, length, _ = parts(circle, p)
    return length - circle[2], np.column_stack([-v, minus_ones(p)])


@mistake(
    "You take R − |p − c|, with its slopes. That fits the same circle, but here outside is"
    " positive: |p − c| − R."
)
def turned_round(circle: np.ndarray, p: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Makes inside positive in both."""
    residuals, jacobian = linearise_sphere(circle, p)
    return -residuals, -jacobian


@mistake(
    "Your residuals have the wrong sign for your Jacobian: R − |p − c| with the slopes of |p − c| −"
    " R goes uphill."
)
def residuals_turned_round(circle: np.ndarray, p: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Makes inside positive in the residuals alone."""
    residuals, jacobian = linearise_sphere(circle, p)
    return -residuals, jacobian


@mistake(
    "Your residuals have lost their sign. A distance with |...| around it has a kink at the circle:"
    " keep inside negative."
)
def absolute_distances(circle: np.ndarray, p: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Takes the absolute value of the residuals."""
    residuals, jacobian = linearise_sphere(circle, p)
    return np.abs(residuals), jacobian


@mistake(
    "The column of R has the wrong sign: a larger circle is nearer to a point outside, so its slope"
    " is −1."
)
def sign_of_the_radius(circle: np.ndarray, p: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Has +1 for R."""
    residuals, jacobian = linearise_sphere(circle, p)
    return residuals, jacobian * [1.0, 1.0, -1.0]


@mistake(
    "Your slopes by x and y have the wrong sign, the one by R is right: a centre that moves towards"
    " a point is nearer to it."
)
def sign_of_the_center(circle: np.ndarray, p: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Has +v / |v| for the centre."""
    residuals, jacobian = linearise_sphere(circle, p)
    return residuals, jacobian * [-1.0, -1.0, 1.0]


@mistake("You forgot the radius: a residual is the distance from the centre less R.")
def radius_forgotten(circle: np.ndarray, p: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Takes the distance from the centre."""
    residuals, jacobian = linearise_sphere(circle, p)
    return residuals + circle[2], jacobian


@mistake(
    "A point at the centre makes your Jacobian divide by 0. It has no direction: give it the slopes"
    " 0, 0, −1."
)
def divided_by_zero(circle: np.ndarray, p: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Divides whatever the distance."""
    v, length, _ = parts(circle, p)
    with np.errstate(all="ignore"):
        return length - circle[2], np.column_stack([-v / length[:, None], minus_ones(p)])


@alternative
def point_by_point(circle: np.ndarray, p: np.ndarray) -> tuple[list[float], list[list[float]]]:
    """Goes row by row."""
    residuals, rows = [], []
    for x, y in p:
        dx, dy = x - circle[0], y - circle[1]
        d = float(np.hypot(dx, dy))
        residuals.append(float(d - circle[2]))
        rows.append([float(-dx / d), float(-dy / d), -1.0] if d > 0 else [0.0, 0.0, -1.0])
    return residuals, rows


@alternative
def by_angles(circle: np.ndarray, p: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Takes the direction from its angle."""
    v, length, _ = parts(circle, p)
    turn = np.arctan2(v[:, 1], v[:, 0])
    slopes = np.column_stack([-np.cos(turn), -np.sin(turn)]) * (length > 0)[:, None]
    return length - circle[2], np.column_stack([slopes, minus_ones(p)])
