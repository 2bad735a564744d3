"""The rim of something bright and round on a dark ground, found from a pixel inside."""

import functools
from dataclasses import dataclass

import numpy as np
import scipy
from jaxtyping import Float, UInt8

from workbench.data.files.samples import shipped_image
from workbench.errors import InputError
from workbench.geometry.shapes.algebraic_fits import fit_algebraic

SMOOTH = 1.5  # pixels, standard deviation
NEAREST, FARTHEST, STEP = 6.0, 45.0, 0.5  # pixels from the pixel inside
RAYS, WINDOWS = 360, 12  # round it
MOST_PIXELS = 900  # of a photograph's longer side


@dataclass(frozen=True, eq=False)
class Rim:
    """The rim of something round in a photograph.

    Attributes:
        p: Its points in order, y upwards, in radii of the circle through them, about its centre.
        center, radius: Of that circle, pixels.
    """

    photograph: UInt8[np.ndarray, "h w *channels"]
    p: Float[np.ndarray, "n 2"]
    center: Float[np.ndarray, "2"]
    radius: float

    def windows(self, arc: float) -> Float[np.ndarray, "k m 2"]:
        """Return twelve arcs of so many degrees, the first about +x."""
        n = len(self.p)
        count = max(round(n * arc / 360.0), 4)
        first = np.arange(WINDOWS) * n // WINDOWS - count // 2
        return self.p[(first[:, None] + np.arange(count)) % n]


def find_rim(photograph: UInt8[np.ndarray, "h w *channels"], pixel: tuple[int, int]) -> Rim:
    """Return the rim of what a pixel (column, row) is inside of, bright on dark.

    Raises:
        InputError: If the photograph is too large, or no rim is found.
    """
    h, w = photograph.shape[:2]
    if max(h, w) > MOST_PIXELS:
        raise InputError(
            f"the photograph is {w} by {h} pixels; at most {MOST_PIXELS} are used: make it smaller"
        )
    rim = rim_points(
        photograph, np.minimum(pixel, (w - 1, h - 1)).astype(float), RAYS, farthest=FARTHEST
    )
    whole = fit_algebraic(rim)
    if not (np.isfinite(whole).all() and 0.0 < whole[2] < 4 * FARTHEST):
        raise InputError(
            "no rim is found round this pixel: pick one inside something bright and round"
        )
    return Rim(photograph, (rim - whole[:2]) * [1.0, -1.0] / whole[2], whole[:2], float(whole[2]))


@functools.cache
def coins() -> UInt8[np.ndarray, "h w"]:
    """Return the coins of Pompeii that scikit-image ships."""
    return shipped_image("coins.png")


def rim_points(
    image: UInt8[np.ndarray, "h w *channels"],
    uv_inside: Float[np.ndarray, "2"],
    rays: int,
    *,
    farthest: float,
) -> Float[np.ndarray, "n 2"]:
    """Return where the picture darkens most along rays from a pixel, in order round it, pixels.

    A ray on which nothing darkens gives some place on it.
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
