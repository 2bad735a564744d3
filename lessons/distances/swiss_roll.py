"""A sheet that is rolled up: points of it, and where they lie once it is unrolled.

Reference: Tenenbaum, de Silva and Langford, A global geometric framework for nonlinear
dimensionality reduction, Science 290, 2000, figure 3.
"""

import numpy as np
from jaxtyping import Float

FIRST, LAST = 1.5 * np.pi, 4.5 * np.pi  # how far it is turned at its inner and outer end, radians
HEIGHT = 21.0  # of the sheet, in the unit of the spiral r = t


def swiss_roll(
    count: int, rng: np.random.Generator
) -> tuple[Float[np.ndarray, "{count} 3"], Float[np.ndarray, "{count} 2"]]:
    """Return points of a roll one metre in radius about the z axis, and their places on the flat
    sheet, metres.

    Distances along the roll are those on the sheet. The points are even in the angle, so denser
    inside.
    """
    t = FIRST + (LAST - FIRST) * rng.random(count)
    z = HEIGHT * (rng.random(count) - 0.5)
    p = np.column_stack([t * np.cos(t), t * np.sin(t), z])
    return p / LAST, np.column_stack([_along(t), z]) / LAST


def rolled(sheet: Float[np.ndarray, "n 2"]) -> Float[np.ndarray, "n 3"]:
    """Return where places on the flat sheet lie on the roll, metres; the way back from
    `swiss_roll`.
    """
    angles = np.linspace(0.0, 1.1 * LAST, 4000)
    t = np.interp(sheet[:, 0] * LAST, _along(angles), angles)
    return np.column_stack([t * np.cos(t) / LAST, t * np.sin(t) / LAST, sheet[:, 1]])


def _along(t: np.ndarray) -> np.ndarray:
    """Return the length of the spiral r = t from its centre."""
    return (t * np.sqrt(1 + t * t) + np.arcsinh(t)) / 2
