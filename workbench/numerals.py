"""Numbers as a sentence or a table writes them: no exponents, no negative zero, and a minus sign that is one.

What is not finite has no numeral: say in words what is missing.
"""

from collections.abc import Iterable
from decimal import Decimal

_SUPERSCRIPTS = str.maketrans("0123456789", "⁰¹²³⁴⁵⁶⁷⁸⁹")
ROUND_OFF = 1e-9
"""Below this share of its unit (metre, pixel, degree, per cent) a quantity is rounding: it is zero, in words and on axes."""


def fixed(value: float, places: int) -> str:
    """Write a number with so many decimals, thousands set off; what rounds to zero is 0 without a sign."""
    text = f"{value:,.{places}f}"
    return (text if any(digit in text for digit in "123456789") else text.lstrip("-")).replace("-", "−")


def brief(value: float, digits: int = 3) -> str:
    """Write a number with so many significant digits and no zeros behind them; 0 where only rounding is left."""
    if abs(value) < ROUND_OFF:
        return "0"
    text = f"{Decimal(f'{value:.{digits - 1}e}'):,f}"
    return (text.rstrip("0").rstrip(".") if "." in text else text).replace("-", "−")


def fixed_or_power(value: float, places: int) -> str:
    """Write a number as `fixed` does, from a million on as a power of ten with three digits: 3.28 × 10⁹."""
    if abs(value) < 1e6:
        return fixed(value, places)
    mantissa, exponent = f"{value:.2e}".split("e")
    return f"{mantissa} × 10{str(int(exponent)).translate(_SUPERSCRIPTS)}".replace("-", "−")


def fixed_row(values: Iterable[float], places: int) -> str:
    """Write some numbers in a row, each with so many decimals."""
    return ", ".join(fixed(value, places) for value in values)
