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


def right_einsum(y):
    u = _n(y[:, :3])
    v = _n(y[:, 3:] - np.einsum("ni,ni->n", u, y[:, 3:])[:, None] * u)
    R = np.zeros((len(y), 3, 3))
    R[:, :, 0], R[:, :, 1], R[:, :, 2] = u, v, np.cross(u, v)
    return R


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


def right_third_first(y):
    a, b = y[:, :3], y[:, 3:]
    w = _n(np.cross(a, b))
    u = _n(a)
    return np.stack([u, np.cross(w, u), w], -1)


def right_without_first_normalising(y):
    a, b = y[:, :3], y[:, 3:]
    v = _dot(a, a) * b - _dot(a, b) * a
    return np.stack([_n(a), _n(v), np.cross(_n(a), _n(v))], axis=-1)


def right_cross_by_hand(y):
    u = y[:, 0:3] / np.sqrt((y[:, 0:3] ** 2).sum(axis=1))[:, None]
    v = y[:, 3:6] - (y[:, 3:6] * u).sum(axis=1)[:, None] * u
    v = v / np.sqrt((v**2).sum(axis=1))[:, None]
    w = np.stack(
        [
            u[:, 1] * v[:, 2] - u[:, 2] * v[:, 1],
            u[:, 2] * v[:, 0] - u[:, 0] * v[:, 2],
            u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0],
        ],
        axis=1,
    )
    return np.concatenate([u[:, :, None], v[:, :, None], w[:, :, None]], axis=2)


def right_rows_then_transposed(y):
    rows = y.reshape(-1, 2, 3)
    u = _n(rows[:, 0])
    v = _n(rows[:, 1] - _dot(rows[:, 1], u) * u)
    return np.stack([u, v, np.cross(u, v)], axis=1).transpose(0, 2, 1)


def right_one_at_a_time(y):
    def one(six):
        a, b = np.split(six, 2)
        u = a / np.linalg.norm(a)
        b = b - np.dot(u, b) * u
        v = b / np.linalg.norm(b)
        return np.column_stack((u, v, np.cross(u, v)))

    return np.stack([one(six) for six in y])


def right_cholesky(y):
    M = y.reshape(-1, 2, 3).swapaxes(1, 2)
    L = np.linalg.cholesky(M.swapaxes(1, 2) @ M)
    Q = np.linalg.solve(L, M.swapaxes(1, 2)).swapaxes(1, 2)
    return np.dstack([Q, np.cross(Q[:, :, 0], Q[:, :, 1])])


def right_twice_for_safety(y):
    u, v = _n(y[:, :3]), y[:, 3:]
    for _ in range(2):
        v = _n(v - _dot(u, v) * u)
    R = np.empty((y.shape[0], 3, 3))
    R[..., 0] = u
    R[..., 1] = v
    R[..., 2] = np.cross(u, v, axis=-1)
    return R


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


def wrong_normalised_over_the_batch(y):
    a = y[:, :3] / np.linalg.norm(y[:, :3])
    v = _n(y[:, 3:] - _dot(a, y[:, 3:]) * a)
    return np.stack([a, v, np.cross(a, v)], -1)


def wrong_added_the_projection(y):
    u = _n(y[:, :3])
    v = _n(y[:, 3:] + _dot(u, y[:, 3:]) * u)
    return np.stack([u, v, np.cross(u, v)], -1)


def wrong_third_from_b(y):
    u = _n(y[:, :3])
    v = _n(y[:, 3:] - _dot(u, y[:, 3:]) * u)
    return np.stack([u, v, np.cross(u, y[:, 3:])], -1)


def wrong_nearest_rotation(y):
    a, b = y[:, :3], y[:, 3:]
    U, _, Vt = np.linalg.svd(np.stack([a, b, np.cross(a, b)], -1))
    return U @ Vt


def wrong_sum_of_squares(y):
    a, b = y[:, :3], y[:, 3:]
    u = a / _dot(a, a)
    v = _n(b - _dot(u, b) * u)
    return np.stack([u, v, np.cross(u, v)], -1)


def wrong_swapped_columns(y):
    u = _n(y[:, :3])
    v = _n(y[:, 3:] - _dot(u, y[:, 3:]) * u)
    return np.stack([v, u, np.cross(v, u)], -1)


def wrong_first_row_only(y):
    u = _n(y[:1, :3])
    v = _n(y[:1, 3:] - _dot(u, y[:1, 3:]) * u)
    return np.repeat(np.stack([u, v, np.cross(u, v)], -1), len(y), axis=0)


def wrong_identity_third(y):
    u = _n(y[:, :3])
    v = _n(y[:, 3:] - _dot(u, y[:, 3:]) * u)
    return np.stack([u, v, np.tile([0.0, 0.0, 1.0], (len(y), 1))], -1)


def wrong_in_place(y):
    y[:, :3] /= np.linalg.norm(y[:, :3], axis=1, keepdims=True)
    u = y[:, :3]
    v = _n(y[:, 3:] - _dot(u, y[:, 3:]) * u)
    return np.stack([u, v, np.cross(u, v)], -1)
