"""A set of points and many targets: gradients by differences, and the means of two losses."""

import numpy as np
import pytest

from tests.algorithms.gradients import assert_gradient, descended
from workbench.algorithms.learning import set_regression
from workbench.algorithms.learning.set_regression import learn_set


@pytest.mark.parametrize("set_loss", ["Chamfer", "earth mover's"])
def test_gradients_are_those_of_differences(monkeypatch, set_loss):
    rng = np.random.default_rng(1)
    p = rng.normal(size=(12, 3))
    training = learn_set(p, lambda: rng.normal(size=(12, 3)), set_loss=set_loss, counts=(0, 1))
    values, gradient = descended(monkeypatch, set_regression, lambda: training)
    assert_gradient(values, gradient, rng)


def test_earth_movers_of_squares_ends_in_the_mean_of_partners():
    """Two targets, the same points moved by different ways: one to one, the mean is moved by the
    mean of the ways.
    """
    start = np.random.default_rng(2).normal(size=(8, 3))
    ways = iter(np.tile([[0.5, 0, 0], [1.5, 0, 0]], (1000, 1)))
    *_, last = learn_set(
        start, lambda: start + next(ways), set_loss="earth mover's", counts=(0, 120)
    )
    np.testing.assert_allclose(last.p, start + np.array([1.0, 0, 0]), atol=0.05)


def test_under_chamfer_points_share_the_targets_among_them():
    """Two points and two targets of one spot each: either is near one of the spots, and not in the
    middle.
    """
    spots = np.array([[-1.0, 0, 0], [1, 0, 0]])
    turn = iter(range(10_000))
    start = np.array([[-0.2, 0.1, 0], [0.2, -0.1, 0]])
    *_, last = learn_set(
        start, lambda: spots[[next(turn) % 2] * 2], set_loss="Chamfer", counts=(0, 120)
    )
    assert abs(last.p[0, 0] - last.p[1, 0]) > 0.5
    *_, last = learn_set(
        start, lambda: spots[[next(turn) % 2] * 2], set_loss="earth mover's", counts=(0, 120)
    )
    np.testing.assert_allclose(last.p, 0, atol=0.1)
