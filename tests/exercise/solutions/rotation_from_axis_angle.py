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


def right_expm(axis, angle):
    from scipy.linalg import expm

    return expm(angle * hat(unit(axis)))


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


def wrong_small_angles_lost(axis, angle):
    return np.eye(3) if abs(angle) < 1e-4 else rodrigues(unit(axis), angle)


def wrong_one_turn_taken_off(axis, angle):
    a = unit(axis)
    if angle > 2 * np.pi:
        angle -= 2 * np.pi
    return rodrigues(a, min(angle, 2 * np.pi))


def wrong_sign_lost_beyond_a_turn(axis, angle):
    a = unit(axis)
    return rodrigues(a, angle if abs(angle) < 2 * np.pi else abs(angle) % (2 * np.pi))
