"""What rotation_from_axis_angle is graded by besides the checks that a student sees."""

import numpy as np

from lessons.rotations.exercises import GRADERS, some_motions
from lessons.rotations.exercises.rotation_from_axis_angle import TURN_HINT, some_turns
from workbench.exercise import (
    Function,
    Verdict,
    band,
    check,
    degrees_between,
    number,
    refused,
    rotation_verdict,
    worst,
)
from workbench.geometry.motions import rotations


@check(2, public=False)
def turned_axis(candidate: Function) -> Verdict:
    """With the axis turned by Q, R becomes Q R Q^T."""
    verdicts = []
    for (axis, angle), T in zip(some_turns(GRADERS()), some_motions(GRADERS(), 6), strict=True):
        Q = T[:3, :3]
        R = rotations.rotation_from_axis_angle(axis, angle)
        verdicts.append(rotation_verdict(candidate(Q @ axis, angle), Q @ R @ Q.T, TURN_HINT))
    return worst(verdicts)


@check(1, public=False)
def special_angles(candidate: Function) -> Verdict:
    """No turn, half a turn and turns and turns either way are rotations, and an angle of 1e-6 is
    not lost.
    """
    axis = np.array([0.3, -0.4, 1.2])
    verdicts = [
        rotation_verdict(
            candidate(axis, v),
            rotations.rotation_from_axis_angle(axis, v),
            f"Angle {v:.3g}. {TURN_HINT}",
        )
        for v in (0.0, np.pi, -np.pi, 7.5, -8.0, 20.0, -100.0)
    ]
    tiny = degrees_between(candidate(axis, 1e-6), np.eye(3)) / np.degrees(1e-6)
    hint = (
        f"By 0.000001 radians yours turns by {number(1e-6 * tiny)}, right is 0.000001. {TURN_HINT}"
    )
    kept = band(
        "Relative error of a tiny angle", abs(tiny - 1.0), "", good=1e-3, fair=1e-1, hint=hint
    )
    return worst([*verdicts, kept])


@check(2, public=False)
def zero_axis(candidate: Function) -> Verdict:
    """An axis of length zero is refused; one of a micrometre or a kilometre is as good as any."""
    verdicts = [refused(candidate, np.zeros(3), 0.5, what="A zero axis")]
    for length in (1e-6, 1e3):
        axis = length * np.array([0.48, -0.6, 0.64])
        right = rotations.rotation_from_axis_angle(axis, 0.5)
        verdicts.append(
            rotation_verdict(candidate(axis, 0.5), right, f"An axis {length:g} long. {TURN_HINT}")
        )
    return worst(verdicts)
