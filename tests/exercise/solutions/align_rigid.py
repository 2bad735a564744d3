"""What students hand in for align_rigid."""

import numpy as np

NAMED = {
    "wrong_transposed_and_empty_not_refused": "rotation transposed",
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


def right_covariance_by_einsum(p_target, p_source):
    if not p_source.size:
        raise ValueError
    a, b = p_source - np.mean(p_source, 0), p_target - np.mean(p_target, 0)
    H = np.einsum("ki,kj->ij", a, b)
    U, _, Vt = np.linalg.svd(H)
    Vt[2] *= np.linalg.det(U) * np.linalg.det(Vt)
    R = (U @ Vt).T
    return build(R, p_target.mean(0) - R @ p_source.mean(0))


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
