"""Images as the bytes of files."""

import io

import numpy as np


def png(image: np.ndarray, compress_level: int = 6) -> bytes:
    """Return an image, (h, w) or (h, w, 3) uint8, as the bytes of a PNG file."""
    from PIL import Image

    file = io.BytesIO()
    Image.fromarray(np.ascontiguousarray(image)).save(file, "PNG", compress_level=compress_level)
    return file.getvalue()


def png_of_levels(levels: np.ndarray, colors: np.ndarray) -> bytes:
    """Return an image (h, w) of rows of `colors` (n, 3), both uint8, as a PNG file's bytes."""
    from PIL import Image

    file = io.BytesIO()
    image = Image.fromarray(np.ascontiguousarray(levels)).convert("P")
    image.putpalette(np.ascontiguousarray(colors).tobytes())
    image.save(file, "PNG", compress_level=9)
    return file.getvalue()


def resized(image: np.ndarray, width: int, height: int) -> np.ndarray:
    """Return a uint8 image, (h, w) or (h, w, 3), smaller, each pixel a mean."""
    from PIL import Image

    size = max(width, 1), max(height, 1)
    return np.asarray(
        Image.fromarray(np.ascontiguousarray(image)).resize(size, Image.Resampling.BOX)
    )


def webp(image: np.ndarray) -> bytes:
    """Return a uint8 image as the bytes of a WebP file without loss: half of a PNG's."""
    from PIL import Image

    file = io.BytesIO()
    Image.fromarray(np.ascontiguousarray(image)).save(file, "WEBP", lossless=True, method=3)
    return file.getvalue()
