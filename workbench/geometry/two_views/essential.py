"""The motion between two calibrated cameras, held by the essential matrix up to its length.

Convention: `E` takes normalised points of the first camera to lines of the second, `xy_second_h.T @
E @ xy_first_h = 0`, and `T_second_first` takes points of the first camera's frame to the second's:
E = [t]x R. No picture tells how long t is.
Reference: Hartley and Zisserman, Multiple View Geometry, 2nd ed. (HZ), 9.6.
"""

import numpy as np
from jaxtyping import Float

from workbench.geometry.motions import across, exp_so3, motion, skew
from workbench.geometry.refinement import levenberg_marquardt
from workbench.geometry.two_views.epipolar import GENERATORS, outer_products, sampson_slopes
from workbench.geometry.two_views.homography import homogeneous, normalising_similarity

_QUARTER = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
_FORTH = np.array([1.0, 0.61, 0.37])
"""Of t and -t the one with a part along this comes first; hardly a camera moves across it."""
_Motion = tuple[np.ndarray, np.ndarray]


def essential_from_fundamental(
    F: Float[np.ndarray, "3 3"],
    K_first: Float[np.ndarray, "3 3"],
    K_second: Float[np.ndarray, "3 3"],
) -> Float[np.ndarray, "3 3"]:
    """Return E = K'^T F K, of Frobenius norm one (HZ eq. 9.12); singular values may differ."""
    E = K_second.T @ F @ K_first
    return E / np.linalg.norm(E)


def equal_singular_values(E: Float[np.ndarray, "3 3"]) -> Float[np.ndarray, "3 3"]:
    """Return the nearest essential matrix: singular values (s, s, 0) (HZ 9.6.1 and 11.7.3)."""
    U, s, Vt = np.linalg.svd(E)
    return 0.5 * (s[0] + s[1]) * U[:, :2] @ Vt[:2]


def essential_to_poses(E: Float[np.ndarray, "3 3"]) -> Float[np.ndarray, "4 4 4"]:
    """Return the four T_second_first of an essential matrix, |t| = 1 (HZ 9.6.2, result 9.19).

    Two rotations, half a turn about the baseline apart: (R, t), (R, -t), (R', t), (R', -t). R is
    the smaller turn, and t points along (1, 0.61, 0.37): equal singular values leave U and V open.
    """
    U, _, Vt = np.linalg.svd(E)
    U, Vt = U * np.copysign(1.0, np.linalg.det(U)), Vt * np.copysign(1.0, np.linalg.det(Vt))
    rotations = sorted((U @ W @ Vt for W in (_QUARTER, _QUARTER.T)), key=np.trace, reverse=True)
    t = U[:, 2] * np.copysign(1.0, U[:, 2] @ _FORTH)
    return np.stack([motion(R, side * t) for R in rotations for side in (1.0, -1.0)])


def refine_motion(
    T_second_first: Float[np.ndarray, "4 4"],
    uv_first: Float[np.ndarray, "n 2"],
    uv_second: Float[np.ndarray, "n 2"],
    *,
    K_first: Float[np.ndarray, "3 3"],
    K_second: Float[np.ndarray, "3 3"],
    steps: int = 10,
) -> Float[np.ndarray, "4 4"]:
    """Return the motion near this one, |t| = 1, of least squared Sampson distances of matches.

    Five unknowns: a turn of R (three) and of t (two) (HZ 11.4.3 and eq. 11.9).

    Raises:
        ValueError: If the translation is zero.
    """
    length = np.linalg.norm(T_second_first[:3, 3])
    if not length > 0.0:
        raise ValueError("a motion without translation has no epipolar geometry to refine")
    S = normalising_similarity(np.concatenate([uv_first, uv_second]))
    x, y = S @ homogeneous(uv_first).T, S @ homogeneous(uv_second).T
    outer = outer_products(y, x)
    left = np.linalg.inv(S @ K_second).T
    right = np.linalg.inv(S @ K_first)

    def linearise(unknown: _Motion) -> tuple[np.ndarray, np.ndarray]:
        R, t = unknown
        residuals, by_F = sampson_slopes(left @ skew(t) @ R @ right, x, y, outer=outer)
        turned = skew(t) @ GENERATORS @ R
        moved = np.array([skew(side) @ R for side in across(t)])
        by_step = (left @ np.concatenate([turned, moved]) @ right).reshape(5, 9)
        return residuals, (by_step @ by_F).T

    def retract(unknown: _Motion, step: np.ndarray) -> _Motion:
        R, t = unknown
        t_moved = t + step[3:] @ np.stack(across(t))
        return exp_so3(step[:3]) @ R, t_moved / np.linalg.norm(t_moved)

    start = T_second_first[:3, :3], T_second_first[:3, 3] / length
    return motion(*levenberg_marquardt(linearise, retract, start, steps=steps))
