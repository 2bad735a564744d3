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


def right_tree(p_a, p_b):
    from scipy.spatial import KDTree

    refuse(p_a, p_b)
    d, _ = KDTree(p_b).query(p_a)
    return d @ d / len(d)


def right_einsum(p_a, p_b):
    refuse(p_a, p_b)
    diff = p_a[:, np.newaxis, :] - p_b
    return np.einsum("ijk,ijk->ij", diff, diff).min(1).sum() / p_a.shape[0]


def right_in_blocks(p_a, p_b):
    refuse(p_a, p_b)
    best = np.full(len(p_a), np.inf)
    for k in range(0, len(p_b), 7):
        best = np.minimum(best, squares(p_a, p_b[k : k + 7]).min(axis=1))
    return np.average(best)


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


def wrong_points_that_are_twice_count_once(p_a, p_b):
    refuse(p_a, p_b)
    return right_matrix(np.unique(p_a, axis=0), p_b)


def wrong_equally_near_points_all_count(p_a, p_b):
    refuse(p_a, p_b)
    D = squares(p_a, p_b)
    return np.mean((D == D.min(1, keepdims=True)).sum(1) * D.min(1))
