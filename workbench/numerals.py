"""Numbers as sentences and labels write them."""

import numpy as np

ROUNDING = 1e-9  # what is smaller is rounding of a quantity of about one


def short(value: float, digits: int = 3) -> str:
    """Return a number with so many digits that count, never with an exponent; what is below ROUNDING is 0."""
    if abs(value) < ROUNDING:
        return "0"
    rounded = float(f"{value:.{digits}g}")
    text = f"{rounded:,.0f}" if abs(rounded) >= 10 ** (digits - 1) else np.format_float_positional(rounded, trim="-")
    return text.replace("-", "−")
