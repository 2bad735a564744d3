"""What students hand in for pair_angles."""

import numpy as np

NAMED = {
    "wrong_first_is_source": "never swapped",
    "wrong_first_is_source_in_a_loop": "never swapped",
    "wrong_line_in_metres": "line not unit",
    "wrong_arguments": "arctangent exchanged",
    "wrong_line_stays": "line not turned",
    "wrong_v_as_it_is": "cross not unit",
    "wrong_v_reversed": "cross exchanged",
}


def unit(x):
    return x / np.linalg.norm(x, axis=1, keepdims=True)


def dot(a, b):
    return np.sum(a * b, axis=1)


def right_pcl(p_i, n_i, p_j, n_j):
    found = []
    for p1, n1, p2, n2 in zip(p_i, n_i, p_j, n_j):
        dp = p2 - p1
        f4 = np.linalg.norm(dp)
        a1, a2 = n1 @ dp / f4, n2 @ dp / f4
        if np.arccos(abs(a1)) > np.arccos(abs(a2)):
            n1, n2, dp, f3 = n2, n1, -dp, -a2
        else:
            f3 = a1
        v = np.cross(dp, n1)
        v = v / np.linalg.norm(v)
        w = np.cross(n1, v)
        found.append([np.arctan2(w @ n2, n1 @ n2), v @ n2, f3])
    return np.array(found)


def right_copies(p_i, n_i, p_j, n_j):
    d, u, n = unit(p_j - p_i), n_i.copy(), n_j.copy()
    swap = np.abs(dot(n_j, d)) > np.abs(dot(n_i, d))
    u[swap], n[swap] = n_j[swap], n_i[swap]
    d[swap] *= -1
    v = unit(np.cross(d, u))
    return np.stack([np.arctan2(dot(np.cross(u, v), n), dot(u, n)), dot(v, n), dot(u, d)], axis=1)


def right_both_ways_then_choose(p_i, n_i, p_j, n_j):
    def one(p, u, q, n):
        d = unit(q - p)
        v = unit(np.cross(d, u))
        return np.c_[np.arctan2(dot(np.cross(u, v), n), dot(u, n)), dot(v, n), dot(u, d)]

    a, b = one(p_i, n_i, p_j, n_j), one(p_j, n_j, p_i, n_i)
    return np.where(np.abs(a[:, 2:]) >= np.abs(b[:, 2:]), a, b)


def right_einsum(p_i, n_i, p_j, n_j):
    d = p_j - p_i
    d = d / np.sqrt(np.einsum("ij,ij->i", d, d))[:, None]
    s = np.abs(np.einsum("ij,ij->i", n_i, d)) < np.abs(np.einsum("ij,ij->i", n_j, d))
    sign = np.where(s, -1.0, 1.0)[:, None]
    u, n, d = np.where(s[:, None], n_j, n_i), np.where(s[:, None], n_i, n_j), sign * d
    v = np.cross(d, u)
    v /= np.sqrt((v**2).sum(1))[:, None]
    w = np.cross(u, v)
    return np.array([np.arctan2((w * n).sum(1), (u * n).sum(1)), (v * n).sum(1), (u * d).sum(1)]).T


def right_without_cross_of_w(p_i, n_i, p_j, n_j):
    d = unit(p_j - p_i)
    a, b = dot(n_i, d), dot(n_j, d)
    swap = abs(b) > abs(a)
    phi, other = np.where(swap, -b, a), np.where(swap, -a, b)
    s = np.sqrt(1 - phi**2)
    alpha = dot(np.cross(d, n_i), n_j) / s
    theta = np.arctan2((other - phi * dot(n_i, n_j)) / s, dot(n_i, n_j))
    return np.column_stack((theta, alpha, phi))


