"""What students hand in for shortest_distances."""

import heapq

import numpy as np

NAMED = {
    "wrong_directed": "one way",
    "wrong_breadth_first": "first visit",
    "wrong_counts": "hops",
    "wrong_zero_unreached": "zero out of reach",
    "wrong_minus_one": "minus one out of reach",
    "wrong_one_round": "one pass",
    "wrong_prim": "next edge only",
}


def _beside(edges, lengths, count):
    beside = [[] for _ in range(count)]
    for (a, b), w in zip(edges, lengths, strict=True):
        beside[a].append((b, w))
        beside[b].append((a, w))
    return beside


def right_heap(edges, lengths, count, source):
    beside = _beside(edges, lengths, count)
    d = [float("inf")] * count
    d[source] = 0.0
    heap, done = [(0.0, source)], set()
    while heap:
        way, u = heapq.heappop(heap)
        if u in done:
            continue
        done.add(u)
        for v, w in beside[u]:
            if way + w < d[v]:
                d[v] = way + w
                heapq.heappush(heap, (d[v], v))
    return np.array(d)


def right_floyd(edges, lengths, count, source):
    D = np.full((count, count), np.inf)
    np.fill_diagonal(D, 0)
    for (a, b), w in zip(edges, lengths, strict=True):
        D[a, b] = D[b, a] = w
    for k in range(count):
        D = np.minimum(D, D[:, [k]] + D[k])
    return D[source]


def right_queue_without_order(edges, lengths, count, source):
    beside, d, waiting = _beside(edges, lengths, count), np.full(count, np.inf), [source]
    d[source] = 0
    while waiting:
        u = waiting.pop()
        for v, w in beside[u]:
            if d[u] + w < d[v]:
                d[v] = d[u] + w
                waiting.append(v)
    return d


def wrong_directed(edges, lengths, count, source):
    d = np.full(count, np.inf)
    d[source] = 0.0
    for _ in range(count):
        for (a, b), w in zip(edges, lengths, strict=True):
            d[b] = min(d[b], d[a] + w)
    return d


def wrong_breadth_first(edges, lengths, count, source):
    beside, d, queue = _beside(edges, lengths, count), np.full(count, np.inf), [source]
    d[source] = 0.0
    for u in queue:
        for v, w in beside[u]:
            if np.isinf(d[v]):
                d[v] = d[u] + w
                queue.append(v)
    return d


def wrong_counts(edges, lengths, count, source):
    return right_heap(edges, np.ones(len(edges)), count, source)


def wrong_zero_unreached(edges, lengths, count, source):
    d = right_heap(edges, lengths, count, source)
    d[np.isinf(d)] = 0
    return d


def wrong_minus_one(edges, lengths, count, source):
    return [w if np.isfinite(w) else -1.0 for w in right_heap(edges, lengths, count, source)]


def wrong_one_round(edges, lengths, count, source):
    d = np.full(count, np.inf)
    d[source] = 0.0
    for k in range(len(edges)):
        a, b = edges[k]
        d[b] = min(d[b], d[a] + lengths[k])
        d[a] = min(d[a], d[b] + lengths[k])
    return d


def wrong_prim(edges, lengths, count, source):
    beside, d, done, heap = (
        _beside(edges, lengths, count),
        [np.inf] * count,
        set(),
        [(0.0, source, 0.0)],
    )
    while heap:
        _, u, way = heapq.heappop(heap)
        if u not in done:
            done.add(u)
            d[u] = way
            for v, w in beside[u]:
                if v not in done:
                    heapq.heappush(heap, (w, v, way + w))
    return d


def wrong_all_reached_without_edges(edges, lengths, count, source):
    return np.zeros(count) if not len(edges) else right_heap(edges, lengths, count, source)


def wrong_source_must_have_an_edge(edges, lengths, count, source):
    if len(edges) and source not in edges:
        raise KeyError(source)
    return right_heap(edges, lengths, count, source)


def wrong_over_a_kilometre_is_out_of_reach(edges, lengths, count, source):
    d = right_heap(edges, lengths, count, source)
    return np.where(d > 1000, np.inf, d)


def wrong_rounded_to_a_micrometre(edges, lengths, count, source):
    return np.round(right_heap(edges, lengths, count, source), 6)


def right_relax_from_both_ends(edges, lengths, count, source):
    d = np.full(count, np.inf)
    d[source] = 0.0
    for _ in range(count):
        for i, j in (edges.T, edges[:, ::-1].T):
            np.minimum.at(d, j, d[i] + lengths)
    return d
