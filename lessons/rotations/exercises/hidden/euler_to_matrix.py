"""What euler_to_matrix is graded by besides the checks that a student sees."""

import numpy as np

from lessons.rotations.exercises import GRADERS
from lessons.rotations.exercises.euler_to_matrix import EULER_HINT, _ordered, some_angles
from workbench.exercise import (
    Function,
    Verdict,
    check,
    fail,
    full,
    left_alone,
    partial,
    refused,
    rotation_verdict,
    worst,
)
from workbench.geometry.motions import rotations
from workbench.geometry.motions.rotations import EULER_ORDERS


@check(2, public=False)
def all_orders(candidate: Function) -> Verdict:
    """All 24 orders give the right rotation."""
    verdicts = {
        order: _ordered(candidate, some_angles(GRADERS() + k), order)
        for k, order in enumerate(EULER_ORDERS)
    }
    right = [order for order, verdict in verdicts.items() if verdict.share == 1.0]
    if len(right) == len(verdicts):
        return full("24 of 24 orders are right.")
    message = f"{len(right)} of 24 orders are right. {worst(verdicts.values()).message}"
    return partial(0.5, message) if len(right) >= 16 else fail(message)


@check(1, public=False)
def gimbal_lock(candidate: Function) -> Verdict:
    """At a pitch of 90 degrees only the sum of the first and the third angle counts; more than half
    a turn is a turn too.
    """
    a = 0.4
    c = -0.9
    more = 0.7
    R, other = (candidate(np.array([a + d, np.pi / 2, c - d]), "XYZ") for d in (0.0, more))
    right = rotations.euler_to_matrix(np.array([a, np.pi / 2, c]), "XYZ")
    others = (
        ("xyz", [a, -np.pi / 2, c]),
        ("ZXZ", [a, 0.0, c]),
        ("zyz", [a, np.pi, c]),
        ("XYZ", [4.0, -5.0, 7.5]),
    )
    locked = [_ordered(candidate, np.array(angles), order) for order, angles in others]
    return worst([*(rotation_verdict(got, right, EULER_HINT) for got in (R, other)), *locked])


@check(1, public=False)
def unknown_orders(candidate: Function) -> Verdict:
    """Orders that are none of the 24 are refused, and the angles are left alone."""
    kept = left_alone(candidate, _ordered(candidate, some_angles(GRADERS()), "zyx"))
    none = ("xxy", "xYz", "zyy", "xyZ", "xYZ", "xyzx")
    asked = (
        refused(candidate, some_angles(GRADERS()), order, what=f'The order "{order}"')
        for order in none
    )
    return worst([*asked, kept])