def right_complex_angle(p_i, n_i, p_j, n_j):
    out = np.zeros((len(p_i), 3))
    for k in range(len(p_i)):
        ends = [(p_i[k], n_i[k]), (p_j[k], n_j[k])]
        line = (p_j[k] - p_i[k]) / np.linalg.norm(p_j[k] - p_i[k])
        (p, u), (q, n) = sorted(ends, key=lambda end: -abs(end[1] @ line))
        d = (q - p) / np.linalg.norm(q - p)
        v = np.cross(d, u) / np.linalg.norm(np.cross(d, u))
        out[k] = np.angle(u @ n + 1j * (np.cross(u, v) @ n)), v @ n, u @ d
    return out


def right_matrix_frames(p_i, n_i, p_j, n_j):
    d = unit(p_j - p_i)
    swap = (dot(n_i, d) ** 2 < dot(n_j, d) ** 2)[:, None]
    u, n, d = np.where(swap, n_j, n_i), np.where(swap, n_i, n_j), np.where(swap, -d, d)
    v = unit(np.cross(d, u))
    frames = np.stack([u, v, np.cross(u, v)], axis=1)
    x = np.einsum("kab,kb->ka", frames, n)
    return np.c_[np.arctan2(x[:, 2], x[:, 0]), x[:, 1], dot(u, d)]


def right_recursive(p_i, n_i, p_j, n_j):
    d = unit(p_j - p_i)
    swap = np.abs(dot(n_i, d)) < np.abs(dot(n_j, d))
    if not swap.any():
        v = unit(np.cross(d, n_i))
        w = np.cross(n_i, v)
        return np.column_stack([np.arctan2(dot(w, n_j), dot(n_i, n_j)), dot(v, n_j), dot(n_i, d)])
    s = swap[:, None]
    return right_recursive(
        np.where(s, p_j, p_i), np.where(s, n_j, n_i), np.where(s, p_i, p_j), np.where(s, n_i, n_j)
    )


def right_angles_to_the_line(p_i, n_i, p_j, n_j):
    d = unit(p_j - p_i)
    to_i, to_j = (
        np.arccos(np.clip(abs(dot(n_i, d)), 0, 1)),
        np.arccos(np.clip(abs(dot(n_j, d)), 0, 1)),
    )
    second = to_j < to_i
    out = np.empty((len(d), 3))
    for chosen, u, n, line in ((~second, n_i, n_j, d), (second, n_j, n_i, -d)):
        v = unit(np.cross(line[chosen], u[chosen]))
        w = np.cross(u[chosen], v)
        out[chosen, 0] = np.arctan2(dot(w, n[chosen]), dot(u[chosen], n[chosen]))
        out[chosen, 1], out[chosen, 2] = dot(v, n[chosen]), dot(u[chosen], line[chosen])
    return out


# wrong ---------------------------------------------------------------------------------------------------------------


def _angles(d, u, n, v, w):
    return np.column_stack([np.arctan2(dot(w, n), dot(u, n)), dot(v, n), dot(u, d)])


def _swapped(p_i, n_i, p_j, n_j):
    d = unit(p_j - p_i)
    s = (np.abs(dot(n_i, d)) < np.abs(dot(n_j, d)))[:, None]
    return np.where(s, -d, d), np.where(s, n_j, n_i), np.where(s, n_i, n_j)


def wrong_first_is_source(p_i, n_i, p_j, n_j):
    d = unit(p_j - p_i)
    v = unit(np.cross(d, n_i))
    return _angles(d, n_i, n_j, v, np.cross(n_i, v))


def wrong_first_is_source_in_a_loop(p_i, n_i, p_j, n_j):
    rows = []
    for a, u, b, n in zip(p_i, n_i, p_j, n_j):
        d = (b - a) / np.linalg.norm(b - a)
        v = np.cross(d, u)
        v = v / np.linalg.norm(v)
        w = np.cross(u, v)
        rows.append((np.arctan2(w.dot(n), u.dot(n)), v.dot(n), u.dot(d)))
    return np.array(rows)


