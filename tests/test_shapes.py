"""Shapes of arrays are checked in every test, at a function's first calls in it."""

import numpy as np
import pytest
from jaxtyping import TypeCheckError

from tests.conftest import ENOUGH
from workbench.geometry.fields.voxels import Grid
from workbench.geometry.motions import rotation_angle


@pytest.mark.parametrize("test", ["one", "the next, where it was called often before"])
def test_a_wrong_shape_is_refused(test):
    with pytest.raises(TypeCheckError):
        rotation_angle(np.eye(4))
    for _ in range(2 * ENOUGH):
        assert rotation_angle(np.eye(3)) == 0


@pytest.mark.parametrize("test", ["one", "the next, where many were made before"])
def test_a_value_with_a_wrong_shape_is_refused(test):
    with pytest.raises(TypeCheckError):
        Grid(np.zeros(2), np.ones(3), (1, 1, 1))
    for _ in range(2 * ENOUGH):
        Grid(np.zeros(3), np.ones(3), (1, 1, 1))
