"""Write the three angles of pairs of points with normals, all pairs at once. Both scans are
described with your function, so what it gets wrong shows in the share of matches that are right.
"""

import numpy as np
from jaxtyping import Float

from lessons.features.exercises import STUDENTS
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
    worst,
)
from workbench.geometry.features import fpfh


@contract(
    slot="pair_angles",
    examples=(
        (
            (
                "pair_angles(np.zeros((1, 3)), np.array([[0.0, 0, 1]]), np.array([[0.0, 1, 0]]),"
                " np.array([[0.0, 0.6, 0.8]]))"
            ),
            "[[0.6435, 0, -0.6]]",
        ),
        (
            (
                "pair_angles(np.array([[0.0, 1, 0]]), np.array([[0.0, 0.6, 0.8]]), np.zeros((1,"
                " 3)), np.array([[0.0, 0, 1]]))"
            ),
            "[[0.6435, 0, -0.6]]",
        ),
    ),
)
def pair_angles(
    p_i: Float[np.ndarray, "k 3"],
    n_i: Float[np.ndarray, "k 3"],
    p_j: Float[np.ndarray, "k 3"],
    n_j: Float[np.ndarray, "k 3"],
) -> Float[np.ndarray, "k 3"]:
    """Return (theta, alpha, phi) of each pair of points with normals; row k belongs to row k.

    Let d be the unit line from one point to the other. Of the two normals, u is the one with the
    larger |u . d|, and d runs from its point to the other, whose normal is n. With v = (d x u) / |d
    x u| and w = u x v: theta = atan2(w . n, u . n), alpha = v . n, phi = u . d.

    Args:
        p_i: The first points, metres.
        n_i: Their unit normals.
        p_j: The second points, never at the place of the first.
        n_j: Their unit normals. No line runs along the normal u.

    Returns:
        One row per pair: theta in radians, alpha and phi as they are. Exchanging the two points of
        a pair changes nothing. The inputs stay as they are.
    """
    return fpfh.pair_angles(p_i, n_i, p_j, n_j)


HINT = "d is a unit vector, u the normal nearer to it, v and w as in the task."


def pairs(seed: int, count: int, spread: float = 1.0) -> tuple[np.ndarray, ...]:
    """Return points a few centimetres apart and unit normals that differ."""
    rng = np.random.default_rng(seed)
    p_i, n_i = rng.normal(size=(2, count, 3))
    n_j = n_i + spread * rng.normal(size=(count, 3))
    p_j = p_i + 0.05 * rng.normal(size=(count, 3))
    n_i, n_j = (n / np.linalg.norm(n, axis=1, keepdims=True) for n in (n_i, n_j))
    return p_i, n_i, p_j, n_j


def judged(candidate: Function, case: tuple[np.ndarray, ...], label: str) -> Verdict:
    """Judge by the largest difference of an angle; theta of half a turn may be either."""
    got = candidate(*case)
    right = fpfh.pair_angles(*case)
    off = got - right
    half = np.abs(right[:, 0]) > np.pi - 1e-6  # where rounding decides between -pi and pi
    off[half, 0] = (off[half, 0] + np.pi) % (2 * np.pi) - np.pi
    off = np.abs(np.where(np.isfinite(off), off, np.inf))
    row = int(off.max(axis=1).argmax())
    hint = beside(got[row], right[row], HINT, "(theta, alpha, phi)")
    return band(
        f"{label}: largest difference", float(off.max()), "", good=1e-6, fair=1e-3, hint=hint
    )


@check(2)
def pairs_on_a_surface(candidate: Function) -> Verdict:
    """Neighbours whose normals differ a little."""
    return judged(candidate, pairs(STUDENTS, 30, 0.3), "30 pairs")


@check(2)
def in_either_order(candidate: Function) -> Verdict:
    """The two points of a pair exchanged: the same three angles."""
    p_i, n_i, p_j, n_j = pairs(STUDENTS + 1, 30)
    return worst(
        [
            judged(candidate, (p_i, n_i, p_j, n_j), "One way"),
            judged(candidate, (p_j, n_j, p_i, n_i), "Exchanged"),
        ]
    )


@check(1)
def inputs_are_left_alone(candidate: Function) -> Verdict:
    """Points and normals are not changed."""
    return left_alone(candidate, judged(candidate, pairs(STUDENTS + 2, 5), "5 pairs"))


