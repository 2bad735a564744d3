"""Write the rule that ends the search: how many samples until one of them is probably free of
outliers. The lesson asks it after every new best, with the share of inliers of the best so far, for
planes and all other models, and stops when so many are drawn.
"""

import math

import numpy as np

from workbench.algorithms.robust import ransac
from workbench.exercise import (
    Function,
    Verdict,
    against,
    alternative,
    check,
    contract,
    fail,
    full,
    mistake,
    partial,
    worst,
)


@contract(
    slot="iterations_needed",
    examples=(
        ("iterations_needed(0.5, 3, 0.99)", "35"),
        ("iterations_needed(0.0, 3, 0.99)", "np.inf"),
    ),
)
def iterations_needed(inlier_ratio: float, sample_size: int, confidence: float) -> float:
    """Return how many samples must be drawn to draw, with this confidence, at least one that holds
    no outlier.

    It is the smallest whole number N, at least 1, for which N samples all hold an outlier with a
    probability of at most 1 - confidence. Points are drawn independently: each is an inlier with
    probability inlier_ratio.

    Args:
        inlier_ratio: The share w of inliers among all points, from 0 to 1.
        sample_size: The number s of points in one sample, 1 or more.
        confidence: Strictly between 0 and 1, such as 0.99.

    Returns:
        The number as an int or a float without a fraction. Where all points are inliers it is 1.
        Where none is, it is inf (np.inf). Also where only one sample in 1e18 is clean it is right
        to six digits: 1 - x loses those of so small an x, and np.log1p(-x), which is log(1 - x),
        keeps them.
    """
    return float(ransac.iterations_needed(inlier_ratio, sample_size, confidence))


NEEDED_HINT = "One sample is clean with probability w^s; N are all spoilt with (1 - w^s)^N."


def needed_verdict(
    candidate: Function, w: float, s: int, confidence: float, hint: str = NEEDED_HINT
) -> Verdict:
    """Judge a number of samples: all for the smallest that is enough, half where it is one off."""
    got = float(candidate(w, s, confidence))
    right = iterations_needed(w, s, confidence)
    case = f"{100 * w:g} % inliers, {s} in a sample, {100 * confidence:g} % confidence"
    if got == right:
        return full(f"{case}: {right:.12g} {'sample' if right == 1.0 else 'samples'}.")
    message = f"{case}: yours is {against(got, right, 12)}."
    if got < 1.0:
        return fail(f"{message} Nobody can do with less than one sample. {hint}")
    if got < right < np.inf:
        spoilt = np.exp(got * np.log1p(-(w**s)))
        allowed = 1.0 - confidence
        if spoilt > 1.01 * allowed:
            message += (
                f" After yours all are spoilt in {100 * spoilt:.3g} % of the runs,"
                f" {100 * allowed:.3g} % is allowed."
            )
    return (
        partial(0.5, f"{message} Round up.")
        if abs(got - right) <= 1.0
        else fail(f"{message} {hint}")
    )


@check(3)
def planes_at_99_percent(candidate: Function) -> Verdict:
    """A plane at 50, 30 and 20 % inliers needs 35, 169 and 574 samples for 99 % confidence."""
    return worst(needed_verdict(candidate, w, 3, 0.99) for w in (0.5, 0.3, 0.2))


@check(2)
def larger_samples(candidate: Function) -> Verdict:
    """At 50 % inliers, samples of 1, 4 and 7 points need 7, 72 and 588 draws."""
    return worst(needed_verdict(candidate, 0.5, s, 0.99) for s in (1, 4, 7))


@check(1)
def no_outliers(candidate: Function) -> Verdict:
    """Where all points are inliers one sample is enough."""
    hint = "Each sample is clean: log(1 - w^s) is -inf here, so answer before you divide."
    return worst(
        needed_verdict(candidate, 1.0, s, confidence, hint)
        for s, confidence in ((3, 0.99), (7, 0.6))
    )


def rounded_up(value: float) -> float:
    """Return a number of samples."""
    return max(1.0, float(np.ceil(value)))


@mistake(
    "You use w itself. A sample is clean only if all of its points are inliers: that has"
    " probability w^s."
)
def sample_size_forgotten(inlier_ratio: float, sample_size: int, confidence: float) -> float:
    """Uses w for w^s."""
    return rounded_up(np.log1p(-confidence) / np.log1p(-inlier_ratio))


@mistake(
    "You take the share of outliers for that of inliers: your numbers fall where there are more"
    " outliers. A clean sample has probability w^s."
)
def outliers_for_inliers(inlier_ratio: float, sample_size: int, confidence: float) -> float:
    """Uses 1 - w for w."""
    return rounded_up(np.log1p(-confidence) / np.log1p(-((1.0 - inlier_ratio) ** sample_size)))


@mistake(
    "You call a sample spoilt when all of its points are outliers, (1 - w)^s. One is enough: spoilt"
    " is whatever is not clean, 1 - w^s."
)
def all_outliers(inlier_ratio: float, sample_size: int, confidence: float) -> float:
    """Calls a sample spoilt only if all of its points are outliers."""
    return rounded_up(np.log1p(-confidence) / np.log((1.0 - inlier_ratio) ** sample_size))


