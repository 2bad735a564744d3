"""What pose_from_homography is graded by besides the checks that a student sees."""

import numpy as np

from lessons.calibration.exercises import CAMERA, GRADERS, views
from lessons.calibration.exercises.pose_from_homography import BOARD, HINT, posed, rotations
from workbench.exercise import Function, Verdict, check, motion_verdict, worst
from workbench.geometry.cameras import intrinsics
from workbench.geometry.motions import motion


@check(2, public=False)
def other_views(candidate: Function) -> Verdict:
    """Other exact homographies, of either sign, give their poses: near, far, at any scale, by
    another camera with skew.
    """
    K = intrinsics(1100.0, 350.0, 700.0, fy=900.0, skew=12.0)
    verdicts = [posed(candidate, GRADERS(), 4)]
    for (T, _), depth, scale in zip(
        views(GRADERS() + 5, 4), (8.0, 0.06, 0.5, 0.5), (1.0, 1.0, 1e-7, 1e7), strict=True
    ):
        T = motion(T[:3, :3], T[:3, 3] * depth / T[2, 3])
        verdicts.append(
            motion_verdict(candidate(K, scale * K @ T[:3, [0, 1, 3]]), T, HINT, p=BOARD)
        )
    return worst(verdicts)


@check(2, public=False)
def other_noise(candidate: Function) -> Verdict:
    """Other noise leaves rotations too."""
    return rotations(candidate, GRADERS() + 10)


@check(1, public=False)
def before_the_camera(candidate: Function) -> Verdict:
    """H and -H give the same pose, with the board's origin before the camera, seen from the front
    or from the back.
    """
    T, _ = views(GRADERS() + 20, 1)[0]
    verdicts = []
    for turn in (
        np.eye(3),
        np.diag([1.0, -1.0, -1.0]),
    ):  # about the board's own x axis: its back is seen
        T_board = motion(T[:3, :3] @ turn, T[:3, 3])
        H = CAMERA @ T_board[:3, [0, 1, 3]]
        verdicts += [
            motion_verdict(candidate(CAMERA, sign * H), T_board, HINT, p=BOARD)
            for sign in (1.0, -1.0)
        ]
    return worst(verdicts)
