"""What students hand in for point_to_plane_step."""

import numpy as np

NAMED = {
    "wrong_gap_turned_round": "sign of the gap",
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


def right_pinv(p_target, p_source, n_target):
    A, b = system(p_target, p_source, n_target)
    x = np.linalg.pinv(A, rcond=1e-9) @ b
    return build(rodrigues(x[:3]), x[3:])


def right_scipy_rotation(p_target, p_source, n_target):
    from scipy.spatial.transform import Rotation

    w, v = solved(*system(p_target, p_source, n_target))
    return build(Rotation.from_rotvec(w).as_matrix(), v)


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


def wrong_small_angle_matrix(p_target, p_source, n_target):
    w, v = solved(*system(p_target, p_source, n_target))
    return build(np.eye(3) + skew(w), v)


def wrong_inverse_of_the_normal_matrix(p_target, p_source, n_target):
    A, b = system(p_target, p_source, n_target)
    x = np.linalg.solve(A.T @ A, A.T @ b)
    return build(rodrigues(x[:3]), x[3:])


def wrong_rotation_transposed(p_target, p_source, n_target):
    w, v = solved(*system(p_target, p_source, n_target))
    return build(rodrigues(w).T, v)


def wrong_normals_scaled_in_place(p_target, p_source, n_target):
    n_target *= np.sign(n_target[:, 2:]) + (n_target[:, 2:] == 0)
    return right_least_squares(p_target, p_source, n_target)


def wrong_points_outside_dropped(p_target, p_source, n_target):
    A, b = system(p_target, p_source, n_target)
    near = b > 0
    w, v = solved(A[near], b[near])
    return build(rodrigues(w), v)


def wrong_six_pairs_demanded(p_target, p_source, n):
    return right_least_squares(p_target, p_source, n) if len(n) >= 6 else np.eye(4)


def wrong_one_pair_is_none(p_target, p_source, n):
    return right_least_squares(p_target, p_source, n) if len(n) > 1 else np.eye(4)
