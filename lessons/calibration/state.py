"""The inputs, the views with what is true of them, and what one step holds."""

from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated, Literal

import numpy as np

from workbench.algorithms.cameras import calibration
from workbench.algorithms.least_squares.board_adjustment import Adjustment
from workbench.data.framing import Unit
from workbench.data.pictures import Pictures
from workbench.data.views.boards import Fault
from workbench.data.views.corners import MOST_VIEWS, Which
from workbench.geometry.cameras.distortion import NONE, Distortion
from workbench.knobs import Knob, Pick

Lens = Literal["none", "k1", "k1 k2", "k1 k2 p1 p2", "k1 k2 p1 p2 k3"]
COEFFICIENTS: dict[Lens, int] = {
    "none": 0,
    "k1": 1,
    "k1 k2": 2,
    "k1 k2 p1 p2": 4,
    "k1 k2 p1 p2 k3": 5,
}


@dataclass(frozen=True)
class Params:
    """Pictures of a board, what is wrong with them, and the model that is fitted."""

    views: Annotated[int, Knob("How many pictures of the board", 2, 20)] = 8
    tilt: Annotated[
        float, Knob("How far boards are turned away from the picture's plane", 0, 60, unit="deg")
    ] = 30.0
    distance: Annotated[float, Knob("How far away boards are", 0.3, 1.2, unit="m", step=0.05)] = 0.4
    spread: Annotated[
        float, Knob("How far boards go to the sides: 0 in the middle, 1 all over", 0, 1, step=0.05)
    ] = 1.0
    noise: Annotated[
        float, Knob("Noise of each coordinate of a corner (sigma)", 0, 1, unit="px", step=0.05)
    ] = 0.2
    lens: Annotated[Lens, Knob("Which terms of the lens are estimated")] = "k1 k2 p1 p2"
    fault: Annotated[
        Fault, Knob("What is wrong with the printed board; nobody tells the calibration")
    ] = "none"
    bad_corners: Annotated[int, Knob("Corners of view 1 that were found 5 px away", 0, 10)] = 0
    leave_out: Annotated[
        int, Knob("Leave out this view, counted from 0; −1: none", -1, MOST_VIEWS - 1)
    ] = -1
    loss: Annotated[Literal["squares", "Cauchy"], Knob("How much a far corner may pull")] = (
        "squares"
    )
    corner: Annotated[
        float,
        Knob(
            "Residuals beyond this hardly pull",
            0.05,
            5,
            unit="px",
            step=0.05,
            needs={"loss": ("Cauchy",)},
        ),
    ] = 0.3
    shown: Annotated[
        int,
        Knob(
            "Whose picture is shown: click the middle of a board",
            0,
            MOST_VIEWS - 1,
            by=Pick("middles"),
        ),
    ] = 0
    corners: Annotated[
        Path | None, Knob("Own corners: npz (object_points, corners) or lines view X Y u v")
    ] = None
    camera: Annotated[Which, Knob("Which camera, where a file has two", of_files=True)] = "first"
    board: Annotated[
        tuple[int, int],
        Knob(
            "Inner corners of the board where own pictures come without corners",
            3,
            20,
            parts=("in a row", "rows"),
            of_files=True,
        ),
    ] = (9, 6)
    unit: Annotated[Unit, Knob("In which unit an own board is", of_files=True)] = "m"
    images: Annotated[
        Path | None,
        Knob(
            "Own pictures of the views: a folder or a zip of jpg or png; or one picture, of the"
            " view shown"
        ),
    ] = None
    seed: Annotated[int, Knob("Where boards are, and their noise", 0, 99)] = 0


@dataclass(frozen=True, eq=False, kw_only=True)
class Subject:
    """The views that are calibrated from.

    Attributes:
        p_board: Points of the board as they are believed to be, metres.
        uv: Their measured pixels in the views that are used.
        views: The numbers of these views, from 0 on.
        size: Width and height of the pictures.
        K: The true camera, or None where nobody knows it.
        lens: The true lens.
        Ts_camera_board: True poses of the views that are used; none where nobody knows.
        pictures: A person's own pictures of all views.
        without: Names of own pictures in which no whole board was found.
    """

    p_board: np.ndarray
    uv: np.ndarray
    views: tuple[int, ...]
    size: tuple[int, int]
    K: np.ndarray | None = None
    lens: Distortion = NONE
    Ts_camera_board: np.ndarray = field(default_factory=lambda: np.empty((0, 4, 4)))
    pictures: Pictures | None = None
    without: tuple[str, ...] = ()


@dataclass(frozen=True, eq=False, kw_only=True)
class Ending:
    """What is asked once the refinement has ended.

    Attributes:
        kind: How well each view fits; what changes without the worst; or how well all is known.
        worst: Which of the views that are used has the largest rms.
        without: The calibration without it, or None where too few views are left.
        deviation: Predicted standard deviation of where a ray is seen, over the picture, pixels;
            NaN where unknown.
        tilts: Of other boards at the same places: their tilt in degrees, and the predicted
            deviation of f, pixels.
    """

    kind: Literal["views", "without", "known"]
    worst: int
    without: Adjustment | None = None
    deviation: np.ndarray = field(default_factory=lambda: np.empty((0, 0)))
    tilts: tuple[np.ndarray, np.ndarray] | None = None


@dataclass(frozen=True, eq=False, kw_only=True)
class State:
    """One step.

    Attributes:
        params: The inputs.
        subject: The views.
        now: How far the calibration has come.
        rms: Of all residuals so far, as the function in the slot has it, pixels.
        before: The rms one step earlier; NaN at the first.
        shown: Which of the views that are used has its picture shown.
        map_error: How far off rays are seen, over a grid of the picture, pixels; empty where there
            is no camera or truth.
        ending: What is asked at the end, or None before.
    """

    params: Params
    subject: Subject
    now: calibration.State
    rms: float
    before: float
    shown: int
    map_error: np.ndarray
    ending: Ending | None = None

    @property
    def per_view(self) -> np.ndarray:
        """The rms of each view so far, pixels."""
        return np.sqrt(np.square(self.now.residuals).sum(axis=2).mean(axis=1))

    @property
    def worst_in_picture(self) -> float:
        """The largest error of the map within the picture, pixels; NaN where nobody knows."""
        known = self.map_error[np.isfinite(self.map_error)]
        return float(known.max()) if len(known) else float("nan")
