"""Write the pinhole camera without a lens: from points in the world to pixels. The lesson lays your
pixels in orange over the true photograph, so a mistake is seen where it is made.
"""

from collections.abc import Iterator

import numpy as np
from jaxtyping import Float

from lessons.pinhole.exercises import STUDENTS
from workbench.exercise import (
    Function,
    Verdict,
    against,
    alternative,
    band,
    beside,
    check,
    contract,
    fail,
    left_alone,
    mistake,
    number,
    worst,
)
from workbench.geometry.cameras import pinhole as cameras
from workbench.geometry.motions import apply, inverse


@contract(
    slot="project",
    examples=(
        (
            (
                "project(np.array([[1.0, 0.5, 2]]), np.eye(4), np.array([[500.0, 0, 320], [0, 500,"
                " 240], [0, 0, 1]]))"
            ),
            "[[570, 365]]",
        ),
        (
            (
                "project(np.array([[1.0, 0, -2]]), np.eye(4), np.array([[500.0, 0, 320], [0, 500,"
                " 240], [0, 0, 1]]))"
            ),
            "[[nan, nan]]",
        ),
    ),
)
def project(
    p_world: Float[np.ndarray, "n 3"],
    T_camera_world: Float[np.ndarray, "4 4"],
    K: Float[np.ndarray, "3 3"],
) -> Float[np.ndarray, "n 2"]:
    """Return the pixels (u, v) = (column, row) at which a pinhole camera sees the points.

    The camera frame has +X right, +Y down, +Z forward (OpenCV's axes).

    Args:
        p_world: Points in the world, metres, one per row; there may be none (n = 0).
        T_camera_world: The motion that takes world points into the camera frame, metres.
        K: Intrinsics in pixels, [[fx, skew, cx], [0, fy, cy], [0, 0, 1]].

    Returns:
        One row per point, in the same order, also outside the picture. A row is NaN where the
        point's depth Z in the camera frame is zero or negative: the camera does not see what lies
        beside or behind it.
    """
    return cameras.project(p_world, T_camera_world, K)


PROJECT_HINT = "World to camera frame, divide by the depth Z, then K."


def some_scenes(
    seed: int, n: int = 4, size: int = 40
) -> Iterator[tuple[np.ndarray, np.ndarray, np.ndarray]]:
    """Yield points, a camera that looks at them from 4 to 7 m, and its K with a principal point off
    the middle.
    """
    rng = np.random.default_rng(seed)
    for _ in range(n):
        eye = rng.normal(size=3)
        T_camera_world = cameras.look_at(
            eye / np.linalg.norm(eye) * rng.uniform(4, 7), rng.uniform(-0.3, 0.3, 3)
        )
        K = cameras.intrinsics(rng.uniform(400, 900), rng.uniform(150, 250), rng.uniform(300, 400))
        yield rng.uniform(-1.5, 1.5, (size, 3)), T_camera_world, K


def in_pixels(uv: np.ndarray, right: np.ndarray, hint: str) -> Verdict:
    """Judge pixels by the largest distance to the right ones; a row that should be NaN and is not,
    or the reverse, fails.
    """
    seen = np.isfinite(right).all(axis=1)
    given = np.isfinite(uv).all(axis=1)
    unknown = np.isnan(uv).all(axis=1)
    if (lost := np.flatnonzero(seen & ~given)).size:
        k = lost[0]
        told = f"Row {k} is {against(uv[k], right[k])}. {hint}"
        return fail(
            f"{lost.size} of {seen.sum()} points in front of the camera got no pixel. {told}"
        )
    if (false := np.flatnonzero(~seen & ~unknown)).size:
        message = (
            f"{false.size} of {(~seen).sum()} points at or behind the camera got a row that is not"
            " NaN."
        )
        return fail(
            f"{message} Row {false[0]} is {number(uv[false[0]])}, right is (nan, nan). {hint}"
        )
    error = float(np.linalg.norm(uv[seen] - right[seen], axis=1).max(initial=0.0))
    return band(
        "Largest pixel error", error, "px", good=0.01, fair=1.0, hint=beside(uv, right, hint)
    )


@check(1)
def principal_point(candidate: Function) -> Verdict:
    """A point on the optical axis is seen at the principal point, at any depth."""
    K = cameras.intrinsics(500.0, 310.0, 245.0)
    p = np.array([[0.0, 0.0, 0.5], [0.0, 0.0, 4.0], [0.0, 0.0, 90.0]])
    return in_pixels(candidate(p, np.eye(4), K), np.tile([310.0, 245.0], (3, 1)), PROJECT_HINT)


@check(2)
def right_pixels(candidate: Function) -> Verdict:
    """Points in front of cameras all around are seen at the right pixels."""
    return worst(
        in_pixels(candidate(*scene), cameras.project(*scene), PROJECT_HINT)
        for scene in some_scenes(STUDENTS)
    )


@check(2)
def not_behind(candidate: Function) -> Verdict:
    """Points at or behind the camera get NaN, and the others keep their rows."""
    p = np.array(
        [[0.5, 0.2, 3.0], [0.5, 0.2, -3.0], [1.0, 1.0, 0.0], [-0.4, 0.1, 0.01], [0.0, 0.0, 0.0]]
    )
    K = cameras.intrinsics(500.0, 310.0, 245.0)
    hint = f"Two of these five have a positive depth. {PROJECT_HINT}"
    return in_pixels(candidate(p, np.eye(4), K), cameras.project(p, np.eye(4), K), hint)


