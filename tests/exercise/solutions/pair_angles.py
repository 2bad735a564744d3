"""What students hand in for pair_angles."""

import numpy as np

NAMED = {
    "wrong_first_is_source": "never swapped",
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


def wrong_in_place(p_i, n_i, p_j, n_j):
    d = unit(p_j - p_i)
    s = np.abs(dot(n_i, d)) < np.abs(dot(n_j, d))
    n_i[s], n_j[s] = n_j[s].copy(), n_i[s].copy()
    d[s] *= -1
    v = unit(np.cross(d, n_i))
    return _angles(d, n_i, n_j, v, np.cross(n_i, v))


def wrong_near_points_are_one(p_i, n_i, p_j, n_j):
    out = right_pcl(p_i, n_i, p_j, n_j)
    out[np.linalg.norm(p_j - p_i, axis=1) < 1e-4] = 0
    return out


def wrong_nearly_equal_normals_are_equal(p_i, n_i, p_j, n_j):
    out = right_pcl(p_i, n_i, p_j, n_j)
    out[np.linalg.norm(n_j - n_i, axis=1) < 0.01, :2] = 0
    return out
