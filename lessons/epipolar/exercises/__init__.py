"""The exercises of this lesson: F from eight points, motions from E, and points from two pixels
each.
"""

from dataclasses import dataclass

import numpy as np

from workbench.exercise import HiddenSeed
from workbench.geometry.cameras import intrinsics
from workbench.geometry.motions import apply, exp_so3, motion

# seeds of what a student sees run, and of what only a grader does
STUDENTS = 67
GRADERS = HiddenSeed(9127)


@dataclass(frozen=True, eq=False, kw_only=True)
class Pair:
    """Two cameras before a cloud of points: pixels with noise, and without."""

    K_first: np.ndarray
    K_second: np.ndarray
    T_second_first: np.ndarray
    p_first: np.ndarray
    uv_first: np.ndarray
    uv_second: np.ndarray
    clean_first: np.ndarray
    clean_second: np.ndarray


def a_pair(seed: int, n: int = 60, sigma: float = 1.0, *, ahead: float = 0.3) -> Pair:
    """Return a pair of 1024 x 683 pixels; the second camera stands 1 m to the right and by chance
    up to so much ahead.
    """
    rng = np.random.default_rng(seed)
    p_first = np.column_stack([rng.uniform(-3, 3, n), rng.uniform(-2, 2, n), rng.uniform(6, 12, n)])
    p_center = np.array([1.0, *rng.uniform(-0.2, 0.2, 1), rng.uniform(-ahead, ahead)])
    R = exp_so3(np.array([0.0, 0.1, 0.02]) + rng.normal(size=3) * 0.03)
    T_second_first = motion(R, -R @ p_center)
    K_first = intrinsics(900.0, 512.0, 341.0)
    K_second = intrinsics(880.0, 500.0, 350.0, fy=885.0)
    clean = [
        pixels_of(K, p) for K, p in ((K_first, p_first), (K_second, apply(T_second_first, p_first)))
    ]
    noisy = [uv + sigma * rng.normal(size=uv.shape) for uv in clean]
    return Pair(
        K_first=K_first,
        K_second=K_second,
        T_second_first=T_second_first,
        p_first=p_first,
        uv_first=noisy[0],
        uv_second=noisy[1],
        clean_first=clean[0],
        clean_second=clean[1],
    )


def pixels_of(K: np.ndarray, p_camera: np.ndarray) -> np.ndarray:
    """Return where a camera sees points of its own frame."""
    uvw = p_camera @ K.T
    return uvw[:, :2] / uvw[:, 2:]


def homogeneous(uv: np.ndarray) -> np.ndarray:
    """Return pixels with a third coordinate 1."""
    return np.column_stack([uv, np.ones(len(uv))])
