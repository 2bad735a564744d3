"""The outline of a photographed animal as points in order.

Source: the horse is that of scikit-image's test pictures, https://scikit-image.org (public domain).
"""

import functools

import numpy as np
from jaxtyping import Float

from workbench.data.files import shipped_image


@functools.lru_cache(maxsize=4)
def horse(count: int, reach: float) -> Float[np.ndarray, "n 2"]:
    """Return points evenly along the outline of scikit-image's horse, about their middle, upright.

    Args:
        count: How many.
        reach: The largest coordinate, metres.
    """
    from skimage.measure import find_contours

    inside = shipped_image("horse.png")[..., 0] < 128
    outline = max(find_contours(inside.astype(float), 0.5), key=len)[:, ::-1] * [1.0, -1.0]
    along = np.r_[0.0, np.cumsum(np.linalg.norm(np.diff(outline, axis=0), axis=1))]
    at = np.linspace(0.0, along[-1], count, endpoint=False)
    p = np.column_stack([np.interp(at, along, outline[:, k]) for k in range(2)])
    p = p - p.mean(axis=0)
    return p * (reach / np.abs(p).max())
