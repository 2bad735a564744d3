"""Pinhole cameras: from world points to pixels and back to rays.

Conventions (OpenCV's): the camera frame has +X right, +Y down, +Z forward; a pixel `uv` is (u, v) =
(column, row) and pixel centres are at integers, so a picture of width w spans u from -0.5 to w -
0.5. The motion `T_camera_world` takes world points, metres, into the camera frame; K is in pixels;
a depth is Z, not the length of a ray. One point goes

    p_camera = R p_world + t,   xy = (X/Z, Y/Z),   xy' = distort(xy),   (u, v, 1) = K (x', y', 1).

Reference: Hartley and Zisserman, Multiple View Geometry, 2nd ed., chapters 6 (camera), 7.4
(distortion), 8.6 (vanishing points).
"""

import math

import numpy as np
from jaxtyping import Bool, Float

from workbench.geometry.cameras.distortion import (
    NONE,
    Distortion,
    bend,
    chunks,
    invertible_radius,
    undistort,
)
from workbench.geometry.motions import across, apply, inverse, motion

OPENGL_FROM_OPENCV = np.diag([1.0, -1.0, -1.0, 1.0])
"""Takes points of an OpenCV camera frame to OpenGL's (+Y up, looking along -Z)."""


def intrinsics(
    f: float, cx: float, cy: float, *, fy: float | None = None, skew: float = 0.0
) -> Float[np.ndarray, "3 3"]:
    """Return K from focal length and principal point, pixels; skew shifts u per normalised y.

    Raises:
        ValueError: If a focal length is not positive and finite.

    Examples:
        >>> intrinsics(500.0, 319.5, 239.5).tolist()
        [[500.0, 0.0, 319.5], [0.0, 500.0, 239.5], [0.0, 0.0, 1.0]]
    """
    fy = f if fy is None else fy
    if not (0 < f < math.inf and 0 < fy < math.inf):
        raise ValueError(f"focal lengths must be positive and finite, got {f} and {fy}")
    return np.array([[f, skew, cx], [0.0, fy, cy], [0.0, 0.0, 1.0]])


def focal_from_field_of_view(angle: float, size: int) -> float:
    """Return the focal length in pixels at which `size` pixels span this angle, radians.

    Raises:
        ValueError: If the angle is not between 0 and pi.

    Examples:
        >>> round(focal_from_field_of_view(math.pi / 2, 640), 6)
        320.0
    """
    if not 0 < angle < math.pi:
        raise ValueError(f"a pinhole's field of view lies between 0 and pi radians, got {angle}")
    return 0.5 * size / math.tan(0.5 * angle)


def crop_intrinsics(
    K: Float[np.ndarray, "3 3"], left: float, top: float
) -> Float[np.ndarray, "3 3"]:
    """Return the K of the part of a picture whose pixel (0, 0) was (left, top)."""
    return np.array([[1.0, 0.0, -left], [0.0, 1.0, -top], [0.0, 0.0, 1.0]]) @ K


def resize_intrinsics(
    K: Float[np.ndarray, "3 3"], scale_u: float, scale_v: float
) -> Float[np.ndarray, "3 3"]:
    """Return the K of a picture resized by factors: u_new + 0.5 = scale_u (u + 0.5).

    Raises:
        ValueError: If a factor is not positive.
    """
    if not (scale_u > 0 and scale_v > 0):
        raise ValueError(f"a picture is resized by positive factors, got {scale_u} and {scale_v}")
    S = np.array(
        [[scale_u, 0.0, 0.5 * scale_u - 0.5], [0.0, scale_v, 0.5 * scale_v - 0.5], [0.0, 0.0, 1.0]]
    )
    return S @ K


def look_at(
    p_world_eye: Float[np.ndarray, "3"],
    p_world_target: Float[np.ndarray, "3"],
    n_world_up: Float[np.ndarray, "3"] | None = None,
) -> Float[np.ndarray, "4 4"]:
    """Return the T_camera_world of a camera at `eye` whose axis goes through `target`.

    `up`, +Z by default, points upwards in the picture; where one looks straight along it, the world
    axis furthest from the view takes its place.

    Raises:
        ValueError: If eye and target coincide.

    Examples:
        >>> T_camera_world = look_at(np.array([0.0, -5.0, 0.0]), np.zeros(3))
        >>> apply(T_camera_world, np.zeros(3)).round(6).tolist()  # the target: 5 m ahead
        [0.0, 0.0, 5.0]
    """
    up = np.array([0.0, 0.0, 1.0]) if n_world_up is None else n_world_up
    v_forward = p_world_target - p_world_eye
    distance = np.linalg.norm(v_forward)
    if not distance > 0:
        raise ValueError(
            f"eye and target coincide at {p_world_eye}: the viewing direction is undefined"
        )
    n_forward = v_forward / distance
    v_right = np.cross(n_forward, up)
    if np.linalg.norm(v_right) < 1e-9 * np.linalg.norm(up):
        v_right = np.cross(n_forward, np.eye(3)[np.argmin(np.abs(n_forward))])
    n_right = v_right / np.linalg.norm(v_right)
    R_camera_world = np.stack([n_right, np.cross(n_forward, n_right), n_forward])
    return motion(R_camera_world, -R_camera_world @ p_world_eye)


