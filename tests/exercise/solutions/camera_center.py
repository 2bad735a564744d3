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


def right_einsum(T):
    return -np.einsum("ki,k->i", T[:3, :3], T[:3, 3])


def right_homogeneous(T):
    C = np.linalg.solve(T, np.array([0, 0, 0, 1.0]))
    return C[:3] / C[3]


def right_least_squares(T):
    return np.linalg.lstsq(T[:3, :3], -T[:3, 3], rcond=None)[0]


# wrong ---------------------------------------------------------------------------------------------------------------


def wrong_inverse_of_nothing(T):
    return [float(x) for x in T[:3, 3]]


def wrong_negative_column(T):
    return 0 - np.array(T)[:3, 3]


def wrong_forward_product(T):
    return -np.dot(T[:3, :3], T[:3, 3])


def wrong_no_minus(T):
    return T[:3, 3] @ T[:3, :3]


def wrong_in_place(T):
    T[:3, 3] *= -1
    return T[:3, :3].T @ T[:3, 3]


def wrong_viewing_direction(T):
    return T[2, :3]


def wrong_nan_for_the_identity(T):
    C = -T[:3, :3].T @ T[:3, 3]
    with np.errstate(invalid="ignore"):
        return C / np.linalg.norm(C) * np.linalg.norm(C)


def wrong_rotation_ignored_if_symmetric(T):
    if np.allclose(T[:3, :3], T[:3, :3].T):
        return -T[:3, 3]
    return -T[:3, :3].T @ T[:3, 3]
