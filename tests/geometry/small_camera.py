"""A camera of few pixels, its lenses, and colours, for the tests of the picture."""

import numpy as np
from hypothesis import strategies as st

from workbench.geometry.cameras import intrinsics
from workbench.geometry.cameras.distortion import NONE, Distortion

WIDTH, HEIGHT = 64, 48
K = intrinsics(50.0, 31.5, 23.5)
BARREL = Distortion(-0.25, 0.05, 0.01, -0.01)
RED, BLUE = np.array([[255, 0, 0]], np.uint8), np.array([[0, 0, 255]], np.uint8)
seeds = st.integers(0, 2**32 - 1)
lenses = st.sampled_from([NONE, BARREL])
