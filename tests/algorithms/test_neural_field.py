"""The network: gradients against finite differences, Adam against its definition, and what it
learns.
"""

import numpy as np
import pytest

from workbench.algorithms.learning import neural_field, perceptron
from workbench.algorithms.learning.neural_field import (
    BATCH,
    CLAMP,
    FieldNetwork,
    encoded,
    new_network,
    train_field,
)
from workbench.geometry.fields.signed_distances import torus_sdf

TARGETS = ("sdf", "clamped", "occupancy")


def samples(n: int, seed: int = 0) -> tuple[np.ndarray, np.ndarray]:
    p = np.random.default_rng(seed).uniform(-1, 1, (n, 3))
    return p, torus_sdf(p, 0.6, 0.25)


def loss_of(
    network: FieldNetwork, values: np.ndarray, x: np.ndarray, *, y: np.ndarray, target
) -> float:
    layers = perceptron.layers_of(values, network.sizes)
    return neural_field._loss(
        perceptron.forward(layers, x, network.activation)[-1][:, 0], y, target
    )[0]


@pytest.mark.parametrize("target", TARGETS)
@pytest.mark.parametrize("activation", ["tanh", "relu"])
def test_gradients_are_those_of_finite_differences(target, activation):
    rng = np.random.default_rng(1)
    network = new_network(6, 1, activation, rng=rng)
    values = network.values.astype(float) / 3
    p, y = samples(40)
    x = encoded(p, 1).astype(float)
    y = y.astype(np.float32)
    layers = perceptron.layers_of(values, network.sizes)
    gradient = np.zeros(len(values))
    outputs = perceptron.forward(layers, x, activation)
    _, slope = neural_field._loss(outputs[-1][:, 0], y, target)
    into = perceptron.layers_of(gradient, network.sizes)
    perceptron.backward(layers, outputs, slope[:, None], activation=activation, into=into)
    for k in rng.choice(len(values), 25, replace=False):
        step = np.zeros(len(values))
        step[k] = 1e-6
        ends = [loss_of(network, values + sign * step, x, y=y, target=target) for sign in (1, -1)]
        assert gradient[k] == pytest.approx((ends[0] - ends[1]) / 2e-6, abs=2e-5)


def test_a_layer_is_its_formula_and_the_input_has_its_waves():
    network = new_network(5, 2, "tanh", rng=np.random.default_rng(2))
    p, _ = samples(7)
    x = np.concatenate(
        [p] + [f(np.pi * 2**k * p) for k in (0, 1) for f in (np.sin, np.cos)], axis=1
    )
    np.testing.assert_allclose(encoded(p, 2), x, atol=1e-6)
    (a, b), (c, d), (e, f) = perceptron.layers_of(network.values, network.sizes)
    expected = np.tanh(np.tanh(x @ a + b) @ c + d) @ e + f
    np.testing.assert_allclose(network(p), expected[:, 0], atol=1e-5)
    assert network.bytes == 4 * (15 * 5 + 5 + 5 * 5 + 5 + 5 + 1)


def test_the_loss_falls_and_states_stay_as_they_were():
    p, y = samples(3000)
    rng = np.random.default_rng(3)
    states = list(
        train_field(
            new_network(16, 1, "tanh", rng=rng),
            p,
            y.__getitem__,
            counts=(0, 20, 100, 300),
            target="sdf",
            rng=rng,
        )
    )
    losses = [state.loss for state in states]
    assert losses == sorted(losses, reverse=True)
    assert losses[-1] < 0.05 * losses[0]
    assert [state.iterations for state in states] == [0, 20, 100, 300]
    errors = [float(((state.network(p) - y) ** 2).mean()) for state in states]
    assert errors == sorted(errors, reverse=True)


@pytest.mark.parametrize("target", TARGETS)
def test_what_is_learned_is_negative_inside(target):
    p, y = samples(2000, 4)
    rng = np.random.default_rng(5)
    *_, last = train_field(
        new_network(12, 1, "tanh", rng=rng), p, y.__getitem__, counts=(300,), target=target, rng=rng
    )
    value = last.network(p)
    far = np.abs(y) > 0.05
    assert ((value < 0) == (y < 0))[far].mean() > 0.93


def test_outputs_beyond_the_clamp_learn_nothing():
    network = new_network(8, 1, "tanh", rng=np.random.default_rng(6))
    values = network.values.copy()
    values[-1] = 50 * CLAMP  # the last bias
    dead = FieldNetwork(values=values, sizes=network.sizes, frequencies=1, activation="tanh")
    p, y = samples(2 * BATCH)
    counts = (0, 50)
    _, last = train_field(
        dead, p, y.__getitem__, counts=counts, target="clamped", rng=np.random.default_rng(7)
    )
    np.testing.assert_array_equal(last.network.values, values)
