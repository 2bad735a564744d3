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
    stored = STORED / name
    file = stored if stored.is_file() else _shipped(name)
    return read_arrays(file.read_bytes(), name)["arr_0"]


def stored_files() -> dict[str, bytes]:
    """Return the files that stand in for scikit-image's, by name.

    A picture holds the differences along its rows, which pack better.
    """
    files = {name: _shipped(name).read_bytes() for name in ARRAYS}
    for name in PICTURES:
        file = io.BytesIO()
        np.save(file, np.diff(shipped_image(name), axis=1, prepend=np.uint8(0)))
        files[f"{name}.npy"] = file.getvalue()
    return files


def _shipped(name: str) -> Path:
    """Return where scikit-image keeps a sample: to import its own readers takes 0.3 s."""
    import skimage

    return Path(skimage.__file__).with_name("data") / name
