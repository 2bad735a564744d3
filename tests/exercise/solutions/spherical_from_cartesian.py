"""What students hand in for spherical_from_cartesian."""

import math

import numpy as np

NAMED = {
    "wrong_sign_of_a_zero": "sign of a zero",
    "wrong_sign_of_a_zero_in_a_loop": "sign of a zero",
    "wrong_atan": "atan and nan",
    "wrong_atan_where": "atan of the quotient",
    "wrong_arccos": "arccos of the quotient",
    "wrong_arccos_where": "arccos with care",
    "wrong_elevation_by_half_pi": "elevation",
    "wrong_mathematics": "other order",
    "wrong_degrees": "in degrees",
    "wrong_two_pi": "from zero to two pi",
    "wrong_x_first": "atan2 of x y",
    "wrong_rho": "distance from the axis",
}


def right_plain(p):
    p = p + 0.0
    x, y, z = p[:, 0], p[:, 1], p[:, 2]
    r = np.sqrt(x**2 + y**2 + z**2)
    return np.stack([r, np.arctan2(np.sqrt(x**2 + y**2), z), np.arctan2(y, x)], axis=1)


def right_complex(p):
    p = p + 0.0
    c = p[:, 0] + 1j * p[:, 1]
    s = p[:, 2] + 1j * abs(c)
    return np.column_stack((abs(s), np.angle(s), np.angle(c)))


def right_arcsin_and_cases(p):
    p = p + 0.0
    out = []
    for q in np.asarray(p, dtype=float):
        r = float(np.sqrt(q @ q))
        if r == 0:
            out.append((0.0, 0.0, 0.0))
            continue
        rho = math.hypot(q[0], q[1])
        small = math.asin(min(rho / r, 1.0)) if rho < abs(q[2]) else math.acos(abs(q[2]) / r)
        out.append((r, small if q[2] >= 0 else math.pi - small, math.atan2(q[1], q[0])))
    return np.array(out)


def right_einsum(p):
    p = p + 0.0
    squares = np.einsum("ij,ij->i", p, p)
    flat = np.einsum("ij,ij->i", p[:, :2], p[:, :2])
    return np.array(
        [np.sqrt(squares), np.arctan2(np.sqrt(flat), p[:, 2]), np.arctan2(p[:, 1], p[:, 0])]
    ).T


# wrong ---------------------------------------------------------------------------------------------------------------


def wrong_atan(p):
    x, y, z = p.T
    return np.stack(
        [np.linalg.norm(p, axis=1), np.arctan2(np.hypot(x, y), z), np.arctan(y / x)], axis=1
    )


def wrong_atan_where(p):
    out = right_plain(p)
    for i, (x, y, _) in enumerate(p):
        out[i, 2] = (
            math.atan(y / x) if x != 0 else (math.pi / 2 if y > 0 else -math.pi / 2 if y < 0 else 0)
        )
    return out


def wrong_arccos(p):
    r = np.linalg.norm(p, axis=1)
    return np.c_[r, np.arccos(p[:, 2] / r), np.arctan2(p[:, 1], p[:, 0])]


def wrong_arccos_where(p):
    r = np.linalg.norm(p, axis=1)
    safe = np.where(r > 0, r, 1)
    polar = np.where(r > 0, np.arccos(np.clip(p[:, 2] / safe, -1, 1)), 0)
    return np.c_[r, polar, np.arctan2(p[:, 1], p[:, 0])]


def wrong_elevation_by_half_pi(p):
    out = right_plain(p)
    out[:, 1] = np.where(out[:, 0] > 0, np.pi / 2 - out[:, 1], 0)
    return out


def wrong_mathematics(p):
    r, polar, azimuth = right_plain(p).T
    return np.stack([r, azimuth, polar], axis=1)


def wrong_degrees(p):
    out = right_plain(p)
    out[:, 1:] = np.degrees(out[:, 1:])
    return out


def wrong_two_pi(p):
    out = right_plain(p)
    out[:, 2] %= 2 * np.pi
    return out


def wrong_x_first(p):
    out = right_plain(p)
    out[:, 2] = np.arctan2(p[:, 0], p[:, 1])
    return out


def wrong_rho(p):
    rho = np.sqrt(p[:, 0] ** 2 + p[:, 1] ** 2)
    return np.c_[rho, np.arctan2(rho, p[:, 2]), np.arctan2(p[:, 1], p[:, 0])]


def wrong_in_place(p):
    out = right_plain(p)
    p[:] = out
    return p


def wrong_sign_of_a_zero(p):
    x, y, z = p.T
    rho = np.hypot(x, y)
    return np.c_[np.hypot(rho, z), np.arctan2(rho, z), np.arctan2(y, x)]


def wrong_sign_of_a_zero_in_a_loop(p):
    rows = []
    for x, y, z in p:
        r = math.sqrt(x * x + y * y + z * z)
        rows.append([r, math.atan2(math.sqrt(x * x + y * y), z), math.atan2(y, x)])
    return np.array(rows)


def wrong_near_the_axis_no_azimuth(p):
    out = right_plain(p)
    out[out[:, 1] < 1e-6, 2] = 0
    return out


def wrong_arccos_below(p):
    out = right_plain(p)
    low = p[:, 2] < 0
    out[low, 1] = np.arccos(p[low, 2] / out[low, 0])
    return out


def wrong_small_is_the_origin(p):
    out = right_plain(p)
    out[out[:, 0] < 1e-5] = 0
    return out
