"""Write the linear triangulation of points from two pixels each. The lesson tries its four motions
with it, and shows the points that you find.
"""

import numpy as np
from jaxtyping import Float

from lessons.epipolar.exercises import STUDENTS, Pair, a_pair
from workbench.exercise import (
    Function,
    Verdict,
    alternative,
    band,
    beside,
    check,
    contract,
    left_alone,
    mistake,
)
from workbench.geometry.two_views import triangulation


@contract(
    slot="triangulate",
    examples=(
        (
            (
                "triangulate(np.eye(3, 4), np.eye(3, 4) - np.eye(3, 4, 3), array([[0.2, 0.1]]),"
                " array([[0., 0.1]]))"
            ),
            "[[1, 0.5, 5]]",
        ),
        (
            (
                "triangulate(np.eye(3, 4), 2 * np.eye(3, 4) - np.eye(3, 4, 3), array([[0.25, -1]]),"
                " array([[0.125, -1]]))"
            ),
            "[[1, -4, 4]]",
        ),
    ),
)
def triangulate(
    P_first: Float[np.ndarray, "3 4"],
    P_second: Float[np.ndarray, "3 4"],
    uv_first: Float[np.ndarray, "n 2"],
    uv_second: Float[np.ndarray, "n 2"],
) -> Float[np.ndarray, "n 3"]:
    """Return the points (x, y, z) that two cameras see at these pixels, metres, in the frame from
    which both P take them.

    Each pixel is two equations in homogeneous coordinates, from (u, v, 1) x P p = 0; the four of
    both cameras are solved in the sense of least squares. With exact pixels the points are exact;
    with noise, any weights of the equations will do.

    Args:
        P_first: Camera matrix of the first camera, K [R | t]: takes (x, y, z, 1) to (u, v, 1) up to
            a factor. At any scale.
        P_second: That of the second.
        uv_first: Pixels (column, row) of the first picture.
        uv_second: Their matches in the second, row k for row k.
    """
    return triangulation.triangulate(P_first, P_second, uv_first, uv_second)


HINT = (
    "Rows u P₃ − P₁ and v P₃ − P₂ of both cameras; the last right singular vector, divided by its"
    " fourth entry."
)


def matrices(pair: Pair) -> tuple[np.ndarray, np.ndarray]:
    """Return both camera matrices."""
    return pair.K_first @ np.eye(3, 4), pair.K_second @ pair.T_second_first[:3]


def judged(
    got: np.ndarray, right: np.ndarray, good: float, fair: float, hint: str = HINT
) -> Verdict:
    """Judge points by the one that is farthest off, as a share of its distance."""
    off = np.linalg.norm(got - right, axis=1) / np.linalg.norm(right, axis=1)
    worst_row = int(np.argmax(np.where(np.isfinite(off), off, np.inf)))
    told = beside(got[worst_row], right[worst_row], hint, "The point")
    return band(
        "The point farthest off is, of its distance, off by",
        100 * float(off[worst_row]),
        "%",
        good=100 * good,
        fair=100 * fair,
        hint=told,
    )


@check(3)
def exact_pixels(candidate: Function) -> Verdict:
    """With exact pixels all points are where they are."""
    pair = a_pair(STUDENTS, 12)
    return judged(
        candidate(*matrices(pair), pair.clean_first, pair.clean_second), pair.p_first, 1e-5, 1e-3
    )


@check(2)
def matrices_at_any_scale(candidate: Function) -> Verdict:
    """Camera matrices mean the same at another scale and sign."""
    pair = a_pair(STUDENTS + 1, 9)
    P, Q = matrices(pair)
    return judged(
        candidate(0.01 * P, -3.0 * Q, pair.clean_first, pair.clean_second), pair.p_first, 1e-5, 1e-3
    )


@check(1)
def arrays_are_left_alone(candidate: Function) -> Verdict:
    """The arrays that come in are not changed."""
    pair = a_pair(STUDENTS + 2, 7)
    got = candidate(*matrices(pair), pair.clean_first, pair.clean_second)
    return left_alone(candidate, judged(got, pair.p_first, 1e-5, 1e-3))


def equations(P_first, P_second, uv_first, uv_second) -> np.ndarray:
    """Return the four equations of each point, (n, 4, 4)."""
    rows = [
        uv[:, k, None] * P[2] - P[k]
        for P, uv in ((P_first, uv_first), (P_second, uv_second))
        for k in (0, 1)
    ]
    return np.stack(rows, axis=1)


def null_vectors(A: np.ndarray) -> np.ndarray:
    """Return the last right singular vectors."""
    return np.linalg.svd(A)[2][:, -1]


