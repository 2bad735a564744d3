"""From two pixels to a point: where the rays of two cameras meet, and how uncertain that is.

Camera matrices are P = K [R | t], 3x4, and take points of one common frame to pixels.
Reference: Hartley and Zisserman, Multiple View Geometry, 2nd ed. (HZ), chapter 12.
"""

import numpy as np
from jaxtyping import Bool, Float

from workbench.geometry.motions import apply
from workbench.geometry.two_views.homography import homogeneous, null_vectors


def camera_matrix(
    K: Float[np.ndarray, "3 3"], T_camera_world: Float[np.ndarray, "4 4"]
) -> Float[np.ndarray, "3 4"]:
    """Return P = K [R | t], which takes points to pixels in homogeneous coordinates."""
    return K @ T_camera_world[:3]


def triangulate(  # noqa: PLR0917
    P_first: Float[np.ndarray, "3 4"],
    P_second: Float[np.ndarray, "3 4"],
    uv_first: Float[np.ndarray, "n 2"],
    uv_second: Float[np.ndarray, "n 2"],
) -> Float[np.ndarray, "n 3"]:
    """Return the points that fit the pixels best in the algebraic sense (DLT, HZ 12.2).

    Nearly parallel rays may meet behind; parallel ones give what is huge, infinite or NaN.
    """
    rows = [
        uv[:, k : k + 1] * P[2] - P[k]
        for P, uv in ((P_first, uv_first), (P_second, uv_second))
        for k in (0, 1)
    ]
    A = np.stack(rows, axis=1)
    A /= np.linalg.norm(A, axis=2, keepdims=True)
    p_h = null_vectors(A)
    with np.errstate(divide="ignore", invalid="ignore"):
        return p_h[:, :3] / p_h[:, 3:]


def midpoints(
    T_second_first: Float[np.ndarray, "4 4"],
    xy_first: Float[np.ndarray, "n 2"],
    xy_second: Float[np.ndarray, "n 2"],
) -> Float[np.ndarray, "n 3"]:
    """Return the middles between normalised rays, in the first camera's frame; NaN if parallel.

    Reference: Hartley and Sturm, Triangulation, CVIU 1997, section 5.3.
    """
    R = T_second_first[:3, :3]
    t = T_second_first[:3, 3]
    a = homogeneous(xy_first)
    b = homogeneous(xy_second) @ R
    a /= np.sqrt(np.einsum("ij,ij->i", a, a))[:, None]
    b /= np.sqrt(np.einsum("ij,ij->i", b, b))[:, None]
    p_center = -t @ R
    along_a = a @ p_center
    along_b = b @ p_center
    cosine = np.einsum("ij,ij->i", a, b)
    sine = 1.0 - cosine * cosine
    with np.errstate(divide="ignore", invalid="ignore"):
        depth_a = (along_a - along_b * cosine) / sine
        depth_b = (along_a * cosine - along_b) / sine
    return 0.5 * (depth_a[:, None] * a + p_center + depth_b[:, None] * b)


def before_both(
    p_first: Float[np.ndarray, "n 3"], T_second_first: Float[np.ndarray, "4 4"]
) -> Bool[np.ndarray, " n"]:
    """Return which points of the first camera's frame are in front of both; NaN rows are not."""
    return (p_first[:, 2] > 0.0) & (apply(T_second_first, p_first)[:, 2] > 0.0)


def triangulation_covariances(
    P_first: Float[np.ndarray, "3 4"],
    P_second: Float[np.ndarray, "3 4"],
    p: Float[np.ndarray, "n 3"],
    *,
    sigma: float,
) -> Float[np.ndarray, "n 3 3"]:
    """Return points' covariances, to first order, for a standard deviation of pixel coordinates.

    NaN where the two rays are parallel to the last digit (HZ 5.2.2, result 5.10, and 12.6).
    """
    slopes = []
    for P in (P_first, P_second):
        u, v, w = P @ homogeneous(p).T
        slopes += [
            (P[k, :3] - (q / w)[:, None] * P[2, :3]) / w[:, None] for k, q in ((0, u), (1, v))
        ]
    J = np.stack(slopes, axis=1)
    information = np.swapaxes(J, 1, 2) @ J
    singular = ~(np.linalg.cond(information) < 1e15) if len(p) else np.zeros(0, bool)
    information[singular] = np.eye(3)
    covariances = sigma * sigma * np.linalg.inv(information)
    covariances[singular] = np.nan
    return covariances
