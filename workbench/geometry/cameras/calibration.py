"""What pictures of a flat board say of a camera, in closed form: constraints, poses, a lens.

A board lies in the plane Z = 0 of its own frame, so a picture of it is a homography H ~ K [r1 r2
t], which takes (X, Y) in metres to pixels. That r1 and r2 are orthonormal makes two equations for B
= K^-T K^-1 of every picture.
Reference: Zhang, A Flexible New Technique for Camera Calibration, PAMI 2000, sections 2 and 3.
"""

import numpy as np
from jaxtyping import Float

from workbench.geometry.motions import apply, motion
from workbench.geometry.motions.alignment import nearest_rotation

_NO_SKEW = [0, 2, 3, 4, 5]  # the columns of B11, B22, B13, B23, B33: without skew B12 is 0


def constraint_rows(H_image_board: Float[np.ndarray, "3 3"]) -> Float[np.ndarray, "2 6"]:
    """Return v12 and v11 - v22 of a view, whose products with B are zero (Zhang, eq. 7 and 8).

    Examples:
        >>> K = np.array([[500.0, 0, 320], [0, 500, 240], [0, 0, 1]])  # straight ahead
        >>> constraint_rows(K)[0].tolist()
        [0.0, 250000.0, 0.0, 0.0, 0.0, 0.0]
    """
    h1, h2 = H_image_board[:, 0], H_image_board[:, 1]
    return np.stack([_products(h1, h2), _products(h1, h1) - _products(h2, h2)])


def _products(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Return v with v · b = aᵀ B b, for B symmetric (Zhang, eq. 7)."""
    return np.array(
        [
            a[0] * b[0],
            a[0] * b[1] + a[1] * b[0],
            a[1] * b[1],
            a[2] * b[0] + a[0] * b[2],
            a[2] * b[1] + a[1] * b[2],
            a[2] * b[2],
        ]
    )


def intrinsics_from_constraints(rows: Float[np.ndarray, "m 6"]) -> Float[np.ndarray, "3 3"] | None:
    """Return the camera without skew that fits the rows best, or None where there is none.

    None for fewer than four rows (two views), values that are not finite, or a B that is not
    positive definite (Zhang 2000, 3.1 and appendix B; K by Cholesky's factors).
    """
    if len(rows) < 4 or not np.isfinite(rows).all():
        return None
    b = np.linalg.svd(rows[:, _NO_SKEW])[2][-1]
    B = np.array([[b[0], 0.0, b[2]], [0.0, b[1], b[3]], [b[2], b[3], b[4]]])
    try:
        # B = (K^-T)(K^-1), K^-T lower triangular
        K = np.linalg.inv(np.linalg.cholesky(B if b[0] > 0 else -B).T)
    except np.linalg.LinAlgError:
        return None
    K /= K[2, 2]
    return K if np.isfinite(K).all() else None


def pose_from_homography(
    K: Float[np.ndarray, "3 3"], H_image_board: Float[np.ndarray, "3 3"]
) -> Float[np.ndarray, "4 4"]:
    """Return T_camera_board, metres, with the board before the camera (Zhang 2000, 3.1).

    r1 and r2 of K^-1 H are made one long on average; the nearest rotation takes their place.

    Raises:
        ValueError: If K cannot be inverted, or the homography is zero.
    """
    try:
        r1, r2, t = np.linalg.solve(K, H_image_board).T
    except np.linalg.LinAlgError:
        raise ValueError("K has no inverse") from None
    size = np.linalg.norm(r1) + np.linalg.norm(r2)
    if not size > 0:
        raise ValueError("the homography is zero")
    scale = np.copysign(2.0 / size, t[2])
    r1, r2 = scale * r1, scale * r2
    return motion(nearest_rotation(np.column_stack([r1, r2, np.cross(r1, r2)])), scale * t)


def linear_lens(
    K: Float[np.ndarray, "3 3"],
    Ts_camera_board: Float[np.ndarray, "k 4 4"],
    p_board: Float[np.ndarray, "n 3"],
    *,
    uv: Float[np.ndarray, "k n 2"],
    terms: int = 2,
) -> Float[np.ndarray, " terms"]:
    """Return the radial k1, k2, ... that explain best how far pixels are off (Zhang, eq. 13).

    Camera and poses stay as they are. They were found as if there were no lens, and have taken up
    most of what it does: the coefficients come out far too small, or with the other sign.
    """
    p = np.concatenate([apply(T, p_board) for T in Ts_camera_board])
    xy = p[:, :2] / p[:, 2:]
    s = (xy**2).sum(axis=1, keepdims=True)
    ideal = xy * [K[0, 0], K[1, 1]]
    columns = np.stack([(ideal * s ** (i + 1)).ravel() for i in range(terms)], axis=1)
    return np.linalg.lstsq(columns, (uv.reshape(-1, 2) - K[:2, 2] - ideal).ravel(), rcond=None)[0]


def reprojection_rms(residuals: Float[np.ndarray, "n 2"]) -> float:
    """Return the root mean squared length of residuals, pixels, as OpenCV's calibrateCamera does.

    Examples:
        >>> reprojection_rms(np.array([[3.0, 4.0], [5.0, 0.0]]))
        5.0
    """
    return float(np.sqrt(np.square(residuals).sum(axis=-1).mean()))
