"""What students hand in for earth_movers."""

import numpy as np

NAMED = {
    "wrong_rows_as_they_come": "paired by row",
    "wrong_nearest_for_each": "nearest neighbours",
    "wrong_rectangular": "points left out",
    "wrong_total": "sum for mean",
    "wrong_squares_assigned": "squares",
    "wrong_greedy": "greedy by row",
}


def refuse(*clouds):
    if not all(len(p) for p in clouds):
        raise ValueError("empty cloud")


def distances(p_a, p_b):
    return np.linalg.norm(p_a[:, None] - p_b[None], axis=2)


def spread(p_a, p_b):
    refuse(p_a, p_b)
    k = np.lcm(len(p_a), len(p_b))
    return np.repeat(p_a, k // len(p_a), axis=0), np.repeat(p_b, k // len(p_b), axis=0)


def assigned(D):
    from scipy.optimize import linear_sum_assignment

    return linear_sum_assignment(D)


def right_assignment(p_a, p_b):
    D = distances(*spread(p_a, p_b))
    return D[assigned(D)].mean()


def right_index_arithmetic(p_a, p_b):
    refuse(p_a, p_b)
    n, m = len(p_a), len(p_b)
    k = int(np.lcm(n, m))
    D = distances(p_a, p_b)[np.arange(k)[:, None] * n // k, np.arange(k) * m // k]
    return np.average(D[assigned(D)])


def right_cdist(p_a, p_b):
    from scipy.spatial.distance import cdist

    a, b = spread(p_a, p_b)
    D = cdist(a, b)
    i, j = assigned(D)
    return np.mean(D[i, j])


def right_larger_first(p_a, p_b):
    if len(p_a) > len(p_b):
        return right_larger_first(p_b, p_a)
    return right_assignment(p_a, p_b)


# wrong ---------------------------------------------------------------------------------------------------------------


def wrong_rectangular(p_a, p_b):
    refuse(p_a, p_b)
    D = distances(p_a, p_b)
    return D[assigned(D)].mean()


def wrong_total(p_a, p_b):
    return len(p_a) * right_assignment(p_a, p_b)


def wrong_squares_assigned(p_a, p_b):
    D = distances(*spread(p_a, p_b)) ** 2
    return D[assigned(D)].mean()


def wrong_greedy(p_a, p_b):
    D = distances(*spread(p_a, p_b))
    total = 0.0
    for i in range(len(D)):
        j = D[i].argmin()
        total += D[i, j]
        D[:, j] = np.inf
    return total / len(D)


def wrong_empty_is_zero(p_a, p_b):
    return right_assignment(p_a, p_b) if len(p_a) and len(p_b) else 0.0


def wrong_empty_is_zero_division(p_a, p_b):
    k = np.lcm(len(p_a), len(p_b))
    D = distances(np.repeat(p_a, k // len(p_a), axis=0), np.repeat(p_b, k // len(p_b), axis=0))
    return D[assigned(D)].mean()


def wrong_rows_as_they_come(p_a, p_b):
    a, b = spread(p_a, p_b)
    return np.linalg.norm(a - b, axis=1).mean()


def wrong_nearest_for_each(p_a, p_b):
    refuse(p_a, p_b)
    return distances(p_a, p_b).min(axis=1).mean()


def wrong_single_precision(p_a, p_b):
    D = distances(*spread(p_a.astype(np.float32), p_b.astype(np.float32)))
    return float(D[assigned(D)].mean())


def wrong_in_place(p_a, p_b):
    refuse(p_a, p_b)
    c = p_b.mean(axis=0).copy()
    p_a -= c
    p_b -= c
    return right_assignment(p_a, p_b)


def wrong_larger_first_is_cut(p_a, p_b):
    return right_assignment(p_a[: len(p_b)] if len(p_b) else p_a, p_b)


def wrong_points_that_are_twice_count_once(p_a, p_b):
    return right_assignment(np.unique(p_a, axis=0), p_b)


def wrong_counts_without_a_common_factor_cut(p_a, p_b):
    n, m = len(p_a), len(p_b)
    k = min(n, m) if min(n, m) > 4 and np.gcd(n, m) == 1 else None
    return right_assignment(p_a[:k], p_b[:k])
