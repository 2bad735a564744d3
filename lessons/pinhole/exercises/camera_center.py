"""Write where a camera is in the world, given the motion from world to camera. The lesson's last
step sends the rays back into the scene from there.
"""

from collections.abc import Iterator

import numpy as np
from jaxtyping import Float

from lessons.pinhole.exercises import STUDENTS
from workbench.exercise import (
    Function,
    Verdict,
    alternative,
    band,
    beside,
    check,
    contract,
    left_alone,
    mistake,
    worst,
)
from workbench.geometry.cameras import pinhole as cameras


@contract(
    slot="camera_center",
    examples=(
        (
            "camera_center(np.array([[1.0, 0, 0, 2], [0, 1, 0, 0], [0, 0, 1, 5], [0, 0, 0, 1]]))",
            "[-2, 0, -5]",
        ),
        (
            "camera_center(np.array([[0.0, -1, 0, 2], [1, 0, 0, 5], [0, 0, 1, 0], [0, 0, 0, 1]]))",
            "[-5, 2, 0]",
        ),
    ),
)
def camera_center(T_camera_world: Float[np.ndarray, "4 4"]) -> Float[np.ndarray, "3"]:
    """Return where the camera is in the world, metres.

    Args:
        T_camera_world: The rigid motion that takes world points into the camera frame: p_camera = R
            p_world + t, metres. It may be the identity.

    Returns:
        The one world point that the motion takes to the camera's own origin, in a new array.
    """
    return cameras.camera_center(T_camera_world)


CENTER_HINT = "Solve 0 = R C + t for C."


def some_cameras(seed: int, n: int = 5) -> Iterator[tuple[np.ndarray, np.ndarray]]:
    """Yield where cameras are and their motions; no two axes of world and camera agree."""
    rng = np.random.default_rng(seed)
    for _ in range(n):
        eye = rng.normal(size=3)
        eye *= rng.uniform(2, 8) / np.linalg.norm(eye)
        yield eye, cameras.look_at(eye, rng.uniform(-1, 1, 3), rng.normal(size=3))


def placed(got: np.ndarray, right: np.ndarray, name: str = "C") -> Verdict:
    """Judge a camera's place by the distance to the right one."""
    error = float(np.linalg.norm(got - right))
    return band(
        "Camera is off by",
        error,
        "m",
        good=1e-3,
        fair=2e-2,
        hint=beside(got, right, CENTER_HINT, name),
    )


@check(2)
def where_it_stands(candidate: Function) -> Verdict:
    """Cameras that were put at known places are found there."""
    return worst(
        placed(candidate(T_camera_world), eye) for eye, T_camera_world in some_cameras(STUDENTS)
    )


@check(2)
def goes_to_the_origin(candidate: Function) -> Verdict:
    """The motion takes the centre to the camera's origin."""
    verdicts = []
    for _, T_camera_world in some_cameras(STUDENTS + 1):
        p_camera = T_camera_world[:3, :3] @ candidate(T_camera_world) + T_camera_world[:3, 3]
        verdicts.append(placed(p_camera, np.zeros(3), "R C + t"))
    return worst(verdicts)


@check(1)
def camera_is_left_alone(candidate: Function) -> Verdict:
    """The motion that comes in is not changed."""
    eye, T_camera_world = next(some_cameras(STUDENTS + 2))
    return left_alone(candidate, placed(candidate(T_camera_world), eye))


@mistake(
    "You returned t. That is where the world's origin is in the camera frame, not where the camera"
    " is in the world: C = -R^T t."
)
def t_for_the_centre(T_camera_world: np.ndarray) -> np.ndarray:
    """Takes t for the centre."""
    return T_camera_world[:3, 3].copy()


@mistake("You returned -t, which still has camera axes. Turn it into the world: C = -R^T t.")
def minus_t_for_the_centre(T_camera_world: np.ndarray) -> np.ndarray:
    """Takes -t for the centre."""
    return -T_camera_world[:3, 3]


@mistake(
    "You returned -R t. R takes world axes to camera axes; t is in camera axes and must go back:"
    " use R^T."
)
def turned_forwards(T_camera_world: np.ndarray) -> np.ndarray:
    """Returns -R t."""
    return -T_camera_world[:3, :3] @ T_camera_world[:3, 3]


@mistake("You returned R^T t: the sign is missing. R C + t = 0 gives C = -R^T t.")
def sign_forgotten(T_camera_world: np.ndarray) -> np.ndarray:
    """Returns R^T t."""
    return T_camera_world[:3, :3].T @ T_camera_world[:3, 3]


@alternative
def center_by_inverse(T_camera_world: np.ndarray) -> np.ndarray:
    """Reads it off T_world_camera: the camera's origin, in the world."""
    return np.linalg.inv(T_camera_world)[:3, 3]


@alternative
def center_by_solving(T_camera_world: np.ndarray) -> np.ndarray:
    """Solves R C + t = 0."""
    return np.linalg.solve(T_camera_world[:3, :3], -T_camera_world[:3, 3])