def wrong_line_in_metres(p_i, n_i, p_j, n_j):
    d = p_j - p_i
    s = (np.abs(dot(n_i, d)) < np.abs(dot(n_j, d)))[:, None]
    d, u, n = np.where(s, -d, d), np.where(s, n_j, n_i), np.where(s, n_i, n_j)
    v = unit(np.cross(d, u))
    return _angles(d, u, n, v, np.cross(u, v))


def wrong_arguments(p_i, n_i, p_j, n_j):
    d, u, n = _swapped(p_i, n_i, p_j, n_j)
    v = unit(np.cross(d, u))
    w = np.cross(u, v)
    return np.column_stack([np.arctan2(dot(u, n), dot(w, n)), dot(v, n), dot(u, d)])


def wrong_line_stays(p_i, n_i, p_j, n_j):
    _, u, n = _swapped(p_i, n_i, p_j, n_j)
    d = unit(p_j - p_i)
    v = unit(np.cross(d, u))
    return _angles(d, u, n, v, np.cross(u, v))


def wrong_v_as_it_is(p_i, n_i, p_j, n_j):
    d, u, n = _swapped(p_i, n_i, p_j, n_j)
    v = np.cross(d, u)
    return _angles(d, u, n, v, np.cross(u, v))


def wrong_v_reversed(p_i, n_i, p_j, n_j):
    d, u, n = _swapped(p_i, n_i, p_j, n_j)
    v = unit(np.cross(u, d))
    return _angles(d, u, n, v, np.cross(u, v))


def wrong_arctan_of_a_quotient(p_i, n_i, p_j, n_j):
    d, u, n = _swapped(p_i, n_i, p_j, n_j)
    v = unit(np.cross(d, u))
    w = np.cross(u, v)
    return np.column_stack([np.arctan(dot(w, n) / dot(u, n)), dot(v, n), dot(u, d)])


def wrong_degrees(p_i, n_i, p_j, n_j):
    return right_copies(p_i, n_i, p_j, n_j) * [180 / np.pi, 1, 1]


def wrong_angle_of_normals(p_i, n_i, p_j, n_j):
    d, u, n = _swapped(p_i, n_i, p_j, n_j)
    v = unit(np.cross(d, u))
    return np.column_stack([np.arccos(np.clip(dot(u, n), -1, 1)), dot(v, n), dot(u, d)])


def wrong_swap_reversed(p_i, n_i, p_j, n_j):
    d = unit(p_j - p_i)
    s = (np.abs(dot(n_i, d)) > np.abs(dot(n_j, d)))[:, None]
    d, u, n = np.where(s, -d, d), np.where(s, n_j, n_i), np.where(s, n_i, n_j)
    v = unit(np.cross(d, u))
    return _angles(d, u, n, v, np.cross(u, v))


def wrong_swap_by_signed(p_i, n_i, p_j, n_j):
    d = unit(p_j - p_i)
    s = (dot(n_i, d) < dot(n_j, d))[:, None]
    d, u, n = np.where(s, -d, d), np.where(s, n_j, n_i), np.where(s, n_i, n_j)
    v = unit(np.cross(d, u))
    return _angles(d, u, n, v, np.cross(u, v))


def wrong_swap_if_any(p_i, n_i, p_j, n_j):
    d = unit(p_j - p_i)
    if (np.abs(dot(n_i, d)) < np.abs(dot(n_j, d))).any():
        return wrong_first_is_source(p_j, n_j, p_i, n_i)
    return wrong_first_is_source(p_i, n_i, p_j, n_j)


def wrong_w_reversed(p_i, n_i, p_j, n_j):
    d, u, n = _swapped(p_i, n_i, p_j, n_j)
    v = unit(np.cross(d, u))
    return _angles(d, u, n, v, np.cross(v, u))


def wrong_phi_of_the_other(p_i, n_i, p_j, n_j):
    d, u, n = _swapped(p_i, n_i, p_j, n_j)
    v = unit(np.cross(d, u))
    w = np.cross(u, v)
    return np.column_stack([np.arctan2(dot(w, n), dot(u, n)), dot(v, n), dot(n, d)])


