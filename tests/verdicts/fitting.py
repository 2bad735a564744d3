"""When the sentences of the fitting lesson are true, decided by scipy, differences and counting
from its states.
"""

import re

import numpy as np
import scipy

from lessons.fitting.presets import LEAP
from tests.readings import LENGTH, NUMBER, POWER, near, near_length, number, says
from tests.truths.fitting import (
    cost,
    distances,
    is_right,
    least,
    plane_error,
    radius_deviation,
    straight,
    wider,
)
from tests.verdicts import Claim, Run

__all__ = ["CAPTIONS", "LINES", "WHYS", "right"]

SQUARE = rf"{NUMBER} m?m²"


def right(run: Run, k: int) -> bool | None:
    return is_right(run.states[k])


def says_square(text: str, value: float, digits: int = 3) -> bool:
    numeral, unit = text.rsplit(" ", 1)
    return near(numeral, value * (1e6 if unit == "mm²" else 1.0), digits)


def same(text: str, value: float, share: float = 2e-3) -> bool:
    """A sum of squares to its digits, or as near as two solvers come."""
    numeral, unit = text.rsplit(" ", 1)
    written = number(numeral) * (1e-6 if unit == "mm²" else 1.0)
    return says_square(text, value) or abs(written - value) <= share * value + 1e-12


def least_of_all(run: Run, k: int, m: re.Match[str]) -> bool:
    state = run.states[k]
    unknown = state.now.now.unknown
    squares = cost(state, unknown)
    off = abs(abs(unknown[-1]) - state.subject.truth[-1])
    return (
        same(m[1], squares) and squares <= 1.0011 * least(state) and near_length(m[2], float(off))
    )


def no_circle(run: Run, k: int, m: re.Match[str]) -> bool:
    """What escaped costs what a straight line costs, and more than the best circle, if there is
    one.
    """
    state = run.states[k]
    unknown = state.now.now.unknown
    line = straight(state.subject.p)
    squares = cost(state, unknown)
    if not (
        same(m[1], squares)
        and same(m[2], line)
        and abs(squares / line - 1) < 0.5
        and abs(unknown[-1]) > 50
    ):
        return False
    if m[3] is None:
        return squares <= 1.0011 * least(state)
    return same(m[3], least(state)) and squares > 1.0009 * least(state)


def another_end(run: Run, k: int, m: re.Match[str]) -> bool:
    state = run.states[k]
    squares = cost(state, state.now.now.unknown)
    return same(m[1], squares) and same(m[2], least(state)) and squares > 1.0009 * least(state)


def no_end(run: Run, k: int, m: re.Match[str]) -> bool:
    descent = run.states[k].now.now
    J = descent.jacobian
    return bool(np.linalg.cond(J.T @ J) > 1e13) or not np.isfinite(descent.trial_cost)


def repeated(run: Run, k: int, m: re.Match[str]) -> bool:
    state = run.states[k]
    spread = state.now
    sd = radius_deviation(state, spread.unknown)
    low, high = np.quantile(spread.radii, [0.05, 0.95])
    middle = abs(spread.unknown[-1])
    told = zip(
        m.groups()[:4],
        (low, high, middle - 1.6449 * sd, middle + 1.6449 * sd),
        (6e-3, 6e-3, 7e-3, 7e-3),
        strict=True,
    )
    if not all(
        abs(_metres(text) - value) <= share * max(abs(value), sd) for text, value, share in told
    ):
        return False
    times = wider(state)
    if (m[7] is not None) != (middle < 1.6449 * sd):
        return False
    if m[5] is None:
        return 1 / 1.5 <= times <= 1.5
    return near(m[6], times if m[5] == "narrow" else 1 / times, 2) and (
        times > 1.5 if m[5] == "narrow" else times < 1 / 1.5
    )


def _metres(text: str) -> float:
    numeral, unit = text.rsplit(" ", 1)
    return number(numeral) * {"km": 1e3, "m": 1.0, "mm": 1e-3, "µm": 1e-6}[unit]


