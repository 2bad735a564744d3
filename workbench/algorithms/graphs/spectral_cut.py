"""Cuts a graph in two: the Fiedler vector, the cut by its sign, and the best of all cuts along it.

Reference: von Luxburg, A tutorial on spectral clustering, 2007, sections 4 and 5; Spielman,
Spectral and algebraic graph theory, 2019, chapter 21 (sweep cuts).
"""

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from typing import Literal

import numpy as np
from jaxtyping import Bool, Float, Int

from workbench.geometry.graphs import Sparse, conductance, cut_weight, sweep
from workbench.geometry.graphs.spectra import Laplacian
from workbench.tracing import traced

Phase = Literal["graph", "fiedler", "sign", "sweep", "best"]


def _none() -> np.ndarray:
    return np.empty(0)


@dataclass(frozen=True, eq=False, kw_only=True)
class Cut:
    """What is known of a graph's cut after a phase; what comes later is empty.

    Attributes:
        eigenvalues: The three smallest, or as many as there are.
        fiedler: The function of the second.
        side: Which nodes are on the near side.
        order: All nodes in the order of the Fiedler vector.
        conductances: Of each cut along that order.
        k: The near side has the first k + 1 nodes; -1 for the cut by sign.
        cut: The weight of the edges between the two sides.
        conductance: That over the smaller side's degrees.
    """

    phase: Phase
    adjacency: Sparse
    eigenvalues: Float[np.ndarray, " _"] = field(default_factory=_none)
    fiedler: Float[np.ndarray, " _"] = field(default_factory=_none)
    side: Bool[np.ndarray, " _"] = field(default_factory=lambda: np.empty(0, bool))
    order: Int[np.ndarray, " _"] = field(default_factory=lambda: np.empty(0, int))
    conductances: Float[np.ndarray, " _"] = field(default_factory=_none)
    k: int = -1
    cut: float = float("nan")
    conductance: float = float("nan")


@traced
def spectral_cut(adjacency: Sparse, laplacian: Laplacian, shown: int = 6) -> Iterator[Cut]:
    """Yield the graph, its Fiedler vector, the cut by sign, `shown` cuts along it, and the best.

    Args:
        adjacency: A of a symmetric graph with two nodes or more.
        laplacian: Of which the second function is taken: plain, normalised, or of a mesh.
    """
    state = Cut(phase="graph", adjacency=adjacency)
    yield state

    # the first is constant and tells nothing
    values, fiedler = laplacian.second(min(3, adjacency.shape[0]))
    yield (state := replace(state, phase="fiedler", eigenvalues=values, fiedler=fiedler))

    yield (state := _with(state, "sign", fiedler > 0, k=-1))

    order, conductances = sweep(adjacency, fiedler)
    state = replace(state, order=order, conductances=conductances)
    for k in np.unique(np.linspace(0, len(order) - 2, shown + 2).round().astype(int)[1:-1]):
        yield _with(state, "sweep", np.isin(np.arange(len(order)), order[: k + 1]), k=int(k))

    best = int(np.argmin(conductances))
    yield _with(state, "best", np.isin(np.arange(len(order)), order[: best + 1]), k=best)


def _with(state: Cut, phase: Phase, side: np.ndarray, *, k: int) -> Cut:
    cut, phi = cut_weight(state.adjacency, side), conductance(state.adjacency, side)
    return replace(state, phase=phase, side=side, k=k, cut=cut, conductance=phi)
