"""Write the guess: the plane through a sample of three points. The lesson draws it in purple for
every sample and counts who is near it. It is used where the model is a plane, as in the default
run; the preset 'Three points on one line' shows what becomes of a sample that has none.
"""

import math

import numpy as np
from jaxtyping import Float

from lessons.ransac.exercises import STUDENTS
from workbench.exercise import (
    Function,
    Verdict,
    against,
    alternative,
    band,
    check,
    contract,
    fail,
    full,
    left_alone,
    mistake,
    number,
    partial,
    worst,
)
from workbench.geometry.motions import exp_so3
from workbench.geometry.shapes import lines_planes

NO_UNIT = 1e-5  # how far a normal's length may be from 1: rounding, also of single precision


@contract(
    slot="plane_from_points",
    either=np.negative,
    examples=(
        ("plane_from_points(np.array([[0.0, 0, 2], [1, 0, 2], [0, 1, 2]]))", "[0, 0, 1, -2]"),
        (
            "plane_from_points(np.array([[0.0, 0, 0], [1, 1, 1], [3, 3, 3]]))",
            "[nan, nan, nan, nan]",
        ),
    ),
)
def plane_from_points(p: Float[np.ndarray, "3 3"]) -> Float[np.ndarray, "4"]:
    """Return the plane through three points.

    Args:
        p: The three points, one per row, metres. Any place, any size: sides of a micrometre or of a
            kilometre.

    Returns:
        (a, b, c, d) with a unit normal n = (a, b, c) and d in metres, so that n . p + d is a
        point's signed distance and 0 for the three. Either side may be the normal's: (a, b, c, d)
        and (-a, -b, -c, -d) are the same plane. Points on one line, or coinciding, have many
        planes: return four nan, do not raise. They count as such where the cross product of two
        sides is shorter than a billionth of the squared longest side: rounding leaves less.
    """
    return lines_planes.plane_from_points(p)


NORMAL_HINT = "The normal is at right angles to the sides, such as p[1] - p[0] and p[2] - p[0]."


OFFSET_HINT = "n . p + d is 0 at each of the points."


NAN_HINT = (
    "How small an area counts as none depends on the sides: compare it with the squared longest"
    " one."
)


def a_triangle(rng: np.random.Generator, size: float = 1.0) -> np.ndarray:
    """Return three points that are far from being on one line, aside from the origin."""
    sides = np.array([[0.0, 0.0], [1.0, 0.1], [0.3, 0.8]]) + rng.uniform(-0.2, 0.2, (3, 2))
    R = exp_so3(rng.normal(size=3))
    return size * (np.column_stack([sides, np.zeros(3)]) @ R.T + rng.uniform(-1.0, 1.0, 3))


def plane_verdict(got: np.ndarray, right: np.ndarray, p: np.ndarray, case: str) -> Verdict:
    """Judge a plane by its unit normal, up to sign, in degrees, and by its distance to points of
    the right one, in metres.

    Args:
        got: The answer.
        right: The right plane.
        p: Points on it, metres. Distances are judged by how far apart these are.
        case: How the message begins.
    """
    if not np.isfinite(got).all():
        return fail(f"{case}: yours is {against(got, right)}. {NAN_HINT}")
    length = float(np.linalg.norm(got[:3]))
    size = float(np.ptp(p, axis=0).max())
    if abs(length - 1.0) > NO_UNIT:
        remark = (
            f"The length of your normal is {against(length, 1.0)}: distances come out as many times"
            " as large."
        )
        return fail(f"{case}: {remark}")
    degrees = float(
        np.degrees(
            np.arctan2(np.linalg.norm(np.cross(got[:3], right[:3])), abs(got[:3] @ right[:3]))
        )
    )
    away = float(np.abs(p @ got[:3] + got[3]).max())
    side = np.where(got[:3] @ right[:3] < 0, -right, right)
    told = f"Yours is {against(got, side)} or its negative."
    turned = band(
        f"{case}: normal off by",
        round(degrees, 9),
        "degrees",
        good=0.01,
        fair=1.0,
        hint=f"{told} {NORMAL_HINT}",
    )
    unit = 10.0 ** round(np.log10(size))
    away = away if away > 1e-9 * unit else 0.0  # rounding is not worth reading
    moved = band(
        f"{case}: plane off the points by",
        away,
        "m",
        good=1e-6 * unit,
        fair=1e-2 * unit,
        hint=f"{told} {OFFSET_HINT}",
    )
    return worst((turned, moved))


def found(candidate: Function, p: np.ndarray, case: str) -> Verdict:
    """Judge the plane through three points that have one."""
    return plane_verdict(candidate(p), plane_from_points(p), p, case)


def no_plane(got: np.ndarray, case: str) -> Verdict:
    """Judge the answer to points that have many planes."""
    unknown = int(np.isnan(got).sum())
    if unknown == len(got):
        return full(f"{case}: four nan.")
    message = f"{case}: yours is {number(got)}, right is four nan: many planes fit."
    return partial(0.5, message) if unknown else fail(message)


