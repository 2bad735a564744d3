"""What students hand in for knn_adjacency."""

import numpy as np

NAMED = {
    "wrong_argsort_with_itself": "loops that take a place",
    "wrong_argsort_with_itself_cleared": "itself counted",
    "wrong_not_symmetrised": "one way",
    "wrong_logical_and": "mutual",
    "wrong_sum_of_both": "added up",
    "wrong_mean_of_both": "averaged",
    "wrong_tree_first_column": "first column dropped",
    "wrong_distances_kept": "lengths",
    "wrong_identity_added": "loops kept",
}


def distances(p):
    return np.sqrt(((p[:, None, :] - p[None, :, :]) ** 2).sum(axis=-1))


def right_inf_diagonal(p, k):
    d = distances(p)
    np.fill_diagonal(d, np.inf)
    A = np.zeros(d.shape)
    A[np.arange(len(p))[:, None], np.argsort(d, axis=1)[:, :k]] = 1
    return np.maximum(A, A.T)


def right_argpartition(p, k):
    d = distances(p) ** 2 + np.diag(np.full(len(p), np.inf))
    A = np.zeros((len(p), len(p)))
    for i, row in enumerate(np.argpartition(d, k - 1, axis=1)[:, :k]):
        A[i, row] = A[row, i] = 1
    return A


def right_loops(p, k):
    n = len(p)
    A = np.zeros((n, n))
    for i in range(n):
        others = sorted(
            (j for j in range(n) if j != i), key=lambda j: float(np.sum((p[i] - p[j]) ** 2))
        )
        for j in others[:k]:
            A[i][j] = 1
            A[j][i] = 1
    return A


def right_tree_without_itself(p, k):
    from scipy.spatial import KDTree

    _, found = KDTree(p).query(p, k + 1)
    A = np.zeros((len(p), len(p)))
    for i, row in enumerate(found):
        for j in [j for j in row if j != i][:k]:
            A[i, j] = A[j, i] = 1.0
    return A


def right_booleans(p, k):
    d = distances(p)
    np.fill_diagonal(d, np.inf)
    near = d <= np.sort(d, axis=1)[:, k - 1][:, None]
    return near | near.T


def right_integers(p, k):
    return right_inf_diagonal(p, k).astype(int)


def right_logical_or(p, k):
    d = distances(p)
    d[np.diag_indices(len(p))] = d.max() + 1
    rank = d.argsort(axis=1).argsort(axis=1)
    return np.logical_or(rank < k, rank.T < k).astype(float)


def right_sign_of_sum(p, k):
    A = np.triu(right_loops(p, k))
    return np.sign(A + A.T)


def right_list_of_lists(p, k):
    return [[1.0 if one else 0.0 for one in row] for row in right_booleans(p, k)]


def right_sparse(p, k):
    from scipy.sparse import csr_array

    d = distances(p)
    np.fill_diagonal(d, np.inf)
    cols = np.argsort(d, axis=1)[:, :k].ravel()
    A = csr_array((np.ones(len(cols)), (np.repeat(np.arange(len(p)), k), cols)), shape=d.shape)
    return A.maximum(A.T).toarray()


def right_cdist(p, k):
    from scipy.spatial.distance import cdist

    d = cdist(p, p)
    d[np.eye(len(p), dtype=bool)] = np.inf
    A = np.zeros_like(d)
    np.put_along_axis(A, d.argsort(axis=1)[:, :k], 1, axis=1)
    return ((A + A.T) > 0) * 1.0


# wrong ---------------------------------------------------------------------------------------------------------------


def wrong_argsort_with_itself(p, k):
    A = np.zeros((len(p), len(p)))
    np.put_along_axis(A, np.argsort(distances(p), axis=1, kind="stable")[:, :k], 1, axis=1)
    return np.maximum(A, A.T)


def wrong_argsort_with_itself_cleared(p, k):
    A = wrong_argsort_with_itself(p, k)
    A[np.arange(len(p)), np.arange(len(p))] = 0
    return A


def wrong_not_symmetrised(p, k):
    d = distances(p)
    np.fill_diagonal(d, np.inf)
    A = np.zeros(d.shape)
    np.put_along_axis(A, np.argsort(d, axis=1)[:, :k], 1, axis=1)
    return A


def wrong_logical_and(p, k):
    A = wrong_not_symmetrised(p, k)
    return np.logical_and(A, A.T).astype(float)


def wrong_sum_of_both(p, k):
    A = wrong_not_symmetrised(p, k)
    return A + A.T


def wrong_mean_of_both(p, k):
    A = wrong_not_symmetrised(p, k)
    return 0.5 * (A + A.T)


def wrong_tree_first_column(p, k):
    order = np.argsort(distances(p), axis=1, kind="stable")[:, 1 : k + 1]
    A = np.zeros((len(p), len(p)))
    np.put_along_axis(A, order, 1, axis=1)
    return np.maximum(A, A.T)


def wrong_distances_kept(p, k):
    return right_inf_diagonal(p, k) * distances(p)


def wrong_identity_added(p, k):
    A = right_inf_diagonal(p, k) + np.eye(len(p))
    return np.minimum(A, 1)


def wrong_one_too_many(p, k):
    return right_inf_diagonal(p, min(k + 1, len(p) - 1))


def wrong_radius(p, k):
    d = distances(p)
    np.fill_diagonal(d, np.inf)
    radius = np.mean(np.sort(d, axis=1)[:, k - 1])
    return (d <= radius).astype(float)


def wrong_only_x(p, k):
    return right_inf_diagonal(p[:, :1], k)


def wrong_manhattan(p, k):
    d = np.abs(p[:, None] - p[None]).sum(axis=2)
    np.fill_diagonal(d, np.inf)
    near = d <= np.sort(d, axis=1)[:, k - 1 : k]
    return (near | near.T).astype(float)


def wrong_similarity(p, k):
    d = -(p @ p.T)
    np.fill_diagonal(d, np.inf)
    near = d <= np.sort(d, axis=1)[:, k - 1 : k]
    return (near | near.T).astype(float)


def wrong_indices_returned(p, k):
    d = distances(p)
    np.fill_diagonal(d, np.inf)
    return np.argsort(d, axis=1)[:, :k]


def wrong_columns_sorted(p, k):
    d = distances(p)
    np.fill_diagonal(d, np.inf)
    A = np.zeros(d.shape)
    A[np.argsort(d, axis=0)[:k], :] = 1
    return A


def wrong_lower_triangle_only(p, k):
    return np.tril(right_inf_diagonal(p, k))


def wrong_centres_in_place(p, k):
    p -= p.mean(axis=0)
    return right_inf_diagonal(p, k)


def wrong_no_edge_of_length_zero(p, k):
    A = right_inf_diagonal(p, k)
    return A if k == 1 else A * (distances(p) > 0)


def wrong_only_three_coordinates(p, k):
    return right_inf_diagonal(p[:, :3], k)


def wrong_rounded_to_a_tenth_of_a_millimetre(p, k):
    return right_inf_diagonal(np.round(p, 4), k)


def wrong_planes_at_least(p, k):
    if p.shape[1] < 2:
        raise ValueError("points in a plane or in space")
    return right_inf_diagonal(p, k)