def camera_center(T_camera_world: Float[np.ndarray, "4 4"]) -> Float[np.ndarray, "3"]:
    """Return where the camera is in the world, m: C = -R^T t (Hartley and Zisserman, eq. 6.7).

    Examples:
        >>> camera_center(look_at(np.array([0.0, -5.0, 1.0]), np.zeros(3))).round(6).tolist()
        [0.0, -5.0, 1.0]
    """
    R_camera_world = T_camera_world[:3, :3]
    t = T_camera_world[:3, 3]
    return -R_camera_world.T @ t


def depths(
    p_world: Float[np.ndarray, "n 3"], T_camera_world: Float[np.ndarray, "4 4"]
) -> Float[np.ndarray, " n"]:
    """Return Z in the camera frame, metres: along the optical axis, not along the ray."""
    return p_world @ T_camera_world[2, :3] + T_camera_world[2, 3]


def in_front(
    p_world: Float[np.ndarray, "n 3"], T_camera_world: Float[np.ndarray, "4 4"], near: float = 0.0
) -> Bool[np.ndarray, " n"]:
    """Return which points have a depth above `near`, metres; NaN rows have not.

    Examples:
        >>> in_front(np.array([[0.0, 0.0, 2.0], [0.0, 0.0, -2.0]]), np.eye(4)).tolist()
        [True, False]
    """
    return depths(p_world, T_camera_world) > near


def project(  # noqa: PLR0917
    p_world: Float[np.ndarray, "n 3"],
    T_camera_world: Float[np.ndarray, "4 4"],
    K: Float[np.ndarray, "3 3"],
    distortion: Distortion = NONE,
    *,
    near: float = 0.0,
) -> Float[np.ndarray, "n 2"]:
    """Return the pixels (u, v) at which a camera sees the points (Hartley and Zisserman, eq. 6.8).

    They may lie outside the picture. NaN where the point lies at or behind `near` (m), or so far
    out that the lens folds (`invertible_radius`): dividing anyway would give a pixel that looks
    valid.

    Examples:
        >>> p_world = np.array([[0.1, 0.0, 2.0], [0.0, 0.0, -1.0]])  # the second is behind
        >>> project(p_world, np.eye(4), intrinsics(500.0, 319.5, 239.5)).round(6).tolist()
        [[344.5, 239.5], [nan, nan]]
    """
    ideal = not any(distortion)
    reach = invertible_radius(distortion) ** 2
    P = K @ T_camera_world[:3] if ideal else T_camera_world[:3]
    uv = np.empty((len(p_world), 2))
    with np.errstate(all="ignore"):
        for rows in chunks(len(p_world)):
            x, y, z = P[:, :3] @ p_world[rows].T + P[:, 3:]
            inverse_depth = 1.0 / np.where(z > near, z, np.nan)
            x *= inverse_depth
            y *= inverse_depth
            if not ideal:
                if reach < math.inf:
                    x[x * x + y * y >= reach] = np.nan
                    y[np.isnan(x)] = np.nan
                x, y = bend(x, y, *distortion)
                x = K[0, 0] * x + K[0, 1] * y + K[0, 2]
                y = K[1, 1] * y + K[1, 2]
            uv[rows, 0], uv[rows, 1] = x, y
    return uv


def project_orthographic(
    p_world: Float[np.ndarray, "n 3"],
    T_camera_world: Float[np.ndarray, "4 4"],
    K: Float[np.ndarray, "3 3"],
) -> Float[np.ndarray, "n 2"]:
    """Return pixels of a parallel projection: (u, v, 1) = K (X, Y, 1), K in pixels per metre.

    It is the limit of `project` with (K, T) from `dolly` as its factor grows, with scale f / Z.
    """
    xy = apply(T_camera_world, p_world)[:, :2]
    return xy @ K[:2, :2].T + K[:2, 2]


def dolly(
    T_camera_world: Float[np.ndarray, "4 4"],
    K: Float[np.ndarray, "3 3"],
    subject_depth: float,
    *,
    factor: float,
) -> tuple[Float[np.ndarray, "4 4"], Float[np.ndarray, "3 3"]]:
    """Return (T_camera_world, K) moved back along the axis with f lengthened by a factor.

    The plane at `subject_depth` keeps its size, and is `factor` times as far away. The picture
    tends to the orthographic one with f / Z pixels per metre, at a rate of one over the factor.
    """
    T_back = T_camera_world.copy()
    T_back[2, 3] += (factor - 1.0) * subject_depth
    K_long = K.copy()
    K_long[:2, :2] *= factor
    return T_back, K_long


