"""Graph convolutional networks: one layer in its parts, many layers in a row, and training.

Reference: Kipf and Welling, Semi-supervised classification with graph convolutional networks, ICLR
2017.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from jaxtyping import Float, Int

from workbench.geometry.graphs import adjacency as graphs
from workbench.tracing import traced

GcnLayer = Callable[[np.ndarray, np.ndarray, np.ndarray], np.ndarray]
"""gcn_layer(adjacency, features, weights) -> features."""
Part = Literal["input", "loops", "normalised", "gathered", "layer"]


@dataclass(frozen=True, eq=False)
class Layer:
    """Features of the nodes, one row each, after a part of the first layer or after a whole one.

    Attributes:
        layer: How many layers are behind them; that of a part counts.
        part: What was done last.
        matrix: What gathers: A, then A + I, then its normalised form.
    """

    layer: int
    part: Part
    features: Float[np.ndarray, "n c"]
    matrix: Float[np.ndarray, "n n"]


@traced
def spread(
    adjacency: Float[np.ndarray, "n n"],
    features: Float[np.ndarray, "n c"],
    weights: Sequence[np.ndarray],
    *,
    gcn_layer: GcnLayer = graphs.gcn_layer,
) -> Iterator[Layer]:
    """Yield the features of all nodes, the parts of the first layer, then every layer whole.

    The adjacency is dense, symmetric and without loops.
    """
    yield Layer(0, "input", features, adjacency)
    if weights:
        yield Layer(1, "loops", features, adjacency + np.eye(len(adjacency)))
        gathers = graphs.propagation(adjacency)
        yield Layer(1, "normalised", features, gathers)
        yield Layer(1, "gathered", gathers @ features, gathers)
        for layer, w in enumerate(weights, 1):
            # eq. (2): ReLU(A_hat X W)
            features = np.asarray(gcn_layer(adjacency, features, w), float)
            yield Layer(layer, "layer", features, gathers)


@dataclass(frozen=True, eq=False)
class Trained:
    """A network after some steps of training.

    Attributes:
        loss: The cross-entropy over the labelled nodes.
        scores: The last layer's, a row per node, a column per class; the largest decides.
    """

    iteration: int
    loss: float
    scores: Float[np.ndarray, "n c"]


@traced
def train(
    adjacency: Float[np.ndarray, "n n"],
    features: Float[np.ndarray, "n a"],
    weights: Sequence[np.ndarray],
    *,
    labelled: Int[np.ndarray, " m"],
    classes: Int[np.ndarray, " m"],
    iterations: int = 200,
    rate: float = 0.05,
    gcn_layer: GcnLayer = graphs.gcn_layer,
) -> Iterator[Trained]:
    """Yield a network before and after every step of Adam; the last layer has no ReLU.

    Args:
        adjacency: A, dense, symmetric, without loops.
        labelled: The nodes whose class is known.
        classes: Their classes.
        rate: Adam's step size; its other numbers are the usual ones.
        gcn_layer: Computes every layer but the last.

    Reference: Kipf and Welling 2017, eq. 9 and 10; Kingma and Ba, Adam, 2015, algorithm 1.
    """
    gathers = graphs.propagation(graphs.sparse(adjacency))  # most of A is zero
    w = list(weights)
    mean, square = [np.zeros_like(W) for W in w], [np.zeros_like(W) for W in w]
    for iteration in range(iterations + 1):
        hidden = [features]
        for W in w[:-1]:
            hidden.append(np.asarray(gcn_layer(adjacency, hidden[-1], W), float))
        scores = gathers @ hidden[-1] @ w[-1]
        chance = softmax(scores[labelled])
        loss = -float(np.log(chance[np.arange(len(labelled)), classes] + 1e-300).mean())  # eq. (10)
        yield Trained(iteration, loss, scores)

        back = np.zeros_like(scores)
        chance[np.arange(len(labelled)), classes] -= 1.0
        back[labelled] = chance / len(labelled)
        for layer in reversed(range(len(w))):
            carried = gathers @ back  # the matrix is symmetric: its transpose is itself
            slope = hidden[layer].T @ carried
            back = (carried @ w[layer].T) * (hidden[layer] > 0)
            mean[layer] = 0.9 * mean[layer] + 0.1 * slope
            square[layer] = 0.999 * square[layer] + 0.001 * slope**2
            unbiased = (
                mean[layer] / (1 - 0.9 ** (iteration + 1)),
                square[layer] / (1 - 0.999 ** (iteration + 1)),
            )
            w[layer] = w[layer] - rate * unbiased[0] / (np.sqrt(unbiased[1]) + 1e-8)


def softmax(scores: Float[np.ndarray, "n c"]) -> Float[np.ndarray, "n c"]:
    """Return each row's scores as probabilities (Kipf and Welling 2017, eq. 9)."""
    raised = np.exp(scores - scores.max(axis=1, keepdims=True))
    return raised / raised.sum(axis=1, keepdims=True)
