"""Turns two cameras, where they stand, until rows of their pictures correspond.

Both get one orientation, their common x axis along the baseline, and one K. A turn of a camera is a
homography.
Reference: Fusiello, Trucco and Verri, A compact algorithm for rectification of stereo pairs,
Machine Vision and Applications, 2000; here the new optical axis is the mean of both old ones.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, UInt8

from workbench.geometry.motions import skew
from workbench.geometry.polylines import rectangle
from workbench.geometry.two_views.homography import homogeneous


@dataclass(frozen=True, eq=False, kw_only=True)
class Rectification:
    """Two cameras turned so that rows correspond; disparities are those of the left one."""

    R_rectified_first: Float[np.ndarray, "3 3"]
    R_rectified_second: Float[np.ndarray, "3 3"]
    K: Float[np.ndarray, "3 3"]
    H_first: Float[np.ndarray, "3 3"]
    H_second: Float[np.ndarray, "3 3"]
    second_is_left: bool


def rectify(
    T_second_first: Float[np.ndarray, "4 4"],
    K_first: Float[np.ndarray, "3 3"],
    K_second: Float[np.ndarray, "3 3"],
    *,
    keep_upright: bool = True,
) -> Rectification:
    """Return the common orientation of two cameras, and the homographies that turn their pictures.

    `keep_upright` lets x run against the baseline where the second camera stands left of the first.
    In the paper x always runs from the first to the second; such pictures come out upside down.
    Where a camera sees the other its picture is `torn`.

    Raises:
        ValueError: If the cameras stand at one place, or the baseline runs along the optical axes.
    """
    R = T_second_first[:3, :3]
    t = T_second_first[:3, 3]
    length = np.linalg.norm(t)
    if not length > 0.0:
        raise ValueError("both cameras stand at one place: there is no baseline to turn them to")
    n_x = -t @ R / length  # from the first camera to the second
    second_is_left = bool(n_x @ (np.eye(3)[0] + R[0]) < 0.0)
    if second_is_left and keep_upright:
        n_x = -n_x
    n_y = skew(np.eye(3)[2] + R[2]) @ n_x
    if not np.linalg.norm(n_y) > 1e-9:
        raise ValueError("the baseline runs along the optical axes: no turn makes rows correspond")
    n_y /= np.linalg.norm(n_y)
    R_rectified_first = np.stack([n_x, n_y, skew(n_x) @ n_y])
    R_rectified_second = R_rectified_first @ R.T
    K = 0.5 * (K_first + K_second)
    K[0, 1] = 0.0
    return Rectification(
        R_rectified_first=R_rectified_first,
        R_rectified_second=R_rectified_second,
        K=K,
        H_first=K @ R_rectified_first @ np.linalg.inv(K_first),
        H_second=K @ R_rectified_second @ np.linalg.inv(K_second),
        second_is_left=second_is_left,
    )


def torn(H: Float[np.ndarray, "3 3"], size: tuple[int, int]) -> bool:
    """Return whether a homography takes part of a picture (width, height) through infinity."""
    w = homogeneous(_corners(size)) @ H[2]
    return not bool((w > 1e-9 * np.abs(w).max()).all())


def growth(H: Float[np.ndarray, "3 3"], size: tuple[int, int]) -> float:
    """Return a warped picture's upright box over the picture's area; infinite where it tears."""
    if torn(H, size):
        return float("inf")
    low, high = _box(H, size)
    return float((high - low).prod() / (size[0] * size[1]))


def fitted(
    H_first: Float[np.ndarray, "3 3"],
    H_second: Float[np.ndarray, "3 3"],
    *,
    size_first: tuple[int, int],
    size_second: tuple[int, int],
    size: tuple[int, int],
) -> tuple[Float[np.ndarray, "3 3"], Float[np.ndarray, "3 3"]]:
    """Return both homographies, scaled and moved alike so that both warped pictures fit in `size`.

    Raises:
        ValueError: If one of them is torn.
    """
    if torn(H_first, size_first) or torn(H_second, size_second):
        raise ValueError("a picture is torn: it goes through infinity")
    boxes = np.array([_box(H_first, size_first), _box(H_second, size_second)])
    top, bottom = boxes[:, 0, 1].min(), boxes[:, 1, 1].max()
    scale = min(size[1] / (bottom - top), size[0] / (boxes[:, 1, 0] - boxes[:, 0, 0]).max())
    moves = []
    for box in boxes:
        middle = np.array([box[:, 0].mean(), 0.5 * (top + bottom)])
        shift = 0.5 * (np.array(size) - 1) - scale * middle
        moves.append(np.array([[scale, 0.0, shift[0]], [0.0, scale, shift[1]], [0.0, 0.0, 1.0]]))
    return moves[0] @ H_first, moves[1] @ H_second


def warp(
    image: UInt8[np.ndarray, "h w 3"],
    H: Float[np.ndarray, "3 3"],
    size: tuple[int, int],
    *,
    around: int = 255,
) -> UInt8[np.ndarray, "m k 3"]:
    """Return the (width, height) picture that a homography makes, bilinear, grey around it."""
    h, w = image.shape[:2]
    u, v = np.meshgrid(np.arange(size[0], dtype=float), np.arange(size[1], dtype=float))
    back = np.linalg.inv(H)
    x_h = back @ np.stack([u.ravel(), v.ravel(), np.ones(u.size)])
    with np.errstate(divide="ignore", invalid="ignore"):
        x, y = x_h[:2] / x_h[2]
        inside = (x >= 0.0) & (x <= w - 1) & (y >= 0.0) & (y <= h - 1)
    x, y = x[inside], y[inside]
    column, row = np.minimum(x.astype(int), w - 2), np.minimum(y.astype(int), h - 2)
    across, down = (x - column)[:, None], (y - row)[:, None]
    flat = image.reshape(-1, 3)
    at = row * w + column
    upper = flat[at] * (1.0 - across) + flat[at + 1] * across
    lower = flat[at + w] * (1.0 - across) + flat[at + w + 1] * across
    warped = np.full((u.size, 3), around, np.uint8)
    warped[inside] = np.rint(upper * (1.0 - down) + lower * down).astype(np.uint8)
    return warped.reshape(size[1], size[0], 3)


def _corners(size: tuple[int, int]) -> np.ndarray:
    return rectangle(np.full(2, -0.5), np.array(size) - 0.5)


def _box(H: np.ndarray, size: tuple[int, int]) -> np.ndarray:
    """Return the lowest and highest corner of the upright box around a warped picture, (2, 2)."""
    p = homogeneous(_corners(size)) @ H.T
    uv = p[:, :2] / p[:, 2:]
    return np.stack([uv.min(axis=0), uv.max(axis=0)])
