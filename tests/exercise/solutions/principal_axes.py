"""What students hand in for principal_axes."""

import numpy as np

NAMED = {
    "wrong_eigh_order": "ascending",
    "wrong_eigh_order_other_signs": "ascending",
    "wrong_about_the_origin": "not centred",
    "wrong_svd_of_raw_points": "not centred",
    "wrong_handedness_left": "left handed",
    "wrong_svd_handedness": "left handed",
    "wrong_z_scores": "standardised",
    "wrong_raw_moments": "moments cancel",
}


def scatter(p):
    if len(p) == 0:
        raise ValueError("no points")
    q = p - p.mean(axis=0)
    return q.T @ q


def proper(V):
    V = np.array(V, float)
    if np.linalg.det(V) < 0:
        V[:, 2] = -V[:, 2]
    return V


def right_eigh(p):
    _w, V = np.linalg.eigh(scatter(p))
    return proper(V[:, ::-1])


def right_cross(p):
    _w, V = np.linalg.eigh(scatter(p))
    a, b = V[:, 2], V[:, 1]
    return np.stack([a, b, np.cross(a, b)], axis=1)


def right_svd(p):
    if not len(p):
        raise ValueError("empty")
    _, _, Vt = np.linalg.svd(p - p.mean(0), full_matrices=True)
    return proper(Vt.T)


def right_negated_if_left(p):
    _w, V = np.linalg.eigh(scatter(p))
    V = V[:, [2, 1, 0]]
    return -V if np.linalg.det(V) < 0 else V


def right_eig(p):
    w, V = np.linalg.eig(scatter(p))
    V, _ = np.linalg.qr(np.real(V[:, np.argsort(np.real(w))[::-1]]))
    return proper(V)


def right_np_cov(p):
    if len(p) == 0:
        raise ValueError
    C = np.cov(p, rowvar=False, bias=True)
    w, V = np.linalg.eigh(C)
    order = sorted(range(3), key=lambda k: -w[k])
    return proper(V[:, order])


def right_sum_of_outer(p):
    if p.shape[0] < 1:
        raise ValueError("need points")
    c = sum(p) / len(p)
    C = np.zeros((3, 3))
    for x in p:
        C += np.outer(x - c, x - c)
    _values, vectors = np.linalg.eigh(C)
    axes = np.fliplr(vectors)
    return axes * [1, 1, np.linalg.det(axes)]


def right_svd_of_covariance(p):
    U, _, _ = np.linalg.svd(scatter(p))
    return U * np.sign(np.linalg.det(U)) if np.linalg.det(U) < 0 else U


def right_negative_eigenvalues(p):
    _w, V = np.linalg.eigh(-scatter(p))
    return np.c_[V[:, 0], V[:, 1], np.cross(V[:, 0], V[:, 1])]


def right_jacobi(p):
    A, V = scatter(p), np.eye(3)
    for _ in range(30):
        for i, j in ((0, 1), (0, 2), (1, 2)):
            t = 0.5 * np.arctan2(2 * A[i, j], A[i, i] - A[j, j])
            G = np.eye(3)
            G[i, i] = G[j, j] = np.cos(t)
            G[i, j], G[j, i] = -np.sin(t), np.sin(t)
            A, V = G.T @ A @ G, V @ G
    return proper(V[:, np.argsort(-np.diag(A))])


def right_list(p):
    return right_eigh(p).tolist()


# wrong ---------------------------------------------------------------------------------------------------------------


def wrong_eigh_order(p):
    _, V = np.linalg.eigh(scatter(p))
    return proper(V)


def wrong_eigh_order_other_signs(p):
    _, V = np.linalg.eigh(scatter(p))
    V = proper(V)
    return V * [-1, 1, -1]


def wrong_about_the_origin(p):
    if len(p) == 0:
        raise ValueError("no points")
    return proper(np.linalg.eigh(p.T @ p)[1][:, ::-1])


