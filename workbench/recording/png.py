"""Images as PNG, so that a recording of many pictures stays small."""

from typing import Any

import numpy as np
import rerun as rr

from workbench.machinery.images import png, png_of_levels, resized
from workbench.scene import UNKNOWN, Field, color_map

IMAGE = "/image"
"""Below which suffix of an entity an encoded image stands, and nothing else."""
_LEVELS = 25
_TEXELS = 12_000
_QUICK = 3  # zlib's level: a third of the time of the default for a tenth more bytes


def encoded(image: np.ndarray | Field) -> Any:
    """Return an image, (h, w) or (h, w, 3) uint8 or a Field, as Rerun's archetype.

    A Field has 25 levels, which makes the file a third to a quarter.
    """
    data = _field_png(image) if isinstance(image, Field) else png(image, _QUICK)
    return rr.EncodedImage(contents=data, media_type="image/png")


def texture(image: np.ndarray) -> np.ndarray:
    """Return an image (h, w, 3) as drawn in space, of pixels that fit rerun's 64 kB of repetitions.

    A picture that changes in a corner from step to step then costs what has changed.
    """
    h, w = image.shape[:2]
    shrink = np.sqrt(_TEXELS / (h * w))
    return image if shrink >= 1 else resized(image, int(w * shrink), int(h * shrink))


def _field_png(field: Field) -> bytes:
    known = np.isfinite(field.values)
    share = np.where(known, (field.values - field.low) / (field.high - field.low), 0.0)
    levels = np.where(known, np.rint(np.clip(share, 0.0, 1.0) * (_LEVELS - 1)), _LEVELS)
    colors = np.vstack([color_map(field.map, np.linspace(0.0, 1.0, _LEVELS)), UNKNOWN]).astype(
        np.uint8
    )
    return png_of_levels(levels.astype(np.uint8), colors)


def gone(suffix: str) -> Any:
    """Return what takes away what stands here: Rerun's viewer overlooks a `Clear` of an image."""
    return rr.EncodedImage.cleared() if suffix == IMAGE else rr.Clear(recursive=False)