def wrong_order_of_columns(p_i, n_i, p_j, n_j):
    return right_copies(p_i, n_i, p_j, n_j)[:, [1, 2, 0]]


def wrong_one_norm_for_all(p_i, n_i, p_j, n_j):
    d = p_j - p_i
    d = d / np.linalg.norm(d)
    s = (np.abs(dot(n_i, d)) < np.abs(dot(n_j, d)))[:, None]
    d, u, n = np.where(s, -d, d), np.where(s, n_j, n_i), np.where(s, n_i, n_j)
    v = np.cross(d, u)
    v = v / np.linalg.norm(v)
    return _angles(d, u, n, v, np.cross(u, v))


def wrong_norm_of_columns(p_i, n_i, p_j, n_j):
    d = p_j - p_i
    d = d / np.linalg.norm(d, axis=0)
    s = (np.abs(dot(n_i, d)) < np.abs(dot(n_j, d)))[:, None]
    d, u, n = np.where(s, -d, d), np.where(s, n_j, n_i), np.where(s, n_i, n_j)
    v = unit(np.cross(d, u))
    return _angles(d, u, n, v, np.cross(u, v))


def wrong_in_place(p_i, n_i, p_j, n_j):
    d = unit(p_j - p_i)
    s = np.abs(dot(n_i, d)) < np.abs(dot(n_j, d))
    n_i[s], n_j[s] = n_j[s].copy(), n_i[s].copy()
    d[s] *= -1
    v = unit(np.cross(d, n_i))
    return _angles(d, n_i, n_j, v, np.cross(n_i, v))


def wrong_swapped_twice(p_i, n_i, p_j, n_j):
    u, n, d = n_i.copy(), n_j.copy(), unit(p_j - p_i)
    s = np.abs(dot(u, d)) < np.abs(dot(n, d))
    u[s] = n[s]
    n[s] = u[s]
    d[s] = -d[s]
    v = unit(np.cross(d, u))
    return _angles(d, u, n, v, np.cross(u, v))


def wrong_angles_for_cosines(p_i, n_i, p_j, n_j):
    found = right_copies(p_i, n_i, p_j, n_j)
    return np.column_stack([found[:, 0], np.arccos(found[:, 1]), np.arccos(found[:, 2])])


def wrong_line_from_the_other_end(p_i, n_i, p_j, n_j):
    d, u, n = _swapped(p_i, n_i, p_j, n_j)
    d = -d
    v = unit(np.cross(d, u))
    return _angles(d, u, n, v, np.cross(u, v))


def wrong_absolute_phi(p_i, n_i, p_j, n_j):
    found = right_copies(p_i, n_i, p_j, n_j)
    return np.column_stack([found[:, :2], np.abs(found[:, 2])])


def wrong_v_of_both_normals(p_i, n_i, p_j, n_j):
    d, u, n = _swapped(p_i, n_i, p_j, n_j)
    v = unit(np.cross(u, n))
    return _angles(d, u, n, v, np.cross(u, v))


def wrong_first_pair_alone(p_i, n_i, p_j, n_j):
    return np.tile(right_copies(p_i[:1], n_i[:1], p_j[:1], n_j[:1]), (len(p_i), 1))


def wrong_theta_from_0(p_i, n_i, p_j, n_j):
    out = right_pcl(p_i, n_i, p_j, n_j)
    out[:, 0] %= 2 * np.pi
    return out


def wrong_near_points_are_one(p_i, n_i, p_j, n_j):
    out = right_pcl(p_i, n_i, p_j, n_j)
    out[np.linalg.norm(p_j - p_i, axis=1) < 1e-4] = 0
    return out


def wrong_nearly_equal_normals_are_equal(p_i, n_i, p_j, n_j):
    out = right_pcl(p_i, n_i, p_j, n_j)
    out[np.linalg.norm(n_j - n_i, axis=1) < 0.01, :2] = 0
    return out
