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


def right_nerf_cumprod(density, spacing):
    alpha = 1 - np.exp(-density * spacing)
    ones = np.ones((alpha.shape[0], 1))
    return alpha * np.cumprod(np.hstack([ones, 1 - alpha]), axis=1)[:, :-1]


def right_loop_over_samples(density, spacing):
    T = np.ones(len(density))
    out = np.empty_like(density, dtype=float)
    for k in range(density.shape[1]):
        a = 1 - np.exp(-density[:, k] * spacing)
        out[:, k] = T * a
        T = T * (1 - a)
    return out


def right_diff(density, spacing):
    T = np.exp(-spacing * np.cumsum(np.pad(density, ((0, 0), (1, 0))), axis=1))
    return -np.diff(T, axis=1)


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


def right_roll_with_first_set(density, spacing):
    total = np.roll(np.cumsum(density * spacing, axis=1), 1, axis=1)
    total[:, 0] = 0
    return np.exp(-total) * (1.0 - np.exp(-density * spacing))


def right_accumulate(density, spacing):
    from itertools import accumulate

    rows = []
    for ray in density:
        passes = [np.exp(-d * spacing) for d in ray]
        light = [1.0, *accumulate(passes, lambda a, b: a * b)]
        rows.append([T * (1 - k) for T, k in zip(light, passes)])
    return np.array(rows)


def right_multiply_accumulate(density, spacing):
    passes = np.exp(-np.asarray(density) * spacing)
    T = np.ones_like(passes)
    T[:, 1:] = np.multiply.accumulate(passes[:, :-1], axis=1)
    return T - T * passes


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


def wrong_spacing_in_alpha_only(density, spacing):
    return _T(density) * (1 - np.exp(-density * spacing))


def wrong_spacing_in_transmittance_only(density, spacing):
    return _T(density * spacing) * (1 - np.exp(-density))


def wrong_divided_by_spacing(density, spacing):
    x = density / spacing
    return _T(x) * (1 - np.exp(-x))


def wrong_rolled(density, spacing):
    x = density * spacing
    return np.roll(np.exp(-np.cumsum(x, 1)), 1, axis=1) * (1 - np.exp(-x))


def wrong_previous_only(density, spacing):
    a = 1 - np.exp(-density * spacing)
    passed = np.hstack([np.ones((len(a), 1)), 1 - a[:, :-1]])
    return a * passed


def wrong_density_weighted(density, spacing):
    s = density.sum(1, keepdims=True)
    return density / np.where(s > 0, s, 1)


def wrong_times_density(density, spacing):
    return _T(density * spacing) * density


def wrong_sign(density, spacing):
    x = density * spacing
    return np.exp(np.minimum(np.cumsum(x, 1) - x, 50)) * (1 - np.exp(-x))


def wrong_base_two(density, spacing):
    x = density * spacing * np.log(2)
    return _T(x) * (1 - np.exp(-x))
