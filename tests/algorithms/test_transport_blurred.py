"""Blurred transport is told how long and how exactly."""

import numpy as np

from workbench.algorithms.transport import blurred_earth_movers


def test_sweeps_and_tolerance_reach_the_solver():
    rng = np.random.default_rng(0)
    p_a = rng.normal(size=(20, 3))
    p_b = rng.normal(size=(25, 3)) + 1.0
    whole = blurred_earth_movers(p_a, p_b, 0.05)
    assert abs(blurred_earth_movers(p_a, p_b, 0.05, max_sweeps=1) - whole) > 1e-6
    assert abs(blurred_earth_movers(p_a, p_b, 0.05, tolerance=0.5) - whole) > 1e-6
    assert abs(blurred_earth_movers(p_a, p_b, 0.05, tolerance=1e-7) - whole) < 1e-4
