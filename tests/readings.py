"""Reads numbers back out of sentences, to hold them against what was computed."""

import re
from decimal import Decimal

import numpy as np

NUMBER = r"[-−]?\d[\d,]*(?:\.\d+)?"


def number(text: str) -> float:
    """The number that a numeral says."""
    return float(text.replace(",", "").replace("−", "-"))


def says(text: str, value: float, digits: int | None = None) -> bool:
    """Whether a numeral says a value, as exactly as it is written: to its last decimal, or to so many digits."""
    plain = Decimal(text.replace(",", "").replace("−", "-"))
    place = 10.0 ** int(plain.as_tuple().exponent)
    if digits is not None and plain:
        place = max(place, 10.0 ** (plain.adjusted() + 1 - digits))
    return abs(float(plain) - value) <= 0.51 * place + 1e-9


def says_length(text: str, metres: float) -> bool:
    """Whether "0.82 m", "3.1 mm" or "0 m" says a length."""
    found = re.fullmatch(rf"({NUMBER}) (mm|m)", text)
    if found is None:
        return False
    return says(found[1], 1000 * metres if found[2] == "mm" else metres)


def close(value, other, atol: float = 1e-8, *, equal_nan: bool = False) -> bool:
    """Whether two numbers or arrays are the same up to rounding."""
    return bool(np.allclose(value, other, atol=atol, equal_nan=equal_nan))
