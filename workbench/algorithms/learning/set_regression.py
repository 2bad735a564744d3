"""Moves points to be like many targets at once; what remains is what the loss calls the mean.

Reference: Fan, Su and Guibas, A point set generation network, CVPR 2017, section 3.3 and figure 4.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
import scipy
from jaxtyping import Float

from workbench.algorithms.learning.perceptron import descend
from workbench.algorithms.transport import best_assignment
from workbench.geometry.points.shape_distances import chamfer, chamfer_gradient
from workbench.tracing import traced

ChamferGradient = Callable[[np.ndarray, np.ndarray], np.ndarray]
"""chamfer_gradient(p, q) -> the gradient of the Chamfer distance by p."""
SetLoss = Literal["Chamfer", "earth mover's"]

BATCH = 4
RATE = 0.03


@dataclass(frozen=True, eq=False, kw_only=True)
class SetLearned:
    """The points after some updates, the mean loss meanwhile, m², and the last targets."""

    updates: int
    loss: float
    p: Float[np.ndarray, "n 3"]
    targets: Float[np.ndarray, "b n 3"]


@traced
def learn_set(
    p: Float[np.ndarray, "n 3"],
    draw: Callable[[], Float[np.ndarray, "n 3"]],
    *,
    set_loss: SetLoss,
    counts: Sequence[int],
    chamfer_gradient: ChamferGradient = chamfer_gradient,
) -> Iterator[SetLearned]:
    """Yield the points as they move down the mean loss to ever new targets.

    Args:
        draw: Makes a target, as many points.
        set_loss: Nearest both ways, or one to one; both of squares.
        counts: After how many updates a state is yielded.
        chamfer_gradient: Computes one gradient of the first loss.
    """
    p = p.copy()
    targets = np.empty((0, len(p), 3))

    def gradient() -> tuple[float, np.ndarray]:
        nonlocal targets
        targets = np.stack([draw() for _ in range(BATCH)])
        loss = 0.0
        slope = np.zeros_like(p)
        for q in targets:
            if set_loss == "Chamfer":
                loss += chamfer(p, q) / BATCH
                slope += np.asarray(chamfer_gradient(p, q), float) / BATCH
            else:
                _, to = best_assignment(scipy.spatial.distance.cdist(p, q, "sqeuclidean"))
                off = p - q[to]
                loss += float((off * off).sum()) / len(p) / BATCH
                slope += 2 * off / len(p) / BATCH
        return loss, slope

    for updates, loss in descend(p, gradient, counts, rate=RATE):
        yield SetLearned(updates=updates, loss=loss, p=p.copy(), targets=targets)
