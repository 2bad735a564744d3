"""The inputs, the two clouds, and one step of both flows with all that is measured of it."""

import functools
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Literal

import numpy as np

from lessons.chamfer_emd.point_sets import Shape
from workbench.algorithms.transport import TransportPlan, blurred_earth_movers
from workbench.algorithms.transport.flow import Flow
from workbench.geometry.points.shape_distances import Definition, NearestPoints
from workbench.knobs import Knob

Start = Literal[
    "blob",
    "larger",
    "bunched",
    "bump",
    "part missing",
    "one outlier",
    "shuffled rows",
    "doubled points",
]
Lowers = Literal["both sides", "source to target", "target to source"]


@dataclass(frozen=True)
class Params:
    """Two clouds, what the left flow lowers, and how far flows step."""

    shape: Annotated[Shape, Knob("The built-in target", label="Target")] = "ring"
    start: Annotated[Start, Knob("A blob, or the target after one change", label="Source")] = "blob"
    amount: Annotated[
        float,
        Knob(
            "How much: blob, bump and outlier in metres; the others as a share, up to 1",
            0,
            3,
            step=0.001,
        ),
    ] = 0.3
    points: Annotated[
        int,
        Knob(
            "Points of the target; an own cloud is thinned to them", 10, 200, label="Target points"
        ),
    ] = 80
    source_points: Annotated[
        int, Knob("Points of the source; 0 takes as many as the target has", 0, 200)
    ] = 0
    lowers: Annotated[
        Lowers, Knob("Which sides of Chamfer the left flow lowers", label="Left flow lowers")
    ] = "both sides"
    blur: Annotated[
        float,
        Knob(
            "Regularisation of Sinkhorn's transport",
            0.01,
            2,
            unit="m",
            step=0.01,
            label="Sinkhorn blur",
        ),
    ] = 0.05
    near: Annotated[
        float,
        Knob(
            "Up to here the F-score counts a point, and mass is not astray",
            0.01,
            0.5,
            unit="m",
            step=0.01,
        ),
    ] = 0.1
    longest_step: Annotated[
        float, Knob("No step moves the points farther than this", 0.01, 0.3, unit="m", step=0.01)
    ] = 0.06
    steps: Annotated[int, Knob("Steps of each flow, unless it ends before", 0, 150)] = 40
    target: Annotated[
        Path | None, Knob("Own target cloud: ply, pcd, obj, xyz, csv, npz; scaled to the picture")
    ] = None
    source: Annotated[Path | None, Knob("Own source cloud, in the frame of the own target")] = None
    seed: Annotated[
        int, Knob("Which points of the blob, which order, which points of own clouds", 0, 99)
    ] = 0


@dataclass(frozen=True, eq=False, kw_only=True)
class Clouds:
    """Source and target of a run in one frame, metres of the picture.

    Attributes:
        p_source: Where both flows start.
        p_target: Where they should go.
        name: What the source is, in words.
        scale: Metres of the picture per unit of an own cloud; 1 for built-in ones.
    """

    p_source: np.ndarray
    p_target: np.ndarray
    name: str
    scale: float


@dataclass(frozen=True, eq=False, kw_only=True)
class Numbers:
    """Distances of one cloud to the target. Metres, and square metres where the name says squared.

    Attributes:
        chamfer: By the function in the slot: ours is the mean of squares, both sides.
        definitions: Two-sided Chamfer by the name of its definition.
        to_target, to_source: One-sided Chamfer by the function in its slot: from the cloud to the
            target, and back.
        earth_movers: By the function in the slot: ours is exact.
        hausdorff, f_score: As named.
        index_mse: Mean squared distance of rows with the same index; NaN where the counts differ.
        astray: The share of the cloud's mass whose place in the best one-to-one matching is farther
            than `Params.near`.
    """

    chamfer: float
    definitions: dict[Definition, float]
    to_target: float
    to_source: float
    earth_movers: float
    hausdorff: float
    f_score: float
    index_mse: float
    astray: float


@dataclass(frozen=True, eq=False, kw_only=True)
class Side:
    """One of the two flows at one step: where it is, its numbers, and who is matched to whom."""

    flow: Flow
    numbers: Numbers
    near: NearestPoints
    matching: TransportPlan
    p_target: np.ndarray
    blur: float

    @functools.cached_property
    def sinkhorn(self) -> float:
        """The cost of Sinkhorn's blurred plan, metres; found when first asked for: nothing else
        depends on it.
        """
        return blurred_earth_movers(
            self.flow.p_moving, self.p_target, self.blur, max_sweeps=200, tolerance=1e-4
        )

    @property
    def served(self) -> np.ndarray:
        """How many target points have each point of the cloud as their nearest."""
        return np.bincount(self.near.b_to_a, minlength=len(self.flow.p_moving))


@dataclass(frozen=True, eq=False, kw_only=True)
class State:
    """One step of both flows; the one that ended first waits for the other.

    Attributes:
        step: Counted from 0, the start.
        params: The inputs.
        clouds: Source and target.
        left: The flow that lowers Chamfer, or one side of it.
        right: The flow that lowers the earth mover's distance.
        before: The numbers of both clouds one step earlier, or None.
        yardsticks: Numbers of known changes of the target, by name; the same in all steps.
        last: Whether both flows have ended.
    """

    step: int
    params: Params
    clouds: Clouds
    left: Side
    right: Side
    before: tuple[Numbers, Numbers] | None
    yardsticks: dict[str, Numbers]
    last: bool
