"""The exercises of this lesson: turn about an axis, multiply Euler angles."""

from collections.abc import Iterator

import numpy as np

from workbench.exercise import HiddenSeed
from workbench.geometry.motions import exp_so3, motion

# seeds of what a student sees run, and of what only a grader does
STUDENTS = 11
GRADERS = HiddenSeed(7310)


def some_motions(seed: int, n: int = 5) -> Iterator[np.ndarray]:
    """Yield motions that turn by 20 to 160 degrees and shift by half a metre to two."""
    rng = np.random.default_rng(seed)
    for _ in range(n):
        axis, shift = rng.normal(size=(2, 3))
        w = axis / np.linalg.norm(axis) * np.radians(rng.uniform(20, 160))
        yield motion(exp_so3(w), shift / np.linalg.norm(shift) * rng.uniform(0.5, 2.0))
