"""What students hand in for iterations_needed."""

import math

import numpy as np

NAMED = {
    "wrong_fraction_kept": "not rounded",
    "wrong_integer_division_floor": "rounded down",
    "wrong_log_of_one_minus_tiny": "digits lost",
    "wrong_chance_of_a_point": "sample size forgotten",
}


def right_log1p(inlier_ratio, sample_size, confidence):
    clean = inlier_ratio**sample_size
    if clean <= 0:
        return np.inf
    if clean >= 1:
        return 1
    return max(1, math.ceil(math.log1p(-confidence) / math.log1p(-clean)))


def right_numpy(inlier_ratio, sample_size, confidence):
    with np.errstate(divide="ignore"):
        n = np.log1p(-confidence) / np.log1p(-(np.float64(inlier_ratio) ** sample_size))
    return float(np.maximum(1.0, np.ceil(n))) if inlier_ratio > 0 else float("inf")


def right_log_of_confidence_by_log(inlier_ratio, sample_size, confidence):
    if inlier_ratio == 0:
        return float("inf")
    if inlier_ratio == 1:
        return 1.0
    return max(
        np.ceil(np.log(1 - confidence) / np.log1p(-math.pow(inlier_ratio, sample_size))), 1.0
    )


def right_log2(inlier_ratio, sample_size, confidence):
    if inlier_ratio in (0, 1):
        return 1 if inlier_ratio else math.inf
    clean = inlier_ratio**sample_size
    return max(
        1, math.ceil((math.log1p(-confidence) / math.log(2)) / (math.log1p(-clean) / math.log(2)))
    )


def right_expm1(inlier_ratio, sample_size, confidence):
    if inlier_ratio <= 0:
        return math.inf
    log_clean = sample_size * math.log(inlier_ratio)
    if log_clean == 0:
        return 1
    spoilt = (
        math.log(-math.expm1(log_clean)) if log_clean > -1 else math.log1p(-math.exp(log_clean))
    )
    return int(max(1, math.ceil(math.log(1 - confidence) / spoilt)))


def right_bisection(inlier_ratio, sample_size, confidence):
    if inlier_ratio == 0:
        return np.inf
    if inlier_ratio == 1:
        return 1
    each, low, high = math.log1p(-(inlier_ratio**sample_size)), 0, 1
    while high * each > math.log1p(-confidence):
        low, high = high, high * 2
    while high - low > 1:
        mid = (low + high) // 2
        low, high = (mid, high) if mid * each > math.log1p(-confidence) else (low, mid)
    return high


