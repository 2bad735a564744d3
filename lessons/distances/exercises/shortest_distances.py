"""Write Dijkstra's algorithm: how long the shortest way along edges is from one node to all. The
lesson's fronts on grids, surfaces and rolls run on what you return.
"""

import heapq
from collections import deque

import numpy as np
import scipy
from jaxtyping import Float, Int

from lessons.distances.exercises import STUDENTS, values_verdict
from workbench.exercise import Function, Verdict, alternative, check, contract, left_alone, mistake
from workbench.geometry.meshes import geodesics

Edges = Int[np.ndarray, "e 2"]
Lengths = Float[np.ndarray, " e"]


@contract(
    slot="shortest_distances",
    forbid=("scipy.sparse.csgraph",),
    examples=(
        (
            (
                "shortest_distances(np.array([[0, 1], [1, 2], [0, 2]]), np.array([1.0, 1.0, 5.0]),"
                " 4, 0)"
            ),
            "[0, 1, 2, np.inf]",
        ),
        (
            (
                "shortest_distances(np.array([[0, 1], [1, 2], [0, 2]]), np.array([1.0, 1.0, 5.0]),"
                " 4, 2)"
            ),
            "[2, 1, 0, np.inf]",
        ),
    ),
)
def shortest_distances(
    edges: Edges, lengths: Lengths, count: int, source: int
) -> Float[np.ndarray, " {count}"]:
    """Return the length of the shortest way from the source to every node.

    Args:
        edges: Pairs of nodes, each pair once. An edge leads both ways.
        lengths: How long each edge is, positive.
        count: How many nodes there are, from 0 to count - 1.
        source: Where all ways begin.

    Returns:
        One length per node: 0 at the source, inf where no way leads. The inputs stay as they are.
    """
    return geodesics.shortest_distances(edges, lengths, count, source)


HINT = (
    "Take the nearest node that is not done, and see whether a way over it is shorter for its"
    " neighbours."
)


def network(seed: int, count: int, near: int) -> tuple[np.ndarray, np.ndarray, int, int]:
    """Return points of a square joined at random to some of the nearest, with lengths of their own,
    and a source.
    """
    rng = np.random.default_rng(seed)
    p = rng.random((count, 2))
    order = np.argsort(np.linalg.norm(p[:, None] - p, axis=2), axis=1)[:, 1 : near + 1]
    pairs = np.column_stack([np.repeat(np.arange(count), near), order.ravel()])
    edges = np.unique(np.sort(pairs, axis=1), axis=0)
    edges = rng.permuted(edges[rng.permutation(len(edges))], axis=1)  # either end may come first
    lengths = np.linalg.norm(p[edges[:, 0]] - p[edges[:, 1]], axis=1) * rng.uniform(
        0.5, 3.0, len(edges)
    )
    return edges, np.round(lengths + 0.001, 4), count, int(rng.integers(count))


def found(
    candidate: Function, case: tuple[np.ndarray, np.ndarray, int, int], label: str = ""
) -> Verdict:
    """Judge the distances in one graph."""
    return values_verdict(candidate(*case), geodesics.shortest_distances(*case), HINT, label)


@check(2)
def a_detour_is_shorter(candidate: Function) -> Verdict:
    """Over more edges a way may be shorter."""
    edges = np.array([[0, 3], [0, 1], [1, 2], [2, 3], [3, 4]])
    return found(candidate, (edges, np.array([10.0, 1.0, 1.5, 2.0, 1.0]), 5, 0))


@check(2)
def edges_lead_both_ways(candidate: Function) -> Verdict:
    """An edge may be walked in either direction."""
    edges = np.array([[1, 0], [2, 1], [2, 3], [4, 3]])
    return found(candidate, (edges, np.array([1.0, 2.0, 3.0, 4.0]), 5, 2))


@check(1)
def inputs_are_left_alone(candidate: Function) -> Verdict:
    """Edges and lengths are not changed."""
    return left_alone(candidate, found(candidate, network(STUDENTS, 12, 3)))


def _beside(edges: np.ndarray, lengths: np.ndarray, count: int) -> list[list[tuple[int, float]]]:
    beside: list[list[tuple[int, float]]] = [[] for _ in range(count)]
    for (a, b), w in zip(edges.tolist(), lengths.tolist(), strict=True):
        beside[a].append((b, w))
        beside[b].append((a, w))
    return beside


