"""Wrong answers that students give to the exercises of this lesson, and right ones that are written differently."""

import numpy as np

from workbench.exercise.model import Mistake
from workbench.geometry import cameras, distortion
from workbench.geometry.motions import apply, inverse

# project --------------------------------------------------------------------------------------------------------------


def motion_inverted(p_world: np.ndarray, T_camera_world: np.ndarray, K: np.ndarray) -> np.ndarray:
    """Takes camera-to-world for world-to-camera."""
    return cameras.project(p_world, inverse(T_camera_world), K)


def divides_behind_too(p_world: np.ndarray, T_camera_world: np.ndarray, K: np.ndarray) -> np.ndarray:
    """Divides by the depth whatever its sign."""
    x, y, w = K @ apply(T_camera_world, p_world).T
    return np.stack([x / w, y / w], axis=1)


def row_before_column(p_world: np.ndarray, T_camera_world: np.ndarray, K: np.ndarray) -> np.ndarray:
    """Returns (v, u)."""
    return cameras.project(p_world, T_camera_world, K)[:, ::-1].copy()


def never_divides(p_world: np.ndarray, T_camera_world: np.ndarray, K: np.ndarray) -> np.ndarray:
    """Leaves the depth out."""
    p_camera = apply(T_camera_world, p_world)
    uv = p_camera[:, :2] @ K[:2, :2].T + K[:2, 2]
    uv[p_camera[:, 2] <= 0] = np.nan
    return uv


def ray_length_for_depth(p_world: np.ndarray, T_camera_world: np.ndarray, K: np.ndarray) -> np.ndarray:
    """Divides by the distance from the camera."""
    p_camera = apply(T_camera_world, p_world)
    uv = p_camera[:, :2] / np.linalg.norm(p_camera, axis=1, keepdims=True) @ K[:2, :2].T + K[:2, 2]
    uv[p_camera[:, 2] <= 0] = np.nan
    return uv


def opengl_axes(p_world: np.ndarray, T_camera_world: np.ndarray, K: np.ndarray) -> np.ndarray:
    """Takes the camera to look along -Z with +Y up."""
    return cameras.project(p_world, cameras.OPENGL_FROM_OPENCV @ T_camera_world, K)


def principal_point_forgotten(p_world: np.ndarray, T_camera_world: np.ndarray, K: np.ndarray) -> np.ndarray:
    """Scales with the focal lengths only."""
    return cameras.project(p_world, T_camera_world, K) - K[:2, 2]


def skew_forgotten(p_world: np.ndarray, T_camera_world: np.ndarray, K: np.ndarray) -> np.ndarray:
    """Reads fx, fy, cx and cy out of K, and no more."""
    return cameras.project(p_world, T_camera_world, cameras.intrinsics(K[0, 0], K[0, 2], K[1, 2], fy=K[1, 1]))


def rows_dropped(p_world: np.ndarray, T_camera_world: np.ndarray, K: np.ndarray) -> np.ndarray:
    """Leaves the points behind the camera out of the answer."""
    uv = cameras.project(p_world, T_camera_world, K)
    return uv[np.isfinite(uv).all(axis=1)]


PROJECT_MISTAKES = (
    Mistake(
        "motion inverted",
        motion_inverted,
        "You used the inverse of T_camera_world. It takes world points into the camera frame already: apply it as it is.",
    ),
    Mistake(
        "divides behind too",
        divides_behind_too,
        "You divide by depths that are negative or zero. A point behind the camera then gets a pixel that looks valid, "
        "upside down; its row must be NaN.",
    ),
    Mistake(
        "row before column",
        row_before_column,
        "You returned (v, u). A pixel is (u, v) = (column, row): u goes with X and comes first.",
    ),
    Mistake(
        "never divides",
        never_divides,
        "You did not divide by the depth Z. That is a parallel projection: far things do not get smaller.",
    ),
    Mistake(
        "ray length for depth",
        ray_length_for_depth,
        "You divided by the distance from the camera. Depth is Z in the camera frame, not the length of the ray; towards "
        "the border of the picture they differ.",
    ),
    Mistake(
        "OpenGL axes",
        opengl_axes,
        "Your camera looks along -Z with +Y up, as OpenGL's does. Ours has +Z forward and +Y down (OpenCV).",
    ),
    Mistake(
        "principal point forgotten",
        principal_point_forgotten,
        "Your pixels are counted from the principal point. Add (cx, cy), the last column of K.",
    ),
    Mistake(
        "skew forgotten",
        skew_forgotten,
        "You read fx, fy, cx, cy out of K but not its skew K[0, 1]. Multiply with the whole matrix.",
    ),
    Mistake(
        "rows dropped",
        rows_dropped,
        "You left the points behind the camera out. One row for every point: theirs is NaN, so that rows still belong "
        "together.",
    ),
)