@check(2)
def floor_and_slope(candidate: Function) -> Verdict:
    """The plane of a floor 0.8 m up, and of a roof that rises 3 m over 4 m, is found."""
    floor = np.array([[0.0, 0.0, 0.8], [2.0, 0.0, 0.8], [0.0, 1.0, 0.8]])
    roof = np.array([[0.0, 0.0, 2.0], [4.0, 0.0, 5.0], [0.0, 3.0, 2.0]])
    return worst(
        (
            plane_verdict(candidate(floor), np.array([0.0, 0.0, 1.0, -0.8]), floor, "Floor"),
            plane_verdict(candidate(roof), np.array([-0.6, 0.0, 0.8, -1.6]), roof, "Roof"),
        )
    )


@check(2)
def three_points_anywhere(candidate: Function) -> Verdict:
    """Planes in any direction go through their three points."""
    rng = np.random.default_rng(STUDENTS)
    return worst(found(candidate, a_triangle(rng), f"Triangle {k}") for k in (1, 2, 3))


@check(1)
def points_on_a_line(candidate: Function) -> Verdict:
    """Three points on one line, and points that coincide, give four nan."""
    line = np.array([[1.0, 2.0, 0.0], [2.0, 4.0, 1.0], [4.0, 8.0, 3.0]])
    verdicts = [no_plane(candidate(line), "(1, 2, 0), (2, 4, 1), (4, 8, 3) are on one line")]
    for k in ([0, 1, 1], [0, 0, 1], [0, 1, 0], [1, 1, 1]):
        verdicts.append(no_plane(candidate(line[k]), f"Points {k} of these coincide"))
    return worst(verdicts)


@check(1)
def points_are_left_alone(candidate: Function) -> Verdict:
    """The points that come in are not changed."""
    return left_alone(
        candidate, found(candidate, a_triangle(np.random.default_rng(STUDENTS + 1)), "A triangle")
    )


NO_PLANE = np.full(4, np.nan)


def area_normal(p: np.ndarray) -> np.ndarray:
    """Return the cross product of two sides: along the normal, and twice the area long."""
    return np.cross(p[1] - p[0], p[2] - p[0])


def on_one_line(p: np.ndarray) -> bool:
    """Tell whether points determine no plane."""
    longest = max(np.linalg.norm(p[i] - p[j]) for i, j in ((0, 1), (1, 2), (2, 0)))
    return bool(np.linalg.norm(area_normal(p)) <= 1e-9 * longest**2)


def unit(v: np.ndarray) -> np.ndarray:
    """Return a vector at length one."""
    return v / np.linalg.norm(v)


def through(normal: np.ndarray, p: np.ndarray) -> np.ndarray:
    """Return the plane with a normal through a point."""
    return np.append(normal, -normal @ p)


@mistake(
    "Your plane is right but its normal is not of length 1. Then |n . p + d| is no distance: it"
    " comes out multiplied by the normal's length, and so do the votes."
)
def not_normalised(p: np.ndarray) -> np.ndarray:
    """Leaves the normal as long as the cross product."""
    return NO_PLANE if on_one_line(p) else through(area_normal(p), p[0])


@mistake(
    "You divided by the length of (a, b, c, d). Only the normal (a, b, c) gets length 1: d is a"
    " distance and may be anything."
)
def all_four_normalised(p: np.ndarray) -> np.ndarray:
    """Divides a, b, c and d by the length of all four."""
    return NO_PLANE if on_one_line(p) else unit(through(area_normal(p), p[0]))


@mistake(
    "You normalised the normal but not d. Compute d = -n . p from the unit normal, or divide both"
    " by the same length."
)
def d_left_long(p: np.ndarray) -> np.ndarray:
    """Normalises the normal after d was computed with the long one."""
    return NO_PLANE if on_one_line(p) else np.append(unit(area_normal(p)), -area_normal(p) @ p[0])


@mistake(
    "Your d has the wrong sign: n . p + d = 0 at each point, so d = -n . p. Your plane is on the"
    " other side of the origin."
)
def sign_of_d(p: np.ndarray) -> np.ndarray:
    """Takes n . p for d."""
    return (
        NO_PLANE if on_one_line(p) else np.append(unit(area_normal(p)), unit(area_normal(p)) @ p[0])
    )


@mistake(
    "Your normal is right, and your d is 0: that plane goes through the origin and not through the"
    " points. d = -n . p."
)
def d_forgotten(p: np.ndarray) -> np.ndarray:
    """Lets every plane go through the origin."""
    return NO_PLANE if on_one_line(p) else np.append(unit(area_normal(p)), 0.0)


@mistake(
    "You took the cross product of points. It needs two sides, such as p[1] - p[0] and p[2] - p[0]:"
    " differences do not care where the origin is."
)
def points_for_sides(p: np.ndarray) -> np.ndarray:
    """Multiplies two points instead of two sides."""
    return NO_PLANE if on_one_line(p) else through(unit(np.cross(p[0], p[1])), p[0])


