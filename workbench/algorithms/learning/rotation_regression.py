"""Trains a network to tell how its input is turned, with one or another representation.

Reference: Zhou et al., On the continuity of rotation representations in neural networks, CVPR 2019,
sections 4 and 5.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from jaxtyping import Float

from workbench.algorithms.learning.perceptron import (
    backward,
    descend,
    forward,
    layers_of,
    new_values,
)
from workbench.geometry.motions.rotation_outputs import (
    Representation,
    Rotations,
    degrees_apart,
    random_rotations,
)
from workbench.tracing import traced

Compared = Literal["numbers", "matrix"]

BATCH = 64


@dataclass(frozen=True, eq=False, kw_only=True)
class Regressed:
    """A network after some updates.

    Attributes:
        loss: The mean over the batches since the last state.
        outputs: What it puts out for each test input.
        R: The rotations that these are.
        errors: Degrees to the truth, for each test input.
    """

    updates: int
    loss: float
    outputs: Float[np.ndarray, "n k"]
    R: Rotations
    errors: Float[np.ndarray, " n"]


@traced
def regress(
    representation: Representation,
    R_test: Rotations,
    *,
    largest: float,
    compared: Compared,
    width: int,
    rate: float,
    counts: Sequence[int],
    rng: np.random.Generator,
) -> Iterator[Regressed]:
    """Yield a network that is shown the entries of rotations and is to put out the same rotations.

    Args:
        R_test: Rotations on which it is tested, never drawn for training but by chance.
        largest: The largest turn of those it is trained on, radians.
        compared: What the loss compares: the numbers with those asked for, or the matrices.
        width: Numbers in each of two hidden layers.
        rate: The step size of Adam at the start.
        counts: After how many updates a state is yielded.
    """
    d = R_test.shape[1]
    sizes = (_inputs(R_test).shape[1], width, width, len(representation.start))
    values = new_values(sizes, rng)
    layers = layers_of(values, sizes)
    slopes = np.empty_like(values)
    into = layers_of(slopes, sizes)
    layers[-1][1][:] = representation.start

    def gradient() -> tuple[float, np.ndarray]:
        R_true, _ = random_rotations(BATCH, d, largest, rng=rng)
        outputs = forward(layers, _inputs(R_true), "relu")
        y = outputs[-1]
        if compared == "numbers":
            off = y - representation.numbers(R_true)
            slope = 2 * off / BATCH
        else:
            # |R - R_true|², 8 sin²(a / 2) of the angle a between them
            off = representation.decode(y) - R_true
            slope = representation.pullback(y, 2 * off / BATCH)
        backward(layers, outputs, slope, activation="relu", into=into)
        return float((off * off).sum() / BATCH), slopes

    for updates, loss in descend(values, gradient, counts, rate=rate):
        y = forward(layers, _inputs(R_test), "relu")[-1]
        R = np.asarray(representation.decode(y), float)
        yield Regressed(updates=updates, loss=loss, outputs=y, R=R, errors=degrees_apart(R, R_test))


def _inputs(R: np.ndarray) -> np.ndarray:
    """Return what the network is shown: in the plane the turned x axis, in space all entries."""
    return R[:, :, 0] if R.shape[1] == 2 else R.reshape(-1, 9)
