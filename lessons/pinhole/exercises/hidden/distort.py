"""What distort is graded by besides the checks that a student sees."""

import numpy as np

from lessons.pinhole.exercises import GRADERS
from lessons.pinhole.exercises.distort import _bent, bent, some_rays
from workbench.exercise import Function, Verdict, check, worst
from workbench.geometry.cameras import distortion


@check(2, public=False)
def whole_lens(candidate: Function) -> Verdict:
    """All four terms together are right, also at the rim of a wide picture, for one point, and for
    none at all.
    """
    lenses = ((-0.28, 0.09, 0.012, -0.007), (0.15, -0.2, -0.02, 0.015))
    verdicts = [_bent(candidate, some_rays(GRADERS() + k), *lens) for k, lens in enumerate(lenses)]
    others = (2.5 * some_rays(GRADERS() + 4), some_rays(GRADERS() + 5, 1), np.empty((0, 2)))
    return worst([*verdicts, *(_bent(candidate, xy, *lenses[0]) for xy in others)])


@check(1, public=False)
def turned_lens(candidate: Function) -> Verdict:
    """Turned about the axis together with (p2, p1), a lens moves turned points alike."""
    c, s = np.cos(0.7), np.sin(0.7)
    Q = np.array([[c, -s], [s, c]])
    xy = some_rays(GRADERS() + 2)
    p1, p2 = (0.012, -0.02)
    q = Q @ [p2, p1]
    right = distortion.distort(xy, -0.2, 0.1, p1, p2)
    return bent(candidate(xy @ Q.T, -0.2, 0.1, float(q[1]), float(q[0])), right @ Q.T)


@check(1, public=False)
def twice_the_lens(candidate: Function) -> Verdict:
    """Twice the coefficients move every point by twice as much."""
    xy = some_rays(GRADERS() + 3)
    lens = (-0.12, 0.06, 0.006, -0.004)
    once = candidate(xy, *lens) - xy
    twice = candidate(xy, *(2 * k for k in lens)) - xy
    right = distortion.distort(xy, *lens) - xy
    return worst([bent(once, right), bent(twice, 2 * right)])
