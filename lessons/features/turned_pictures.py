"""Pairs of pictures, the second turned about its middle: a photograph with its true disparity, or a
person's own.
"""

import functools
from pathlib import Path

import numpy as np
import scipy
from jaxtyping import Float, Int

from workbench.data.files import read_image
from workbench.data.views.stereo import grey, motorcycle, shrunk
from workbench.errors import InputError

Image = Float[np.ndarray, "h w"]
SHRINK = 2  # of the motorcycle's pictures
MOST_SIDE, LEAST_SIDE = 400, 80  # own pictures, pixels


@functools.lru_cache(maxsize=1)
def motorcycle_levels() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return the grey levels of the left and of the right picture of the motorcycle, and the left
    one's true disparity.
    """
    made = shrunk(motorcycle(), SHRINK)
    assert made.disparity is not None
    return grey(made.left), grey(made.right), made.disparity


def read_levels(file: Path) -> Image:
    """Return a picture's grey levels, its longer side at most 400 pixels: means of blocks where it
    is larger.

    Raises:
        InputError: If it cannot be read, or is less than 80 pixels wide or high then.
    """
    image = read_image(file)
    levels = grey(image) if image.ndim == 3 else image.astype(float)
    k = -(-max(levels.shape) // MOST_SIDE)
    h, w = (side // k for side in levels.shape)
    if min(h, w) < LEAST_SIDE:
        raise InputError(
            f"{file.name}: {w} x {h} pixels after shrinking; {LEAST_SIDE} at least are needed"
        )
    return levels[: h * k, : w * k].reshape(h, k, w, k).mean(axis=(1, 3))


def turned(image: Image, angle: float) -> Image:
    """Return the picture turned about its middle, u towards v, of the same size; what comes from
    outside is mid-grey.

    Args:
        image: Grey levels.
        angle: Radians.
    """
    if angle == 0:
        return image
    # in (v, u), the turn's inverse is R itself
    R = _turn(angle)
    middle = (np.array(image.shape) - 1) / 2
    return scipy.ndimage.affine_transform(image, R, middle - R @ middle, order=1, cval=128.0)


def places_in_turned(
    uv: Int[np.ndarray, "n 2"] | Float[np.ndarray, "n 2"], disparity: Image, angle: float
) -> Float[np.ndarray, "n 2"]:
    """Return where places (u, v) of the left picture lie in the turned right one; NaN where the
    disparity is.

    Args:
        uv: Places in the left picture, pixels.
        disparity: How far to the left the right picture has each pixel, pixels; a place has that of
            the nearest.
        angle: How far the right picture is turned, radians.
    """
    u, v = np.rint(uv).astype(int).T
    d = disparity[v, u]
    middle = (np.array(disparity.shape[::-1]) - 1) / 2
    return (uv - np.column_stack([d, np.zeros_like(d)]) - middle) @ _turn(angle).T + middle


def _turn(angle: float) -> np.ndarray:
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s], [s, c]])
