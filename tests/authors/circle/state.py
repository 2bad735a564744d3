"""What a person sets, and what the fit yields."""

from dataclasses import dataclass
from typing import Annotated

import numpy as np

from workbench.knobs import Knob

CENTRE, RADIUS = np.array([0.4, 0.3]), 1.0
"""The true circle, metres."""


@dataclass(frozen=True)
class Params:
    """The inputs of a run."""

    points: Annotated[int, Knob("How many points are measured", 5, 200)] = 40
    arc: Annotated[float, Knob("How much of the circle they cover", 20, 360, unit="deg")] = 360.0
    noise: Annotated[float, Knob("Standard deviation of x and of y", 0, 0.1, unit="m")] = 0.03
    seed: Annotated[int, Knob("Which noise is drawn", 0, 99)] = 0


@dataclass(frozen=True, eq=False, kw_only=True)
class State:
    """One step: the points (n, 2), and the circle of now; the first step has none."""

    k: int
    p: np.ndarray
    circle: np.ndarray | None = None  # x, y, r

    @property
    def rms(self) -> float:
        """The root mean square of the points' distances to the circle, metres."""
        if self.circle is None:
            return float("nan")
        return float(np.sqrt(((radii(self.p, self.circle) - self.circle[2]) ** 2).mean()))

    @property
    def error(self) -> float:
        """How far the radius is from the true one, metres."""
        return float("nan") if self.circle is None else float(abs(self.circle[2] - RADIUS))


def radii(p: np.ndarray, circle: np.ndarray) -> np.ndarray:
    """Return the distance of every point from a circle's centre."""
    return np.linalg.norm(p - circle[:2], axis=1)
