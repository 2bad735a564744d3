"""Keeps out of a browser's Python what no lesson uses: every module costs there what it costs to
compile.
"""

import sys

import numpy

RARE = frozenset({"ctypeslib", "f2py", "ma", "polynomial", "rec", "testing", "typing"})
"""Parts of numpy that are imported when they are first asked for."""


def without_rare_parts() -> None:
    """Keep `from numpy import *`, as SciPy's modules say it, from importing all of numpy: a second
    of processor time.

    For a process that computes lessons and nothing else.
    """
    numpy.__all__ = [name for name in numpy.__all__ if name not in RARE]


def is_browser() -> bool:
    """Tell whether this Python was compiled for browsers."""
    return sys.platform == "emscripten"
