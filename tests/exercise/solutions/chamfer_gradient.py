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


def wrong_in_place(p, q):
    D = _sq(p, q)
    g = right_add_at(p, q)
    p -= q[D.argmin(1)]
    return g
