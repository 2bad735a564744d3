"""Images as PNG, so that a recording of many pictures stays small."""

import io
from typing import Any

import numpy as np
import rerun as rr

_QUICK = 3  # zlib's level: a third of the time of the default for a tenth more bytes


def encoded(image: np.ndarray) -> Any:
    """Return an image, (h, w) or (h, w, 3) uint8, as Rerun's archetype."""
    return rr.EncodedImage(contents=png(image), media_type="image/png")


def png(image: np.ndarray) -> bytes:
    """Return an image, (h, w) or (h, w, 3) uint8, as the bytes of a PNG file."""
    from PIL import Image

    file = io.BytesIO()
    Image.fromarray(np.ascontiguousarray(image)).save(file, "PNG", compress_level=_QUICK)
    return file.getvalue()
