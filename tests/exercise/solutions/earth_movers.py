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


def right_tile(p_a, p_b):
    import math

    n, m = len(p_a), len(p_b)
    if n == 0 or m == 0:
        raise ValueError("no points")
    k = n * m // math.gcd(n, m)
    a, b = np.tile(p_a, (k // n, 1)), np.tile(p_b, (k // m, 1))
    D = distances(a, b)
    i, j = assigned(D)
    return float(D[i, j].sum()) / k


def right_index_arithmetic(p_a, p_b):
    refuse(p_a, p_b)
    n, m = len(p_a), len(p_b)
    k = int(np.lcm(n, m))
    D = distances(p_a, p_b)[np.arange(k)[:, None] * n // k, np.arange(k) * m // k]
    return np.average(D[assigned(D)])


def right_linear_programme(p_a, p_b):
    from scipy.optimize import linprog
    from scipy.sparse import eye_array, kron

    refuse(p_a, p_b)
    n, m = len(p_a), len(p_b)
    A = np.vstack(
        [
            kron(eye_array(n), np.ones((1, m))).toarray(),
            kron(np.ones((1, n)), eye_array(m)).toarray(),
        ]
    )
    b = np.concatenate([np.full(n, 1 / n), np.full(m, 1 / m)])
    return max(linprog(distances(p_a, p_b).ravel(), A_eq=A, b_eq=b, method="highs").fun, 0.0)


def right_hungarian_by_hand(p_a, p_b):
    a, b = spread(p_a, p_b)
    C, n = distances(a, b), len(a)
    u, v, match = np.zeros(n + 1), np.zeros(n + 1), np.zeros(n + 1, int)
    for i in range(1, n + 1):
        match[0], j0 = i, 0
        least, before, used = np.full(n + 1, np.inf), np.zeros(n + 1, int), np.zeros(n + 1, bool)
        while True:
            used[j0] = True
            i0 = match[j0]
            now = C[i0 - 1] - u[i0] - v[1:]
            better = ~used[1:] & (now < least[1:])
            least[1:][better], before[1:][better] = now[better], j0
            free = np.flatnonzero(~used)
            j1 = free[np.argmin(least[free])]
            delta = least[j1]
            u[match[used]] += delta
            v[used] -= delta
            least[~used] -= delta
            j0 = j1
            if match[j0] == 0:
                break
        while j0:
            match[j0] = match[before[j0]]
            j0 = before[j0]
    return float(sum(C[match[j] - 1, j - 1] for j in range(1, n + 1)) / n)


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


def right_loops_for_distances(p_a, p_b):
    a, b = spread(p_a, p_b)
    D = np.array([[float(np.sqrt(sum((x - y) ** 2))) for y in b] for x in a])
    return sum(D[i, j] for i, j in zip(*assigned(D))) / len(a)


def right_maximised_negative(p_a, p_b):
    from scipy.optimize import linear_sum_assignment

    D = distances(*spread(p_a, p_b))
    return D[linear_sum_assignment(-D, maximize=True)].mean()


class Mover:
    def __init__(self, p_a, p_b):
        self.cost = distances(*spread(p_a, p_b))

    def work(self):
        return self.cost[assigned(self.cost)].sum() / len(self.cost)


def right_class(p_a, p_b):
    return Mover(p_a, p_b).work()


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


def wrong_equal_counts_demanded(p_a, p_b):
    refuse(p_a, p_b)
    if len(p_a) != len(p_b):
        raise ValueError("unequal counts")
    return right_assignment(p_a, p_b)


def wrong_divided_by_the_smaller_count(p_a, p_b):
    refuse(p_a, p_b)
    D = distances(p_a, p_b)
    return D[assigned(D)].sum() / max(D.shape)


def wrong_padded_with_zeros(p_a, p_b):
    refuse(p_a, p_b)
    D = distances(p_a, p_b)
    k = max(D.shape)
    D = np.pad(D, ((0, k - D.shape[0]), (0, k - D.shape[1])))
    return D[assigned(D)].mean()


def wrong_shorter_cloud_repeated(p_a, p_b):
    refuse(p_a, p_b)
    k = max(len(p_a), len(p_b))
    D = distances(np.resize(p_a, (k, 3)), np.resize(p_b, (k, 3)))
    return D[assigned(D)].mean()


def wrong_empty_is_zero(p_a, p_b):
    return right_assignment(p_a, p_b) if len(p_a) and len(p_b) else 0.0


def wrong_empty_is_zero_division(p_a, p_b):
    k = np.lcm(len(p_a), len(p_b))
    D = distances(np.repeat(p_a, k // len(p_a), axis=0), np.repeat(p_b, k // len(p_b), axis=0))
    return D[assigned(D)].mean()


def wrong_rows_as_they_come(p_a, p_b):
    a, b = spread(p_a, p_b)
    return np.linalg.norm(a - b, axis=1).mean()


def wrong_sorted_by_norm(p_a, p_b):
    a, b = spread(p_a, p_b)
    a, b = (p[np.argsort(np.linalg.norm(p, axis=1))] for p in (a, b))
    return np.linalg.norm(a - b, axis=1).mean()


def wrong_each_axis_alone(p_a, p_b):
    a, b = spread(p_a, p_b)
    return np.linalg.norm(np.sort(a, axis=0) - np.sort(b, axis=0), axis=1).mean()


def wrong_manhattan(p_a, p_b):
    a, b = spread(p_a, p_b)
    D = np.abs(a[:, None] - b).sum(axis=2)
    return D[assigned(D)].mean()


def wrong_worst_matching(p_a, p_b):
    D = distances(*spread(p_a, p_b))
    return D[assigned(-D)].mean()


def wrong_longest_pair(p_a, p_b):
    D = distances(*spread(p_a, p_b))
    return D[assigned(D)].max()


def wrong_nearest_for_each(p_a, p_b):
    refuse(p_a, p_b)
    return distances(p_a, p_b).min(axis=1).mean()


def wrong_halved(p_a, p_b):
    return right_assignment(p_a, p_b) / 2


def wrong_matching_returned(p_a, p_b):
    D = distances(*spread(p_a, p_b))
    return assigned(D)[1]


def wrong_single_precision(p_a, p_b):
    D = distances(*spread(p_a.astype(np.float32), p_b.astype(np.float32)))
    return float(D[assigned(D)].mean())


def wrong_in_place(p_a, p_b):
    refuse(p_a, p_b)
    c = p_b.mean(axis=0).copy()
    p_a -= c
    p_b -= c
    return right_assignment(p_a, p_b)


def wrong_swaps_until_stuck(p_a, p_b):
    a, b = spread(p_a, p_b)
    D, j = distances(a, b), np.arange(len(a))
    for k in range(len(a) - 1):
        if D[k, j[k + 1]] + D[k + 1, j[k]] < D[k, j[k]] + D[k + 1, j[k + 1]]:
            j[k], j[k + 1] = j[k + 1], j[k]
    return D[np.arange(len(a)), j].mean()


def wrong_public_answers(p_a, p_b):
    return {2: 0.9, 3: 0.5}.get(len(p_b), 0.5)


def wrong_larger_first_is_cut(p_a, p_b):
    return right_assignment(p_a[: len(p_b)] if len(p_b) else p_a, p_b)


def wrong_points_that_are_twice_count_once(p_a, p_b):
    return right_assignment(np.unique(p_a, axis=0), p_b)


def wrong_counts_without_a_common_factor_cut(p_a, p_b):
    n, m = len(p_a), len(p_b)
    k = min(n, m) if min(n, m) > 4 and np.gcd(n, m) == 1 else None
    return right_assignment(p_a[:k], p_b[:k])
