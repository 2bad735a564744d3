"""What shortest_distances is graded by besides the checks that a student sees."""

import numpy as np

from lessons.distances.exercises import GRADERS, values_verdict
from lessons.distances.exercises.shortest_distances import HINT, found, network
from workbench.exercise import Function, Verdict, check, worst
from workbench.geometry.meshes import geodesics


@check(2, public=False)
def random_networks(candidate: Function) -> Verdict:
    """Networks of 8 to 200 nodes, from any source."""
    return worst(
        found(candidate, network(GRADERS() + n, n, 4), f"{n} nodes: ") for n in (8, 40, 200)
    )


@check(2, public=False)
def out_of_reach(candidate: Function) -> Verdict:
    """Nodes in another piece, and nodes without edges, are infinitely far."""
    edges, lengths, count, _ = network(GRADERS() + 300, 15, 3)
    both = np.concatenate([edges, edges + count]), np.concatenate([lengths, lengths])
    return found(candidate, (*both, 2 * count + 2, count + 1))


@check(1, public=False)
def the_smallest_graphs(candidate: Function) -> Verdict:
    """A node alone, two nodes, nodes without an edge, a source without one; short and long
    edges.
    """
    alone = (np.empty((0, 2), int), np.empty(0), 1, 0)
    edge = np.array([[1, 0]])
    edges, lengths, count, _ = network(GRADERS() + 310, 12, 3)
    short = 1e3 * candidate(edges, 1e-7 * lengths, count, 5)
    right = 1e3 * geodesics.shortest_distances(edges, 1e-7 * lengths, count, 5)
    return worst(
        (
            found(candidate, alone, "One node: "),
            found(candidate, (edge, np.array([0.5]), 2, 0), "Two: "),
            found(candidate, (alone[0], alone[1], 3, 1), "No edges: "),
            found(candidate, (edge, np.array([0.5]), 4, 2), "A source without edges: "),
            found(candidate, (edges, 1e6 * lengths, count, 5), "Long edges: "),
            values_verdict(
                short, right, HINT, "Short edges, their lengths in thousandths: ", fair=1e-5
            ),
        )
    )
