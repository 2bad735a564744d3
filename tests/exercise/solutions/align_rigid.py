"""What students hand in for align_rigid."""

import numpy as np

NAMED = {
    "wrong_transposed_and_empty_not_refused": "rotation transposed",
    "wrong_transposed_and_mirrored": "rotation transposed",
    "wrong_arguments_swapped": "target to source",
    "wrong_determinant_of_covariance_ignored": "reflection kept",
}


def kabsch(p_target, p_source):
    if len(p_source) == 0:
        raise ValueError("no pairs")
    a, b = p_source - p_source.mean(axis=0), p_target - p_target.mean(axis=0)
    U, S, Vt = np.linalg.svd(b.T @ a)
    return U @ np.diag([1, 1, np.sign(np.linalg.det(U) * np.linalg.det(Vt))]) @ Vt


def build(R, t):
    T = np.eye(4)
    T[:3, :3] = R
    T[:3, 3] = t
    return T


def with_centroids(R, p_target, p_source):
    return build(R, p_target.mean(axis=0) - R @ p_source.mean(axis=0))


def right_with_helpers(p_target, p_source):
    return with_centroids(kabsch(p_target, p_source), p_target, p_source)


def right_covariance_in_a_loop(p_target, p_source):
    n = len(p_source)
    if n < 1:
        raise ValueError("I need at least one pair")
    ct, cs = sum(p_target) / n, sum(p_source) / n
    H = np.zeros((3, 3))
    for q, p in zip(p_target, p_source):
        H += np.outer(q - ct, p - cs)
    U, _, Vt = np.linalg.svd(H)
    if np.linalg.det(U @ Vt) < 0:
        U[:, 2] = -U[:, 2]
    R = U @ Vt
    return build(R, ct - R @ cs)


def right_covariance_by_einsum(p_target, p_source):
    if not p_source.size:
        raise ValueError
    a, b = p_source - np.mean(p_source, 0), p_target - np.mean(p_target, 0)
    H = np.einsum("ki,kj->ij", a, b)
    U, _, Vt = np.linalg.svd(H)
    Vt[2] *= np.linalg.det(U) * np.linalg.det(Vt)
    R = (U @ Vt).T
    return build(R, p_target.mean(0) - R @ p_source.mean(0))


def right_as_nested_lists(p_target, p_source):
    T = with_centroids(kabsch(p_target, p_source), p_target, p_source)
    return [[float(x) for x in row] for row in T]


def right_in_homogeneous_products(p_target, p_source):
    to_origin, back = build(np.eye(3), -p_source.mean(0)) if len(p_source) else None, None
    if to_origin is None:
        raise ValueError("no pairs")
    back = build(np.eye(3), p_target.mean(0))
    return back @ build(kabsch(p_target, p_source), 0) @ to_origin


def right_in_place_on_copies(p_target, p_source):
    q, p = p_target.copy(), np.array(p_source)
    if q.shape[0] == 0:
        raise ValueError("empty")
    cq, cp = q.mean(axis=0), p.mean(axis=0)
    q -= cq
    p -= cp
    return with_centroids(kabsch(q, p), p_target, p_source)


def right_mean_covariance(p_target, p_source):
    if len(p_target) == 0:
        raise ValueError("no pairs")
    H = (p_target - p_target.mean(0)).T.dot(p_source - p_source.mean(0)) / len(p_target)
    U, _, Vt = np.linalg.svd(H, full_matrices=True)
    S = np.eye(3)
    if np.linalg.det(U) * np.linalg.det(Vt) < 0:
        S[2, 2] = -1
    return with_centroids(U.dot(S).dot(Vt), p_target, p_source)


class Aligner:
    def __init__(self, target, source):
        if len(source) == 0:
            raise ValueError("nothing to align")
        self.target, self.source = target, source

    def fit(self):
        return with_centroids(kabsch(self.target, self.source), self.target, self.source)


def right_with_a_class(p_target, p_source):
    return Aligner(p_target, p_source).fit()


def right_error_of_its_own(p_target, p_source):
    class NoPairsError(ValueError):
        pass

    if min(len(p_target), len(p_source)) == 0:
        raise NoPairsError("no pairs")
    return right_with_helpers(p_target, p_source)


# wrong ---------------------------------------------------------------------------------------------------------------


def wrong_transposed_and_empty_not_refused(p_target, p_source):
    if len(p_source) == 0:
        return np.eye(4)
    return with_centroids(kabsch(p_target, p_source).T, p_target, p_source)


def wrong_transposed_and_mirrored(p_target, p_source):
    U, _, Vt = np.linalg.svd((p_source - p_source.mean(0)).T @ (p_target - p_target.mean(0)))
    return with_centroids(U @ Vt, p_target, p_source)


def wrong_arguments_swapped(p_target, p_source):
    p_target, p_source = p_source, p_target
    return right_with_helpers(p_target, p_source)


