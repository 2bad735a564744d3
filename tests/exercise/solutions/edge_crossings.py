"""What students hand in for edge_crossings."""

import numpy as np

NAMED = {
    "wrong_middle": "middles",
    "wrong_swapped": "swapped",
    "wrong_swapped_weights": "swapped",
    "wrong_sum": "divided by the sum",
    "wrong_walked": "walked",
    "wrong_sign": "outwards",
    "wrong_squares": "squared",
    "wrong_no_start": "without the start",
}


def right_lerp(p_a, p_b, f_a, f_b):
    t = f_a / (f_a - f_b)
    return p_a + t[:, None] * (p_b - p_a)


def right_weights(p_a, p_b, f_a, f_b):
    w_a, w_b = np.abs(f_b), np.abs(f_a)
    return (w_a[:, None] * p_a + w_b[:, None] * p_b) / (w_a + w_b)[:, None]


def right_determinant(p_a, p_b, f_a, f_b):
    return (f_b[:, None] * p_a - f_a[:, None] * p_b) / (f_b - f_a)[:, None]


def right_from_b(p_a, p_b, f_a, f_b):
    s = f_b / (f_b - f_a)
    return p_b + (p_a - p_b) * s.reshape(-1, 1)


def right_loop(p_a, p_b, f_a, f_b):
    out = np.empty_like(p_a)
    for k in range(len(p_a)):
        t = (0 - f_a[k]) / (f_b[k] - f_a[k])
        out[k] = (1 - t) * p_a[k] + t * p_b[k]
    return out


def right_ordered(p_a, p_b, f_a, f_b):
    turn = (f_a > f_b)[:, None]
    low, high = np.where(turn, p_b, p_a), np.where(turn, p_a, p_b)
    f_low, f_high = np.minimum(f_a, f_b), np.maximum(f_a, f_b)
    return low + (high - low) * (-f_low / (f_high - f_low))[:, None]


def right_bisection(p_a, p_b, f_a, f_b):
    low, high = np.zeros(len(f_a)), np.ones(len(f_a))
    for _ in range(60):
        t = (low + high) / 2
        f = f_a + t * (f_b - f_a)
        before = f * np.where(f_a == 0, -f_b, f_a) > 0
        low, high = np.where(before, t, low), np.where(before, high, t)
    return p_a + low[:, None] * (p_b - p_a)


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


def wrong_swapped_weights(p_a, p_b, f_a, f_b):
    w_a, w_b = np.abs(f_a), np.abs(f_b)
    return (w_a[:, None] * p_a + w_b[:, None] * p_b) / (w_a + w_b)[:, None]


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


def wrong_other_sum(p_a, p_b, f_a, f_b):
    return p_a + (f_b / (f_a + f_b))[:, None] * (p_b - p_a)


def wrong_nearer_end(p_a, p_b, f_a, f_b):
    return np.where((np.abs(f_a) < np.abs(f_b))[:, None], p_a, p_b)


def wrong_root(p_a, p_b, f_a, f_b):
    t = np.sqrt(np.abs(f_a)) / (np.sqrt(np.abs(f_a)) + np.sqrt(np.abs(f_b)))
    return p_a + t[:, None] * (p_b - p_a)


def wrong_only_negative_first(p_a, p_b, f_a, f_b):
    t = np.where(f_a < 0, f_a / (f_a - f_b), 0.5)
    return p_a + t[:, None] * (p_b - p_a)


def wrong_epsilon(p_a, p_b, f_a, f_b):
    return p_a + (f_a / (f_a - f_b + 1e-3))[:, None] * (p_b - p_a)


def wrong_clipped(p_a, p_b, f_a, f_b):
    return p_a + np.clip(f_a / (f_a - f_b), 0.25, 0.75)[:, None] * (p_b - p_a)


def wrong_rounded(p_a, p_b, f_a, f_b):
    return p_a + np.round(f_a / (f_a - f_b), 1)[:, None] * (p_b - p_a)


def wrong_broadcast(p_a, p_b, f_a, f_b):
    return p_a + f_a / (f_a - f_b) * (p_b - p_a)


def wrong_start(p_a, p_b, f_a, f_b):
    return p_a.copy()


def wrong_one_for_all(p_a, p_b, f_a, f_b):
    return p_a + np.mean(f_a / (f_a - f_b)) * (p_b - p_a)


def wrong_in_place(p_a, p_b, f_a, f_b):
    p_b -= p_a
    return p_a + (f_a / (f_a - f_b))[:, None] * p_b


def wrong_flat(p_a, p_b, f_a, f_b):
    return f_a / (f_a - f_b)


def wrong_times_the_length(p_a, p_b, f_a, f_b):
    way = p_b - p_a
    return p_a + (f_a / (f_a - f_b) * np.linalg.norm(way, axis=1))[:, None] * way


def wrong_nearly_zero_is_an_end(p_a, p_b, f_a, f_b):
    t = np.where(np.abs(f_a) < 1e-4, 0.0, np.where(np.abs(f_b) < 1e-4, 1.0, f_a / (f_a - f_b)))
    return p_a + t[:, None] * (p_b - p_a)
