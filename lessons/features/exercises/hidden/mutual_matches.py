"""What mutual_matches is graded by besides the checks that a student sees."""

import numpy as np

from lessons.features.exercises import GRADERS
from lessons.features.exercises.mutual_matches import judged, sets
from workbench.exercise import Function, Verdict, check, worst


@check(2, public=False)
def several_ratios(candidate: Function) -> Verdict:
    """At 0.5, 0.7, 0.8 and 0.95, and at 0.2 and 0.995."""
    return worst(
        judged(candidate, *sets(GRADERS() + k, 60, 50, 6), ratio, f"Ratio {ratio:g}")
        for k, ratio in enumerate((0.5, 0.7, 0.8, 0.95, 0.2, 0.995))
    )


@check(2, public=False)
def crowded(candidate: Function) -> Verdict:
    """Many of one set want the same few of the other, two of them even, or one wants many."""
    rng = np.random.default_rng(GRADERS() + 9)
    verdicts = [
        judged(candidate, rng.normal(size=(60, 3)), 2.5 * rng.normal(size=(8, 3)), 0.95, "60 and 8")
    ]
    for n, m, d in ((60, 2, 3), (1, 30, 3), (1, 2, 1), (30, 30, 1)):
        a, b = sets(GRADERS() + n + m, n, m, d, 0.3)
        verdicts.append(judged(candidate, a, b, 0.97, f"{n} and {m}, of {d} numbers"))
    return worst(verdicts)


@check(1, public=False)
def like_histograms(candidate: Function) -> Verdict:
    """33 numbers from 0 to 200 each, as the lesson has them."""
    a, b = sets(GRADERS() + 20, 80, 80, 33, 0.9)
    return judged(candidate, np.abs(60 * a), np.abs(60 * b), 0.9, "80 and 80")


@check(1, public=False)
def equal_descriptors(candidate: Function) -> Verdict:
    """Of equal rows of a the first has the match; equal rows of b are none; a distance of 0 is one;
    less is not equal.
    """
    rng = np.random.default_rng(GRADERS() + 30)
    b = rng.permutation(np.arange(40.0).reshape(10, 4) ** 2 % 37)
    a = b[[3, 3, 0, 7, 5, 5, 5, 0, 1]] + np.array([1.0, 1, 0, 0, 2, 2, 2, 2, 12])[:, None]
    # one of two equal rows follows the other, and one stands last
    twice = np.concatenate([b[:8], b[7:], b[[3]]])
    verdicts = [
        judged(candidate, a, b, 0.5, "Equal rows of a"),
        judged(candidate, a, twice, 0.5, "Equal rows of b"),
    ]
    steps = np.array([[1.0, 0], [0, 2], [9, 0]])
    verdicts.append(
        judged(
            candidate, np.zeros((1, 2)), steps, 0.5, "A distance that is the ratio times the second"
        )
    )
    return worst(verdicts)
