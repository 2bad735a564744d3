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


def right_pixel_loops(cost):
    D, h, w = cost.shape
    out = np.zeros((h, w), dtype=int)
    for y in range(h):
        for x in range(w):
            best = 0
            for d in range(1, D):
                if cost[d, y, x] < cost[best, y, x]:
                    best = d
            out[y, x] = best
    return out


def right_nested_lists(cost):
    D, h, w = cost.shape
    return [[min(range(D), key=lambda d: cost[d, y, x]) for x in range(w)] for y in range(h)]


def right_reduce_slices(cost):
    best, where = cost[0].astype(float), np.zeros(cost.shape[1:], np.int64)
    for d in range(1, len(cost)):
        lower = cost[d] < best
        best = np.where(lower, cost[d], best)
        where = np.where(lower, d, where)
    return where


def right_first_equal_to_the_minimum(cost):
    return (cost == cost.min(axis=0)).argmax(axis=0)


def right_sorted(cost):
    return np.argsort(cost, axis=0, kind="mergesort")[0]


def right_moved_axis(cost):
    return (
        np.moveaxis(cost, 0, -1).reshape(-1, cost.shape[0]).argmin(axis=1).reshape(cost.shape[1:])
    )


def right_apply_along_axis(cost):
    return np.apply_along_axis(np.argmin, 0, cost)


def right_recursive(cost):
    if len(cost) == 1:
        return np.zeros(cost.shape[1:], dtype=np.int32)
    m = len(cost) // 2
    a, b = right_recursive(cost[:m]), right_recursive(cost[m:])
    lowest_a, lowest_b = cost[:m].min(axis=0), cost[m:].min(axis=0)
    return np.where(lowest_b < lowest_a, b + m, a)


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


def wrong_float_disparities(cost):
    return np.argmin(cost, axis=0).astype(float)


def wrong_transposed(cost):
    return np.argmin(cost, axis=0).T


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


def wrong_starts_from_999(cost):
    best, where = np.full(cost.shape[1:], 999.0), np.zeros(cost.shape[1:], int)
    for d in range(len(cost)):
        lower = cost[d] < best
        best[lower], where[lower] = cost[d][lower], d
    return where


def wrong_starts_from_zero(cost):
    best, where = np.zeros(cost.shape[1:]), np.zeros(cost.shape[1:], int)
    for d in range(len(cost)):
        lower = cost[d] < best
        best[lower], where[lower] = cost[d][lower], d
    return where


def wrong_infinite_replaced_in_place(cost):
    if cost.dtype.kind == "f":
        cost[np.isinf(cost)] = 1e12
    return np.argmin(cost, axis=0)


def wrong_absolute_cost(cost):
    return np.argmin(np.abs(cost.astype(float)), axis=0)


def wrong_bytes(cost):
    with np.errstate(invalid="ignore"):
        return np.argmin(np.clip(cost, 0, 255).astype(np.uint8), axis=0)


def wrong_last_slice_not_looked_at(cost):
    return np.argmin(cost[:-1], axis=0) if len(cost) > 1 else np.zeros(cost.shape[1:], int)


def wrong_two_lowest_averaged(cost):
    order = np.argsort(cost, axis=0, kind="stable")
    return (order[0] + order[min(1, len(cost) - 1)]) // 2


def wrong_one_per_row(cost):
    return np.broadcast_to(np.argmin(cost.sum(axis=2), axis=0)[:, None], cost.shape[1:])


def wrong_smoothed_first(cost):
    from scipy.ndimage import uniform_filter1d

    finite = np.where(np.isinf(cost), 1e6, cost.astype(float))
    return np.argmin(uniform_filter1d(finite, 3, axis=0), axis=0)


def wrong_one_hot(cost):
    return (cost == cost.min(axis=0)).astype(int)


def wrong_middle_axis(cost):
    return np.argmin(cost, axis=1)


def wrong_cost_and_disparity(cost):
    return np.argmin(cost, axis=0), np.min(cost, axis=0)


def wrong_rounded_costs(cost):
    return np.argmin(np.round(cost.astype(float), -1), axis=0)


def wrong_cubes_only(cost):
    n = min(cost.shape)
    return np.argmin(cost[:n, :n, :n], axis=0)


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
