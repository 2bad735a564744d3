"""Lengths of shortest ways: along the edges of a graph, over the faces of a mesh, round a wall.

Edges are pairs of nodes, undirected, with lengths that are not negative.
Reference: Dijkstra, A note on two problems in connexion with graphs, 1959; Lanthier, Maheshwari and
Sack, Approximating weighted shortest paths on polyhedral surfaces, 2001, section 3.1.
"""

import numpy as np
import scipy
from jaxtyping import Bool, Float, Int

from workbench.geometry.graphs import Sparse
from workbench.geometry.meshes import triangles as meshes

Points = Float[np.ndarray, "n d"]
Edges = Int[np.ndarray, "e 2"]
Lengths = Float[np.ndarray, " e"]
TINY = 1e-300  # an edge of length 0, told from none


def edge_lengths(p: Points, edges: Edges) -> Lengths:
    """Return how long every edge is."""
    v = p[edges[:, 0]] - p[edges[:, 1]]
    return np.sqrt(np.einsum("ed,ed->e", v, v))


def length_graph(edges: Edges, lengths: Lengths, count: int) -> Sparse:
    """Return the symmetric matrix of a graph's lengths, also of 0; repeated edges' shortest."""
    return _one_way(
        np.concatenate([edges, edges[:, ::-1]]), np.concatenate([lengths, lengths]), count
    )


def _one_way(edges: Edges, lengths: Lengths, count: int) -> Sparse:
    """Return the matrix of edges that lead as they are given; of equal ones the shortest."""
    graph = scipy.sparse.csr_array(
        (np.maximum(lengths, TINY), tuple(edges.T)), shape=(count, count)
    )
    if graph.nnz < len(edges):  # some came twice, and their lengths were added up
        order = np.lexsort((lengths, edges[:, 1], edges[:, 0]))
        kept = order[np.r_[True, (np.diff(edges[order], axis=0) != 0).any(axis=1)]]
        return _one_way(edges[kept], lengths[kept], count)
    return graph


def shortest_distances(  # noqa: PLR0917
    edges: Edges, lengths: Lengths, count: int, source: int
) -> Float[np.ndarray, " {count}"]:
    """Return the length of the shortest way from the source to every node; inf out of reach.

    Examples:
        >>> edges = np.array([[0, 1], [1, 2], [0, 2]])
        >>> shortest_distances(edges, np.array([1.0, 1.0, 5.0]), 4, 0).tolist()
        [0.0, 1.0, 2.0, inf]
    """
    graph = _one_way(edges, lengths, count)
    return scipy.sparse.csgraph.dijkstra(graph, directed=False, indices=np.array([source]))[0]


def shortest_path(
    edges: Edges, lengths: Lengths, distances: Float[np.ndarray, " n"], *, goal: int
) -> Int[np.ndarray, " k"]:
    """Return the nodes of a shortest way from the source to the goal; empty out of reach.

    It is read back off the distances from the source, and stops where no neighbour is nearer.
    """
    if not np.isfinite(distances[goal]):
        return np.empty(0, int)
    graph = length_graph(edges, lengths, len(distances))
    path = [int(goal)]
    while distances[path[-1]] > 0 and len(path) <= len(distances):
        row = slice(graph.indptr[path[-1]], graph.indptr[path[-1] + 1])
        near = graph.indices[row]
        if not len(near):
            break
        best = near[np.argmin(distances[near] + graph.data[row])]
        if not distances[best] < distances[path[-1]]:
            break
        path.append(int(best))
    return np.array(path[::-1])


