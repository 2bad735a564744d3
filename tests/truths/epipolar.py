"""What is true of a run of the epipolar lesson, from its states alone: lines, rays and rotations by
other formulas.
"""

from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

from workbench.algorithms.two_views import Related

F_STREET = 420.0  # focal length of the made pictures, pixels


def apart(R: np.ndarray, other: np.ndarray) -> float:
    """The angle between two rotations, degrees, by scipy."""
    return float(
        np.degrees((Rotation.from_matrix(R) * Rotation.from_matrix(other).inv()).magnitude())
    )


def directions_apart(t: np.ndarray, other: np.ndarray) -> float:
    """The angle between two vectors, degrees."""
    cosine = t @ other / np.linalg.norm(t) / np.linalg.norm(other)
    return float(np.degrees(np.arccos(np.clip(cosine, -1, 1))))


def errors(state: Any) -> tuple[float, float] | None:
    """By how many degrees rotation and direction are off; the second NaN where nothing moved; None
    where nobody knows.
    """
    T = getattr(state.now, "T_second_first", None)
    true = state.views.T_second_first
    if T is None or true is None:
        return None
    moved = np.linalg.norm(true[:3, 3]) > 0
    return apart(T[:3, :3], true[:3, :3]), (
        directions_apart(T[:3, 3], true[:3, 3]) if moved else float("nan")
    )


def sampson(F: np.ndarray, matches: np.ndarray) -> float:
    """The root mean square Sampson distance, one match at a time."""
    squares = []
    for u, v, s, t in matches:
        x, y = np.array([u, v, 1.0]), np.array([s, t, 1.0])
        a = F @ x
        b = F.T @ y
        squares.append((y @ F @ x) ** 2 / (a[0] ** 2 + a[1] ** 2 + b[0] ** 2 + b[1] ** 2))
    return float(np.sqrt(np.mean(squares)))


def true_fundamental(state: Any) -> np.ndarray:
    """F of the true cameras, by eight-point's inverse: three columns from where the axes'
    directions are seen.
    """
    T, K, L = state.views.T_second_first, state.views.K_first, state.views.K_second
    e = L @ T[:3, 3]  # the first centre, seen by the second camera
    H = L @ T[:3, :3] @ np.linalg.inv(K)  # how infinity moves
    return np.cross(
        np.tile(e[:, None], 3).T, H.T
    ).T  # columns e x h: the line from the epipole to where infinity is seen


def rows_apart(state: Any) -> float:
    """The root mean square difference of rows after both cameras are turned, by rotating every
    ray.
    """
    rectification = state.now.rectification
    views = state.views
    rows = []
    for R, K, uv in (
        (rectification.R_rectified_first, state.K_first, views.matches[:, :2]),
        (rectification.R_rectified_second, state.K_second, views.matches[:, 2:]),
    ):
        rays = np.column_stack([uv, np.ones(len(uv))]) @ np.linalg.inv(K).T @ R.T
        rows.append(rectification.K[1, 1] * rays[:, 1] / rays[:, 2] + rectification.K[1, 2])
    return float(np.sqrt(np.mean((rows[0] - rows[1]) ** 2)))


def in_front(state: Any, T: np.ndarray) -> int:
    """How many matches the four equations put before both cameras, one at a time, by
    eigenvectors.
    """
    P = state.K_first @ np.eye(3, 4)
    Q = state.K_second @ T[:3]
    count = 0
    for u, v, s, t in state.views.matches:
        A = np.array([u * P[2] - P[0], v * P[2] - P[1], s * Q[2] - Q[0], t * Q[2] - Q[1]])
        A /= np.linalg.norm(A, axis=1, keepdims=True)
        x, y, z, w = np.linalg.eigh(A.T @ A)[1][:, 0]
        count += z / w > 0 and T[2] @ [x, y, z, w] / w > 0
    return count


def is_right(state: Any) -> bool | None:
    """Whether the end of a run is right; None before it, and where nobody knows."""
    if not (isinstance(state.now, Related) and state.now.stage == "rectified"):
        return None
    angles = errors(state)
    if angles is None:
        return None
    turn, direction = angles
    return turn < 1.0 and direction < 5.0
