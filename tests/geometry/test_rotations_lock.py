"""Past gimbal lock: the turn is made, and the triple is the nearer of two."""

import numpy as np
import pytest

from workbench.geometry.motions import exp_so3, rotation_angle
from workbench.geometry.motions.rotations import (
    angles_apart,
    euler_axes,
    euler_to_matrix,
    matrix_to_euler,
    other_triple,
    triple_past_lock,
)


@pytest.mark.parametrize(
    ("order", "middle"), [("xyz", np.pi / 2), ("zyx", -np.pi / 2), ("zxz", 0.0)]
)
@pytest.mark.parametrize("turn", [0.2, -0.4])
def test_the_body_turns_by_so_much_about_the_lost_axis(order, middle, turn):
    angles = np.array([0.3, middle, -0.5])
    first, second, _ = euler_axes(angles, order)
    lost = np.cross(first, second)
    assert np.linalg.norm(lost) == pytest.approx(1.0)
    triple = triple_past_lock(angles, order, turn)
    made = euler_to_matrix(triple, order) @ euler_to_matrix(angles, order).T
    np.testing.assert_allclose(made, exp_so3(turn * lost), atol=1e-7)
    assert rotation_angle(made) == pytest.approx(abs(turn))
    both = [matrix_to_euler(euler_to_matrix(triple, order), order)]
    both.append(other_triple(both[0], order))
    assert angles_apart(triple, angles) == pytest.approx(min(angles_apart(b, angles) for b in both))
