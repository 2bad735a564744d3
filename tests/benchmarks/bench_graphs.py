"""Graphs of neighbours, Fiedler vectors and diffusion beside their peers: `python -m
tests.benchmarks.bench_graphs`.

All contenders of a task see the same points or graph in one run and on one thread, taking turns;
figures are medians of CPU milliseconds. The number behind is what must agree: edges, an eigenvalue,
the heat of one node. Floors are ratios to the best peer that a prototype reached. networkx' default
way to a Fiedler vector (tracemin_pcg) takes seconds and is asked once.
"""

# ruff: noqa: E402 (the number of threads is set before numpy starts them)
import os

for _name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ.setdefault(_name, "1")

from types import ModuleType

import numpy as np
import scipy

from tests.benchmarks.bench_curvature import Contender, compare, peer
from workbench.geometry.graphs import adjacency as graphs
from workbench.geometry.graphs.spectra import Laplacian

FLOORS = {"neighbours": 0.8, "fiedler": 0.27}


def main() -> None:
    """Print one table per task."""
    networkx, neighbors = peer("networkx"), peer("sklearn.neighbors")
    p = np.random.default_rng(0).random((20_000, 3))
    compare(
        "Graph of 8 neighbours, either way, 20,000 points",
        joins(p, neighbors),
        None,
        floor=FLOORS["neighbours"],
        repeats=5,
    )
    few = graphs.joined(graphs.directed_graph(graphs.neighbours(p[:5000], 8)[0]), "union")
    compare(
        "Second eigenvalue and vector of L, 5,000 nodes",
        fiedlers(few, networkx),
        None,
        floor=FLOORS["fiedler"],
        repeats=3,
    )
    compare("The same, networkx as it is", slow(few, networkx), None, floor=None, repeats=1)
    many = graphs.joined(graphs.directed_graph(graphs.neighbours(p, 8)[0]), "union")
    compare("Components, 20,000 nodes", pieces(many, networkx), None, floor=None, repeats=3)


def joins(p: np.ndarray, neighbors: ModuleType | None) -> dict[str, Contender]:
    """Return who makes a symmetric graph of neighbours; the sum of its entries must agree."""
    contenders: dict[str, Contender] = {
        "ours": lambda: float(
            graphs.joined(graphs.directed_graph(graphs.neighbours(p, 8)[0]), "union").sum()
        )
    }
    if neighbors is not None:

        def theirs() -> float:
            named = neighbors.kneighbors_graph(p, 8)
            return float(named.maximum(named.T).sum())

        contenders["sklearn"] = theirs
    return contenders


def fiedlers(
    adjacency: scipy.sparse.csr_array, networkx: ModuleType | None
) -> dict[str, Contender]:
    """Return who finds the second eigenvalue of L = D - A."""
    ones = np.ones(adjacency.shape[0])
    contenders: dict[str, Contender] = {
        "ours": lambda: float(Laplacian(graphs.laplacian(adjacency), ones).smallest(2)[0][1])
    }

    def plain() -> float:
        L = graphs.laplacian(adjacency).tocsc()
        return float(
            np.sort(scipy.sparse.linalg.eigsh(L, 2, sigma=-1e-3, return_eigenvectors=False))[1]
        )

    contenders["our L, eigsh as it is"] = plain
    if networkx is not None:
        graph = networkx.from_scipy_sparse_array(adjacency)
        for method in ("lanczos", "tracemin_lu"):
            contenders[f"networkx {method}"] = lambda method=method: float(
                networkx.algebraic_connectivity(graph, method=method, seed=0)
            )
    return contenders


def slow(adjacency: scipy.sparse.csr_array, networkx: ModuleType | None) -> dict[str, Contender]:
    """Return ours beside networkx' default."""
    contenders = {"ours": fiedlers(adjacency, None)["ours"]}
    if networkx is not None:
        graph = networkx.from_scipy_sparse_array(adjacency)
        contenders["networkx tracemin_pcg"] = lambda: float(
            networkx.algebraic_connectivity(graph, seed=0)
        )
    return contenders


def pieces(adjacency: scipy.sparse.csr_array, networkx: ModuleType | None) -> dict[str, Contender]:
    """Return who counts the components."""
    contenders: dict[str, Contender] = {
        "ours": lambda: float(graphs.components(adjacency).max() + 1)
    }
    if networkx is not None:
        graph = networkx.from_scipy_sparse_array(adjacency)
        contenders["networkx"] = lambda: float(networkx.number_connected_components(graph))
    return contenders


if __name__ == "__main__":
    main()
