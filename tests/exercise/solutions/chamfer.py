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


def right_trees(p_a, p_b):
    from scipy.spatial import cKDTree

    refuse(p_a, p_b)
    there, back = cKDTree(p_b).query(p_a)[0], cKDTree(p_a).query(p_b)[0]
    return np.square(there).mean() + np.square(back).mean()


def right_expanded_about_the_mean(p_a, p_b):
    refuse(p_a, p_b)
    c = (p_a.mean(0) + p_b.mean(0)) / 2
    a, b = p_a - c, p_b - c
    D = np.maximum((a * a).sum(1)[:, None] + (b * b).sum(1) - 2 * a @ b.T, 0)
    return D.min(1).mean() + D.min(0).mean()


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


def wrong_moved_in_place(p_a, p_b):
    refuse(p_a, p_b)
    c = p_a.mean(axis=0).copy()
    p_a -= c
    p_b -= c
    return side(p_a, p_b) + side(p_b, p_a)


def wrong_points_that_are_twice_count_once(p_a, p_b):
    refuse(p_a, p_b)
    return right_two_sides(np.unique(p_a, axis=0), np.unique(p_b, axis=0))


def wrong_small_is_zero(p_a, p_b):
    d = right_two_sides(p_a, p_b)
    return d if d > 1e-4 else 0.0
