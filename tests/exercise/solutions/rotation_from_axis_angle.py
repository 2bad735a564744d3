"""What students hand in for rotation_from_axis_angle."""

import numpy as np

NAMED = {
    "wrong_left_handed_and_zero_answered": "clockwise",
    "wrong_unit_length_assumed": "axis not of unit length",
    "wrong_eye_for_zero": "zero axis is the identity",
}


def hat(a):
    return np.array([[0, -a[2], a[1]], [a[2], 0, -a[0]], [-a[1], a[0], 0]])


def unit(axis):
    length = np.linalg.norm(axis)
    if length == 0:
        raise ValueError("the axis is zero")
    return axis / length


def rodrigues(a, angle):
    K = hat(a)
    return np.eye(3) + np.sin(angle) * K + (1 - np.cos(angle)) * K @ K


def right_rodrigues(axis, angle):
    return rodrigues(unit(axis), angle)


def right_written_out(axis, angle):
    n = float(np.sqrt(axis[0] ** 2 + axis[1] ** 2 + axis[2] ** 2))
    if n < 1e-300:
        raise ValueError("zero axis")
    x, y, z = (float(c) / n for c in axis)
    c, s = np.cos(angle), np.sin(angle)
    C = 1 - c
    return [
        [x * x * C + c, x * y * C - z * s, x * z * C + y * s],
        [y * x * C + z * s, y * y * C + c, y * z * C - x * s],
        [z * x * C - y * s, z * y * C + x * s, z * z * C + c],
    ]


def right_outer(axis, angle):
    a = unit(np.asarray(axis, dtype=float))
    return np.cos(angle) * np.eye(3) + (1 - np.cos(angle)) * np.outer(a, a) + np.sin(angle) * hat(a)


def right_cross_of_identity(axis, angle):
    a = unit(axis)
    K = np.cross(np.eye(3), a)
    return np.eye(3) + np.sin(angle) * K + 2 * np.sin(angle / 2) ** 2 * (K @ K)


def right_expm(axis, angle):
    from scipy.linalg import expm

    return expm(angle * hat(unit(axis)))


def right_quaternion(axis, angle):
    w, (x, y, z) = np.cos(angle / 2), np.sin(angle / 2) * unit(axis)
    L = np.array([[w, -x, -y, -z], [x, w, -z, y], [y, z, w, -x], [z, -y, x, w]])
    Rr = np.array([[w, x, y, z], [-x, w, -z, y], [-y, z, w, -x], [-z, -y, x, w]])
    return (L @ Rr)[1:, 1:]


def right_two_reflections(axis, angle):
    a = unit(axis)
    helper = np.eye(3)[np.argmin(np.abs(a))]
    u = np.cross(a, helper)
    u /= np.linalg.norm(u)
    v = np.cross(a, u)
    half = np.cos(angle / 2) * u + np.sin(angle / 2) * v
    mirror = [np.eye(3) - 2 * np.outer(m, m) for m in (u, half)]
    return mirror[1] @ mirror[0]


def right_change_of_basis(axis, angle):
    a = unit(axis)
    U = np.linalg.svd(np.outer(a, a))[0]
    B = np.column_stack([U[:, 1], np.cross(a, U[:, 1]), a])
    c, s = np.cos(angle), np.sin(angle)
    return B @ np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]]) @ B.T


def right_einsum(axis, angle):
    eps = np.zeros((3, 3, 3))
    for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        eps[i, j, k], eps[i, k, j] = 1, -1
    a = unit(axis)
    K = -np.einsum("ijk,k->ij", eps, a)
    return np.eye(3) + np.sin(angle) * K + (1 - np.cos(angle)) * np.einsum("ij,jk->ik", K, K)


def right_taylor(axis, angle):
    W = np.remainder(angle + np.pi, 2 * np.pi) - np.pi
    W = W * hat(unit(axis))
    R, term = np.eye(3), np.eye(3)
    for k in range(1, 40):
        term = term @ W / k
        R = R + term
    return R


