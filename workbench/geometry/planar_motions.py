"""Where a camera was that saw points of one plane: the two answers that fit nearly alike where perspective is weak.

Reference: Collins and Bartoli, Infinitesimal Plane-Based Pose Estimation, 2014, section 3.
"""

import numpy as np
from jaxtyping import Float

from workbench.geometry.alignment import nearest_rotation
from workbench.geometry.homography import fit_homography
from workbench.geometry.motions import exp_so3, motion

FLAT = 1e-3
"""Points count as flat below this ratio of their smallest to their second largest extent."""


def is_flat(p_world: Float[np.ndarray, "n 3"]) -> bool:
    """Return whether points lie in one plane (and not all on one line).

    Examples:
        >>> square = np.array([[0.0, 0, 5], [1, 0, 5], [1, 1, 5], [0, 1, 5]])
        >>> is_flat(square), is_flat(square + [[0, 0, 1], [0, 0, 0], [0, 0, 0], [0, 0, 0]])
        (True, False)
    """
    _, extents, _ = np.linalg.svd(p_world - p_world.mean(axis=0), full_matrices=False)
    return bool(extents[2] <= FLAT * extents[1]) and bool(extents[1] > 1e-9 * extents[0])


def planar_motions(p_world: Float[np.ndarray, "n 3"], xy: Float[np.ndarray, "n 2"]) -> Float[np.ndarray, "2 4 4"]:
    """Return the two T_camera_world that a homography of a plane leaves at its middle, by IPPE, in no order.

    To first order about the middle of the points the two project alike; what tells them apart is perspective.

    Args:
        p_world: Four points or more of one plane, metres.
        xy: Their normalised image coordinates.

    Raises:
        ValueError: If there are fewer than four points, or they are not in one plane or all on one line.

    Note:
        Seen along the plane's normal the two are one.

    Reference: Collins and Bartoli 2014, eq. 8 to 13 (J, its singular value, both rotations).
    """
    if len(p_world) < 4 or not is_flat(p_world):
        raise ValueError(f"IPPE takes four points or more of one plane, not these {len(p_world)}")
    p_mean = p_world.mean(axis=0)
    _, _, axes = np.linalg.svd(p_world - p_mean, full_matrices=False)
    axes[2] = np.cross(axes[0], axes[1])
    q = (p_world - p_mean) @ axes.T
    H = fit_homography(q[:, :2], xy)
    H = H / H[2, 2]
    x0, y0 = H[:2, 2]
    J = H[:2, :2] - np.outer(H[:2, 2], H[2, :2])  # of the map from plane to picture, at the middle
    R_ray = _turn_to(np.array([x0, y0, 1.0]))
    B = (np.array([[1.0, 0.0, -x0], [0.0, 1.0, -y0]]) @ R_ray)[:, :2]
    A = np.linalg.solve(B, J)
    top = A / np.linalg.svd(A, compute_uv=False)[0]  # the upper left of the rotation, relative to the ray
    rest = np.eye(2) - top.T @ top
    b = np.sqrt(np.maximum(np.diag(rest), 0.0))
    b[1] = -b[1] if rest[0, 1] < 0.0 else b[1]
    found = []
    for third in (b, -b):
        columns = np.vstack([top, third])
        R = nearest_rotation(R_ray @ np.column_stack([columns, np.cross(columns[:, 0], columns[:, 1])])) @ axes
        found.append(motion(R, _translation(R, p_world - p_mean, xy) - R @ p_mean))
    return np.stack(found)


def _turn_to(v: np.ndarray) -> np.ndarray:
    """Return the shortest rotation that takes the z axis to the direction of v, which is not behind."""
    axis = np.array([-v[1], v[0], 0.0])
    sine = np.linalg.norm(axis)
    return np.eye(3) if sine == 0.0 else exp_so3(axis / sine * np.arctan2(sine, v[2]))


def _translation(R: np.ndarray, q: np.ndarray, xy: np.ndarray) -> np.ndarray:
    """Return the translation that puts the turned points nearest to their rays, linearly."""
    turned = q @ R.T
    A, b = np.zeros((len(q), 2, 3)), xy * turned[:, 2:] - turned[:, :2]
    A[:, 0, 0] = A[:, 1, 1] = 1.0
    A[:, :, 2] = -xy
    return np.linalg.lstsq(A.reshape(-1, 3), b.ravel(), rcond=None)[0]
