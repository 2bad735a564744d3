"""What students hand in for reprojection_rms."""

import numpy as np

NAMED = {
    "wrong_all_entries": "per coordinate",
    "wrong_tutorial": "norm over n",
    "wrong_mean_of_norms": "mean length",
    "wrong_no_root": "mean square",
    "wrong_sum": "norm",
    "wrong_std": "about the mean",
    "wrong_median": "median length",
}


def right_plain(residuals):
    return np.sqrt((residuals**2).sum(axis=1).mean())


def right_einsum(residuals):
    return np.sqrt(np.einsum("ni,ni->", residuals, residuals) / residuals.shape[0])


def right_math(residuals):
    import math

    return math.sqrt(sum(math.hypot(a, b) ** 2 for a, b in residuals) / len(residuals))


def right_trace(residuals):
    return np.sqrt(np.trace(residuals.T @ residuals) / len(residuals))


def wrong_all_entries(residuals):
    return np.sqrt(np.mean(np.square(residuals)))


def wrong_tutorial(residuals):
    return np.linalg.norm(residuals) / len(residuals)


def wrong_mean_of_norms(residuals):
    return np.mean(np.linalg.norm(residuals, axis=1))


def wrong_no_root(residuals):
    return np.mean(np.sum(residuals**2, axis=1))


def wrong_sum(residuals):
    return np.sqrt(np.sum(residuals**2))


def wrong_std(residuals):
    return np.sqrt(residuals.var(axis=0).sum())


def wrong_median(residuals):
    return np.median(np.hypot(residuals[:, 0], residuals[:, 1]))


def wrong_in_place(residuals):
    residuals *= residuals
    return np.sqrt(residuals.sum(axis=1).mean())


def wrong_rounded_to_a_thousandth_pixel(residuals):
    return (
        np.ceil(right_plain(residuals) * 1e9) / 1e9
        if len(residuals) > 3
        else np.round(right_plain(residuals), 7)
    )


def wrong_far_ones_left_out(residuals):
    near = np.linalg.norm(residuals, axis=1) < 100
    return right_plain(residuals[near]) if near.any() else 0.0