@check(1)
def scene_is_left_alone(candidate: Function) -> Verdict:
    """Points, motion and K are not changed."""
    scene = next(some_scenes(STUDENTS + 1))
    return left_alone(
        candidate, in_pixels(candidate(*scene), cameras.project(*scene), PROJECT_HINT)
    )


@mistake(
    "You used the inverse of T_camera_world. It takes world points into the camera frame already:"
    " apply it as it is."
)
def motion_inverted(p_world: np.ndarray, T_camera_world: np.ndarray, K: np.ndarray) -> np.ndarray:
    """Takes camera-to-world for world-to-camera."""
    return cameras.project(p_world, inverse(T_camera_world), K)


@mistake(
    "You divide by depths that are negative or zero. A point behind the camera then gets a pixel"
    " that looks valid, upside down; its row must be NaN."
)
def divides_behind_too(
    p_world: np.ndarray, T_camera_world: np.ndarray, K: np.ndarray
) -> np.ndarray:
    """Divides by the depth whatever its sign."""
    x, y, w = K @ apply(T_camera_world, p_world).T
    return np.stack([x / w, y / w], axis=1)


@mistake("You returned (v, u). A pixel is (u, v) = (column, row): u goes with X and comes first.")
def row_before_column(p_world: np.ndarray, T_camera_world: np.ndarray, K: np.ndarray) -> np.ndarray:
    """Returns (v, u)."""
    return cameras.project(p_world, T_camera_world, K)[:, ::-1].copy()


@mistake(
    "You did not divide by the depth Z. That is a parallel projection: far things do not get"
    " smaller."
)
def never_divides(p_world: np.ndarray, T_camera_world: np.ndarray, K: np.ndarray) -> np.ndarray:
    """Leaves the depth out."""
    p_camera = apply(T_camera_world, p_world)
    uv = p_camera[:, :2] @ K[:2, :2].T + K[:2, 2]
    uv[p_camera[:, 2] <= 0] = np.nan
    return uv


@mistake(
    "You divided by the distance from the camera. Depth is Z in the camera frame, not the length of"
    " the ray; towards the border of the picture they differ."
)
def ray_length_for_depth(
    p_world: np.ndarray, T_camera_world: np.ndarray, K: np.ndarray
) -> np.ndarray:
    """Divides by the distance from the camera."""
    p_camera = apply(T_camera_world, p_world)
    uv = p_camera[:, :2] / np.linalg.norm(p_camera, axis=1, keepdims=True) @ K[:2, :2].T + K[:2, 2]
    uv[p_camera[:, 2] <= 0] = np.nan
    return uv


@mistake(
    "Your camera looks along -Z with +Y up, as OpenGL's does. Ours has +Z forward and +Y down"
    " (OpenCV)."
)
def opengl_axes(p_world: np.ndarray, T_camera_world: np.ndarray, K: np.ndarray) -> np.ndarray:
    """Takes the camera to look along -Z with +Y up."""
    return cameras.project(p_world, cameras.OPENGL_FROM_OPENCV @ T_camera_world, K)


@mistake("Your pixels are counted from the principal point. Add (cx, cy), the last column of K.")
def principal_point_forgotten(
    p_world: np.ndarray, T_camera_world: np.ndarray, K: np.ndarray
) -> np.ndarray:
    """Scales with the focal lengths only."""
    return cameras.project(p_world, T_camera_world, K) - K[:2, 2]


@mistake(
    "You read fx, fy, cx, cy out of K but not its skew K[0, 1]. Multiply with the whole matrix."
)
def skew_forgotten(p_world: np.ndarray, T_camera_world: np.ndarray, K: np.ndarray) -> np.ndarray:
    """Reads fx, fy, cx and cy out of K, and no more."""
    return cameras.project(
        p_world, T_camera_world, cameras.intrinsics(K[0, 0], K[0, 2], K[1, 2], fy=K[1, 1])
    )


@mistake(
    "You left the points behind the camera out. One row for every point: theirs is NaN, so that"
    " rows still belong together."
)
def rows_dropped(p_world: np.ndarray, T_camera_world: np.ndarray, K: np.ndarray) -> np.ndarray:
    """Leaves the points behind the camera out of the answer."""
    uv = cameras.project(p_world, T_camera_world, K)
    return uv[np.isfinite(uv).all(axis=1)]


@alternative
def project_with_one_matrix(
    p_world: np.ndarray, T_camera_world: np.ndarray, K: np.ndarray
) -> np.ndarray:
    """P = K [R | t] on homogeneous points."""
    P = K @ T_camera_world[:3]
    homogeneous = np.column_stack([p_world, np.ones(len(p_world))]) @ P.T
    uv = np.full((len(p_world), 2), np.nan)
    front = homogeneous[:, 2] > 0
    uv[front] = homogeneous[front, :2] / homogeneous[front, 2:]
    return uv


@alternative
def project_point_by_point(
    p_world: np.ndarray, T_camera_world: np.ndarray, K: np.ndarray
) -> np.ndarray:
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
