"""The inputs, the two scans, and the steps."""

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Literal

import numpy as np

from workbench.algorithms.registration.jacobi import State as Rotated
from workbench.data.framing import Up
from workbench.knobs import Gizmo, Knob

Shape = Literal["rabbit", "box", "vase", "cube", "plate"]
Signs = Literal["none", "largest-entry", "third-moment"]
Noisy = Literal["both", "target"]
Moment = Literal["cloud", "centroid", "covariance", "rotation", "order", "signs", "pose", "turns"]
OF_BOTH = ("shape", "side", "fresh", "density", "seen", "turn", "noise")

HOME_DEGREES = 10.0


@dataclass(frozen=True)
class Params:
    """A shape scanned twice, what is wrong with the second scan, and how they are aligned."""

    shape: Annotated[Shape, Knob("What is scanned: lopsided, or with a symmetry of its own")] = (
        "rabbit"
    )
    signs: Annotated[Signs, Knob("How each axis gets its sign")] = "third-moment"
    turn: Annotated[
        float,
        Knob(
            "How far the second scan is turned away, about a slanting axis",
            0,
            180,
            unit="deg",
            step=1,
        ),
    ] = 130.0
    fresh: Annotated[bool, Knob("The second scan has points of its own, not the same ones")] = False
    points: Annotated[int, Knob("Points of each scan", 100, 20_000, step=100)] = 1500
    noise: Annotated[
        float, Knob("Noise of each coordinate (standard deviation)", 0, 0.2, unit="m", step=0.005)
    ] = 0.0
    noisy: Annotated[Noisy, Knob("Which scan has the noise")] = "both"
    side: Annotated[
        float,
        Knob(
            "Middle side of the box or plate; its long one is 1 m",
            0.4,
            1,
            unit="m",
            step=0.01,
            needs={"shape": ("box", "plate")},
        ),
    ] = 0.6
    density: Annotated[
        int, Knob("How many times as dense the second scan is above its middle", 1, 5)
    ] = 1
    seen: Annotated[
        float, Knob("Share of the shape that the second scan saw", 0.3, 1, step=0.05)
    ] = 1.0
    stray: Annotated[
        tuple[float, float, float],
        Knob(
            "Drag the handle out of the second scan: one stray point; none at the origin",
            -10,
            10,
            unit="m",
            by=Gizmo(0.3),
        ),
    ] = (0.0, 0.0, 0.0)
    source: Annotated[
        Path | None, Knob("Own cloud in place of the shape: ply, pcd, obj, xyz, csv, npz")
    ] = None
    target: Annotated[Path | None, Knob("Own first scan, onto which the own cloud is brought")] = (
        None
    )
    truth: Annotated[Path | None, Knob("Known pose of the own cloud in the first scan's frame")] = (
        None
    )
    up: Annotated[Up, Knob("Which axis of own clouds points up", of_files=True)] = "z"
    seed: Annotated[int, Knob("Which points are sampled", 0, 99)] = 0

    @property
    def idle(self) -> tuple[str, ...]:
        """The inputs that were changed and have no effect, since own clouds are open."""
        names = (
            () if self.source is None else OF_BOTH if self.target is not None else ("shape", "side")
        )
        return tuple(name for name in names if getattr(self, name) != getattr(Params, name))


@dataclass(frozen=True, eq=False, kw_only=True)
class Scans:
    """Two scans, each in its own frame, metres; the source's frame is the world that is shown.

    Attributes:
        p_target: The first scan.
        p_source: The second; row by row the partners of the first's where the lesson goes by pairs.
        T_target_source: What truly brings the second to the first, scale included; None where
            nobody knows or nothing does.
        T_world_target: Where the first scan is shown, beside the second.
        own: Whether both are a person's own.
        stray: The stray point, source frame, where there is one.
    """

    p_target: np.ndarray
    p_source: np.ndarray
    T_target_source: np.ndarray | None
    T_world_target: np.ndarray
    own: bool = False
    stray: np.ndarray | None = None


@dataclass(frozen=True, eq=False, kw_only=True)
class Outcome:
    """How well a map brings the source to the target.

    Attributes:
        T_target_source: The map.
        rotation: Degrees to the truth; NaN where that is not known.
        axes: Degrees between each axis, brought over by the truth, and its namesake of the target.
        gap: Root mean square distance from the moved source's points to the nearest of the target,
            metres.
    """

    T_target_source: np.ndarray
    rotation: float
    axes: np.ndarray | None
    gap: float

    @property
    def home(self) -> bool:
        """Whether it is the true rotation, but for sampling."""
        return self.rotation < HOME_DEGREES


@dataclass(frozen=True, eq=False, kw_only=True)
class Turns:
    """The same recipe on the second scan turned at random, many times.

    Attributes:
        degrees: How far each ended from the truth.
        tips: Where axes 1 and 2 of the turned scan came to lie in the target's frame, unit vectors
            (k, 2, 3).
        axes: How far each axis came from its namesake of the target, whatever its sign, degrees (k,
            3).
    """

    degrees: np.ndarray
    tips: np.ndarray
    axes: np.ndarray

    @property
    def home(self) -> np.ndarray:
        """Which came home."""
        return self.degrees < HOME_DEGREES


@dataclass(frozen=True, eq=False, kw_only=True)
class State:
    """One step; what is not known yet is None.

    Attributes:
        moment: What was done just now.
        p_centre: Centroid of the source, source frame.
        jacobi: The source's covariance and frame after the last rotation.
        before: Its covariance in the frame before that rotation.
        rotations: How many there were.
        variances: Of the source along its axes, falling.
        axes: The source's axes as they stand, source frame.
        axes_target: The target's, target frame.
        frames: How many right-handed frames have these axes.
        moments: Third moments of the source along the axes before they got their signs, m^3.
        outcome: What comes of laying the frames as they stand on each other.
        turns: What comes of many turns.
        box: Volume of the box along the axes, as a multiple of the one along the shape's own sides;
            NaN where it has none.
    """

    params: Params
    scans: Scans
    moment: Moment
    p_centre: np.ndarray
    jacobi: Rotated | None = None
    before: np.ndarray | None = None
    rotations: int = 0
    variances: np.ndarray | None = None
    axes: np.ndarray | None = None
    axes_target: np.ndarray | None = None
    frames: int = 0
    moments: np.ndarray | None = None
    outcome: Outcome | None = None
    turns: Turns | None = None
    box: float = float("nan")
