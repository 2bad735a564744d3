"""What knn_adjacency is graded by besides the checks that a student sees."""

import numpy as np

from lessons.graphs.exercises import GRADERS
from lessons.graphs.exercises.knn_adjacency import cloud, found
from workbench.exercise import Function, Verdict, check, worst
from workbench.geometry.motions import exp_so3


def with_a_pair(seed: int) -> np.ndarray:
    """Return points of which two lie at one place, far from the others."""
    p = cloud(seed, 12)
    p[[4, 9]] = [20.0, 0.0, 0.0]
    return p


@check(2, public=False)
def other_counts(candidate: Function) -> Verdict:
    """One neighbour to all but one, few points and many."""
    cases = ((2, 1), (10, 9), (30, 1), (60, 7))
    return worst(
        found(candidate, cloud(GRADERS() + n, n), k, f"{n} points, k = {k}: ") for n, k in cases
    )


@check(2, public=False)
def moved_clouds(candidate: Function) -> Verdict:
    """Turned, moved a kilometre, enlarged, made tiny or in another order it is the same; points may
    have 1 or 5 numbers.
    """
    rng = np.random.default_rng(GRADERS())
    p = cloud(GRADERS() + 1, 50)
    away = 3.0 * p @ exp_so3(rng.normal(size=3)).T + 1000.0 * rng.normal(size=3)
    cases = [(away, "Moved: "), (rng.permutation(p), "Other order: "), (1e-5 * p, "Tiny: ")]
    cases += [(cloud(GRADERS() + 2 + d, 50, d), f"{d} numbers a point: ") for d in (2, 1, 5)]
    return worst(found(candidate, q, 5, case) for q, case in cases)


@check(1, public=False)
def two_at_one_place(candidate: Function) -> Verdict:
    """Of two points at one place each names the other, and not itself, of three both others."""
    verdicts = [
        found(candidate, with_a_pair(GRADERS() + k), 1, "Two at one place: ") for k in range(3)
    ]
    verdicts += [
        found(candidate, with_a_pair(GRADERS() + k), 3, "Two at one place, k = 3: ")
        for k in range(3)
    ]
    p = with_a_pair(GRADERS() + 3)
    p[0] = p[9]
    return worst([*verdicts, found(candidate, p, 2, "Three at one place: ")])
