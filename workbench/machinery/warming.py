"""What a server loads before the first one asks: parts of scipy, which loads them when first used.

A part takes up to 70 ms of processor time, which the first knob that needs it would wait for.
"""

import importlib

PARTS = ("scipy.ndimage", "scipy.optimize", "scipy.spatial")


def load_scipy() -> None:
    """Load the parts that lessons use."""
    for part in PARTS:
        importlib.import_module(part)
