"""The exercises of this lesson: a pose from three lengths, the choice among poses, and a step that
refines one.
"""

import numpy as np

from workbench.exercise import HiddenSeed
from workbench.geometry.motions import apply, exp_so3, inverse, motion

# seeds of what a student sees run, and of what only a grader does
STUDENTS = 47
GRADERS = HiddenSeed(5310)


def a_view(
    rng: np.random.Generator, n: int, *, aside: float = 0.0, flat: bool = False
) -> tuple[np.ndarray, ...]:
    """Return T_camera_world, n points before that camera and where it sees them; `aside`: how far
    off the origin is.
    """
    p_camera = rng.uniform([-1.5, -1.2, 4.0], [1.5, 1.2, 7.0], (n, 3))
    if flat:
        p = rng.uniform(-1.0, 1.0, (n, 3)) * [1.0, 1.0, 0.0]
        p_camera = p @ exp_so3(np.array([2.6, 0.5, 0.3])).T + [0.1, -0.2, 5.0]
    R = exp_so3(1.5 * rng.standard_normal(3))
    T_camera_world = motion(
        R, p_camera.mean(axis=0) - R @ (aside * np.array([0.8, -0.6, 0.1]) + rng.normal(size=3))
    )
    return (
        T_camera_world,
        apply(inverse(T_camera_world), p_camera),
        p_camera[:, :2] / p_camera[:, 2:],
    )
