"""Write the frame of a cloud: its principal axes. The lesson lays the frames of two scans on each
other by your function; which end of an axis is its tip is left to you here, and to the next
exercise.
"""

import numpy as np
from jaxtyping import Float

from lessons.axes.exercises import STUDENTS
from workbench.data.lopsided import a_rotation
from workbench.exercise import (
    Function,
    Verdict,
    alternative,
    band,
    check,
    contract,
    fail,
    left_alone,
    mistake,
    worst,
)
from workbench.geometry.motions import principal_axes as geometry

SKEWED = 1e-5  # how far V^T V may be from the identity: rounding, also of single precision
TURNED = ([-1.0, -1.0, 1.0], [-1.0, 1.0, -1.0], [1.0, -1.0, -1.0])


def other_signs(axes: np.ndarray) -> list[np.ndarray]:
    """Return the axes with two of three columns turned round: as right, and of the same
    handedness.
    """
    return [np.asarray(axes) * signs for signs in TURNED]


@contract(
    slot="principal_axes",
    either=other_signs,
    examples=(
        (
            (
                "principal_axes(np.array([[5.0, 1, 0], [5, -1, 0], [6, 0, 0], [4, 0, 0], [5, 4, 0],"
                " [5, -4, 0]]))"
            ),
            "[[0, 1, 0], [1, 0, 0], [0, 0, -1]]",
        ),
        (
            (
                "principal_axes(np.array([[0.0, 0, 3], [0, 0, -3], [2, 0, 0], [-2, 0, 0], [0, 1,"
                " 0], [0, -1, 0]]))"
            ),
            "[[0, 1, 0], [0, 0, 1], [1, 0, 0]]",
        ),
    ),
)
def principal_axes(p: Float[np.ndarray, "n 3"]) -> Float[np.ndarray, "3 3"]:
    """Return the directions of largest, middle and least variance of a cloud, about its centroid.

    Args:
        p: Points, metres; anywhere, also a thousand kilometres from the origin.

    Returns:
        A rotation: column k is the unit vector of axis k, the largest variance first, and the
        determinant is +1. Two columns may be turned round together: an axis has no sign. Where the
        cloud leaves directions open (points on one line, a single point), any that fit will do.

    Raises:
        ValueError: If there is no point (n = 0).
    """
    return geometry.largest_entry_signs(geometry.principal_axes(p))


AXES_HINT = (
    "Centre the points, take the eigenvectors of their covariance, and look at their order and"
    " determinant."
)


def axes_verdict(axes: np.ndarray, p: np.ndarray, hint: str = AXES_HINT, first: int = 3) -> Verdict:
    """Judge axes by their angles to the eigenvectors, whatever the signs; what is no rotation earns
    nothing.

    Args:
        axes: The answer.
        p: The cloud.
        hint: What to look at where it is wrong.
        first: How many of the axes the cloud decides.
    """
    off = float(np.abs(axes.T @ axes - np.eye(3)).max())
    det = float(np.linalg.det(axes))
    if off > SKEWED:
        return fail(
            f"The columns are no frame: V^T V is off by {off:.2g}, right is the identity, up to"
            f" {SKEWED:.5f}. {hint}"
        )
    if det < 0:
        return fail(f"The determinant is {det:.3g}, right is 1: the frame is left-handed. {hint}")
    centred = p - p.mean(axis=0)
    right = np.linalg.svd(centred, full_matrices=len(p) < 3)[2].T
    degrees = geometry.degrees_between_axes(axes, right)[:first]
    worst_axis = int(degrees.argmax())
    if geometry.degrees_between_axes(axes.T, right).max() < 0.1 < degrees[worst_axis]:
        hint = "Your rows are the axes: transpose the matrix."
    x, y, z = right[:, worst_axis]
    correction = f"right is ({x:.3f}, {y:.3f}, {z:.3f}), or the opposite. {hint}"
    return band(
        f"Axis {worst_axis + 1} is off by",
        float(degrees.max()),
        "degrees",
        good=0.1,
        fair=2.0,
        hint=correction,
    )


def a_cloud(rng: np.random.Generator, n: int = 80) -> np.ndarray:
    """Return points of a lump half a metre in size, turned, aside from the origin."""
    return rng.normal(size=(n, 3)) * [0.5, 0.3, 0.15] @ a_rotation(rng).T + [0.9, -1.2, 0.7]


@check(2)
def a_lump_aside(candidate: Function) -> Verdict:
    """The axes of a lump aside from the origin are found, in their order."""
    p = a_cloud(np.random.default_rng(STUDENTS))
    return axes_verdict(candidate(p), p)


