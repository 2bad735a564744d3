"""What students hand in for one_sided."""

import numpy as np

NAMED = {
    "wrong_axis": "other side",
    "wrong_distances": "not squared",
    "wrong_total": "sum for mean",
    "wrong_both_added_and_empty_is_zero": "both sides",
    "wrong_mean_of_the_difference_array": "mean over coordinates",
}


def refuse(*clouds):
    if any(len(p) == 0 for p in clouds):
        raise ValueError("a cloud is empty")


def squares(p_a, p_b):
    return ((p_a[:, None] - p_b[None]) ** 2).sum(axis=-1)


def right_matrix(p_a, p_b):
    refuse(p_a, p_b)
    return squares(p_a, p_b).min(axis=1).mean()


def right_python_loops(p_a, p_b):
    if len(p_a) == 0 or len(p_b) == 0:
        raise ValueError
    total = 0.0
    for a in p_a.tolist():
        total += min(sum((x - y) ** 2 for x, y in zip(a, b)) for b in p_b.tolist())
    return total / len(p_a)


def right_cdist(p_a, p_b):
    from scipy.spatial.distance import cdist

    refuse(p_a, p_b)
    return float(np.mean(cdist(p_a, p_b, "sqeuclidean").min(axis=1)))


def right_tree(p_a, p_b):
    from scipy.spatial import KDTree

    refuse(p_a, p_b)
    d, _ = KDTree(p_b).query(p_a)
    return d @ d / len(d)


def right_einsum(p_a, p_b):
    refuse(p_a, p_b)
    diff = p_a[:, np.newaxis, :] - p_b
    return np.einsum("ijk,ijk->ij", diff, diff).min(1).sum() / p_a.shape[0]


def right_expanded_about_the_mean(p_a, p_b):
    refuse(p_a, p_b)
    c = p_b.mean(axis=0)
    a, b = p_a - c, p_b - c
    D = (a**2).sum(1)[:, None] + (b**2).sum(1) - 2 * a @ b.T
    j = D.argmin(axis=1)
    return np.sum((p_a - p_b[j]) ** 2) / len(p_a)


def right_in_blocks(p_a, p_b):
    refuse(p_a, p_b)
    best = np.full(len(p_a), np.inf)
    for k in range(0, len(p_b), 7):
        best = np.minimum(best, squares(p_a, p_b[k : k + 7]).min(axis=1))
    return np.average(best)


def right_norms_squared_again(p_a, p_b):
    refuse(p_a, p_b)
    return (np.linalg.norm(p_a[:, None] - p_b, axis=2).min(axis=1) ** 2).mean()


