"""Images as the bytes of files."""

import io

import numpy as np


def png(image: np.ndarray, compress_level: int = 6) -> bytes:
    """Return an image, (h, w) or (h, w, 3) uint8, as the bytes of a PNG file."""
    from PIL import Image

    file = io.BytesIO()
    Image.fromarray(np.ascontiguousarray(image)).save(file, "PNG", compress_level=compress_level)
    return file.getvalue()


def webp(image: np.ndarray) -> bytes:
    """Return an image, (h, w) or (h, w, 3) uint8, as the bytes of a WebP file without loss: half of a PNG's."""
    from PIL import Image

    file = io.BytesIO()
    Image.fromarray(np.ascontiguousarray(image)).save(file, "WEBP", lossless=True, method=3)
    return file.getvalue()
