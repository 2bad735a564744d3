"""What bezier_patch is graded by besides the checks that a student sees."""

import numpy as np

from lessons.representations.exercises import GRADERS, rows_verdict
from lessons.representations.exercises.bezier_patch import HINT, a_net, verdict
from workbench.exercise import Function, Verdict, check, worst
from workbench.geometry.shapes import bezier


@check(2, public=False)
def other_patches(candidate: Function) -> Verdict:
    """Other nets, large and far away."""
    rng = np.random.default_rng(GRADERS())
    nets = (rng.normal(size=(4, 4, 3)), 30 * a_net(rng) + 500, 0.01 * a_net(rng))
    return worst(verdict(candidate, net, rng.random((20, 2)), "On another patch") for net in nets)


@check(2, public=False)
def a_patch_of_a_torus(candidate: Function) -> Verdict:
    """The patches of the lesson's torus lie within 0.3 mm of it."""
    control = bezier.torus_patches(0.6, 0.25, rational=False)[5, ..., :3]
    return verdict(
        candidate, control, np.random.default_rng(GRADERS() + 1).random((20, 2)), "On the torus"
    )


@check(1, public=False)
def none_and_edges(candidate: Function) -> Verdict:
    """No places give no points, one gives one; along each edge only the four control points of that
    edge count.
    """
    rng = np.random.default_rng(GRADERS() + 2)
    if len(candidate(a_net(rng), np.empty((0, 2)))):
        return rows_verdict(np.ones(1), np.zeros(1), lambda k: "No places came in, points", HINT)
    edge = np.column_stack([np.zeros(8), rng.random(8)])
    end = np.column_stack([np.ones(8), rng.random(8)])
    edges = (edge, edge[:, ::-1].copy(), end, end[:, ::-1].copy())
    verdicts = [verdict(candidate, a_net(rng), uv, "Along an edge") for uv in edges]
    return worst([verdict(candidate, a_net(rng), edge[:1] + 0.3, "A single place"), *verdicts])
