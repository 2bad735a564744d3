"""What eight_point is graded by besides the checks that a student sees."""

import numpy as np

from lessons.epipolar.exercises import GRADERS, a_pair
from lessons.epipolar.exercises.eight_point import HINT, judged, ranked
from workbench.exercise import Function, Verdict, band, beside, check, fail, refused, worst
from workbench.exercise.model import number


@check(1, public=False)
def eight_are_enough(candidate: Function) -> Verdict:
    """Eight matches without noise are enough; seven, five and none are not."""
    pair = a_pair(GRADERS() + 1, 8, 0.0)
    verdict = judged(candidate, pair, 1e-2, 0.5)
    few = ((7, "Seven matches"), (5, "Five matches"), (0, "A call without matches"))
    refusals = [
        refused(candidate, pair.uv_first[:n], pair.uv_second[:n], what=label) for n, label in few
    ]
    return verdict if verdict.share < 1 else worst(refusals)


@check(3, public=False)
def other_matches(candidate: Function) -> Verdict:
    """Other noisy matches give lines as near, and none of their F has rank three."""
    verdicts = [judged(candidate, a_pair(GRADERS() + k, 120), 0.9, 1.8) for k in (2, 3, 4)]
    return worst([*verdicts, ranked(candidate, a_pair(GRADERS() + 5))])


@check(1, public=False)
def the_last_entry_is_zero(candidate: Function) -> Verdict:
    """Where the two origins are partners F33 is 0, and F is found as well."""
    rng = np.random.default_rng(GRADERS() + 6)
    uv = rng.integers(-300, 300, (20, 2)).astype(float)
    partners = uv + rng.integers(10, 60, (20, 1)) * [1.0, 0.0]  # a camera that moved aside: v' = v
    F = candidate(uv, partners)
    largest = float(np.abs(F).max())
    right = np.array([[0.0, 0, 0], [0, 0, -1], [0, 1, 0]]) / np.sqrt(2)
    unit = F * (np.sign(F[2, 1]) / np.linalg.norm(F))
    if not largest < 1e9:
        return fail(
            f"F33 is 0 here, and the largest entry of F is {number(largest)}, right is 1 or so:"
            " scale F by its norm."
        )
    told = beside(unit, right, HINT, "F over its norm")
    return band(
        "F over its norm is off by",
        float(np.abs(unit - right).max()),
        "",
        good=1e-6,
        fair=1e-3,
        hint=told,
    )
