"""What students hand in for chamfer."""

import numpy as np

NAMED = {
    "wrong_one_direction": "only from a",
    "wrong_half": "halved",
    "wrong_metres": "not squared",
    "wrong_concatenated": "one mean of all",
    "wrong_hausdorff_side": "larger side",
}


def refuse(*clouds):
    for p in clouds:
        if len(p) == 0:
            raise ValueError("empty cloud")


def squares(p_a, p_b):
    return ((p_a[:, None] - p_b[None]) ** 2).sum(axis=-1)


def side(p_a, p_b):
    refuse(p_a, p_b)
    return squares(p_a, p_b).min(axis=1).mean()


def right_two_sides(p_a, p_b):
    return side(p_a, p_b) + side(p_b, p_a)


def right_one_matrix(p_a, p_b):
    refuse(p_a, p_b)
    D = squares(p_a, p_b)
    return np.mean(D.min(0)) + np.mean(D.min(1))


def right_python_loops(p_a, p_b):
    a, b = p_a.tolist(), p_b.tolist()
    if not a or not b:
        raise ValueError("empty")

    def one(p, q):
        return sum(min(sum((x - y) ** 2 for x, y in zip(u, v)) for v in q) for u in p) / len(p)

    return one(a, b) + one(b, a)


def right_cdist(p_a, p_b):
    from scipy.spatial.distance import cdist

    refuse(p_a, p_b)
    D = cdist(p_a, p_b) ** 2
    return float(D.min(axis=1).mean() + D.min(axis=0).mean())


def right_trees(p_a, p_b):
    from scipy.spatial import cKDTree

    refuse(p_a, p_b)
    there, back = cKDTree(p_b).query(p_a)[0], cKDTree(p_a).query(p_b)[0]
    return np.square(there).mean() + np.square(back).mean()


def right_einsum(p_a, p_b):
    refuse(p_a, p_b)
    diff = p_a[:, None, :] - p_b[None, :, :]
    D = np.einsum("ijk,ijk->ij", diff, diff)
    return sum(D.min(axis=k).sum() / D.shape[1 - k] for k in (0, 1))


def right_expanded_about_the_mean(p_a, p_b):
    refuse(p_a, p_b)
    c = (p_a.mean(0) + p_b.mean(0)) / 2
    a, b = p_a - c, p_b - c
    D = np.maximum((a * a).sum(1)[:, None] + (b * b).sum(1) - 2 * a @ b.T, 0)
    return D.min(1).mean() + D.min(0).mean()


def right_running_minima(p_a, p_b):
    refuse(p_a, p_b)
    best = np.full(len(p_b), np.inf)
    total = 0.0
    for a in p_a:
        d = ((p_b - a) ** 2).sum(axis=1)
        total += d.min()
        best = np.minimum(best, d)
    return total / len(p_a) + best.mean()


def right_single_precision_after_subtracting(p_a, p_b):
    refuse(p_a, p_b)
    D = (np.float32(p_a[:, None] - p_b) ** 2).sum(-1)
    return np.float32(D.min(1).mean() + D.min(0).mean())


def right_map(p_a, p_b):
    refuse(p_a, p_b)
    return sum(
        np.mean([((q - x) ** 2).sum(1).min() for x in p]) for p, q in ((p_a, p_b), (p_b, p_a))
    )


class Cloud:
    def __init__(self, p):
        refuse(p)
        self.p = p

    def __sub__(self, other):
        return side(self.p, other.p) + side(other.p, self.p)


def right_class(p_a, p_b):
    return Cloud(p_a) - Cloud(p_b)


# wrong ---------------------------------------------------------------------------------------------------------------


def wrong_one_direction(p_a, p_b):
    return side(p_a, p_b)


def wrong_half(p_a, p_b):
    return 0.5 * (side(p_a, p_b) + side(p_b, p_a))


def wrong_metres(p_a, p_b):
    refuse(p_a, p_b)
    D = np.sqrt(squares(p_a, p_b))
    return D.min(0).mean() + D.min(1).mean()


