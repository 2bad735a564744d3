"""What students hand in for triangulate."""

import numpy as np

NAMED = {
    "wrong_no_division": "not divided",
    "wrong_rows_and_columns": "u and v swapped",
    "wrong_rows_of_p_confused": "u and v swapped",
    "wrong_pictures_mixed": "cameras exchanged",
    "wrong_plus": "sign of equations",
    "wrong_largest": "first vector",
    "wrong_column": "column of vt",
    "wrong_third": "divided by the third",
}


def rows(P, uv):
    u, v = uv
    return [u * P[2] - P[0], v * P[2] - P[1]]


def solve(P, Q, a, b, pick=lambda A: np.linalg.svd(A)[2][-1]):
    out = []
    for p, q in zip(a, b):
        X = pick(np.array(rows(P, p) + rows(Q, q)))
        out.append(X[:3] / X[3])
    return np.array(out)


def right_loop(P, Q, a, b):
    return solve(P, Q, a, b)


def right_eigh(P, Q, a, b):
    def pick(A):
        A = A / np.linalg.norm(A, axis=1)[:, None]
        return np.linalg.eigh(A.T @ A)[1][:, 0]

    return solve(P, Q, a, b, pick)


def right_batched(P, Q, a, b):
    A = np.stack(
        [
            a[:, :1] * P[2] - P[0],
            a[:, 1:] * P[2] - P[1],
            b[:, :1] * Q[2] - Q[0],
            b[:, 1:] * Q[2] - Q[1],
        ],
        1,
    )
    X = np.linalg.svd(A)[2][:, 3]
    return X[:, :3] / X[:, 3:]


def right_signs_turned(P, Q, a, b):
    return solve(-P, 2 * Q, a, b)


def right_least_squares(P, Q, a, b):
    out = []
    for p, q in zip(a, b):
        A = np.array(rows(P, p) + rows(Q, q))
        out.append(np.linalg.lstsq(A[:, :3], -A[:, 3], rcond=None)[0])
    return np.array(out)


def right_normal_equations(P, Q, a, b):
    out = []
    for p, q in zip(a, b):
        A = np.array(rows(P / np.linalg.norm(P[2, :3]), p) + rows(Q / np.linalg.norm(Q[2, :3]), q))
        out.append(np.linalg.solve(A[:, :3].T @ A[:, :3], -A[:, :3].T @ A[:, 3]))
    return np.array(out)


def right_six_rows(P, Q, a, b):
    def pick_rows(P, p):
        u, v = p
        S = np.array([[0, -1, v], [1, 0, -u], [-v, u, 0]])
        return S[:2] @ P

    out = []
    for p, q in zip(a, b):
        X = np.linalg.svd(np.vstack([pick_rows(P, p), pick_rows(Q, q)]))[2][-1]
        out.append(X[:3] / X[3])
    return np.array(out)


def right_midpoints(P, Q, a, b):
    def ray(P, uv):
        M = P[:, :3]
        c = -np.linalg.solve(M, P[:, 3])
        d = np.linalg.solve(M, np.append(uv, 1))
        return c, d / np.linalg.norm(d)

    out = []
    for p, q in zip(a, b):
        (c, d), (e, f) = ray(P, p), ray(Q, q)
        s, t = np.linalg.lstsq(np.column_stack([d, -f]), e - c, rcond=None)[0]
        out.append((c + s * d + e + t * f) / 2)
    return np.array(out)


def right_normalised_matrices(P, Q, a, b):
    return solve(P / np.linalg.norm(P), Q / np.linalg.norm(Q), a, b)


def right_stacked_by_camera(P, Q, a, b):
    out = np.empty((len(a), 3))
    for i in range(len(a)):
        M = np.zeros((4, 4))
        M[:2] = np.outer(a[i], P[2]) - P[:2]
        M[2:] = np.outer(b[i], Q[2]) - Q[:2]
        x = np.linalg.svd(M)[2][3]
        out[i] = x[:3] / x[3]
    return out


