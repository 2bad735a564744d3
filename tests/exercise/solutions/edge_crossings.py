"""What students hand in for edge_crossings."""

import numpy as np

NAMED = {
    "wrong_middle": "middles",
    "wrong_swapped": "swapped",
    "wrong_sum": "divided by the sum",
    "wrong_walked": "walked",
    "wrong_sign": "outwards",
    "wrong_squares": "squared",
    "wrong_no_start": "without the start",
}


def right_determinant(p_a, p_b, f_a, f_b):
    return (f_b[:, None] * p_a - f_a[:, None] * p_b) / (f_b - f_a)[:, None]


def right_from_b(p_a, p_b, f_a, f_b):
    s = f_b / (f_b - f_a)
    return p_b + (p_a - p_b) * s.reshape(-1, 1)


def right_interp(p_a, p_b, f_a, f_b):
    answer = np.zeros(p_a.shape)
    for k in range(len(p_a)):
        order = [0, 1] if f_a[k] < f_b[k] else [1, 0]
        f, ends = np.array([f_a[k], f_b[k]])[order], np.stack([p_a[k], p_b[k]])[order]
        answer[k] = [np.interp(0.0, f, ends[:, axis]) for axis in range(3)]
    return answer


def right_ratio(p_a, p_b, f_a, f_b):
    with np.errstate(divide="ignore"):
        t = 1 / (1 + np.abs(f_b) / np.abs(f_a))
    return (1 - t[:, None]) * p_a + t[:, None] * p_b


# wrong ---------------------------------------------------------------------------------------------------------------


def wrong_middle(p_a, p_b, f_a, f_b):
    return 0.5 * (p_a + p_b)


def wrong_swapped(p_a, p_b, f_a, f_b):
    return p_b + (f_a / (f_a - f_b))[:, None] * (p_a - p_b)


def wrong_sum(p_a, p_b, f_a, f_b):
    return p_a + (f_a / (f_a + f_b))[:, None] * (p_b - p_a)


def wrong_walked(p_a, p_b, f_a, f_b):
    way = p_b - p_a
    return p_a + np.abs(f_a)[:, None] * way / np.linalg.norm(way, axis=1)[:, None]


def wrong_sign(p_a, p_b, f_a, f_b):
    return p_a - (f_a / (f_a - f_b))[:, None] * (p_b - p_a)


def wrong_squares(p_a, p_b, f_a, f_b):
    return p_a + (f_a**2 / (f_a**2 + f_b**2))[:, None] * (p_b - p_a)


def wrong_no_start(p_a, p_b, f_a, f_b):
    return (f_a / (f_a - f_b))[:, None] * (p_b - p_a)


def wrong_in_place(p_a, p_b, f_a, f_b):
    p_b -= p_a
    return p_a + (f_a / (f_a - f_b))[:, None] * p_b