def framed(
    p_i: np.ndarray,
    n_i: np.ndarray,
    p_j: np.ndarray,
    n_j: np.ndarray,
    *,
    swap: bool = True,
    unit: bool = True,
) -> tuple[np.ndarray, ...]:
    """Return d, u, n, v, w of every pair, written as the task has it."""
    d = p_j - p_i
    if unit:
        d = d / np.linalg.norm(d, axis=1, keepdims=True)
    other = np.abs((n_i * d).sum(1)) < np.abs((n_j * d).sum(1))
    other = (other & swap)[:, None]
    d = np.where(other, -d, d)
    u = np.where(other, n_j, n_i)
    n = np.where(other, n_i, n_j)
    v = np.cross(d, u)
    v = v / np.linalg.norm(v, axis=1, keepdims=True)
    return d, u, n, v, np.cross(u, v)


def angles_in(
    d: np.ndarray, u: np.ndarray, n: np.ndarray, v: np.ndarray, w: np.ndarray
) -> np.ndarray:
    """Return the angles in a frame."""
    return np.column_stack(
        [np.arctan2((w * n).sum(1), (u * n).sum(1)), (v * n).sum(1), (u * d).sum(1)]
    )


@mistake(
    "Your angles depend on the order of the two points. u is the normal that is nearer to the line,"
    " from either point."
)
def never_swapped(p_i: np.ndarray, n_i: np.ndarray, p_j: np.ndarray, n_j: np.ndarray) -> np.ndarray:
    """Always takes the first point as source."""
    return angles_in(*framed(p_i, n_i, p_j, n_j, swap=False))


@mistake("Your phi grows with the distance of the points: d has to be divided by its length.")
def line_not_unit(p_i: np.ndarray, n_i: np.ndarray, p_j: np.ndarray, n_j: np.ndarray) -> np.ndarray:
    """Leaves d as long as the points are apart."""
    return angles_in(*framed(p_i, n_i, p_j, n_j, unit=False))


@mistake(
    "The two arguments of your arctangent are exchanged: theta = atan2(w . n, u . n), the sine"
    " comes first."
)
def arctangent_exchanged(
    p_i: np.ndarray, n_i: np.ndarray, p_j: np.ndarray, n_j: np.ndarray
) -> np.ndarray:
    """Takes atan2(u n, w n)."""
    d, u, n, v, w = framed(p_i, n_i, p_j, n_j)
    return np.column_stack(
        [np.arctan2((u * n).sum(1), (w * n).sum(1)), (v * n).sum(1), (u * d).sum(1)]
    )


@mistake(
    "You exchange the normals but keep d: where the second point is the source, the line runs from"
    " it to the first."
)
def line_not_turned(
    p_i: np.ndarray, n_i: np.ndarray, p_j: np.ndarray, n_j: np.ndarray
) -> np.ndarray:
    """Swaps the normals and not the line."""
    d, u, n, *_ = framed(p_i, n_i, p_j, n_j)
    d = (p_j - p_i) / np.linalg.norm(p_j - p_i, axis=1, keepdims=True)
    v = np.cross(d, u)
    v = v / np.linalg.norm(v, axis=1, keepdims=True)
    return angles_in(d, u, n, v, np.cross(u, v))


@mistake(
    "Your v is not of length 1: d and u are not at a right angle, so their cross product has to be"
    " divided by its length."
)
def cross_not_unit(
    p_i: np.ndarray, n_i: np.ndarray, p_j: np.ndarray, n_j: np.ndarray
) -> np.ndarray:
    """Leaves v as the cross product is."""
    d, u, n, *_ = framed(p_i, n_i, p_j, n_j)
    v = np.cross(d, u)
    return angles_in(d, u, n, v, np.cross(u, v))


@mistake(
    "Your v points the other way: it is d x u, in this order. So the signs of alpha and theta are"
    " not right."
)
def cross_exchanged(
    p_i: np.ndarray, n_i: np.ndarray, p_j: np.ndarray, n_j: np.ndarray
) -> np.ndarray:
    """Takes u x d."""
    d, u, n, v, w = framed(p_i, n_i, p_j, n_j)
    return angles_in(d, u, n, -v, -w)


@alternative
def by_rows(p_i: np.ndarray, n_i: np.ndarray, p_j: np.ndarray, n_j: np.ndarray) -> np.ndarray:
    """One pair after the other."""
    rows = []
    for a, u, b, n in zip(p_i, n_i, p_j, n_j, strict=True):
        d = (b - a) / np.linalg.norm(b - a)
        if abs(u @ d) < abs(n @ d):
            u, n, d = n, u, -d
        v = np.cross(d, u)
        v /= np.linalg.norm(v)
        rows.append([np.arctan2(np.cross(u, v) @ n, u @ n), v @ n, u @ d])
    return np.array(rows)


@alternative
def by_frames(p_i: np.ndarray, n_i: np.ndarray, p_j: np.ndarray, n_j: np.ndarray) -> np.ndarray:
    """The frame as the task has it."""
    return angles_in(*framed(p_i, n_i, p_j, n_j))
