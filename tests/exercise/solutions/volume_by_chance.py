"""What students hand in for volume_by_chance."""

import math

import numpy as np

NAMED = {
    "wrong_no_root_n": "no root of n",
    "wrong_std_of_the_throws": "no root of n",
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


def right_sample_std(inside, box_volume):
    if inside.size == 0:
        raise ValueError("throw at least one point")
    return inside.mean() * box_volume, box_volume * inside.astype(float).std(ddof=1) / math.sqrt(
        inside.size
    )


def right_counts(inside, box_volume):
    n, k = len(inside), int(np.count_nonzero(inside))
    if n < 1:
        raise ValueError("n")
    return box_volume * k / n, box_volume * math.sqrt(k * (n - k) / n**3)


def right_list(inside, box_volume):
    p = _checked(inside)
    return [float(box_volume * p), float(box_volume * (p * (1 - p) / len(inside)) ** 0.5)]


def right_scipy_sem(inside, box_volume):
    if len(inside) == 0:
        raise ValueError("empty")
    values = np.where(inside, box_volume, 0.0)
    return values.mean(), np.sqrt(
        ((values - values.mean()) ** 2).sum() / (len(values) - 1) / len(values)
    )


def right_pure_python(inside, box_volume):
    hits = [bool(one) for one in inside]
    if not hits:
        raise ValueError("there are no points")
    share = sum(hits) / len(hits)
    return share * box_volume, box_volume * (share * (1 - share) / len(hits)) ** 0.5


def right_statistics(inside, box_volume):
    import statistics

    values = [box_volume if one else 0.0 for one in inside.tolist()]
    if len(values) == 0:
        raise ValueError("no throws, no volume")
    return statistics.fmean(values), statistics.pstdev(values) / math.sqrt(len(values))


def right_variance_first(inside, box_volume):
    if not inside.size:
        raise ValueError("inside is empty")
    values = inside * float(box_volume)
    return values.mean(), np.sqrt(np.var(values) / values.size)


def right_array(inside, box_volume):
    n = inside.shape[0]
    if n == 0:
        raise ValueError
    share = inside.sum() / n
    return tuple(np.array([share, math.sqrt(share - share**2) / math.sqrt(n)]) * box_volume)


def wrong_no_root_n(inside, box_volume):
    p = _checked(inside)
    return box_volume * p, box_volume * np.sqrt(p * (1 - p))


def wrong_std_of_the_throws(inside, box_volume):
    _checked(inside)
    values = inside * box_volume
    return values.mean(), values.std()


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


def wrong_one_over_root_n(inside, box_volume):
    p = _checked(inside)
    return box_volume * p, box_volume / np.sqrt(len(inside))


def wrong_poisson(inside, box_volume):
    _checked(inside)
    k, n = inside.sum(), len(inside)
    return box_volume * k / n, box_volume * np.sqrt(k) / n


def wrong_two_sigma(inside, box_volume):
    p = _checked(inside)
    return box_volume * p, 2 * box_volume * np.sqrt(p * (1 - p) / len(inside))


def wrong_misses(inside, box_volume):
    p = 1 - _checked(inside)
    return box_volume * p, box_volume * np.sqrt(p * (1 - p) / len(inside))


def wrong_number_of_hits(inside, box_volume):
    p = _checked(inside)
    return box_volume * inside.sum(), box_volume * np.sqrt(p * (1 - p) / len(inside))


def wrong_divided_by_the_box(inside, box_volume):
    p = _checked(inside)
    return p / box_volume, np.sqrt(p * (1 - p) / len(inside)) / box_volume


def wrong_no_refusal(inside, box_volume):
    p = inside.mean() if len(inside) else 0.0
    return box_volume * p, box_volume * np.sqrt(p * (1 - p) / max(len(inside), 1))


def wrong_error_of_a_half(inside, box_volume):
    p = _checked(inside)
    return box_volume * p, box_volume * np.sqrt(0.25 / len(inside))


def wrong_swapped(inside, box_volume):
    p = _checked(inside)
    return box_volume * np.sqrt(p * (1 - p) / len(inside)), box_volume * p


def wrong_laplace_smoothing(inside, box_volume):
    if len(inside) == 0:
        raise ValueError("no points")
    p = (inside.sum() + 1) / (len(inside) + 2)
    return box_volume * p, box_volume * np.sqrt(p * (1 - p) / len(inside))
