"""Write the vote: how many points are within the inlier distance of a plane. With the score 'count'
your number decides which sample is the best so far, and its share of all points how many samples
are still needed. It is used where the model is a plane, as in the default run.
"""

import numpy as np
from jaxtyping import Float

from lessons.ransac.exercises import STUDENTS
from workbench.algorithms.robust import scores
from workbench.exercise import (
    Function,
    Verdict,
    alternative,
    check,
    contract,
    fail,
    full,
    left_alone,
    mistake,
    partial,
    worst,
)
from workbench.geometry.motions import exp_so3


@contract(
    slot="count_inliers",
    examples=(
        (
            (
                "count_inliers(np.array([0.0, 0, 1, -2]), np.array([[5.0, 1, 2.1], [0, 0, 1.9], [0,"
                " 0, 0]]), 0.2)"
            ),
            "2",
        ),
        (
            "count_inliers(np.array([0.6, 0, 0.8, 0]), np.array([[1.0, 0, 0], [0, 9, 0.5]]), 0.5)",
            "1",
        ),
    ),
)
def count_inliers(
    plane: Float[np.ndarray, "4"], p: Float[np.ndarray, "n 3"], inlier_distance: float
) -> int:
    """Return how many points are near a plane, on both its sides.

    Args:
        plane: (a, b, c, d) with a unit normal n = (a, b, c), d in metres: n . p + d is a point's
            signed distance.
        p: The points, one per row, metres; there may be none (n = 0).
        inlier_distance: How far from the plane an inlier may be, metres, measured at a right angle
            to it. A point exactly this far is an inlier.

    Returns:
        A whole number from 0 to n (an int). A point with a nan is near nothing, and nothing is near
        a plane of four nan, which stands for a degenerate sample: these count 0.
    """
    return scores.count_inliers(plane, p, inlier_distance)


COUNT_HINT = "An inlier has |n . p + d| <= inlier_distance."


def a_layer(rng: np.random.Generator, n: int = 240) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return a plane, points around it, and their signed distances by which they were made."""
    R = exp_so3(rng.normal(size=3))
    foot = rng.uniform(-1.0, 1.0, 3)
    signed = rng.uniform(-0.4, 0.6, n)
    p = foot + np.column_stack([rng.uniform(-1.5, 1.5, (n, 2)), signed]) @ R.T
    return np.append(R[:, 2], -R[:, 2] @ foot), p, signed


def count_verdict(got: int, right: int, n: int, case: str, hint: str = COUNT_HINT) -> Verdict:
    """Judge a count: all for the exact one, half where at most one point in a hundred is too many
    or too few.
    """
    if got == right:
        return full(f"{case}: {got} of {n} points are inliers.")
    message = f"{case}: yours is {got} of {n} points, right is {right}. {hint}"
    return partial(0.5, message) if abs(got - right) <= 0.01 * n else fail(message)


@check(2)
def above_and_below_a_table(candidate: Function) -> Verdict:
    """Around a table 0.75 m up, points above and below it are counted at 1, 5 and 30 cm."""
    heights = np.array([-0.75, -0.4, -0.2, -0.04, -0.004, 0.0, 0.007, 0.03, 0.045, 0.25, 0.5, 0.9])
    p = np.column_stack([np.linspace(-1.0, 1.0, 12), np.cos(np.arange(12.0)), 0.75 + heights])
    plane = np.array([0.0, 0.0, 1.0, -0.75])
    return worst(
        count_verdict(candidate(plane, p, t), right, 12, f"Within {t:g} m")
        for t, right in ((0.01, 3), (0.05, 6), (0.3, 8))
    )


@check(2)
def slanted_planes(candidate: Function) -> Verdict:
    """Around slanted planes the points within 2 and 10 cm, at right angles, are counted."""
    rng = np.random.default_rng(STUDENTS + 20)
    verdicts = []
    for _ in range(2):
        plane, p, signed = a_layer(rng)
        for t in (0.02, 0.1):
            right = int((np.abs(signed) <= t).sum())
            verdicts.append(
                count_verdict(
                    candidate(plane, p, t), right, len(p), f"Within {t:g} m of a slanted plane"
                )
            )
    return worst(verdicts)


@check(1)
def cloud_is_left_alone(candidate: Function) -> Verdict:
    """The plane and the points that come in are not changed."""
    plane, p, signed = a_layer(np.random.default_rng(STUDENTS + 30), 50)
    right = int((np.abs(signed) <= 0.12).sum())
    return left_alone(
        candidate, count_verdict(candidate(plane, p, 0.12), right, 50, "Within 0.12 m")
    )


def signed(plane: np.ndarray, p: np.ndarray) -> np.ndarray:
    """Return the signed distances."""
    return p @ plane[:3] + plane[3]


@mistake(
    "You compare the signed distance: every point on the far side of the normal is negative and"
    " counts, however far it is. Take its absolute value."
)
def below_counts(plane: np.ndarray, p: np.ndarray, inlier_distance: float) -> int:
    """Compares the signed distance."""
    return int((signed(plane, p) <= inlier_distance).sum())


@mistake(
    "You count the side of the normal only. The signed distance of a point just below the plane is"
    " negative: take its absolute value."
)
def above_only(plane: np.ndarray, p: np.ndarray, inlier_distance: float) -> int:
    """Leaves out the side from which the normal points away."""
    s = signed(plane, p)
    return int(((s >= 0) & (s <= inlier_distance)).sum())


@mistake(
    "You compare squared distances with the inlier distance: square metres with metres. Square both"
    " or neither."
)
def distance_squared(plane: np.ndarray, p: np.ndarray, inlier_distance: float) -> int:
    """Compares squared metres with metres."""
    return int((signed(plane, p) ** 2 <= inlier_distance).sum())


@mistake(
    "You square the inlier distance but not the distances: metres against square metres. Square"
    " both or neither."
)
def limit_squared(plane: np.ndarray, p: np.ndarray, inlier_distance: float) -> int:
    """Compares metres with squared metres."""
    return int((np.abs(signed(plane, p)) <= inlier_distance**2).sum())


@mistake(
    "You halve the inlier distance. It is how far a point may be on either side: the layer is twice"
    " as thick."
)
def limit_halved(plane: np.ndarray, p: np.ndarray, inlier_distance: float) -> int:
    """Takes the distance for the thickness of the layer."""
    return int((np.abs(signed(plane, p)) <= inlier_distance / 2).sum())


@mistake(
    "You left d out, so you count points near the parallel plane through the origin. The signed"
    " distance is n . p + d."
)
def offset_forgotten(plane: np.ndarray, p: np.ndarray, inlier_distance: float) -> int:
    """Lets the plane go through the origin."""
    return int((np.abs(p @ plane[:3]) <= inlier_distance).sum())


@mistake(
    "You subtract d: that is the plane on the other side of the origin. The signed distance is n ."
    " p + d."
)
def offset_subtracted(plane: np.ndarray, p: np.ndarray, inlier_distance: float) -> int:
    """Takes d for the plane's distance along the normal."""
    return int((np.abs(p @ plane[:3] - plane[3]) <= inlier_distance).sum())


