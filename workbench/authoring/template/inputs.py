"""What a person sets, what a run is about, and what a step is."""

from dataclasses import dataclass

import numpy as np

from workbench.lesson import Params, cached, knob

P_TRUE = np.array([0.2, -0.1, 0.4])
"""Where the beacon is, metres."""
P_OTHER = P_TRUE + np.array([0.8, 0.3, 0.0])
"""Where another beacon is, metres."""


class Input(Params):
    """The inputs: every field becomes a control, a flag of the commands and a part of links."""

    weight: float = knob(1.0, "How much a fix of the bad sensor counts; a good one counts 1", 0, 1)
    fixes: int = knob(30, "How many times the beacon is measured", 2, 60)
    good: float = knob(0.04, "Standard deviation of the good sensor", 0.01, 0.3, unit="m")
    bad: float = knob(0.08, "Standard deviation of the bad sensor", 0.01, 0.3, unit="m")
    strays: int = knob(0, "How many fixes of the good sensor are of another beacon", 0, 5)
    seed: int = knob(86, "Which noise is drawn", 0, 99)


@dataclass(frozen=True, eq=False)
class Fixes:
    """The measurements p (n, 3), metres, and which of them (n,) the good sensor made."""

    p: np.ndarray
    is_good: np.ndarray


@cached
def setup(params: Input) -> Fixes:
    """Return the fixes, made by both sensors in turn; the last good ones may be strays."""
    rng = np.random.default_rng(params.seed)
    is_good = np.arange(params.fixes) % 2 == 0
    sigma = np.where(is_good, params.good, params.bad)
    p = P_TRUE + sigma[:, None] * rng.standard_normal((params.fixes, 3))
    strays = np.flatnonzero(is_good)[::-1][: params.strays]
    p[strays] += P_OTHER - P_TRUE
    return Fixes(p, is_good)


@dataclass(frozen=True, eq=False)
class Estimate:
    """One step: the estimate p (3,) of the first `count` fixes, metres, and all their weights."""

    count: int
    p: np.ndarray
    w: np.ndarray


def expected_error(params: Input, weight: np.ndarray) -> np.ndarray:
    """Return the RMS distance of the estimate from the beacon over all noise, metres."""
    n_bad = params.fixes // 2
    n_good = params.fixes - n_bad
    variance = n_good * params.good**2 + n_bad * (weight * params.bad) ** 2
    return np.sqrt(3 * variance) / (n_good + n_bad * weight)
