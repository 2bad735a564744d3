"""What students hand in for triangulate."""

import numpy as np

NAMED = {
    "wrong_no_division": "not divided",
    "wrong_rows_and_columns": "u and v swapped",
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


def right_signs_turned(P, Q, a, b):
    return solve(-P, 2 * Q, a, b)


def right_least_squares(P, Q, a, b):
    out = []
    for p, q in zip(a, b):
        A = np.array(rows(P, p) + rows(Q, q))
        out.append(np.linalg.lstsq(A[:, :3], -A[:, 3], rcond=None)[0])
    return np.array(out)


def right_normalised_matrices(P, Q, a, b):
    return solve(P / np.linalg.norm(P), Q / np.linalg.norm(Q), a, b)


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


def wrong_in_front_of_the_world(P_first, P_second, uv_first, uv_second):
    p = right_loop(P_first, P_second, uv_first, uv_second)
    return np.where(p[:, 2:] < 0, -p, p)