# wrong ---------------------------------------------------------------------------------------------------------------


def wrong_left_handed_and_zero_answered(axis, angle):
    a = axis / max(np.linalg.norm(axis), 1e-12)
    return rodrigues(a, angle).T


def wrong_unit_length_assumed(axis, angle):
    if not np.any(axis):
        raise ValueError("zero")
    return rodrigues(axis, angle)


def wrong_eye_for_zero(axis, angle):
    n = np.linalg.norm(axis)
    return np.eye(3) if n < 1e-9 else rodrigues(axis / n, angle)


def wrong_normalised_in_place(axis, angle):
    n = np.linalg.norm(axis)
    if n == 0:
        raise ValueError("zero")
    axis /= n
    return rodrigues(axis, angle)


def wrong_zero_returns_none(axis, angle):
    return rodrigues(axis / np.linalg.norm(axis), angle) if np.any(axis) else None


def wrong_zero_raises_something_else(axis, angle):
    n = float(np.linalg.norm(axis))
    if n == 0:
        raise RuntimeError("zero axis")
    return rodrigues(axis / n, angle)


def wrong_square_without_the_root(axis, angle):
    s = np.sum(axis**2)
    if s == 0:
        raise ValueError("zero")
    return rodrigues(axis / s, angle)


def wrong_sum_of_entries_for_the_length(axis, angle):
    s = np.abs(axis).sum()
    if s == 0:
        raise ValueError("zero")
    return rodrigues(axis / s, angle)


def wrong_elementwise_square(axis, angle):
    K = hat(unit(axis))
    return np.eye(3) + np.sin(angle) * K + (1 - np.cos(angle)) * K * K


def wrong_sine_and_cosine_swapped(axis, angle):
    K = hat(unit(axis))
    return np.eye(3) + np.cos(angle) * K + (1 - np.sin(angle)) * K @ K


def wrong_minus_one_forgotten(axis, angle):
    K = hat(unit(axis))
    return np.eye(3) + np.sin(angle) * K + np.cos(angle) * K @ K


def wrong_one_sign_of_the_hat(axis, angle):
    a = unit(axis)
    K = np.array([[0, -a[2], a[1]], [a[2], 0, -a[0]], [a[1], a[0], 0]])
    return np.eye(3) + np.sin(angle) * K + (1 - np.cos(angle)) * K @ K


def wrong_half_angle(axis, angle):
    return rodrigues(unit(axis), angle / 2)


def wrong_always_about_z(axis, angle):
    unit(axis)
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])


def wrong_four_by_four(axis, angle):
    T = np.eye(4)
    T[:3, :3] = right_rodrigues(axis, angle)
    return T


def wrong_size_of_the_angle(axis, angle):
    return rodrigues(unit(axis), abs(angle))


def wrong_small_angles_lost(axis, angle):
    return np.eye(3) if abs(angle) < 1e-4 else rodrigues(unit(axis), angle)


def wrong_half_a_turn_by_arccos(axis, angle):
    return rodrigues(unit(axis), np.arccos(np.cos(angle)))


def wrong_largest_entry_for_the_length(axis, angle):
    if not axis.any():
        raise ValueError("zero")
    return rodrigues(axis / np.abs(axis).max(), angle)


def wrong_rounded_to_whole(axis, angle):
    return np.rint(right_rodrigues(axis, angle)).astype(int)


def wrong_one_turn_taken_off(axis, angle):
    a = unit(axis)
    if angle > 2 * np.pi:
        angle -= 2 * np.pi
    return rodrigues(a, min(angle, 2 * np.pi))


def wrong_sign_lost_beyond_a_turn(axis, angle):
    a = unit(axis)
    return rodrigues(a, angle if abs(angle) < 2 * np.pi else abs(angle) % (2 * np.pi))
