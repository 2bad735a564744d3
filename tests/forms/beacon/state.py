"""What a person sets, and what the algorithm yields."""

from dataclasses import dataclass
from typing import Annotated, Literal

import numpy as np

from workbench.knobs import Knob

P_TRUE = np.array([0.2, -0.1, 0.4])
"""Where the beacon is, metres."""


@dataclass(frozen=True)
class Params:
    """The inputs of a run: every field becomes a control, a flag of the commands and a part of
    links.
    """

    fixes: Annotated[int, Knob("How many times the beacon is measured", 2, 60)] = 30
    good: Annotated[float, Knob("Standard deviation of the good sensor", 0, 0.3, unit="m")] = 0.02
    bad: Annotated[float, Knob("Standard deviation of the bad sensor", 0, 0.3, unit="m")] = 0.2
    weights: Annotated[Literal["one over variance", "equal"], Knob("How much a fix counts")] = (
        "one over variance"
    )
    outliers: Annotated[
        int, Knob("How many fixes of the good sensor are of another beacon", 0, 5)
    ] = 0
    seed: Annotated[int, Knob("Which noise is drawn", 0, 99)] = 0


@dataclass(frozen=True, eq=False, kw_only=True)
class State:
    """One step: the fixes so far (k, 3), their weights (k,), and the estimate (3,), metres."""

    p: np.ndarray
    w: np.ndarray
    p_estimate: np.ndarray

    @property
    def spread(self) -> float:
        """The weighted RMS distance of the fixes from the estimate, metres: what the centroid makes
        smallest.
        """
        squared = ((self.p - self.p_estimate) ** 2).sum(axis=1)
        return float(np.sqrt(self.w @ squared / self.w.sum()))

    @property
    def error(self) -> float:
        """The distance of the estimate from the truth, metres."""
        return float(np.linalg.norm(self.p_estimate - P_TRUE))
