"""Give axes their signs, so that a frame turns with its cloud. The lesson lays one scan's frame on
the other's by your function: with a sign that hangs on the coordinates the scan lands half a turn
away.
"""

import numpy as np
from jaxtyping import Float

from lessons.axes.exercises import STUDENTS
from workbench.data.lopsided import a_lopsided_cloud, a_rotation
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
    worst,
)
from workbench.geometry.motions import principal_axes as geometry


@contract(
    slot="canonical_signs",
    examples=(
        (
            "canonical_signs(np.eye(3), np.array([[0.0, 0, 0], [0, 0, 0], [-3, 3, 1]]))",
            "[[-1, 0, 0], [0, 1, 0], [0, 0, -1]]",
        ),
        (
            "canonical_signs(-np.eye(3), np.array([[9.0, 8, 5], [9, 8, 6], [12, 11, 7]]))",
            "[[1, 0, 0], [0, 1, 0], [0, 0, 1]]",
        ),
    ),
)
def canonical_signs(
    axes: Float[np.ndarray, "3 3"], p: Float[np.ndarray, "n 3"]
) -> Float[np.ndarray, "3 3"]:
    """Return the axes of a cloud with signs that the cloud decides.

    Axes 1 and 2 point to where the third moment about the centroid, the sum of (axis . (p -
    centroid))^3, is positive; where it is 0 they stay as they are. Axis 3 is the cross product of
    these two.

    Args:
        axes: Three perpendicular unit vectors in columns, each of any sign; the frame may be
            left-handed.
        p: The cloud whose axes they are, metres; anywhere.

    Returns:
        Axes 1 and 2, each as it was or turned round, and their cross product, in columns.
    """
    return geometry.canonical_signs(axes, p)


SIGNS_HINT = (
    "Sign of the mean of ((p - centroid) @ axis)**3 for axes 1 and 2; the third is np.cross of the"
    " two."
)


def signs_verdict(
    got: np.ndarray, axes: np.ndarray, p: np.ndarray, hint: str = SIGNS_HINT
) -> Verdict:
    """Judge axes by their signs."""
    right = geometry.canonical_signs(axes, p)
    for k in range(3):
        off = float(np.abs(np.abs(got[:, k] @ right[:, k]) - 1.0))
        longer = float(np.abs(np.linalg.norm(got[:, k]) - 1.0))
        x, y, z = right[:, k]
        if max(off, longer) > 1e-5:
            entries = ", ".join(f"{value:.3g}" for value in got[:, k])
            return fail(
                f"Axis {k + 1} is ({entries}), right is ({x:.3f}, {y:.3f}, {z:.3f}). {hint}"
            )
    turned = [k + 1 for k in range(3) if got[:, k] @ right[:, k] < 0]
    if not turned:
        return full("All three axes point where they should.")
    moments = ", ".join(
        f"{value:.2g}" for value in geometry.third_moments(axes, p) / np.std(p) ** 3
    )
    evidence = f"The third moments of what came in are {moments} (over the cube of the spread)"
    names = " and ".join(map(str, turned))
    return fail(
        f"Of the three axes {len(turned)} are turned round (axis {names}), right is 0. {evidence}."
        f" {hint}"
    )


def of_any_signs(rng: np.random.Generator, p: np.ndarray) -> np.ndarray:
    """Return the axes of a cloud, each with a sign by chance."""
    return geometry.principal_axes(p) * rng.choice([-1.0, 1.0], 3)


def several(candidate: Function, seed: int, count: int, *, mirrored: bool) -> Verdict:
    """Judge some clouds, turned each in its own way."""
    verdicts = []
    for k in range(count):
        rng = np.random.default_rng(seed + k)
        p = a_lopsided_cloud(rng, mirrored=mirrored)
        axes = of_any_signs(rng, p)
        verdicts.append(signs_verdict(candidate(axes, p), axes, p))
    return worst(verdicts)


@check(2)
def some_clouds(candidate: Function) -> Verdict:
    """Four clouds with long tails get the signs of their tails."""
    return several(candidate, STUDENTS, 4, mirrored=False)


