"""Polylines as the segments they are drawn with."""

import numpy as np
from jaxtyping import Float


def segments(p: Float[np.ndarray, "n d"], *, closed: bool = False) -> Float[np.ndarray, "m 2 d"]:
    """Return the segments from each point to the next, and where the line is closed from the last to the first."""
    if closed:
        return np.stack([p, np.roll(p, -1, axis=0)], axis=1)
    return np.stack([p[:-1], p[1:]], axis=1)


def fan(corners: int) -> np.ndarray:
    """Return the triangles (n - 2, 3) of a convex polygon with so many corners, all from the first."""
    k = np.arange(1, corners - 1)
    return np.column_stack([np.zeros_like(k), k, k + 1])
