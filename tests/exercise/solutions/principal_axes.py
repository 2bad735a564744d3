"""What students hand in for principal_axes."""

import numpy as np

NAMED = {
    "wrong_eigh_order": "ascending",
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


def right_svd(p):
    if not len(p):
        raise ValueError("empty")
    _, _, Vt = np.linalg.svd(p - p.mean(0), full_matrices=True)
    return proper(Vt.T)


def right_np_cov(p):
    if len(p) == 0:
        raise ValueError
    C = np.cov(p, rowvar=False, bias=True)
    w, V = np.linalg.eigh(C)
    order = sorted(range(3), key=lambda k: -w[k])
    return proper(V[:, order])


def right_svd_of_covariance(p):
    U, _, _ = np.linalg.svd(scatter(p))
    return U * np.sign(np.linalg.det(U)) if np.linalg.det(U) < 0 else U


# wrong ---------------------------------------------------------------------------------------------------------------


def wrong_eigh_order(p):
    _, V = np.linalg.eigh(scatter(p))
    return proper(V)


def wrong_svd_of_raw_points(p):
    if len(p) == 0:
        raise ValueError("no points")
    return proper(np.linalg.svd(p)[2].T)


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


def wrong_no_error(p):
    if len(p) == 0:
        return np.eye(3)
    return right_eigh(p)


def wrong_in_place(p):
    if len(p) == 0:
        raise ValueError("no points")
    p -= p.mean(axis=0)
    return proper(np.linalg.eigh(p.T @ p)[1][:, ::-1])


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
