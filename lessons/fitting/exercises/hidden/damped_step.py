"""What damped_step is graded by besides the checks that a student sees."""

import numpy as np

from lessons.fitting.exercises import GRADERS
from lessons.fitting.exercises.damped_step import judged, problem
from workbench.exercise import Function, Verdict, check, worst


@check(2, public=False)
def other_units(candidate: Function) -> Verdict:
    """An unknown counted in millimetres gets a step a thousand times as large, in kilometres a
    thousandth.
    """
    residuals, jacobian = problem(GRADERS())
    return worst(
        judged(candidate, residuals, jacobian / [1.0, unit, 1.0], 0.2) for unit in (1000.0, 0.001)
    )


@check(2, public=False)
def other_sizes(candidate: Function) -> Verdict:
    """Other numbers of unknowns have their steps too, with little damping and with much; where r is
    0 the step is 0.
    """
    sizes = ((5, 1, 0.0), (8, 2, 0.3), (40, 5, 2.0), (6, 6, 0.01), (9, 3, 1e-4), (9, 3, 1e5))
    verdicts = [
        judged(candidate, *problem(GRADERS() + k, n, m), damping)
        for k, (n, m, damping) in enumerate(sizes, 1)
    ]
    return worst([*verdicts, judged(candidate, np.zeros(8), problem(GRADERS())[1][:8], 0.5)])