def homes(run: Run, k: int) -> float:
    basin = run.states[k].now
    unknowns = basin.now.unknowns.copy()
    unknowns[:, 2] = abs(unknowns[:, 2])
    return float((np.abs(unknowns - basin.best).max(axis=1) < 0.01).mean())


def came_home(run: Run, k: int, m: re.Match[str]) -> bool:
    return abs(number(m[1].rstrip(" %")) / 100 - homes(run, k)) < 0.006


def trusted(run: Run, k: int, m: re.Match[str]) -> bool:
    state = run.states[k]
    off = plane_error(state.now.now.estimate)
    first = run.states[0].now.now.estimate
    good = (m[2] is None or near_length(m[2], plane_error(first))) and near_length(m[1], off)
    return good and bool(m[3]) == (state.now.last and off >= max(state.params.noise, 0.005))


def never_rises(run: Run, k: int, m: re.Match[str]) -> bool:
    costs = [s.now.now.cost for s in run.states if type(s.now).__name__ == "Walked"]
    return bool((np.diff(costs) <= 0).all())


def biased(run: Run, k: int, m: re.Match[str]) -> bool:
    rivals = run.states[-1].now
    of = dict(zip(rivals.circles, rivals.medians[-1], strict=True))
    return abs(of["geometric"] - 1.005) < 0.0025 and abs(of["Taubin"] - 1.010) < 0.0025


CAPTIONS = (
    Claim(
        rf"({SQUARE}), R = {LENGTH}: the least there is, right\.(?: R is ({LENGTH}) off the"
        r" truth\.)?",
        least_of_all,
    ),
    Claim(
        rf"({SQUARE}), R = {LENGTH}: the best straight line has ({SQUARE}) as well, and that is"
        r" what this circle is\."
        rf"(?: A circle of ({SQUARE}) exists\. It looks settled, and it is wrong\.| Nothing round"
        r" fits better\.)",
        no_circle,
    ),
    Claim(
        rf"({SQUARE}), R = {LENGTH}; the least is ({SQUARE})\. It (?:looks settled, and it )?is"
        r" wrong\.",
        another_end,
    ),
    Claim(
        rf"with R = (?:{POWER} k?m|{LENGTH}|no number): (?:the linear problem has no one"
        r" solution|the numbers are not finite"
        r" any more)\. It is wrong\.",
        no_end,
    ),
    Claim(
        rf"the middle 90 % of radii reach from ({LENGTH}) to ({LENGTH})\. The covariance said"
        rf" ({LENGTH}) to ({LENGTH})"
        rf"(?:: about right|(?:: about as wide|, too (narrow|wide) by a factor of ({NUMBER}))"
        r"(, and no circle has a radius below 0)?\. It is wrong)\.",
        repeated,
    ),
    Claim(rf"({NUMBER} %) of the starts are within 1 cm of the best circle", came_home),
    Claim(r"as a share of the true radius|takes [xy] as exact", None),
    Claim(
        rf"RMS error to the truth ({LENGTH})(?:, of least squares ({LENGTH})\.)?( It (?:looks"
        r" settled, and it )?is wrong)?",
        trusted,
    ),
)


def leaps(run: Run, k: int, m: re.Match[str]) -> bool:
    """Of the preset's own seed: the sums of squares of the start and of the first circle, and R
    after four.
    """
    if run.params.seed != LEAP.seed:
        return True
    kept = [
        s.now.now
        for s in run.states
        if type(s.now).__name__ == "Walked" and s.now.now.phase in ("start", "accepted")
    ]
    first, second = (cost(run.states[0], descent.unknown) for descent in kept[:2])
    return (
        says_square(m[1], first)
        and says_square(m[2], second)
        and near_length(m[3], abs(kept[4].unknown[-1]))
    )


LINES = {
    "jumps": (Claim(rf"from ({SQUARE}) to ({SQUARE}), and after four R is ({LENGTH})\.", leaps),),
    "damped": (
        Claim(
            r"It comes home\.",
            lambda run, k, m: bool(run.states[-1].now.radii.size) and right_end(run),
        ),
    ),
    "basin": (Claim(r"Green ones come home", lambda run, k, m: 0.4 < homes(run, k) < 0.8),),
    "basin-jumps": (Claim(r"how many come home now", lambda run, k, m: homes(run, k) < 0.5),),
    "basin-full": (
        Claim(r"may start anywhere in the picture", lambda run, k, m: homes(run, k) == 1.0),
    ),
    "tukey": (Claim(r"the wrong points are beyond it", None),),
    "escape": (Claim(r"No step raises the sum of squares", never_rises),),
    "bias": (Claim(r"too large by σ² / 2, Taubin's by twice that", biased),),
    "short-arc": (Claim(r"which of them keeps the radius", None),),
}


