"""What students hand in for match."""

import numpy as np

NAMED = {
    "wrong_argmin_over_the_source": "matched backwards",
    "wrong_manhattan_in_loops": "manhattan distance",
    "wrong_backwards_and_empty_answered": "matched backwards",
}


def refuse(p_target):
    if len(p_target) == 0:
        raise ValueError("no target points")


def pairwise(p_target, p_source):
    return np.linalg.norm(p_source[:, None] - p_target[None], axis=-1)


def right_matrix(p_target, p_source):
    refuse(p_target)
    return pairwise(p_target, p_source).argmin(axis=1)


def right_two_loops(p_target, p_source):
    if len(p_target) == 0:
        raise ValueError
    found = []
    for s in p_source:
        best, best_d = 0, float("inf")
        for j, t in enumerate(p_target):
            d = (s[0] - t[0]) ** 2 + (s[1] - t[1]) ** 2 + (s[2] - t[2]) ** 2
            if d < best_d:
                best, best_d = j, d
        found.append(best)
    return found


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


def right_last_of_equals(p_target, p_source):
    refuse(p_target)
    D = pairwise(p_target, p_source)
    return D.shape[1] - 1 - np.argmin(D[:, ::-1], axis=1)


def right_argsort_first_column(p_target, p_source):
    refuse(p_target)
    return np.argsort(pairwise(p_target, p_source), axis=1)[:, 0].astype(np.uint16)


def right_recursive_halves(p_target, p_source):
    refuse(p_target)
    if len(p_source) <= 16:
        return right_matrix(p_target, p_source)
    half = len(p_source) // 2
    return np.append(
        right_recursive_halves(p_target, p_source[:half]),
        right_recursive_halves(p_target, p_source[half:]),
    )


class Brute:
    def __init__(self, cloud):
        self.cloud = np.array(cloud)
        refuse(self.cloud)

    def nearest(self, p):
        return int(((self.cloud - p) ** 2).sum(axis=1).argmin())


def right_class(p_target, p_source):
    brute = Brute(p_target)
    return np.fromiter((brute.nearest(p) for p in p_source), dtype=int, count=len(p_source))


# wrong ---------------------------------------------------------------------------------------------------------------


def wrong_argmin_over_the_source(p_target, p_source):
    refuse(p_target)
    return pairwise(p_target, p_source).argmin(axis=0)


def wrong_manhattan_in_loops(p_target, p_source):
    refuse(p_target)
    return [int(np.argmin([sum(abs(s - t)) for t in p_target])) for s in p_source]


def wrong_backwards_and_empty_answered(p_target, p_source):
    if not len(p_target):
        return np.zeros(len(p_source), int)
    return pairwise(p_source, p_target).argmin(axis=1)


def wrong_empty_gives_zeros(p_target, p_source):
    if len(p_target) == 0:
        return np.zeros(len(p_source), dtype=int)
    return right_matrix(p_target, p_source)


def wrong_counted_from_one(p_target, p_source):
    return right_matrix(p_target, p_source) + 1


def wrong_points_returned(p_target, p_source):
    return p_target[right_matrix(p_target, p_source)]


def wrong_floats(p_target, p_source):
    return right_matrix(p_target, p_source).astype(float)


def wrong_column_vector(p_target, p_source):
    return right_matrix(p_target, p_source).reshape(-1, 1)


def wrong_indices_and_distances(p_target, p_source):
    D = pairwise(p_target, p_source)
    return D.argmin(axis=1), D.min(axis=1)


def wrong_moved_to_the_origin_in_place(p_target, p_source):
    refuse(p_target)
    c = p_target.mean(axis=0)
    p_target -= c
    p_source -= c
    return pairwise(p_target, p_source).argmin(axis=1)


def wrong_centred_apart(p_target, p_source):
    refuse(p_target)
    return pairwise(p_target - p_target.mean(0), p_source - p_source.mean(0)).argmin(axis=1)


def wrong_in_single_precision(p_target, p_source):
    refuse(p_target)
    return pairwise(p_target.astype(np.float32), p_source.astype(np.float32)).argmin(axis=1)


def wrong_largest_coordinate_difference(p_target, p_source):
    refuse(p_target)
    return np.abs(p_source[:, None] - p_target).max(axis=2).argmin(axis=1)


def wrong_smallest_dot_product(p_target, p_source):
    refuse(p_target)
    return (p_source @ p_target.T).argmax(axis=1)


def wrong_distance_to_origin(p_target, p_source):
    refuse(p_target)
    a, b = np.linalg.norm(p_target, axis=1), np.linalg.norm(p_source, axis=1)
    return np.abs(b[:, None] - a).argmin(axis=1)


def wrong_stops_at_the_first_improvement(p_target, p_source):
    refuse(p_target)
    found = []
    for s in p_source:
        best = 0
        for j in range(1, len(p_target)):
            if np.linalg.norm(s - p_target[j]) < np.linalg.norm(s - p_target[best]):
                best = j
                break
        found.append(best)
    return found


def wrong_misses_the_last_target(p_target, p_source):
    refuse(p_target)
    return [
        min(range(max(len(p_target) - 1, 1)), key=lambda j: np.linalg.norm(p_target[j] - s))
        for s in p_source
    ]


def wrong_signed_sum(p_target, p_source):
    refuse(p_target)
    return (p_source[:, None] - p_target).sum(axis=2).argmin(axis=1)


def wrong_the_public_case(p_target, p_source):
    return [1, 2, 1, 0] if len(p_source) == 4 else [0] * len(p_source)


def wrong_mutual_pairs_only(p_target, p_source):
    refuse(p_target)
    D = pairwise(p_target, p_source)
    there, back = D.argmin(1), D.argmin(0)
    return np.array([j if back[j] == i else -1 for i, j in enumerate(there)])


def wrong_partners_within_a_hundred_metres(p_target, p_source):
    refuse(p_target)
    D = pairwise(p_target, p_source)
    return np.where(D.min(axis=1) > 100, 0, D.argmin(axis=1))


def wrong_one_source_point_without_its_row(p_target, p_source):
    refuse(p_target)
    return np.squeeze(pairwise(p_target, p_source).argmin(axis=1))