def project_with_one_matrix(p_world: np.ndarray, T_camera_world: np.ndarray, K: np.ndarray) -> np.ndarray:
    """P = K [R | t] on homogeneous points."""
    P = K @ T_camera_world[:3]
    homogeneous = np.column_stack([p_world, np.ones(len(p_world))]) @ P.T
    uv = np.full((len(p_world), 2), np.nan)
    front = homogeneous[:, 2] > 0
    uv[front] = homogeneous[front, :2] / homogeneous[front, 2:]
    return uv


def project_point_by_point(p_world: np.ndarray, T_camera_world: np.ndarray, K: np.ndarray) -> np.ndarray:
    """Loops over the points."""
    pixels = []
    for p in p_world:
        x, y, z = T_camera_world[:3, :3] @ p + T_camera_world[:3, 3]
        if z > 0:
            u, v, _ = K @ [x / z, y / z, 1.0]
            pixels.append([u, v])
        else:
            pixels.append([np.nan, np.nan])
    return np.array(pixels).reshape(-1, 2)


# distort --------------------------------------------------------------------------------------------------------------


def tangential_swapped(xy_camera: np.ndarray, k1: float, k2: float, p1: float, p2: float) -> np.ndarray:
    """Takes p1 for p2."""
    return distortion.distort(xy_camera, k1, k2, p2, p1)


def radius_not_squared(xy_camera: np.ndarray, k1: float, k2: float, p1: float, p2: float) -> np.ndarray:
    """Uses 1 + k1 r + k2 r^2."""
    r = np.linalg.norm(xy_camera, axis=1, keepdims=True)
    tangential = distortion.distort(xy_camera, 0.0, 0.0, p1, p2) - xy_camera
    return xy_camera * (1 + k1 * r + k2 * r**2) + tangential


def tangential_forgotten(xy_camera: np.ndarray, k1: float, k2: float, p1: float, p2: float) -> np.ndarray:
    """Bends along the radius only."""
    return distortion.distort(xy_camera, k1, k2)


def divided(xy_camera: np.ndarray, k1: float, k2: float, p1: float, p2: float) -> np.ndarray:
    """Divides where it must multiply, as who takes the lens off would."""
    s = np.sum(xy_camera**2, axis=1, keepdims=True)
    return (xy_camera - (distortion.distort(xy_camera, 0.0, 0.0, p1, p2) - xy_camera)) / (1 + k1 * s + k2 * s**2)


def one_after_the_other(xy_camera: np.ndarray, k1: float, k2: float, p1: float, p2: float) -> np.ndarray:
    """Computes the tangential terms from points that the radial ones have moved."""
    return distortion.distort(distortion.distort(xy_camera, k1, k2), 0.0, 0.0, p1, p2)


def displacement_only(xy_camera: np.ndarray, k1: float, k2: float, p1: float, p2: float) -> np.ndarray:
    """Returns by how much, not to where."""
    return distortion.distort(xy_camera, k1, k2, p1, p2) - xy_camera


def fourth_power_lost(xy_camera: np.ndarray, k1: float, k2: float, p1: float, p2: float) -> np.ndarray:
    """Uses r^2 for k2 as well."""
    return distortion.distort(xy_camera, k1 + k2, 0.0, p1, p2)


