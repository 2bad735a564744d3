"""What students hand in for pose_from_homography."""

import numpy as np

NAMED = {
    "wrong_positive_scale": "sign as it came",
    "wrong_no_svd": "not orthonormal",
    "wrong_cross_swapped": "mirrored",
    "wrong_forgot_scale_of_t": "t unscaled",
    "wrong_unit_t": "t of length one",
    "wrong_inverse": "inverted",
    "wrong_forgot_k": "without k",
    "wrong_rows": "transposed",
}


def four(R, t):
    T = np.eye(4)
    T[:3, :3], T[:3, 3] = R, t
    return T


def parts(K, H):
    A = np.linalg.inv(K) @ H
    s = 1 / np.linalg.norm(A[:, 0])
    if A[2, 2] < 0:
        s = -s
    return s * A[:, 0], s * A[:, 1], s * A[:, 2]


def nearest(Q):
    U, _, Vt = np.linalg.svd(Q)
    return U @ np.diag([1, 1, np.linalg.det(U @ Vt)]) @ Vt


def right_zhang(K, H):
    r1, r2, t = parts(K, H)
    return four(nearest(np.column_stack([r1, r2, np.cross(r1, r2)])), t)


def right_mean_scale(K, H):
    A = np.linalg.solve(K, H)
    A /= (np.linalg.norm(A[:, 0]) + np.linalg.norm(A[:, 1])) / 2
    A *= np.sign(A[2, 2])
    return four(nearest(np.c_[A[:, :2], np.cross(A[:, 0], A[:, 1])]), A[:, 2])


def right_r3_from_unit(K, H):
    r1, r2, t = parts(K, H)
    r3 = np.cross(r1, r2)
    r3 /= np.linalg.norm(r3)
    U, _, Vt = np.linalg.svd(np.stack([r1, r2, r3], axis=1))
    return np.vstack([np.hstack([U @ Vt, t.reshape(3, 1)]), [0, 0, 0, 1]])


def right_svd_of_two_columns(K, H):
    A = np.linalg.inv(K) @ H
    U, s, Vt = np.linalg.svd(A[:, :2], full_matrices=False)
    Q = U @ Vt
    scale = s.mean()
    if A[2, 2] < 0:
        Q, scale = -Q, -scale
    return four(np.column_stack([Q, np.cross(Q[:, 0], Q[:, 1])]), A[:, 2] / scale)


def wrong_positive_scale(K, H):
    A = np.linalg.inv(K) @ H
    A /= np.linalg.norm(A[:, 0])
    r1, r2, t = A.T
    return four(nearest(np.column_stack([r1, r2, np.cross(r1, r2)])), t)


def wrong_no_svd(K, H):
    r1, r2, t = parts(K, H)
    return four(np.column_stack([r1, r2, np.cross(r1, r2)]), t)


def wrong_cross_swapped(K, H):
    r1, r2, t = parts(K, H)
    U, _, Vt = np.linalg.svd(np.column_stack([r1, r2, np.cross(r2, r1)]))
    return four(U @ Vt, t)


def wrong_forgot_scale_of_t(K, H):
    r1, r2, _ = parts(K, H)
    t = np.linalg.inv(K) @ H[:, 2]
    return four(nearest(np.column_stack([r1, r2, np.cross(r1, r2)])), t if t[2] > 0 else -t)


def wrong_unit_t(K, H):
    r1, r2, t = parts(K, H)
    return four(nearest(np.column_stack([r1, r2, np.cross(r1, r2)])), t / np.linalg.norm(t))


def wrong_inverse(K, H):
    r1, r2, t = parts(K, H)
    return np.linalg.inv(four(nearest(np.column_stack([r1, r2, np.cross(r1, r2)])), t))


def wrong_forgot_k(K, H):
    r1, r2, t = parts(np.eye(3), H)
    return four(nearest(np.column_stack([r1, r2, np.cross(r1, r2)])), t)


def wrong_rows(K, H):
    r1, r2, t = parts(K, H)
    return four(nearest(np.array([r1, r2, np.cross(r1, r2)])), t)


def wrong_in_place(K, H):
    H /= np.linalg.norm(H)
    r1, r2, t = parts(K, H)
    return four(nearest(np.column_stack([r1, r2, np.cross(r1, r2)])), t)


def wrong_front_side_only(K, H):
    T = right_zhang(K, H)
    if T[2, 2] < 0:
        T[:3, 1:3] *= -1
    return T


def wrong_no_skew(K, H):
    return right_zhang(K * [[1, 0, 1], [1, 1, 1], [1, 1, 1]], H)


def wrong_two_metres_away_at_most(K, H):
    T = right_zhang(K, H)
    T[2, 3] = min(T[2, 3], 2.0)
    return T


def wrong_ten_centimetres_away_at_least(K, H):
    T = right_zhang(K, H)
    T[2, 3] = max(T[2, 3], 0.1)
    return T


def wrong_small_homography_is_none(K, H):
    return right_zhang(K, H) if np.linalg.norm(H) > 1e-3 else np.eye(4)
