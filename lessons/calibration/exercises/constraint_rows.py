"""Write the two equations that a picture of a flat board gives about the camera. The closed form
stacks what you return: see K in the captions of the steps 'view by view'.
"""

import numpy as np
from jaxtyping import Float

from lessons.calibration.exercises import STUDENTS, rows_verdict, views
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
from workbench.geometry.cameras import calibration


@contract(
    slot="constraint_rows",
    examples=(
        ("constraint_rows(np.eye(3))", "[[0, 1, 0, 0, 0, 0], [1, 0, -1, 0, 0, 0]]"),
        (
            "constraint_rows(np.array([[2.0, 1, 0], [0, 3, 0], [1, 0, 1]]))",
            "[[2, 6, 0, 1, 3, 0], [3, -6, -9, 4, 0, 1]]",
        ),
    ),
)
def constraint_rows(H: Float[np.ndarray, "3 3"]) -> Float[np.ndarray, "2 6"]:
    """Return two rows whose products with b = (B11, B12, B22, B13, B23, B33) are 0 for the true
    camera.

    B = K^-T K^-1 is symmetric. With the columns h1 and h2 of the homography, h1^T B h2 = 0 and h1^T
    B h1 = h2^T B h2.

    Args:
        H: Takes (X, Y, 1) on the board, metres, to pixels, up to scale.

    Returns:
        Row 0: coefficients of h1^T B h2. Row 1: those of h1^T B h1 - h2^T B h2. Not scaled; H stays
        as it is.
    """
    return calibration.constraint_rows(H)


HINT = "With v(a, b) · b = aᵀ B b the rows are v(h1, h2) and v(h1, h1) - v(h2, h2); h1 = H[:, 0]."


def found(candidate: Function, H: np.ndarray, label: str = "") -> Verdict:
    """Judge the rows of one homography."""
    return rows_verdict(candidate(H), calibration.constraint_rows(H), HINT, label)


def whole(seed: int) -> np.ndarray:
    """Return a homography of small whole numbers."""
    return np.random.default_rng(seed).integers(-5, 6, (3, 3)).astype(float)


@check(2)
def whole_numbers(candidate: Function) -> Verdict:
    """For matrices of small whole numbers all twelve entries are right."""
    return worst(found(candidate, whole(STUDENTS + k)) for k in range(3))


@check(2)
def rows_of_views(candidate: Function) -> Verdict:
    """For pictures of a board all entries are right: their products with the true b are 0."""
    return worst(found(candidate, scaled(H)) for _, H in views(STUDENTS, 3))


def scaled(H: np.ndarray) -> np.ndarray:
    """Return a homography in coordinates in which the picture is about one wide, of unit size."""
    G = np.diag([1 / 640, 1 / 640, 1.0]) @ H
    return G / np.linalg.norm(G)


@check(1)
def homography_is_left_alone(candidate: Function) -> Verdict:
    """The homography that comes in is not changed."""
    return left_alone(candidate, found(candidate, whole(STUDENTS + 9)))


def _v(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    return np.array(
        [
            a[0] * b[0],
            a[0] * b[1] + a[1] * b[0],
            a[1] * b[1],
            a[0] * b[2] + a[2] * b[0],
            a[1] * b[2] + a[2] * b[1],
            a[2] * b[2],
        ]
    )


@mistake(
    "You took rows of H for columns. r1 and r2 go with its columns: h1 = H[:, 0] and h2 = H[:, 1]."
)
def rows_for_columns(H: np.ndarray) -> np.ndarray:
    """H[0] and H[1]."""
    return calibration.constraint_rows(H.T)


@mistake("Your second row has v(h1, h1) alone. Both columns are equally long: subtract v(h2, h2).")
def no_difference(H: np.ndarray) -> np.ndarray:
    """v12 and v11."""
    return np.stack([_v(H[:, 0], H[:, 1]), _v(H[:, 0], H[:, 0])])


@mistake(
    "Your second row adds v(h1, h1) and v(h2, h2). Equal lengths mean that their difference is 0."
)
def added(H: np.ndarray) -> np.ndarray:
    """v11 + v22."""
    return np.stack([_v(H[:, 0], H[:, 1]), _v(H[:, 0], H[:, 0]) + _v(H[:, 1], H[:, 1])])


@mistake(
    "Your two rows are in the other order: the contract has h1ᵀ B h2 first, and the difference of"
    " lengths second."
)
def swapped(H: np.ndarray) -> np.ndarray:
    """The second row first."""
    return calibration.constraint_rows(H)[::-1].copy()


@mistake("Your second row is v(h2, h2) - v(h1, h1): the contract has it the other way round.")
def other_sign(H: np.ndarray) -> np.ndarray:
    """v22 - v11."""
    return calibration.constraint_rows(H) * np.array([[1.0], [-1.0]])


@mistake(
    "Your mixed products count once. B is symmetric: B12 gets a1 b2 + a2 b1, and so do B13 and B23."
)
def mixed_once(H: np.ndarray) -> np.ndarray:
    """a1 b2 without a2 b1."""

    def v(a: np.ndarray, b: np.ndarray) -> np.ndarray:
        return np.array(
            [a[0] * b[0], a[0] * b[1], a[1] * b[1], a[0] * b[2], a[1] * b[2], a[2] * b[2]]
        )

    h1, h2 = H[:, 0], H[:, 1]
    return np.stack([v(h1, h2), v(h1, h1) - v(h2, h2)])


@mistake(
    "Your entries are ordered along the rows of B: B11, B12, B13, B22, ... The contract has B22"
    " before B13."
)
def row_by_row(H: np.ndarray) -> np.ndarray:
    """B13 before B22."""
    return calibration.constraint_rows(H)[:, [0, 1, 3, 2, 4, 5]]


@mistake(
    "You took columns 2 and 3 of H. The third one is t, of which nothing is known: r1 and r2 are"
    " columns 1 and 2."
)
def columns_one_too_far(H: np.ndarray) -> np.ndarray:
    """h2 and h3."""
    return calibration.constraint_rows(H[:, [1, 2, 0]])


@alternative
def by_outer_products(H: np.ndarray) -> np.ndarray:
    """Symmetric outer products, whose upper triangle counts twice off the diagonal."""
    h1, h2 = H[:, 0], H[:, 1]
    first = np.outer(h1, h2) + np.outer(h2, h1)
    second = 2 * (np.outer(h1, h1) - np.outer(h2, h2))
    i, j = np.array([0, 0, 1, 0, 1, 2]), np.array([0, 1, 1, 2, 2, 2])
    half = np.where(i == j, 0.5, 1.0)
    return np.stack([first[i, j] * half, second[i, j] * half])


@alternative
def by_probing(H: np.ndarray) -> np.ndarray:
    """Puts a one at every entry of B in turn."""
    rows = np.zeros((2, 6))
    for k, (i, j) in enumerate([(0, 0), (0, 1), (1, 1), (0, 2), (1, 2), (2, 2)]):
        B = np.zeros((3, 3))
        B[i, j] = B[j, i] = 1.0
        rows[:, k] = H[:, 0] @ B @ H[:, 1], H[:, 0] @ B @ H[:, 0] - H[:, 1] @ B @ H[:, 1]
    return rows
