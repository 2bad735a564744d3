"""What students hand in for huber_weights."""

import numpy as np

NAMED = {
    "wrong_no_abs": "no absolute",
    "wrong_squared": "squared",
    "wrong_psi": "slope",
    "wrong_loss": "loss",
    "wrong_cut": "cut",
    "wrong_unbounded": "unbounded",
    "wrong_upside_down": "upside down",
    "wrong_root": "square root",
    "wrong_one_over": "jumps",
    "wrong_cauchy": "cauchy",
    "wrong_tukey": "tukey",
    "wrong_zero_by_zero": "zero by zero",
}


def right_maximum(residuals, corner):
    return corner / np.maximum(np.abs(residuals), corner)


def right_psi_over_r(residuals, corner):
    psi = np.clip(residuals, -corner, corner)
    return np.divide(psi, residuals, out=np.ones_like(psi), where=residuals != 0)


def right_minimum_with_warning(residuals, corner):
    with np.errstate(divide="ignore"):
        return np.minimum(1, corner / np.abs(residuals))


def right_piece_by_piece(residuals, corner):
    return np.piecewise(
        residuals,
        [residuals < -corner, residuals > corner],
        [lambda r: -corner / r, lambda r: corner / r, 1.0],
    )


def wrong_no_abs(residuals, corner):
    return corner / np.maximum(residuals, corner)


def wrong_squared(residuals, corner):
    return (corner / np.maximum(abs(residuals), corner)) ** 2


def wrong_psi(residuals, corner):
    return np.minimum(np.maximum(residuals, -corner), corner)


def wrong_loss(residuals, corner):
    a = abs(residuals)
    return np.where(a <= corner, a**2 / 2, corner * (a - corner / 2))


def wrong_cut(residuals, corner):
    return np.where(abs(residuals) > corner, 0.0, 1.0)


def wrong_unbounded(residuals, corner):
    return corner / np.maximum(abs(residuals), 1e-9)


def wrong_upside_down(residuals, corner):
    return np.maximum(abs(residuals) / corner, 1)


def wrong_root(residuals, corner):
    return np.sqrt(corner / np.maximum(abs(residuals), corner))


def wrong_one_over(residuals, corner):
    a = abs(residuals)
    return np.where(a <= corner, 1, 1 / np.where(a == 0, 1, a))


def wrong_cauchy(residuals, corner):
    return 1 / (1 + (residuals / corner) ** 2)


def wrong_tukey(residuals, corner):
    u = residuals / corner
    return np.where(abs(u) < 1, (1 - u**2) ** 2, 0)


def wrong_zero_by_zero(residuals, corner):
    with np.errstate(all="ignore"):
        return np.clip(residuals, -corner, corner) / residuals


def wrong_changes_residuals(residuals, corner):
    np.abs(residuals, out=residuals)
    return corner / np.maximum(residuals, corner)


def wrong_lower_corner_is_outside(residuals, corner):
    return np.where(residuals == -corner, 0.0, right_maximum(residuals, corner))


def wrong_nearly_zero_weighs_nothing(residuals, corner):
    return np.where(
        (residuals != 0) & (np.abs(residuals) < 1e-8), 0.0, right_maximum(residuals, corner)
    )


def wrong_a_hundredth_at_least(residuals, corner):
    return np.maximum(right_maximum(residuals, corner), 0.01)


def wrong_corner_of_a_millimetre_at_least(residuals, corner):
    return right_maximum(residuals, max(corner, 1e-3))
