"""Numbers and quantities as a sentence or a table writes them: no exponents, no negative zero, a
minus sign that is one.

`fixed`, `brief` and their like write numbers; `length`, `pixels`, `angle` and `percent` write
quantities with their unit. What is not finite has no numeral: say in words what is missing.
"""

import math
from collections.abc import Iterable
from decimal import ROUND_HALF_UP, Context

_SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
ROUND_OFF = 1e-9
"""Below this share of its unit (metre, pixel, degree, per cent) a quantity is rounding: it is zero,
in words and on axes.
"""


def fixed(value: float, places: int) -> str:
    """Write a number with so many decimals, thousands set off; what rounds to zero is 0 without a
    sign.
    """
    text = f"{value:,.{places}f}"
    return (text if any(digit in text for digit in "123456789") else text.lstrip("-")).replace(
        "-", "−"
    )


def brief(value: float, digits: int = 3) -> str:
    """Write a number with so many significant digits and no zeros behind them; 0 where only
    rounding is left.

    It is rounded once, halves away from zero, as the page rounds the numbers beside its charts.
    """
    if abs(value) < ROUND_OFF:
        return "0"
    text = (
        f"{Context(prec=digits, rounding=ROUND_HALF_UP).create_decimal_from_float(float(value)):,f}"
    )
    return (text.rstrip("0").rstrip(".") if "." in text else text).replace("-", "−")


def fixed_or_power(value: float, places: int) -> str:
    """Write a number as `fixed` does, from a million on as a power of ten with three digits: 3.28 ×
    10⁹.
    """
    if abs(value) < 1e6:
        return fixed(value, places)
    mantissa, exponent = f"{value:.2e}".split("e")
    return f"{mantissa} × {power_of_ten(int(exponent))}".replace("-", "−")


def _brief_or_power(value: float, digits: int) -> str:
    return brief(value, digits) if abs(value) < 1e6 else fixed_or_power(value, 0)


def power_of_ten(exponent: int) -> str:
    """Write a power of ten: 10⁹, 10⁻⁵."""
    return f"10{str(exponent).translate(_SUPERSCRIPTS)}"


def fixed_row(values: Iterable[float], places: int) -> str:
    """Write some numbers in a row, each with so many decimals."""
    return ", ".join(fixed(value, places) for value in values)


def coordinates(values: Iterable[float], places: int) -> str:
    """Write a point, pixel or vector in brackets, each number with so many decimals; "none" where
    one is not finite.
    """
    numbers = [float(value) for value in values]
    if not all(math.isfinite(value) for value in numbers):
        return "none"
    return f"({', '.join(fixed_or_power(value, places) for value in numbers)})"


def length(metres: float, digits: int = 3) -> str:
    """Write a length in the unit that suits it, from µm to km, with so many significant digits; km
    from 1,000 km on.

    What only rounding left of a length is "0 mm".
    """
    size = abs(metres)
    if size < ROUND_OFF:
        return "0 mm"
    if size >= 999.5e3:
        return f"{_brief_or_power(metres / 1e3, digits)} km"
    if size >= 0.1:
        return f"{brief(metres, digits)} m"
    return (
        f"{brief(1e3 * metres, digits)} mm"
        if size >= 1e-6
        else f"{brief(1e6 * metres, min(digits, 2))} µm"
    )


def area(square_metres: float, digits: int = 3) -> str:
    """Write an area or a sum of squared lengths with so many significant digits, below a thousandth
    of a m² in mm².
    """
    in_metres = abs(square_metres) >= 1e-3
    return (
        f"{brief(square_metres, digits)} m²"
        if in_metres
        else f"{brief(1e6 * square_metres, digits)} mm²"
    )


def pixels(count: float, digits: int = 3) -> str:
    """Write a distance in an image with so many significant digits; 0 px below 0.0005 px."""
    return "0 px" if abs(count) < 5e-4 else f"{_brief_or_power(count, digits)} px"


def angle(degrees: float, digits: int = 3) -> str:
    """Write an angle with so many significant digits; below a thousandth of a degree only that it
    is less.
    """
    if abs(degrees) < ROUND_OFF:
        return "0°"
    return f"{brief(degrees, digits)}°" if abs(degrees) >= 0.001 else "less than 0.001°"


def percent(share: float, places: int | None = None) -> str:
    """Write a share, 1 being all of it, in per cent.

    Without a number of decimals it has two significant digits, and no decimals from 100 % on; below
    0.01 % it is only said that it is less.
    """
    value = 100.0 * share
    if places is not None:
        return f"{fixed(value, places)} %"
    if abs(value) < 0.01:
        return "0 %" if abs(value) < 1e-6 else "less than 0.01 %"
    return f"{brief(value, 2) if abs(value) < 99.5 else fixed_or_power(value, 0)} %"


def plus_minus(value: float, deviation: float, places: int = 1) -> tuple[str, str]:
    """Write a value and its standard deviation: of the deviation two digits, of the value none that
    the deviation drowns.

    Args:
        value: The value: "535.6" beside "1.6", "490" beside "200".
        deviation: Its standard deviation.
        places: The most decimals that the value has.

    Raises:
        ValueError: If the deviation is not positive and finite.
    """
    if not 0.0 < deviation < math.inf:
        raise ValueError("a deviation is positive and finite")
    place = math.floor(math.log10(float(f"{deviation:.1e}"))) - 1
    if place <= 0:
        return fixed(value, min(-place, places)), brief(deviation, 2)
    return fixed(round(value / 10**place) * 10**place, 0), brief(deviation, 2)


def counted(count: int, one: str, more: str = "") -> str:
    """Write how many there are of what: "1 sample", "2 samples"; a plural that is no mere s is
    given.
    """
    return f"{count:,} {one if count == 1 else more or f'{one}s'}"
