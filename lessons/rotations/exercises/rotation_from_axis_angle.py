"""Write Rodrigues' formula: the rotation by an angle about an axis. The lesson turns the
body from one pose to the other by it, and makes one turn of a chain of turns.
"""

from collections.abc import Iterator

import numpy as np
from jaxtyping import Float

from lessons.rotations.exercises import STUDENTS
from workbench.exercise import (
    Function,
    Verdict,
    alternative,
    check,
    contract,
    left_alone,
    mistake,
    rotation_verdict,
    worst,
)
from workbench.geometry.motions import exp_so3, rotations, skew


@contract(
    slot="rotation_from_axis_angle",
    forbid=("scipy.spatial.transform",),
    examples=(
        (
            "rotation_from_axis_angle(np.array([0.0, 0.0, 1.0]), np.pi / 2)",
            "[[0, -1, 0], [1, 0, 0], [0, 0, 1]]",
        ),
        (
            "rotation_from_axis_angle(np.array([2.0, 2.0, 2.0]), 2 * np.pi / 3)",
            "[[0, 0, 1], [1, 0, 0], [0, 1, 0]]",
        ),
    ),
)
def rotation_from_axis_angle(
    axis: Float[np.ndarray, "3"], angle: float
) -> Float[np.ndarray, "3 3"]:
    """Return the rotation matrix R that turns by an angle about an axis through the origin.

    R turns vectors actively, v_turned = R @ v, counter-clockwise where the axis points at you
    (right-hand rule): a quarter turn about z takes x to y.

    Args:
        axis: Direction of the axis. Its length has no meaning and need not be 1; it is not zero.
        angle: Radians; any sign, also more than a turn.

    Returns:
        R, with R^T R = I and determinant 1.

    Raises:
        ValueError: If the axis has length zero: it names no direction.
    """
    return rotations.rotation_from_axis_angle(axis, float(angle))


TURN_HINT = (
    "What lies along the axis stays, what lies across it turns; the length of the axis must not"
    " matter."
)


def some_turns(seed: int, n: int = 6) -> Iterator[tuple[np.ndarray, float]]:
    """Yield axes of lengths from 0.2 to 5 and angles of 20 to 160 degrees of either sign."""
    rng = np.random.default_rng(seed)
    for k in range(n):
        axis = rng.normal(size=3)
        axis *= rng.uniform(0.2, 0.7) ** (-1) ** k / np.linalg.norm(axis)
        yield axis, float(np.radians(rng.uniform(20, 160)) * (-1) ** (k // 2))


@check(2)
def quarter_turn(candidate: Function) -> Verdict:
    """A quarter turn about z takes x to y."""
    right = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    return rotation_verdict(candidate(np.array([0.0, 0.0, 1.0]), np.pi / 2), right, TURN_HINT)


@check(2)
def any_axis(candidate: Function) -> Verdict:
    """About axes in all directions and of all lengths, R turns by the right angle."""
    return worst(
        rotation_verdict(
            candidate(axis, angle), rotations.rotation_from_axis_angle(axis, angle), TURN_HINT
        )
        for axis, angle in some_turns(STUDENTS)
    )


@check(1)
def axis_is_left_alone(candidate: Function) -> Verdict:
    """The axis that comes in is not changed."""
    axis, angle = next(some_turns(STUDENTS + 1))
    right = rotations.rotation_from_axis_angle(axis, angle)
    return left_alone(candidate, rotation_verdict(candidate(axis, angle), right, TURN_HINT))


@mistake(
    "Your R is the transpose of the right one: it turns clockwise. Look along the axis towards you:"
    " a positive angle turns counter-clockwise (right-hand rule)."
)
def clockwise(axis: np.ndarray, angle: float) -> np.ndarray:
    """R^T."""
    return rotations.rotation_from_axis_angle(axis, -angle)


@mistake("You took the angle for degrees. It is in radians: do not convert it.")
def degrees_taken(axis: np.ndarray, angle: float) -> np.ndarray:
    """Converts what is in radians already."""
    return rotations.rotation_from_axis_angle(axis, np.radians(angle))


@mistake(
    "Your formula uses the axis as it comes; it holds for a unit axis only. Divide by its length"
    " first."
)
def axis_not_of_unit_length(axis: np.ndarray, angle: float) -> np.ndarray:
    """Rodrigues' formula with the axis as it comes."""
    W = skew(axis)
    return np.eye(3) + np.sin(angle) * W + (1 - np.cos(angle)) * W @ W


@mistake(
    "You returned I + sin(angle) K. That holds for small angles; the term (1 - cos(angle)) K K is"
    " missing."
)
def square_forgotten(axis: np.ndarray, angle: float) -> np.ndarray:
    """I + sin(angle) K, the formula for small angles."""
    return np.eye(3) + np.sin(angle) * skew(axis / np.linalg.norm(axis))


@mistake(
    "You returned cos(angle) I + sin(angle) K. The part along the axis must stay: add (1 -"
    " cos(angle)) a a^T."
)
def projection_forgotten(axis: np.ndarray, angle: float) -> np.ndarray:
    """cos(angle) I + sin(angle) K, without (1 - cos) a a^T."""
    return np.cos(angle) * np.eye(3) + np.sin(angle) * skew(axis / np.linalg.norm(axis))


@mistake(
    "All is right but the axis of length zero, by which you divide: it names no direction. Raise a"
    " ValueError."
)
def zero_axis_divides(axis: np.ndarray, angle: float) -> np.ndarray:
    """Divides by a length of zero."""
    W = skew(axis / np.linalg.norm(axis))
    return np.eye(3) + np.sin(angle) * W + (1 - np.cos(angle)) * W @ W


@mistake(
    "All is right but the axis of length zero, for which you return the identity. The contract asks"
    " for a ValueError: an answer made up hides the error of whoever calls you."
)
def zero_axis_is_the_identity(axis: np.ndarray, angle: float) -> np.ndarray:
    """Makes an answer up."""
    return exp_so3(axis * (angle / np.linalg.norm(axis))) if np.any(axis) else np.eye(3)


@alternative
def turn_by_quaternion(axis: np.ndarray, angle: float) -> np.ndarray:
    """By way of the unit quaternion (cos, sin a) of half the angle."""
    length = np.sqrt(np.sum(np.square(axis)))
    if length == 0:
        raise ValueError("a zero axis")
    x, y, z = np.sin(angle / 2) * np.asarray(axis) / length
    w = np.cos(angle / 2)
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


@alternative
def turn_column_by_column(axis: np.ndarray, angle: float) -> np.ndarray:
    """Rodrigues' formula for vectors, applied to x, y and z."""
    length = np.linalg.norm(axis)
    if not length > 0:
        raise ValueError("a zero axis")
    n = axis / length
    turned = [
        v * np.cos(angle) + np.cross(n, v) * np.sin(angle) + n * (n @ v) * (1 - np.cos(angle))
        for v in np.eye(3)
    ]
    return np.array(turned).T
