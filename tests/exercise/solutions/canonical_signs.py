"""What students hand in for canonical_signs."""

import numpy as np

NAMED = {
    "wrong_svd_flip": "largest entry",
    "wrong_svd_flip_loop": "largest entry",
    "wrong_forgot_centroid": "about the origin",
    "wrong_three_moments": "each by its own moment",
    "wrong_third_left": "third axis kept",
    "wrong_way_round": "to the negative side",
    "wrong_farthest_point": "to the negative side",
    "wrong_majority": "to more points",
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


def right_mean_of_cubes(axes, p):
    c = p.mean(0)
    V = axes.copy()
    for k in (0, 1):
        if np.mean(((p - c) @ V[:, k]) ** 3) < 0:
            V[:, k] *= -1
    V[:, 2] = np.cross(V[:, 0], V[:, 1])
    return V


def right_by_det(axes, p):
    m = tails(axes, p)
    V = np.array(axes)
    V[:, 0] *= -1 if m[0] < 0 else 1
    V[:, 1] *= -1 if m[1] < 0 else 1
    if np.linalg.det(V) < 0:
        V[:, 2] = -V[:, 2]
    return V


def right_skewness(axes, p):
    q = (p - np.mean(p, axis=0)) @ axes
    sigma = q.std(axis=0)
    skew = np.mean(q**3, axis=0) / np.where(sigma > 0, sigma, 1) ** 3
    signs = [-1 if value < 0 else 1 for value in skew[:2]]
    return with_cross(signs[0] * axes[:, 0], signs[1] * axes[:, 1])


def right_normalised_first(axes, p):
    q = p - p.mean(axis=0)
    q = q / np.abs(q).max()
    m = np.power(q @ axes, 3).sum(axis=0)
    return with_cross(*(axes[:, k] * (1 if m[k] >= 0 else -1) for k in range(2)))


def right_loop(axes, p):
    c = sum(p) / len(p)
    out = []
    for k in range(2):
        u, total = axes[:, k], 0.0
        for x in p:
            d = (x - c) @ u
            total += d * d * d
        out.append(u if total >= 0 else -u)
    return np.array([out[0], out[1], np.cross(out[0], out[1])]).T


def right_einsum(axes, p):
    q = np.einsum("ni,ik->nk", p - p.mean(0), axes)
    m = np.einsum("nk,nk,nk->k", q, q, q)
    s = np.ones(3)
    s[m < 0] = -1
    s[2] = 1
    V = axes * s
    return V * [1, 1, np.sign(np.linalg.det(V))]


def right_copysign(axes, p):
    m = tails(axes, p)
    a, b = axes[:, 0] * np.copysign(1, m[0] + 0.0), axes[:, 1] * np.copysign(1, m[1] + 0.0)
    return with_cross(a, b)


def right_lists(axes, p):
    return [list(row) for row in right_plain(axes, p)]


# wrong ---------------------------------------------------------------------------------------------------------------


def wrong_svd_flip(axes, p):
    k = np.argmax(np.abs(axes), axis=0)
    V = axes * np.sign(axes[k, [0, 1, 2]])
    return with_cross(V[:, 0], V[:, 1])


def wrong_svd_flip_loop(axes, p):
    V = axes.copy()
    for k in range(2):
        if V[np.abs(V[:, k]).argmax(), k] < 0:
            V[:, k] = -V[:, k]
    V[:, 2] = np.cross(V[:, 0], V[:, 1])
    return V


def wrong_first_entry(axes, p):
    V = axes * np.where(axes[0] < 0, -1, 1)
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


def wrong_majority(axes, p):
    q = (p - p.mean(axis=0)) @ axes
    V = axes * np.where((q > 0).mean(axis=0) < 0.5, -1, 1)
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


def wrong_cross_order(axes, p):
    V = right_plain(axes, p)
    return np.column_stack([V[:, 0], V[:, 1], np.cross(V[:, 1], V[:, 0])])


def wrong_squares(axes, p):
    m = ((p - p.mean(axis=0)) @ axes) ** 2
    V = axes * np.where(m.sum(axis=0) < 0, -1, 1)
    return with_cross(V[:, 0], V[:, 1])


def wrong_sum_not_cubed(axes, p):
    m = ((p - p.mean(axis=0)) @ axes).sum(axis=0)
    V = axes * np.where(m < 0, -1, 1)
    return with_cross(V[:, 0], V[:, 1])


def wrong_farthest_point(axes, p):
    q = (p - p.mean(axis=0)) @ axes
    far = q[np.abs(q).argmax(axis=0), [0, 1, 2]]
    V = axes * np.where(far < 0, 1, -1)
    return with_cross(V[:, 0], V[:, 1])


def wrong_identity(axes, p):
    return axes


def wrong_det_only(axes, p):
    V = axes.copy()
    V[:, 2] *= np.sign(np.linalg.det(V))
    return V


def wrong_signs_only(axes, p):
    return np.where(tails(axes, p) < 0, -1.0, 1.0)


def wrong_all_flipped_together(axes, p):
    return axes if tails(axes, p)[0] >= 0 else -axes


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
