"""What eikonal_update is graded by besides the checks that a student sees."""

import numpy as np

from lessons.distances.exercises import GRADERS
from lessons.distances.exercises.eikonal_update import found, nodes
from workbench.exercise import Function, Verdict, check, worst


@check(2, public=False)
def neighbours_out_of_reach(candidate: Function) -> Verdict:
    """Where one axis has no neighbour, inf, the front comes along the other."""
    a, b, h = nodes(GRADERS(), 8, 0.25, 1.5)
    a[[1, 4]], b[[2, 7]] = np.inf, np.inf
    return found(candidate, a, b, h)


@check(2, public=False)
def any_spacing(candidate: Function) -> Verdict:
    """Grids of 1 mm to 30 m, whichever neighbour is nearer."""
    return worst(
        found(candidate, *nodes(GRADERS() + k, 40, h, 1.8), f"Spacing {h:g} m: ")
        for k, h in enumerate((0.001, 0.1, 30.0))
    )


@check(1, public=False)
def one_node(candidate: Function) -> Verdict:
    """One node, one beside the source, one between two sources, and one far away."""
    return worst(
        (
            found(candidate, np.array([0.7]), np.array([0.4]), 0.5, "One node: "),
            found(candidate, np.array([0.0]), np.array([np.inf]), 0.5, "Beside the source: "),
            found(candidate, np.zeros(1), np.zeros(1), 0.5, "Between two sources: "),
            found(candidate, np.array([5e4]), np.array([5e4 + 3]), 10.0, "Far away: "),
        )
    )
