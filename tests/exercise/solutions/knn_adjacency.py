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


def right_tree_without_itself(p, k):
    from scipy.spatial import KDTree

    _, found = KDTree(p).query(p, k + 1)
    A = np.zeros((len(p), len(p)))
    for i, row in enumerate(found):
        for j in [j for j in row if j != i][:k]:
            A[i, j] = A[j, i] = 1.0
    return A


def right_integers(p, k):
    return right_inf_diagonal(p, k).astype(int)


def right_logical_or(p, k):
    d = distances(p)
    d[np.diag_indices(len(p))] = d.max() + 1
    rank = d.argsort(axis=1).argsort(axis=1)
    return np.logical_or(rank < k, rank.T < k).astype(float)


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
