"""Clouds that no turn takes to themselves, and random turns: what exercises about alignment
draw.
"""

import numpy as np
from jaxtyping import Float

from workbench.geometry.motions import exp_so3


def a_rotation(rng: np.random.Generator) -> Float[np.ndarray, "3 3"]:
    """Return a rotation by up to half a turn about a random axis."""
    axis = rng.normal(size=3)
    return exp_so3(rng.uniform(0.3, 3.1) * axis / np.linalg.norm(axis))


def a_lopsided_cloud(
    rng: np.random.Generator, n: int = 200, *, mirrored: bool = False
) -> Float[np.ndarray, "n 3"]:
    """Return points with a long tail along each of three slanted directions, aside from the origin.

    Args:
        rng: Draws everything.
        n: How many.
        mirrored: Whether the three tails make a left-handed frame.
    """
    along = (rng.gamma(1.5, 1.0, (n, 3)) - 1.5) * [0.5, 0.3, 0.17]
    along[:, 2] *= -1.0 if mirrored else 1.0
    return along @ a_rotation(rng).T + rng.uniform(-1.0, 1.0, 3)