@check(1)
def right_handed(candidate: Function) -> Verdict:
    """Six clouds get right-handed frames."""
    clouds = [a_cloud(np.random.default_rng(STUDENTS + k)) for k in range(1, 7)]
    return worst(axes_verdict(candidate(p), p) for p in clouds)


@check(1)
def points_are_left_alone(candidate: Function) -> Verdict:
    """The points that come in are not changed."""
    p = a_cloud(np.random.default_rng(STUDENTS + 8))
    return left_alone(candidate, axes_verdict(candidate(p), p))


def covariance(p: np.ndarray) -> np.ndarray:
    """Return the covariance of points; they must be some."""
    if len(p) == 0:
        raise ValueError("no points")
    centred = p - p.mean(axis=0)
    return centred.T @ centred / len(p)


@mistake(
    "Your axes go from the least variance to the largest: eigh sorts that way. Reverse the columns."
)
def ascending(p: np.ndarray) -> np.ndarray:
    """Leaves the order of eigh."""
    return geometry.largest_entry_signs(np.linalg.eigh(covariance(p))[1])


@mistake(
    "You did not subtract the centroid, so that your first axis points at the cloud from the"
    " origin."
)
def not_centred(p: np.ndarray) -> np.ndarray:
    """Takes the moments about the origin."""
    if len(p) == 0:
        raise ValueError("no points")
    return geometry.largest_entry_signs(geometry.ordered(*np.linalg.eigh(p.T @ p / len(p)))[1])


@mistake("Your axes stand in the rows. Column k is axis k: transpose the matrix.")
def rows_for_columns(p: np.ndarray) -> np.ndarray:
    """Returns the transpose."""
    return principal_axes(p).T


@mistake(
    "Your axes are right but where their determinant is −1: turn one column round there, to be"
    " right-handed."
)
def left_handed(p: np.ndarray) -> np.ndarray:
    """Leaves the handedness as eigh gives it."""
    return np.linalg.eigh(covariance(p))[1][:, ::-1]


@mistake(
    "You divided each coordinate by its standard deviation first (a correlation matrix)."
    " Coordinates are all in metres: their spread is what the axes are about."
)
def standardised(p: np.ndarray) -> np.ndarray:
    """Takes the correlation instead of the covariance."""
    C = covariance(p)
    spread = np.sqrt(np.maximum(np.diag(C), 1e-300))
    return geometry.largest_entry_signs(
        geometry.ordered(*np.linalg.eigh(C / np.outer(spread, spread)))[1]
    )


@mistake(
    "You subtract the product of the means from the mean of the products. Far from the origin all"
    " digits cancel: subtract the centroid from the points first."
)
def moments_cancel(p: np.ndarray) -> np.ndarray:
    """Uses E[x x^T] - E[x] E[x]^T."""
    if len(p) == 0:
        raise ValueError("no points")
    mean = p.mean(axis=0)
    return geometry.largest_entry_signs(
        geometry.ordered(*np.linalg.eigh(p.T @ p / len(p) - np.outer(mean, mean)))[1]
    )


@alternative
def axes_by_svd(p: np.ndarray) -> np.ndarray:
    """The right singular vectors of the centred points, which come in falling order."""
    if len(p) == 0:
        raise ValueError("a cloud without points has no axes")
    V = np.linalg.svd(p - np.mean(p, axis=0), full_matrices=len(p) < 3)[2].T
    V = V * np.sign(V[np.abs(V).argmax(axis=0), range(3)])
    V[:, 2] *= np.sign(np.linalg.det(V))
    return V


@alternative
def axes_by_power_iteration(p: np.ndarray) -> np.ndarray:
    """Power iteration for the first axis, squaring the matrix each time, and for the next one
    without it.
    """
    C = covariance(p)
    axes = []
    for k in range(2):
        A = C / (np.trace(C) or 1.0)
        for _ in range(60):
            A = A @ A / (np.linalg.norm(A @ A) or 1.0)
        column = A[:, np.linalg.norm(A, axis=0).argmax()]
        length = np.linalg.norm(column)
        axis = (
            column / length
            if length > 0.5
            else np.eye(3)[np.abs(axes).sum(axis=0).argmin() if k else 0]
        )
        axis = axis - sum((axis @ other) * other for other in axes) if axes else axis
        axis = axis / np.linalg.norm(axis)
        axes.append(axis * np.sign(axis[np.abs(axis).argmax()]))
        C = C - axis @ C @ axis * np.outer(axis, axis)
    return np.column_stack([*axes, np.cross(*axes)])
