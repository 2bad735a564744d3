"""What students hand in for point_to_plane_step."""

import numpy as np

NAMED = {
    "wrong_cross_with_the_target": "sign of the gap",
    "wrong_gap_turned_round": "sign of the gap",
    "wrong_n_cross_p": "cross product turned round",
    "wrong_rotation_transposed": "cross product turned round",
    "wrong_small_angle_matrix": "no proper rotation",
    "wrong_inverse_of_the_normal_matrix": "singular",
}


def skew(w):
    return np.array([[0, -w[2], w[1]], [w[2], 0, -w[0]], [-w[1], w[0], 0]])


def rodrigues(w):
    angle = np.linalg.norm(w)
    if angle < 1e-12:
        return np.eye(3)
    K = skew(w / angle)
    return np.eye(3) + np.sin(angle) * K + (1 - np.cos(angle)) * K @ K


def build(R, t):
    T = np.eye(4)
    T[:3, :3], T[:3, 3] = R, t
    return T


def system(p_target, p_source, n):
    return np.hstack([np.cross(p_source, n), n]), ((p_target - p_source) * n).sum(axis=1)


def solved(A, b):
    x = np.linalg.lstsq(A, b, rcond=1e-9)[0]
    return x[:3], x[3:]


def right_least_squares(p_target, p_source, n_target):
    w, v = solved(*system(p_target, p_source, n_target))
    return build(rodrigues(w), v)


def right_about_the_centroid(p_target, p_source, n_target):
    c = p_source.mean(axis=0)
    w, v = solved(*system(p_target - c, p_source - c, n_target))
    R = rodrigues(w)
    return build(R, c + v - R @ c)


def right_rows_in_a_loop(p_target, p_source, n_target):
    A, b = [], []
    for q, p, n in zip(p_target, p_source, n_target):
        A.append(list(np.cross(p, n)) + list(n))
        b.append(np.dot(n, q - p))
    w, v = solved(np.array(A), np.array(b))
    return build(rodrigues(w), v)


def right_pinv(p_target, p_source, n_target):
    A, b = system(p_target, p_source, n_target)
    x = np.linalg.pinv(A, rcond=1e-9) @ b
    return build(rodrigues(x[:3]), x[3:])


def right_expm(p_target, p_source, n_target):
    from scipy.linalg import expm

    w, v = solved(*system(p_target, p_source, n_target))
    return build(expm(skew(w)), v)


def right_quaternion(p_target, p_source, n_target):
    w, v = solved(*system(p_target, p_source, n_target))
    q = np.array([1.0, *(w / 2)])
    a, x, y, z = q / np.linalg.norm(q)
    R = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - a * z), 2 * (x * z + a * y)],
        [2 * (x * y + a * z), 1 - 2 * (x * x + z * z), 2 * (y * z - a * x)],
        [2 * (x * z - a * y), 2 * (y * z + a * x), 1 - 2 * (x * x + y * y)],
    ]
    return build(np.array(R), v)


def right_scipy_rotation(p_target, p_source, n_target):
    from scipy.spatial.transform import Rotation

    w, v = solved(*system(p_target, p_source, n_target))
    return build(Rotation.from_rotvec(w).as_matrix(), v)


def right_nested_lists(p_target, p_source, n_target):
    return right_least_squares(p_target, p_source, n_target).tolist()


def right_svd_of_the_rows(p_target, p_source, n_target):
    A, b = system(p_target, p_source, n_target)
    U, s, Vt = np.linalg.svd(A, full_matrices=False)
    keep = s > 1e-9 * s[0]
    x = Vt[keep].T @ ((U[:, keep].T @ b) / s[keep])
    return build(rodrigues(x[:3]), x[3:])


def right_euler_small(p_target, p_source, n_target):
    (a, b, c), v = solved(*system(p_target, p_source, n_target))
    ca, sa, cb, sb, cc, sc = np.cos(a), np.sin(a), np.cos(b), np.sin(b), np.cos(c), np.sin(c)
    R = [
        [cc * cb, -sc * ca + cc * sb * sa, sc * sa + cc * sb * ca],
        [sc * cb, cc * ca + sc * sb * sa, -cc * sa + sc * sb * ca],
        [-sb, cb * sa, cb * ca],
    ]
    return build(np.array(R), v)


