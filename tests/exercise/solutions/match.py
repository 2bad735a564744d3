"""What students hand in for match."""

import numpy as np

NAMED = {
    "wrong_argmin_over_the_source": "matched backwards",
    "wrong_manhattan_in_loops": "manhattan distance",
}


def refuse(p_target):
    if len(p_target) == 0:
        raise ValueError("no target points")


def pairwise(p_target, p_source):
    return np.linalg.norm(p_source[:, None] - p_target[None], axis=-1)


def right_matrix(p_target, p_source):
    refuse(p_target)
    return pairwise(p_target, p_source).argmin(axis=1)


def right_min_with_key(p_target, p_source):
    return [
        min(range(len(p_target)), key=lambda j: float(np.sum((p_target[j] - s) ** 2)))
        for s in p_source
    ]


def right_einsum(p_target, p_source):
    refuse(p_target)
    diff = p_source[:, None, :] - p_target[None, :, :]
    return np.einsum("ijk,ijk->ij", diff, diff).argmin(1).astype(np.int32)


def right_expanded_about_the_mean(p_target, p_source):
    refuse(p_target)
    c = p_target.mean(0)
    a, b = p_source - c, p_target - c
    return np.argmin((a**2).sum(1)[:, None] - 2 * a @ b.T + (b**2).sum(1), axis=1)


# wrong ---------------------------------------------------------------------------------------------------------------


def wrong_argmin_over_the_source(p_target, p_source):
    refuse(p_target)
    return pairwise(p_target, p_source).argmin(axis=0)


def wrong_manhattan_in_loops(p_target, p_source):
    refuse(p_target)
    return [int(np.argmin([sum(abs(s - t)) for t in p_target])) for s in p_source]


def wrong_empty_gives_zeros(p_target, p_source):
    if len(p_target) == 0:
        return np.zeros(len(p_source), dtype=int)
    return right_matrix(p_target, p_source)


def wrong_moved_to_the_origin_in_place(p_target, p_source):
    refuse(p_target)
    c = p_target.mean(axis=0)
    p_target -= c
    p_source -= c
    return pairwise(p_target, p_source).argmin(axis=1)


def wrong_in_single_precision(p_target, p_source):
    refuse(p_target)
    return pairwise(p_target.astype(np.float32), p_source.astype(np.float32)).argmin(axis=1)


def wrong_largest_coordinate_difference(p_target, p_source):
    refuse(p_target)
    return np.abs(p_source[:, None] - p_target).max(axis=2).argmin(axis=1)


def wrong_partners_within_a_hundred_metres(p_target, p_source):
    refuse(p_target)
    D = pairwise(p_target, p_source)
    return np.where(D.min(axis=1) > 100, 0, D.argmin(axis=1))


def wrong_one_source_point_without_its_row(p_target, p_source):
    refuse(p_target)
    return np.squeeze(pairwise(p_target, p_source).argmin(axis=1))