@check(1)
def the_frame_turns_with_the_cloud(candidate: Function) -> Verdict:
    """A cloud that is turned has its frame turned with it."""
    rng = np.random.default_rng(STUDENTS + 10)
    p = a_lopsided_cloud(rng)
    verdicts = []
    for _ in range(4):
        p = p @ a_rotation(rng).T
        axes = of_any_signs(rng, p)
        verdicts.append(
            signs_verdict(candidate(axes, p), axes, p, f"The cloud was turned. {SIGNS_HINT}")
        )
    return worst(verdicts)


@check(1)
def inputs_are_left_alone(candidate: Function) -> Verdict:
    """The axes and points that come in are not changed."""
    rng = np.random.default_rng(STUDENTS + 20)
    p = a_lopsided_cloud(rng)
    axes = of_any_signs(rng, p)
    return left_alone(candidate, signs_verdict(candidate(axes, p), axes, p))


@mistake(
    "You make the largest entry of each axis positive. That looks at coordinates, not at the cloud:"
    " turn the cloud, and the signs change. Use third moments."
)
def largest_entry(axes: np.ndarray, p: np.ndarray) -> np.ndarray:
    """The rule of svd_flip."""
    return geometry.largest_entry_signs(axes)


@mistake(
    "Your third moments are about the origin. Subtract the centroid first, or they tell where the"
    " cloud is."
)
def about_the_origin(axes: np.ndarray, p: np.ndarray) -> np.ndarray:
    """Does not centre."""
    return geometry.right_handed(axes * np.where(((p @ axes) ** 3).sum(axis=0) < 0, -1.0, 1.0))


@mistake(
    "Axis 3 has a sign by its own third moment here, so that some frames are left-handed. Two axes"
    " decide; the third is their cross product."
)
def each_by_its_own_moment(axes: np.ndarray, p: np.ndarray) -> np.ndarray:
    """Turns all three by their moments."""
    return axes * np.where(geometry.third_moments(axes, p) < 0, -1.0, 1.0)


@mistake(
    "Axes 1 and 2 are right, and axis 3 stays as it came in. Take the cross product of axes 1"
    " and 2."
)
def third_axis_kept(axes: np.ndarray, p: np.ndarray) -> np.ndarray:
    """Leaves the third axis alone."""
    signs = np.where(geometry.third_moments(axes, p) < 0, -1.0, 1.0)
    signs[2] = 1.0
    return axes * signs


@mistake(
    "Your axes point away from the long tails: their third moments are negative. Turn axes 1 and 2"
    " round."
)
def to_the_negative_side(axes: np.ndarray, p: np.ndarray) -> np.ndarray:
    """Makes the moments negative."""
    return geometry.right_handed(axes * np.where(geometry.third_moments(axes, p) < 0, 1.0, -1.0))


@mistake(
    "You point each axis to where more points lie. The long tail, where the third moment is"
    " positive, is often on the other side: sum the cubes."
)
def to_more_points(axes: np.ndarray, p: np.ndarray) -> np.ndarray:
    """Counts points on either side of the centroid."""
    along = (p - p.mean(axis=0)) @ axes
    return geometry.right_handed(
        axes * np.where((along > 0).sum(axis=0) < (along < 0).sum(axis=0), -1.0, 1.0)
    )


@mistake("You took the rows of `axes` for its axes. Axis k is column k: axes[:, k].")
def rows_for_columns(axes: np.ndarray, p: np.ndarray) -> np.ndarray:
    """Works on the transpose."""
    return geometry.canonical_signs(axes.T, p).T


@alternative
def signs_one_by_one(axes: np.ndarray, p: np.ndarray) -> np.ndarray:
    """A loop over the two axes."""
    centre = np.mean(p, axis=0)
    signed = []
    for k in range(2):
        total = sum(float(np.dot(point - centre, axes[:, k])) ** 3 for point in p)
        signed.append(-axes[:, k] if total < 0 else axes[:, k])
    return np.array([signed[0], signed[1], np.cross(signed[0], signed[1])]).T


@alternative
def signs_by_determinant(axes: np.ndarray, p: np.ndarray) -> np.ndarray:
    """Turns axis 3 round where the determinant is -1."""
    q = (p - p.mean(0)) @ axes
    result = axes * np.where(np.einsum("ij,ij,ij->j", q, q, q) < 0, -1, 1)
    result[:, 2] *= np.sign(np.linalg.det(result))
    return result
