"""What students hand in for gcn_layer."""

import numpy as np

NAMED = {
    "wrong_no_loops": "no self loops",
    "wrong_mean_aggregation": "row mean",
    "wrong_linear": "no relu",
    "wrong_degrees_before_loops": "degrees without loops",
    "wrong_plain_sum": "not normalised",
    "wrong_no_roots": "whole degrees",
    "wrong_relu_first": "relu too early",
    "wrong_counts": "neighbours counted",
}


def right_as_written(adjacency, features, weights):
    A = adjacency + np.eye(adjacency.shape[0])
    D = np.diag(A.sum(axis=1) ** -0.5)
    return np.maximum(0, D @ A @ D @ features @ weights)


def right_broadcast(adjacency, features, weights):
    A = adjacency + np.eye(len(adjacency))
    s = 1 / np.sqrt(A.sum(1))
    return np.maximum(s[:, None] * (A @ (s[:, None] * features)) @ weights, 0)


def right_outer(adjacency, features, weights):
    A = adjacency + np.identity(len(adjacency))
    d = A.sum(axis=0)
    return np.clip((A / np.sqrt(np.outer(d, d))) @ features @ weights, 0, None)


def right_where(adjacency, features, weights):
    A = adjacency + np.eye(len(adjacency))
    d = A.sum(axis=1)
    H = (A / np.sqrt(d[:, None]) / np.sqrt(d[None, :])) @ (features @ weights)
    return np.where(H > 0, H, 0.0)


def right_loops(adjacency, features, weights):
    n = len(adjacency)
    d = [1 + sum(adjacency[i]) for i in range(n)]
    out = np.zeros((n, weights.shape[1]))
    for i in range(n):
        total = features[i] / d[i]
        for j in range(n):
            if adjacency[i, j] != 0:
                total = total + adjacency[i, j] * features[j] / (d[i] * d[j]) ** 0.5
        out[i] = total @ weights
    return np.maximum(out, 0)


def right_inverse_root(adjacency, features, weights):
    A = adjacency + np.eye(len(adjacency))
    root = np.linalg.inv(np.sqrt(np.diag(A.sum(axis=1))))
    H = root @ A @ root @ features @ weights
    H[H < 0] = 0
    return H


def right_sparse(adjacency, features, weights):
    from scipy.sparse import csr_array, diags_array, eye_array

    A = csr_array(adjacency) + eye_array(len(adjacency))
    s = diags_array(1 / np.sqrt(np.asarray(A.sum(axis=1)).ravel()))
    return np.maximum(np.asarray(s @ A @ s @ features @ weights), 0.0)


def right_einsum(adjacency, features, weights):
    A = adjacency + np.eye(len(adjacency))
    s = A.sum(1) ** -0.5
    return np.maximum(np.einsum("i,ij,j,jk,kl->il", s, A, s, features, weights), 0)


def right_solved(adjacency, features, weights):
    A = adjacency + np.eye(len(adjacency))
    root = np.sqrt(np.diag(A.sum(axis=1)))
    H = np.linalg.solve(root, A @ np.linalg.solve(root, features @ weights))
    return (np.abs(H) + H) / 2


def right_lists(adjacency, features, weights):
    return right_as_written(adjacency, features, weights).tolist()


class Layer:
    def __init__(self, weights):
        self.weights = weights

    def __call__(self, adjacency, x):
        A = adjacency + np.eye(len(x))
        s = np.power(A.sum(axis=-1), -0.5)
        return np.maximum((s[:, None] * A * s[None]) @ x @ self.weights, 0)


def right_class(adjacency, features, weights):
    return Layer(weights)(adjacency, features)


# wrong ---------------------------------------------------------------------------------------------------------------


def wrong_no_loops(adjacency, features, weights):
    s = adjacency.sum(axis=1) ** -0.5
    return np.maximum((s[:, None] * adjacency * s) @ features @ weights, 0)


def wrong_mean_aggregation(adjacency, features, weights):
    A = adjacency + np.eye(len(adjacency))
    return np.maximum((A @ features) / A.sum(axis=1)[:, None] @ weights, 0)


def wrong_linear(adjacency, features, weights):
    A = adjacency + np.eye(len(adjacency))
    s = A.sum(axis=1) ** -0.5
    return (s[:, None] * A * s) @ features @ weights


