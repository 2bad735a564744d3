"""Write the inverse of a rigid motion. The lesson takes the body back with it at the last step:
with the right inverse it stands on its ghost again, with (R^T, -t) it does not.
"""

import numpy as np
from jaxtyping import Float

from lessons.transforms.exercises import STUDENTS, some_motions
from workbench.exercise import (
    Function,
    Verdict,
    alternative,
    check,
    contract,
    left_alone,
    mistake,
    motion_verdict,
    worst,
)
from workbench.geometry.motions import inverse, motion


@contract(
    slot="invert_rigid",
    examples=(
        (
            "invert_rigid(np.array([[1.0, 0, 0, 2], [0, 1, 0, 0], [0, 0, 1, -3], [0, 0, 0, 1]]))",
            "[[1, 0, 0, -2], [0, 1, 0, 0], [0, 0, 1, 3], [0, 0, 0, 1]]",
        ),
        (
            "invert_rigid(np.array([[0.0, -1, 0, 2], [1, 0, 0, 5], [0, 0, 1, 0], [0, 0, 0, 1]]))",
            "[[0, 1, 0, -5], [-1, 0, 0, 2], [0, 0, 1, 0], [0, 0, 0, 1]]",
        ),
    ),
)
def invert_rigid(T_a_b: Float[np.ndarray, "4 4"]) -> Float[np.ndarray, "4 4"]:
    """Return the motion T_b_a that takes points back from frame a to frame b.

    With T_a_b = (R, t) a point goes p_a = R p_b + t, metres. The inverse undoes that for every
    point.

    Args:
        T_a_b: A rigid motion: rotation R in the upper left 3x3, translation t (metres) in the last
            column, and (0, 0, 0, 1) as last row. It may be the identity. Nobody gives you a motion
            that scales or shears.

    Returns:
        T_b_a, again a rigid motion, in a new array: the input stays as it is.
    """
    return inverse(T_a_b)


def some_points(seed: int, n: int = 50, size: float = 1.0) -> np.ndarray:
    """Return points in a cube of this half edge, metres."""
    return np.random.default_rng(seed).uniform(-size, size, (n, 3))


INVERT_HINT = "Solve p_a = R p_b + t for p_b."


@check(3)
def there_and_back(candidate: Function) -> Verdict:
    """A point that goes from b to a and back is where it was."""
    return worst(
        motion_verdict(
            candidate(T) @ T,
            np.eye(4),
            INVERT_HINT,
            p=some_points(STUDENTS),
            name="(T_b_a @ T_a_b)",
        )
        for T in some_motions(STUDENTS)
    )


@check(1)
def twice_is_nothing(candidate: Function) -> Verdict:
    """The inverse of the inverse is the motion itself."""
    return worst(
        motion_verdict(candidate(candidate(T)), T, INVERT_HINT) for T in some_motions(STUDENTS + 1)
    )


@check(1)
def motion_is_left_alone(candidate: Function) -> Verdict:
    """The motion that comes in is not changed."""
    T = next(some_motions(STUDENTS + 2))
    return left_alone(candidate, motion_verdict(candidate(T), inverse(T), INVERT_HINT))


@mistake(
    "You returned (R^T, -t). The translation is undone in frame a, but R^T turns it first: it must"
    " be -R^T t."
)
def negated_translation(T_a_b: np.ndarray) -> np.ndarray:
    """(R^T, -t)."""
    return motion(T_a_b[:3, :3].T, -T_a_b[:3, 3])


@mistake(
    "You returned (R, -t): the translation is negated, but the rotation still turns from b to a."
    " Its inverse is R^T."
)
def rotation_kept(T_a_b: np.ndarray) -> np.ndarray:
    """(R, -t)."""
    return motion(T_a_b[:3, :3], -T_a_b[:3, 3])


@mistake(
    "Your rotation is R^T, but your translation is -R t. The inverse has -R^T t: solve p_a = R p_b"
    " + t for p_b."
)
def translation_turned_forwards(T_a_b: np.ndarray) -> np.ndarray:
    """(R^T, -R t)."""
    return motion(T_a_b[:3, :3].T, -T_a_b[:3, :3] @ T_a_b[:3, 3])


@mistake(
    "Your translation is R^T t; it has the wrong sign. Solve p_a = R p_b + t for p_b: p_b = R^T p_a"
    " - R^T t."
)
def sign_forgotten(T_a_b: np.ndarray) -> np.ndarray:
    """(R^T, R^T t)."""
    return motion(T_a_b[:3, :3].T, T_a_b[:3, :3].T @ T_a_b[:3, 3])


@mistake(
    "You transposed the whole 4×4, so that t lies in the last row. Only its 3×3 rotation is"
    " orthogonal."
)
def all_transposed(T_a_b: np.ndarray) -> np.ndarray:
    """The transpose of the 4x4."""
    return T_a_b.T.copy()


@alternative
def invert_by_elimination(T_a_b: np.ndarray) -> np.ndarray:
    """Any inverse of the 4x4 will do."""
    return np.linalg.inv(T_a_b)


@alternative
def invert_by_parts(T_a_b: np.ndarray) -> np.ndarray:
    """The motion to the origin first, then the turn back."""
    back, turn = np.eye(4), np.eye(4)
    back[:3, 3] = -T_a_b[:3, 3]
    turn[:3, :3] = T_a_b[:3, :3].T
    return turn @ back