def wrong_svd_of_raw_points(p):
    if len(p) == 0:
        raise ValueError("no points")
    return proper(np.linalg.svd(p)[2].T)


def wrong_vt(p):
    if len(p) == 0:
        raise ValueError("no points")
    return proper(np.linalg.svd(p - p.mean(0))[2].T).T


def wrong_eigenvectors_in_rows(p):
    return right_cross(p).T


def wrong_handedness_left(p):
    return np.linalg.eigh(scatter(p))[1][:, ::-1]


def wrong_svd_handedness(p):
    if len(p) == 0:
        raise ValueError("no points")
    return np.linalg.svd(p - p.mean(0))[2].T


def wrong_z_scores(p):
    if len(p) == 0:
        raise ValueError("no points")
    q = p - p.mean(0)
    s = q.std(0)
    z = q / np.where(s > 0, s, 1)
    return proper(np.linalg.eigh(z.T @ z)[1][:, ::-1])


def wrong_raw_moments(p):
    if len(p) == 0:
        raise ValueError("no points")
    m = p.mean(0)
    return proper(np.linalg.eigh(p.T @ p / len(p) - np.outer(m, m))[1][:, ::-1])


def wrong_cov_by_expectation(p):
    if len(p) == 0:
        raise ValueError("no points")
    m = np.mean(p, axis=0)
    C = np.mean(p[:, :, None] * p[:, None, :], axis=0) - m[:, None] * m[None, :]
    V = np.linalg.eigh(C)[1]
    return np.stack([V[:, 2], V[:, 1], np.cross(V[:, 2], V[:, 1])], axis=1)


def wrong_absolute(p):
    return np.abs(right_eigh(p))


def wrong_median_centre(p):
    if len(p) == 0:
        raise ValueError("no points")
    q = p - np.median(p, axis=0)
    return proper(np.linalg.eigh(q.T @ q)[1][:, ::-1])


def wrong_first_point_centre(p):
    if len(p) == 0:
        raise ValueError("no points")
    q = p - p[0]
    return proper(np.linalg.eigh(q.T @ q)[1][:, ::-1])


def wrong_scaled_by_sigma(p):
    w, V = np.linalg.eigh(scatter(p))
    return proper(V[:, ::-1]) * np.sqrt(np.maximum(w[::-1], 0) / len(p))


def wrong_cov_of_rows(p):
    if len(p) == 0:
        raise ValueError("no points")
    return proper(np.linalg.svd(np.cov(p)[:3, :3])[0])


def wrong_middle_last(p):
    V = np.linalg.eigh(scatter(p))[1]
    return proper(V[:, [2, 0, 1]])


def wrong_no_error(p):
    if len(p) == 0:
        return np.eye(3)
    return right_eigh(p)


def wrong_in_place(p):
    if len(p) == 0:
        raise ValueError("no points")
    p -= p.mean(axis=0)
    return proper(np.linalg.eigh(p.T @ p)[1][:, ::-1])


def wrong_returns_both(p):
    w, V = np.linalg.eigh(scatter(p))
    return w[::-1], proper(V[:, ::-1])


def wrong_identity(p):
    if len(p) == 0:
        raise ValueError("no points")
    return np.eye(3)


def wrong_three_points_at_least(p):
    return right_svd(p) if len(p) > 2 or not len(p) else np.eye(3)


def wrong_four_points_at_least(p):
    if len(p) in (2, 3):
        raise ValueError("too few points")
    return right_svd(p)


def wrong_equal_points_have_no_frame(p):
    return np.zeros((3, 3)) if len(p) > 1 and np.ptp(p, axis=0).max() == 0 else right_svd(p)


def wrong_no_spread_along_x(p):
    q = p - p.mean(axis=0) if len(p) else p
    return np.eye(3) if len(p) > 1 and np.abs(q[:, 0]).max() < 1e-12 else right_svd(p)
