"""What students hand in for distort."""

import numpy as np

NAMED = {
    "wrong_one_forgotten": "displacement only",
    "wrong_p1_p2_exchanged": "p1 and p2 swapped",
    "wrong_k2_times_r2": "fourth power lost",
    "wrong_r_not_squared": "radius not squared",
}


def right_columns(xy, k1, k2, p1, p2):
    x, y = xy.T
    r2 = x * x + y * y
    g = 1 + k1 * r2 + k2 * r2 * r2
    return np.stack(
        [
            x * g + 2 * p1 * x * y + p2 * (r2 + 2 * x * x),
            y * g + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y,
        ],
        1,
    )


def right_loop(xy, k1, k2, p1, p2):
    out = np.zeros((len(xy), 2))
    for i, (x, y) in enumerate(xy):
        r2 = x**2 + y**2
        out[i, 0] = x * (1 + k1 * r2 + k2 * r2**2) + 2 * p1 * x * y + p2 * (r2 + 2 * x**2)
        out[i, 1] = y * (1 + k1 * r2 + k2 * r2**2) + p1 * (r2 + 2 * y**2) + 2 * p2 * x * y
    return out


def right_vector_form(xy, k1, k2, p1, p2):
    p = np.array([p2, p1])
    r2 = np.sum(xy**2, axis=1, keepdims=True)
    return xy * (1 + r2 * (k1 + k2 * r2) + 2 * (xy @ p)[:, None]) + r2 * p


def right_polar(xy, k1, k2, p1, p2):
    r, a = np.hypot(xy[:, 0], xy[:, 1]), np.arctan2(xy[:, 1], xy[:, 0])
    g = r * (1 + k1 * r**2 + k2 * r**4)
    s, c = np.sin(a), np.cos(a)
    dx = r**2 * (2 * p1 * s * c + p2 * (1 + 2 * c * c))
    dy = r**2 * (p1 * (1 + 2 * s * s) + 2 * p2 * s * c)
    return np.array([g * c + dx, g * s + dy]).T


def right_on_a_copy(xy, k1, k2, p1, p2):
    out = xy.copy()
    r2 = (xy**2).sum(1)
    out *= (1 + k1 * r2 + k2 * r2**2)[:, None]
    out[:, 0] += 2 * p1 * xy[:, 0] * xy[:, 1] + p2 * (r2 + 2 * xy[:, 0] ** 2)
    out[:, 1] += p1 * (r2 + 2 * xy[:, 1] ** 2) + 2 * p2 * xy[:, 0] * xy[:, 1]
    return out


# wrong ---------------------------------------------------------------------------------------------------------------


def wrong_p1_p2_exchanged(xy, k1, k2, p1, p2):
    return right_loop(xy, k1, k2, p2, p1)


def wrong_k2_times_r2(xy, k1, k2, p1, p2):
    x, y = xy.T
    r2 = x**2 + y**2
    g = 1 + (k1 + k2) * r2
    return np.stack(
        [
            x * g + 2 * p1 * x * y + p2 * (r2 + 2 * x**2),
            y * g + p1 * (r2 + 2 * y**2) + 2 * p2 * x * y,
        ],
        1,
    )


def wrong_r_not_squared(xy, k1, k2, p1, p2):
    x, y = xy.T
    r = np.sqrt(x**2 + y**2)
    g = 1 + k1 * r + k2 * r**2
    return np.stack(
        [
            x * g + 2 * p1 * x * y + p2 * (r**2 + 2 * x**2),
            y * g + p1 * (r**2 + 2 * y**2) + 2 * p2 * x * y,
        ],
        1,
    )


def wrong_in_place(xy, k1, k2, p1, p2):
    out = right_columns(xy, k1, k2, p1, p2)
    xy[:] = out
    return xy


def wrong_one_forgotten(xy, k1, k2, p1, p2):
    x, y = xy.T
    r2 = x**2 + y**2
    g = k1 * r2 + k2 * r2**2
    return np.stack(
        [
            x * g + 2 * p1 * x * y + p2 * (r2 + 2 * x**2),
            y * g + p1 * (r2 + 2 * y**2) + 2 * p2 * x * y,
        ],
        1,
    )


def wrong_empty_fails(xy, k1, k2, p1, p2):
    if len(xy) == 0:
        raise ValueError("no points")
    return right_columns(xy, k1, k2, p1, p2)


def wrong_one_row_too_few_when_empty(xy, k1, k2, p1, p2):
    return np.array([right_columns(row[None], k1, k2, p1, p2)[0] for row in xy])


def wrong_rim_left_as_it_is(xy, k1, k2, p1, p2):
    return np.where(np.hypot(xy[:, :1], xy[:, 1:]) < 0.7, right_columns(xy, k1, k2, p1, p2), xy)
