"""What laplacian is graded by besides the checks that a student sees."""

import numpy as np

from lessons.graphs.exercises import GRADERS, matrix_verdict, weighted
from lessons.graphs.exercises.laplacian import HINT, found
from workbench.exercise import Function, Verdict, against, band, check, worst
from workbench.geometry.graphs import adjacency as graphs


@check(2, public=False)
def a_constant_costs_nothing(candidate: Function) -> Verdict:
    """L 1 = 0, and u^T L u adds up the weighted squared differences of the edges."""
    rng = np.random.default_rng(GRADERS())
    verdicts = []
    for k, count in enumerate((3, 12, 40)):
        adjacency = weighted(GRADERS() + k, count)
        L = candidate(adjacency)
        u = rng.normal(size=count)
        right = float((np.triu(adjacency) * (u[:, None] - u) ** 2).sum())
        got = float(u @ L @ u)
        told = f"u^T L u is {against(got, right, 5)}. {HINT}"
        off = max(abs(got - right) / max(right, 1.0), float(np.abs(L.sum(axis=1)).max()))
        verdicts.append(band(f"{count} nodes: error", off, "", good=1e-6, fair=1e-3, hint=told))
    return worst(verdicts)


@check(2, public=False)
def graphs_of_all_sizes(candidate: Function) -> Verdict:
    """Graphs of 2 to 60 nodes, sparse and full, entry by entry."""
    sizes = ((2, 1.0), (9, 0.3), (25, 1.0), (60, 0.1))
    return worst(
        found(candidate, weighted(GRADERS() + 10 + n, n, chance), f"{n} nodes: ")
        for n, chance in sizes
    )


@check(1, public=False)
def nodes_without_edges(candidate: Function) -> Verdict:
    """A node without edges has a row of zeros, a graph of one node is 0; weights of a millionth and
    of a million count.
    """
    lonely = weighted(GRADERS() + 20, 7)
    lonely[:, [2, 5]] = lonely[[2, 5]] = 0.0
    none = [
        found(candidate, np.zeros((n, n)), case)
        for n, case in ((1, "One node: "), (4, "Four lone nodes: "))
    ]
    large = found(candidate, 1e6 * weighted(GRADERS() + 21, 6), "Weights of a million: ")
    small = 1e-3 * weighted(GRADERS() + 22, 6)
    hint = f"Weights of a thousandth count. {HINT}"
    tiny = matrix_verdict(
        1e3 * candidate(1e-3 * small), 1e3 * graphs.laplacian(1e-3 * small), hint, "Tiny weights: "
    )
    return worst((found(candidate, lonely, "Two lone nodes: "), *none, large, tiny))
