"""A multilayer perceptron and Adam, written out, with all numbers of a network in one row.

An activation follows every layer but the last.

Reference: Goodfellow, Bengio and Courville, Deep Learning, 2016, algorithms 6.3 and 6.4. Kingma and
Ba, Adam, ICLR 2015, algorithm 1. He et al., Delving deep into rectifiers, ICCV 2015 (the first
weights).
"""

from collections.abc import Callable, Iterator, Sequence
from itertools import pairwise
from typing import Literal

import numpy as np
from jaxtyping import Float

Activation = Literal["tanh", "relu"]
Layers = list[tuple[np.ndarray, np.ndarray]]
Gradient = Callable[[], tuple[float, np.ndarray]]
"""gradient() -> the loss of a new batch, and its gradient by all numbers."""

_B1, _B2, _TINY = 0.9, 0.999, 1e-8


def new_values(sizes: Sequence[int], rng: np.random.Generator) -> Float[np.ndarray, " w"]:
    """Return first weights, normal of variance 2 over the inputs, and biases of 0, for ReLU."""
    parts = []
    for into, out in pairwise(sizes):
        parts += [rng.normal(size=into * out) * np.sqrt(2 / into), np.zeros(out)]
    return np.concatenate(parts)


def count_values(sizes: Sequence[int]) -> int:
    """Return how many weights and biases layers of these sizes have."""
    return sum((into + 1) * out for into, out in pairwise(sizes))


def layers_of(values: Float[np.ndarray, " w"], sizes: Sequence[int]) -> Layers:
    """Return weights and biases of each layer, as views of the row of all numbers."""
    layers = []
    at = 0
    for into, out in pairwise(sizes):
        weights = values[at : at + into * out].reshape(into, out)
        at += into * out
        layers.append((weights, values[at : at + out]))
        at += out
    return layers


def forward(
    layers: Layers, x: Float[np.ndarray, "n a"], activation: Activation
) -> list[np.ndarray]:
    """Return what goes into each layer, and what comes out of the last."""
    outputs = [x]
    for weights, bias in layers[:-1]:
        z = outputs[-1] @ weights
        z += bias
        outputs.append(np.tanh(z, out=z) if activation == "tanh" else np.maximum(z, 0, out=z))
    weights, bias = layers[-1]
    return [*outputs, outputs[-1] @ weights + bias]


def backward(
    layers: Layers,
    outputs: list[np.ndarray],
    slope: Float[np.ndarray, "n b"],
    *,
    activation: Activation,
    into: Layers,
) -> Float[np.ndarray, "n c"]:
    """Write the gradients of all weights and biases; return that by the sums of the first layer.

    Times its weights transposed, it is the gradient by the inputs.

    Args:
        outputs: What `forward` returned.
        slope: The gradient of the loss by what comes out.
        into: Where the gradients go, as the layers lie.
    """
    for k in reversed(range(len(layers))):
        h = outputs[k]
        np.matmul(h.T, slope, out=into[k][0])
        slope.sum(axis=0, out=into[k][1])
        if k:
            slope = (slope @ layers[k][0].T) * (1 - h * h if activation == "tanh" else h > 0)
    return slope


def descend(
    values: np.ndarray, gradient: Gradient, counts: Sequence[int], *, rate: float
) -> Iterator[tuple[int, float]]:
    """Yield how many steps Adam has taken, and the mean loss since; `values` are moved in place.

    Args:
        gradient: Makes a batch, and returns its loss and the gradient, shaped as the values.
        counts: After how many steps, from 0 on (the loss of one batch); the last is the end.
        rate: The step size at the start; it falls evenly to a fifteenth at the end.

    Reference: Kingma and Ba 2015, algorithm 1.
    """
    real = values.dtype.type
    moment, square = np.zeros_like(values), np.zeros_like(values)
    done = 0
    losses = []
    for count in counts:
        while done < max(count, 1):
            loss, slope = gradient()
            losses.append(loss)
            if count == 0:
                break
            done += 1
            moment += real(1 - _B1) * (slope - moment)
            square += real(1 - _B2) * (slope * slope - square)
            step = rate * (1 - done / (1.07 * counts[-1])) / (1 - _B1**done)
            values -= (
                real(step) * moment / (np.sqrt(square * real(1 / (1 - _B2**done))) + real(_TINY))
            )
        yield done, float(np.mean(losses))
        losses = []
