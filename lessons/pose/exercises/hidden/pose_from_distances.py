"""What pose_from_distances is graded by besides the checks that a student sees."""

import numpy as np

from lessons.pose.exercises import GRADERS
from lessons.pose.exercises.pose_from_distances import HINT, judged
from workbench.exercise import Function, Verdict, check, motion_verdict, worst
from workbench.geometry.cameras.three_points import unit_rays
from workbench.geometry.motions import apply, exp_so3, inverse, motion


@check(2, public=False)
def other_cameras(candidate: Function) -> Verdict:
    """Cameras at other places are found too, half a turn away, with wide views, equal distances and
    small triangles.
    """
    verdicts = [judged(candidate, range(GRADERS(), GRADERS() + 20))]
    wide = unit_rays(np.array([[9.0, 0.5], [-6.0, 7.0], [0.2, -8.0]]))
    ends = (wide * [[2.0], [3.0], [2.5]], 4.0 * wide, 0.004 * wide, wide * [[2.0], [3.0], [-2.5]])
    for k, q in enumerate(ends):
        for R in (np.diag(np.roll([1.0, -1.0, -1.0], k)), exp_so3(np.array([0.3, -0.9, 0.4 * k]))):
            T = motion(R, np.array([0.3, -0.2, 0.5]))
            p_world = apply(inverse(T), q)
            distances = np.linalg.norm(q, axis=1)
            got = candidate(p_world, q / distances[:, None], distances)
            verdicts.append(motion_verdict(got, T, f"A wide view. {HINT}", p=p_world))
    return worst(verdicts)


@check(2, public=False)
def far_from_the_origin(candidate: Function) -> Verdict:
    """Points a hundred kilometres from the origin are as good."""
    return judged(candidate, range(GRADERS() + 30, GRADERS() + 34), aside=1e5)
