"""The rim of something bright and round on a dark ground, such as a coin, found from a pixel inside."""

import numpy as np
import scipy
from jaxtyping import Float, UInt8

SMOOTH = 1.5  # pixels, standard deviation
NEAREST, STEP = 6.0, 0.5  # pixels from the pixel inside


def rim_points(
    image: UInt8[np.ndarray, "h w *channels"], uv_inside: Float[np.ndarray, "2"], rays: int, farthest: float
) -> Float[np.ndarray, "n 2"]:
    """Return where the picture darkens most along rays from a pixel, in order round it, pixels.

    Args:
        image: Grey or coloured.
        uv_inside: The pixel, column first.
        rays: How many, evenly all round.
        farthest: How far they go, pixels.

    Note:
        A ray on which nothing darkens gives some place on it: what is fitted to the rim may have to be robust.
    """
    gray = image if image.ndim == 2 else image[..., :3].mean(axis=-1)
    smooth = scipy.ndimage.gaussian_filter(gray.astype(float), SMOOTH)
    turn = 2.0 * np.pi * np.arange(rays) / rays
    out = np.column_stack([np.cos(turn), np.sin(turn)])
    r = np.arange(NEAREST, farthest, STEP)
    uv = uv_inside + out[:, None] * r[:, None]
    seen = scipy.ndimage.map_coordinates(smooth, [uv[..., 1], uv[..., 0]], order=1, mode="nearest")
    steepest = np.diff(seen, axis=1).argmin(axis=1)
    return uv_inside + out * (r[steepest] + STEP / 2.0)[:, None]
