"""What point_to_plane_step is graded by besides the checks that a student sees."""

import numpy as np

from lessons.icp.exercises import GRADERS, a_motion
from lessons.icp.exercises.point_to_plane_step import STEP_HINT, _stepped, arrived, planes, slid
from workbench.exercise import Function, Verdict, check, motion_verdict, worst
from workbench.geometry.motions import apply, motion


@check(2, public=False)
def noisy_step(candidate: Function) -> Verdict:
    """With noise and normals of either sign, one step is the least-squares step."""
    verdicts = []
    for k in range(3):
        rng = np.random.default_rng(GRADERS() + k)
        p_true, n_target = planes(rng, 150)
        p_source = apply(a_motion(rng, 0.5, 0.02), p_true) + 0.005 * rng.normal(size=p_true.shape)
        p_target = slid(rng, p_true, n_target)
        signs = rng.choice([-1.0, 1.0], (150, 1))
        verdicts.append(
            _stepped(candidate(p_target, p_source, signs * n_target), p_target, p_source, n_target)
        )
    return worst(verdicts)


@check(2, public=False)
def steps_arrive_elsewhere(candidate: Function) -> Verdict:
    """Six steps arrive from other starts too, also five metres from the origin."""
    return worst(
        [
            arrived(candidate, GRADERS() + 10, 15.0, 0.1),
            arrived(candidate, GRADERS() + 11, 8.0, 0.05, aside=5.0),
        ]
    )


@check(1, public=False)
def sliding(candidate: Function) -> Verdict:
    """One plane, or two, pull points onto themselves and do not slide or spin them; one pair is
    enough for that.
    """
    rng = np.random.default_rng(GRADERS() + 20)
    flat = rng.uniform(-1, 1, (40, 3)) * [1.0, 1.0, 0.0]
    flat -= flat.mean(0)
    n_target = np.tile([0.0, 0.0, 1.0], (40, 1))
    p_target = flat + rng.uniform(-0.2, 0.2, flat.shape) * [1.0, 1.0, 0.0]
    right = motion(np.eye(3), np.array([0.0, 0.0, -0.04]))
    lifted = flat + np.array([0.0, 0.0, 0.04])
    hint = "What no plane holds stays. " + STEP_HINT
    verdicts = [motion_verdict(candidate(p_target, lifted, n_target), right, hint, p=lifted)]
    normal = np.array([[0.6, 0.0, 0.8]])
    place = np.zeros((1, 3))
    shift = motion(np.eye(3), 0.07 * normal[0])
    verdicts.append(
        motion_verdict(
            candidate(place + 0.07 * normal, place, normal), shift, f"One pair. {hint}", p=place
        )
    )
    # two and two, seen from the middle
    walls = np.array([[1.0, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0]])
    p_walls = 1.5 * walls
    both = motion(np.eye(3), np.array([0.03, -0.05, 0.0]))
    moved = p_walls + np.abs(walls) * [0.03, -0.05, 0.0]
    verdicts.append(
        motion_verdict(
            candidate(moved, p_walls, np.abs(walls)), both, f"Two planes. {hint}", p=p_walls
        )
    )
    return worst(verdicts)
