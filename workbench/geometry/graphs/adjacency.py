"""Graphs as matrices: neighbours of points, components, Laplacians, cuts, distances.

A graph of n nodes is its adjacency matrix A (n, n): A_ij is the weight of the edge from i to j, 0
where there is none. It is symmetric unless it is said to be directed. A `Matrix` is dense or
sparse, and so is the answer.
Reference: von Luxburg, A tutorial on spectral clustering, Statistics and Computing 17, 2007,
sections 2 and 3.
"""

from typing import Literal, TypeAlias, TypeVar

import numpy as np
import scipy
from jaxtyping import Bool, Float, Int

Points = Float[np.ndarray, "n d"]
Sparse: TypeAlias = scipy.sparse.csr_array
Matrix = TypeVar("Matrix", np.ndarray, scipy.sparse.csr_array)
Join = Literal["union", "mutual", "directed"]


def neighbours(p: Points, k: int) -> tuple[Int[np.ndarray, "n {k}"], Float[np.ndarray, "n {k}"]]:
    """Return the k nearest other points of every point, nearest first, and their distances.

    Raises:
        ValueError: If there are not more than k points, or k is below 1.
    """
    if not 0 < k < len(p):
        raise ValueError(
            f"asked for {k} neighbours of {len(p)} points; there must be more points, and 1"
            " neighbour or more"
        )
    # A query of many points goes through the tree in their own order; sorted by leaf it stays in
    # the processor's cache.
    tree = scipy.spatial.cKDTree(p, balanced_tree=False, compact_nodes=False)
    order = tree.indices
    d = np.empty((len(p), k + 1))
    index = np.empty((len(p), k + 1), dtype=np.intp)
    d[order], index[order] = tree.query(p[order], k + 1)
    others = index != np.arange(len(p))[:, None]
    # So many points at one place that it did not find itself
    others[others.all(axis=1), -1] = False
    return index[others].reshape(len(p), k), d[others].reshape(len(p), k)


def directed_graph(
    rows: Int[np.ndarray, "n k"], lengths: Float[np.ndarray, "n k"] | None = None
) -> Sparse:
    """Return the directed graph from every point to its neighbours, weighted 1 or by lengths."""
    n, k = rows.shape
    weights = np.ones(n * k) if lengths is None else lengths.ravel()
    return scipy.sparse.csr_array((weights, rows.ravel(), np.arange(0, n * k + 1, k)), shape=(n, n))


def joined(directed: Sparse, join: Join) -> Sparse:
    """Return the graph with edges that either end names (union), both do (mutual), or as it is."""
    if join == "directed":
        return directed
    back = directed.T.tocsr()
    graph = directed.maximum(back) if join == "union" else directed.minimum(back)
    return graph.tocsr()


def knn_adjacency(p: Points, k: int) -> Float[np.ndarray, "n n"]:
    """Return the dense 0-1 adjacency of the union k-nearest neighbour graph (von Luxburg, 2.2)."""
    rows, _ = neighbours(p, k)
    adjacency = np.zeros((len(p), len(p)))
    np.put_along_axis(adjacency, rows, 1.0, axis=1)
    return np.maximum(adjacency, adjacency.T)


def graph_of(
    edges: Int[np.ndarray, "e 2"], count: int, weights: Float[np.ndarray, " e"] | None = None
) -> Sparse:
    """Return the adjacency of undirected edges; weights, 1 by default, of repeated ones add up."""
    a, b = edges.T
    w = np.ones(len(edges)) if weights is None else weights
    both = np.concatenate([a, b]), np.concatenate([b, a])
    return scipy.sparse.csr_array((np.concatenate([w, w]), both), shape=(count, count))


def sparse(dense: Float[np.ndarray, "n n"]) -> Sparse:
    """Return a matrix without its zeros, a third of the time that scipy takes for large ones."""
    filled = np.flatnonzero(dense != 0)
    places = np.stack(np.divmod(filled, dense.shape[1])).astype(np.int32)
    return scipy.sparse.csr_array((dense.ravel()[filled], places), shape=dense.shape)


def edges_of(adjacency: Sparse) -> Int[np.ndarray, "e 2"]:
    """Return every edge between two nodes once, smaller node first, in ascending order."""
    a, b = adjacency.nonzero()
    once = np.unique(
        np.minimum(a, b)[a != b].astype(np.int64) * adjacency.shape[0] + np.maximum(a, b)[a != b]
    )
    return np.stack(np.divmod(once, adjacency.shape[0]), axis=1).astype(np.intp)


def one_way_share(directed: Sparse) -> float:
    """Return the share of a directed graph's edges that have none in the other direction."""
    edges = directed.astype(bool)
    return 1.0 - edges.multiply(edges.T).sum() / max(edges.sum(), 1)


