"""What invert_rigid is graded by besides the checks that a student sees."""

import numpy as np

from lessons.transforms.exercises import GRADERS, some_motions
from lessons.transforms.exercises.invert_rigid import INVERT_HINT, some_points
from workbench.exercise import Function, Verdict, check, motion_verdict, worst
from workbench.geometry.motions import exp_so3, motion


@check(3, public=False)
def products_turn_round(candidate: Function) -> Verdict:
    """The inverse of a product is the product of the inverses, the other way round."""
    verdicts = []
    for T_a_b, T_b_c in zip(some_motions(GRADERS()), some_motions(GRADERS() + 1), strict=True):
        T_c_a = candidate(T_b_c) @ candidate(T_a_b)
        verdicts += [
            motion_verdict(candidate(T_a_b @ T_b_c), T_c_a, INVERT_HINT),
            _right(T_a_b, candidate(T_a_b)),
        ]
    return worst(verdicts)


@check(2, public=False)
def special_motions(candidate: Function) -> Verdict:
    """The identity, a pure translation, half a turn, a motion a kilometre long and a very small one
    are inverted.
    """
    far = np.array([800.0, -500.0, 300.0])
    cases = (np.eye(4), motion(np.eye(3), far), motion(np.diag([-1.0, 1.0, -1.0]), far))
    turns = (motion(exp_so3(np.array(w)), far) for w in ([0.0, 0.0, 1.0], [0.0, 0.01, 0.0]))
    small = motion(exp_so3(np.array([0.004, 0.0, -0.003])), np.array([0.01, -0.02, 0.005]))
    return worst(_right(T, candidate(T)) for T in (*cases, *turns, small))


def _right(T: np.ndarray, T_back: np.ndarray) -> Verdict:
    return motion_verdict(
        T_back @ T, np.eye(4), INVERT_HINT, p=some_points(GRADERS()), name="(T_b_a @ T_a_b)"
    )
