"""What students hand in for plane_from_points."""

import numpy as np

NAMED = {
    "wrong_length_of_the_normal": "not normalised",
    "wrong_no_test_for_lines": "line not seen",
    "wrong_tiny_area_absolute": "fixed smallest area",
    "wrong_exactly_zero_only": "line not seen",
    "wrong_d_is_a_distance": "sign of d",
    "wrong_error_on_lines": "line refused",
}


def normal_of(p):
    return np.cross(p[1] - p[0], p[2] - p[0])


def longest2(p):
    return max(((p[i] - p[j]) ** 2).sum() for i in range(3) for j in range(i))


def flat(p):
    return np.linalg.norm(normal_of(p)) <= 1e-9 * longest2(p)


def right_cross(p):
    if flat(p):
        return np.full(4, np.nan)
    n = normal_of(p) / np.linalg.norm(normal_of(p))
    return np.array([*n, -n @ p[0]])


def right_turned_over(p):
    return -right_cross(p)


def right_as_a_list(p):
    return [float(x) for x in right_cross(p)]


def right_about_the_centroid(p):
    c = p.mean(axis=0)
    q = p - c
    n = np.cross(q[0], q[1]) + np.cross(q[1], q[2]) + np.cross(q[2], q[0])
    length = np.linalg.norm(n)
    if length <= 1e-9 * longest2(p):
        return np.array([np.nan] * 4)
    n = n / length
    return np.append(n, -n.dot(c))


def right_svd(p):
    c = p.mean(0)
    _, s, Vt = np.linalg.svd(p - c)
    if s[0] == 0 or s[1] / s[0] < 3e-10:
        return np.nan * np.ones(4)
    return np.append(Vt[-1], -Vt[-1] @ c)


def right_scaled_first(p):
    size = np.abs(p - p[0]).max()
    if size == 0:
        return np.full(4, np.nan)
    q = (p - p[0]) / size
    n = np.cross(q[1], q[2])
    if np.sqrt(n @ n) <= 1e-9 * longest2(q):
        return np.full(4, np.nan)
    n /= np.sqrt(n @ n)
    return np.concatenate([n, [-(p[0] @ n)]])


def right_levi_civita(p):
    a, b = p[1] - p[0], p[2] - p[0]
    eps = np.zeros((3, 3, 3))
    eps[0, 1, 2] = eps[1, 2, 0] = eps[2, 0, 1] = 1
    eps[0, 2, 1] = eps[2, 1, 0] = eps[1, 0, 2] = -1
    n = np.einsum("ijk,j,k->i", eps, a, b)
    if np.linalg.norm(n) <= 1e-9 * longest2(p):
        return np.full(4, np.nan)
    n = n / np.linalg.norm(n)
    return np.hstack([n, -n @ p[2]])


def right_gram_schmidt(p):
    sides = sorted(((p[i] - p[j]) for i in range(3) for j in range(i)), key=lambda v: v @ v)
    long, short = sides[2], sides[0]
    if long @ long == 0:
        return np.full(4, np.nan)
    u = long / np.linalg.norm(long)
    w = short - (short @ u) * u
    if np.linalg.norm(w) <= 1e-9 * np.linalg.norm(long):
        return np.full(4, np.nan)
    n = np.cross(u, w / np.linalg.norm(w))
    n /= np.linalg.norm(n)
    return np.append(n, -(p @ n).mean())


def right_null_divide(p):
    n = normal_of(p)
    with np.errstate(all="ignore"):
        n = n / (np.nan if flat(p) else np.linalg.norm(n))
    return np.append(n, -n @ p[0])


def right_determinants(p):
    q = p - p[0]
    n = np.array([np.linalg.det(np.vstack([np.eye(3)[i], q[1], q[2]])) for i in range(3)])
    length = float(np.hypot(np.hypot(n[0], n[1]), n[2]))
    if length <= 1e-9 * longest2(p):
        return np.full(4, np.nan)
    n = n / length
    return np.append(n, -n @ p[0])


class Plane:
    def __init__(self, p):
        self.p = p

    def coefficients(self):
        return tuple(right_cross(self.p))


def right_class(p):
    return np.array(Plane(p).coefficients())


# wrong ---------------------------------------------------------------------------------------------------------------


def wrong_length_of_the_normal(p):
    n = np.cross(p[2] - p[0], p[1] - p[0])
    return np.full(4, np.nan) if flat(p) else np.append(n, -n @ p[1])


