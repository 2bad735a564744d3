"""What students hand in for eight_point."""

import numpy as np

NAMED = {
    "wrong_transposed": "transposed",
    "wrong_raw": "raw pixels",
    "wrong_rank_three": "rank three",
    "wrong_inverse": "denormalised with inverses",
    "wrong_swapped_similarities": "similarities swapped",
    "wrong_still_normalised": "not denormalised",
    "wrong_no_transpose": "without transpose",
    "wrong_rank_last": "dropped in pixels",
}


def h(p):
    return np.column_stack([p, np.ones(len(p))])


def nrm(p):
    if len(p) < 8:
        raise ValueError("too few")
    m = p.mean(axis=0)
    s = np.sqrt(2) / np.sqrt(((p - m) ** 2).sum(axis=1)).mean()
    return np.array([[s, 0, -s * m[0]], [0, s, -s * m[1]], [0, 0, 1]])


def null(x, y):
    A = np.array([np.kron(q, p) for p, q in zip(x, y)])
    return np.linalg.svd(A)[2][-1].reshape(3, 3)


def two(F):
    U, S, V = np.linalg.svd(F)
    S[2] = 0
    return U @ np.diag(S) @ V


def right_plain(a, b):
    T1, T2 = nrm(a), nrm(b)
    return T2.T @ two(null(h(a) @ T1.T, h(b) @ T2.T)) @ T1


def wrong_f33(a, b):
    F = right_plain(a, b)
    return F / F[2, 2]


def right_negative_and_large(a, b):
    return -1000 * right_plain(a, b)


def right_smallest_by_argmin(a, b):
    T, S = nrm(a), nrm(b)
    F = null(h(a) @ T.T, h(b) @ S.T)
    U, s, Vt = np.linalg.svd(F)
    s[np.argmin(s)] = 0
    return S.T @ (U * s) @ Vt @ T


def right_solved_by_qr(a, b):
    T, S = nrm(a), nrm(b)
    A = np.einsum("ni,nj->nij", h(b) @ S.T, h(a) @ T.T).reshape(len(a), 9)
    R = np.linalg.qr(A, mode="r")
    return S.T @ two(np.linalg.svd(R, full_matrices=True)[2][-1].reshape(3, 3)) @ T


def wrong_transposed(a, b):
    return right_plain(a, b).T


def wrong_raw(a, b):
    if len(a) < 8:
        raise ValueError
    return two(null(h(a), h(b)))


def wrong_rank_three(a, b):
    T1, T2 = nrm(a), nrm(b)
    return T2.T @ null(h(a) @ T1.T, h(b) @ T2.T) @ T1


def wrong_inverse(a, b):
    T1, T2 = nrm(a), nrm(b)
    F = two(null(h(a) @ T1.T, h(b) @ T2.T))
    return np.linalg.inv(T2).T @ F @ np.linalg.inv(T1)


def wrong_swapped_similarities(a, b):
    T1, T2 = nrm(a), nrm(b)
    return T1.T @ two(null(h(a) @ T1.T, h(b) @ T2.T)) @ T2


def wrong_still_normalised(a, b):
    T1, T2 = nrm(a), nrm(b)
    return two(null(h(a) @ T1.T, h(b) @ T2.T))


def wrong_no_transpose(a, b):
    T1, T2 = nrm(a), nrm(b)
    return T2 @ two(null(h(a) @ T1.T, h(b) @ T2.T)) @ T1


def wrong_rank_last(a, b):
    return two(wrong_rank_three(a, b))


def wrong_accepts_seven(a, b):
    def N(p):
        m = p.mean(0)
        s = np.sqrt(2) / np.linalg.norm(p - m, axis=1).mean()
        return np.array([[s, 0, -s * m[0]], [0, s, -s * m[1]], [0, 0, 1]])

    T1, T2 = N(a), N(b)
    return T2.T @ two(null(h(a) @ T1.T, h(b) @ T2.T)) @ T1


def wrong_refuses_only_seven(a, b):
    return np.zeros((3, 3)) if len(a) < 7 else right_plain(a, b)


def wrong_nothing_gives_zeros(a, b):
    return right_plain(a, b) if len(a) else np.zeros((3, 3))
