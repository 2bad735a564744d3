"""What spherical_from_cartesian is graded by besides the checks that a student sees."""

import numpy as np

from lessons.coordinates.exercises import GRADERS, numbers, row_by_row
from lessons.coordinates.exercises.spherical_from_cartesian import (
    AXIS,
    LOST,
    all_round,
    judged,
    near,
)
from workbench.exercise import Function, Verdict, check, worst


@check(2, public=False)
def other_points_all_round(candidate: Function) -> Verdict:
    """Other points, near and far, have their coordinates too."""
    return judged(
        candidate,
        np.concatenate(
            [all_round(GRADERS() + k, radius=r) for k, r in enumerate((1e-2, 1e4, 1e-6))]
        ),
    )


@check(1, public=False)
def nearer_the_axis(candidate: Function) -> Verdict:
    """So have points other millionths from the axis, in any direction, and below: there the azimuth
    has a meaning still.
    """
    polar = np.array([3e-5, 2e-7, *LOST, 2e-10])
    above = [near(candidate, polar, 2e-3), near(candidate, polar, 2e-3, azimuth=2.4)]
    p = np.column_stack([np.zeros(6), -0.5 * np.sin(polar), -0.5 * np.cos(polar)])
    short = np.pi - candidate(p)[:, 1]
    asked = [f"A polar angle of π less {numbers(angle)} radians" for angle in polar]
    below = row_by_row(asked, short, polar, np.abs(short / polar - 1), AXIS, good=1e-4, fair=1e-2)
    return worst((*above, judged(candidate, p), below))


@check(1, public=False)
def a_single_point(candidate: Function) -> Verdict:
    """A single point is one row."""
    return judged(candidate, all_round(GRADERS() + 2, 3)[2:])


@check(1, public=False)
def zeros_of_either_sign(candidate: Function) -> Verdict:
    """-0.0 is 0: on -x the azimuth is pi and not -pi, and on the axis it is 0."""
    p = np.array(
        [
            [-1.0, -0.0, 0.5],
            [-0.0, -0.0, -2.0],
            [-0.0, 0.0, 1.0],
            [2.0, -0.0, 0.0],
            [-0.0, -0.0, -0.0],
        ]
    )
    return judged(candidate, p, "atan2 listens to the sign of a zero, and x + 0.0 takes it away.")
