"""Steps and numbers of a story in the runs that they name: where `stop` is, what a scalar says
there.
"""

import math
import re
from collections.abc import Mapping

from workbench.run.series import Series
from workbench.run.timeline import Timeline, stop_of
from workbench.story.model import StepName, Value

LENGTHS: Mapping[str, float] = {"m": 1.0, "cm": 0.01, "mm": 0.001, "µm": 1e-6, "km": 1000.0}
"""Units of length, in metres."""
_NUMBER = re.compile(r"(?P<sign>[−-]?)(?P<digits>\d[\d,]*(?:\.\d+)?)\s*(?P<unit>.*)")


def step_in(timeline: Timeline, step: StepName) -> int | None:
    """Return the index of a step of a finished run, None where it has none such."""
    if step == "stop":
        return stop_of(timeline)
    k = int(step)
    index = k if k >= 0 else len(timeline) + k
    return index if 0 <= index < len(timeline) else None


def series_in(timeline: Timeline, name: str) -> Series | None:
    """Return the scalar of a run that a story names: by its path, else by its name; None where
    there is none.
    """
    series = timeline.series()
    if name in series:
        return series[name]
    return next((column for column in series.values() if column.scalar.name == name), None)


def disagreement(value: Value, timeline: Timeline) -> str | None:
    """Say how a number in the words differs from that of its run, by the digits that are
    written; None if not.
    """
    series = series_in(timeline, value.series)
    if series is None:
        return f"the run {value.run!r} has no scalar {value.series!r}"
    k = step_in(timeline, value.step)
    if k is None:
        return f"the run {value.run!r} has no step {value.step}"
    actual = float(series.values[k])
    written = _NUMBER.search(value.text)
    if written is None:
        return f"{value.text!r} is no number"
    unit = written["unit"].strip().split(" ")[0].rstrip(".,;:")
    factor = factor_of(unit, series.scalar.unit)
    if factor is None:
        return f"{value.text!r} is in {unit!r}, and {value.series} in {series.scalar.unit!r}"
    claim = float(written["digits"].replace(",", "")) * (-1.0 if written["sign"] else 1.0)
    decimals = len(written["digits"].partition(".")[2])
    if math.isfinite(actual) and abs(actual / factor - claim) <= 0.5 * 10.0**-decimals * (1 + 1e-9):
        return None
    return (
        f"it says {value.text!r}, and {value.series} at {value.run}@{value.step} is"
        f" {actual / factor:.6g} {unit}"
    )


def factor_of(written: str, unit: str) -> float | None:
    """Return how many of a scalar's units a written unit is; None where they do not go together."""
    same = {"°": "deg", "": "", "×": "", "%": "%"}
    if written in LENGTHS and unit in LENGTHS:
        return LENGTHS[written] / LENGTHS[unit]
    if written == "%" and unit == "":
        return 0.01
    if same.get(written, written) == same.get(unit, unit) or unit in ("", "×"):
        return 1.0
    return 1.0 if written == "" else None  # a number without its unit, such as a count
