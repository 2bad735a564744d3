"""What a person sets, and what the fit yields."""

from dataclasses import dataclass
from typing import Annotated

import numpy as np

from workbench.knobs import Knob

TRUE = np.array([0.4, 0.3, 1.0])  # the true circle: x, y, r, metres


@dataclass(frozen=True)
class Params:
    points: Annotated[int, Knob("How many points are measured", 5, 200)] = 40
    arc: Annotated[float, Knob("How much of the circle they cover", 20, 360, unit="deg")] = 360.0
    noise: Annotated[float, Knob("Standard deviation of x and of y", 0, 0.1, unit="m")] = 0.03
    seed: Annotated[int, Knob("Which noise is drawn", 0, 99)] = 0


@dataclass(frozen=True, eq=False)
class State:
    """One step: the points (n, 2), and the circle x, y, r of now, metres."""

    k: int
    p: np.ndarray
    circle: np.ndarray

    @property
    def rms(self) -> float:
        """The root mean square of the points' distances to the circle, metres."""
        return float(
            np.sqrt(
                ((np.linalg.norm(self.p - self.circle[:2], axis=1) - self.circle[2]) ** 2).mean()
            )
        )

    @property
    def error(self) -> float:
        """How far the radius is from the true one, metres."""
        return float(abs(self.circle[2] - TRUE[2]))
