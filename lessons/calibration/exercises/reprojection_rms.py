"""Write the number that calibrations are judged by. It is the curve 'reprojection, rms' and the
number in the captions; the table 'What is called the error', two steps before the end, has its
namesakes.
"""

import numpy as np
from jaxtyping import Float

from lessons.calibration.exercises import STUDENTS
from workbench.exercise import (
    Function,
    Verdict,
    against,
    alternative,
    band,
    check,
    contract,
    left_alone,
    mistake,
    worst,
)
from workbench.geometry.cameras import calibration


@contract(
    slot="reprojection_rms",
    examples=(
        ("reprojection_rms(np.array([[3.0, 4.0]]))", "5"),
        ("reprojection_rms(np.array([[3.0, 4.0], [0.0, 0.0]]))", "3.5355"),
    ),
)
def reprojection_rms(residuals: Float[np.ndarray, "n 2"]) -> float:
    """Return the root mean square length of the residuals, in pixels: per point, not per
    coordinate.

    Args:
        residuals: Projected minus measured, pixels, one row (du, dv) per corner; at least one.

    Returns:
        The root of the mean of squared lengths. The input stays as it is.
    """
    return calibration.reprojection_rms(residuals)


HINT = "Square each length du² + dv², average over the n points, take the root."


def said(candidate: Function, residuals: np.ndarray, quantity: str = "The rms") -> Verdict:
    """Judge the rms of some residuals, by its relative error."""
    right = calibration.reprojection_rms(residuals)
    got = float(candidate(residuals))
    off = 100 * abs(got - right) / (right or 1.0)
    told = f"Yours is {against(got, right, unit='px')}. {HINT}"
    return band(f"{quantity} is off by", off, "%", good=1e-4, fair=0.01, hint=told)


def some(seed: int, n: int, sigma: float = 0.3, shift: float = 0.0) -> np.ndarray:
    """Return residuals with noise, and all of them shifted."""
    return np.random.default_rng(seed).normal(0, sigma, (n, 2)) + shift * np.array([1.0, 0.5])


@check(2)
def two_corners(candidate: Function) -> Verdict:
    """(3, 4) and (0, 0) have an rms of 3.5355 px, (1, 0) and (0, 1) one of 1 px."""
    cases = (np.array([[3.0, 4.0], [0.0, 0.0]]), np.array([[1.0, 0.0], [0.0, 1.0]]))
    return worst(said(candidate, case) for case in cases)


@check(2)
def many_corners(candidate: Function) -> Verdict:
    """For 50 and for 700 corners with noise."""
    return worst(said(candidate, some(STUDENTS, n)) for n in (50, 700))


@check(1)
def residuals_are_left_alone(candidate: Function) -> Verdict:
    """The residuals that come in are not changed."""
    return left_alone(candidate, said(candidate, some(STUDENTS + 1, 9)))


@mistake(
    "You averaged over the 2n coordinates. The rms is per point: divide the sum of squares by n,"
    " not by 2n."
)
def per_coordinate(residuals: np.ndarray) -> float:
    """Over coordinates."""
    return float(np.sqrt(np.mean(residuals**2)))


@mistake(
    "You divided the norm of all residuals by n, as an old tutorial does: n has to go under the"
    " root."
)
def norm_over_n(residuals: np.ndarray) -> float:
    """Divides the norm by n."""
    return float(np.linalg.norm(residuals) / len(residuals))


@mistake(
    "You averaged the lengths. Square them first, and take the root of the mean: large residuals"
    " count more."
)
def mean_length(residuals: np.ndarray) -> float:
    """The mean of lengths."""
    return float(np.linalg.norm(residuals, axis=1).mean())


@mistake("You did not take the root: that is the mean square, in px².")
def mean_square(residuals: np.ndarray) -> float:
    """Without the root."""
    return float((residuals**2).sum(axis=1).mean())


@mistake("You took the root of the sum of squares, without dividing by the number of points.")
def norm(residuals: np.ndarray) -> float:
    """The norm of all."""
    return float(np.linalg.norm(residuals))


@mistake(
    "You took off the mean residual first. A shift that all corners share is an error too, and"
    " counts."
)
def about_the_mean(residuals: np.ndarray) -> float:
    """A standard deviation."""
    return calibration.reprojection_rms(residuals - residuals.mean(axis=0))


@mistake(
    "You took the median of the lengths: a corner that is far off plays no part in it, in the rms"
    " it does."
)
def median_length(residuals: np.ndarray) -> float:
    """The median of lengths."""
    return float(np.median(np.linalg.norm(residuals, axis=1)))


@alternative
def by_hypot(residuals: np.ndarray) -> float:
    """Lengths first."""
    return float(np.sqrt(np.mean(np.hypot(residuals[:, 0], residuals[:, 1]) ** 2)))


@alternative
def by_norm(residuals: np.ndarray) -> float:
    """The norm of all, over the root of n."""
    return float(np.linalg.norm(residuals) / np.sqrt(len(residuals)))