def wrong_degrees_before_loops(adjacency, features, weights):
    d = adjacency.sum(axis=1)
    A = adjacency + np.eye(len(adjacency))
    return np.maximum(A / np.sqrt(np.outer(d, d)) @ features @ weights, 0)


def wrong_plain_sum(adjacency, features, weights):
    return np.maximum((adjacency + np.eye(len(adjacency))) @ features @ weights, 0)


def wrong_no_roots(adjacency, features, weights):
    A = adjacency + np.eye(len(adjacency))
    D = np.linalg.inv(np.diag(A.sum(axis=1)))
    return np.maximum(D @ A @ D @ features @ weights, 0)


def wrong_relu_first(adjacency, features, weights):
    A = adjacency + np.eye(len(adjacency))
    s = A.sum(axis=1) ** -0.5
    return np.maximum((s[:, None] * A * s) @ features, 0) @ weights


def wrong_counts(adjacency, features, weights):
    A = adjacency + np.eye(len(adjacency))
    s = np.count_nonzero(A, axis=1) ** -0.5
    return np.maximum((s[:, None] * A * s) @ features @ weights, 0)


def wrong_column_mean(adjacency, features, weights):
    A = adjacency + np.eye(len(adjacency))
    return np.maximum(A / A.sum(axis=0) @ features @ weights, 0)


def wrong_laplacian(adjacency, features, weights):
    d = adjacency.sum(axis=1)
    d[d == 0] = 1
    L = np.eye(len(adjacency)) - adjacency / np.sqrt(np.outer(d, d))
    return np.maximum(L @ features @ weights, 0)


def wrong_loops_twice(adjacency, features, weights):
    A = adjacency + 2 * np.eye(len(adjacency))
    s = A.sum(axis=1) ** -0.5
    return np.maximum((s[:, None] * A * s) @ features @ weights, 0)


def wrong_minus_half_of_the_matrix(adjacency, features, weights):
    A = adjacency + np.eye(len(adjacency))
    D = np.diag(A.sum(axis=1))
    with np.errstate(divide="ignore", invalid="ignore"):
        root = D**-0.5
    return np.maximum(root @ A @ root @ features @ weights, 0)


def wrong_left_side_only(adjacency, features, weights):
    A = adjacency + np.eye(len(adjacency))
    s = A.sum(axis=1) ** -0.5
    return np.maximum((s[:, None] * A) @ features @ weights, 0)


def wrong_leaky(adjacency, features, weights):
    A = adjacency + np.eye(len(adjacency))
    s = A.sum(axis=1) ** -0.5
    H = (s[:, None] * A * s) @ features @ weights
    return np.where(H > 0, H, 0.01 * H)


def wrong_sigmoid(adjacency, features, weights):
    A = adjacency + np.eye(len(adjacency))
    s = A.sum(axis=1) ** -0.5
    return 1 / (1 + np.exp(-(s[:, None] * A * s) @ features @ weights))


def wrong_absolute(adjacency, features, weights):
    A = adjacency + np.eye(len(adjacency))
    s = A.sum(axis=1) ** -0.5
    return np.abs((s[:, None] * A * s) @ features @ weights)


def wrong_no_neighbours(adjacency, features, weights):
    return np.maximum(features @ weights, 0)


def wrong_in_place(adjacency, features, weights):
    adjacency += np.eye(len(adjacency))
    s = adjacency.sum(axis=1) ** -0.5
    return np.maximum((s[:, None] * adjacency * s) @ features @ weights, 0)


def wrong_weights_transposed(adjacency, features, weights):
    A = adjacency + np.eye(len(adjacency))
    s = A.sum(axis=1) ** -0.5
    return np.maximum((s[:, None] * A * s) @ features @ weights.T, 0)


def wrong_one_node_has_nothing(adjacency, features, weights):
    return (
        right_broadcast(adjacency, features, weights)
        if len(adjacency) > 1
        else np.zeros((1, weights.shape[1]))
    )


def wrong_weak_edges_are_none(adjacency, features, weights):
    return right_broadcast(np.where(adjacency > 0.05, adjacency, 0), features, weights)


def wrong_weights_up_to_ten(adjacency, features, weights):
    return right_broadcast(np.minimum(adjacency, 10), features, weights)