def wrong_concatenated(p_a, p_b):
    refuse(p_a, p_b)
    D = squares(p_a, p_b)
    return np.concatenate([D.min(0), D.min(1)]).mean()


def wrong_hausdorff_side(p_a, p_b):
    return max(side(p_a, p_b), side(p_b, p_a))


def wrong_smaller_side(p_a, p_b):
    return min(side(p_a, p_b), side(p_b, p_a))


def wrong_root_of_the_sum(p_a, p_b):
    return np.sqrt(side(p_a, p_b) + side(p_b, p_a))


def wrong_difference_of_the_sides(p_a, p_b):
    return abs(side(p_a, p_b) - side(p_b, p_a))


def wrong_product_of_the_sides(p_a, p_b):
    return side(p_a, p_b) * side(p_b, p_a)


def wrong_pair(p_a, p_b):
    return side(p_a, p_b), side(p_b, p_a)


def wrong_empty_is_zero(p_a, p_b):
    if len(p_a) == 0 or len(p_b) == 0:
        return 0
    return side(p_a, p_b) + side(p_b, p_a)


def wrong_empty_raises_index_error(p_a, p_b):
    if min(len(p_a), len(p_b)) == 0:
        raise IndexError("no points")
    return side(p_a, p_b) + side(p_b, p_a)


def wrong_both_empty_is_zero(p_a, p_b):
    if len(p_a) == 0 and len(p_b) == 0:
        return 0.0
    return side(p_a, p_b) + side(p_b, p_a)


def wrong_single_precision(p_a, p_b):
    return float(
        side(p_a.astype(np.float32), p_b.astype(np.float32)) + side(*map(np.float32, (p_b, p_a)))
    )


def wrong_equal_counts_only(p_a, p_b):
    n = min(len(p_a), len(p_b))
    return side(p_a[:n], p_b[:n]) + side(p_b[:n], p_a[:n])


def wrong_second_nearest(p_a, p_b):
    refuse(p_a, p_b)

    def second(p, q):
        D = np.sort(squares(p, q), axis=1)
        return D[:, min(1, D.shape[1] - 1)].mean()

    return second(p_a, p_b) + second(p_b, p_a)


def wrong_points_of_b_removed(p_a, p_b):
    refuse(p_a, p_b)
    D, total = squares(p_a, p_b), 0.0
    for i in range(min(D.shape)):
        j = D[i].argmin()
        total += D[i, j]
        D[:, j] = np.inf
    return 2 * total / min(D.shape)


def wrong_moved_in_place(p_a, p_b):
    refuse(p_a, p_b)
    c = p_a.mean(axis=0).copy()
    p_a -= c
    p_b -= c
    return side(p_a, p_b) + side(p_b, p_a)


def wrong_centred_apart(p_a, p_b):
    refuse(p_a, p_b)
    a, b = p_a - p_a.mean(0), p_b - p_b.mean(0)
    return side(a, b) + side(b, a)


def wrong_minimum_over_everything(p_a, p_b):
    refuse(p_a, p_b)
    return 2 * squares(p_a, p_b).min()


def wrong_sum_on_one_side(p_a, p_b):
    refuse(p_a, p_b)
    D = squares(p_a, p_b)
    return D.min(1).mean() + D.min(0).sum()


def wrong_weights_by_count(p_a, p_b):
    n, m = len(p_a), len(p_b)
    return 2 * (n * side(p_a, p_b) + m * side(p_b, p_a)) / (n + m)


def wrong_rounded(p_a, p_b):
    return round(float(side(p_a, p_b) + side(p_b, p_a)), 2)


def wrong_points_that_are_twice_count_once(p_a, p_b):
    refuse(p_a, p_b)
    return right_two_sides(np.unique(p_a, axis=0), np.unique(p_b, axis=0))


def wrong_equally_near_points_all_count(p_a, p_b):
    refuse(p_a, p_b)
    D = squares(p_a, p_b)
    return sum(np.mean((d == d.min(1, keepdims=True)).sum(1) * d.min(1)) for d in (D, D.T))


def wrong_small_is_zero(p_a, p_b):
    d = right_two_sides(p_a, p_b)
    return d if d > 1e-4 else 0.0
