"""What students hand in for ray_weights."""

import numpy as np

NAMED = {
    "wrong_inclusive_product": "own sample included",
    "wrong_forgot_spacing": "no spacing",
    "wrong_linear_alpha": "linear share",
    "wrong_linear_with_exp_transmittance": "linear share behind exponentials",
    "wrong_alpha_only": "nothing hides",
    "wrong_reversed": "far to near",
    "wrong_sum_to_one": "normalised",
    "wrong_transmittance_only": "only what arrives",
    "wrong_axis": "over the rays",
}


def _T(x, axis=1):
    """Exclusive running sum, as light that is left."""
    return np.exp(-(np.cumsum(x, axis) - x))


def right_exclusive_sum(density, spacing):
    x = density * spacing
    return _T(x) * (1 - np.exp(-x))


def right_what_is_left(density, spacing):
    """Each sample takes its share of what the ones before did not take."""
    a = 1 - np.exp(-density * spacing)
    w = np.zeros(density.shape)
    for i in range(density.shape[1]):
        w[:, i] = a[:, i] * (1 - w[:, :i].sum(axis=1))
    return w


def right_triangle(density, spacing):
    s = density.shape[1]
    before = np.triu(np.ones((s, s)), 1)
    return np.exp(-spacing * density @ before) * (1 - np.exp(-spacing * density))


def right_transposed(density, spacing):
    depth = (density * spacing).T
    T = np.exp(-np.vstack([np.zeros(depth.shape[1]), np.cumsum(depth, axis=0)]))
    return (T[:-1] - T[1:]).T


def wrong_inclusive_product(density, spacing):
    alpha = 1 - np.exp(-density * spacing)
    return alpha * np.cumprod(1 - alpha, axis=1)


def wrong_forgot_spacing(density, spacing):
    return _T(density) * (1 - np.exp(-density))


def wrong_linear_alpha(density, spacing):
    a = density * spacing
    ones = np.ones((len(a), 1))
    return a * np.cumprod(np.hstack([ones, 1 - a]), axis=1)[:, :-1]


def wrong_linear_with_exp_transmittance(density, spacing):
    x = density * spacing
    return _T(x) * x


def wrong_alpha_only(density, spacing):
    return 1 - np.exp(-density * spacing)


def wrong_reversed(density, spacing):
    return right_exclusive_sum(density[:, ::-1], spacing)[:, ::-1]


def wrong_sum_to_one(density, spacing):
    w = right_exclusive_sum(density, spacing)
    s = w.sum(1, keepdims=True)
    return w / np.where(s > 0, s, 1)


def wrong_transmittance_only(density, spacing):
    return _T(density * spacing)


def wrong_axis(density, spacing):
    x = density * spacing
    return _T(x, 0) * (1 - np.exp(-x))
