"""Write the pose of a camera from the lengths of three rays. The lesson solves a quartic for the
lengths and takes each possible camera from you: watch where yours stand, and whether they see the
three points where they were seen.
"""

import numpy as np
from jaxtyping import Float

from lessons.pose.exercises import STUDENTS, a_view
from workbench.algorithms.cameras import camera_search
from workbench.exercise import (
    Function,
    Verdict,
    alternative,
    check,
    contract,
    left_alone,
    mistake,
    motion_verdict,
    worst,
)
from workbench.geometry.cameras.three_points import motions_from_lengths, unit_rays
from workbench.geometry.motions import inverse, motion
from workbench.geometry.motions.alignment import align_rigid


@contract(
    slot="pose_from_distances",
    forbid=("scipy.spatial.transform",),
    examples=(
        (
            "pose_from_distances(np.eye(3), np.eye(3), np.ones(3))",
            "[[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]",
        ),
        (
            "pose_from_distances(np.eye(3), np.eye(3)[[1, 2, 0]], np.ones(3))",
            "[[0, 0, 1, 0], [1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 0, 1]]",
        ),
    ),
)
def pose_from_distances(
    p_world: Float[np.ndarray, "3 3"],
    rays: Float[np.ndarray, "3 3"],
    distances: Float[np.ndarray, "3"],
) -> Float[np.ndarray, "4 4"]:
    """Return the T_camera_world that takes three points to the ends of their rays.

    Args:
        p_world: The points, one a row, metres; not on one line.
        rays: The unit vectors, in the camera's frame, on which they are seen, row by row.
        distances: How far along its ray each point is, metres. They fit: the ends of the rays are
            as far apart as the points are.

    Returns:
        A rotation and a translation, 4x4, with determinant +1.
    """
    return camera_search.pose_from_distances(p_world, rays, distances)


HINT = (
    "The ends of the rays are distances times rays. Find R, t with R p_world + t = ends, and det R"
    " = +1."
)


def judged(candidate: Function, seeds: range, aside: float = 0.0) -> Verdict:
    """Judge the poses of some cameras."""
    verdicts = []
    for seed in seeds:
        T, p_world, xy = a_view(np.random.default_rng(seed), 3, aside=aside)
        rays = unit_rays(xy)
        distances = np.linalg.norm(p_world @ T[:3, :3].T + T[:3, 3], axis=1)
        verdicts.append(motion_verdict(candidate(p_world, rays, distances), T, HINT, p=p_world))
    return worst(verdicts)


@check(2)
def one_camera(candidate: Function) -> Verdict:
    """A camera is found from three exact lengths."""
    return judged(candidate, range(STUDENTS, STUDENTS + 1))


@check(3)
def many_cameras(candidate: Function) -> Verdict:
    """So are twelve others, none of them mirrored."""
    return judged(candidate, range(STUDENTS + 1, STUDENTS + 13))


@check(1)
def inputs_are_left_alone(candidate: Function) -> Verdict:
    """The points, rays and distances that come in are not changed."""
    return left_alone(candidate, judged(candidate, range(STUDENTS + 20, STUDENTS + 21)))


def kabsch(p: np.ndarray, q: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return U and Vt of the covariance of q with p, and the signs that make a rotation of them."""
    U, _, Vt = np.linalg.svd((q - q.mean(axis=0)).T @ (p - p.mean(axis=0)))
    return U, Vt, np.array([1.0, 1.0, np.linalg.det(U @ Vt)])


@mistake(
    "Your camera is mirrored in about half of the cases. Three points are flat, so the SVD may"
    " reflect: fix det R = +1."
)
def without_determinant(p_world: np.ndarray, rays: np.ndarray, distances: np.ndarray) -> np.ndarray:
    """Leaves the sign to chance."""
    q = distances[:, None] * rays
    U, Vt, _ = kabsch(p_world, q)
    return motion(U @ Vt, q.mean(axis=0) - U @ Vt @ p_world.mean(axis=0))


@mistake(
    "You returned camera-to-world, T_world_camera. Asked for is T_camera_world, which takes world"
    " points to the camera."
)
def inverted(p_world: np.ndarray, rays: np.ndarray, distances: np.ndarray) -> np.ndarray:
    """Aligns the other way round."""
    return inverse(align_rigid(distances[:, None] * rays, p_world))


@mistake(
    "You took the distances for depths Z. They are measured along the rays: the points are"
    " distances times unit rays."
)
def lengths_as_depths(p_world: np.ndarray, rays: np.ndarray, distances: np.ndarray) -> np.ndarray:
    """Divides the rays by their z."""
    return align_rigid(distances[:, None] * rays / rays[:, 2:], p_world)


@mistake(
    "You left the distances out: the rays' unit vectors are not yet the points. Multiply each by"
    " its distance."
)
def without_distances(p_world: np.ndarray, rays: np.ndarray, distances: np.ndarray) -> np.ndarray:
    """Aligns with the unit vectors."""
    return align_rigid(rays, p_world)


@mistake(
    "Your rotation is right, your translation is not: t = mean of the ends − R (mean of p_world),"
    " and you left out R."
)
def translation_not_turned(
    p_world: np.ndarray, rays: np.ndarray, distances: np.ndarray
) -> np.ndarray:
    """Subtracts the means as they are."""
    q = distances[:, None] * rays
    T = align_rigid(q, p_world)
    return motion(T[:3, :3], q.mean(axis=0) - p_world.mean(axis=0))


@mistake(
    "Your rotation is the inverse of the right one, though the translation uses it as if it were"
    " not. Mind UVᵀ and VUᵀ."
)
def rotation_transposed(p_world: np.ndarray, rays: np.ndarray, distances: np.ndarray) -> np.ndarray:
    """Transposes the rotation, and puts the middle where it belongs."""
    q = distances[:, None] * rays
    R = align_rigid(q, p_world)[:3, :3].T
    return motion(R, q.mean(axis=0) - R @ p_world.mean(axis=0))


@alternative
def by_svd(p_world: np.ndarray, rays: np.ndarray, distances: np.ndarray) -> np.ndarray:
    """Kabsch's way, written out."""
    q = distances[:, None] * rays
    U, _, Vt = np.linalg.svd((q - q.mean(axis=0)).T @ (p_world - p_world.mean(axis=0)))
    T = np.eye(4)
    T[:3, :3] = U @ np.diag([1.0, 1.0, np.linalg.det(U @ Vt)]) @ Vt
    T[:3, 3] = q.mean(axis=0) - T[:3, :3] @ p_world.mean(axis=0)
    return T


@alternative
def by_frames(p_world: np.ndarray, rays: np.ndarray, distances: np.ndarray) -> np.ndarray:
    """Puts a frame along the sides of both triangles."""
    return motions_from_lengths(p_world[None], rays[None], distances[None])[0]
