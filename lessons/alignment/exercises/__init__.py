"""The exercises of this lesson: axes, their signs, and the scale of pairs. Judged in degrees, signs
and per cent.
"""

import numpy as np

from workbench.exercise import HiddenSeed
from workbench.geometry.motions import exp_so3

STUDENTS, GRADERS = (
    53,
    HiddenSeed(7310),
)  # seeds of what a student sees run, and of what only a grader does


def a_rotation(rng: np.random.Generator) -> np.ndarray:
    """Return a rotation by up to half a turn about a random axis."""
    axis = rng.normal(size=3)
    return exp_so3(rng.uniform(0.3, 3.1) * axis / np.linalg.norm(axis))


def a_lopsided_cloud(
    rng: np.random.Generator, n: int = 200, *, mirrored: bool = False
) -> np.ndarray:
    """Return points with a long tail along each of three slanted directions, aside from the origin.

    Args:
        rng: Draws everything.
        n: How many.
        mirrored: Whether the three tails make a left-handed frame.
    """
    along = (rng.gamma(1.5, 1.0, (n, 3)) - 1.5) * [0.5, 0.3, 0.17]
    along[:, 2] *= -1.0 if mirrored else 1.0
    return along @ a_rotation(rng).T + rng.uniform(-1.0, 1.0, 3)
