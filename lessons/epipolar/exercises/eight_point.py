"""Write the normalised eight-point algorithm: from matches to the fundamental matrix. All lines of
the lesson and the motion after them are made of it.
"""

import numpy as np
from jaxtyping import Float

from lessons.epipolar.exercises import STUDENTS, Pair, a_pair, homogeneous
from workbench.exercise import (
    Function,
    Verdict,
    alternative,
    band,
    beside,
    check,
    contract,
    fail,
    full,
    left_alone,
    mistake,
    worst,
)
from workbench.exercise.model import number
from workbench.geometry.two_views import epipolar


@contract(
    slot="eight_point",
    examples=(
        (
            (
                "eight_point(np.cos(np.c_[0:9] ** [1, 2]),"
                " np.cos(np.c_[0:9] ** [1, 2]) + [[k, 0] for k in range(9)])[1] ** 2"
            ),
            "[0, 0, 0.5]",
        ),
        (
            (
                "eight_point(np.cos(np.c_[0:9] ** [1, 2]), np.cos(np.c_[0:9] ** [1, 2]) * [[k] for"
                " k in range(9)])[2]"
            ),
            "[0, 0, 0]",
        ),
    ),
    either=lambda F: -np.asarray(F),
)
def eight_point(
    uv_first: Float[np.ndarray, "n 2"], uv_second: Float[np.ndarray, "n 2"]
) -> Float[np.ndarray, "3 3"]:
    """Return the fundamental matrix F of matches, (u', v', 1) F (u, v, 1)^T = 0, of rank two.

    The normalised eight-point algorithm: shift and scale the pixels of each picture to mean 0 and a
    mean distance of about the square root of 2, take the unit vector that makes the sum of squares
    of all equations smallest, drop the smallest singular value there, and go back to pixels.

    Args:
        uv_first: Pixels (column, row) of the first picture.
        uv_second: Their matches in the second, row k for row k.

    Returns:
        F at any scale that keeps its numbers within 1e9; the examples have Frobenius norm one. F33
        may be 0: do not divide by it.

    Raises:
        ValueError: If there are fewer than eight matches.
    """
    return epipolar.fit_fundamental(uv_first, uv_second)


HINT = (
    "Normalise both pictures, solve, drop the smallest singular value, and only then F = T'^T F T."
)


def judged(candidate: Function, pair: Pair, good: float, fair: float) -> Verdict:
    """Judge F by how far points without noise are from their lines in both pictures, and tell of
    the farthest.
    """
    F = candidate(pair.uv_first, pair.uv_second)
    x = homogeneous(pair.clean_first)
    y = homogeneous(pair.clean_second)
    offs, feet = [], []
    with np.errstate(all="ignore"):
        for lines, p in ((y @ F, x), (x @ F.T, y)):
            n = lines[:, :2] / np.linalg.norm(lines[:, :2], axis=1, keepdims=True)
            offs.append((lines * p).sum(axis=1) / np.linalg.norm(lines[:, :2], axis=1))
            feet.append(p[:, :2] - offs[-1][:, None] * n)
        off = float(np.sqrt(np.square(offs).mean()))
    if not np.isfinite(off):
        return fail(
            f"F has no lines: it is {number(F[0])} in its first row, right is a matrix of finite"
            f" numbers. {HINT}"
        )
    k = int(np.abs(offs[1]).argmax())
    told = beside(
        feet[1][k],
        pair.clean_second[k],
        HINT,
        f"The place on the line of {number(x[k, :2])} nearest to its partner",
    )
    return band(
        "Points without noise are from their lines",
        off,
        "px (rms)",
        good=good,
        fair=fair,
        hint=told,
    )


def ranked(candidate: Function, pair: Pair) -> Verdict:
    """Judge whether F has rank two."""
    F = candidate(pair.uv_first, pair.uv_second)
    values = np.linalg.svd(F)[1] if np.isfinite(F).all() else np.ones(3)
    share = float(values[2] / (values[1] or 1.0))
    if share < 1e-7:
        return full("The third singular value of F is 0.")
    told = beside(np.array([values[2]]), np.zeros(1), HINT, "The third singular value of F")
    return fail(
        f"F has rank three: its third singular value is {number(1e6 * share, 3)} millionths of the"
        f" second. {told}"
    )


@check(2)
def exact_matches(candidate: Function) -> Verdict:
    """Matches without noise lie on the lines of F, in both pictures."""
    return worst(judged(candidate, a_pair(STUDENTS + k, 20, 0.0), 1e-3, 0.1) for k in range(2))


@check(3)
def noisy_matches(candidate: Function) -> Verdict:
    """With a pixel of noise on 60 matches, other points are less than a pixel from their lines."""
    return worst(judged(candidate, a_pair(STUDENTS + k), 0.9, 1.8) for k in (2, 4, 5))


@check(2)
def has_rank_two(candidate: Function) -> Verdict:
    """F has rank two, so that all its lines meet."""
    return ranked(candidate, a_pair(STUDENTS + 4, 12, 2.0))


@check(1)
def matches_are_left_alone(candidate: Function) -> Verdict:
    """The pixels that come in are not changed."""
    return left_alone(candidate, judged(candidate, a_pair(STUDENTS + 5, 30, 0.0), 1e-3, 0.1))


def similarity(uv: np.ndarray) -> np.ndarray:
    """Return what brings pixels to mean 0 and mean distance √2."""
    mean = uv.mean(axis=0)
    scale = np.sqrt(2) / np.linalg.norm(uv - mean, axis=1).mean()
    return np.array([[scale, 0, -scale * mean[0]], [0, scale, -scale * mean[1]], [0, 0, 1.0]])


