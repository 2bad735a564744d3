"""What box_sdf is graded by besides the checks that a student sees."""

import numpy as np

from lessons.representations.exercises import GRADERS, rows_verdict
from lessons.representations.exercises.box_sdf import BOX, HINT, outside, verdict
from workbench.exercise import Function, Verdict, check, worst


@check(2, public=False)
def other_boxes(candidate: Function) -> Verdict:
    """Boxes of other shapes, long, flat and large, inside and outside."""
    rng = np.random.default_rng(GRADERS())
    verdicts = []
    for half in ([0.1, 2.0, 0.4], [0.6, 0.6, 0.01], [30.0, 20.0, 50.0], [1.0, 1.0, 1.0]):
        box = np.array(half)
        p = np.concatenate(
            [outside(box, k, rng, 8) for k in (1, 2, 3)] + [rng.uniform(-1, 1, (8, 3)) * box]
        )
        verdicts.append(verdict(candidate, p, box, "Another box"))
    return worst(verdicts)


@check(1, public=False)
def on_the_surface(candidate: Function) -> Verdict:
    """On faces, edges and corners it is 0, a millimetre off it is one, and in the middle minus the
    smallest half edge.
    """
    box = np.array([0.7, 0.2, 0.4])
    signs = np.stack(np.meshgrid(*[[-1, 0, 1]] * 3, indexing="ij"), axis=-1).reshape(-1, 3)
    p = np.concatenate([signs * box, signs * (box + 1e-3), signs * (box - 1e-3)])
    return verdict(candidate, p, box, "On the surface, a millimetre off it, or in the middle")


@check(1, public=False)
def none_or_one(candidate: Function) -> Verdict:
    """No points give no distances, one point gives one."""
    if len(candidate(np.empty((0, 3)), BOX)):
        return rows_verdict(np.ones(1), np.zeros(1), lambda k: "No points came in, distances", HINT)
    return verdict(candidate, np.array([[0.9, -0.1, 0.1]]), BOX, "A single point")
