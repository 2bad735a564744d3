"""A small step of a cylinder changes what it says: the axis across itself, the tilt, the radius."""

import numpy as np

from workbench.geometry.motions import across
from workbench.geometry.shapes.cylinders import retract_cylinder

CYLINDER = np.array([0.3, -0.2, 0.5, 0.0, 0.0, 1.0, 0.7])


def test_each_number_of_a_step_moves_one_thing():
    u, v = across(CYLINDER[3:6])
    moved = retract_cylinder(CYLINDER, np.array([0.1, 0.2, 0.0, 0.0, 0.05]))
    np.testing.assert_allclose(moved[:3], CYLINDER[:3] + 0.1 * u + 0.2 * v)
    np.testing.assert_allclose(moved[3:6], CYLINDER[3:6])
    np.testing.assert_allclose(moved[6], 0.75)
    tilted = retract_cylinder(CYLINDER, np.array([0.0, 0.0, 0.3, -0.4, 0.0]))
    np.testing.assert_allclose(tilted[:3], CYLINDER[:3])
    np.testing.assert_allclose(tilted[3:6], (CYLINDER[3:6] + 0.3 * u - 0.4 * v) / np.sqrt(1.25))
    np.testing.assert_allclose(tilted[6], 0.7)
