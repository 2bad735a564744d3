"""What students hand in for volume_by_chance."""

import math

import numpy as np

NAMED = {
    "wrong_no_root_n": "no root of n",
    "wrong_error_of_the_share": "error without the box",
    "wrong_share_and_its_error": "share alone",
    "wrong_variance_of_the_estimate": "variance",
    "wrong_half_width": "interval",
    "wrong_n_outside": "n outside the root",
}


def _checked(inside):
    if len(inside) == 0:
        raise ValueError("no points")
    return inside.mean()


def right_formula(inside, box_volume):
    p = _checked(inside)
    return box_volume * p, box_volume * np.sqrt(p * (1 - p) / len(inside))


def right_std(inside, box_volume):
    if inside.size == 0:
        raise ValueError("throw at least one point")
    return inside.mean() * box_volume, box_volume * inside.std() / np.sqrt(inside.size)


def right_pure_python(inside, box_volume):
    hits = [bool(one) for one in inside]
    if not hits:
        raise ValueError("there are no points")
    share = sum(hits) / len(hits)
    return share * box_volume, box_volume * (share * (1 - share) / len(hits)) ** 0.5


def right_array(inside, box_volume):
    n = inside.shape[0]
    if n == 0:
        raise ValueError
    share = inside.sum() / n
    return tuple(np.array([share, math.sqrt(share - share**2) / math.sqrt(n)]) * box_volume)


def wrong_no_root_n(inside, box_volume):
    p = _checked(inside)
    return box_volume * p, box_volume * np.sqrt(p * (1 - p))


def wrong_error_of_the_share(inside, box_volume):
    p = _checked(inside)
    return box_volume * p, np.sqrt(p * (1 - p) / len(inside))


def wrong_share_and_its_error(inside, box_volume):
    p = _checked(inside)
    return p, np.sqrt(p * (1 - p) / len(inside))


def wrong_variance_of_the_estimate(inside, box_volume):
    p = _checked(inside)
    return box_volume * p, box_volume**2 * p * (1 - p) / len(inside)


def wrong_half_width(inside, box_volume):
    p = _checked(inside)
    return box_volume * p, 1.96 * box_volume * np.sqrt(p * (1 - p) / len(inside))


def wrong_n_outside(inside, box_volume):
    p = _checked(inside)
    return box_volume * p, box_volume * np.sqrt(p * (1 - p)) / len(inside)


def wrong_no_refusal(inside, box_volume):
    p = inside.mean() if len(inside) else 0.0
    return box_volume * p, box_volume * np.sqrt(p * (1 - p) / max(len(inside), 1))


def wrong_error_of_a_half(inside, box_volume):
    p = _checked(inside)
    return box_volume * p, box_volume * np.sqrt(0.25 / len(inside))
