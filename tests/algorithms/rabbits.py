"""Two scans of a rabbit, one of them turned, for the tests of ICP."""

import numpy as np
from hypothesis import strategies as st

from workbench.data.shapes.clouds import pair
from workbench.geometry.motions import exp_so3, motion

SEEDS = st.integers(0, 1000)


def turned(degrees: float, axis=(0.0, 0.0, 1.0), t=(0.0, 0.0, 0.0)) -> np.ndarray:
    return motion(exp_so3(np.radians(degrees) * np.array(axis)), np.array(t))


def rabbits(degrees: float = 20, n: int = 400, seed: int = 0, **options):
    return pair("rabbit", n, turned(degrees), rng=np.random.default_rng(seed), **options)
