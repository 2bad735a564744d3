"""Huber's fit: it uses all points at once, and trusts each by its distance."""

from collections.abc import Iterator
from dataclasses import dataclass
from enum import Enum

import numpy as np
from jaxtyping import Float

from workbench.algorithms.models import Model
from workbench.tracing import traced


class Settled(Enum):
    """Why the iteration ended."""

    CONVERGED = "converged: no distance changed by more than the tolerance"
    MAX_ITERATIONS = "the maximum number of iterations is reached"

    @property
    def message(self) -> str:
        """The reason in words."""
        return self.value


@dataclass(frozen=True, eq=False)
class Reweighted:
    """One iteration of a reweighted fit.

    Attributes:
        iteration: 0 is the plain least-squares fit.
        estimate: The parameters.
        distances: Of each row to it, in the unit of the model.
        weights: How much each row's squared distance counted in this fit.
        cost: The sum of Huber's loss at these distances.
        stop: Why this is the last state, or None.
    """

    iteration: int
    estimate: Float[np.ndarray, "..."]
    distances: Float[np.ndarray, " n"]
    weights: Float[np.ndarray, " n"]
    cost: float
    stop: Settled | None = None


def huber_loss(distances: Float[np.ndarray, " n"], corner: float) -> Float[np.ndarray, " n"]:
    """Return Huber's loss: half the square up to the corner, and straight on from there.

    Reference: Huber, Robust estimation of a location parameter, 1964.
    """
    return np.where(distances <= corner, 0.5 * distances**2, corner * (distances - 0.5 * corner))


def huber_weights(distances: Float[np.ndarray, " n"], corner: float) -> Float[np.ndarray, " n"]:
    """Return the weights that give least squares the slope of Huber's loss: 1 up to the corner, then corner / distance."""
    return corner / np.maximum(distances, corner)


@traced
def huber_fit(
    p: Float[np.ndarray, "n d"], model: Model, *, corner: float, max_iterations: int = 50, tolerance: float = 1e-4
) -> Iterator[Reweighted]:
    """Yield the iterations of Huber's robust fit by iteratively reweighted least squares, from the plain fit on.

    Args:
        p: The rows: points, or matches.
        model: What to fit.
        corner: The distance from which the loss grows linearly, in the unit of the model's distances.
        max_iterations: Reweighted fits at most.
        tolerance: Converged when no distance changes by more than this share of the corner.

    Raises:
        ValueError: If there are too few rows for the model's refit.

    Note:
        A far outlier pulls with the same force as one at the corner, but it does pull: many on one side win.
    Reference: Holland and Welsch, Robust regression using iteratively reweighted least-squares, 1977.
    """
    weights = np.ones(len(p))
    estimate = model.refit(p, weights)
    distances = model.distances(estimate, p)
    yield Reweighted(0, estimate, distances, weights, float(huber_loss(distances, corner).sum()))

    for iteration in range(1, max_iterations + 1):
        weights = huber_weights(distances, corner)
        estimate = model.refit(p, weights, estimate)
        before, distances = distances, model.distances(estimate, p)
        stop = Settled.MAX_ITERATIONS if iteration == max_iterations else None
        if np.abs(distances - before).max() <= tolerance * corner:
            stop = Settled.CONVERGED
        yield Reweighted(iteration, estimate, distances, weights, float(huber_loss(distances, corner).sum()), stop)
        if stop:
            return
