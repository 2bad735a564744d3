"""SIFT's keypoints of the motorcycle as a file, for a browser, which has no scikit-image.

What is published for a browser has the file that `files` returns; elsewhere there is none, and
keypoints are computed.
"""

import functools
import io
from pathlib import Path

import numpy as np

from lessons.features.turned_pictures import motorcycle_levels, turned
from workbench.geometry.features.sift import Image, Sift, sift

STORED = Path(__file__).with_name("sift.npz")
TURNS = (0.0, 30.0)
"""Of the right picture, degrees."""


def keypoints(image: Image) -> Sift:
    """Return the keypoints of a picture: those that are stored, or computed.

    Raises:
        InputError: If neither can be.
    """
    stored = _stored().get(_name(image))
    return sift(image) if stored is None else stored


def files() -> dict[str, bytes]:
    """Return what is stored beside this module where nothing can be computed, by name."""
    left, right, _ = motorcycle_levels()
    pictures = [left, *(turned(right, np.radians(turn)) for turn in TURNS)]
    arrays = {}
    for image in pictures:
        features = sift(image)
        arrays[f"{_name(image)} places"] = np.column_stack(
            [features.uv, features.sigma, features.angle]
        )
        arrays[f"{_name(image)} descriptors"] = features.descriptors.astype(np.uint8)
    file = io.BytesIO()
    np.savez(file, **arrays)
    return {STORED.name: file.getvalue()}


def _name(image: Image) -> str:
    """Return what stands for a picture: rounding, which differs between machines, changes it not
    at all.
    """
    return f"{image.shape[0]} {image.shape[1]} {image.mean():.6f} {image.std():.6f}"


@functools.cache
def _stored() -> dict[str, Sift]:
    if not STORED.is_file():
        return {}
    with np.load(STORED) as arrays:
        names = {name.removesuffix(" places") for name in arrays.files if name.endswith(" places")}
        return {name: _sift(arrays, name) for name in names}


def _sift(arrays: np.lib.npyio.NpzFile, name: str) -> Sift:
    places, descriptors = arrays[f"{name} places"], arrays[f"{name} descriptors"]
    return Sift(places[:, :2], places[:, 2], places[:, 3], descriptors.astype(float))
