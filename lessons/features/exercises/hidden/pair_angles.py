"""What pair_angles is graded by besides the checks that a student sees."""

import numpy as np

from lessons.features.exercises import GRADERS
from lessons.features.exercises.pair_angles import judged, pairs
from workbench.exercise import Function, Verdict, check, worst
from workbench.geometry.motions import exp_so3


@check(1, public=False)
def any_distance(candidate: Function) -> Verdict:
    """Points 50 m, 1 mm and some micrometres apart: angles have no length."""
    verdicts = []
    for scale in (1000.0, 0.02, 1e-4):
        p_i, n_i, p_j, n_j = pairs(GRADERS(), 20)
        verdicts.append(
            judged(candidate, (p_i, n_i, p_i + scale * (p_j - p_i), n_j), f"{scale:g} times as far")
        )
    return worst(verdicts)


@check(2, public=False)
def moved(candidate: Function) -> Verdict:
    """All turned and moved, the angles stay."""
    p_i, n_i, p_j, n_j = pairs(GRADERS() + 1, 40)
    R = exp_so3(np.array([0.4, -1.2, 0.9]))
    t = np.array([3.0, -2.0, 1.0])
    return judged(candidate, (p_i @ R.T + t, n_i @ R.T, p_j @ R.T + t, n_j @ R.T), "Moved")


@check(1, public=False)
def one_pair(candidate: Function) -> Verdict:
    """A single pair, normals more than a right angle apart, and pairs with equal or opposite
    normals.
    """
    p_i, n_i, p_j, n_j = pairs(GRADERS() + 2, 1)
    single = judged(candidate, (p_i, n_i, p_j, -n_j), "One pair")
    p_i, n_i, p_j, _ = pairs(GRADERS() + 3, 12)
    n_j = np.where(np.arange(12)[:, None] % 2 == 0, n_i, -n_i)
    first = ((p_j - p_i) * n_i).sum(
        axis=1, keepdims=True
    ) > 0  # the two are equally near: turned by a hair, one is nearer
    n_j = n_j + 1e-3 * np.where(first, -1, 1) * n_j[:, [1, 2, 0]]
    n_j /= np.linalg.norm(n_j, axis=1, keepdims=True)
    return worst(
        [single, judged(candidate, (p_i, n_i, p_j, n_j), "Normals nearly equal or opposite")]
    )
