"""What students hand in for essential_to_poses."""

import numpy as np

NAMED = {
    "wrong_no_signs": "signs not mended",
    "wrong_v": "v for its transpose",
    "wrong_w_twice": "one rotation",
    "wrong_one_t": "one direction",
    "wrong_t_of_v": "t from v",
    "wrong_inverted": "inverses",
    "wrong_transposed_r": "transposed rotations",
    "wrong_long_t": "t scaled",
}

W = np.array([[0, -1, 0], [1, 0, 0], [0, 0, 1.0]])


def pack(Rs, ts):
    out = np.zeros((4, 4, 4))
    out[:, 3, 3] = 1
    for k, (R, t) in enumerate((R, t) for R in Rs for t in ts):
        out[k, :3, :3], out[k, :3, 3] = R, t
    return out


def fixed(E):
    U, s, Vt = np.linalg.svd(E)
    if np.linalg.det(U) < 0:
        U = -U
    if np.linalg.det(Vt) < 0:
        Vt = -Vt
    return U, s, Vt


def right_plain(E):
    U, _, Vt = fixed(E)
    return pack([U @ W @ Vt, U @ W.T @ Vt], [U[:, 2], -U[:, 2]])


def right_other_order(E):
    return right_plain(E)[::-1].copy()


def right_scaled_first(E):
    return right_plain(E / np.linalg.norm(E))


def right_negative(E):
    return right_plain(-E)


def wrong_no_signs(E):
    U, _, Vt = np.linalg.svd(E)
    return pack([U @ W @ Vt, U @ W.T @ Vt], [U[:, 2], -U[:, 2]])


def wrong_v(E):
    U, _, Vt = fixed(E)
    return pack([U @ W @ Vt.T, U @ W.T @ Vt.T], [U[:, 2], -U[:, 2]])


def wrong_w_twice(E):
    U, _, Vt = fixed(E)
    return pack([U @ W @ Vt, U @ W @ Vt], [U[:, 2], -U[:, 2]])


def wrong_one_t(E):
    U, _, Vt = fixed(E)
    return pack([U @ W @ Vt, U @ W.T @ Vt], [U[:, 2], U[:, 2]])


def wrong_t_of_v(E):
    U, _, Vt = fixed(E)
    return pack([U @ W @ Vt, U @ W.T @ Vt], [Vt[2], -Vt[2]])


def wrong_inverted(E):
    return np.linalg.inv(right_plain(E))


def wrong_transposed_r(E):
    U, _, Vt = fixed(E)
    return pack([(U @ W @ Vt).T, (U @ W.T @ Vt).T], [U[:, 2], -U[:, 2]])


def wrong_long_t(E):
    U, s, Vt = fixed(E)
    return pack([U @ W @ Vt, U @ W.T @ Vt], [s[0] * U[:, 2], -s[0] * U[:, 2]])


def wrong_last_row_missing(E):
    Ts = right_plain(E)
    Ts[:, 3] = 0
    return Ts


def wrong_no_rotation_with_noise(E):
    E = E / np.sqrt(0.5 * np.trace(E @ E.T))
    t = np.linalg.svd(E)[0][:, 2]
    cofactors = np.stack([np.cross(E[1], E[2]), np.cross(E[2], E[0]), np.cross(E[0], E[1])])
    X = np.array([[0, -t[2], t[1]], [t[2], 0, -t[0]], [-t[1], t[0], 0]])
    Ts = np.tile(np.eye(4), (4, 1, 1))
    Ts[:2, :3, :3], Ts[2:, :3, :3] = cofactors - X @ E, cofactors + X @ E
    Ts[:, :3, 3] = t, -t, t, -t
    return Ts


def wrong_small_matrix_refused(E):
    if np.linalg.norm(E) < 1e-4:
        raise ValueError("zero matrix")
    return right_plain(E)


def wrong_t_a_little_long_with_noise(E):
    out = right_plain(E)
    s = np.linalg.svd(E)[1]
    out[:, :3, 3] *= 2 * s[0] / (s[0] + s[1])
    return out
