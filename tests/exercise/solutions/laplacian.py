"""What students hand in for laplacian."""

import numpy as np

NAMED = {
    "wrong_a_minus_d": "sign",
    "wrong_count_nonzero": "neighbours counted",
    "wrong_plus": "signless",
    "wrong_random_walk_with_guard": "divided by degrees",
    "wrong_networkx_normalised": "normalised",
    "wrong_binary": "weights ignored",
    "wrong_just_the_degrees": "degrees alone",
}


def right_diag_minus(adjacency):
    return np.diag(adjacency.sum(axis=1)) - adjacency


def right_eye_times(adjacency):
    degrees = adjacency @ np.ones(len(adjacency))
    return np.eye(len(adjacency)) * degrees - adjacency


def right_einsum(adjacency):
    return np.einsum("ij,ik->ij", np.eye(len(adjacency)), adjacency) - adjacency


def right_sparse_back_to_dense(adjacency):
    from scipy.sparse import csr_array, diags_array

    A = csr_array(adjacency)
    return (diags_array(np.asarray(A.sum(axis=1)).ravel()) - A).toarray()


# wrong ---------------------------------------------------------------------------------------------------------------


def wrong_a_minus_d(adjacency):
    return adjacency - np.diag(adjacency.sum(axis=1))


def wrong_count_nonzero(adjacency):
    return np.diag(np.count_nonzero(adjacency, axis=1)) - adjacency


def wrong_plus(adjacency):
    return np.diag(adjacency.sum(axis=0)) + adjacency


def wrong_random_walk_with_guard(adjacency):
    L = np.diag(adjacency.sum(axis=1)) - adjacency
    d = np.diag(L).copy()
    d[d == 0] = 1
    return L / d[:, None]


def wrong_networkx_normalised(adjacency):
    d = adjacency.sum(axis=1)
    inverse = np.zeros_like(d)
    inverse[d > 0] = d[d > 0] ** -0.5
    return np.diag(inverse) @ (np.diag(d) - adjacency) @ np.diag(inverse)


def wrong_binary(adjacency):
    A = (adjacency != 0).astype(float)
    return np.diag(A.sum(axis=1)) - A


def wrong_just_the_degrees(adjacency):
    return np.diag(adjacency.sum(axis=1))


def wrong_in_place(adjacency):
    d = adjacency.sum(axis=1)
    adjacency *= -1
    np.fill_diagonal(adjacency, d)
    return adjacency


def wrong_weak_edges_are_none(adjacency):
    return right_diag_minus(np.where(adjacency > 1e-4, adjacency, 0))


def wrong_weights_up_to_a_thousand(adjacency):
    return right_diag_minus(np.minimum(adjacency, 1000))


def wrong_identity_without_edges(adjacency):
    return (
        right_diag_minus(adjacency)
        if adjacency.any() or len(adjacency) == 1
        else np.eye(len(adjacency))
    )
