"""Graphs of points: adjacency, spectra and embeddings.

- `adjacency`: graphs as matrices: neighbours, components, Laplacians, cuts, distances.
- `spectra`: eigenvalues and eigenvectors of Laplacians of any graph or mesh.
- `embedding`: places for things of which only the distances are known.
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
