"""The inputs, what is fitted, and what one step holds."""

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Literal

import numpy as np

from workbench.algorithms.fit_studies import Basin, Lines, Rivals, Spread
from workbench.algorithms.least_squares import Along, Descent
from workbench.algorithms.robust import Reweighted
from workbench.algorithms.round_shapes import RoundName, RoundShape
from workbench.data.fit_scenes import Errors
from workbench.data.framing import Unit
from workbench.knobs import Gizmo, Knob

Stage = Literal["descent", "basin", "algebraic", "coin", "line", "robust"]
Method = Literal["Levenberg-Marquardt", "Gauss-Newton"]
LossName = Literal["squares", "Huber", "Cauchy", "Geman-McClure", "Tukey", "Huber then Tukey"]
ROUND = {"stage": ("descent", "basin", "algebraic", "coin")}
DESCENT, WALKS = {"stage": ("descent",)}, {"stage": ("descent", "basin")}
ROBUST = {"stage": ("robust",)}
BENT = {**ROBUST, "loss": ("Huber", "Cauchy", "Geman-McClure", "Tukey", "Huber then Tukey")}
MADE = {"stage": ("descent", "basin", "algebraic", "line", "robust")}


@dataclass(frozen=True)
class Params:
    """What is fitted to what, by which method and from where."""

    stage: Annotated[Stage, Knob("What is shown")] = "descent"
    shape: Annotated[RoundName, Knob("What is fitted", needs=DESCENT)] = "circle"
    arc: Annotated[float, Knob("How much of the way round has points", 20, 360, unit="deg", needs=ROUND)] = 90.0
    points: Annotated[int, Knob("How many points", 10, 2000, needs=MADE)] = 60
    noise: Annotated[
        float, Knob("Standard deviation of each coordinate's error", 0, 0.3, unit="m", step=0.005, needs=MADE)
    ] = 0.02
    errors: Annotated[Errors, Knob("Whether neighbours err alike", needs=DESCENT)] = "independent"
    method: Annotated[Method, Knob("How it goes down", needs=WALKS)] = "Levenberg-Marquardt"
    rest: Annotated[
        Literal["a millionth", "a trillionth"],
        Knob(
            "It stops when a step changes the sum of squares by less than this share of it",
            label="stops at",
            needs=DESCENT,
        ),
    ] = "a millionth"
    start: Annotated[
        tuple[float, float, float],
        Knob("The centre to start from; drag its handle", -4, 4, unit="m", by=Gizmo(0.4), needs=DESCENT),
    ] = (0.5, 0.4, 0.0)
    start_radius: Annotated[float, Knob("The radius to start from", 0.05, 5, unit="m", needs=WALKS)] = 0.7
    start_tilt: Annotated[
        float,
        Knob("How far the axis to start from leans", 0, 89, unit="deg", needs={**DESCENT, "shape": ("cylinder",)}),
    ] = 30.0
    slope: Annotated[float, Knob("How steep the line is", 0, 85, unit="deg", needs={"stage": ("line",)})] = 60.0
    loss: Annotated[LossName, Knob("What a distance costs", needs=ROBUST)] = "Huber"
    corner: Annotated[
        float,
        Knob("Where the loss bends, in σ; 0 is where it costs 5 % of good points", 0, 6, step=0.1, needs=BENT),
    ] = 0.0
    outliers: Annotated[float, Knob("Share of points that lie off the plane", 0, 0.6, step=0.05, needs=ROBUST)] = 0.3
    reach: Annotated[float, Knob("How far off they lie at most", 0.1, 2, unit="m", step=0.1, needs=ROBUST)] = 0.5
    side: Annotated[Literal["one", "both"], Knob("On which side of it", needs=ROBUST)] = "one"
    coin: Annotated[
        tuple[int, int],
        Knob("A pixel inside the coin", 0, 900, unit="px", parts=("u", "v"), needs={"stage": ("coin",)}),
    ] = (337, 125)  # fmt: skip
    cloud: Annotated[
        Path | None, Knob("Own points to fit: x y for a circle, x y z for a sphere, cylinder or plane")
    ] = None
    cloud_unit: Annotated[Unit, Knob("In which unit the numbers of own points are", of_files=True)] = "m"
    image: Annotated[Path | None, Knob("Own photograph instead of the coins: something bright on dark")] = None
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
        photograph: Where the points come from, if from a picture.
        middle: The centre of the whole rim in it, and its radius, pixels.
    """

    p: np.ndarray
    kind: RoundShape | None = None
    truth: np.ndarray | None = None
    p_true: np.ndarray | None = None
    straight: np.ndarray | None = None
    best: np.ndarray | None = None
    scale: float = 1.0
    photograph: np.ndarray | None = None
    middle: tuple[float, float, float] = (0.0, 0.0, 1.0)


@dataclass(frozen=True, eq=False)
class Walked:
    """A moment of a descent, where it has been so far, and while a step is tried the sums of squares along it.

    Attributes:
        now: The moment.
        kept: The unknowns from the start to the present one.
        taken_back: Those that were tried and not kept.
        along: While a step is tried.
    """

    now: Descent
    kept: np.ndarray
    taken_back: np.ndarray
    along: Along | None = None


@dataclass(frozen=True, eq=False)
class Trusted:
    """A round of a reweighted fit.

    Attributes:
        loss: By which loss.
        corner: Where it bends, metres.
        now: The round.
        error: RMS distance of the true plane from the fit, metres; NaN where it is not known.
        squares_error: That of plain least squares.
        last: Whether no other loss follows.
    """

    loss: str
    corner: float
    now: Reweighted
    error: float
    squares_error: float
    last: bool


Now = Walked | Spread | Basin | Rivals | Lines | Trusted


@dataclass(frozen=True, eq=False)
class State:
    """One step of the lesson."""

    params: Params
    subject: Subject
    now: Now
