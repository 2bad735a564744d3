"""Robust fits: they use all points at once, and trust each by its distance."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from enum import Enum

import numpy as np
from jaxtyping import Float

from workbench.algorithms.robust.models import Model
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
        iteration: 0 is where it starts: the plain least-squares fit, if nothing else was given.
        distances: Of each row to the estimate, in the unit of the model.
        weights: How much each row's squared distance counted in this fit.
        cost: The sum of the loss at these distances.
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
    far = np.abs(distances)
    return np.where(far <= corner, 0.5 * distances**2, corner * (far - 0.5 * corner))


def huber_weights(distances: Float[np.ndarray, " n"], corner: float) -> Float[np.ndarray, " n"]:
    """Return the weights that give least squares the slope of Huber's loss: 1, then corner/|d|."""
    return corner / np.maximum(np.abs(distances), corner)


@dataclass(frozen=True, kw_only=True)
class Loss:
    """What a distance costs.

    Attributes:
        efficient_corner: In standard deviations of the noise: where the corner costs 5 % of the
            points when all are good.
        cost: From distances of either sign and a corner the loss of each.
        weights: Likewise the weights that give least squares its slope: slope / distance.
    """

    name: str
    efficient_corner: float
    cost: Callable[[np.ndarray, float], np.ndarray]
    weights: Callable[[np.ndarray, float], np.ndarray]


def _tukey_cost(distances: np.ndarray, corner: float) -> np.ndarray:
    return corner**2 / 6.0 * (1.0 - np.maximum(1.0 - np.square(distances / corner), 0.0) ** 3)


SQUARES = Loss(
    name="squares",
    efficient_corner=np.inf,
    cost=lambda distances, corner: 0.5 * np.square(distances),
    weights=lambda distances, corner: np.ones(len(distances)),
)
HUBER = Loss(name="Huber", efficient_corner=1.345, cost=huber_loss, weights=huber_weights)
CAUCHY = Loss(
    name="Cauchy",
    efficient_corner=2.385,
    cost=lambda distances, corner: 0.5 * corner**2 * np.log1p(np.square(distances / corner)),
    weights=lambda distances, corner: 1.0 / (1.0 + np.square(distances / corner)),
)
GEMAN_MCCLURE = Loss(
    name="Geman-McClure",
    efficient_corner=3.787,
    cost=lambda distances, corner: (
        0.5 * np.square(distances) / (1.0 + np.square(distances / corner))
    ),
    weights=lambda distances, corner: 1.0 / np.square(1.0 + np.square(distances / corner)),
)
TUKEY = Loss(
    name="Tukey",
    efficient_corner=4.685,
    cost=_tukey_cost,
    weights=lambda distances, corner: np.square(
        np.maximum(1.0 - np.square(distances / corner), 0.0)
    ),
)
LOSSES = {loss.name: loss for loss in (SQUARES, HUBER, CAUCHY, GEMAN_MCCLURE, TUKEY)}


@dataclass(frozen=True, eq=False)
class Trusted:
    """A round of one of several reweighted fits, each from the end of the one before.

    Attributes:
        corner: Where the loss bends, in the unit of the model's distances.
        first: The estimate that all began with, of plain least squares.
        last: Whether no other round follows.
    """

    loss: Loss
    corner: float
    now: Reweighted
    first: Float[np.ndarray, "..."]
    last: bool


def cascade(
    p: Float[np.ndarray, "n d"],
    model: Model,
    losses: Sequence[tuple[Loss, float]],
    *,
    max_iterations: int,
    tolerance: float,
) -> Iterator[Trusted]:
    """Yield the rounds of fits with several losses, each with its corner, one from the other's end.

    Raises:
        ValueError: As `reweighted_fit`.

    Reference: Maronna, Martin, Yohai and Salibian-Barrera, Robust Statistics, 2nd ed., 2019, 5.5: a
    loss whose slope returns to zero starts from a fit that is robust already.
    """
    first, fit = None, None
    for k, (loss, corner) in enumerate(losses):
        start = fit.estimate if fit else None
        for fit in reweighted_fit(
            p,
            model,
            loss,
            corner=corner,
            start=start,
            max_iterations=max_iterations,
            tolerance=tolerance,
        ):
            first = fit.estimate if first is None else first
            if start is None or fit.iteration > 0:
                yield Trusted(
                    loss, corner, fit, first, fit.stop is not None and k == len(losses) - 1
                )


@traced
def reweighted_fit(
    p: Float[np.ndarray, "n d"],
    model: Model,
    loss: Loss,
    *,
    corner: float,
    start: Float[np.ndarray, "..."] | None = None,
    max_iterations: int = 50,
    tolerance: float = 1e-4,
) -> Iterator[Reweighted]:
    """Yield the iterations of a robust fit by iteratively reweighted least squares.

    Under Huber's loss a far outlier pulls with the same force as one at the corner: many on one
    side win. Losses whose slope returns to 0 have several minima: where they start decides.

    Args:
        corner: The distance from which the loss grows less than the square, in the model's unit.
        start: The plain fit to all rows if None.
        tolerance: Converged when no distance changes by more than this share of the corner.

    Raises:
        ValueError: If there are too few rows for the model's refit, or too few of them keep a
            weight.

    Reference: Holland and Welsch, Robust regression using iteratively reweighted least-squares,
    1977.
    """
    weights = np.ones(len(p))
    estimate = model.refit(p, weights) if start is None else start
    distances = model.distances(estimate, p)
    yield Reweighted(0, estimate, distances, weights, float(loss.cost(distances, corner).sum()))

    for iteration in range(1, max_iterations + 1):
        weights = loss.weights(distances, corner)
        estimate = model.refit(p, weights, estimate)
        before = distances
        distances = model.distances(estimate, p)
        stop = Settled.MAX_ITERATIONS if iteration == max_iterations else None
        if np.abs(distances - before).max() <= tolerance * corner:
            stop = Settled.CONVERGED
        yield Reweighted(
            iteration, estimate, distances, weights, float(loss.cost(distances, corner).sum()), stop
        )
        if stop:
            return