def normalize(
    uv: Float[np.ndarray, "n 2"], K: Float[np.ndarray, "3 3"], distortion: Distortion = NONE
) -> Float[np.ndarray, "n 2"]:
    """Return ideal normalised coordinates (X/Z, Y/Z) of pixels; NaN where the lens folds."""
    y = (uv[:, 1] - K[1, 2]) / K[1, 1]
    x = (uv[:, 0] - K[0, 2] - K[0, 1] * y) / K[0, 0]
    xy = np.stack([x, y], axis=1)
    return undistort(xy, distortion) if any(distortion) else xy


def pixel_rays(
    uv: Float[np.ndarray, "n 2"],
    T_camera_world: Float[np.ndarray, "4 4"],
    K: Float[np.ndarray, "3 3"],
    *,
    distortion: Distortion = NONE,
) -> tuple[Float[np.ndarray, "3"], Float[np.ndarray, "n 3"]]:
    """Return the camera centre and each pixel's unit direction, in the world; NaN as `normalize`.

    Examples:
        >>> K = intrinsics(500.0, 320.0, 240.0)
        >>> centre, n_world = pixel_rays(np.array([[320.0, 240.0]]), np.eye(4), K)
        >>> centre.tolist(), n_world.tolist()
        ([0.0, 0.0, 0.0], [[0.0, 0.0, 1.0]])
    """
    xy = normalize(uv, K, distortion)
    v_camera = np.column_stack([xy, np.ones(len(xy))])
    n_camera = v_camera / np.linalg.norm(v_camera, axis=1, keepdims=True)
    return camera_center(T_camera_world), n_camera @ T_camera_world[:3, :3]


def back_project(
    uv: Float[np.ndarray, "n 2"],
    depth: Float[np.ndarray, " n"],
    T_camera_world: Float[np.ndarray, "4 4"],
    *,
    K: Float[np.ndarray, "3 3"],
    distortion: Distortion = NONE,
) -> Float[np.ndarray, "n 3"]:
    """Return the world points, metres, that are seen at these pixels at these depths Z.

    Examples:
        >>> K = intrinsics(500.0, 319.5, 239.5)
        >>> p_world = back_project(np.array([[344.5, 239.5]]), np.array([2.0]), np.eye(4), K=K)
        >>> p_world.round(6).tolist()
        [[0.1, 0.0, 2.0]]
    """
    xy = normalize(uv, K, distortion)
    p_camera = np.column_stack([xy, np.ones(len(xy))]) * depth[:, None]
    return apply(inverse(T_camera_world), p_camera)


def ray_lengths(
    uv: Float[np.ndarray, "n 2"],
    depth: Float[np.ndarray, " n"],
    K: Float[np.ndarray, "3 3"],
    *,
    distortion: Distortion = NONE,
) -> Float[np.ndarray, " n"]:
    """Return the distance from the camera centre of points at these depths: Z sqrt(1 + x² + y²).

    Examples:
        >>> K = intrinsics(500.0, 320.0, 240.0)
        >>> ray_lengths(np.array([[620.0, 640.0]]), np.array([2.0]), K).round(6).tolist()
        [2.828427]
    """
    xy = normalize(uv, K, distortion)
    return depth * np.sqrt(1.0 + np.einsum("ni,ni->n", xy, xy))


def vanishing_points(
    v_world: Float[np.ndarray, "n 3"],
    T_camera_world: Float[np.ndarray, "4 4"],
    K: Float[np.ndarray, "3 3"],
    *,
    distortion: Distortion = NONE,
) -> Float[np.ndarray, "n 2"]:
    """Return the pixel in which lines of a world direction meet, NaN if parallel to the picture.

    Reference: Hartley and Zisserman, 8.6.1, eq. 8.15: v = K R d.
    """
    R_camera_world = T_camera_world[:3, :3]
    v_camera = v_world @ R_camera_world.T
    length = np.linalg.norm(v_camera, axis=1, keepdims=True)
    parallel = np.abs(v_camera[:, 2:]) <= 1e-12 * length
    forward = np.where(parallel, np.nan, v_camera * np.copysign(1.0, v_camera[:, 2:]))
    return project(forward, np.eye(4), K, distortion)


def sphere_outline(
    p_world_center: Float[np.ndarray, "3"],
    radius: float,
    T_camera_world: Float[np.ndarray, "4 4"],
    *,
    n: int = 96,
) -> Float[np.ndarray, "n 3"]:
    """Return n points of the circle, metres, in which the camera's rays touch a sphere.

    Raises:
        ValueError: If the camera is inside the sphere.
    """
    v_center = p_world_center - camera_center(T_camera_world)
    distance = float(np.linalg.norm(v_center))
    if not distance > radius:
        raise ValueError(
            f"the camera is inside the sphere: distance {distance:.3g} m, radius {radius:.3g} m"
        )
    n_axis = v_center / distance
    n_side, n_up = across(n_axis)
    angle = np.linspace(0.0, 2.0 * np.pi, n, endpoint=False)
    circle = np.cos(angle)[:, None] * n_side + np.sin(angle)[:, None] * n_up
    cosine = math.sqrt(1.0 - (radius / distance) ** 2)
    return p_world_center - radius * radius / distance * n_axis + radius * cosine * circle
