"""The outline of a photographed animal as points in order.

Source: the horse is that of scikit-image's test pictures, https://scikit-image.org (public domain).
"""

import functools

import numpy as np
from jaxtyping import Float

from workbench.data.files import shipped_image
from workbench.geometry.fields.marching import closed_lines, marching_squares


@functools.lru_cache(maxsize=4)
def horse(count: int, reach: float) -> Float[np.ndarray, "n 2"]:
    """Return points evenly along the outline of scikit-image's horse, about their middle, upright.

    Args:
        count: How many.
        reach: The largest coordinate, metres.
    """
    low, high, segments = marching_squares(shipped_image("horse.png")[..., 0] < 128)
    line = max(closed_lines(segments), key=len)[::-1]
    outline = (low + high)[line] / 2.0
    lowest = np.lexsort(outline.T[::-1])[-1]
    outline = np.roll(outline, -lowest, axis=0)[[*range(len(outline)), 0], ::-1] * [1.0, -1.0]
    along = np.r_[0.0, np.cumsum(np.linalg.norm(np.diff(outline, axis=0), axis=1))]
    at = np.linspace(0.0, along[-1], count, endpoint=False)
    p = np.column_stack([np.interp(at, along, outline[:, k]) for k in range(2)])
    p = p - p.mean(axis=0)
    return p * (reach / np.abs(p).max())
