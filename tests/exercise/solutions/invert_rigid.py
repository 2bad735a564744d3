"""What students hand in for invert_rigid."""

import numpy as np

NAMED = {
    "wrong_minus_t_in_a_loop": "negated translation",
    "wrong_whole_matrix_transposed": "all transposed",
    "wrong_forward_by_einsum": "translation turned forwards",
}


def parts(T):
    return T[:3, :3], T[:3, 3]


def build(R, t):
    T = np.eye(4)
    T[:3, :3], T[:3, 3] = R, t
    return T


def right_formula(T_a_b):
    R, t = parts(T_a_b)
    return build(R.T, -R.T @ t)


def right_inv(T_a_b):
    return np.linalg.inv(T_a_b)


def right_solve(T_a_b):
    return np.linalg.solve(T_a_b, np.eye(4))


def right_scipy(T_a_b):
    from scipy.spatial.transform import Rotation

    back = Rotation.from_matrix(T_a_b[:3, :3]).inv()
    return build(back.as_matrix(), -back.apply(T_a_b[:3, 3]))


# wrong ---------------------------------------------------------------------------------------------------------------


def wrong_minus_t_in_a_loop(T_a_b):
    out = np.eye(4)
    for i in range(3):
        out[i, :3] = T_a_b[:3, i]
        out[i, 3] = -T_a_b[i, 3]
    return out


def wrong_whole_matrix_transposed(T_a_b):
    return np.transpose(T_a_b).tolist()


def wrong_forward_by_einsum(T_a_b):
    R, t = parts(T_a_b)
    return build(R.T, -np.einsum("ij,j->i", R, t))


def wrong_transposed_view_written(T_a_b):
    T_a_b[:3, :3] = T_a_b[:3, :3].T.copy()
    T_a_b[:3, 3] = -T_a_b[:3, :3] @ T_a_b[:3, 3]
    return T_a_b


def wrong_identity_when_no_turn(T_a_b):
    return np.eye(4) if np.allclose(T_a_b[:3, :3], np.eye(3)) else right_formula(T_a_b)


def wrong_nothing_for_identity(T_a_b):
    if (T_a_b == np.eye(4)).all():
        return None
    return right_formula(T_a_b)


def wrong_small_turn_is_none(T_a_b):
    if np.allclose(T_a_b[:3, :3], np.eye(3), atol=0.02):
        return build(np.eye(3), -T_a_b[:3, 3])
    return right_formula(T_a_b)


def wrong_small_motion_is_none(T_a_b):
    return np.eye(4) if np.allclose(T_a_b, np.eye(4), atol=0.05) else right_formula(T_a_b)