def wrong_no_division(P, Q, a, b):
    return np.array(
        [np.linalg.svd(np.array(rows(P, p) + rows(Q, q)))[2][-1][:3] for p, q in zip(a, b)]
    )


def wrong_rows_and_columns(P, Q, a, b):
    return solve(P, Q, a[:, ::-1], b[:, ::-1])


def wrong_pictures_mixed(P, Q, a, b):
    return solve(P, Q, b, a)


def wrong_plus(P, Q, a, b):
    out = []
    for (u, v), (s, t) in zip(a, b):
        A = np.array([u * P[2] + P[0], v * P[2] + P[1], s * Q[2] + Q[0], t * Q[2] + Q[1]])
        X = np.linalg.svd(A)[2][-1]
        out.append(X[:3] / X[3])
    return np.array(out)


def wrong_largest(P, Q, a, b):
    return solve(P, Q, a, b, lambda A: np.linalg.svd(A)[2][0])


def wrong_column(P, Q, a, b):
    return solve(P, Q, a, b, lambda A: np.linalg.svd(A)[2][:, -1])


def wrong_third(P, Q, a, b):
    out = []
    for p, q in zip(a, b):
        X = np.linalg.svd(np.array(rows(P, p) + rows(Q, q)))[2][-1]
        out.append(X[:3] / X[2])
    return np.array(out)


def wrong_rows_of_p_confused(P, Q, a, b):
    out = []
    for (u, v), (s, t) in zip(a, b):
        A = np.array([u * P[2] - P[1], v * P[2] - P[0], s * Q[2] - Q[1], t * Q[2] - Q[0]])
        X = np.linalg.svd(A)[2][-1]
        out.append(X[:3] / X[3])
    return np.array(out)


def wrong_columns_of_p(P, Q, a, b):
    out = []
    for (u, v), (s, t) in zip(a, b):
        A = np.array([u * P[0] - P[2], v * P[1] - P[2], s * Q[0] - Q[2], t * Q[1] - Q[2]])
        X = np.linalg.svd(A)[2][-1]
        out.append(X[:3] / X[3])
    return np.array(out)


def wrong_first_camera_only(P, Q, a, b):
    return solve(P, P, a, a)


def wrong_first_point_only(P, Q, a, b):
    return np.repeat(solve(P, Q, a[:1], b[:1]), len(a), axis=0)


def wrong_u_matrix(P, Q, a, b):
    return solve(P, Q, a, b, lambda A: np.linalg.svd(A)[0][:, -1])


def wrong_absolute_depth(P, Q, a, b):
    X = solve(P, Q, a, b)
    X[:, 0] = np.abs(X[:, 0])
    return X


def wrong_negative(P, Q, a, b):
    return -solve(P, Q, a, b)


def wrong_ones(P, Q, a, b):
    return np.ones((len(a), 3))


def wrong_as_if_parallel(P, Q, a, b):
    f, base = P[0, 0] / P[2, 2], abs(Q[0, 3] / Q[0, 0])
    z = f * base / (a[:, 0] - b[:, 0])
    return np.column_stack([(a - P[:2, 2] / P[2, 2]) / f * z[:, None], z])


def wrong_camera_frame_of_second(P, Q, a, b):
    X = solve(P, Q, a, b)
    K = Q[:, :3] @ np.linalg.inv(Q[:, :3])
    return np.column_stack([X, np.ones(len(X))]) @ (K @ np.linalg.inv(P[:, :3]) @ Q).T


def wrong_second_camera_assumed_to_be_scaled(P, Q, a, b):
    return solve(P / P[2, 2], Q / Q[2, 3], a, b) * Q[2, 3]


def wrong_rounded(P, Q, a, b):
    return np.round(solve(P, Q, a, b), 1)


def wrong_missing_equation(P, Q, a, b):
    return solve(P, Q, a, b, lambda A: np.linalg.svd(A[:2])[2][-1])


def wrong_in_front_of_the_world(P_first, P_second, uv_first, uv_second):
    p = right_loop(P_first, P_second, uv_first, uv_second)
    return np.where(p[:, 2:] < 0, -p, p)
