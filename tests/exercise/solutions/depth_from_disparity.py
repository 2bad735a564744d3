"""What students hand in for depth_from_disparity."""

import numpy as np

NAMED = {
    "wrong_masked_array_filled": "zero for all else",
    "wrong_plain_division": "behind the cameras",
    "wrong_nothing_at_zero": "zero is unknown",
    "wrong_absolute_disparity": "sign dropped",
    "wrong_small_number_added_to_zero": "zero made small",
}


def right_where(d, f, baseline):
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.where(d >= 0, f * baseline / np.abs(d), np.nan)


def right_vectorize(d, f, baseline):
    def one(s):
        return f * baseline / s if s > 0 else (np.inf if s == 0 else np.nan)

    return np.vectorize(one, otypes=[float])(d)


def right_select(d, f, baseline):
    safe = np.where(d > 0, d, 1.0)
    return np.select([d > 0, d == 0], [f * baseline / safe, np.inf], default=np.nan)


def right_log(d, f, baseline):
    with np.errstate(all="ignore"):
        return np.exp(np.log(f) + np.log(baseline) - np.log(d))


# wrong ---------------------------------------------------------------------------------------------------------------


def wrong_plain_division(d, f, baseline):
    return np.divide(f * baseline, d)


def wrong_nothing_at_zero(d, f, baseline):
    out = np.full(d.shape, np.nan)
    out[d > 0] = f * baseline / d[d > 0]
    return out


def wrong_absolute_disparity(d, f, baseline):
    return f * baseline / abs(d)


def wrong_small_number_added_to_zero(d, f, baseline):
    return f * baseline / np.clip(d, 1e-6, None)


def wrong_all_unknown_is_infinite(d, f, baseline):
    return np.where(d > 0, f * baseline / np.where(d > 0, d, 1), np.inf)


def wrong_nan_is_zero(d, f, baseline):
    out = right_where(d, f, baseline)
    out[np.isnan(d)] = 0
    return out


def wrong_negative_is_infinite(d, f, baseline):
    with np.errstate(divide="ignore"):
        return np.where(d < 0, np.inf, f * baseline / np.abs(d))


def wrong_written_into_the_input(d, f, baseline):
    d[d < 0] = np.nan
    with np.errstate(divide="ignore"):
        return f * baseline / np.abs(d)


def wrong_raises_on_negative(d, f, baseline):
    if (d < 0).any():
        raise ValueError("negative disparity")
    with np.errstate(divide="ignore"):
        return f * baseline / np.abs(d)


def wrong_raises_on_zero(d, f, baseline):
    if np.any(d == 0):
        raise ZeroDivisionError("zero disparity")
    return right_where(d, f, baseline)


def wrong_masked_array_filled(d, f, baseline):
    return np.ma.filled(f * baseline / np.ma.masked_less_equal(d, 0), 0.0)


def wrong_thousandth_of_a_pixel_is_none(d, f, baseline):
    return np.where((d >= 0) & (d < 1e-3), np.inf, right_where(d, f, baseline))


def wrong_special_values_of_maps(d, f, baseline):
    z = right_where(d, f, baseline)
    return z if d.ndim == 1 else np.nan_to_num(z, nan=0.0, posinf=np.inf)


def wrong_all_zero_is_unknown(d, f, baseline):
    return right_where(d, f, baseline) if (d != 0).any() or not d.size else np.full(d.shape, np.nan)


def wrong_nothing_is_an_error(d, f, baseline):
    return right_where(d, f, baseline) if d.max() > -np.inf or np.isnan(d).any() else d
