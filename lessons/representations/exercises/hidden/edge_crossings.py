"""What edge_crossings is graded by besides the checks that a student sees."""

import numpy as np

from lessons.representations.exercises import GRADERS, rows_verdict
from lessons.representations.exercises.edge_crossings import HINT, edges, verdict
from workbench.exercise import Function, Verdict, check, worst


@check(2, public=False)
def other_edges(candidate: Function) -> Verdict:
    """Long and short edges, large and small values."""
    rng = np.random.default_rng(GRADERS())
    verdicts = []
    for size, factor in ((50.0, 1.0), (0.02, 1.0), (1.0, 1e-4), (1.0, 1e4)):
        p_a, p_b, f_a, f_b = edges(rng, 20, size)
        verdicts.append(
            verdict(candidate, (p_a, p_b, factor * f_a, factor * f_b), "On another edge")
        )
    return worst(verdicts)


@check(1, public=False)
def zero_at_an_end(candidate: Function) -> Verdict:
    """Where the field is zero at an end, the place is that end; where it is nearly zero, the place
    is near it.
    """
    rng = np.random.default_rng(GRADERS() + 1)
    p_a, p_b, f_a, f_b = edges(rng, 8)
    f_a = np.where(np.arange(8) < 4, 0.0, f_a)
    f_b = np.where(np.arange(8) < 4, f_b, 0.0)
    zero = verdict(candidate, (p_a, p_b, f_a, f_b), "With a zero at an end")
    p_a, p_b, f_a, f_b = edges(rng, 8)
    f_a = np.where(np.arange(8) < 4, 2e-5 * f_a, f_a)
    f_b = np.where(np.arange(8) < 4, f_b, 2e-5 * f_b)
    return worst(
        (zero, verdict(candidate, (50 * p_a, 50 * p_b, f_a, f_b), "With nearly a zero at an end"))
    )


@check(1, public=False)
def none_or_one(candidate: Function) -> Verdict:
    """No edges give no points, and one gives one."""
    p_a, p_b, f_a, f_b = edges(np.random.default_rng(GRADERS() + 2), 1)
    if len(candidate(p_a[:0], p_b[:0], f_a[:0], f_b[:0])):
        return rows_verdict(np.ones(1), np.zeros(1), lambda k: "No edges came in, points", HINT)
    return verdict(candidate, (p_a, p_b, f_a, f_b), "A single edge")