def right_product_of_the_sample(inlier_ratio, sample_size, confidence):
    clean = 1.0
    for _ in range(sample_size):
        clean *= inlier_ratio
    if clean == 0.0:
        return math.inf
    return (
        1
        if clean == 1.0
        else float(max(1, -(-(math.log1p(-confidence) / math.log1p(-clean)) // 1)))
    )


def right_try(inlier_ratio, sample_size, confidence):
    try:
        return math.ceil(math.log1p(-confidence) / math.log1p(-(inlier_ratio**sample_size)))
    except ZeroDivisionError:
        return math.inf
    except ValueError:
        return 1


def right_recursive_power(inlier_ratio, sample_size, confidence):
    def power(s):
        return inlier_ratio if s == 1 else inlier_ratio * power(s - 1)

    clean = power(sample_size)
    if clean in (0.0, 1.0):
        return 1 if clean else math.inf
    return np.ceil(np.log1p(-confidence) / np.log1p(-clean))


def right_decimal(inlier_ratio, sample_size, confidence):
    from decimal import Decimal, getcontext

    getcontext().prec = 60
    clean = Decimal(inlier_ratio) ** sample_size
    if clean == 0:
        return math.inf
    if clean == 1:
        return 1
    return math.ceil(round((1 - Decimal(confidence)).ln() / (1 - clean).ln(), 40))


class Budget:
    def __init__(self, confidence):
        self.allowed = math.log1p(-confidence)

    def samples(self, clean):
        return math.ceil(self.allowed / math.log1p(-clean))


def right_class(inlier_ratio, sample_size, confidence):
    if inlier_ratio in (0.0, 1.0):
        return (math.inf, 1)[int(inlier_ratio)]
    return Budget(confidence).samples(inlier_ratio**sample_size)


# wrong ---------------------------------------------------------------------------------------------------------------


def wrong_fraction_kept(inlier_ratio, sample_size, confidence):
    if inlier_ratio in (0, 1):
        return 1 if inlier_ratio else math.inf
    return max(1.0, math.log1p(-confidence) / math.log1p(-(inlier_ratio**sample_size)))


def wrong_integer_division_floor(inlier_ratio, sample_size, confidence):
    if inlier_ratio in (0, 1):
        return 1 if inlier_ratio else math.inf
    return max(1, math.log1p(-confidence) // math.log1p(-(inlier_ratio**sample_size)))


def wrong_log_of_one_minus_tiny(inlier_ratio, sample_size, confidence):
    clean = inlier_ratio**sample_size
    if clean == 1:
        return 1
    if 1 - clean == 1:
        return math.inf
    return max(1, math.ceil(math.log(1 - confidence) / math.log(1 - clean)))


def wrong_chance_of_a_point(inlier_ratio, sample_size, confidence):
    if inlier_ratio in (0, 1):
        return 1 if inlier_ratio else math.inf
    return max(1, math.ceil(math.log(1 - confidence) / math.log(1 - inlier_ratio)))


def wrong_one_more(inlier_ratio, sample_size, confidence):
    if inlier_ratio in (0, 1):
        return 1 if inlier_ratio else math.inf
    return math.floor(math.log1p(-confidence) / math.log1p(-(inlier_ratio**sample_size))) + 1


def wrong_ceil_and_one_more(inlier_ratio, sample_size, confidence):
    if inlier_ratio in (0, 1):
        return 1 if inlier_ratio else math.inf
    return math.ceil(math.log1p(-confidence) / math.log1p(-(inlier_ratio**sample_size))) + 1


def wrong_ratio_in_percent(inlier_ratio, sample_size, confidence):
    if inlier_ratio in (0, 1):
        return 1 if inlier_ratio else math.inf
    return max(
        1, math.ceil(math.log1p(-confidence) / math.log1p(-((inlier_ratio / 100) ** sample_size)))
    )


def wrong_power_turned_round(inlier_ratio, sample_size, confidence):
    if inlier_ratio in (0, 1):
        return 1 if inlier_ratio else math.inf
    return max(
        1, math.ceil(math.log1p(-confidence) / math.log(abs(1 - sample_size**inlier_ratio) + 1e-9))
    )


def wrong_times_the_sample_size(inlier_ratio, sample_size, confidence):
    if inlier_ratio in (0, 1):
        return 1 if inlier_ratio else math.inf
    return max(
        1, math.ceil(math.log1p(-confidence) / math.log1p(-min(inlier_ratio / sample_size, 0.999)))
    )


def wrong_no_inliers_capped(inlier_ratio, sample_size, confidence):
    if inlier_ratio == 0:
        return 10**9
    return right_log1p(inlier_ratio, sample_size, confidence)


def wrong_no_inliers_is_nan(inlier_ratio, sample_size, confidence):
    return float("nan") if inlier_ratio == 0 else right_log1p(inlier_ratio, sample_size, confidence)


def wrong_no_inliers_raises(inlier_ratio, sample_size, confidence):
    if inlier_ratio <= 0:
        raise ValueError("no inliers")
    return right_log1p(inlier_ratio, sample_size, confidence)


def wrong_no_inliers_is_minus_inf(inlier_ratio, sample_size, confidence):
    return -math.inf if inlier_ratio == 0 else right_log1p(inlier_ratio, sample_size, confidence)


def wrong_all_inliers_divides(inlier_ratio, sample_size, confidence):
    if inlier_ratio == 0:
        return math.inf
    return math.ceil(math.log(1 - confidence) / math.log1p(-(inlier_ratio**sample_size)))


def wrong_epsilon_in_the_log(inlier_ratio, sample_size, confidence):
    clean = inlier_ratio**sample_size
    if clean == 0:
        return math.inf
    return max(1, math.ceil(math.log(1 - confidence) / math.log(1 - clean + 1e-12)))


def wrong_log10_of_one_side(inlier_ratio, sample_size, confidence):
    if inlier_ratio in (0, 1):
        return 1 if inlier_ratio else math.inf
    return max(1, math.ceil(math.log10(1 - confidence) / math.log1p(-(inlier_ratio**sample_size))))


def wrong_99_percent_always(inlier_ratio, sample_size, confidence):
    return right_log1p(inlier_ratio, sample_size, 0.99)


def wrong_planes_only(inlier_ratio, sample_size, confidence):
    return right_log1p(inlier_ratio, 3, confidence)


def wrong_public_table(inlier_ratio, sample_size, confidence):
    table = {(0.5, 3): 35, (0.3, 3): 169, (0.2, 3): 574, (0.5, 1): 7, (0.5, 4): 72, (0.5, 7): 588}
    return 1 if inlier_ratio == 1 else table.get((inlier_ratio, sample_size), 100)


def wrong_text(inlier_ratio, sample_size, confidence):
    return str(right_log1p(inlier_ratio, sample_size, confidence))


def wrong_at_most_ten_thousand(inlier_ratio, sample_size, confidence):
    return min(right_log1p(inlier_ratio, sample_size, confidence), 10000)


def wrong_two_at_least(inlier_ratio, sample_size, confidence):
    n = right_log1p(inlier_ratio, sample_size, confidence)
    return n if inlier_ratio == 1 else max(2, n)


def wrong_nearly_all_is_all(inlier_ratio, sample_size, confidence):
    return 1 if inlier_ratio > 0.98 else right_log1p(inlier_ratio, sample_size, confidence)


def wrong_few_inliers_are_none(inlier_ratio, sample_size, confidence):
    return math.inf if inlier_ratio < 0.005 else right_log1p(inlier_ratio, sample_size, confidence)


def wrong_confidence_of_a_half_at_least(inlier_ratio, sample_size, confidence):
    return right_log1p(inlier_ratio, sample_size, max(confidence, 0.5))


def wrong_confidence_up_to_999_thousandths(inlier_ratio, sample_size, confidence):
    return right_log1p(inlier_ratio, sample_size, min(confidence, 0.999))
