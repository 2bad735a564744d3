"""Learns density and colour on a grid in the plane from photographs alone.

Rays begin at p and have unit directions d; lengths are in metres.

Reference: Mildenhall et al., NeRF, ECCV 2020, section 4; Sun, Sun and Chen, Direct voxel grid
optimization, CVPR 2022, section 3 (a grid in place of the network).
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float

from workbench.algorithms.learning.perceptron import descend
from workbench.geometry.cameras.volume_rendering import (
    RayWeights,
    ray_weights,
    samples_on,
    seen,
    through_seen,
)
from workbench.tracing import traced

CELLS = 32
SAMPLES = 40
RAYS = 160
RATE = 0.25
# raw density beyond the grid and at the start; 1/m that one unit is
OUTSIDE = -6.0
LEAST = -2.0
PER_UNIT = 10.0


@dataclass(frozen=True, eq=False, kw_only=True)
class RadianceField:
    """A square grid over (-1, 1)².

    Attributes:
        raw: Of each node, x first: one number that becomes density, three that become colour.
        reach: From where to where rays are sampled.
    """

    raw: Float[np.ndarray, "k 4"]
    reach: tuple[float, float]

    @property
    def density(self) -> Float[np.ndarray, "n n"]:
        """Density at the nodes, 1/m, x first."""
        return PER_UNIT * np.logaddexp(0, self.raw[:, 0]).reshape(CELLS, CELLS)

    @property
    def color(self) -> Float[np.ndarray, "n n 3"]:
        """Colour at the nodes, 0 to 1, x first."""
        return _logistic(self.raw[:, 1:]).reshape(CELLS, CELLS, 3)

    def at(self, p: Float[np.ndarray, "r s 2"]) -> tuple[np.ndarray, np.ndarray]:
        """Return density and colour, linear between nodes before they are made positive."""
        return _at(self.raw, *_between(p))[:2]

    def along(
        self,
        p: Float[np.ndarray, "r 2"],
        d: Float[np.ndarray, "r 2"],
        ray_weights: RayWeights = ray_weights,
    ) -> tuple[Float[np.ndarray, "r s"], Float[np.ndarray, "r 3"]]:
        """Return the weights along rays and the colours that they see."""
        q, spacing = samples_on(p, d, self.reach, count=SAMPLES)
        density, color = self.at(q)
        weights = np.asarray(ray_weights(density, spacing), float)
        return weights, seen(weights, color)


@dataclass(frozen=True, eq=False, kw_only=True)
class Reconstructed:
    """A field after some updates, and the mean squared difference to the photographs meanwhile."""

    updates: int
    loss: float
    field: RadianceField


@traced
def reconstruct(
    p: Float[np.ndarray, "r 2"],
    d: Float[np.ndarray, "r 2"],
    colors: Float[np.ndarray, "r 3"],
    *,
    reach: tuple[float, float],
    counts: Sequence[int],
    rng: np.random.Generator,
    ray_weights: RayWeights = ray_weights,
) -> Iterator[Reconstructed]:
    """Yield a field as it comes to look like photographs.

    Args:
        colors: What the pixels show, 0 to 1.
        reach: From where to where rays are sampled.
        counts: After how many updates a state is yielded.
        ray_weights: Computes how much each sample of a ray counts.
    """
    raw = np.zeros((CELLS * CELLS, 4))
    raw[:, 0] = LEAST

    def gradient() -> tuple[float, np.ndarray]:
        rays = rng.integers(len(p), size=RAYS)
        q, spacing = samples_on(
            p[rays], d[rays], reach, count=SAMPLES, shift=rng.random((RAYS, SAMPLES))
        )
        nodes, shares = _between(q)
        density, color, by_raw = _at(raw, nodes, shares)
        off = seen(np.asarray(ray_weights(density, spacing), float), color) - colors[rays]
        by_density, by_color = through_seen(2 * off / off.size, density, color, spacing=spacing)
        slope = np.concatenate([by_density[:, :, None], by_color], axis=2) * by_raw
        into = (
            np.bincount(nodes.ravel(), (shares * slope[:, :, None, k]).ravel(), len(raw))
            for k in range(4)
        )
        return float((off * off).mean()), np.stack(list(into), axis=1)

    for updates, loss in descend(raw, gradient, counts, rate=RATE):
        yield Reconstructed(
            updates=updates, loss=loss, field=RadianceField(raw=raw.copy(), reach=reach)
        )


def _between(p: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the four nodes about each point, and their shares; none beyond the grid."""
    at = (p + 1) / 2 * (CELLS - 1)
    inside = np.all((at >= 0) & (at <= CELLS - 1), axis=-1)
    at = np.clip(at, 0, CELLS - 1 - 1e-6)
    low = at.astype(int)
    fx, fy = np.moveaxis(at - low, -1, 0)
    node = low[..., 0] * CELLS + low[..., 1]
    shares = np.stack([(1 - fx) * (1 - fy), fx * (1 - fy), (1 - fx) * fy, fx * fy], axis=-1)
    return np.stack(
        [node, node + CELLS, node + 1, node + CELLS + 1], axis=-1
    ), shares * np.expand_dims(inside, -1)


def _at(
    raw: np.ndarray, nodes: np.ndarray, shares: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return density and colour, and the derivatives of all four by what the nodes add up to."""
    mixed = np.einsum("rsk,rskc->rsc", shares, raw[nodes])
    rate = mixed[:, :, 0] + OUTSIDE * (1 - shares.sum(axis=-1))
    color = _logistic(mixed[:, :, 1:])
    slopes = np.concatenate([PER_UNIT * _logistic(rate)[:, :, None], color * (1 - color)], axis=2)
    return PER_UNIT * np.logaddexp(0, rate), color, slopes


def _logistic(x: np.ndarray) -> np.ndarray:
    return 0.5 * (1 + np.tanh(0.5 * x))
