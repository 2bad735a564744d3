"""PointNet: a network for each point, one pooling over all points, a network for what is pooled.

Reference: Qi et al., PointNet: Deep learning on point sets for 3D classification and segmentation,
CVPR 2017, section 4 (eq. 1; theorem 2 on critical points), without its transforming networks.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from jaxtyping import Float, Int

from workbench.algorithms.learning.graph_network import softmax
from workbench.algorithms.learning.perceptron import (
    backward,
    count_values,
    descend,
    forward,
    layers_of,
    new_values,
)
from workbench.tracing import traced

Pool = Literal["max", "mean", "none"]
Clouds = Float[np.ndarray, "b n 3"]

POINTWISE = (3, 16, 32, 64)
HEAD = 32
FLAT = 128
BATCH = 24
RATE = 6e-3


@dataclass(frozen=True, eq=False, kw_only=True)
class PointNet:
    """A network from clouds to scores.

    Attributes:
        values: All weights and biases in a row.
        pointwise: Sizes of the layers that every point goes through alone.
        head: Sizes of the layers behind the pooling.
        pool: How the points' features become one row; with "none" the points themselves stand in a
            row.
    """

    values: Float[np.ndarray, " w"]
    pointwise: tuple[int, ...]
    head: tuple[int, ...]
    pool: Pool

    def __call__(self, clouds: Clouds) -> Float[np.ndarray, "b c"]:
        """Return one row of scores for each cloud; the largest names the class."""
        return self.run(clouds).head[-1]

    def critical(self, clouds: Clouds) -> list[Int[np.ndarray, " k"]]:
        """Return for each cloud the points with the largest of some feature: they decide."""
        return [np.unique(row) for row in self.run(clouds).winners]

    def run(self, clouds: Clouds) -> "Pass":
        """Return what happens on the way."""
        of_points, of_head = self._layers(self.values)
        count, n, _ = clouds.shape
        clouds = clouds.astype(self.values.dtype)
        if self.pool == "none":
            x = clouds.reshape(count, -1)
            return Pass(
                points=[],
                features=x,
                winners=np.empty((count, 0), int),
                head=forward(of_head, x, "relu"),
            )
        outputs = forward(of_points, clouds.reshape(-1, 3), "relu")
        features = np.maximum(outputs[-1], 0).reshape(count, n, -1)
        winners = features.argmax(axis=1)
        largest = np.take_along_axis(features, winners[:, None], 1)[:, 0]  # eq. (1)
        pooled = largest if self.pool == "max" else features.mean(axis=1)
        return Pass(
            points=outputs,
            features=features,
            winners=winners,
            head=forward(of_head, pooled, "relu"),
        )

    def slopes(self, done: "Pass", slope: Float[np.ndarray, "b c"]) -> Float[np.ndarray, " w"]:
        """Return the gradient by all values, given that by the scores of a pass."""
        gradient = np.zeros_like(self.values)
        of_points, of_head = self._layers(self.values)
        into_points, into_head = self._layers(gradient)
        by_pooled = (
            backward(of_head, done.head, slope, activation="relu", into=into_head) @ of_head[0][0].T
        )
        if self.pool == "none":
            return gradient
        by_features = np.zeros_like(done.features)
        if self.pool == "max":
            np.put_along_axis(by_features, done.winners[:, None], by_pooled[:, None], 1)
        else:
            by_features += by_pooled[:, None] / done.features.shape[1]
        by_features *= done.features > 0
        backward(
            of_points,
            done.points,
            by_features.reshape(-1, by_features.shape[2]),
            activation="relu",
            into=into_points,
        )
        return gradient

    def _layers(self, values: np.ndarray) -> tuple:
        split = count_values(self.pointwise)
        return layers_of(values[:split], self.pointwise), layers_of(values[split:], self.head)


@dataclass(frozen=True, eq=False, kw_only=True)
class Pass:
    """What went through a network.

    Attributes:
        points: What went into each layer of the points, and came out.
        features: Of each point of each cloud, (b, n, c); without pooling the inputs, (b, 3 n).
        winners: Which point has the largest of each feature, (b, c).
        head: What went into each layer behind the pooling, and came out.
    """

    points: list[np.ndarray]
    features: np.ndarray
    winners: np.ndarray
    head: list[np.ndarray]


@dataclass(frozen=True, eq=False, kw_only=True)
class Classified:
    """A network after some updates, its mean loss since the last state, its scores by test."""

    updates: int
    loss: float
    network: PointNet
    scores: Mapping[str, Float[np.ndarray, "t c"]]


@traced
def train_classifier(
    pool: Pool,
    draw: Callable[[int], tuple[Clouds, Int[np.ndarray, " b"]]],
    tests: Mapping[str, Clouds],
    *,
    classes: int,
    counts: Sequence[int],
    rng: np.random.Generator,
) -> Iterator[Classified]:
    """Yield a network that learns to name the shape of a cloud.

    Args:
        draw: Makes so many clouds, with their classes.
        tests: Clouds on which it is tried.
        counts: After how many updates a state is yielded.
    """
    n = next(iter(tests.values())).shape[1]
    pointwise = POINTWISE if pool != "none" else ()
    head = (POINTWISE[-1], HEAD, classes) if pool != "none" else (3 * n, FLAT, HEAD, classes)
    values = np.concatenate(
        [new_values(sizes, rng) for sizes in (pointwise, head) if sizes]
    ).astype(np.float32)
    network = PointNet(values=values, pointwise=pointwise, head=head, pool=pool)

    def gradient() -> tuple[float, np.ndarray]:
        clouds, of = draw(BATCH)
        done = network.run(clouds)
        rows = np.arange(len(of))
        slope = softmax(done.head[-1])
        loss = -float(np.log(slope[rows, of] + 1e-300).mean())
        slope[rows, of] -= 1
        return loss, network.slopes(done, slope / len(of))

    for updates, loss in descend(values, gradient, counts, rate=RATE):
        trained = PointNet(values=values.copy(), pointwise=pointwise, head=head, pool=pool)
        yield Classified(
            updates=updates,
            loss=loss,
            network=trained,
            scores={name: trained(clouds) for name, clouds in tests.items()},
        )
