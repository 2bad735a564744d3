"""Write what a share of hits tells: the volume, and how far off it is likely to be. The lesson
throws points into a box and draws your interval around your estimate.
"""

import numpy as np
from jaxtyping import Bool

from lessons.measures.exercises import STUDENTS, relative_verdict
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
from workbench.geometry.points import sampling


@contract(
    slot="volume_by_chance",
    preset="throws",
    examples=(
        ("volume_by_chance(np.array([True, False, True, True]), 8.0)", "(6.0, 1.73205)"),
        ("volume_by_chance(np.array([False, False]), 8.0)", "(0.0, 0.0)"),
    ),
)
def volume_by_chance(inside: Bool[np.ndarray, " n"], box_volume: float) -> tuple[float, float]:
    """Return the volume that hits among random points of a box tell, and the standard error of
    that, both in m^3.

    Of n points a share lies inside; it is binomial, with the variance share (1 - share) / n.

    Args:
        inside: Which of n points, evenly drawn in the box, lie inside.
        box_volume: The volume of the box, m^3.

    Returns:
        The estimate and its standard error (one standard deviation of the estimate): (estimate,
        error).

    Raises:
        ValueError: If there are no points.
    """
    return sampling.volume_by_chance(inside, box_volume)


SHARE_HINT = "The estimate is the share of hits times the volume of the box."
ERROR_HINT = "The error is box_volume * sqrt(share * (1 - share) / n)."


def hits(n: int, count: int, seed: int) -> np.ndarray:
    """Return n throws with so many hits among them."""
    return np.random.default_rng(seed).permutation(np.arange(n) < count)


def both(candidate: Function, inside: np.ndarray, box: float) -> Verdict:
    """Judge estimate and error of one call; n - 1 in place of n is as good."""
    value, error = candidate(inside, box)
    right = sampling.volume_by_chance(inside, box)
    case = f"{int(inside.sum())} of {len(inside)} in {box:g} m³"
    return worst(
        (
            relative_verdict(
                f"{case}, estimate", float(value), right[0], SHARE_HINT, good=0.01, fair=0.5
            ),
            relative_verdict(
                f"{case}, error", float(error), right[1], ERROR_HINT, good=1.0, fair=2.0
            ),
        )
    )


@check(2)
def share_of_the_box(candidate: Function) -> Verdict:
    """The estimate is the box times the share of hits."""
    verdicts = []
    for n, count, box in ((1000, 524, 8.0), (400, 100, 2.0)):
        inside = hits(n, count, STUDENTS)
        value = float(candidate(inside, box)[0])
        case = f"{count} of {n} in {box:g} m³"
        verdicts.append(
            relative_verdict(case, value, box * count / n, SHARE_HINT, good=0.01, fair=0.5)
        )
    return worst(verdicts)


@check(2)
def standard_error(candidate: Function) -> Verdict:
    """1,000 throws into a box of 8 m³ leave a standard error of 0.126 m³ at a share of a half."""
    inside = hits(1000, 524, STUDENTS)
    error = float(candidate(inside, 8.0)[1])
    right = sampling.volume_by_chance(inside, 8.0)[1]
    return relative_verdict("524 of 1000 in 8 m³", error, right, ERROR_HINT, good=1.0, fair=2.0)


@check(1)
def hits_are_left_alone(candidate: Function) -> Verdict:
    """The hits that come in are not changed."""
    return left_alone(candidate, both(candidate, hits(500, 200, STUDENTS), 1.0))


def _share(inside: np.ndarray) -> float:
    if len(inside) == 0:
        raise ValueError("no points")
    return float(inside.mean())


@mistake(
    "Your error does not fall with the number of throws: divide share (1 - share) by n before you"
    " take the root."
)
def no_root_of_n(inside: np.ndarray, box_volume: float) -> tuple[float, float]:
    """The deviation of one throw."""
    share = _share(inside)
    return box_volume * share, box_volume * (share * (1 - share)) ** 0.5


@mistake(
    "Your error is that of the share. The estimate is the box times the share, and so is its error."
)
def error_without_the_box(inside: np.ndarray, box_volume: float) -> tuple[float, float]:
    """Forgets the box in the error."""
    share = _share(inside)
    return box_volume * share, (share * (1 - share) / len(inside)) ** 0.5


@mistake(
    "You returned the share of hits and its error, without a unit: multiply both by the volume of"
    " the box."
)
def share_alone(inside: np.ndarray, box_volume: float) -> tuple[float, float]:
    """Forgets the box."""
    share = _share(inside)
    return share, (share * (1 - share) / len(inside)) ** 0.5


@mistake(
    "You returned a variance. The standard error is its root: box_volume * sqrt(share * (1 - share)"
    " / n)."
)
def variance(inside: np.ndarray, box_volume: float) -> tuple[float, float]:
    """Forgets the root."""
    share = _share(inside)
    return box_volume * share, box_volume**2 * share * (1 - share) / len(inside)


@mistake(
    "You returned the half width of a 95 % interval. The contract asks for one standard error,"
    " without 1.96."
)
def interval(inside: np.ndarray, box_volume: float) -> tuple[float, float]:
    """Multiplies by 1.96."""
    share = _share(inside)
    return box_volume * share, 1.96 * box_volume * (share * (1 - share) / len(inside)) ** 0.5


@mistake(
    "You divided by n outside the root: the error falls with the root of n, so n belongs under it."
)
def n_outside_the_root(inside: np.ndarray, box_volume: float) -> tuple[float, float]:
    """Divides by n, not by its root."""
    share = _share(inside)
    return box_volume * share, box_volume * (share * (1 - share)) ** 0.5 / len(inside)


@alternative
def by_the_deviation(inside: np.ndarray, box_volume: float) -> tuple[float, float]:
    """The deviation of numbers 0 and 1."""
    if len(inside) == 0:
        raise ValueError("nothing was thrown")
    values = box_volume * inside.astype(float)
    return float(values.mean()), float(values.std() / np.sqrt(len(values)))


@alternative
def counted(inside: np.ndarray, box_volume: float) -> tuple[float, float]:
    """Counts in plain Python."""
    n = len(inside)
    if n == 0:
        raise ValueError("n = 0")
    k = sum(1 for hit in inside if hit)
    return box_volume * k / n, box_volume / n * (k * (n - k) / n) ** 0.5
