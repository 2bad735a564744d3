"""How numbers are laid on an axis: what counts as zero, where the axis ends, its ticks, and their
words. For every home.
"""

from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np

from workbench.numerals import ROUND_OFF, brief

LONGEST_LABEL = 20
"""So many characters fit along the height of a chart."""


@dataclass(frozen=True)
class Axis:
    """An axis from `low` to `high` with ticks at round numbers inside, each with its word; no two
    words are the same.
    """

    low: float
    high: float
    ticks: tuple[float, ...]
    words: tuple[str, ...]


def settled(values: np.ndarray) -> np.ndarray:
    """Return values in which what is below round-off is zero."""
    return np.where(np.abs(values) < ROUND_OFF, 0.0, values)


def axis(low: float, high: float, most: int = 5, *, whole: bool = False) -> Axis:
    """Return the axis from low to high; around both where nothing but round-off lies between them.

    `whole` says that there is nothing between whole numbers, steps for instance: ticks are at some
    of these then.
    """
    low, high = apart(low, high)
    places = ticks(low, high, most)
    if whole and (places != np.rint(places)).any():
        places = np.arange(np.ceil(low), np.floor(high) + 1)
    return Axis(low, high, tuple(places.tolist()), _words(places))


def value_axis(columns: Iterable[np.ndarray], from_zero: bool = False, most: int = 5) -> Axis:
    """Return the axis of values with some room around them, from zero where they are magnitudes far
    apart.

    Args:
        columns: The values; NaN is left out.
        from_zero: Whether zero is on the axis in any case, as bars need it.
        most: At most so many ticks.
    """
    known = settled(
        np.concatenate([np.zeros(0), *(column[np.isfinite(column)] for column in columns)])
    )
    if not len(known):
        return axis(0.0, 1.06, most)
    low, high = float(known.min()), float(known.max())
    if from_zero:
        low, high = min(low, 0.0), max(high, 0.0)
    if 0.0 <= low < 0.5 * high:
        low = 0.0  # magnitudes are read against zero
    if low == high == 0.0:
        return axis(0.0, 1.06, most)
    if not _differ(low, high):
        return axis(min(0.5 * low, 1.5 * high), max(0.5 * low, 1.5 * high), most)
    room = 0.06 * (high - low)
    return axis(low if low == 0.0 else low - room, high if high == 0.0 else high + room, most)


LOGARITHM = "log₁₀ "
"""How the label of an axis, or the title of a colour bar, begins whose values are logarithms."""


def of_powers(logs: Axis) -> Axis:
    """Return an axis of logarithms with the numbers themselves as words, at powers of ten where
    there are two, else at one, two and five times such powers.
    """
    places = np.array(logs.ticks)
    powers = np.arange(np.ceil(logs.low), np.floor(logs.high) + 1)
    if len(places) < 2 or (places != np.rint(places)).any():
        near = np.arange(np.floor(logs.low), np.ceil(logs.high))
        finer = (near[:, None] + np.log10([1.0, 2.0, 5.0])).ravel()
        finer = finer[(finer >= logs.low) & (finer <= logs.high)]
        places = next((some for some in (powers, finer) if len(some) > 1), places)
    words = tuple(number(10.0**place) for place in places)
    return replace(logs, ticks=tuple(places.tolist()), words=words)


def apart(low: float, high: float) -> tuple[float, float]:
    """Return two ends that differ by more than round-off: the given ones, or some around them."""
    if _differ(low, high):
        return float(low), float(high)
    room = 0.1 * abs(high) or 0.5
    return float(low - room), float(high + room)


def _differ(low: float, high: float) -> bool:
    return high - low > ROUND_OFF * max(abs(low), abs(high)) and high - low > ROUND_OFF * ROUND_OFF


def ticks(low: float, high: float, most: int = 5) -> np.ndarray:
    """Return round numbers inside [low, high], at most `most` of them."""
    power = 10.0 ** np.floor(np.log10((high - low) / most))
    for step in power * np.array([1.0, 2.0, 5.0, 10.0, 20.0]):
        first = np.ceil(low / step - 1e-9)
        last = np.floor(high / step + 1e-9)
        if last - first < most:
            return np.arange(first, last + 1) * step + 0.0  # + 0.0 makes -0.0 a plain zero
    return np.array([low, high])


def _words(places: np.ndarray) -> tuple[str, ...]:
    """Return ticks with the digits that tell them apart, and one power of ten where they are tiny
    or huge.
    """
    largest = float(np.abs(places).max(initial=0.0))
    step = float(np.diff(places).min()) if len(places) > 1 else largest
    if largest == 0.0 or step <= 0.0:
        return tuple(number(place) for place in places)
    power = int(np.floor(np.log10(largest)))
    power = power if not -4 < power < 6 else 0
    digits = max(0, int(np.ceil(-np.log10(step / 10.0**power) - 1e-6)))
    return tuple(_word(place, power, digits) for place in places)


def _word(value: float, power: int, digits: int) -> str:
    text = f"{value / 10.0**power:,.{digits}f}"
    if not text.strip("-0."):
        return "0"
    if power:
        text += f"e{power}"
    return text.replace("-", "−")


def number(value: float) -> str:
    """Return a number with three significant digits, with a true minus sign; zero where it is
    round-off.
    """
    if abs(value) < ROUND_OFF:
        return "0"
    power = int(np.floor(np.log10(abs(float(f"{value:.2e}")))))
    if not -4 < power < 6:
        return f"{value / 10.0**power:.3g}e{power}".replace("-", "−")
    return brief(value)


def labelled(chart: str, unit: str) -> tuple[str, str]:
    """Return what stands above a chart before its values, and its label; a label that would be cut
    goes above.
    """
    whole = f"{chart} ({unit})" if unit else chart
    return ("", whole) if len(whole) <= LONGEST_LABEL else (chart, unit)