@mistake("Your edges lead one way only. Enter every edge at both of its ends.")
def one_way(edges: np.ndarray, lengths: np.ndarray, count: int, source: int) -> np.ndarray:
    """From the first end to the second only."""
    graph = scipy.sparse.csr_array((lengths, (edges[:, 0], edges[:, 1])), shape=(count, count))
    return scipy.sparse.csgraph.dijkstra(graph, indices=np.array([source]))[0]


@mistake(
    "You keep the distance of a node's first visit. A later, shorter way must be allowed to"
    " lower it."
)
def first_visit(edges: np.ndarray, lengths: np.ndarray, count: int, source: int) -> np.ndarray:
    """Breadth first, nothing is lowered."""
    beside = _beside(edges, lengths, count)
    d = np.full(count, np.inf)
    d[source] = 0.0
    queue = deque([source])
    while queue:
        node = queue.popleft()
        for other, w in beside[node]:
            if d[other] == np.inf:
                d[other] = d[node] + w
                queue.append(other)
    return d


@mistake("You counted edges. Add up their lengths.")
def hops(edges: np.ndarray, lengths: np.ndarray, count: int, source: int) -> np.ndarray:
    """The number of edges."""
    return geodesics.shortest_distances(edges, np.ones(len(edges)), count, source)


@mistake(
    "Nodes that cannot be reached have the distance inf, not 0: start with inf everywhere but at"
    " the source."
)
def zero_out_of_reach(
    edges: np.ndarray, lengths: np.ndarray, count: int, source: int
) -> np.ndarray:
    """0 where no way leads."""
    d = geodesics.shortest_distances(edges, lengths, count, source)
    return np.where(np.isinf(d), 0.0, d)


@mistake(
    "Nodes that cannot be reached have the distance inf, not −1: start with inf everywhere but at"
    " the source."
)
def minus_one_out_of_reach(
    edges: np.ndarray, lengths: np.ndarray, count: int, source: int
) -> np.ndarray:
    """-1 where no way leads."""
    d = geodesics.shortest_distances(edges, lengths, count, source)
    return np.where(np.isinf(d), -1.0, d)


@mistake(
    "You went over the edges once. Distances must go on falling until no edge makes a way shorter."
)
def one_pass(edges: np.ndarray, lengths: np.ndarray, count: int, source: int) -> np.ndarray:
    """A single round of relaxation."""
    d = np.full(count, np.inf)
    d[source] = 0.0
    for (a, b), w in zip(edges, lengths, strict=True):
        d[b] = min(d[b], d[a] + w)
        d[a] = min(d[a], d[b] + w)
    return d


@mistake(
    "You compare the next edge alone, as a spanning tree does (Prim). Compare whole ways: d[node] +"
    " length."
)
def next_edge_only(edges: np.ndarray, lengths: np.ndarray, count: int, source: int) -> np.ndarray:
    """Prim's order: the shortest edge that leaves what is done."""
    beside = _beside(edges, lengths, count)
    d = np.full(count, np.inf)
    done = np.zeros(count, bool)
    heap = [(0.0, source, 0.0)]
    while heap:
        _, node, way = heapq.heappop(heap)
        if done[node]:
            continue
        done[node] = True
        d[node] = way
        for other, w in beside[node]:
            heapq.heappush(heap, (w, other, way + w))
    return d


@alternative
def in_rounds(edges: np.ndarray, lengths: np.ndarray, count: int, source: int) -> np.ndarray:
    """Bellman and Ford: all edges again and again, until nothing falls."""
    d = np.full(count, np.inf)
    d[source] = 0.0
    a, b = edges.T
    while True:
        before = d.copy()
        np.minimum.at(d, b, d[a] + lengths)
        np.minimum.at(d, a, d[b] + lengths)
        if np.array_equal(before, d):
            return d


@alternative
def with_a_heap(edges: np.ndarray, lengths: np.ndarray, count: int, source: int) -> np.ndarray:
    """Dijkstra with a heap."""
    beside = _beside(edges, lengths, count)
    d = np.full(count, np.inf)
    d[source] = 0.0
    heap = [(0.0, source)]
    while heap:
        way, node = heapq.heappop(heap)
        if way > d[node]:
            continue
        for other, w in beside[node]:
            if way + w < d[other]:
                d[other] = way + w
                heapq.heappush(heap, (d[other], other))
    return d