@mistake(
    "You divide by log(w^s), the chance of a clean sample. It is the spoilt ones that must not go"
    " on: log(1 - w^s)."
)
def clean_for_spoilt(inlier_ratio: float, sample_size: int, confidence: float) -> float:
    """Forgets the 1 - in the denominator."""
    return rounded_up(np.log1p(-confidence) / np.log(inlier_ratio**sample_size))


@mistake(
    "You take log(confidence). What may go wrong is the rest: all samples are spoilt with at most 1"
    " - confidence."
)
def confidence_for_its_rest(inlier_ratio: float, sample_size: int, confidence: float) -> float:
    """Forgets the 1 - in the numerator."""
    return rounded_up(np.log(confidence) / np.log1p(-(inlier_ratio**sample_size)))


@mistake("Your fraction is upside down: it is log(1 - confidence) over log(1 - w^s).")
def turned_upside_down(inlier_ratio: float, sample_size: int, confidence: float) -> float:
    """Divides the other way round."""
    return rounded_up(np.log1p(-(inlier_ratio**sample_size)) / np.log1p(-confidence))


@mistake(
    "You return 1 / w^s: so long a clean sample takes on average. In about a third of all runs"
    " there is none by then; the confidence asks for more."
)
def on_average(inlier_ratio: float, sample_size: int, confidence: float) -> float:
    """Waits as long as a clean sample takes on average."""
    return rounded_up(1.0 / inlier_ratio**sample_size)


@mistake("You round down: with the fraction cut off the confidence is just missed. Round up.")
def rounded_down(inlier_ratio: float, sample_size: int, confidence: float) -> float:
    """Cuts the fraction off."""
    return max(1.0, float(np.floor(np.log1p(-confidence) / np.log1p(-(inlier_ratio**sample_size)))))


@mistake("You round to the nearest: in half of all cases the confidence is just missed. Round up.")
def rounded_to_the_nearest(inlier_ratio: float, sample_size: int, confidence: float) -> float:
    """Rounds to the nearest."""
    return max(1.0, float(np.round(np.log1p(-confidence) / np.log1p(-(inlier_ratio**sample_size)))))


@mistake("You leave a fraction. Nobody draws part of a sample: round up.")
def not_rounded(inlier_ratio: float, sample_size: int, confidence: float) -> float:
    """Leaves the fraction."""
    return max(1.0, float(np.log1p(-confidence) / np.log1p(-(inlier_ratio**sample_size))))


@mistake(
    "Where all points are inliers you return 0, from a division by log(0). One sample must be"
    " drawn: answer 1."
)
def none_where_all_are_inliers(inlier_ratio: float, sample_size: int, confidence: float) -> float:
    """Divides by log(0), which gives no sample at all."""
    clean = np.float64(inlier_ratio) ** sample_size
    return float(np.ceil(np.log1p(-confidence) / np.log1p(-clean)))


@mistake(
    "Where no point is an inlier you divide by log(1) = 0. No number of samples is enough then:"
    " return np.inf."
)
def no_inlier_not_seen(inlier_ratio: float, sample_size: int, confidence: float) -> float:
    """Divides by log(1)."""
    clean = inlier_ratio**sample_size
    return 1 if clean == 1 else math.ceil(math.log(1 - confidence) / math.log1p(-clean))


@mistake(
    "All is right until w^s is below 10⁻¹⁶: then 1 - w^s is 1 to the computer, and its log is 0."
    " Use np.log1p(-w^s)."
)
def digits_lost(inlier_ratio: float, sample_size: int, confidence: float) -> float:
    """Subtracts a tiny number from 1."""
    spoilt = 1.0 - inlier_ratio**sample_size
    if spoilt in (0.0, 1.0):
        return np.inf if spoilt else 1.0
    return rounded_up(np.log(1.0 - confidence) / np.log(spoilt))


@alternative
def needed_by_halving(inlier_ratio: float, sample_size: int, confidence: float) -> int | float:
    """Looks for the smallest number of samples that is enough, without dividing logarithms."""
    if inlier_ratio == 0.0:
        return np.inf
    if inlier_ratio == 1.0:
        return 1
    each = np.log1p(-np.exp(sample_size * np.log(inlier_ratio)))
    least, enough = 0, 1
    while enough * each > np.log(1.0 - confidence):
        least = enough
        enough = 2 * enough
    while enough - least > 1:
        middle = (least + enough) // 2
        if middle * each > np.log(1.0 - confidence):
            least = middle
        else:
            enough = middle
    return enough


@alternative
def needed_with_math(inlier_ratio: float, sample_size: int, confidence: float) -> float:
    """Uses Python's own logarithms and whole numbers."""
    clean = inlier_ratio**sample_size
    if clean == 0:
        return math.inf
    if clean == 1:
        return 1
    return math.ceil(math.log(1 - confidence) / math.log1p(-clean))
