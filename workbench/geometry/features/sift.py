"""SIFT's keypoints of a picture, by scikit-image: places with a size and a direction.

References: Lowe, Distinctive Image Features from Scale-Invariant Keypoints, 2004, sections 3 to 6;
Otero and Delbracio, Anatomy of the SIFT Method, IPOL 2014, which scikit-image follows.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
import scipy
from jaxtyping import Float

from workbench.errors import InputError

Image = Float[np.ndarray, "h w"]
BINS = 36
"""Of the histogram of directions, after Lowe's section 5."""


@dataclass(frozen=True, eq=False)
class Sift:
    """The keypoints of one picture: places and sizes in pixels, directions from u towards v."""

    uv: Float[np.ndarray, "n 2"]
    sigma: Float[np.ndarray, " n"]
    angle: Float[np.ndarray, " n"]
    descriptors: Float[np.ndarray, "n 128"]


def sift(image: Image) -> Sift:
    """Return the keypoints of a picture of 12 x 12 pixels or more, not doubled as Lowe's is.

    Raises:
        InputError: If scikit-image is not here, such as in a browser.
    """
    try:
        from skimage.feature import SIFT
    except ModuleNotFoundError:
        raise InputError(
            "SIFT's keypoints of these pictures cannot be found in a browser; open the lesson on"
            " your own computer"
        ) from None

    detector: Any = SIFT(upsampling=1, n_bins=BINS)  # what it holds is None until it has looked
    try:
        detector.detect_and_extract(image / 255.0)
    except RuntimeError:  # it found nothing, and says so in this way
        return Sift(np.zeros((0, 2)), np.zeros(0), np.zeros(0), np.zeros((0, 128)))
    # theirs are rows and columns, and an angle from down to the right; their bins are told half a
    # bin too far
    uv = detector.positions[:, ::-1].astype(float)
    angle = np.pi / 2 - (detector.orientations - np.pi / BINS)
    return Sift(uv, detector.sigmas.astype(float), angle, detector.descriptors.astype(float))


def turned_patch(
    image: Image, uv: Float[np.ndarray, "2"], angle: float, *, half: float, side: int
) -> Float[np.ndarray, "side side"]:
    """Return the grey levels of a square around a place, turned so that a direction points right.

    The direction is an angle from u towards v; `half` a side in pixels, `side` in samples.
    """
    across, down = np.meshgrid(np.linspace(-half, half, side), np.linspace(-half, half, side))
    c, s = np.cos(angle), np.sin(angle)
    places = [uv[1] + s * across + c * down, uv[0] + c * across - s * down]
    return scipy.ndimage.map_coordinates(image, places, order=1, mode="nearest")
