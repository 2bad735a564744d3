"""Images as the bytes of files."""

import base64
import io
import struct
import zlib

import numpy as np


def png(image: np.ndarray, compress_level: int = 6) -> bytes:
    """Return an image, (h, w) or (h, w, 3) uint8, as the bytes of a PNG file."""
    return _file(image, "PNG", compress_level=compress_level)


def jpeg(image: np.ndarray) -> bytes:
    """Return an image, (h, w, 3) uint8, as the bytes of a JPEG file, as good as viser makes it."""
    return _file(image, "JPEG", quality=75)


def _file(image: np.ndarray, kind: str, **how: int) -> bytes:
    from PIL import Image

    file = io.BytesIO()
    Image.fromarray(np.ascontiguousarray(image)).save(file, kind, **how)
    return file.getvalue()


def plain_png(image: np.ndarray) -> bytes:
    """Return an image, (h, w) or (h, w, 3) uint8, as the bytes of a PNG file, without Pillow.

    Each line holds the differences to the one above it, which pack better in most pictures.

    Reference: W3C, Portable Network Graphics specification, 2nd ed., 9 (filtering), 11 (chunks).
    """
    height, width = image.shape[:2]
    rows = np.ascontiguousarray(image, np.uint8).reshape(height, -1)
    above = np.vstack([np.zeros_like(rows[:1]), rows[:-1]])
    lines = np.column_stack([np.full(height, 2, np.uint8), rows - above])  # filter 2: "up"
    kind = 0 if image.ndim == 2 else 2
    head = struct.pack(">2I5B", width, height, 8, kind, 0, 0, 0)
    parts = ((b"IHDR", head), (b"IDAT", zlib.compress(lines.tobytes(), 1)), (b"IEND", b""))
    return b"\x89PNG\r\n\x1a\n" + b"".join(_png_chunk(name, data) for name, data in parts)


def _png_chunk(name: bytes, data: bytes) -> bytes:
    check = zlib.crc32(name + data)
    return struct.pack(">I", len(data)) + name + data + struct.pack(">I", check)


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
    return _file(image, "WEBP", lossless=True, method=3)


def webp_address(image: np.ndarray) -> str:
    """Return a uint8 image as the address of a WebP picture that holds itself."""
    return f"data:image/webp;base64,{base64.b64encode(webp(image)).decode()}"


def png_address(image: np.ndarray) -> str:
    """Return a uint8 image as the address of a PNG picture that holds itself, without Pillow."""
    return f"data:image/png;base64,{base64.b64encode(plain_png(image)).decode()}"
