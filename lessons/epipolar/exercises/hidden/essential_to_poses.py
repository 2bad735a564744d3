"""What essential_to_poses is graded by besides the checks that a student sees."""

import numpy as np

from lessons.epipolar.exercises import GRADERS
from lessons.epipolar.exercises.essential_to_poses import judged, some_motions
from workbench.exercise import Function, Verdict, check, worst
from workbench.geometry.motions import skew
from workbench.geometry.two_views import essential


@check(2, public=False)
def other_matrices(candidate: Function) -> Verdict:
    """So they are for other matrices, of very small and very large numbers too, and none of them
    mirrors.
    """
    cases = [E for E, _ in some_motions(GRADERS(), 12)]
    cases += [1e-6 * cases[0], -1e6 * cases[1]]
    return worst(judged(candidate(E), essential.essential_to_poses(E)) for E in cases)


@check(2, public=False)
def with_noise(candidate: Function) -> Verdict:
    """Of a matrix that is an essential one but for 0.3 % of noise, they are motions, and within 2.5
    degrees.
    """
    rng = np.random.default_rng(GRADERS() + 1)
    verdicts = []
    for E, _ in some_motions(GRADERS() + 1):
        noisy = E + 0.003 * np.linalg.norm(E) * rng.normal(size=(3, 3))
        verdicts.append(
            judged(candidate(noisy), essential.essential_to_poses(E), good=2.5, fair=5.0)
        )
    return worst(verdicts)


@check(1, public=False)
def along_the_axes(candidate: Function) -> Verdict:
    """Ahead, aside and up without a turn, as well."""
    return worst(
        judged(candidate(skew(t)), essential.essential_to_poses(skew(t))) for t in np.eye(3)
    )