@mistake(
    "You did not divide by the fourth coordinate: (x, y, z, w) stands for (x / w, y / w, z / w)."
)
def not_divided(
    P_first: np.ndarray, P_second: np.ndarray, uv_first: np.ndarray, uv_second: np.ndarray
) -> np.ndarray:
    """Returns the first three entries."""
    return null_vectors(equations(P_first, P_second, uv_first, uv_second))[:, :3]


@mistake(
    "You swapped u and v. A pixel is (u, v) = (column, row): u belongs to the first row of P, v to"
    " the second."
)
def u_and_v_swapped(
    P_first: np.ndarray, P_second: np.ndarray, uv_first: np.ndarray, uv_second: np.ndarray
) -> np.ndarray:
    """Reads (row, column)."""
    x_h = null_vectors(equations(P_first, P_second, uv_first[:, ::-1], uv_second[:, ::-1]))
    return x_h[:, :3] / x_h[:, 3:]


@mistake("You gave each camera the other one's pixels.")
def cameras_exchanged(
    P_first: np.ndarray, P_second: np.ndarray, uv_first: np.ndarray, uv_second: np.ndarray
) -> np.ndarray:
    """Mixes up the pictures."""
    x_h = null_vectors(equations(P_second, P_first, uv_first, uv_second))
    return x_h[:, :3] / x_h[:, 3:]


@mistake(
    "The sign in your equations is wrong: u P₃ + P₁ in place of u P₃ − P₁. It comes from u = P₁ p /"
    " P₃ p."
)
def sign_of_equations(
    P_first: np.ndarray, P_second: np.ndarray, uv_first: np.ndarray, uv_second: np.ndarray
) -> np.ndarray:
    """Adds where it should subtract."""
    x_h = null_vectors(equations(P_first, P_second, -uv_first, -uv_second))
    return x_h[:, :3] / x_h[:, 3:]


@mistake(
    "You took the singular vector of the largest singular value. The equations are to become 0:"
    " take the last."
)
def first_vector(
    P_first: np.ndarray, P_second: np.ndarray, uv_first: np.ndarray, uv_second: np.ndarray
) -> np.ndarray:
    """Takes Vt[0]."""
    x_h = np.linalg.svd(equations(P_first, P_second, uv_first, uv_second))[2][:, 0]
    return x_h[:, :3] / x_h[:, 3:]


@mistake(
    "You took a column of V^T, or of U, in place of a row of V^T: numpy's svd returns V^T, whose"
    " rows are the vectors."
)
def column_of_vt(
    P_first: np.ndarray, P_second: np.ndarray, uv_first: np.ndarray, uv_second: np.ndarray
) -> np.ndarray:
    """Takes Vt[:, -1]."""
    x_h = np.linalg.svd(equations(P_first, P_second, uv_first, uv_second))[2][:, :, -1]
    return x_h[:, :3] / x_h[:, 3:]


@mistake(
    "You divided by the third coordinate, as one does for pixels. Points in space are divided by"
    " the fourth."
)
def divided_by_the_third(
    P_first: np.ndarray, P_second: np.ndarray, uv_first: np.ndarray, uv_second: np.ndarray
) -> np.ndarray:
    """Divides by z."""
    x_h = null_vectors(equations(P_first, P_second, uv_first, uv_second))
    return x_h[:, :3] / x_h[:, 2:3]


@alternative
def by_cross_products(
    P_first: np.ndarray, P_second: np.ndarray, uv_first: np.ndarray, uv_second: np.ndarray
) -> np.ndarray:
    """Takes all six equations of both cross products, point by point."""
    points = []
    for (u, v), (s, t) in zip(uv_first, uv_second, strict=True):
        first = np.array([[0, -1, v], [1, 0, -u], [-v, u, 0]]) @ P_first
        second = np.array([[0, -1, t], [1, 0, -s], [-t, s, 0]]) @ P_second
        A = np.concatenate([first, second])
        x_h = np.linalg.svd(A / np.linalg.norm(A, axis=1, keepdims=True))[2][-1]
        points.append(x_h[:3] / x_h[3])
    return np.array(points)


@alternative
def with_w_one(
    P_first: np.ndarray, P_second: np.ndarray, uv_first: np.ndarray, uv_second: np.ndarray
) -> np.ndarray:
    """Sets w to 1 and solves for the three others."""
    points = []
    for A in equations(P_first, P_second, uv_first, uv_second):
        A = A / np.linalg.norm(A, axis=1, keepdims=True)
        points.append(np.linalg.lstsq(A[:, :3], -A[:, 3], rcond=None)[0])
    return np.array(points)
