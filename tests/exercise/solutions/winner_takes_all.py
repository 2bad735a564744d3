"""What students hand in for winner_takes_all."""

import numpy as np

NAMED = {
    "wrong_later_equal_wins": "last of several",
    "wrong_maximum": "highest wins",
    "wrong_lowest_values": "lowest cost",
}


def right_argmin(cost):
    return np.argmin(cost, axis=0)


def right_small_integers(cost):
    return cost.argmin(0).astype(np.uint8)


def right_sorted(cost):
    return np.argsort(cost, axis=0, kind="mergesort")[0]


def right_lexsort(cost):
    d = np.broadcast_to(np.arange(len(cost))[:, None, None], cost.shape)
    return np.take_along_axis(d, np.lexsort((d, cost), axis=0)[:1], axis=0)[0]


# wrong ---------------------------------------------------------------------------------------------------------------


def wrong_later_equal_wins(cost):
    best, where = cost[0].astype(float), np.zeros(cost.shape[1:], int)
    for d in range(1, len(cost)):
        lower = cost[d] <= best
        best[lower], where[lower] = cost[d][lower], d
    return where


def wrong_maximum(cost):
    return cost.argmax(axis=0)


def wrong_lowest_values(cost):
    return cost.min(0)


def wrong_minus_one_where_all_are_infinite(cost):
    out = np.argmin(cost, axis=0)
    out[np.isinf(cost).all(axis=0)] = -1
    return out


def wrong_error_where_all_are_infinite(cost):
    if np.isinf(cost).all(axis=0).any():
        raise ValueError("no candidate")
    return np.argmin(cost, axis=0)


def wrong_last_where_all_are_infinite(cost):
    out = np.argmin(cost, axis=0)
    return np.where(np.isinf(cost.min(axis=0)), len(cost) - 1, out)


def wrong_whole_numbers_without_sign(cost):
    return np.argmin(np.abs(cost) if cost.dtype.kind == "i" else cost, axis=0)


def wrong_later_equal_whole_number_wins(cost):
    if cost.dtype.kind in "iu":
        return len(cost) - 1 - np.argmin(cost[::-1], axis=0)
    return np.argmin(cost, axis=0)


def wrong_large_is_infinite(cost):
    return np.argmin(np.where(cost > 1e9, np.inf, cost.astype(float)), axis=0)


def wrong_infinite_single_slice(cost):
    out = np.argmin(cost, axis=0)
    return np.where(np.isinf(cost[0]), -1, out) if len(cost) == 1 else out
