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


def right_svd(p):
    c = p.mean(0)
    _, s, Vt = np.linalg.svd(p - c)
    if s[0] == 0 or s[1] / s[0] < 3e-10:
        return np.nan * np.ones(4)
    return np.append(Vt[-1], -Vt[-1] @ c)


def right_determinants(p):
    q = p - p[0]
    n = np.array([np.linalg.det(np.vstack([np.eye(3)[i], q[1], q[2]])) for i in range(3)])
    length = float(np.hypot(np.hypot(n[0], n[1]), n[2]))
    if length <= 1e-9 * longest2(p):
        return np.full(4, np.nan)
    n = n / length
    return np.append(n, -n @ p[0])


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


def wrong_exactly_zero_only(p):
    n = normal_of(p)
    if not n.any():
        return np.full(4, np.nan)
    n = n / np.linalg.norm(n)
    return np.append(n, -n @ p[0])


def wrong_error_on_lines(p):
    if flat(p):
        raise ValueError("collinear")
    return right_cross(p)


def wrong_d_is_a_distance(p):
    plane = right_cross(p)
    plane[3] = abs(plane[3])
    return plane


def wrong_moved_in_place(p):
    first = p[0].copy()
    p -= first
    if flat(p):
        return np.full(4, np.nan)
    n = np.cross(p[1], p[2])
    n = n / np.linalg.norm(n)
    return np.append(n, -n @ first)


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
