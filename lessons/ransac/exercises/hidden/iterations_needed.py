"""What iterations_needed is graded by besides the checks that a student sees."""

import numpy as np

from lessons.ransac.exercises import GRADERS
from lessons.ransac.exercises.iterations_needed import (
    NEEDED_HINT,
    iterations_needed,
    needed_verdict,
)
from workbench.exercise import Function, Verdict, against, band, check, fail, number, worst
from workbench.exercise.student import StudentError


def a_case(rng: np.random.Generator) -> tuple[float, int, float]:
    """Return an inlier ratio, a sample size and a confidence for which no rounding decides the
    answer.
    """
    while True:
        w = round(rng.uniform(0.2, 0.9), 3)
        s = int(rng.integers(2, 8))
        confidence = round(rng.uniform(0.6, 0.999), 3)
        exact = np.log1p(-confidence) / np.log1p(-(w**s))
        if exact > 2.0 and 0.05 < exact % 1.0 < 0.95:
            return w, s, confidence


@check(3, public=False)
def the_smallest_that_is_enough(candidate: Function) -> Verdict:
    """N samples are all spoilt in at most the share of runs that the confidence leaves, N - 1 in
    more.
    """
    rng = np.random.default_rng(GRADERS() + 70)
    # n samples are just enough, and logarithms say so exactly
    exact = [(0.5, 1, 1 - 0.5**n) for n in (1, 2, 4, 8)]
    exact += [
        (0.9, 1, 0.5),
        (0.99, 2, 0.9999),
        (0.999, 8, 0.999),
        (0.3, 3, 0.05),
        (0.002, 1, 0.99),
        (0.6, 4, 0.999999),
    ]
    hint = f"Just enough is enough. {NEEDED_HINT}"
    boundary = [needed_verdict(candidate, *case, hint) for case in exact]
    return worst([*(needed_verdict(candidate, *a_case(rng)) for _ in range(8)), *boundary])


@check(2, public=False)
def more_confidence(candidate: Function) -> Verdict:
    """Each further nine of confidence, 90, 99 and 99.9 %, asks for as many samples again."""
    hint = (
        "Halving 1 - confidence adds the same number of samples each time. Is it log(1 -"
        " confidence)?"
    )
    return worst(
        needed_verdict(candidate, 0.4, 4, confidence, hint)
        for confidence in (0.6, 0.9, 0.99, 0.999)
    )


@check(1, public=False)
def no_inliers(candidate: Function) -> Verdict:
    """Where no point is an inlier no number is enough: inf."""
    return worst(
        needed_verdict(candidate, 0.0, s, 0.99, "w^s is 0: answer np.inf then.") for s in (3, 4, 1)
    )


@check(1, public=False)
def rarely_clean(candidate: Function) -> Verdict:
    """Where one sample in 1e18 is clean, the number is right to six digits."""
    hint = "1 - 1e-18 is 1 to the computer, and its log is 0: use np.log1p(-x) for log(1 - x)."
    right = iterations_needed(0.01, 9, 0.99)
    try:
        got = float(candidate(0.01, 9, 0.99))
    except StudentError as error:
        if error.kind != "result":
            raise
        return fail(f"{error}; right is {number(right)}. {hint}")
    start = f"1 % inliers, 9 in a sample: yours is {against(got, right)}; off by"
    return band(start, 100 * abs(got - right) / right, "%", good=1e-4, fair=1.0, hint=hint)
