"""What a server loads before the first one asks: parts of scipy, which loads them when first used,
and of Pillow.

A part takes up to 70 ms of processor time, which the first knob that needs it would wait for.
"""

import importlib

PARTS = ("scipy.ndimage", "scipy.optimize", "scipy.spatial", "PIL.WebPImagePlugin")


def load_parts() -> None:
    """Load the parts that lessons and their pictures use.

    A format that Pillow has loaded it writes at once; for another it loads all that it knows.
    """
    for part in PARTS:
        importlib.import_module(part)
    importlib.import_module("PIL.Image").preinit()  # which a first picture would wait for
