"""What students hand in for circle_linearised."""

import numpy as np

NAMED = {
    "wrong_algebraic": "squared distances",
    "wrong_sign_of_J": "sign of the jacobian",
    "wrong_long_rows": "not divided",
    "wrong_inside_positive": "turned round",
    "wrong_r_flipped": "residuals turned round",
    "wrong_abs": "absolute distances",
    "wrong_plus_one": "sign of the radius",
    "wrong_plus_direction": "sign of the center",
    "wrong_no_radius": "radius forgotten",
    "wrong_nan_at_centre": "divided by zero",
}


def right_hypot(circle, p):
    dx, dy = p[:, 0] - circle[0], p[:, 1] - circle[1]
    d = np.hypot(dx, dy)
    s = np.where(d == 0, 1, d)
    return d - circle[2], np.stack([-dx / s, -dy / s, -np.ones(len(p))], axis=1)


def right_divide_where(circle, p):
    v = p - circle[:2]
    d = np.sqrt((v**2).sum(1))
    n = np.divide(v, d[:, None], out=np.zeros_like(v), where=d[:, None] > 0)
    return d - circle[2], np.hstack([-n, np.full((len(p), 1), -1.0)])


def right_complex(circle, p):
    z = p[:, 0] + 1j * p[:, 1] - (circle[0] + 1j * circle[1])
    d = abs(z)
    n = np.where(d > 0, z / np.where(d > 0, d, 1), 0)
    return d - circle[2], np.column_stack([-n.real, -n.imag, -np.ones(len(p))])


def right_angles(circle, p):
    x, y, R = circle
    dx, dy = p[:, 0] - x, p[:, 1] - y
    d = np.sqrt(dx * dx + dy * dy)
    angle = np.arctan2(dy, dx)
    J = -np.array([np.cos(angle) * (d > 0), np.sin(angle) * (d > 0), np.ones_like(d)]).T
    return d - R, J


def wrong_algebraic(circle, p):
    v = p - circle[:2]
    return (v**2).sum(1) - circle[2] ** 2, np.column_stack(
        [-2 * v, np.full(len(p), -2 * circle[2])]
    )


def wrong_sign_of_J(circle, p):
    r, J = right_hypot(circle, p)
    return r, -J


def wrong_long_rows(circle, p):
    v = p - circle[:2]
    return np.linalg.norm(v, axis=1) - circle[2], np.column_stack([-v, -np.ones(len(p))])


def wrong_inside_positive(circle, p):
    r, J = right_hypot(circle, p)
    return -r, -J


def wrong_r_flipped(circle, p):
    r, J = right_hypot(circle, p)
    return -r, J


def wrong_abs(circle, p):
    r, J = right_hypot(circle, p)
    return abs(r), J


def wrong_plus_one(circle, p):
    r, J = right_hypot(circle, p)
    J[:, 2] = 1
    return r, J


def wrong_plus_direction(circle, p):
    r, J = right_hypot(circle, p)
    J[:, :2] *= -1
    return r, J


def wrong_no_radius(circle, p):
    r, J = right_hypot(circle, p)
    return r + circle[2], J


def wrong_nan_at_centre(circle, p):
    v = p - circle[:2]
    d = np.linalg.norm(v, axis=1)
    return d - circle[2], np.column_stack([-v / d[:, None], -np.ones(len(p))])


def wrong_changes_points(circle, p):
    p -= circle[:2]
    return right_hypot(np.array([0, 0, circle[2]]), p)


def wrong_near_the_centre_is_at_it(circle, p):
    r, J = right_hypot(circle, p)
    J[np.linalg.norm(p - circle[:2], axis=1) < 1e-4, :2] = 0
    return r, J


def wrong_a_little_added_to_the_length(circle, p):
    v = p - circle[:2]
    d = np.linalg.norm(v, axis=1)
    return d - circle[2], np.column_stack([-v / (d + 1e-9)[:, None], -np.ones(len(p))])
