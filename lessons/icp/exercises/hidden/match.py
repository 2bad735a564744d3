"""What match is graded by besides the checks that a student sees."""

import numpy as np

from lessons.icp.exercises import GRADERS, a_motion
from lessons.icp.exercises.match import MATCH_HINT, nearest_found, two_clouds
from workbench.exercise import Function, Verdict, check, refused, worst
from workbench.geometry.motions import apply


@check(2, public=False)
def uneven_clouds(candidate: Function) -> Verdict:
    """Few targets for many points, many for few, and single ones are all served, in a room and in a
    town.
    """
    sizes = ((7, 300), (300, 7), (1, 20), (90, 90), (30, 1))
    clouds = [two_clouds(GRADERS() + k, m, n) for k, (m, n) in enumerate(sizes)]
    p_target, p_source = two_clouds(GRADERS() + 9, 60, 60)
    return worst(
        nearest_found(candidate, *pair) for pair in (*clouds, (2000 * p_target, 2000 * p_source))
    )


@check(1, public=False)
def moved_clouds(candidate: Function) -> Verdict:
    """Moving both clouds a thousand kilometres away and turning them changes no partner."""
    verdicts = []
    for k in range(3):
        p_target, p_source = two_clouds(GRADERS() + 10 + k, 120, 100)
        T = a_motion(np.random.default_rng(GRADERS() + k), 100.0, 1e6)
        verdicts.append(
            nearest_found(
                candidate,
                apply(T, p_target),
                apply(T, p_source),
                "Far from the origin. " + MATCH_HINT,
            )
        )
    return worst(verdicts)


@check(1, public=False)
def double_points(candidate: Function) -> Verdict:
    """Target points that occur twice do no harm."""
    p_target, p_source = two_clouds(GRADERS() + 20, 40, 60)
    return nearest_found(
        candidate, np.vstack([p_target, p_target]), np.vstack([p_source, p_target])
    )


@check(1, public=False)
def no_target(candidate: Function) -> Verdict:
    """A target without points is refused."""
    return refused(
        candidate, np.empty((0, 3)), two_clouds(GRADERS(), 1, 5)[1], what="An empty target"
    )
