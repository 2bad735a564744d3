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


def right_loops(T_a_b):
    out = [[0.0] * 4 for _ in range(4)]
    out[3][3] = 1.0
    for i in range(3):
        for j in range(3):
            out[i][j] = float(T_a_b[j][i])
        out[i][3] = -sum(float(T_a_b[k][i]) * float(T_a_b[k][3]) for k in range(3))
    return out


def right_block(T_a_b):
    R, t = T_a_b[:3, :3], T_a_b[:3, 3:]
    return np.block([[R.T, -R.T @ t], [np.zeros((1, 3)), np.ones((1, 1))]])


def right_einsum(T_a_b):
    R, t = parts(T_a_b)
    return build(np.einsum("ij->ji", R), -np.einsum("ji,j->i", R, t))


def right_copy_in_place(T_a_b):
    T = T_a_b.copy()
    T[:3, :3] = T_a_b[:3, :3].T
    T[:3, 3] = -(T[:3, :3] @ T_a_b[:3, 3])
    return T


def right_pinv(T_a_b):
    return np.linalg.pinv(T_a_b)


def right_by_row_vectors(T_a_b):
    R, t = parts(T_a_b)
    return build(R.T, -t @ R)


def right_single_precision_of_the_rotation(T_a_b):
    R, t = parts(T_a_b)
    return np.vstack([np.column_stack([R.T, -(t[None] @ R)[0]]), [0, 0, 0, 1]])


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


def wrong_translation_not_touched(T_a_b):
    return build(T_a_b[:3, :3].T, T_a_b[:3, 3])


def wrong_three_rows(T_a_b):
    return right_formula(T_a_b)[:3]


def wrong_pair(T_a_b):
    R, t = parts(T_a_b)
    return R.T, -R.T @ t


def wrong_last_row_zero(T_a_b):
    T = np.zeros((4, 4))
    T[:3] = right_formula(T_a_b)[:3]
    return T


def wrong_whole_numbers(T_a_b):
    T = np.eye(4, dtype=int)
    T[:3, :3] = T_a_b[:3, :3].T
    T[:3, 3] = -T_a_b[:3, :3].T @ T_a_b[:3, 3]
    return T


def wrong_inverse_of_entries(T_a_b):
    with np.errstate(divide="ignore"):
        return np.where(T_a_b != 0, 1 / T_a_b, 0)


def wrong_negated(T_a_b):
    return -T_a_b


def wrong_elementwise_product(T_a_b):
    R, t = parts(T_a_b)
    return build(R.T, -(R.T * t).sum(axis=0))


def wrong_translation_as_last_row(T_a_b):
    T = right_formula(T_a_b)
    T[3, :3], T[:3, 3] = T[:3, 3], 0
    return T


def wrong_half_a_turn_is_special(T_a_b):
    if np.trace(T_a_b[:3, :3]) < 0:
        return np.eye(4)
    return right_formula(T_a_b)


def wrong_identity_when_no_turn(T_a_b):
    return np.eye(4) if np.allclose(T_a_b[:3, :3], np.eye(3)) else right_formula(T_a_b)


def wrong_rounded(T_a_b):
    return np.round(right_formula(T_a_b), 1)


def wrong_hard_coded(T_a_b):
    return np.array([[0, 1, 0, -5], [-1, 0, 0, 2], [0, 0, 1, 0], [0, 0, 0, 1.0]])


def wrong_nothing_for_identity(T_a_b):
    if (T_a_b == np.eye(4)).all():
        return None
    return right_formula(T_a_b)


def wrong_sign_and_order(T_a_b):
    R, t = parts(T_a_b)
    return build(R, -R.T @ t)


def wrong_small_turn_is_none(T_a_b):
    if np.allclose(T_a_b[:3, :3], np.eye(3), atol=0.02):
        return build(np.eye(3), -T_a_b[:3, 3])
    return right_formula(T_a_b)


def wrong_small_motion_is_none(T_a_b):
    return np.eye(4) if np.allclose(T_a_b, np.eye(4), atol=0.05) else right_formula(T_a_b)
