"""PointNet: gradients by differences, the order of points, critical points, and a first
training.
"""

import numpy as np
import pytest
import scipy
from hypothesis import given
from hypothesis import strategies as st

from tests.algorithms.gradients import assert_gradient, descended
from workbench.algorithms.learning import point_net
from workbench.algorithms.learning.perceptron import count_values
from workbench.algorithms.learning.point_net import PointNet, Pool, train_classifier


def network_of(pool: Pool, n: int = 7, seed: int = 0) -> PointNet:
    """A small network of double precision, with biases that are not zero."""
    pointwise, head = ((), (3 * n, 6, 4)) if pool == "none" else ((3, 5, 8), (8, 6, 4))
    values = np.random.default_rng(seed).normal(size=count_values(pointwise) + count_values(head))
    return PointNet(values=values, pointwise=pointwise, head=head, pool=pool)


@pytest.mark.parametrize("pool", ["max", "mean", "none"])
def test_gradients_are_those_of_differences(pool):
    rng = np.random.default_rng(1)
    network = network_of(pool)
    clouds = rng.normal(size=(6, 7, 3))
    of = rng.integers(4, size=6)

    def gradient() -> tuple[float, np.ndarray]:
        done = network.run(clouds)
        score = done.head[-1]
        loss = -scipy.special.log_softmax(score, axis=1)[np.arange(6), of].sum()
        return float(loss), network.slopes(
            done, scipy.special.softmax(score, axis=1) - np.eye(4)[of]
        )

    assert_gradient(network.values, gradient, rng, tolerance=1e-5)


@pytest.mark.parametrize("pool", ["max", "mean", "none"])
def test_training_goes_down_the_cross_entropy_of_its_batch(monkeypatch, pool):
    rng = np.random.default_rng(2)
    clouds = rng.normal(size=(5, 32, 3))
    of = np.array([0, 1, 2, 1, 0])
    training = train_classifier(
        pool, lambda _: (clouds, of), {"a": clouds}, classes=3, counts=(0, 1), rng=rng
    )
    values, gradient = descended(monkeypatch, point_net, lambda: training)
    loss, slope = gradient()
    n = 3 * 32
    pointwise, head = (
        ((), (n, point_net.FLAT, point_net.HEAD, 3))
        if pool == "none"
        else (point_net.POINTWISE, (point_net.POINTWISE[-1], point_net.HEAD, 3))
    )
    exact = PointNet(values=values.astype(float), pointwise=pointwise, head=head, pool=pool)
    done = exact.run(clouds)
    score = done.head[-1]
    assert loss == pytest.approx(
        -scipy.special.log_softmax(score, axis=1)[np.arange(5), of].mean(), rel=1e-4
    )
    expected = exact.slopes(done, (scipy.special.softmax(score, axis=1) - np.eye(3)[of]) / 5)
    np.testing.assert_allclose(slope, expected, atol=1e-4 * np.abs(expected).max())


@given(st.integers(0, 10_000), st.sampled_from(["max", "mean"]))
def test_pooled_networks_do_not_know_the_order_of_points(seed, pool):
    rng = np.random.default_rng(seed)
    network = network_of(pool, seed=seed)
    clouds = rng.normal(size=(2, 9, 3))
    np.testing.assert_allclose(network(clouds[:, rng.permutation(9)]), network(clouds), atol=1e-12)


def test_critical_points_alone_say_the_same_and_without_one_it_may_differ():
    network = network_of("max")
    cloud = np.random.default_rng(3).normal(size=(1, 40, 3))
    (kept,) = network.critical(cloud)
    assert len(kept) <= 8  # one for each feature at most
    np.testing.assert_array_equal(network(cloud[:, kept]), network(cloud))
    np.testing.assert_array_equal(network(np.repeat(cloud, 2, axis=1)), network(cloud))
    assert np.abs(network(np.delete(cloud, kept, axis=1)) - network(cloud)).max() > 1e-6
    assert (
        np.abs(network_of("none", 40)(cloud[:, ::-1]) - network_of("none", 40)(cloud)).max() > 1e-3
    )


def test_left_and_right_are_told_apart_and_states_stay_as_they_were():
    rng = np.random.default_rng(4)

    def draw(count: int) -> tuple[np.ndarray, np.ndarray]:
        of = rng.integers(2, size=count)
        return (
            rng.normal(size=(count, 8, 3)) + np.array([3.0, 0, 0]) * (2 * of - 1)[:, None, None],
            of,
        )

    clouds, of = draw(40)
    states = list(
        train_classifier("max", draw, {"new": clouds}, classes=2, counts=(0, 10, 60), rng=rng)
    )
    assert (states[-1].scores["new"].argmax(axis=1) == of).mean() > 0.95
    assert states[-1].loss < 0.5 * states[0].loss
    np.testing.assert_array_equal(states[1].network(clouds), states[1].scores["new"])