def right_end(run: Run) -> bool:
    """Whether the descent ended on the least sum of squares."""
    state = [s for s in run.states if type(s.now).__name__ == "Walked"][-1]
    return cost(state, state.now.now.unknown) <= 1.0011 * least(state)


def median(run: Run, name: str) -> float:
    rivals = run.states[-1].now
    return rivals.medians[-1][list(rivals.circles).index(name)]


def kept_share(run: Run, k: int, m: re.Match[str]) -> bool:
    return (
        says(m[1], median(run, "Kåsa"))
        and says(m[2], median(run, "Taubin"))
        and median(run, "Kåsa") < 0.7
    )


def iteration_near(run: Run, k: int, m: re.Match[str]) -> bool:
    """The best circle by scipy, and the first iteration that is within 10 µm of it."""
    subject = run.states[0].subject
    solve = scipy.optimize.least_squares
    best = solve(
        lambda c: distances("circle", c, subject.p),
        subject.truth,
        xtol=1e-15,
        ftol=1e-15,
        gtol=1e-15,
    ).x
    moments = [s.now.now for s in run.states if type(s.now).__name__ == "Walked"]
    return int(m[1]) == min(
        descent.iteration for descent in moments if np.abs(descent.unknown - best).max() < 1e-5
    )


def slopes(run: Run, k: int, m: re.Match[str]) -> bool:
    """The median of regressions is flatter than the truth by about what the formula says."""
    angles = run.states[-1].now.angles
    v = np.cos(np.radians(60)) ** 2 / 3
    theory = np.degrees(np.arctan(np.tan(np.radians(60)) * v / (v + 0.1**2)))
    upright, across = float(np.median(angles["upright"])), float(np.median(angles["perpendicular"]))
    return (
        near(m[1], upright)
        and near(m[2], across)
        and abs(upright - theory) < 1.5
        and abs(across - 60) < 0.7
    )


def escaped(run: Run, k: int, m: re.Match[str]) -> bool:
    state = [s for s in run.states if type(s.now).__name__ == "Walked"][-1]
    descent = state.now.now
    return (
        int(m[1]) == descent.iteration
        and near_length(m[2], abs(descent.unknown[-1]))
        and same(m[3], cost(state, descent.unknown))
        and same(m[4], straight(state.subject.p))
        and descent.cost < 1.01 * straight(state.subject.p)
    )


def tukey_end(run: Run, k: int, m: re.Match[str]) -> bool:
    end, first = (plane_error(run.states[k].now.now.estimate) for k in (-1, 0))
    return near_length(m[1], end) and near_length(m[2], first) and end > 0.05


WHYS = {
    "predict-kasa": (Claim(rf"^({NUMBER}); Taubin's is ({NUMBER})\.", kept_share),),
    "predict-end": (
        Claim(
            rf"^After (\d+) iterations R = ({LENGTH})\. The sum of squares fell to ({SQUARE}), that"
            r" of the best straight"
            rf" line: ({SQUARE})\.",
            escaped,
        ),
    ),
    "predict-iterations": (Claim(r"^The (\d+)th\.", iteration_near),),
    "predict-slope": (Claim(rf"^({NUMBER})°: errors in x .* give ({NUMBER})°\.", slopes),),
    "predict-alike": (
        Claim(
            rf"^({NUMBER}) times\.",
            lambda run, k, m: abs(number(m[1]) - wider(run.states[-1])) < 0.06,
        ),
    ),
    "predict-tukey": (
        Claim(rf"^({LENGTH}) off, least squares ({LENGTH})\.", tukey_end),
        Claim(r"lies among the wrong points: those of the true plane", None),
    ),
}
