"""What students hand in for meet."""

import numpy as np

NAMED = {
    "wrong_divided": "divided by w",
    "wrong_slopes": "by slopes",
    "wrong_middle": "middle sign",
    "wrong_c_minus": "c on the right",
    "wrong_product": "entry by entry",
    "wrong_solver": "solved with nan",
    "wrong_difference": "difference",
}


def right_cross(lines_a, lines_b):
    return np.cross(lines_a, lines_b)


def right_columns(lines_a, lines_b):
    a1, b1, c1 = lines_a.T
    a2, b2, c2 = lines_b.T
    return np.stack([b1 * c2 - b2 * c1, c1 * a2 - c2 * a1, a1 * b2 - a2 * b1], axis=1)


def right_unit(lines_a, lines_b):
    x = np.cross(lines_a, lines_b)
    n = np.linalg.norm(x, axis=1, keepdims=True)
    return np.where(n > 1e-12, x / np.where(n > 0, n, 1), 0)


def right_einsum(lines_a, lines_b):
    epsilon = np.zeros((3, 3, 3))
    for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        epsilon[i, j, k], epsilon[i, k, j] = 1, -1
    return np.einsum("ijk,nj,nk->ni", epsilon, lines_a, lines_b)


# wrong ---------------------------------------------------------------------------------------------------------------


def wrong_divided(lines_a, lines_b):
    x = np.cross(lines_a, lines_b)
    return x / x[:, 2:3]


def wrong_slopes(lines_a, lines_b):
    with np.errstate(all="ignore"):
        m1, k1 = -lines_a[:, 0] / lines_a[:, 1], -lines_a[:, 2] / lines_a[:, 1]
        m2, k2 = -lines_b[:, 0] / lines_b[:, 1], -lines_b[:, 2] / lines_b[:, 1]
        x = (k2 - k1) / (m1 - m2)
        return np.stack([x, m1 * x + k1, np.ones_like(x)], axis=1)


def wrong_middle(lines_a, lines_b):
    a1, b1, c1 = lines_a.T
    a2, b2, c2 = lines_b.T
    return np.stack([b1 * c2 - b2 * c1, a1 * c2 - a2 * c1, a1 * b2 - a2 * b1], axis=1)


def wrong_c_minus(lines_a, lines_b):
    x = np.cross(lines_a, lines_b)
    return np.stack([-x[:, 0], -x[:, 1], x[:, 2]], axis=1)


def wrong_product(lines_a, lines_b):
    return np.multiply(lines_a, lines_b)


def wrong_difference(lines_a, lines_b):
    return lines_a - lines_b


def wrong_solver(lines_a, lines_b):
    out = np.full(lines_a.shape, np.nan)
    for i, (a, b) in enumerate(zip(lines_a, lines_b, strict=True)):
        try:
            xy = np.linalg.solve([a[:2], b[:2]], [-a[2], -b[2]])
        except np.linalg.LinAlgError:
            continue
        out[i] = [xy[0], xy[1], 1]
    return out


def wrong_in_place(lines_a, lines_b):
    lines_a /= np.linalg.norm(lines_a, axis=1, keepdims=True)
    return np.cross(lines_a, lines_b)


def wrong_one_for_twice(lines_a, lines_b):
    x = np.cross(lines_a, lines_b)
    x[np.abs(x).max(axis=1) == 0] = [0, 0, 1]
    return x


def wrong_small_numbers_are_zero(lines_a, lines_b):
    p = np.cross(lines_a, lines_b)
    return np.where(np.abs(p) < 1e-9, 0.0, p)


def wrong_short_is_one_line_twice(lines_a, lines_b):
    p = np.cross(lines_a, lines_b)
    return np.where(np.linalg.norm(p, axis=1, keepdims=True) < 1e-9, 0.0, p)
