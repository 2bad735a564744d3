"""Points and lines of the plane in homogeneous coordinates: meets, joins, and what maps keep.

A point (x, y, w) stands for (x / w, y / w), and with w = 0 for a direction: a point at infinity. A
line (a, b, c) holds the points with a x + b y + c w = 0. All are the same up to a factor.
Reference: Hartley and Zisserman, Multiple View Geometry, 2nd ed., 2.2 and 2.3, eq. 2.2, 2.4 and
2.6.
"""

import numpy as np
from jaxtyping import Float


def meet(
    lines_a: Float[np.ndarray, "n 3"], lines_b: Float[np.ndarray, "n 3"]
) -> Float[np.ndarray, "n 3"]:
    """Return the points (x, y, w) where lines cross those in the same rows, or lines of points.

    Examples:
        >>> meet(np.array([[1.0, 0, -2]]), np.array([[0.0, 1, -3]])).tolist()  # x = 2 and y = 3
        [[2.0, 3.0, 1.0]]
    """
    (a, b, c), (d, e, f) = lines_a.T, lines_b.T
    return np.column_stack([b * f - c * e, c * d - a * f, a * e - b * d])


def map_lines(
    H: Float[np.ndarray, "3 3"], lines: Float[np.ndarray, "n 3"]
) -> Float[np.ndarray, "n 3"]:
    """Return where a homography of points takes lines: H^-T l, so that what meets still meets."""
    return np.linalg.solve(H.T, lines.T).T


def cross_ratio(t: Float[np.ndarray, "4"]) -> float:
    """Return (t3 - t1)(t4 - t2) / ((t3 - t2)(t4 - t1)), which no homography changes (eq. 2.18)."""
    a, b, c, d = t
    return float((c - a) * (d - b) / ((c - b) * (d - a)))


def angle_between_rays(
    p_h: Float[np.ndarray, "n 3"], q_h: Float[np.ndarray, "n 3"]
) -> Float[np.ndarray, " n"]:
    """Return the angles between homogeneous vectors up to sign, radians; NaN where one is zero."""
    with np.errstate(all="ignore"):
        p, q = (v / np.linalg.norm(v, axis=1, keepdims=True) for v in (p_h, q_h))
        return np.arctan2(np.linalg.norm(np.cross(p, q), axis=1), np.abs((p * q).sum(axis=1)))