def wrong_no_test_for_lines(p):
    n = normal_of(p)
    n /= np.linalg.norm(n)
    return np.append(n, -n @ p[0])


def wrong_tiny_area_absolute(p):
    n = normal_of(p)
    if np.linalg.norm(n) < 1e-6:
        return np.full(4, np.nan)
    n = n / np.linalg.norm(n)
    return np.append(n, -n @ p[0])


def wrong_tiny_area_absolute_1e_8(p):
    n = normal_of(p)
    if np.allclose(n, 0):
        return np.full(4, np.nan)
    n = n / np.linalg.norm(n)
    return np.append(n, -n @ p[0])


def wrong_tiny_area_absolute_1e_12(p):
    n = normal_of(p)
    if np.linalg.norm(n) < 1e-12:
        return np.full(4, np.nan)
    n = n / np.linalg.norm(n)
    return np.append(n, -n @ p[0])


def wrong_exactly_zero_only(p):
    n = normal_of(p)
    if not n.any():
        return np.full(4, np.nan)
    n = n / np.linalg.norm(n)
    return np.append(n, -n @ p[0])


def wrong_angle_too_coarse(p):
    n = normal_of(p)
    if np.linalg.norm(n) <= 1e-3 * longest2(p):
        return np.full(4, np.nan)
    n = n / np.linalg.norm(n)
    return np.append(n, -n @ p[0])


def wrong_error_on_lines(p):
    if flat(p):
        raise ValueError("collinear")
    return right_cross(p)


def wrong_none_on_lines(p):
    return None if flat(p) else right_cross(p)


def wrong_d_only_is_nan(p):
    return np.array([0, 0, 1, np.nan]) if flat(p) else right_cross(p)


def wrong_infinite_on_lines(p):
    return np.full(4, np.inf) if flat(p) else right_cross(p)


def wrong_floor_on_lines(p):
    return np.array([0.0, 0, 1, 0]) if flat(p) else right_cross(p)


def wrong_normal_only(p):
    return right_cross(p)[:3]


def wrong_d_first(p):
    return np.roll(right_cross(p), 1)


def wrong_d_is_a_distance(p):
    plane = right_cross(p)
    plane[3] = abs(plane[3])
    return plane


def wrong_divided_by_the_sum(p):
    if flat(p):
        return np.full(4, np.nan)
    n = normal_of(p)
    n = n / np.abs(n).sum()
    return np.append(n, -n @ p[0])


def wrong_dot_for_cross(p):
    a, b = p[1] - p[0], p[2] - p[0]
    n = a * b
    with np.errstate(all="ignore"):
        n = n / np.linalg.norm(n)
    return np.append(n, -n @ p[0])


def wrong_cross_of_a_side_and_a_point(p):
    if flat(p):
        return np.full(4, np.nan)
    n = np.cross(p[1] - p[0], p[2])
    n = n / np.linalg.norm(n)
    return np.append(n, -n @ p[0])


def wrong_moved_in_place(p):
    first = p[0].copy()
    p -= first
    if flat(p):
        return np.full(4, np.nan)
    n = np.cross(p[1], p[2])
    n = n / np.linalg.norm(n)
    return np.append(n, -n @ first)


def wrong_single_precision(p):
    p = p.astype(np.float32)
    n = normal_of(p)
    if np.linalg.norm(n) <= 1e-9 * longest2(p):
        return np.full(4, np.nan)
    n = n / np.linalg.norm(n)
    return np.append(n, -n @ p[0])


def wrong_upward_and_rounded(p):
    return np.round(right_cross(p), 2)


def wrong_column_points(p):
    return right_cross(p.T.copy())


def wrong_public_cases(p):
    return np.array([0.0, 0.0, 1.0, -0.8]) if p[0][2] == 0.8 else np.array([-0.6, 0.0, 0.8, -1.6])


def wrong_all_in_one_place_has_a_floor(p):
    return np.array([0.0, 0.0, 1.0, -p[0, 2]]) if np.ptp(p, axis=0).max() == 0 else right_cross(p)


def wrong_only_neighbours_compared(p):
    if (p[0] == p[2]).all() and (p[0] != p[1]).any():
        return np.array([0.0, 0.0, 1.0, -p[0, 2]])
    return right_cross(p)


def wrong_first_two_not_compared(p):
    if (p[0] == p[1]).all() and (p[0] != p[2]).any():
        return np.array([1.0, 0.0, 0.0, -p[0, 0]])
    return right_cross(p)