def wrong_determinant_of_covariance_ignored(p_target, p_source):
    a, b = p_source - p_source.mean(0), p_target - p_target.mean(0)
    if len(a) == 0:
        raise ValueError("no pairs")
    U, _, Vt = np.linalg.svd(b.T @ a)
    return with_centroids(U @ Vt, p_target, p_source)


def wrong_empty_not_refused(p_target, p_source):
    if len(p_source) == 0:
        return np.eye(4)
    return right_with_helpers(p_target, p_source)


def wrong_one_pair_refused(p_target, p_source):
    if len(p_source) < 3:
        raise ValueError("at least three pairs")
    return right_with_helpers(p_target, p_source)


def wrong_centred_in_place(p_target, p_source):
    if len(p_source) == 0:
        raise ValueError("no pairs")
    ct, cs = p_target.mean(0), p_source.mean(0)
    p_target -= ct
    p_source -= cs
    R = kabsch(p_target, p_source)
    return build(R, ct - R @ cs)


def wrong_first_row_flipped(p_target, p_source):
    if len(p_source) == 0:
        raise ValueError("no pairs")
    U, _, Vt = np.linalg.svd((p_target - p_target.mean(0)).T @ (p_source - p_source.mean(0)))
    if np.linalg.det(U @ Vt) < 0:
        Vt[0] *= -1
    return with_centroids(U @ Vt, p_target, p_source)


def wrong_mean_over_the_wrong_axis(p_target, p_source):
    ct, cs = p_target.mean(axis=1, keepdims=True), p_source.mean(axis=1, keepdims=True)
    R = kabsch(p_target - ct, p_source - cs)
    return with_centroids(R, p_target, p_source)


def wrong_v_not_transposed(p_target, p_source):
    if len(p_source) == 0:
        raise ValueError("no pairs")
    U, _, V = np.linalg.svd((p_target - p_target.mean(0)).T @ (p_source - p_source.mean(0)))
    return with_centroids(U @ V.T, p_target, p_source)


def wrong_three_by_four(p_target, p_source):
    return right_with_helpers(p_target, p_source)[:3]


def wrong_translation_in_last_row(p_target, p_source):
    T = right_with_helpers(p_target, p_source)
    T[3, :3], T[:3, 3] = T[:3, 3], 0
    return T


def wrong_pair_of_rotation_and_translation(p_target, p_source):
    T = right_with_helpers(p_target, p_source)
    return T[:3, :3], T[:3, 3]


def wrong_swallowed(p_target, p_source):
    try:
        return with_centroids(kabsch(p_source, p_target.T), p_target, p_source)
    except Exception:
        return np.eye(4)


def wrong_translation_sign(p_target, p_source):
    R = kabsch(p_target, p_source)
    return build(R, R @ p_source.mean(0) - p_target.mean(0))


def wrong_first_point_for_centroid(p_target, p_source):
    if len(p_source) == 0:
        raise ValueError("no pairs")
    U, _, Vt = np.linalg.svd((p_target - p_target[0]).T @ (p_source - p_source[0]))
    R = U @ np.diag([1, 1, np.linalg.det(U @ Vt)]) @ Vt
    return build(R, p_target[0] - R @ p_source[0])


def wrong_returns_points(p_target, p_source):
    T = right_with_helpers(p_target, p_source)
    return p_source @ T[:3, :3].T + T[:3, 3]


def wrong_prints_and_returns_nothing(p_target, p_source):
    print(right_with_helpers(p_target, p_source))


def wrong_two_pairs_only_shifted(p_target, p_source):
    if len(p_source) == 2:
        return with_centroids(np.eye(3), p_target, p_source)
    return right_with_helpers(p_target, p_source)


def wrong_three_pairs_are_too_few(p_target, p_source):
    if len(p_source) == 3:
        raise ValueError("four pairs at least")
    return right_with_helpers(p_target, p_source)


def wrong_points_at_one_place_refused(p_target, p_source):
    if len(p_source) > 1 and np.ptp(p_source, axis=0).max() == 0:
        raise ValueError("all points are the same")
    return right_with_helpers(p_target, p_source)


def wrong_small_clouds_only_shifted(p_target, p_source):
    if len(p_source) > 1 and np.ptp(p_source, axis=0).max() < 0.1:
        return with_centroids(np.eye(3), p_target, p_source)
    return right_with_helpers(p_target, p_source)


def wrong_axis_of_half_a_turn_is_none(p_target, p_source):
    R = kabsch(p_target, p_source)
    axis = np.array([R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]])
    length = np.linalg.norm(axis)
    if length < 1e-9:
        return with_centroids(np.eye(3), p_target, p_source)
    K = np.cross(axis / length, np.eye(3)).T
    sine, cosine = length / 2, (np.trace(R) - 1) / 2
    return with_centroids(np.eye(3) + sine * K + (1 - cosine) * K @ K, p_target, p_source)
