"""What volume_by_chance is graded by besides the checks that a student sees."""

import numpy as np

from lessons.measures.exercises import GRADERS, relative_verdict
from lessons.measures.exercises.volume_by_chance import ERROR_HINT, SHARE_HINT, both, hits
from workbench.exercise import Function, Verdict, check, refused, worst


@check(2, public=False)
def other_boxes(candidate: Function) -> Verdict:
    """Small and large boxes, few and many hits: both numbers follow."""
    cases = ((200, 20, 0.03), (5000, 4800, 120.0), (10_000, 37, 1.0))
    return worst(both(candidate, hits(n, count, GRADERS()), box) for n, count, box in cases)


@check(1, public=False)
def no_hit_and_no_miss(candidate: Function) -> Verdict:
    """Without a hit the estimate is 0, without a miss the box, each with the error 0."""
    verdicts = []
    for inside, right in ((np.zeros(300, bool), 0.0), (np.ones(300, bool), 4.0)):
        value, error = candidate(inside, 4.0)
        case = "All throws hit" if right else "No throw hits"
        verdicts.append(
            relative_verdict(
                f"{case}, estimate", float(value), right, SHARE_HINT, good=0.01, fair=0.5, size=4
            )
        )
        verdicts.append(
            relative_verdict(
                f"{case}, error", float(error), 0.0, ERROR_HINT, good=0.01, fair=0.5, size=4
            )
        )
    return worst(verdicts)


@check(1, public=False)
def no_throws(candidate: Function) -> Verdict:
    """No points are refused with a ValueError."""
    return refused(candidate, np.zeros(0, bool), 8.0, what="An empty array")
