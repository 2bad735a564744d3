"""What reprojection_rms is graded by besides the checks that a student sees."""

import numpy as np

from lessons.calibration.exercises import GRADERS
from lessons.calibration.exercises.reprojection_rms import said, some
from workbench.exercise import Function, Verdict, check, worst


@check(2, public=False)
def shifted(candidate: Function) -> Verdict:
    """Residuals that all point one way count in full, be they large or very small."""
    cases = [some(GRADERS(), n, shift=2.0) for n in (3, 60)]
    return worst(
        said(candidate, residuals) for residuals in (*cases, 1e-6 * cases[0], 300 * cases[1])
    )


@check(2, public=False)
def one_that_is_far_off(candidate: Function) -> Verdict:
    """One corner far off among good ones counts with its square."""
    residuals = some(GRADERS() + 1, 54)
    residuals[7] += [30.0, -20.0]
    return said(candidate, residuals)


@check(1, public=False)
def one_corner_and_none_off(candidate: Function) -> Verdict:
    """One corner alone, and corners that all fit."""
    return worst(said(candidate, case) for case in (np.array([[-6.0, 8.0]]), np.zeros((5, 2))))
