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


def right_broadcast(adjacency, features, weights):
    A = adjacency + np.eye(len(adjacency))
    s = 1 / np.sqrt(A.sum(1))
    return np.maximum(s[:, None] * (A @ (s[:, None] * features)) @ weights, 0)


def right_outer(adjacency, features, weights):
    A = adjacency + np.identity(len(adjacency))
    d = A.sum(axis=0)
    return np.clip((A / np.sqrt(np.outer(d, d))) @ features @ weights, 0, None)


def right_einsum(adjacency, features, weights):
    A = adjacency + np.eye(len(adjacency))
    s = A.sum(1) ** -0.5
    return np.maximum(np.einsum("i,ij,j,jk,kl->il", s, A, s, features, weights), 0)


def right_solved(adjacency, features, weights):
    A = adjacency + np.eye(len(adjacency))
    root = np.sqrt(np.diag(A.sum(axis=1)))
    H = np.linalg.solve(root, A @ np.linalg.solve(root, features @ weights))
    return (np.abs(H) + H) / 2


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


def wrong_in_place(adjacency, features, weights):
    adjacency += np.eye(len(adjacency))
    s = adjacency.sum(axis=1) ** -0.5
    return np.maximum((s[:, None] * adjacency * s) @ features @ weights, 0)


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
