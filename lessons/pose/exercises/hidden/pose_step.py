"""What pose_step is graded by besides the checks that a student sees."""

import numpy as np

from lessons.pose.exercises import GRADERS, a_view
from lessons.pose.exercises.pose_step import HINT, a_start, arrived
from workbench.exercise import Function, Verdict, band, check, fail, motion_verdict, number, worst
from workbench.geometry.motions import apply, exp_so3, motion


def farthest(T: np.ndarray, T_right: np.ndarray, p: np.ndarray) -> float:
    """Return the largest distance, in metres, between where two motions take points."""
    return float(np.linalg.norm(apply(T, p) - apply(T_right, p), axis=1).max())


@check(2, public=False)
def with_noise(candidate: Function) -> Verdict:
    """With noise eight steps arrive at the pose of least squared errors."""
    return worst(arrived(candidate, GRADERS() + k, steps=8, sigma=2e-3, n=20) for k in range(3))


@check(2, public=False)
def other_starts(candidate: Function) -> Verdict:
    """Other starts arrive too, also with five points, with four, and with points of a plane."""
    return worst(
        [
            *(arrived(candidate, GRADERS() + 10 + k) for k in range(4)),
            arrived(candidate, GRADERS() + 22, n=5, steps=8),
            *(
                from_nearby(candidate, GRADERS() + 23 + k, n=4 + 8 * k, flat=bool(k))
                for k in range(2)
            ),
        ]
    )


def from_nearby(candidate: Function, seed: int, *, n: int, flat: bool) -> Verdict:
    """Judge where three steps arrive from a start that is a degree and some centimetres off."""
    T_true, p_world, xy = a_view(np.random.default_rng(seed), n, flat=flat)
    T = motion(exp_so3(np.array([0.01, -0.012, 0.008])), np.array([0.02, 0.01, -0.03])) @ T_true
    for _ in range(3):
        T = candidate(T, p_world, xy)
    hint = f"T is the pose after three steps with {n} points{' of a plane' if flat else ''}. {HINT}"
    return motion_verdict(T, T_true, hint, p=p_world)


@check(1, public=False)
def away_from_the_origin(candidate: Function) -> Verdict:
    """Points some metres from the origin make no difference."""
    return worst(arrived(candidate, GRADERS() + 30 + k, aside=4.0, steps=8) for k in range(2))


@check(1, public=False)
def each_call_is_one_step(candidate: Function) -> Verdict:
    """From 1 degree and 2 cm away one step leaves 2 mm at most; from 15 degrees and 30 cm it cannot
    arrive.
    """
    verdicts = []
    for k in range(4):
        T_true, p_world, xy, T, _ = a_start(
            GRADERS() + 40 + k, aside=2.0 * k, degrees=1.0, metres=0.02
        )
        left = farthest(candidate(T, p_world, xy), T_true, p_world)
        hint = (
            "The small motion moves t too: it is composed on the left of all of T, (exp(w) R,"
            " exp(w) t + v)."
        )
        verdicts.append(
            band(
                "One step from nearby leaves",
                left,
                "m, right is some tenths of a millimetre",
                good=2e-3,
                fair=1e-2,
                hint=hint,
            )
        )
    left = []
    for k in range(4):
        T_true, p_world, xy, T, _ = a_start(GRADERS() + 50 + k, aside=4.0)
        left.append(farthest(candidate(T, p_world, xy), T_true, p_world))
    if max(left) < 0.02:
        message = (
            f"One call from 15 degrees away leaves {number(max(left), 2)} m, right is some"
            " decimetres"
        )
        verdicts.append(
            fail(f"{message}. Return T after a single step: the lesson goes on from there.")
        )
    return worst(verdicts)