@mistake("You count the points that are farther than the inlier distance.")
def outliers_counted(plane: np.ndarray, p: np.ndarray, inlier_distance: float) -> int:
    """Counts the others."""
    return int((np.abs(signed(plane, p)) > inlier_distance).sum())


@mistake(
    "All is right but for points exactly on the limit: an inlier may be as far as the inlier"
    " distance, so <= and not <."
)
def limit_left_out(plane: np.ndarray, p: np.ndarray, inlier_distance: float) -> int:
    """Compares with <."""
    return int((np.abs(signed(plane, p)) < inlier_distance).sum())


@mistake(
    "You measure straight up and down. The distance to a slanted plane is shorter, at a right angle"
    " to it: |n . p + d|."
)
def along_the_height(plane: np.ndarray, p: np.ndarray, inlier_distance: float) -> int:
    """Measures straight up and down."""
    return int((np.abs(signed(plane, p) / plane[2]) <= inlier_distance).sum())


@mistake(
    "You measure to one point of the plane, the one nearest to the origin. Only what is along the"
    " normal counts: |n . p + d|."
)
def to_the_foot(plane: np.ndarray, p: np.ndarray, inlier_distance: float) -> int:
    """Measures to the plane's point nearest to the origin."""
    return int((np.linalg.norm(p + plane[3] * plane[:3], axis=1) <= inlier_distance).sum())


@mistake(
    "You divide by the length of (a, b, c, d). The length that matters is that of the normal (a, b,"
    " c), and it is 1."
)
def divided_by_all_four(plane: np.ndarray, p: np.ndarray, inlier_distance: float) -> int:
    """Divides by the length of (a, b, c, d)."""
    return int((np.abs(signed(plane, p)) / np.linalg.norm(plane) <= inlier_distance).sum())


@mistake(
    "All is right but nan, which you count as near. A comparison with nan is always false: count"
    " where <= is true, do not subtract the far points from all, and do not put a number in the"
    " place of nan."
)
def nan_is_near(plane: np.ndarray, p: np.ndarray, inlier_distance: float) -> int:
    """Counts whatever is not far, nan as well."""
    return len(p) - int((np.abs(signed(plane, p)) > inlier_distance).sum())


@mistake("You return the share of inliers. Return how many there are: a whole number.")
def share_returned(plane: np.ndarray, p: np.ndarray, inlier_distance: float) -> float:
    """Returns the share of inliers."""
    return float((np.abs(signed(plane, p)) <= inlier_distance).sum() / max(len(p), 1))


@mistake(
    "You return which points are inliers, one true or false each. Return how many there are: a"
    " whole number."
)
def mask_returned(plane: np.ndarray, p: np.ndarray, inlier_distance: float) -> np.ndarray:
    """Returns which points are inliers."""
    return np.abs(signed(plane, p)) <= inlier_distance


@alternative
def count_one_by_one(plane: np.ndarray, p: np.ndarray, inlier_distance: float) -> int:
    """Loops over the points."""
    a, b, c, d = plane
    near = 0
    for x, y, z in p:
        if abs(a * x + b * y + c * z + d) <= inlier_distance:
            near += 1
    return near


@alternative
def count_in_homogeneous_coordinates(
    plane: np.ndarray, p: np.ndarray, inlier_distance: float
) -> int:
    """Appends ones, squares both sides, and divides by the normal's length though it is 1."""
    p_h = np.column_stack([p, np.ones(len(p))])
    squares = (p_h @ plane) ** 2 / (plane[:3] @ plane[:3])
    return int(np.count_nonzero(squares <= inlier_distance**2))
