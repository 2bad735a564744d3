"""What students hand in for chamfer_gradient."""

import numpy as np

NAMED = {
    "wrong_only_forward": "one sided",
    "wrong_only_backward": "only back",
    "wrong_fancy_index_add": "duplicates lost",
    "wrong_descent_direction": "sign reversed",
    "wrong_no_two": "without the two",
    "wrong_sums": "sums for means",
    "wrong_n_for_both": "both by the first count",
    "wrong_unit_vectors": "of distances",
    "wrong_lengths_exchanged": "counts swapped",
}


def _sq(p, q):
    return ((p[:, None, :] - q[None, :, :]) ** 2).sum(-1)


def _sides(p, q):
    D = _sq(p, q)
    i, j = D.argmin(1), D.argmin(0)
    back = np.zeros_like(p)
    np.add.at(back, j, p[j] - q)
    return p - q[i], back


def right_add_at(p, q):
    there, back = _sides(p, q)
    return 2 * there / len(p) + 2 * back / len(q)


def right_loops(p, q):
    g = np.zeros((len(p), 3))
    for k in range(len(p)):
        d = np.linalg.norm(q - p[k], axis=1)
        g[k] += 2.0 / len(p) * (p[k] - q[np.argmin(d)])
    for k in range(len(q)):
        d = np.linalg.norm(p - q[k], axis=1)
        g[np.argmin(d)] += 2.0 / len(q) * (p[np.argmin(d)] - q[k])
    return g


def right_bincount(p, q):
    D = _sq(p, q)
    j = D.argmin(axis=0)
    v = 2 * (p[j] - q) / len(q)
    back = np.array([np.bincount(j, v[:, c], len(p)) for c in range(3)]).T
    return 2 * (p - q[D.argmin(axis=1)]) / len(p) + back


def right_counts_and_sums(p, q):
    """Each p times how often it is nearest, minus the sum of those q."""
    D = _sq(p, q)
    B = (D.argmin(0)[:, None] == np.arange(len(p))).astype(float)
    return 2 * (p - q[D.argmin(1)]) / len(p) + 2 * (B.sum(0)[:, None] * p - B.T @ q) / len(q)


def right_kd_trees(p, q):
    from scipy.spatial import cKDTree

    i, j = cKDTree(q).query(p)[1], cKDTree(p).query(q)[1]
    g = 2 * (p - q[i]) / p.shape[0]
    np.subtract.at(g, j, 2 * (q - p[j]) / q.shape[0])
    return g


def right_cdist(p, q):
    from scipy.spatial.distance import cdist

    D = cdist(p, q, "sqeuclidean")
    g = (p - q[np.argmin(D, axis=1)]) * (2 / len(p))
    for k, i in enumerate(np.argmin(D, axis=0)):
        g[i] += (p[i] - q[k]) * (2 / len(q))
    return g


def right_group_by_group(p, q):
    D = _sq(p, q)
    nearest_p = D.argmin(0)
    rows = []
    for i in range(len(p)):
        mine = q[nearest_p == i]
        rows.append(
            2 / len(p) * (p[i] - q[D[i].argmin()])
            + 2 / len(q) * (len(mine) * p[i] - mine.sum(axis=0))
        )
    return np.array(rows)


def right_sparse(p, q):
    from scipy.sparse import coo_array

    D, n, m = _sq(p, q), len(p), len(q)
    there = coo_array((np.ones(n), (np.arange(n), D.argmin(1))), shape=(n, m)).tocsr()
    back = coo_array((np.ones(m), (D.argmin(0), np.arange(m))), shape=(n, m)).tocsr()
    W = 2 * (there / n + back / m)
    return W.sum(axis=1).reshape(-1, 1) * p - W @ q


def right_two_functions(p, q):
    def to_nearest(a, b):
        return np.array([b[((b - x) ** 2).sum(1).argmin()] for x in a])

    def index_of_nearest(a, b):
        return [int(((b - x) ** 2).sum(1).argmin()) for x in a]

    g = (p - to_nearest(p, q)) / len(p)
    for x, i in zip(q, index_of_nearest(q, p)):
        g[i] = g[i] + (p[i] - x) / len(q)
    return 2 * g


def right_swapped_axes(p, q):
    v = q.T[:, None, :] - p.T[:, :, None]
    D = np.einsum("xij,xij->ij", v, v)
    mask = np.zeros(D.shape)
    mask[np.arange(D.shape[0]), D.argmin(1)] += 1 / D.shape[0]
    mask[D.argmin(0), np.arange(D.shape[1])] += 1 / D.shape[1]
    return -2 * np.einsum("ij,xij->ix", mask, v)


def wrong_only_forward(p, q):
    return 2 * _sides(p, q)[0] / len(p)


def wrong_only_backward(p, q):
    return 2 * _sides(p, q)[1] / len(q)


def wrong_fancy_index_add(p, q):
    D = _sq(p, q)
    g = 2 * (p - q[D.argmin(1)]) / len(p)
    j = D.argmin(0)
    g[j] += 2 * (p[j] - q) / len(q)
    return g


def wrong_descent_direction(p, q):
    return -right_add_at(p, q)


def wrong_no_two(p, q):
    there, back = _sides(p, q)
    return there / len(p) + back / len(q)


def wrong_sums(p, q):
    there, back = _sides(p, q)
    return 2 * there + 2 * back


def wrong_n_for_both(p, q):
    there, back = _sides(p, q)
    return 2 * (there + back) / len(p)


def wrong_lengths_exchanged(p, q):
    there, back = _sides(p, q)
    return 2 * there / len(q) + 2 * back / len(p)


def wrong_unit_vectors(p, q):
    D = _sq(p, q)
    i, j = D.argmin(1), D.argmin(0)
    v, w = p - q[i], p[j] - q
    v = v / np.maximum(np.linalg.norm(v, axis=1)[:, None], 1e-12) / len(p)
    w = w / np.maximum(np.linalg.norm(w, axis=1)[:, None], 1e-12) / len(q)
    np.add.at(v, j, w)
    return v


def wrong_same_rows(p, q):
    return 2 * (p - q[np.arange(len(p)) % len(q)]) / len(p)


def wrong_mean_of_both_sides(p, q):
    there, back = _sides(p, q)
    return 2 * (there + back) / (len(p) + len(q))


def wrong_to_the_centroid(p, q):
    return 2 * (p - q.mean(0)) / len(p)


def wrong_farthest(p, q):
    return 2 * (p - q[_sq(p, q).argmax(1)]) / len(p)


def wrong_backward_reversed(p, q):
    there, back = _sides(p, q)
    return 2 * there / len(p) - 2 * back / len(q)


def wrong_all_pairs(p, q):
    return 4 * (p[:, None] - q[None]).mean(1)


def wrong_mean_of_pullers(p, q):
    D = _sq(p, q)
    j = D.argmin(0)
    g = 2 * (p - q[D.argmin(1)]) / len(p)
    for k in np.unique(j):
        g[k] += 2 * (p[k] - q[j == k].mean(0)) / len(q)
    return g


def wrong_per_coordinate_mean(p, q):
    return right_add_at(p, q) / 3


def wrong_in_place(p, q):
    D = _sq(p, q)
    g = right_add_at(p, q)
    p -= q[D.argmin(1)]
    return g
