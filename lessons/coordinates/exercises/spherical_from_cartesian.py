"""Write the spherical coordinates of points. The walk past the axis and the camera's mount take
their angles from you: a camera with a wrong azimuth looks past its target.
"""

import math

import numpy as np
from jaxtyping import Float

from lessons.coordinates.exercises import STUDENTS, numbers, row_by_row
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
from workbench.geometry.shapes import curvilinear


@contract(
    slot="spherical_from_cartesian",
    examples=(
        ("spherical_from_cartesian(np.array([[0.0, 2.0, 0.0]]))", "[[2, 1.5708, 1.5708]]"),
        (
            "spherical_from_cartesian(np.array([[-1.0, 0.0, 1.0], [0.0, 0.0, -3.0]]))",
            "[[1.4142, 0.7854, 3.1416], [3, 3.1416, 0]]",
        ),
    ),
)
def spherical_from_cartesian(p: Float[np.ndarray, "n 3"]) -> Float[np.ndarray, "n 3"]:
    """Return r, polar angle and azimuth of points, one row each; metres and radians.

    The polar angle runs from 0 at +z to pi at -z and is exact near the axis too: a point a
    billionth of a radian from +z has a polar angle of 1e-9. The azimuth runs from +x towards +y, in
    (-pi, pi].

    Args:
        p: One row (x, y, z) per point, metres. A coordinate may be -0.0, which is 0: (-1, -0.0, 0)
            has the azimuth pi.

    Returns:
        Rows (r, polar, azimuth). On the axis, where the azimuth has no meaning, it is 0; the origin
        is (0, 0, 0).
    """
    return curvilinear.spherical_from_cartesian(p)


ANGLES = "r = |p|, polar = atan2(√(x² + y²), z), azimuth = atan2(y, x)."
# radians: about the largest angles whose cosine is 1 in double precision
LOST = (1.02e-8, 1.03e-8, 1.04e-8)
AXIS = "Near the axis arccos has no digits left: atan2(√(x² + y²), z) has."


def judged(candidate: Function, p: np.ndarray, hint: str = ANGLES) -> Verdict:
    """Judge coordinates by their largest difference, of r as a share of it, of angles in
    radians.
    """
    got = candidate(p)
    right = curvilinear.spherical_from_cartesian(p)
    size = np.column_stack([np.maximum(right[:, 0], 1e-12), np.ones((len(p), 2))])
    off = (np.abs(got - right) / size).max(axis=1)
    return row_by_row(
        [f"The point {numbers(row)}" for row in p], got, right, off, hint, good=1e-6, fair=1e-3
    )


def all_round(seed: int, n: int = 24, radius: float = 2.0) -> np.ndarray:
    """Return points in all directions, in every octant some."""
    rng = np.random.default_rng(seed)
    signs = np.array(list(np.ndindex(2, 2, 2)))[np.arange(n) % 8] * 2.0 - 1.0
    return radius * signs * rng.uniform(0.1, 1.0, (n, 3))


@check(3)
def points_all_round(candidate: Function) -> Verdict:
    """Points of all eight octants have their distance, polar angle and azimuth."""
    return judged(candidate, all_round(STUDENTS))


@check(2)
def half_planes_and_axes(candidate: Function) -> Verdict:
    """On -x the azimuth is pi, on the z axis 0; the origin is (0, 0, 0)."""
    p = np.array([[-2.0, 0, 0], [0, 0, 3], [0, 0, -0.5], [0, 0, 0], [0, -1, 0], [1, 0, 0]])
    return judged(
        candidate, p, f"On the z axis take 0 for the azimuth, at the origin 0 for all. {ANGLES}"
    )


@check(1)
def points_are_left_alone(candidate: Function) -> Verdict:
    """The points that come in are not changed."""
    return left_alone(candidate, judged(candidate, all_round(STUDENTS + 1)))


@check(2)
def near_the_axis(candidate: Function) -> Verdict:
    """Points millionths and billionths of a radian from the axis have that polar angle."""
    return near(candidate, np.array([1e-4, 1e-6, *LOST, 1e-9]), 1e-3)


def near(candidate: Function, polar: np.ndarray, r: float, azimuth: float = 0.0) -> Verdict:
    """Judge polar angles close to +z as shares of themselves."""
    x, y = (r * np.sin(polar) * part for part in (np.cos(azimuth), np.sin(azimuth)))
    p = np.column_stack([x, y, r * np.cos(polar)])
    got = candidate(p)
    off = np.abs(got[:, 1] / polar - 1)
    asked = [f"A polar angle of {numbers(angle)} radians" for angle in polar]
    turned = judged(candidate, p)
    return worst((row_by_row(asked, got[:, 1], polar, off, AXIS, good=1e-4, fair=1e-2), turned))


def columns(r: np.ndarray, polar: np.ndarray, azimuth: np.ndarray) -> np.ndarray:
    """Return three columns."""
    return np.column_stack([r, polar, azimuth])


