"""The sample pictures of the course: scikit-image's files, or their pixels where they were stored
beside this module.

A browser has neither scikit-image nor Pillow: what is published for it has the pixels.
Source: https://scikit-image.org, whose folder `data` says where each is from.
"""

import io
from pathlib import Path

import numpy as np
from jaxtyping import Shaped, UInt8

from workbench.data.files.arrays import read_arrays

STORED = Path(__file__).with_name("stored")
PICTURES = ("horse.png", "coins.png", "motorcycle_left.png", "motorcycle_right.png")
ARRAYS = ("motorcycle_disp.npz",)


def shipped_image(name: str) -> UInt8[np.ndarray, "h w *channels"]:
    """Return a sample picture, uint8, grey or RGB."""
    stored = STORED / f"{name}.npy"
    if stored.is_file():
        return np.cumsum(np.load(stored), axis=1, dtype=np.uint8)
    from workbench.data.files.reading import opened_image, plain_pixels

    with opened_image(_shipped(name), name) as image:
        return plain_pixels(image)


def shipped_array(name: str) -> Shaped[np.ndarray, "..."]:
    """Return the one array of a sample file."""
    stored = STORED / f"{name}.npy"
    if stored.is_file():
        of_numbers = np.moveaxis(np.load(stored), 0, -1)
        return np.ascontiguousarray(of_numbers).view(np.float32)[..., 0]
    return read_arrays(_shipped(name).read_bytes(), name)["arr_0"]


def stored_files() -> dict[str, bytes]:
    """Return the files that stand in for scikit-image's, by name.

    They pack better so: a picture holds the differences along its rows, other numbers, float32,
    their first bytes, then their second ones, and so on.
    """
    files = {}
    for name in ARRAYS:
        numbers = shipped_array(name)[..., None]
        files[f"{name}.npy"] = _as_file(np.moveaxis(numbers.view(np.uint8), -1, 0))
    for name in PICTURES:
        steps = np.diff(shipped_image(name), axis=1, prepend=np.uint8(0))
        files[f"{name}.npy"] = _as_file(steps)
    return files


def _as_file(array: np.ndarray) -> bytes:
    file = io.BytesIO()
    np.save(file, np.ascontiguousarray(array))
    return file.getvalue()


def _shipped(name: str) -> Path:
    """Return where scikit-image keeps a sample: to import its own readers takes 0.3 s."""
    import skimage

    return Path(skimage.__file__).with_name("data") / name