# wrong ---------------------------------------------------------------------------------------------------------------


def wrong_gap_turned_round(p_target, p_source, n_target):
    A, b = system(p_target, p_source, n_target)
    w, v = solved(A, -b)
    return build(rodrigues(w), v)


def wrong_n_cross_p(p_target, p_source, n_target):
    A = np.hstack([np.cross(n_target, p_source), n_target])
    w, v = solved(A, system(p_target, p_source, n_target)[1])
    return build(rodrigues(w), v)


def wrong_small_angle_matrix(p_target, p_source, n_target):
    w, v = solved(*system(p_target, p_source, n_target))
    return build(np.eye(3) + skew(w), v)


def wrong_inverse_of_the_normal_matrix(p_target, p_source, n_target):
    A, b = system(p_target, p_source, n_target)
    x = np.linalg.solve(A.T @ A, A.T @ b)
    return build(rodrigues(x[:3]), x[3:])


def wrong_unknowns_mixed_up(p_target, p_source, n_target):
    v, w = solved(*system(p_target, p_source, n_target))
    return build(rodrigues(w), v)


def wrong_cross_with_the_target(p_target, p_source, n_target):
    A = np.hstack([np.cross(p_target, n_target), n_target])
    w, v = solved(A, -((p_target - p_source) * n_target).sum(axis=1))
    return build(rodrigues(w), v)


def wrong_rotation_transposed(p_target, p_source, n_target):
    w, v = solved(*system(p_target, p_source, n_target))
    return build(rodrigues(w).T, v)


def wrong_whole_distance_for_the_gap(p_target, p_source, n_target):
    A, _ = system(p_target, p_source, n_target)
    w, v = solved(A, np.linalg.norm(p_target - p_source, axis=1))
    return build(rodrigues(w), v)


def wrong_halved(p_target, p_source, n_target):
    w, v = solved(*system(p_target, p_source, n_target))
    return build(rodrigues(w / 2), v / 2)


def wrong_moved_points_returned(p_target, p_source, n_target):
    T = right_least_squares(p_target, p_source, n_target)
    return p_source @ T[:3, :3].T + T[:3, 3]


def wrong_six_numbers(p_target, p_source, n_target):
    w, v = solved(*system(p_target, p_source, n_target))
    return np.concatenate([w, v])


def wrong_normals_scaled_in_place(p_target, p_source, n_target):
    n_target *= np.sign(n_target[:, 2:]) + (n_target[:, 2:] == 0)
    return right_least_squares(p_target, p_source, n_target)


def wrong_identity_on_failure(p_target, p_source, n_target):
    try:
        A, b = system(p_target, p_source, n_target)
        x = np.linalg.inv(A) @ b
        return build(rodrigues(x[:3]), x[3:])
    except Exception:
        return np.eye(4)


def wrong_points_outside_dropped(p_target, p_source, n_target):
    A, b = system(p_target, p_source, n_target)
    near = b > 0
    w, v = solved(A[near], b[near])
    return build(rodrigues(w), v)


def wrong_rotation_only(p_target, p_source, n_target):
    A, b = system(p_target, p_source, n_target)
    w = np.linalg.lstsq(A[:, :3], b, rcond=1e-9)[0]
    return build(rodrigues(w), 0)


def wrong_degrees(p_target, p_source, n_target):
    w, v = solved(*system(p_target, p_source, n_target))
    return build(rodrigues(np.degrees(w)), v)


def wrong_centroid_shift_forgotten_target_kept(p_target, p_source, n_target):
    c = p_source.mean(axis=0)
    w, v = solved(*system(p_target, p_source - c, n_target))
    return build(rodrigues(w), v)


def wrong_regularised(p_target, p_source, n_target):
    A, b = system(p_target, p_source, n_target)
    x = np.linalg.solve(A.T @ A + 5.0 * np.eye(6), A.T @ b)
    return build(rodrigues(x[:3]), x[3:])


def wrong_six_pairs_demanded(p_target, p_source, n):
    return right_least_squares(p_target, p_source, n) if len(n) >= 6 else np.eye(4)


def wrong_one_pair_is_none(p_target, p_source, n):
    return right_least_squares(p_target, p_source, n) if len(n) > 1 else np.eye(4)
