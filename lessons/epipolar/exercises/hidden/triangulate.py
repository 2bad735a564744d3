"""What triangulate is graded by besides the checks that a student sees."""

import numpy as np

from lessons.epipolar.exercises import GRADERS, a_pair, pixels_of
from lessons.epipolar.exercises.triangulate import HINT, judged, matrices
from workbench.exercise import Function, Verdict, check, worst
from workbench.geometry.motions import apply
from workbench.geometry.two_views import triangulation


@check(2, public=False)
def with_noise(candidate: Function) -> Verdict:
    """With half a pixel of noise, points are as near as the pixels allow."""
    pair = a_pair(GRADERS(), 40, 0.5)
    got = candidate(*matrices(pair), pair.uv_first, pair.uv_second)
    ours = triangulation.triangulate(*matrices(pair), pair.uv_first, pair.uv_second)
    return judged(got, ours, 1.5e-2, 4.5e-2, f"Beside the least-squares answer. {HINT}")


@check(1, public=False)
def far_and_single(candidate: Function) -> Verdict:
    """A single point is found too, and so is one a kilometre away."""
    pair = a_pair(GRADERS() + 1, 3)
    verdicts = []
    for depth in (5.0, 1000.0):
        p = np.array([[0.1, -0.05, 1.0]]) * depth
        uv = [
            pixels_of(K, q)
            for K, q in ((pair.K_first, p), (pair.K_second, apply(pair.T_second_first, p)))
        ]
        verdicts.append(judged(candidate(*matrices(pair), *uv), p, 1e-4, 1e-2))
    return worst(verdicts)


@check(1, public=False)
def another_origin(candidate: Function) -> Verdict:
    """Neither camera need stand at the origin, and points may have a negative z in the world."""
    pair = a_pair(GRADERS() + 2, 10)
    P, Q = matrices(pair)
    T = a_pair(GRADERS() + 3, 1).T_second_first
    T4 = T @ T
    verdicts = []
    for T_first_world in (
        T4,
        T4 @ np.diag([1.0, -1.0, -1.0, 1.0]),
    ):  # half a turn: all z are negative in the world
        args = P @ T_first_world, Q @ T_first_world, pair.clean_first, pair.clean_second
        p_world = apply(np.linalg.inv(T_first_world), pair.p_first)
        verdicts.append(judged(candidate(*args), p_world, 1e-5, 1e-3))
    return worst(verdicts)
