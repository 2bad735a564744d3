"""What students hand in for canonical_signs."""

import numpy as np

NAMED = {
    "wrong_svd_flip": "largest entry",
    "wrong_forgot_centroid": "about the origin",
    "wrong_three_moments": "each by its own moment",
    "wrong_third_left": "third axis kept",
    "wrong_way_round": "to the negative side",
    "wrong_median": "to more points",
    "wrong_rows": "rows for columns",
}


def tails(axes, p):
    q = (p - p.mean(axis=0)) @ axes
    return (q**3).sum(axis=0)


def with_cross(a, b):
    return np.column_stack([a, b, np.cross(a, b)])


def right_plain(axes, p):
    m = tails(axes, p)
    a = axes[:, 0] if m[0] >= 0 else -axes[:, 0]
    b = axes[:, 1] if m[1] >= 0 else -axes[:, 1]
    return with_cross(a, b)


def right_vectorised(axes, p):
    s = np.where(tails(axes, p) < 0, -1.0, 1.0)
    V = axes * s
    V[:, 2] = np.cross(V[:, 0], V[:, 1])
    return V


def right_normalised_first(axes, p):
    q = p - p.mean(axis=0)
    q = q / np.abs(q).max()
    m = np.power(q @ axes, 3).sum(axis=0)
    return with_cross(*(axes[:, k] * (1 if m[k] >= 0 else -1) for k in range(2)))


def right_einsum(axes, p):
    q = np.einsum("ni,ik->nk", p - p.mean(0), axes)
    m = np.einsum("nk,nk,nk->k", q, q, q)
    s = np.ones(3)
    s[m < 0] = -1
    s[2] = 1
    V = axes * s
    return V * [1, 1, np.sign(np.linalg.det(V))]


# wrong ---------------------------------------------------------------------------------------------------------------


def wrong_svd_flip(axes, p):
    k = np.argmax(np.abs(axes), axis=0)
    V = axes * np.sign(axes[k, [0, 1, 2]])
    return with_cross(V[:, 0], V[:, 1])


def wrong_forgot_centroid(axes, p):
    m = ((p @ axes) ** 3).sum(axis=0)
    V = axes * np.where(m < 0, -1, 1)
    return with_cross(V[:, 0], V[:, 1])


def wrong_three_moments(axes, p):
    return axes * np.where(tails(axes, p) < 0, -1, 1)


def wrong_third_left(axes, p):
    m = tails(axes, p)
    V = axes.copy()
    for k in range(2):
        V[:, k] *= -1 if m[k] < 0 else 1
    return V


def wrong_way_round(axes, p):
    m = tails(axes, p)
    V = axes * np.where(m > 0, -1, 1)
    return with_cross(V[:, 0], V[:, 1])


def wrong_median(axes, p):
    q = (p - p.mean(axis=0)) @ axes
    V = axes * np.where(np.median(q, axis=0) < 0, -1, 1)
    return with_cross(V[:, 0], V[:, 1])


def wrong_rows(axes, p):
    V = axes.T
    m = tails(V, p)
    V = V * np.where(m < 0, -1, 1)
    return with_cross(V[:, 0], V[:, 1]).T


def wrong_in_place(axes, p):
    m = tails(axes, p)
    for k in range(2):
        if m[k] < 0:
            axes[:, k] *= -1
    axes[:, 2] = np.cross(axes[:, 0], axes[:, 1])
    return axes


def wrong_moves_the_points(axes, p):
    p -= p.mean(axis=0)
    return right_plain(axes, p)


def wrong_sign_of_zero(axes, p):
    m = np.sign(tails(axes, p).round(0))
    return with_cross(axes[:, 0] * m[0], axes[:, 1] * m[1])


def wrong_to_the_farthest_point(axes, p):
    q = (p - p.mean(axis=0)) @ axes
    signs = np.sign(q[np.abs(q).argmax(axis=0), range(3)])
    out = axes * signs
    out[:, 2] = np.cross(out[:, 0], out[:, 1])
    return out


def wrong_zero_turns_round(axes, p):
    m = (((p - p.mean(axis=0)) @ axes) ** 3).sum(axis=0)
    out = axes * np.where(m > 0, 1.0, -1.0)
    out[:, 2] = np.cross(out[:, 0], out[:, 1])
    return out


def wrong_zero_becomes_zero(axes, p):
    out = axes * np.sign((((p - p.mean(axis=0)) @ axes) ** 3).sum(axis=0))
    out[:, 2] = np.cross(out[:, 0], out[:, 1])
    return out


def wrong_second_axis_up_where_undecided(axes, p):
    m = tails(axes, p)
    a = axes[:, 0] if m[0] >= 0 else -axes[:, 0]
    b = np.abs(axes[:, 1]) if m[1] == 0 else axes[:, 1] * np.sign(m[1])
    return with_cross(a, b)


def wrong_axes_of_space_where_all_is_even(axes, p):
    return np.eye(3) if not tails(axes, p)[:2].any() else right_plain(axes, p)
