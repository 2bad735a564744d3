"""The exercises of this lesson: two rows of a view, its pose, and what is called the error."""

import numpy as np

from workbench.exercise import HiddenSeed, Verdict, against, fail, full, partial
from workbench.geometry.cameras import intrinsics
from workbench.geometry.motions import exp_so3, motion

# seeds of what a student sees run, and of what only a grader does
STUDENTS = 41
GRADERS = HiddenSeed(8527)
CAMERA = intrinsics(536.0, 342.0, 236.0, fy=541.0)


def views(seed: int, count: int = 3, noise: float = 0.0) -> list[tuple[np.ndarray, np.ndarray]]:
    """Return poses T_camera_board of a board some decimetres away, and its homographies, of any
    scale and sign.
    """
    rng = np.random.default_rng(seed)
    pairs = []
    for k in range(count):
        R = exp_so3(rng.uniform(-0.7, 0.7, 3))
        T = motion(R, np.array([*rng.uniform(-0.15, 0.15, 2), rng.uniform(0.3, 0.9)]))
        H = CAMERA @ T[:3, [0, 1, 3]] * rng.uniform(0.2, 5.0) * (-1) ** k
        pairs.append((T, H * (1 + noise * rng.normal(size=(3, 3)))))
    return pairs


def rows_verdict(got: np.ndarray, right: np.ndarray, hint: str, label: str = "") -> Verdict:
    """Judge rows by the entry that is farthest off, as a share of its row's length."""
    size = np.linalg.norm(right, axis=1, keepdims=True)
    off = np.where(np.isfinite(got), np.abs(got - right) / size, np.inf)
    if off.max() <= 1e-6:
        return full(f"{label}all {got.size} entries are right.")
    i, j = np.unravel_index(np.argmax(off), off.shape)
    message = f"{label}entry [{i}, {j}] is {against(got[i, j], right[i, j], 5)}."
    return (
        partial(0.5, f"{message} Close. {hint}") if off.max() <= 1e-4 else fail(f"{message} {hint}")
    )
