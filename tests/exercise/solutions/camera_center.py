"""What students hand in for camera_center."""

import numpy as np

NAMED = {
    "wrong_inverse_of_nothing": "t for the centre",
    "wrong_negative_column": "minus t for the centre",
    "wrong_forward_product": "turned forwards",
    "wrong_no_minus": "sign forgotten",
}


def right_formula(T):
    return -T[:3, :3].T @ T[:3, 3]


def right_inverse(T):
    return np.linalg.inv(T)[:3, 3]


def right_solve(T):
    return np.linalg.solve(T[:3, :3], -T[:3, 3])


def right_loop(T):
    return [-sum(float(T[k][i]) * float(T[k][3]) for k in range(3)) for i in range(3)]


def right_einsum(T):
    return -np.einsum("ki,k->i", T[:3, :3], T[:3, 3])


def right_row_vector(T):
    R, t = T[:3, :3], T[:3, 3]
    return -t @ R


def right_homogeneous(T):
    C = np.linalg.solve(T, np.array([0, 0, 0, 1.0]))
    return C[:3] / C[3]


def right_null_space(T):
    v = np.linalg.svd(T[:3])[2][-1]
    return v[:3] / v[3]


def right_least_squares(T):
    return np.linalg.lstsq(T[:3, :3], -T[:3, 3], rcond=None)[0]


def right_on_a_copy(T):
    T = T.copy()
    T[:3, 3] *= -1
    return T[:3, :3].T @ T[:3, 3]


def right_cramer(T):
    R, t = T[:3, :3], -T[:3, 3]
    out = []
    for i in range(3):
        M = R.copy()
        M[:, i] = t
        out.append(np.linalg.det(M) / np.linalg.det(R))
    return np.array(out)


# wrong ---------------------------------------------------------------------------------------------------------------


def wrong_inverse_of_nothing(T):
    return [float(x) for x in T[:3, 3]]


def wrong_negative_column(T):
    return 0 - np.array(T)[:3, 3]


def wrong_forward_product(T):
    return -np.dot(T[:3, :3], T[:3, 3])


def wrong_no_minus(T):
    return T[:3, 3] @ T[:3, :3]


def wrong_column_vector(T):
    return -T[:3, :3].T @ T[:3, 3:]


def wrong_homogeneous(T):
    return np.linalg.inv(T)[:, 3]


def wrong_in_place(T):
    T[:3, 3] *= -1
    return T[:3, :3].T @ T[:3, 3]


def wrong_elementwise(T):
    return -(T[:3, :3].T * T[:3, 3])[:, 0]


def wrong_last_row(T):
    return np.linalg.inv(T)[3, :3]


def wrong_viewing_direction(T):
    return T[2, :3]


def wrong_divided_by_length(T):
    C = -T[:3, :3].T @ T[:3, 3]
    return C / max(np.linalg.norm(C), 1e-12)


def wrong_nan_for_the_identity(T):
    C = -T[:3, :3].T @ T[:3, 3]
    with np.errstate(invalid="ignore"):
        return C / np.linalg.norm(C) * np.linalg.norm(C)


def wrong_axes_swapped(T):
    x, y, z = -T[:3, :3].T @ T[:3, 3]
    return np.array([x, -y, -z])


def wrong_rotation_ignored_if_symmetric(T):
    if np.allclose(T[:3, :3], T[:3, :3].T):
        return -T[:3, 3]
    return -T[:3, :3].T @ T[:3, 3]


def wrong_whole_numbers(T):
    return (-T[:3, :3].T @ T[:3, 3]).astype(int)


def wrong_swallowed(T):
    try:
        return -T[:3, :3].T @ T[3, :4]
    except ValueError:
        return np.zeros(3)


def wrong_hard_coded(T):
    return np.array([-5.0, 2.0, 0.0])


def wrong_matrix_returned(T):
    return np.linalg.inv(T)


def wrong_rounded_to_centimetres(T):
    return np.round(-T[:3, :3].T @ T[:3, 3], 1)


def wrong_nothing(T):
    R, t = T[:3, :3], T[:3, 3]
    C = -R.T @ t
