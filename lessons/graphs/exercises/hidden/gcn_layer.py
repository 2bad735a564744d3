"""What gcn_layer is graded by besides the checks that a student sees."""

import numpy as np

from lessons.graphs.exercises import GRADERS
from lessons.graphs.exercises.gcn_layer import Inputs, found, inputs
from workbench.data.networks import karate
from workbench.exercise import Function, Verdict, check, worst
from workbench.geometry.graphs import adjacency as graphs


def club(seed: int) -> Inputs:
    """Return the karate club with features and weights by chance."""
    rng = np.random.default_rng(seed)
    known = karate()
    return (
        graphs.graph_of(known.edges, 34).toarray(),
        rng.normal(size=(34, 5)),
        rng.normal(size=(5, 2)),
    )


@check(2, public=False)
def the_karate_club(candidate: Function) -> Verdict:
    """34 members with five features each."""
    return worst(found(candidate, club(GRADERS() + k)) for k in range(2))


@check(2, public=False)
def weighted_graphs(candidate: Function) -> Verdict:
    """Edges have weights, and degrees are their sums, the loop's 1 among them."""
    cases = ((6, 2, 5), (25, 4, 3), (40, 1, 1))
    return worst(
        found(candidate, inputs(GRADERS() + n, n, a, b), f"{n} nodes: ") for n, a, b in cases
    )


@check(1, public=False)
def nodes_without_edges(candidate: Function) -> Verdict:
    """A node without edges, or all there is, keeps its own features, through W and ReLU; small and
    large weights count.
    """
    adjacency, x, w = inputs(GRADERS() + 20, 9)
    adjacency[:, [0, 4]] = adjacency[[0, 4]] = 0.0
    alone = np.zeros((3, 3))
    wide = inputs(GRADERS() + 21, 12)[0] * np.exp(
        np.random.default_rng(GRADERS()).normal(-3, 3, (12, 12))
    )
    return worst(
        (
            found(candidate, (alone[:1, :1], x[:1], w), "One node: "),
            found(candidate, (wide + wide.T, np.vstack([x, x[:3]]), w), "Weights of all sizes: "),
            found(candidate, (adjacency, x, w), "Two lone nodes: "),
            found(candidate, (alone, x[:3], w), "No edges at all: "),
        )
    )
