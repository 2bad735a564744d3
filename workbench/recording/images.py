"""Images as PNG, so that a recording of many pictures stays small."""

from typing import Any

import numpy as np
import rerun as rr

from workbench.images import png

IMAGE = "/image"
"""Below which suffix of an entity an encoded image stands, and nothing else."""
_QUICK = 3  # zlib's level: a third of the time of the default for a tenth more bytes


def encoded(image: np.ndarray) -> Any:
    """Return an image, (h, w) or (h, w, 3) uint8, as Rerun's archetype."""
    return rr.EncodedImage(contents=png(image, _QUICK), media_type="image/png")


def gone(suffix: str) -> Any:
    """Return what takes away what stands at this suffix: Rerun's viewer overlooks a `Clear` of an encoded image."""
    return rr.EncodedImage.cleared() if suffix == IMAGE else rr.Clear(recursive=False)
