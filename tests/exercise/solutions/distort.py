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


def right_hypot(xy, k1, k2, p1, p2):
    x, y = xy[:, 0], xy[:, 1]
    r = np.hypot(x, y)
    radial = 1 + k1 * r**2 + k2 * r**4
    return np.column_stack(
        (
            x * radial + 2 * p1 * x * y + p2 * (r**2 + 2 * x**2),
            y * radial + p1 * (r**2 + 2 * y**2) + 2 * p2 * x * y,
        )
    )


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


def right_einsum(xy, k1, k2, p1, p2):
    r2 = np.einsum("ij,ij->i", xy, xy)
    g = np.polyval([k2, k1, 1.0], r2)
    cross = np.einsum("i,i->i", xy[:, 0], xy[:, 1])
    add = np.array(
        [
            2 * p1 * cross + p2 * (r2 + 2 * xy[:, 0] ** 2),
            p1 * (r2 + 2 * xy[:, 1] ** 2) + 2 * p2 * cross,
        ]
    ).T
    return np.einsum("i,ij->ij", g, xy) + add


def right_single_precision(xy, k1, k2, p1, p2):
    return right_columns(xy.astype(np.float32), k1, k2, p1, p2).astype(np.float32)


def right_helpers(xy, k1, k2, p1, p2):
    def radial(r2):
        return 1 + k1 * r2 + k2 * r2**2

    def tangential(a, b, pa, pb, r2):
        return 2 * pa * a * b + pb * (r2 + 2 * a * a)

    x, y = np.hsplit(xy, 2)
    r2 = x**2 + y**2
    return np.hstack(
        [
            x * radial(r2) + tangential(x, y, p1, p2, r2),
            y * radial(r2) + tangential(y, x, p2, p1, r2),
        ]
    )


def right_rows_of_a_list(xy, k1, k2, p1, p2):
    rows = [right_columns(row[None], k1, k2, p1, p2)[0] for row in xy]
    return np.array(rows).reshape(-1, 2)


class Lens:
    def __init__(self, k1, k2, p1, p2):
        self.k, self.p = (k1, k2), (p1, p2)

    def bend(self, xy):
        return right_columns(xy, *self.k, *self.p)


def right_class(xy, k1, k2, p1, p2):
    return Lens(k1, k2, p1, p2).bend(xy)


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


def wrong_sequential_assignment(xy, k1, k2, p1, p2):
    xy = xy.copy()
    r2 = xy[:, 0] ** 2 + xy[:, 1] ** 2
    g = 1 + k1 * r2 + k2 * r2**2
    xy[:, 0] = xy[:, 0] * g + 2 * p1 * xy[:, 0] * xy[:, 1] + p2 * (r2 + 2 * xy[:, 0] ** 2)
    xy[:, 1] = xy[:, 1] * g + p1 * (r2 + 2 * xy[:, 1] ** 2) + 2 * p2 * xy[:, 0] * xy[:, 1]
    return xy


def wrong_in_place(xy, k1, k2, p1, p2):
    out = right_columns(xy, k1, k2, p1, p2)
    xy[:] = out
    return xy


def wrong_sixth_power(xy, k1, k2, p1, p2):
    x, y = xy.T
    r2 = x**2 + y**2
    g = 1 + k1 * r2 + k2 * r2**3
    return np.stack(
        [
            x * g + 2 * p1 * x * y + p2 * (r2 + 2 * x**2),
            y * g + p1 * (r2 + 2 * y**2) + 2 * p2 * x * y,
        ],
        1,
    )


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


def wrong_two_forgotten_in_cross_terms(xy, k1, k2, p1, p2):
    x, y = xy.T
    r2 = x**2 + y**2
    g = 1 + k1 * r2 + k2 * r2**2
    return np.stack(
        [x * g + p1 * x * y + p2 * (r2 + 2 * x**2), y * g + p1 * (r2 + 2 * y**2) + p2 * x * y], 1
    )


def wrong_squares_without_the_two(xy, k1, k2, p1, p2):
    x, y = xy.T
    r2 = x**2 + y**2
    g = 1 + k1 * r2 + k2 * r2**2
    return np.stack(
        [x * g + 2 * p1 * x * y + p2 * (r2 + x**2), y * g + p1 * (r2 + y**2) + 2 * p2 * x * y], 1
    )


def wrong_sign_of_k1(xy, k1, k2, p1, p2):
    return right_columns(xy, -k1, k2, p1, p2)


def wrong_radius_of_the_whole_cloud(xy, k1, k2, p1, p2):
    x, y = xy.T
    r2 = np.sum(xy**2)
    g = 1 + k1 * r2 + k2 * r2**2
    return np.stack(
        [
            x * g + 2 * p1 * x * y + p2 * (r2 + 2 * x**2),
            y * g + p1 * (r2 + 2 * y**2) + 2 * p2 * x * y,
        ],
        1,
    )


def wrong_transposed(xy, k1, k2, p1, p2):
    return right_columns(xy, k1, k2, p1, p2).T


def wrong_x_and_y_swapped(xy, k1, k2, p1, p2):
    return right_columns(xy, k1, k2, p1, p2)[:, ::-1]


def wrong_first_point_only(xy, k1, k2, p1, p2):
    x, y = xy[0]
    return right_columns(np.array([[x, y]]), k1, k2, p1, p2)[0]


def wrong_empty_fails(xy, k1, k2, p1, p2):
    if len(xy) == 0:
        raise ValueError("no points")
    return right_columns(xy, k1, k2, p1, p2)


def wrong_one_row_too_few_when_empty(xy, k1, k2, p1, p2):
    return np.array([right_columns(row[None], k1, k2, p1, p2)[0] for row in xy])


def wrong_tangential_in_y_only(xy, k1, k2, p1, p2):
    x, y = xy.T
    r2 = x**2 + y**2
    g = 1 + k1 * r2 + k2 * r2**2
    return np.stack([x * g, y * g + p1 * (r2 + 2 * y**2) + 2 * p2 * x * y], 1)


def wrong_tangential_subtracted(xy, k1, k2, p1, p2):
    return right_columns(xy, k1, k2, -p1, -p2)


def wrong_rounded(xy, k1, k2, p1, p2):
    return np.round(right_columns(xy, k1, k2, p1, p2), 3)


def wrong_iterated_twice(xy, k1, k2, p1, p2):
    return right_columns(right_columns(xy, k1, k2, p1, p2), k1, k2, p1, p2)


def wrong_rim_left_as_it_is(xy, k1, k2, p1, p2):
    return np.where(np.hypot(xy[:, :1], xy[:, 1:]) < 0.7, right_columns(xy, k1, k2, p1, p2), xy)


def wrong_single_point_without_its_row(xy, k1, k2, p1, p2):
    return np.squeeze(right_columns(xy, k1, k2, p1, p2))
