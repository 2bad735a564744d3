"""The exercises of this lesson: depth from disparity, the costs of all shifts, and the shift that wins."""

import numpy as np

from workbench.exercise import HiddenSeed

STUDENTS, GRADERS = 31, HiddenSeed(9241)  # seeds of what a student sees run, and of what only a grader does


Pair = tuple[np.ndarray, np.ndarray]


def textures(seed: int, h: int = 12, w: int = 20, shift: int = 4) -> Pair:
    """Return two noisy pictures; what the left one shows in column x is in column x - shift of the right one."""
    rng = np.random.default_rng(seed)
    scene = rng.uniform(10.0, 240.0, (h, w + shift))
    return scene[:, :w] + rng.normal(0, 3, (h, w)), scene[:, shift:] + rng.normal(0, 3, (h, w))
