"""The direction of heat where a corner has none."""

import numpy as np
import pytest

from workbench.algorithms.surfaces.heat_method import directions_of
from workbench.geometry.meshes import corners

P = np.array([[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
FACES = np.array([[0, 1, 2]])


@pytest.mark.parametrize("size", [1.0, 1e-200])
@pytest.mark.parametrize("u", [(1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 3.0), (1.0, 2.0, 3.0)])
def test_it_is_against_the_slope_however_small_the_heat(u, size):
    direction = directions_of(corners(P, FACES), size * np.array(u))[0]
    slope = np.array([(u[1] - u[0]) / 2.0, u[2] - u[0], 0.0])
    np.testing.assert_allclose(direction, -slope / np.linalg.norm(slope), atol=1e-12)