@mistake(
    "Your normal is a direction in the plane. Of the SVD of the centred points the last row, with"
    " the smallest singular value, is at a right angle to them."
)
def side_for_normal(p: np.ndarray) -> np.ndarray:
    """Takes a direction in the plane, the first row of the SVD, for the one at a right angle to it,
    the last.
    """
    return NO_PLANE if on_one_line(p) else through(np.linalg.svd(p - p.mean(0))[2][0], p.mean(0))


@mistake(
    "You solved z = a x + b y + c. A wall has no such equation. Take the cross product of two"
    " sides, which knows no up."
)
def height_over_the_floor(p: np.ndarray) -> np.ndarray:
    """Solves z = a x + b y + c, which no wall satisfies."""
    if on_one_line(p):
        return NO_PLANE
    a, b, c = np.linalg.solve(np.column_stack([p[:, :2], np.ones(3)]), p[:, 2])
    return np.array([-a, -b, 1.0, -c]) / np.linalg.norm([a, b, 1.0])


@mistake(
    "You solved a x + b y + c z = -1, that is d = 1 before normalising. A plane through the origin"
    " has d = 0 and no such equation."
)
def d_set_to_one(p: np.ndarray) -> np.ndarray:
    """Solves a x + b y + c z = -1, which no plane through the origin satisfies."""
    if on_one_line(p):
        return NO_PLANE
    normal = np.linalg.solve(p, -np.ones(3))
    return np.append(normal, 1.0) / np.linalg.norm(normal)


@mistake(
    "Points on one line get a plane that rounding chose. Return four nan where the cross product is"
    " tiny beside the squared longest side."
)
def line_not_seen(p: np.ndarray) -> np.ndarray:
    """Divides by whatever area there is."""
    return through(unit(area_normal(p)), p[0])


@mistake(
    "You compare the cross product with a fixed number, so small triangles are refused, or long"
    " lines let through. Compare it with the squared longest side."
)
def fixed_smallest_area(p: np.ndarray) -> np.ndarray:
    """Compares the cross product with a fixed number."""
    return (
        NO_PLANE if np.linalg.norm(area_normal(p)) < 1e-5 else through(unit(area_normal(p)), p[0])
    )


@mistake(
    "You raise an error where the points are on one line. In RANSAC that happens by chance: return"
    " four nan, and the sample is passed over."
)
def line_refused(p: np.ndarray) -> np.ndarray:
    """Raises where nan is asked for."""
    if on_one_line(p):
        raise ValueError("the points are on one line")
    return through(unit(area_normal(p)), p[0])


@mistake(
    "You return zeros where the points are on one line. With n = 0 and d = 0 all points are at"
    " distance 0: such a plane wins every vote. Return four nan."
)
def line_given_zeros(p: np.ndarray) -> np.ndarray:
    """Returns a plane of zeros where nan is asked for."""
    return np.zeros(4) if on_one_line(p) else through(unit(area_normal(p)), p[0])


@alternative
def plane_by_minors(p: np.ndarray) -> np.ndarray:
    """Takes the areas of the triangle's three shadows, one per axis."""
    q = p - p.mean(axis=0)
    sides = np.array([q[1] - q[0], q[2] - q[0]])
    shadows = [sides[:, axes] for axes in ([1, 2], [2, 0], [0, 1])]
    normal = np.array([s[0, 0] * s[1, 1] - s[0, 1] * s[1, 0] for s in shadows])
    length = np.sqrt(normal @ normal)
    if length <= 1e-9 * max(np.sum((p[i] - p[j]) ** 2) for i, j in ((0, 1), (0, 2), (1, 2))):
        return np.array([np.nan] * 4)
    normal = normal / length
    return np.concatenate([normal, [-(p @ normal).mean()]])


@alternative
def plane_by_svd(p: np.ndarray) -> np.ndarray:
    """Finds the direction in which the centred points do not extend; its largest entry is
    positive.
    """
    centre = p.mean(axis=0)
    _, s, Vt = np.linalg.svd(p - centre)
    if s[1] <= 1e-9 * s[0]:
        return np.full(4, np.nan)
    normal = Vt[2] * np.sign(Vt[2][np.argmax(np.abs(Vt[2]))])
    return np.append(normal, -normal @ centre)


@alternative
def plane_by_hand(p: np.ndarray) -> list[float]:
    """Writes the cross product out, about the last point."""
    (ax, ay, az), (bx, by, bz) = (p[k] - p[2] for k in (0, 1))
    n = [ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx]
    size = max(ax * ax + ay * ay + az * az, bx * bx + by * by + bz * bz)
    length = math.sqrt(sum(c * c for c in n))
    if length <= 1e-9 * size:
        return [math.nan] * 4
    n = [float(c / length) for c in n]
    return [*n, -float(sum(c * x for c, x in zip(n, p[2], strict=True)))]