def right_recursive_minimum(p_a, p_b):
    refuse(p_a, p_b)

    def nearest(a, b):
        if len(b) == 1:
            return ((a - b[0]) ** 2).sum(axis=1)
        return np.minimum(nearest(a, b[: len(b) // 2]), nearest(a, b[len(b) // 2 :]))

    return nearest(p_a, p_b).mean()


def right_single_precision_after_subtracting(p_a, p_b):
    refuse(p_a, p_b)
    return np.float32((np.float32(p_a[:, None] - p_b) ** 2).sum(-1).min(1).mean())


class Cloud:
    def __init__(self, p):
        refuse(p)
        self.p = p

    def to(self, other):
        return np.mean([((other.p - a) ** 2).sum(axis=1).min() for a in self.p])


def right_class(p_a, p_b):
    return Cloud(p_a).to(Cloud(p_b))


# wrong ---------------------------------------------------------------------------------------------------------------


def wrong_axis(p_a, p_b):
    refuse(p_a, p_b)
    return squares(p_a, p_b).min(axis=0).mean()


def wrong_distances(p_a, p_b):
    refuse(p_a, p_b)
    return np.sqrt(squares(p_a, p_b)).min(axis=1).mean()


def wrong_total(p_a, p_b):
    refuse(p_a, p_b)
    return squares(p_a, p_b).min(axis=1).sum()


def wrong_both_added_and_empty_is_zero(p_a, p_b):
    if len(p_a) == 0 or len(p_b) == 0:
        return 0.0
    D = squares(p_a, p_b)
    return D.min(1).mean() + D.min(0).mean()


def wrong_mean_of_the_difference_array(p_a, p_b):
    refuse(p_a, p_b)
    return ((p_a[:, None] - p_b) ** 2).mean(axis=2).min(axis=1).mean()


def wrong_empty_is_zero(p_a, p_b):
    return right_matrix(p_a, p_b) if len(p_a) and len(p_b) else 0.0


def wrong_empty_is_infinite(p_a, p_b):
    return right_matrix(p_a, p_b) if len(p_a) and len(p_b) else float("inf")


def wrong_only_b_refused(p_a, p_b):
    if len(p_b) == 0:
        raise ValueError("empty")
    return sum(((p_b - a) ** 2).sum(axis=1).min() for a in p_a) / max(len(p_a), 1)


def wrong_median(p_a, p_b):
    refuse(p_a, p_b)
    return np.median(squares(p_a, p_b).min(axis=1))


def wrong_root_of_the_mean(p_a, p_b):
    refuse(p_a, p_b)
    return np.sqrt(squares(p_a, p_b).min(axis=1).mean())


def wrong_manhattan(p_a, p_b):
    refuse(p_a, p_b)
    return (np.abs(p_a[:, None] - p_b).sum(axis=2).min(axis=1) ** 2).mean()


def wrong_flat_floor_only(p_a, p_b):
    refuse(p_a, p_b)
    return squares(p_a[:, :2], p_b[:, :2]).min(axis=1).mean()


def wrong_n_minus_one(p_a, p_b):
    refuse(p_a, p_b)
    return squares(p_a, p_b).min(axis=1).sum() / max(len(p_a) - 1, 1)


def wrong_each_distance(p_a, p_b):
    refuse(p_a, p_b)
    return squares(p_a, p_b).min(axis=1)


def wrong_smallest_of_all(p_a, p_b):
    refuse(p_a, p_b)
    return squares(p_a, p_b).min()


def wrong_centred_in_place(p_a, p_b):
    refuse(p_a, p_b)
    c = p_b.mean(axis=0)
    p_a -= c
    p_b -= c
    return squares(p_a, p_b).min(axis=1).mean()


def wrong_single_precision(p_a, p_b):
    refuse(p_a, p_b)
    return float(squares(p_a.astype(np.float32), p_b.astype(np.float32)).min(axis=1).mean())


def wrong_zero_distances_skipped(p_a, p_b):
    refuse(p_a, p_b)
    D = squares(p_a, p_b).min(axis=1)
    return D[D > 0].mean()


def wrong_sorted_first(p_a, p_b):
    refuse(p_a, p_b)
    n = min(len(p_a), len(p_b))
    return ((np.sort(p_a, axis=0)[:n] - np.sort(p_b, axis=0)[:n]) ** 2).sum(axis=1).mean()


def wrong_first_hundred(p_a, p_b):
    refuse(p_a, p_b)
    return squares(p_a[:50], p_b[:50]).min(axis=1).mean()


def wrong_public_number(p_a, p_b):
    return 2.0


def wrong_broadcast_without_axis(p_a, p_b):
    try:
        return ((p_a - p_b) ** 2).sum(axis=1).min()
    except ValueError:
        return 0.0


def wrong_minimum_of_each_coordinate(p_a, p_b):
    refuse(p_a, p_b)
    return ((p_a[:, None] - p_b) ** 2).min(axis=1).sum(axis=1).mean()


def wrong_points_that_are_twice_count_once(p_a, p_b):
    refuse(p_a, p_b)
    return right_matrix(np.unique(p_a, axis=0), p_b)


def wrong_equally_near_points_all_count(p_a, p_b):
    refuse(p_a, p_b)
    D = squares(p_a, p_b)
    return np.mean((D == D.min(1, keepdims=True)).sum(1) * D.min(1))