def solved(x_h: np.ndarray, y_h: np.ndarray) -> np.ndarray:
    """Return the null vector of the equations, as a matrix."""
    if len(x_h) < 8:
        raise ValueError("eight matches are needed")
    return np.linalg.svd((y_h[:, :, None] * x_h[:, None, :]).reshape(-1, 9))[2][-1].reshape(3, 3)


def dropped(F: np.ndarray) -> np.ndarray:
    """Return F without its smallest singular value."""
    U, s, Vt = np.linalg.svd(F)
    return U @ np.diag([s[0], s[1], 0]) @ Vt


def normalised(
    uv_first: np.ndarray, uv_second: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return F of rank two in normalised coordinates, and both similarities."""
    T, S = similarity(uv_first), similarity(uv_second)
    return dropped(solved(homogeneous(uv_first) @ T.T, homogeneous(uv_second) @ S.T)), T, S


@mistake(
    "You return the transpose: (u, v, 1) F (u', v', 1)^T = 0. The second picture's pixel belongs on"
    " the left of F."
)
def transposed(uv_first: np.ndarray, uv_second: np.ndarray) -> np.ndarray:
    """Takes the second picture to the first."""
    F, T, S = normalised(uv_first, uv_second)
    return (S.T @ F @ T).T


@mistake(
    "You solved in raw pixels. Shift and scale both pictures first: u u' is 100,000 times as large"
    " as 1 otherwise."
)
def raw_pixels(uv_first: np.ndarray, uv_second: np.ndarray) -> np.ndarray:
    """Does not normalise."""
    return dropped(solved(homogeneous(uv_first), homogeneous(uv_second)))


@mistake("Your F has rank three. Drop its smallest singular value before you go back to pixels.")
def rank_three(uv_first: np.ndarray, uv_second: np.ndarray) -> np.ndarray:
    """Leaves it at the null vector."""
    T, S = similarity(uv_first), similarity(uv_second)
    return S.T @ solved(homogeneous(uv_first) @ T.T, homogeneous(uv_second) @ S.T) @ T


@mistake(
    "You went back to pixels with inverses. With x = T u it is y^T F x = u'^T (T'^T F T) u: no"
    " inverse is needed."
)
def denormalised_with_inverses(uv_first: np.ndarray, uv_second: np.ndarray) -> np.ndarray:
    """Takes T'^-T F T^-1."""
    F, T, S = normalised(uv_first, uv_second)
    return np.linalg.inv(S).T @ F @ np.linalg.inv(T)


@mistake(
    "You swapped the two similarities on the way back: T' of the second picture stands on the left,"
    " T on the right."
)
def similarities_swapped(uv_first: np.ndarray, uv_second: np.ndarray) -> np.ndarray:
    """Takes T^T F T'."""
    F, T, S = normalised(uv_first, uv_second)
    return T.T @ F @ S


@mistake(
    "You did not go back to pixels: your F belongs to the normalised coordinates. Return T'^T F T."
)
def not_denormalised(uv_first: np.ndarray, uv_second: np.ndarray) -> np.ndarray:
    """Forgets the way back."""
    return normalised(uv_first, uv_second)[0]


@mistake("You went back to pixels without a transpose: T' F T. It has to be T'^T F T.")
def without_transpose(uv_first: np.ndarray, uv_second: np.ndarray) -> np.ndarray:
    """Takes T' F T."""
    F, T, S = normalised(uv_first, uv_second)
    return S @ F @ T


@mistake(
    "You dropped the smallest singular value in pixels, where that spoils the fit. Drop it before"
    " you go back to them."
)
def dropped_in_pixels(uv_first: np.ndarray, uv_second: np.ndarray) -> np.ndarray:
    """Makes rank two last."""
    return dropped(rank_three(uv_first, uv_second))


@alternative
def by_eigenvectors(uv_first: np.ndarray, uv_second: np.ndarray) -> np.ndarray:
    """Takes the eigenvector of A^T A, and builds the rows one by one."""
    if len(uv_first) < 8:
        raise ValueError("eight matches are needed")
    maps = []
    for uv in (uv_first, uv_second):
        mean = uv.mean(axis=0)
        scale = np.sqrt(2) / np.linalg.norm(uv - mean, axis=1).mean()
        maps.append(
            np.array([[scale, 0, -scale * mean[0]], [0, scale, -scale * mean[1]], [0, 0, 1]])
        )
    A = []
    for first, second in zip(uv_first, uv_second, strict=True):
        u, v, _ = maps[0] @ [*first, 1]
        s, t, _ = maps[1] @ [*second, 1]
        A.append([s * u, s * v, s, t * u, t * v, t, u, v, 1])
    F = np.linalg.eigh(np.array(A).T @ np.array(A))[1][:, 0].reshape(3, 3)
    U, values, Vt = np.linalg.svd(F)
    F = -maps[1].T @ U @ np.diag([*values[:2], 0]) @ Vt @ maps[0]
    return F / np.linalg.norm(F)


@alternative
def scaled_by_axes(uv_first: np.ndarray, uv_second: np.ndarray) -> np.ndarray:
    """Scales each axis to standard deviation one."""
    if len(uv_first) < 8:
        raise ValueError("eight matches are needed")
    maps = []
    for uv in (uv_first, uv_second):
        mean, spread = uv.mean(axis=0), uv.std(axis=0)
        maps.append(
            np.array(
                [
                    [1 / spread[0], 0, -mean[0] / spread[0]],
                    [0, 1 / spread[1], -mean[1] / spread[1]],
                    [0, 0, 1],
                ]
            )
        )
    T, S = maps
    F = S.T @ dropped(solved(homogeneous(uv_first) @ T.T, homogeneous(uv_second) @ S.T)) @ T
    return F / np.linalg.norm(F)
