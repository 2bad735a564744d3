"""What students hand in for eikonal_update."""

import numpy as np

NAMED = {
    "wrong_manhattan": "smaller and h",
    "wrong_mean": "mean and h",
    "wrong_formula_alone": "no fallback",
    "wrong_clipped": "clipped root",
    "wrong_minus_root": "smaller root",
    "wrong_h_is_one": "spacing of one",
    "wrong_max_fallback": "larger fallback",
    "wrong_only_equal": "smaller and h",
}


def right_where(a, b, h):
    with np.errstate(invalid="ignore"):
        both = (a + b + np.sqrt(2 * h**2 - (a - b) ** 2)) / 2
        return np.where(np.abs(a - b) < h, both, np.minimum(a, b) + h)


def right_loop(a, b, h):
    out = []
    for x, y in zip(a, b, strict=True):
        low, high = min(x, y), max(x, y)
        u = low + h
        if u > high:
            u = (low + high + np.sqrt(2 * h * h - (high - low) ** 2)) / 2
        out.append(u)
    return np.array(out)


def right_quadratic(a, b, h):
    u = np.minimum(a, b) + h
    k = np.abs(a - b) < h
    B, C = -(a[k] + b[k]), (a[k] ** 2 + b[k] ** 2 - h * h) / 2
    u[k] = (-B + np.sqrt(B * B - 4 * C)) / 2
    return u


def right_clip(a, b, h):
    low = np.minimum(a, b)
    d = np.minimum(np.maximum(a, b) - low, h)
    return low + (d + np.sqrt(2 * h**2 - d**2)) / 2


def right_mask(a, b, h):
    u = np.empty_like(a)
    one = ~(np.abs(a - b) < h)
    u[one] = np.minimum(a, b)[one] + h
    s = a[~one] + b[~one]
    u[~one] = 0.5 * (s + np.sqrt(s * s - 2 * (a[~one] ** 2 + b[~one] ** 2 - h * h)))
    return u


def right_list(a, b, h):
    return right_loop(a, b, h).tolist()


def right_roots(a, b, h):
    out = np.minimum(a, b) + h
    for k in range(len(a)):
        if abs(a[k] - b[k]) < h:
            x, y = a[k] / h, b[k] / h
            out[k] = h * max(np.roots([2, -2 * (x + y), x * x + y * y - 1]).real)
    return out


def right_sorted(a, b, h):
    low, high = np.sort(np.stack([a, b]), axis=0)
    step = np.full(len(a), float(h))
    near = high - low < h
    d = (high - low)[near]
    step[near] = d / 2 + np.sqrt(h * h / 2 - d * d / 4)
    return low + step


def right_vectorized(a, b, h):
    def one(x, y):
        return (x + y + (2 * h * h - (x - y) ** 2) ** 0.5) / 2 if abs(x - y) < h else min(x, y) + h

    return np.vectorize(one, otypes=[float])(a, b)


def wrong_manhattan(a, b, h):
    return np.array([min(x, y) + h for x, y in zip(a, b, strict=True)])


def wrong_mean(a, b, h):
    u = np.minimum(a, b) + h
    k = np.abs(a - b) < h
    u[k] = (a[k] + b[k]) / 2 + h
    return u


def wrong_formula_alone(a, b, h):
    with np.errstate(invalid="ignore"):
        return 0.5 * (a + b + np.sqrt(2 * h**2 - (a - b) ** 2))


def wrong_clipped(a, b, h):
    a, b = np.where(np.isinf(a), 1e9, a), np.where(np.isinf(b), 1e9, b)
    return 0.5 * (a + b + np.sqrt(np.clip(2 * h**2 - (a - b) ** 2, 0, None)))


def wrong_minus_root(a, b, h):
    u = np.minimum(a, b) + h
    k = np.abs(a - b) < h
    u[k] = (a[k] + b[k] - np.sqrt(2 * h**2 - (a[k] - b[k]) ** 2)) / 2
    return u


def wrong_h_is_one(a, b, h):
    return right_where(a, b, 1.0)


def wrong_max_fallback(a, b, h):
    with np.errstate(invalid="ignore"):
        both = (a + b + np.sqrt(2 * h**2 - (a - b) ** 2)) / 2
        high = np.maximum(a, b)
        high = np.where(np.isinf(high), np.minimum(a, b), high)
        return np.where(np.abs(a - b) < h, both, high + h)


def wrong_euclid(a, b, h):
    return np.minimum(a, b) + h / np.sqrt(2)


def wrong_h_not_squared(a, b, h):
    u = np.minimum(a, b) + h
    k = np.abs(a - b) < h
    u[k] = (a[k] + b[k] + np.sqrt(np.abs(2 * h - (a[k] - b[k]) ** 2))) / 2
    return u


def wrong_one_h(a, b, h):
    u = np.minimum(a, b) + h
    k = np.abs(a - b) < h
    u[k] = (a[k] + b[k] + np.sqrt(h**2 - (a[k] - b[k]) ** 2)) / 2
    return u


def wrong_not_halved(a, b, h):
    u = np.minimum(a, b) + h
    k = np.abs(a - b) < h
    u[k] = a[k] + b[k] + np.sqrt(2 * h**2 - (a[k] - b[k]) ** 2)
    return u


def wrong_larger(a, b, h):
    high = np.maximum(a, b)
    return np.where(np.isinf(high), np.minimum(a, b), high) + h


def wrong_fallback_without_h(a, b, h):
    u = np.minimum(a, b).copy()
    k = np.abs(a - b) < h
    u[k] = (a[k] + b[k] + np.sqrt(2 * h**2 - (a[k] - b[k]) ** 2)) / 2
    return u


def wrong_only_equal(a, b, h):
    return np.where(a == b, np.minimum(a, b) + h / np.sqrt(2), np.minimum(a, b) + h)


def wrong_fallback_from_root_two(a, b, h):
    with np.errstate(invalid="ignore"):
        both = (a + b + np.sqrt(2 * h**2 - (a - b) ** 2)) / 2
        return np.where(np.abs(a - b) < np.sqrt(2) * h, both, np.minimum(a, b) + h)


def wrong_inf_as_zero(a, b, h):
    return right_where(np.where(np.isinf(a), 0.0, a), np.where(np.isinf(b), 0.0, b), h)


def wrong_nan_as_zero(a, b, h):
    return np.nan_to_num(wrong_formula_alone(a, b, h), nan=0.0, posinf=0.0)


def wrong_sum_under_the_root(a, b, h):
    u = np.minimum(a, b) + h
    k = np.abs(a - b) < h
    u[k] = (a[k] + b[k] + np.sqrt(2 * h**2 + (a[k] - b[k]) ** 2)) / 2
    return u


def wrong_signed_difference(a, b, h):
    with np.errstate(invalid="ignore"):
        both = (a + b + np.sqrt(2 * h**2 - (a - b) ** 2)) / 2
        return np.where(a - b < h, both, b + h)


def wrong_in_place(a, b, h):
    a, b = np.minimum(a, b, out=a), np.maximum(a, b)
    return right_where(a, b, h)


def wrong_zero_means_unknown(a, b, h):
    a, b = np.where(a == 0, np.inf, a), np.where(b == 0, np.inf, b)
    u = right_where(a, b, h)
    return np.where(np.isinf(u), 0.0 + h, u)


def wrong_far_is_infinite(a, b, h):
    return np.minimum(right_where(a, b, h), 1e4)