DISTORT_MISTAKES = (
    Mistake(
        "p1 and p2 swapped",
        tangential_swapped,
        "You took p1 for p2. With p1 alone, x moves by 2 p1 x y and y by p1 (r^2 + 2 y^2): p1 acts along y.",
    ),
    Mistake(
        "radius not squared",
        radius_not_squared,
        "Your radial factor is 1 + k1 r + k2 r^2. It has even powers only: 1 + k1 r^2 + k2 r^4.",
    ),
    Mistake(
        "tangential forgotten",
        tangential_forgotten,
        "Your answer does not depend on p1 and p2: the tangential terms are missing.",
    ),
    Mistake(
        "the lens taken off",
        divided,
        "You divide by the radial factor, as if you took the lens off. `distort` goes from ideal to distorted points: "
        "multiply.",
    ),
    Mistake(
        "one after the other",
        one_after_the_other,
        "You compute the tangential terms from points that are bent already. All terms use the x, y and r of the ideal "
        "point.",
    ),
    Mistake(
        "displacement only",
        displacement_only,
        "You returned by how much the points move. Return where they are afterwards: add the points themselves.",
    ),
    Mistake(
        "fourth power lost",
        fourth_power_lost,
        "You multiply k2 by r^2 as you do k1. It belongs to r^4, the square of r^2.",
    ),
)


def distort_by_coordinates(xy_camera: np.ndarray, k1: float, k2: float, p1: float, p2: float) -> np.ndarray:
    """Writes x and y out, as OpenCV's documentation does."""
    x, y = xy_camera[:, 0], xy_camera[:, 1]
    r2 = x**2 + y**2
    radial = 1 + k1 * r2 + k2 * r2**2
    x_bent = x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x**2)
    y_bent = y * radial + p1 * (r2 + 2 * y**2) + 2 * p2 * x * y
    return np.column_stack([x_bent, y_bent])


def distort_in_the_complex_plane(xy_camera: np.ndarray, k1: float, k2: float, p1: float, p2: float) -> np.ndarray:
    """Uses z = x + iy and q = p2 + i p1: z g + 2 Re(conj(q) z) z + q |z|^2."""
    z, q = xy_camera[:, 0] + 1j * xy_camera[:, 1], p2 + 1j * p1
    s = (z * z.conj()).real
    bent = z * (1 + k1 * s + k2 * s * s) + 2 * (q.conjugate() * z).real * z + q * s
    return np.stack([bent.real, bent.imag], axis=1)


# camera_center --------------------------------------------------------------------------------------------------------


def translation_itself(T_camera_world: np.ndarray) -> np.ndarray:
    """Takes t for the centre."""
    return T_camera_world[:3, 3].copy()


def translation_negated(T_camera_world: np.ndarray) -> np.ndarray:
    """Takes -t for the centre."""
    return -T_camera_world[:3, 3]


def center_turned_forwards(T_camera_world: np.ndarray) -> np.ndarray:
    """Returns -R t."""
    return -T_camera_world[:3, :3] @ T_camera_world[:3, 3]


def center_sign_forgotten(T_camera_world: np.ndarray) -> np.ndarray:
    """Returns R^T t."""
    return T_camera_world[:3, :3].T @ T_camera_world[:3, 3]


CENTER_MISTAKES = (
    Mistake(
        "t for the centre",
        translation_itself,
        "You returned t. That is where the world's origin is in the camera frame, not where the camera is in the world: "
        "C = -R^T t.",
    ),
    Mistake(
        "-t for the centre",
        translation_negated,
        "You returned -t, which still has camera axes. Turn it into the world: C = -R^T t.",
    ),
    Mistake(
        "turned forwards",
        center_turned_forwards,
        "You returned -R t. R takes world axes to camera axes; t is in camera axes and must go back: use R^T.",
    ),
    Mistake(
        "sign forgotten",
        center_sign_forgotten,
        "You returned R^T t: the sign is missing. R C + t = 0 gives C = -R^T t.",
    ),
)


def center_by_inverse(T_camera_world: np.ndarray) -> np.ndarray:
    """Reads it off T_world_camera: the camera's origin, in the world."""
    return np.linalg.inv(T_camera_world)[:3, 3]


def center_by_solving(T_camera_world: np.ndarray) -> np.ndarray:
    """Solves R C + t = 0."""
    return np.linalg.solve(T_camera_world[:3, :3], -T_camera_world[:3, 3])
