"""What students hand in for rotation_from_six."""

import numpy as np

NAMED = {
    "wrong_no_gram_schmidt": "without gram and schmidt",
    "wrong_stacked_as_rows": "rows for columns",
    "wrong_cross_reversed": "crossed the wrong way",
    "wrong_projection_on_a": "projected on the long vector",
    "wrong_reshape_columns": "read in pairs",
    "wrong_v_kept_long": "second not normalised",
    "wrong_starts_with_b": "began with the second",
}


def _n(v):
    return v / np.linalg.norm(v, axis=-1, keepdims=True)


def _dot(a, b):
    return (a * b).sum(-1, keepdims=True)


def right_qr(y):
    M = np.stack([y[:, :3], y[:, 3:]], axis=2)
    Q, r = np.linalg.qr(M)
    Q = Q * np.sign(np.stack([r[:, 0, 0], r[:, 1, 1]], axis=1))[:, None]
    return np.concatenate([Q, np.cross(Q[:, :, 0], Q[:, :, 1])[:, :, None]], axis=2)


def right_projector(y):
    out = []
    for row in y:
        u = row[:3] / np.linalg.norm(row[:3])
        v = (np.eye(3) - np.outer(u, u)) @ row[3:]
        v /= np.linalg.norm(v)
        out.append(np.array([u, v, np.cross(u, v)]).T)
    return np.array(out)


def right_without_first_normalising(y):
    a, b = y[:, :3], y[:, 3:]
    v = _dot(a, a) * b - _dot(a, b) * a
    return np.stack([_n(a), _n(v), np.cross(_n(a), _n(v))], axis=-1)


def right_cholesky(y):
    M = y.reshape(-1, 2, 3).swapaxes(1, 2)
    L = np.linalg.cholesky(M.swapaxes(1, 2) @ M)
    Q = np.linalg.solve(L, M.swapaxes(1, 2)).swapaxes(1, 2)
    return np.dstack([Q, np.cross(Q[:, :, 0], Q[:, :, 1])])


def wrong_no_gram_schmidt(y):
    u, v = _n(y[:, :3]), _n(y[:, 3:])
    return np.stack([u, v, np.cross(u, v)], -1)


def wrong_stacked_as_rows(y):
    u = _n(y[:, :3])
    v = _n(y[:, 3:] - _dot(u, y[:, 3:]) * u)
    return np.stack([u, v, np.cross(u, v)], 1)


def wrong_cross_reversed(y):
    u = _n(y[:, :3])
    v = _n(y[:, 3:] - _dot(u, y[:, 3:]) * u)
    return np.stack([u, v, np.cross(v, u)], -1)


def wrong_projection_on_a(y):
    a, b = y[:, :3], y[:, 3:]
    u, v = _n(a), _n(b - _dot(a, b) * a)
    return np.stack([u, v, np.cross(u, v)], -1)


def wrong_reshape_columns(y):
    M = y.reshape(-1, 3, 2)
    u = _n(M[:, :, 0])
    v = _n(M[:, :, 1] - _dot(u, M[:, :, 1]) * u)
    return np.stack([u, v, np.cross(u, v)], -1)


def wrong_v_kept_long(y):
    u = _n(y[:, :3])
    v = y[:, 3:] - _dot(u, y[:, 3:]) * u
    return np.stack([u, v, np.cross(u, v)], -1)


def wrong_starts_with_b(y):
    v = _n(y[:, 3:])
    u = _n(y[:, :3] - _dot(v, y[:, :3]) * v)
    return np.stack([u, v, np.cross(u, v)], -1)


def wrong_in_place(y):
    y[:, :3] /= np.linalg.norm(y[:, :3], axis=1, keepdims=True)
    u = y[:, :3]
    v = _n(y[:, 3:] - _dot(u, y[:, 3:]) * u)
    return np.stack([u, v, np.cross(u, v)], -1)
