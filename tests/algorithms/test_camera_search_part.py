"""A share of a step is a share of one screw."""

import numpy as np
import pytest

from workbench.algorithms.cameras.camera_search import _part
from workbench.geometry.motions import exp_se3, inverse


@pytest.mark.parametrize("parts", [2, 4])
def test_parts_of_a_step_compose_to_the_step(parts):
    T = exp_se3(np.array([0.5, -0.2, 2.0, 0.3, 0.8, -0.1]))
    moved = exp_se3(np.array([0.1, 0.3, -0.2, -0.4, 0.2, 0.5]))
    part = _part(T, moved @ T, 1.0 / parts) @ inverse(T)
    np.testing.assert_allclose(np.linalg.matrix_power(part, parts), moved, atol=1e-9)
    assert _part(T, moved, 1.0) is moved
