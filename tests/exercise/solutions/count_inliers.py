"""What students hand in for count_inliers."""

import numpy as np

NAMED = {
    "wrong_any_coordinate": "to the foot",
    "wrong_nan_counts": "nan is near",
    "wrong_strict": "limit left out",
    "wrong_not_farther": "nan is near",
    "wrong_sum_of_a_list_of_signed": "below counts",
}


def right_vectorised(plane, p, inlier_distance):
    return int(np.sum(np.abs(p @ plane[:3] + plane[3]) <= inlier_distance))


def right_count_nonzero(plane, p, inlier_distance):
    d = np.einsum("ij,j->i", p, plane[:3]) + plane[3]
    return np.count_nonzero((d <= inlier_distance) & (d >= -inlier_distance))


def right_filter(plane, p, inlier_distance):
    def near(q):
        return abs(float(q @ plane[:3]) + float(plane[3])) <= inlier_distance

    return len(list(filter(near, p)))


def right_normalised_first(plane, p, inlier_distance):
    length = np.sqrt(plane[0] ** 2 + plane[1] ** 2 + plane[2] ** 2)
    if not length > 0:
        return 0
    return sum(bool(b) for b in np.abs(p @ plane[:3] + plane[3]) / length <= inlier_distance)


# wrong ---------------------------------------------------------------------------------------------------------------


def wrong_strict(plane, p, inlier_distance):
    n = 0
    for q in p:
        n += abs(q @ plane[:3] + plane[3]) < inlier_distance
    return int(n)


def wrong_not_farther(plane, p, inlier_distance):
    n = len(p)
    for q in p:
        if abs(q @ plane[:3] + plane[3]) > inlier_distance:
            n -= 1
    return n


def wrong_sum_of_a_list_of_signed(plane, p, inlier_distance):
    return sum(1 for q in p if q @ plane[:3] + plane[3] <= inlier_distance)


def wrong_nan_counts(plane, p, inlier_distance):
    return int((np.nan_to_num(np.abs(p @ plane[:3] + plane[3])) <= inlier_distance).sum())


def wrong_nan_plane_is_an_error(plane, p, inlier_distance):
    if np.isnan(plane).any():
        raise ValueError("degenerate plane")
    return right_vectorised(plane, p, inlier_distance)


def wrong_nan_raises(plane, p, inlier_distance):
    assert np.isfinite(p).all()
    return right_vectorised(plane, p, inlier_distance)


def wrong_empty_is_none(plane, p, inlier_distance):
    return right_vectorised(plane, p, inlier_distance) if len(p) else None


def wrong_any_coordinate(plane, p, inlier_distance):
    return int((np.abs(p - plane[:3] * -plane[3]) <= inlier_distance).all(axis=1).sum())


def wrong_nan_replaced_in_place(plane, p, inlier_distance):
    p[np.isnan(p)] = 1e9
    return right_vectorised(plane, p, inlier_distance)


def wrong_points_moved_in_place(plane, p, inlier_distance):
    p += plane[3] * plane[:3]
    return int((np.abs(p @ plane[:3]) <= inlier_distance).sum())


def wrong_both_sides_exclusive(plane, p, inlier_distance):
    d = p @ plane[:3] + plane[3]
    return int((d < inlier_distance).sum() - (d < -inlier_distance).sum())


def wrong_nothing_within_nought(plane, p, inlier_distance):
    return right_vectorised(plane, p, inlier_distance) if inlier_distance > 0 else 0


def wrong_only_y_looked_at_for_nan(plane, p, inlier_distance):
    q = p[~np.isnan(p[:, 1])]
    return int(np.sum(np.abs(np.nan_to_num(q) @ plane[:3] + plane[3]) <= inlier_distance))