def with_points_on_edges(
    p: Float[np.ndarray, "v 3"], faces: Int[np.ndarray, "f 3"], count: int
) -> tuple[Float[np.ndarray, "n 3"], Edges, Lengths]:
    """Return a graph whose ways also cross faces: points on every edge, joined across each face.

    The vertices come first. The more points, the nearer the shortest way is to the true one over
    the faces, from above (Lanthier et al., 3.1, the fixed placement).
    """
    own = meshes.edges(faces)
    if count == 0:
        return p, own, edge_lengths(p, own)
    t = (np.arange(1, count + 1) / (count + 1))[:, None]
    a, b = p[own[:, 0], None], p[own[:, 1], None]
    nodes = np.concatenate([p, (a + t * (b - a)).reshape(-1, 3)])
    index = {k: np.searchsorted(meshes.edge_keys(own), _keys(faces, k)) for k in range(3)}
    # (f, count): of the edge opposite k
    on = [len(p) + count * index[k][:, None] + np.arange(count) for k in range(3)]
    pairs = [_chains(own, len(p), count)]
    for k in range(3):
        first = on[k]
        second = on[(k + 1) % 3]
        pairs.append(
            np.stack(
                [np.repeat(first, count, axis=1), np.tile(second, (1, count))], axis=-1
            ).reshape(-1, 2)
        )
        pairs.append(
            np.stack([np.repeat(faces[:, [k]], count, axis=1), first], axis=-1).reshape(-1, 2)
        )
    edges = np.concatenate(pairs)
    return nodes, edges, edge_lengths(nodes, edges)


def _keys(faces: np.ndarray, k: int) -> np.ndarray:
    """Return the keys of the edges opposite corner k."""
    return meshes.edge_keys(faces[:, [(k + 1) % 3, (k + 2) % 3]])


def _chains(own: np.ndarray, vertices: int, count: int) -> np.ndarray:
    """Return the pieces of every edge: from its first end over its points to its other end."""
    on = vertices + count * np.arange(len(own))[:, None] + np.arange(count)
    chain = np.concatenate([own[:, :1], on, own[:, 1:]], axis=1)
    return np.stack([chain[:, :-1], chain[:, 1:]], axis=-1).reshape(-1, 2)


def grid_edges(side: int, neighbours: int) -> Edges:
    """Return the edges of a square grid, node i * side + j in row i, to 4, 8 or 16 neighbours.

    Raises:
        ValueError: If it is another number of neighbours.
    """
    moves = {4: _PLUS, 8: _PLUS + _CROSS, 16: _PLUS + _CROSS + _KNIGHT}
    if neighbours not in moves:
        raise ValueError(f"a grid has 4, 8 or 16 neighbours, not {neighbours}")
    index = np.arange(side * side).reshape(side, side)
    pairs = []
    for di, dj in moves[neighbours]:
        here = index[: side - di, max(0, -dj) : side - max(0, dj)]
        moved = index[di:, max(0, dj) : side + min(0, dj)]
        pairs.append(np.stack([here, moved], axis=-1).reshape(-1, 2))
    return np.concatenate(pairs)


_PLUS = ((0, 1), (1, 0))
_CROSS = ((1, 1), (1, -1))
_KNIGHT = ((1, 2), (2, 1), (1, -2), (2, -1))


def distance_past_wall(
    p: Float[np.ndarray, "n 2"], q: Float[np.ndarray, "2"], tip: Float[np.ndarray, "2"]
) -> Float[np.ndarray, " n"]:
    """Return the shortest way from q to points of a plane with a wall straight below the tip."""
    straight = np.linalg.norm(p - q, axis=1)
    across = (p[:, 0] - tip[0]) * (q[0] - tip[0]) < 0
    share = np.divide(tip[0] - q[0], p[:, 0] - q[0], out=np.zeros(len(p)), where=across)
    blocked = across & (q[1] + share * (p[:, 1] - q[1]) < tip[1])
    return np.where(blocked, np.linalg.norm(q - tip) + np.linalg.norm(p - tip, axis=1), straight)


def crosses_wall(
    p: Float[np.ndarray, "e 2 2"], tip: Float[np.ndarray, "2"]
) -> Bool[np.ndarray, " e"]:
    """Return which segments cross or touch a wall straight below the tip, without the tip."""
    x = p[:, :, 0] - tip[0]
    meets = x[:, 0] * x[:, 1] <= 1e-12
    run = x[:, 1] - x[:, 0]
    share = np.divide(-x[:, 0], run, out=np.zeros(len(p)), where=run != 0)
    y = p[:, 0, 1] + share * (p[:, 1, 1] - p[:, 0, 1])
    lowest = np.where(run == 0, p[:, :, 1].min(axis=1), y)
    return meets & (lowest < tip[1] - 1e-9)
