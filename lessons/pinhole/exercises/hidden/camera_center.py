"""What camera_center is graded by besides the checks that a student sees."""

import numpy as np

from lessons.pinhole.exercises import GRADERS
from lessons.pinhole.exercises.camera_center import placed, some_cameras
from workbench.exercise import Function, Verdict, check, fail, full, partial, worst
from workbench.geometry.motions import apply, exp_so3, inverse, motion


@check(3, public=False)
def moves_with_the_world(candidate: Function) -> Verdict:
    """Where the world is moved, the centre moves along."""
    verdicts = []
    for eye, T_camera_world in some_cameras(GRADERS()):
        Q = motion(exp_so3(np.array([-0.9, 0.5, 1.3])), np.array([2.0, 7.0, -1.0]))
        verdicts += [
            placed(candidate(T_camera_world), eye),
            placed(candidate(T_camera_world @ inverse(Q)), apply(Q, eye)),
        ]
    return worst(verdicts)


@check(2, public=False)
def special_cameras(candidate: Function) -> Verdict:
    """The identity, a camera that is not turned, half a turn, and one a kilometre away are
    found.
    """
    far = np.array([900.0, -300.0, 400.0])
    T_turned = motion(exp_so3(np.array([0.3, 1.0, -0.6])), far)
    cases = (np.eye(4), motion(np.eye(3), far), motion(np.diag([-1.0, -1.0, 1.0]), far), T_turned)
    verdicts = [placed(candidate(T), inverse(T)[:3, 3]) for T in cases]
    right = sum(verdict.share == 1.0 for verdict in verdicts)
    if right == len(verdicts):
        return full(f"All {right} are found.")
    message = f"{right} of {len(verdicts)} are found. {worst(verdicts).message}"
    return partial(0.5, message) if right == 3 else fail(message)
