"""The inputs, what is fitted, and what one step holds."""

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Annotated, Literal

import numpy as np

from lessons.fitting.fit_scenes import Errors
from lessons.fitting.fit_studies import Basin, Lines, Rivals, Spread
from lessons.fitting.round_shapes import RoundName, RoundShape
from workbench.algorithms.least_squares import Walked
from workbench.algorithms.robust import Trusted
from workbench.algorithms.robust.models import PLANE, rms_distance
from workbench.data.files.rims import Rim
from workbench.data.framing import Unit
from workbench.knobs import Gizmo, Knob

Stage = Literal["descent", "basin", "algebraic", "coin", "line", "robust"]
Method = Literal["Levenberg-Marquardt", "Gauss-Newton"]
LossName = Literal["squares", "Huber", "Cauchy", "Geman-McClure", "Tukey", "Huber then Tukey"]
ROUND = {"stage": ("descent", "basin", "algebraic", "coin")}
DESCENT = {"stage": ("descent",)}
WALKS = {"stage": ("descent", "basin")}
ROBUST = {"stage": ("robust",)}
OF_POINTS = {"stage": ("descent", "basin", "algebraic", "robust")}
BENT = {**ROBUST, "loss": ("Huber", "Cauchy", "Geman-McClure", "Tukey", "Huber then Tukey")}
PLANE_PLACES = np.stack(
    [*np.meshgrid(*2 * [np.linspace(-1.0, 1.0, 9)]), np.zeros((9, 9))], axis=-1
).reshape(-1, 3)
MADE = {"stage": ("descent", "basin", "algebraic", "line", "robust")}


@dataclass(frozen=True)
class Params:
    """What is fitted to what, by which method and from where."""

    stage: Annotated[Stage, Knob("What is shown")] = "descent"
    shape: Annotated[RoundName, Knob("What is fitted", needs=DESCENT)] = "circle"
    arc: Annotated[
        float, Knob("How much of the way round has points", 20, 360, unit="deg", needs=ROUND)
    ] = 90.0
    points: Annotated[int, Knob("How many points", 10, 2000, needs=MADE)] = 60
    noise: Annotated[
        float,
        Knob(
            "Standard deviation of each coordinate's error",
            0,
            0.3,
            unit="m",
            step=0.005,
            needs=MADE,
        ),
    ] = 0.02
    errors: Annotated[Errors, Knob("Whether neighbours err alike", needs=DESCENT)] = "independent"
    method: Annotated[Method, Knob("How it goes down", needs=WALKS)] = "Levenberg-Marquardt"
    rest: Annotated[
        Literal["a millionth", "a trillionth"],
        Knob(
            "It stops when a step changes the sum of squares by less than this share",
            label="stops at",
            needs=DESCENT,
        ),
    ] = "a millionth"
    start: Annotated[
        tuple[float, float, float],
        Knob(
            "The centre to start from; drag its handle",
            -4,
            4,
            unit="m",
            by=Gizmo(0.4),
            needs=DESCENT,
        ),
    ] = (0.5, 0.4, 0.0)
    start_radius: Annotated[
        float, Knob("The radius to start from", 0.05, 5, unit="m", needs=WALKS)
    ] = 0.7
    start_tilt: Annotated[
        float,
        Knob(
            "How far the axis to start from leans",
            0,
            89,
            unit="deg",
            needs={**DESCENT, "shape": ("cylinder",)},
        ),
    ] = 30.0
    slope: Annotated[
        float, Knob("How steep the line is", 0, 85, unit="deg", needs={"stage": ("line",)})
    ] = 60.0
    loss: Annotated[LossName, Knob("What a distance costs", needs=ROBUST)] = "Huber"
    corner: Annotated[
        float,
        Knob(
            "Where the loss bends, in σ; 0 is where it costs 5 % of good points",
            0,
            6,
            step=0.1,
            needs=BENT,
        ),
    ] = 0.0
    outliers: Annotated[
        float, Knob("Share of points that lie off the plane", 0, 0.6, step=0.05, needs=ROBUST)
    ] = 0.3
    reach: Annotated[
        float, Knob("How far off they lie at most", 0.1, 2, unit="m", step=0.1, needs=ROBUST)
    ] = 0.5
    side: Annotated[Literal["one", "both"], Knob("On which side of it", needs=ROBUST)] = "one"
    coin: Annotated[
        tuple[int, int],
        Knob(
            "A pixel inside the coin",
            0,
            900,
            unit="px",
            parts=("u", "v"),
            needs={"stage": ("coin",)},
        ),
    ] = (337, 125)
    cloud: Annotated[
        Path | None,
        Knob(
            "Own points to fit: x y for a circle, x y z for a sphere, cylinder or plane",
            needs=OF_POINTS,
        ),
    ] = None
    cloud_unit: Annotated[
        Unit, Knob("In which unit the numbers of own points are", of_files=True)
    ] = "m"
    image: Annotated[
        Path | None,
        Knob(
            "Own photograph instead of the coins: something bright on dark",
            needs={"stage": ("coin",)},
        ),
    ] = None
    seed: Annotated[int, Knob("Which errors chance makes", 0, 99, needs=MADE)] = 3


@dataclass(frozen=True, eq=False, kw_only=True)
class Subject:
    """What is fitted to, the same for a whole run.

    Attributes:
        p: The points, (n, 2) or (n, 3), metres; of a coin in radii of its whole rim.
        kind: What is fitted to them; None for lines and planes.
        truth: The true unknowns; None where nobody knows.
        p_true: The points without their errors, where known; of a coin all its rim.
        straight: The best straight line (a, b, c), for points in the plane.
        best: The unknowns with the least squares, where known.
        scale: Metres of what was measured per metre of the picture.
        rim: What the points are a part of, if they come from a photograph.
    """

    p: np.ndarray
    kind: RoundShape | None = None
    truth: np.ndarray | None = None
    p_true: np.ndarray | None = None
    straight: np.ndarray | None = None
    best: np.ndarray | None = None
    scale: float = 1.0
    rim: Rim | None = None

    @property
    def straight_cost(self) -> float:
        """The sum of squares of the best straight line through points in the plane; NaN where there
        is none.
        """
        line = self.straight
        return np.nan if line is None else float(np.square(self.p @ line[:-1] + line[-1]).sum())

    @cached_property
    def least_cost(self) -> float:
        """The least sum of squares; NaN where nobody knows it."""
        if self.best is None or self.kind is None:
            return np.nan
        return float(np.square(self.kind.linearise(self.best, self.p)[0]).sum())

    def off_best(self, unknown: np.ndarray) -> float:
        """Return how far the numbers of a fit are from those with the least squares, metres; NaN
        where nobody knows.
        """
        return np.nan if self.best is None else float(np.abs(unknown - self.best).max())


Now = Walked | Spread | Basin | Rivals | Lines | Trusted


@dataclass(frozen=True, eq=False)
class State:
    """One step of the lesson."""

    params: Params
    subject: Subject
    now: Now

    @property
    def plane_errors(self) -> tuple[float, float]:
        """The RMS distances of the true plane from the fit and from that of least squares, metres;
        NaN if not known.
        """
        if not isinstance(self.now, Trusted) or self.subject.truth is None:
            return np.nan, np.nan
        fit, first = (
            rms_distance(PLANE, plane, PLANE_PLACES)
            for plane in (self.now.now.estimate, self.now.first)
        )
        return fit, first

    @property
    def plane_is_right(self) -> bool:
        """Whether the plane is nearer to the true one than the noise allows single points to be."""
        return self.plane_errors[0] < max(self.params.noise, 0.005)
