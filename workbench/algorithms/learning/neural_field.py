"""A neural field: a small network that is trained to give the signed distance of any point, metres.

Reference: Park et al., DeepSDF, CVPR 2019 (the clamped loss, eq. 4). Mescheder et al., Occupancy
networks, CVPR 2019. Tancik et al., Fourier features, NeurIPS 2020. Kingma and Ba, Adam, ICLR 2015,
algorithm 1.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Literal

import numpy as np
from jaxtyping import Float, Int

from workbench.algorithms.learning.perceptron import (
    Activation,
    backward,
    descend,
    forward,
    layers_of,
)
from workbench.tracing import traced

Target = Literal["sdf", "clamped", "occupancy"]

BATCH = 512
RATE = 5e-3
CLAMP = 0.1


@dataclass(frozen=True, eq=False, kw_only=True)
class FieldNetwork:
    """A network from points to one number each.

    Attributes:
        values: All weights and biases in a row, float32.
        sizes: How many numbers go into each layer, and 1 at the end.
        frequencies: Octaves of sine and cosine that go in beside the coordinates.
        activation: What follows every layer but the last.
    """

    values: Float[np.ndarray, " w"]
    sizes: tuple[int, ...]
    frequencies: int
    activation: Activation

    def __call__(self, p: Float[np.ndarray, "n 3"]) -> Float[np.ndarray, " n"]:
        """Return the field at points (m): negative inside."""
        x = encoded(p, self.frequencies)
        return forward(layers_of(self.values, self.sizes), x, self.activation)[-1][:, 0].astype(
            float
        )

    @property
    def bytes(self) -> int:
        """What it takes to keep it, with 4 bytes for each number."""
        return 4 * len(self.values)


@dataclass(frozen=True, eq=False, kw_only=True)
class Trained:
    """A network after some iterations, and the mean loss over the batches since the last state."""

    network: FieldNetwork
    iterations: int
    loss: float


def encoded(p: Float[np.ndarray, "n 3"], frequencies: int) -> Float[np.ndarray, "n k"]:
    """Return the coordinates, and sine and cosine of pi 2^k times each; float32."""
    p = p.astype(np.float32)
    waves = [
        wave(np.float32(np.pi * 2**k) * p) for k in range(frequencies) for wave in (np.sin, np.cos)
    ]
    return np.concatenate([p, *waves], axis=1)


def new_network(
    width: int,
    frequencies: int,
    activation: Activation,
    *,
    rng: np.random.Generator,
    hidden: int = 2,
) -> FieldNetwork:
    """Return a network of normal weights: variance 1 over the inputs, twice that for ReLU."""
    sizes = (3 + 6 * frequencies, *[width] * hidden, 1)
    values = []
    for k, (into, out) in enumerate(pairwise(sizes)):
        values.append(
            rng.normal(size=into * out) * np.sqrt((2 if activation == "relu" else 1) / into)
        )
        inner = k < hidden and activation == "tanh"
        values.append(rng.uniform(-0.5, 0.5, out) if inner else np.zeros(out))
    flat = np.concatenate(values).astype(np.float32)
    return FieldNetwork(values=flat, sizes=sizes, frequencies=frequencies, activation=activation)


@traced
def train_field(
    network: FieldNetwork,
    p: Float[np.ndarray, "n 3"],
    distances_of: Callable[[Int[np.ndarray, " b"]], Float[np.ndarray, " b"]],
    *,
    counts: Sequence[int],
    target: Target,
    rng: np.random.Generator,
) -> Iterator[Trained]:
    """Yield the network after so many iterations of Adam; the step size falls to near 0.

    Args:
        p: Points to learn from, m.
        distances_of: Returns the signed distances of the points in some rows, m: of a batch's, when
            it comes.
        counts: After how many iterations, from 0 on; the last is the end.
        target: What is asked for: the distance (squared error), the distance clamped to 0.1 m
            (absolute error), or inside (cross-entropy, the output being the logit of outside).
    """
    values = network.values.copy()
    layers = layers_of(values, network.sizes)
    gradients = np.zeros_like(values)
    into = layers_of(gradients, network.sizes)
    x = encoded(p, network.frequencies)

    def gradient() -> tuple[float, np.ndarray]:
        rows = rng.integers(0, len(x), BATCH)
        outputs = forward(layers, x[rows], network.activation)
        y = distances_of(rows).astype(np.float32)
        loss, slope = _loss(outputs[-1][:, 0], y, target)
        backward(layers, outputs, slope[:, None], activation=network.activation, into=into)
        return loss, gradients

    for done, loss in descend(values, gradient, counts, rate=RATE):
        trained = FieldNetwork(
            values=values.copy(),
            sizes=network.sizes,
            frequencies=network.frequencies,
            activation=network.activation,
        )
        yield Trained(network=trained, iterations=done, loss=loss)


def _loss(output: np.ndarray, y: np.ndarray, target: Target) -> tuple[float, np.ndarray]:
    """Return the mean loss of a batch, and its derivative by each output."""
    n = np.float32(len(y))
    if target == "sdf":
        off = output - y
        return float((off * off).mean()), 2 * off / n
    if target == "clamped":
        off = np.clip(output, -CLAMP, CLAMP) - np.clip(y, -CLAMP, CLAMP)
        return float(np.abs(off).mean()), np.sign(off) * (np.abs(output) < CLAMP) / n
    inside = y < 0
    share = 1 / (1 + np.exp(np.clip(output, -60, 60)))
    loss = np.logaddexp(0, np.where(inside, output, -output)).mean()
    return float(loss), (inside - share) / n
