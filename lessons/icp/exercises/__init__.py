"""The exercises of this lesson: find partners, align pairs, step towards planes. All judged in
degrees and metres.
"""

import numpy as np

from workbench.exercise import HiddenSeed
from workbench.geometry.motions import exp_so3, motion

# seeds of what a student sees run, and of what only a grader does
STUDENTS = 37
GRADERS = HiddenSeed(8620)


def a_motion(rng: np.random.Generator, degrees: float, metres: float = 1.0) -> np.ndarray:
    """Return a motion that turns by this angle about a random axis."""
    axis, shift = rng.normal(size=(2, 3))
    turn, way = axis / np.linalg.norm(axis), shift / np.linalg.norm(shift)
    return motion(exp_so3(np.radians(degrees) * turn), metres * way)