@mistake(
    "You wrote arctan(y / x): it cannot tell (x, y) from (−x, −y), so half of all azimuths are π"
    " off. atan2(y, x) can."
)
def atan_of_the_quotient(p: np.ndarray) -> np.ndarray:
    """Divides first."""
    r, polar, _ = curvilinear.spherical_from_cartesian(p).T
    azimuth = np.arctan(np.divide(p[:, 1], p[:, 0], out=np.zeros(len(p)), where=p[:, 0] != 0))
    azimuth[p[:, 0] == 0] = np.pi / 2 * np.sign(p[p[:, 0] == 0, 1])
    return columns(r, polar, azimuth)


@mistake(
    "You wrote arctan(y / x) and divide by 0 on the axis; it also puts half of all azimuths π off."
    " Use atan2(y, x)."
)
def atan_and_nan(p: np.ndarray) -> np.ndarray:
    """Divides first, also by 0."""
    r, polar, _ = curvilinear.spherical_from_cartesian(p).T
    return columns(r, polar, np.arctan(p[:, 1] / p[:, 0]))


@mistake(
    "Your polar angle is arccos(z / r): below a hundred-millionth of a radian it is 0, near that it"
    " is wrong, and at the origin it is 0 / 0. Use atan2(√(x² + y²), z)."
)
def arccos_of_the_quotient(p: np.ndarray) -> np.ndarray:
    """Takes the arc cosine, also of 0 / 0."""
    r = np.linalg.norm(p, axis=1)
    azimuth = np.arctan2(p[:, 1], p[:, 0])
    return columns(r, np.arccos(p[:, 2] / r), azimuth)


@mistake(
    "Your polar angle is arccos(z / r), with the origin looked after: below a hundred-millionth of"
    " a radian it is 0, near that it is wrong. Use atan2(√(x² + y²), z)."
)
def arccos_with_care(p: np.ndarray) -> np.ndarray:
    """Takes the arc cosine, but not of 0 / 0."""
    r = np.linalg.norm(p, axis=1)
    azimuth = np.arctan2(p[:, 1], p[:, 0])
    return columns(r, np.arccos(np.divide(p[:, 2], r, out=np.ones(len(p)), where=r > 0)), azimuth)


@mistake(
    "Your second angle is the elevation above the x-y plane. The polar angle starts at +z: the two"
    " add up to π/2."
)
def elevation(p: np.ndarray) -> np.ndarray:
    """Measures from the plane."""
    r, _, azimuth = curvilinear.spherical_from_cartesian(p).T
    return columns(r, np.arctan2(p[:, 2], np.hypot(p[:, 0], p[:, 1])), azimuth)


@mistake("Your two angles stand in the other order. Rows are (r, polar, azimuth).")
def other_order(p: np.ndarray) -> np.ndarray:
    """Returns r, azimuth, polar."""
    return curvilinear.spherical_from_cartesian(p)[:, [0, 2, 1]]


@mistake("Your angles are in degrees. Radians are asked for.")
def in_degrees(p: np.ndarray) -> np.ndarray:
    """Converts."""
    return curvilinear.spherical_from_cartesian(p) * [1.0, 180 / np.pi, 180 / np.pi]


@mistake(
    "Your azimuth runs from 0 to 2π. Here it is in (−π, π]: what atan2 gives, without anything"
    " added."
)
def from_zero_to_two_pi(p: np.ndarray) -> np.ndarray:
    """Adds a turn to negative ones."""
    r, polar, azimuth = curvilinear.spherical_from_cartesian(p).T
    return columns(r, polar, azimuth % (2 * np.pi))


@mistake("You gave atan2 its arguments in the order x, y. It takes y first: atan2(y, x).")
def atan2_of_x_y(p: np.ndarray) -> np.ndarray:
    """Measures the azimuth from +y."""
    r, polar, _ = curvilinear.spherical_from_cartesian(p).T
    return columns(r, polar, np.arctan2(p[:, 0], p[:, 1]))


@mistake(
    "Your r is √(x² + y²), the distance from the axis. r is the distance from the origin, with z."
)
def distance_from_the_axis(p: np.ndarray) -> np.ndarray:
    """Leaves z out."""
    _, polar, azimuth = curvilinear.spherical_from_cartesian(p).T
    return columns(np.hypot(p[:, 0], p[:, 1]), polar, azimuth)


@mistake(
    "All is right but where a coordinate is minus zero: atan2 listens to the sign of a zero and"
    " says −π, or π on the axis. Add 0.0 to the coordinates first."
)
def sign_of_a_zero(p: np.ndarray) -> np.ndarray:
    """Takes the arctangents of what comes in."""
    x, y, z = p.T
    return columns(np.linalg.norm(p, axis=1), np.arctan2(np.hypot(x, y), z), np.arctan2(y, x))


@alternative
def by_complex_numbers(p: np.ndarray) -> np.ndarray:
    """Takes angles of complex numbers."""
    p = p + 0.0  # -0.0 becomes 0
    flat = p[:, 0] + 1j * p[:, 1]
    up = p[:, 2] + 1j * np.abs(flat)
    return np.column_stack([np.abs(up), np.angle(up), np.angle(flat)])


@alternative
def point_by_point(p: np.ndarray) -> np.ndarray:
    """Goes through the points with Python's own functions."""
    rows = []
    for x, y, z in p + 0.0:
        rho = math.hypot(x, y)
        rows.append((math.hypot(rho, z), math.atan2(rho, z), math.atan2(y, x) if rho else 0.0))
    return np.array(rows)
