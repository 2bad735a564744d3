"""Write how much each point counts under Huber's loss. The lesson's robust fits of a plane take
their weights from you, round by round: choose the preset drift.
"""

import numpy as np
from jaxtyping import Float

from lessons.fitting.exercises import STUDENTS, entries
from workbench.algorithms.robust import estimators as robust
from workbench.exercise import (
    Function,
    Verdict,
    alternative,
    check,
    contract,
    left_alone,
    mistake,
    worst,
)


@contract(
    slot="huber_weights",
    preset="drift",
    examples=(
        ("huber_weights(array([-5., -0.5, 0., 2.]), 1.0)", "[0.2, 1, 1, 0.5]"),
        ("huber_weights(array([1., 3.]), 1.5)", "[1, 0.5]"),
    ),
)
def huber_weights(residuals: Float[np.ndarray, " n"], corner: float) -> Float[np.ndarray, " n"]:
    """Return the weights with which least squares has the slope of Huber's loss.

    The loss is r² / 2 up to the corner on both sides, and goes straight on from there: corner (|r|
    − corner / 2). A weight is its slope divided by r, 1 at r = 0.

    Args:
        residuals: Signed distances, metres.
        corner: Where the loss bends, metres, above 0.
    """
    return robust.huber_weights(residuals, corner)


HINT = "The weight is 1 up to the corner on both sides, and corner / |r| beyond."


def some_residuals(seed: int, corner: float, n: int = 15) -> np.ndarray:
    """Return residuals on both sides of a corner, of both signs."""
    return corner * np.random.default_rng(seed).normal(size=n) * 3.0


def judged(candidate: Function, residuals: np.ndarray, corner: float) -> Verdict:
    """Judge weights by their entries."""
    return entries(
        "Weights", candidate(residuals, corner), robust.huber_weights(residuals, corner), HINT
    )


@check(2)
def near_points_count_fully(candidate: Function) -> Verdict:
    """Points within the corner have weight 1, on either side and at 0."""
    return judged(candidate, np.array([-0.9, -0.2, 0.0, 0.3, 1.0]), 1.0)


@check(3)
def far_points_count_less(candidate: Function) -> Verdict:
    """Points beyond the corner lose weight with their distance, on either side."""
    return worst(
        judged(candidate, some_residuals(STUDENTS + k, corner), corner)
        for k, corner in enumerate((1.0, 0.03))
    )


@check(1)
def residuals_are_left_alone(candidate: Function) -> Verdict:
    """The residuals that come in are not changed."""
    return left_alone(candidate, judged(candidate, some_residuals(STUDENTS + 3, 0.5), 0.5))


@mistake(
    "Points far on the negative side have weight 1, or more: take the absolute value of a residual."
)
def no_absolute(residuals: np.ndarray, corner: float) -> np.ndarray:
    """Compares signed residuals."""
    return corner / np.maximum(residuals, corner)


@mistake(
    "Your weights are squared: corner² / r² falls too fast. The slope of Huber's loss beyond the"
    " corner is corner, divided by r."
)
def squared(residuals: np.ndarray, corner: float) -> np.ndarray:
    """Squares the weights."""
    return robust.huber_weights(residuals, corner) ** 2


@mistake("You return the slope ψ(r) of the loss, clipped at the corner. A weight is ψ(r) / r.")
def slope(residuals: np.ndarray, corner: float) -> np.ndarray:
    """Clips."""
    return np.clip(residuals, -corner, corner)


@mistake("You return the loss. A weight is the slope of the loss divided by r.")
def loss(residuals: np.ndarray, corner: float) -> np.ndarray:
    """Returns the loss."""
    return robust.huber_loss(residuals, corner)


@mistake(
    "You cut: 1 within the corner and 0 beyond. Huber lets far points pull, with corner / |r|."
)
def cut(residuals: np.ndarray, corner: float) -> np.ndarray:
    """Leaves far points out."""
    return (np.abs(residuals) <= corner).astype(float)


@mistake(
    "Near points have weights above 1 in your answer. Up to the corner every point counts alike: at"
    " most 1."
)
def unbounded(residuals: np.ndarray, corner: float) -> np.ndarray:
    """Takes corner / |r| everywhere."""
    return corner / np.maximum(np.abs(residuals), 1e-9)


@mistake("Your fraction is upside down: far points weigh more, |r| / corner. Turn it over.")
def upside_down(residuals: np.ndarray, corner: float) -> np.ndarray:
    """Takes |r| / corner."""
    return np.maximum(np.abs(residuals), corner) / corner


@mistake(
    "You took the square root of the weights, which multiplies rows of a linear problem. The"
    " weights themselves are asked for."
)
def square_root(residuals: np.ndarray, corner: float) -> np.ndarray:
    """Takes the root."""
    return np.sqrt(robust.huber_weights(residuals, corner))


@mistake(
    "Beyond the corner your weight is 1 / |r|. It is corner / |r|, so that it goes on from 1"
    " without a jump."
)
def jumps(residuals: np.ndarray, corner: float) -> np.ndarray:
    """Forgets the corner in the numerator."""
    far = np.abs(residuals)
    return np.where(far <= corner, 1.0, 1.0 / np.where(far > 0, far, 1.0))


@mistake(
    "These are the weights of Cauchy's loss, 1 / (1 + (r / corner)²). Huber's are exactly 1 up to"
    " the corner."
)
def cauchy(residuals: np.ndarray, corner: float) -> np.ndarray:
    """Takes another loss."""
    return robust.CAUCHY.weights(residuals, corner)


@mistake(
    "These are the weights of Tukey's loss, 0 beyond the corner. Huber's are corner / |r| there,"
    " and exactly 1 within."
)
def tukey(residuals: np.ndarray, corner: float) -> np.ndarray:
    """Takes another loss."""
    return robust.TUKEY.weights(residuals, corner)


@mistake("A residual of 0 makes your weight 0 / 0. Its weight is 1: divide only beyond the corner.")
def zero_by_zero(residuals: np.ndarray, corner: float) -> np.ndarray:
    """Divides the slope by r wherever."""
    with np.errstate(all="ignore"):
        return np.clip(residuals, -corner, corner) / residuals


@alternative
def by_minimum(residuals: np.ndarray, corner: float) -> np.ndarray:
    """Takes the smaller of 1 and corner / |r|."""
    return np.minimum(1.0, corner / np.maximum(np.abs(residuals), 1e-300))


@alternative
def one_by_one(residuals: np.ndarray, corner: float) -> list[float]:
    """Goes point by point."""
    return [1.0 if abs(r) <= corner else float(corner / abs(r)) for r in residuals]
