"""Reads numbers back out of sentences, to hold them against what was computed."""

from decimal import Decimal

import numpy as np

NUMBER = r"[-−]?\d[\d,]*(?:\.\d+)?"
POWER = rf"{NUMBER}(?: × 10[⁰¹²³⁴⁵⁶⁷⁸⁹]+)?"
LENGTH = rf"{NUMBER} (?:km|cm|mm|µm|m)\b"
_METRES = {"km": 1e3, "m": 1.0, "cm": 1e-2, "mm": 1e-3, "µm": 1e-6}
_DIGITS = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹−", "0123456789-", ",")


def number(text: str) -> float:
    """The number that a numeral says, as a power of ten too."""
    return float(_decimal(text))


def says(text: str, value: float, digits: int | None = None) -> bool:
    """Whether a numeral says a value, as exactly as it is written: to its last decimal, or to so
    many digits.
    """
    numeral = _decimal(text)
    place = 10.0 ** int(numeral.as_tuple().exponent)
    if digits is not None and numeral:
        place = max(place, 10.0 ** (numeral.adjusted() + 1 - digits))
    return abs(float(numeral) - value) <= 0.51 * place + 1e-9 * max(abs(value), 1.0)


def near(text: str, value: float, digits: int = 3) -> bool:
    """Whether a numeral says a value to so many digits that count, where zeros behind them are left
    out.
    """
    place = 10.0 ** (np.floor(np.log10(abs(value))) + 1 - digits) if value else 0.0
    return abs(number(text) - value) <= 0.51 * place + 1e-9 * max(abs(value), 1.0)


def near_length(text: str, metres: float, digits: int = 3) -> bool:
    """Whether "0.8 m", "3.1 mm" or "0 mm" says a length to so many digits, or to two in µm."""
    numeral, unit = text.rsplit(" ", 1)
    return near(numeral, metres / _METRES[unit], min(digits, 2) if unit == "µm" else digits)


def says_length(text: str, metres: float, digits: int | None = None) -> bool:
    """Whether "0.82 m", "3.1 mm" or "0 m" says a length."""
    numeral, unit = text.rsplit(" ", 1)
    return says(numeral, metres / _METRES[unit], digits)


def says_percent(text: str, share: float) -> bool:
    """Whether "7.3 %", "less than 0.01 %" or "0 %" says a share as exactly as it is written; 0 % is
    none at all.
    """
    numeral = text.removesuffix(" %").removeprefix("less than ")
    if text.startswith("less"):
        return abs(100 * share) <= number(numeral)
    return says(numeral, 100 * share) and (number(numeral) != 0 or abs(share) < 1e-7)


def metres(text: str) -> float:
    """The length, in metres, that "0.82 m", "8.2 cm" or "3.1 mm" says."""
    numeral, unit = text.rsplit(" ", 1)
    return number(numeral) * _METRES[unit]


def close(value, other, atol: float = 1e-8, *, equal_nan: bool = False) -> bool:
    """Whether two numbers or arrays are the same up to rounding."""
    return bool(np.allclose(value, other, atol=atol, equal_nan=equal_nan))


def _decimal(text: str) -> Decimal:
    plain, _, tens = text.translate(_DIGITS).partition(" × 10")
    return Decimal(plain).scaleb(int(tens or 0))