def degrees(adjacency: Matrix) -> Float[np.ndarray, " n"]:
    """Return the sum of weights at each node: its number of neighbours, where all are 1."""
    return np.asarray(adjacency.sum(axis=1), dtype=float).ravel()


def components(adjacency: Sparse) -> Int[np.ndarray, " n"]:
    """Return the number of each node's connected component, either way; 0 is the largest."""
    _, names = scipy.sparse.csgraph.connected_components(adjacency, directed=False)
    sizes = np.bincount(names)
    rank = np.empty(len(sizes), dtype=np.intp)
    rank[np.argsort(-sizes, kind="stable")] = np.arange(len(sizes))
    return rank[names]


def hops(
    adjacency: Sparse, sources: Int[np.ndarray, " s"] | None = None
) -> Float[np.ndarray, "s n"]:
    """Return how many edges away every node is from each source (all nodes); inf out of reach."""
    return scipy.sparse.csgraph.dijkstra(
        adjacency, directed=False, unweighted=True, indices=sources
    )


def laplacian(adjacency: Matrix) -> Matrix:
    """Return L = D - A, D holding the degrees: (L u)_i = sum_j A_ij (u_i - u_j) (von Luxburg, 3.1).

    Without negative weights its eigenvalue 0 comes once for every component; loops do not matter.
    """
    d = degrees(adjacency)
    if isinstance(adjacency, np.ndarray):
        return np.diag(d) - adjacency
    return (scipy.sparse.diags_array(d) - adjacency).tocsr()


def propagation(adjacency: Matrix) -> Matrix:
    """Return D^(-1/2) (A + I) D^(-1/2), D holding the degrees of A + I.

    Its largest eigenvalue is 1, with the eigenvector D^(1/2) 1 on every component.
    Reference: Kipf and Welling, Semi-supervised classification with graph convolutional networks,
    2017.
    """
    if isinstance(adjacency, np.ndarray):
        looped = adjacency + 0.0  # a copy of floats
        looped.flat[:: len(looped) + 1] += 1
        root = 1 / np.sqrt(looped.sum(axis=1))
        looped *= root[:, None]
        looped *= root
        return looped
    looped = (adjacency + scipy.sparse.eye_array(adjacency.shape[0])).tocsr()
    scale = scipy.sparse.diags_array(1 / np.sqrt(degrees(looped)))
    return (scale @ looped @ scale).tocsr()


def gcn_layer(
    adjacency: Matrix, features: Float[np.ndarray, "n a"], weights: Float[np.ndarray, "a b"]
) -> Float[np.ndarray, "n b"]:
    """Return ReLU(D^(-1/2) (A + I) D^(-1/2) X W) (Kipf and Welling 2017, eq. 2)."""
    root = 1 / np.sqrt(degrees(adjacency) + 1.0)[:, None]  # D^(-1/2) of A + I
    sent = root * (features @ weights)
    return np.maximum(root * (adjacency @ sent + sent), 0.0)


def cut_weight(adjacency: Sparse, side: Bool[np.ndarray, " n"]) -> float:
    """Return the weight of all edges between a side and the rest."""
    part = side.astype(float)
    return float(part @ (adjacency @ (1 - part)))


def conductance(adjacency: Sparse, side: Bool[np.ndarray, " n"]) -> float:
    """Return a cut's weight over the smaller side's sum of degrees (Spielman 2019, 21.1)."""
    d = degrees(adjacency)
    smaller = min(d[side].sum(), d[~side].sum())
    return cut_weight(adjacency, side) / smaller if smaller > 0 else float("nan")


def sweep(
    adjacency: Sparse, values: Float[np.ndarray, " n"]
) -> tuple[Int[np.ndarray, " n"], Float[np.ndarray, " m"]]:
    """Return the nodes in ascending order of a value, and the conductances of the cuts along it.

    Cut k has the first k + 1 nodes on one side; where a side has no edges it is given 1.
    Reference: Spielman, Spectral and algebraic graph theory, 2019, 21.2 (Cheeger's inequality).
    """
    n = adjacency.shape[0]
    order = np.argsort(values, kind="stable")
    place = np.empty(n, dtype=np.intp)
    place[order] = np.arange(n)
    edges = adjacency.tocoo()
    a, b = place[edges.row], place[edges.col]
    # An edge is cut from where its first end has come to the near side until its second has: +w and
    # -w, added up.
    change = np.bincount(np.minimum(a, b), edges.data, n) - np.bincount(
        np.maximum(a, b), edges.data, n
    )
    cut = np.cumsum(change / 2)[:-1]  # every edge is listed from both its ends
    d = degrees(adjacency)[order]
    near = np.cumsum(d)[:-1]
    smaller = np.minimum(near, d.sum() - near)
    return order, np.where(smaller > 0, cut / np.where(smaller > 0, smaller, 1.0), 1.0)
