"""What students hand in for eight_point."""

import numpy as np

NAMED = {
    "wrong_transposed": "transposed",
    "wrong_kron_swapped": "transposed",
    "wrong_raw": "raw pixels",
    "wrong_raw_eigh": "raw pixels",
    "wrong_no_rank_no_normalising": "raw pixels",
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


def right_unit_box(a, b):
    if len(a) < 8:
        raise ValueError

    def N(p):
        lo, hi = p.min(0), p.max(0)
        s = 2 / (hi - lo).max()
        return np.array([[s, 0, -s * (lo + hi)[0] / 2], [0, s, -s * (lo + hi)[1] / 2], [0, 0, 1]])

    T, S = N(a), N(b)
    return S.T @ two(null(h(a) @ T.T, h(b) @ S.T)) @ T


def right_rms_scale(a, b):
    if len(a) < 8:
        raise ValueError("need 8")

    def N(p):
        m = p.mean(0)
        s = np.sqrt(2 / ((p - m) ** 2).sum(1).mean())
        return np.array([[s, 0, -s * m[0]], [0, s, -s * m[1]], [0, 0, 1]])

    T, S = N(a), N(b)
    return S.T @ two(null(h(a) @ T.T, h(b) @ S.T)) @ T


def right_loop_rows(a, b):
    if a.shape[0] < 8:
        raise ValueError("at least eight")
    T, S = nrm(a), nrm(b)
    rows = []
    for p, q in zip(a, b):
        x, y, _ = T @ [p[0], p[1], 1]
        s, t, _ = S @ [q[0], q[1], 1]
        rows.append([s * x, s * y, s, t * x, t * y, t, x, y, 1])
    w, V = np.linalg.eigh(np.transpose(rows) @ np.array(rows))
    F = V[:, np.argmin(w)].reshape(3, 3)
    return S.T @ two(F) @ T


def right_smallest_by_argmin(a, b):
    T, S = nrm(a), nrm(b)
    F = null(h(a) @ T.T, h(b) @ S.T)
    U, s, Vt = np.linalg.svd(F)
    s[np.argmin(s)] = 0
    return S.T @ (U * s) @ Vt @ T


def right_transposed_equations(a, b):
    T, S = nrm(a), nrm(b)
    G = two(null(h(b) @ S.T, h(a) @ T.T))
    return (T.T @ G @ S).T


def right_solved_by_qr(a, b):
    T, S = nrm(a), nrm(b)
    A = np.einsum("ni,nj->nij", h(b) @ S.T, h(a) @ T.T).reshape(len(a), 9)
    R = np.linalg.qr(A, mode="r")
    return S.T @ two(np.linalg.svd(R, full_matrices=True)[2][-1].reshape(3, 3)) @ T


def right_coordinates_and_matrix_apart(a, b):
    if len(a) < 8:
        raise ValueError("fewer than 8")
    (ma, sa), (mb, sb) = (
        (p.mean(0), np.sqrt(2) / np.linalg.norm(p - p.mean(0), axis=1).mean()) for p in (a, b)
    )
    F = two(null(h((a - ma) * sa), h((b - mb) * sb)))
    back = [
        np.array([[s, 0, -s * m[0]], [0, s, -s * m[1]], [0, 0, 1]]) for m, s in ((ma, sa), (mb, sb))
    ]
    return back[1].T @ F @ back[0]


def wrong_transposed(a, b):
    return right_plain(a, b).T


def wrong_kron_swapped(a, b):
    T1, T2 = nrm(a), nrm(b)
    x, y = h(a) @ T1.T, h(b) @ T2.T
    A = np.array([np.kron(p, q) for p, q in zip(x, y)])
    return T1.T @ two(np.linalg.svd(A)[2][-1].reshape(3, 3)) @ T2


def wrong_raw(a, b):
    if len(a) < 8:
        raise ValueError
    return two(null(h(a), h(b)))


def wrong_raw_eigh(a, b):
    if len(a) < 8:
        raise ValueError
    A = np.array([np.kron(q, p) for p, q in zip(h(a), h(b))])
    return two(np.linalg.svd(A, full_matrices=True)[2][8].reshape(3, 3))


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


def wrong_first_singular_vector(a, b):
    T1, T2 = nrm(a), nrm(b)
    A = np.array([np.kron(q, p) for p, q in zip(h(a) @ T1.T, h(b) @ T2.T)])
    return T2.T @ two(np.linalg.svd(A)[2][0].reshape(3, 3)) @ T1


def wrong_column_of_vt(a, b):
    T1, T2 = nrm(a), nrm(b)
    A = np.array([np.kron(q, p) for p, q in zip(h(a) @ T1.T, h(b) @ T2.T)])
    return T2.T @ two(np.linalg.svd(A)[2][:, -1].reshape(3, 3)) @ T1


def wrong_first_eight_only(a, b):
    return right_plain(a[:8], b[:8])


def wrong_reshaped_in_columns(a, b):
    T1, T2 = nrm(a), nrm(b)
    return T2.T @ two(null(h(a) @ T1.T, h(b) @ T2.T).T) @ T1


def wrong_one_similarity_for_both(a, b):
    T1 = nrm(a)
    return nrm(b).T @ two(null(h(a) @ T1.T, h(b) @ T1.T)) @ T1


def wrong_no_rank_no_normalising(a, b):
    if len(a) < 8:
        raise ValueError
    return null(h(a), h(b))


def wrong_only_centred(a, b):
    if len(a) < 8:
        raise ValueError

    def N(p):
        m = p.mean(0)
        return np.array([[1, 0, -m[0]], [0, 1, -m[1]], [0, 0, 1.0]])

    T1, T2 = N(a), N(b)
    return T2.T @ two(null(h(a) @ T1.T, h(b) @ T2.T)) @ T1


def wrong_one_equation_missing(a, b):
    T1, T2 = nrm(a), nrm(b)
    x, y = h(a) @ T1.T, h(b) @ T2.T
    A = np.array([np.kron(q, p) for p, q in zip(x, y)])
    A[:, 8] = 0
    return T2.T @ two(np.linalg.svd(A)[2][-1].reshape(3, 3)) @ T1


def wrong_drops_two(a, b):
    T1, T2 = nrm(a), nrm(b)
    U, S, V = np.linalg.svd(null(h(a) @ T1.T, h(b) @ T2.T))
    S[1:] = 0
    return T2.T @ U @ np.diag(S) @ V @ T1


def wrong_uv_swapped(a, b):
    return right_plain(a[:, ::-1], b[:, ::-1])


def wrong_identity(a, b):
    return np.eye(3)


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
