"""What students hand in for mutual_matches."""

import numpy as np
from scipy.spatial import KDTree
from scipy.spatial.distance import cdist

NAMED = {
    "wrong_one_way": "one direction",
    "wrong_squares": "squared distances",
    "wrong_greater": "test reversed",
    "wrong_mutual_only": "no ratio",
    "wrong_ratio_of_columns": "second of the wrong set",
}


def right_cdist(a, b, ratio):
    D = cdist(a, b)
    j, i = D.argmin(1), D.argmin(0)
    two = np.partition(D, 1, axis=1)
    ok = (i[j] == np.arange(len(a))) & (two[:, 0] < ratio * two[:, 1])
    j[~ok] = -1
    return j


def right_trees(a, b, ratio):
    d, j = KDTree(b).query(a, k=2)
    _, i = KDTree(a).query(b)
    return np.where((i[j[:, 0]] == np.arange(len(a))) & (d[:, 0] < ratio * d[:, 1]), j[:, 0], -1)


def right_squares_on_both_sides(a, b, ratio):
    D = ((a[:, None, :] - b[None, :, :]) ** 2).sum(-1)
    order = np.argsort(D, axis=1, kind="stable")
    rows = np.arange(len(a))
    d1, d2 = D[rows, order[:, 0]], D[rows, order[:, 1]]
    ok = (d1 < ratio**2 * d2) & (D.argmin(0)[order[:, 0]] == rows)
    return np.where(ok, order[:, 0], -1)


def right_dictionary(a, b, ratio):
    forward, backward = {}, {}
    for i, x in enumerate(a):
        d = np.sqrt(np.sum((b - x) ** 2, axis=1))
        j = int(d.argmin())
        if d[j] < ratio * np.delete(d, j).min():
            forward[i] = j
    for j, y in enumerate(b):
        backward[j] = int(np.sqrt(np.sum((a - y) ** 2, axis=1)).argmin())
    return np.array(
        [forward[i] if i in forward and backward[forward[i]] == i else -1 for i in range(len(a))]
    )


# wrong ---------------------------------------------------------------------------------------------------------------


def wrong_one_way(a, b, ratio):
    D = cdist(a, b)
    s = np.sort(D, axis=1)
    return np.where(s[:, 0] < ratio * s[:, 1], D.argmin(1), -1)


def wrong_squares(a, b, ratio):
    D = ((a[:, None] - b) ** 2).sum(-1)
    s = np.sort(D, axis=1)
    j = D.argmin(1)
    return np.where((s[:, 0] < ratio * s[:, 1]) & (D.argmin(0)[j] == np.arange(len(a))), j, -1)


def wrong_greater(a, b, ratio):
    D = cdist(a, b)
    s = np.sort(D, axis=1)
    j = D.argmin(1)
    return np.where((s[:, 0] > ratio * s[:, 1]) & (D.argmin(0)[j] == np.arange(len(a))), j, -1)


def wrong_mutual_only(a, b, ratio):
    D = cdist(a, b)
    j = D.argmin(1)
    return np.where(D.argmin(0)[j] == np.arange(len(a)), j, -1)


def wrong_ratio_of_columns(a, b, ratio):
    D = cdist(a, b)
    s = np.sort(D, axis=0)
    j = D.argmin(1)
    ok = (s[0] < ratio * s[1])[j] & (D.argmin(0)[j] == np.arange(len(a)))
    return np.where(ok, j, -1)


def wrong_centred_in_place(a, b, ratio):
    a -= b.mean(axis=0)
    b -= b.mean(axis=0)
    return right_cdist(a, b, ratio)


def wrong_all_of_equal_rows(a, b, ratio):
    D = np.linalg.norm(a[:, None] - b[None], axis=2)
    two = np.sort(D, axis=1)[:, :2]
    j = D.argmin(axis=1)
    mutual = D[np.arange(len(a)), j] <= D.min(axis=0)[j]
    return np.where(mutual & (two[:, 0] < ratio * two[:, 1]), j, -1)


def wrong_last_of_equal_rows(a, b, ratio):
    D = np.linalg.norm(a[:, None] - b[None], axis=2)
    two = np.sort(D, axis=1)[:, :2]
    j = D.argmin(axis=1)
    back = len(a) - 1 - D[::-1].argmin(axis=0)
    return np.where((back[j] == np.arange(len(a))) & (two[:, 0] < ratio * two[:, 1]), j, -1)


def wrong_equal_rows_of_b_count_once(a, b, ratio):
    D = np.linalg.norm(a[:, None] - b[None], axis=2)
    j, i = D.argmin(axis=1), D.argmin(axis=0)
    out = np.full(len(a), -1)
    for k in range(len(a)):
        lengths = np.unique(D[k])
        if i[j[k]] == k and lengths[0] < ratio * lengths[1]:
            out[k] = j[k]
    return out


def wrong_distance_zero_is_none(a, b, ratio):
    D = np.linalg.norm(a[:, None] - b[None], axis=2)
    two = np.sort(D, axis=1)[:, :2]
    j, i = D.argmin(axis=1), D.argmin(axis=0)
    keep = (i[j] == np.arange(len(a))) & (two[:, 0] < ratio * two[:, 1]) & (two[:, 0] > 0)
    return np.where(keep, j, -1)


def wrong_equal_is_less(a, b, ratio):
    D = cdist(a, b)
    j, two = D.argmin(1), np.sort(D, axis=1)
    ok = (D.argmin(0)[j] == np.arange(len(a))) & (two[:, 0] <= ratio * two[:, 1]) & (two[:, 1] > 0)
    return np.where(ok, j, -1)


def wrong_three_rows_of_b_demanded(a, b, ratio):
    return right_cdist(a, b, ratio) if len(b) > 2 else np.full(len(a), -1)


def wrong_one_row_of_a_has_none(a, b, ratio):
    return right_cdist(a, b, ratio) if len(a) > 1 else np.array([-1])


def wrong_ratio_of_a_third_at_least(a, b, ratio):
    return right_cdist(a, b, max(ratio, 0.34))
