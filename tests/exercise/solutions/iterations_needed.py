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


def right_try(inlier_ratio, sample_size, confidence):
    try:
        return math.ceil(math.log1p(-confidence) / math.log1p(-(inlier_ratio**sample_size)))
    except ZeroDivisionError:
        return math.inf
    except ValueError:
        return 1


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
