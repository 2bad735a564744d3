"""Graphs of points: adjacency, spectra and embeddings.

- `adjacency`: graphs as matrices: neighbours of points, adjacency, components, Laplacians, cuts,
  and how far apart nodes are.
- `spectra`: eigenvalues and eigenvectors of Laplacians, whichever graph or mesh they belong to.
- `embedding`: places for things of which only the distances are known: classical scaling, and a
  layout of graphs by their stress.
"""

from workbench.geometry.graphs.adjacency import (
    Join,
    Matrix,
    Points,
    Sparse,
    components,
    conductance,
    cut_weight,
    degrees,
    directed_graph,
    edges_of,
    gcn_layer,
    graph_of,
    hops,
    joined,
    knn_adjacency,
    laplacian,
    neighbours,
    one_way_share,
    propagation,
    sweep,
)

__all__ = [
    "Join",
    "Matrix",
    "Points",
    "Sparse",
    "components",
    "conductance",
    "cut_weight",
    "degrees",
    "directed_graph",
    "edges_of",
    "gcn_layer",
    "graph_of",
    "hops",
    "joined",
    "knn_adjacency",
    "laplacian",
    "neighbours",
    "one_way_share",
    "propagation",
    "sweep",
]
