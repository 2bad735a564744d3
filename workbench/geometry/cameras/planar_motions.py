"""Where a camera was that saw points of one plane: two answers where perspective is weak.

Reference: Collins and Bartoli, Infinitesimal Plane-Based Pose Estimation, 2014, section 3.
"""

import numpy as np
from jaxtyping import Float

from workbench.geometry.motions.alignment import nearest_rotation
from workbench.geometry.two_views.homography import fit_homographies

FLAT = 1e-3
"""Points count as flat below this ratio of their smallest to their second largest extent."""


def is_flat(p_world: Float[np.ndarray, "*k n 3"]) -> bool:
    """Return whether the points of each problem lie in one plane, and not all on one line.

    Examples:
        >>> square = np.array([[0.0, 0, 5], [1, 0, 5], [1, 1, 5], [0, 1, 5]])
        >>> is_flat(square), is_flat(square + [[0, 0, 1], [0, 0, 0], [0, 0, 0], [0, 0, 0]])
        (True, False)
    """
    a, b, c = np.moveaxis(
        np.linalg.svd(p_world - p_world.mean(axis=-2, keepdims=True), compute_uv=False), -1, 0
    )
    return bool(((c <= FLAT * b) & (b > 1e-9 * a)).all())


def planar_motions(
    p_world: Float[np.ndarray, "*j n 3"], xy: Float[np.ndarray, "*k n 2"]
) -> Float[np.ndarray, "*k 2 4 4"]:
    """Return the two T_camera_world that a homography of a plane leaves at its middle, by IPPE.

    To first order about the middle of the points the two project alike; seen along the plane's
    normal they are one. Their order hangs on their normals alone. Points may be the same in all
    pictures; `xy` are normalised.
    Reference: Collins and Bartoli 2014, eq. 8 to 13 (J, its singular value, both rotations).

    Raises:
        ValueError: If there are fewer than four points, or they are not in one plane or on one
            line.
    """
    if p_world.shape[-2] < 4 or not is_flat(p_world):
        raise ValueError(
            f"IPPE takes four points or more of one plane, not these {p_world.shape[-2]}"
        )
    p_mean = p_world.mean(axis=-2)
    q = p_world - p_mean[..., None, :]
    axes = np.linalg.svd(q, full_matrices=False)[2]
    axes[..., 2, :] = np.cross(axes[..., 0, :], axes[..., 1, :])
    H = fit_homographies(np.broadcast_to((q @ np.swapaxes(axes, -1, -2))[..., :2], xy.shape), xy)
    H = H / H[..., 2:, 2:]
    middle = H[..., :2, 2:]
    J = H[..., :2, :2] - middle @ H[..., 2:, :2]  # of the map from plane to picture, at the middle
    R_ray = _turns_to(middle[..., 0])
    B = R_ray[..., :2, :2] - middle @ R_ray[..., 2:, :2]
    A = np.linalg.solve(B, J)
    # The upper left of the rotation, relative to the ray
    top = A / np.linalg.svd(A, compute_uv=False)[..., :1, None]
    rest = np.eye(2) - np.swapaxes(top, -1, -2) @ top
    b = np.sqrt(np.maximum(np.stack([rest[..., 0, 0], rest[..., 1, 1]], axis=-1), 0.0))
    b[..., 1] *= np.where(rest[..., 0, 1] < 0.0, -1.0, 1.0)
    third = np.stack([b, -b], axis=-2)[..., None, :]
    columns = np.concatenate(
        [np.broadcast_to(top[..., None, :, :], (*third.shape[:-2], 2, 2)), third], axis=-2
    )
    across = np.cross(columns[..., 0], columns[..., 1])
    R = nearest_rotation(
        R_ray[..., None, :, :] @ np.concatenate([columns, across[..., None]], axis=-1)
    )
    R = _in_order(R, middle[..., 0])
    T = np.zeros((*R.shape[:-2], 4, 4))
    T[..., :3, :3] = R = R @ axes[..., None, :, :]
    T[..., :3, 3] = (
        _translations(R, q[..., None, :, :], xy[..., None, :, :])
        - (R @ p_mean[..., None, :, None])[..., 0]
    )
    T[..., 3, 3] = 1.0
    return T


def _in_order(R: np.ndarray, xy: np.ndarray) -> np.ndarray:
    """Return both rotations of each plane in an order that hangs on the normals alone, towards the
    camera: the one that is larger in the coordinate in which they differ most comes first.
    """
    ray = np.concatenate([xy, np.ones((*xy.shape[:-1], 1))], axis=-1)[..., None, :]
    n = R[..., :, 2]
    n = n * np.where((n * ray).sum(axis=-1, keepdims=True) > 0, -1.0, 1.0)
    apart = n[..., 0, :] - n[..., 1, :]
    most = np.take_along_axis(apart, np.abs(apart).argmax(axis=-1)[..., None], axis=-1)
    return np.where(most[..., None, None] < 0, R[..., ::-1, :, :], R)


def _turns_to(xy: np.ndarray) -> np.ndarray:
    """Return the shortest rotations that take the z axis to rays (x, y, 1)."""
    z = 1.0 / np.sqrt(1.0 + np.square(xy).sum(axis=-1))
    n = xy * z[..., None]
    R = np.zeros((*z.shape, 3, 3))
    R[..., :2, :2] = np.eye(2) - n[..., :, None] * n[..., None, :] / (1.0 + z[..., None, None])
    R[..., :2, 2] = n
    R[..., 2, :2] = -n
    R[..., 2, 2] = z
    return R


def _translations(R: np.ndarray, q: np.ndarray, xy: np.ndarray) -> np.ndarray:
    """Return the translations that put the turned points nearest to their rays, linearly."""
    turned = q @ np.swapaxes(R, -1, -2)
    off = xy * turned[..., 2:] - turned[..., :2]  # t_x - x t_z and t_y - y t_z
    mean = xy.mean(axis=-2)
    apart = xy - mean[..., None, :]
    t_z = -(apart * off).sum(axis=(-2, -1)) / np.square(apart).sum(axis=(-2, -1))
    return np.concatenate([off.mean(axis=-2) + mean * t_z[..., None], t_z[..., None]], axis=-1)
