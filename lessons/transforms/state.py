"""The inputs, the body with its second readings, and the steps of both halves."""

from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated, Literal

import numpy as np

from lessons.transforms.composition import Factor
from workbench.data.shapes.solids import Shape, Solid
from workbench.geometry.meshes.invariants import Change, Measures
from workbench.geometry.motions.rotations import EulerOrder
from workbench.knobs import Gizmo, Knob, Pick
from workbench.scene import Role

FRONT = np.array([0.0, -1.0, 0.0])
BUILDING = {"half": ("build a map",)}
MOVING = {"half": ("move between two poses",)}
SAME = 1e-9  # metres: what rounding leaves of two names for one motion

Half = Literal["build a map", "move between two poses"]
First = Literal["rotate, then translate", "translate, then rotate"]
Mirror = Literal["none", "x", "y", "z"]
Method = Literal["slerp + lerp", "Euler angles", "matrix entries", "slerp to -q", "screw"]
Compare = Literal[
    "nothing",
    "the other order",
    "four conventions",
    "fixed and own axes",
    "other triples",
    "transpose",
    "best rigid motion",
    "xyzw for wxyz",
    "direction with w = 1",
    "undo by (Rᵀ, −t)",
    "undo all as if rigid",
]


@dataclass(frozen=True)
class Params:
    """The factors of one map, or two poses and the way between them."""

    half: Annotated[
        Half, Knob("Build one map factor by factor, or go from one pose to another")
    ] = "build a map"
    angles: Annotated[
        tuple[float, float, float],
        Knob(
            "Three turns, in the order of the letters below; the start pose when moving",
            -180,
            180,
            unit="deg",
            step=1,
            label="Angle",
            parts=("1", "2", "3"),
        ),
    ] = (30.0, 20.0, 60.0)
    order: Annotated[
        EulerOrder,
        Knob(
            "Axes of the three turns: lower case fixed in the world, upper case carried by the body"
        ),
    ] = "xyz"
    pose: Annotated[
        tuple[float, float, float, float, float, float],
        Knob(
            "Translation (m), and one more turn as a rotation vector (radians), by numbers or"
            " handle",
            -4,
            4,
            by=Gizmo(0.5),
        ),
    ] = (1.6, 0.6, 0.3, 0.0, 0.0, 0.0)
    first: Annotated[First, Knob("Which comes first", needs=BUILDING)] = "rotate, then translate"
    scale: Annotated[
        tuple[float, float, float],
        Knob("Factors along x, y and z, before all else", 0.2, 2, step=0.05, needs=BUILDING),
    ] = (1.0, 1.0, 1.4)
    shear: Annotated[
        float, Knob("Shift x by so much per metre of height", -1.5, 1.5, step=0.05, needs=BUILDING)
    ] = 0.0
    perspective: Annotated[
        float,
        Knob("Divide by w = 1 + so much times z", 0, 0.6, unit="1/m", step=0.02, needs=BUILDING),
    ] = 0.0
    mirror: Annotated[Mirror, Knob("The coordinate that changes its sign", needs=BUILDING)] = "none"
    compare: Annotated[
        Compare, Knob("A second reading drawn beside, while building", needs=BUILDING)
    ] = "nothing"
    angles_end: Annotated[
        tuple[float, float, float],
        Knob(
            "The three turns of the end pose, when moving",
            -180,
            180,
            unit="deg",
            step=1,
            label="End angle",
            parts=("1", "2", "3"),
            needs=MOVING,
        ),
    ] = (0.0, 0.0, -110.0)
    method: Annotated[
        Method, Knob("What runs at constant speed between the two poses", needs=MOVING)
    ] = "slerp + lerp"
    steps: Annotated[int, Knob("Steps from one pose to the other", 2, 120, needs=MOVING)] = 30
    point: Annotated[int, Knob("The vertex that is followed", 0, 11, by=Pick("body"))] = 8
    shape: Annotated[Shape, Knob("The body: only the house differs from its mirror image")] = (
        "house"
    )
    mesh: Annotated[
        Path | None, Knob("Own mesh instead (off, obj, ply, stl, glb), shown 1 m large")
    ] = None


@dataclass(frozen=True, eq=False, kw_only=True)
class Body:
    """What moves: its mesh and lines in its own frame, its measures, and the vertex that is
    followed.
    """

    name: str
    solid: Solid
    measures: Measures
    point: int

    @property
    def p_point(self) -> np.ndarray:
        """The followed vertex."""
        return self.solid.p[self.point]

    @property
    def p_door(self) -> np.ndarray:
        """Where the arrow to the front starts."""
        low, high = self.solid.p.min(axis=0), self.solid.p.max(axis=0)
        return np.array([(low[0] + high[0]) / 2, low[1], (low[2] + high[2]) / 4])


@dataclass(frozen=True, eq=False, kw_only=True)
class Ghost:
    """The body under another reading.

    Attributes:
        name: The reading.
        T: Its 4x4.
        distance: How far its farthest vertex is from ours, metres.
        apart: By how much it is drawn aside, where several would stand in each other's way, metres.
    """

    name: str
    T: np.ndarray
    distance: float
    apart: np.ndarray = field(default_factory=lambda: np.zeros(3))

    @property
    def same(self) -> bool:
        """Whether both are one motion of this body, up to rounding."""
        return self.distance < SAME

    @property
    def color(self) -> Role:
        """Green where both are the same motion, vermillion where they differ."""
        return "truth" if self.same else "wrong"


@dataclass(frozen=True, eq=False, kw_only=True)
class Built:
    """One more factor.

    Attributes:
        params, body: What does not change during the run.
        factor: What was multiplied on the left just now.
        T: All factors so far.
        T_world_body: The rigid ones among them.
        turns: How many of the three turns are done.
        angles: The three angles, those still to come being zero, radians.
        by_factor: What this factor changed on the body as it was before.
        by_all: What all factors so far changed on the body of the start.
        trail: Where the followed vertex was after every factor so far, (k, 3).
        complete: Whether this was the last factor of the map.
        ghosts: The second readings of the complete map, once it is; after `undo`, of its inverse.
        left: After `undo`: how far the farthest vertex is from where it was before the motion,
            metres.
    """

    params: Params
    body: Body
    factor: Factor
    T: np.ndarray
    T_world_body: np.ndarray
    turns: int
    angles: np.ndarray
    by_factor: tuple[Change, ...]
    by_all: tuple[Change, ...]
    trail: np.ndarray
    complete: bool
    ghosts: tuple[Ghost, ...] = ()
    left: float = float("nan")


@dataclass(frozen=True, eq=False, kw_only=True)
class Way:
    """A way between two poses, as far as it has been gone.

    Attributes:
        times: 0 at the start, 1 at the end, (n,).
        path: Where the followed vertex was at these times, (n, 3).
        turned: All turning from each time to the next added up, degrees, (n,).
        volume: Of the body, over its volume at the start; negative where it is mirrored, (n,).
    """

    times: np.ndarray
    path: np.ndarray
    turned: np.ndarray
    volume: np.ndarray


@dataclass(frozen=True, eq=False, kw_only=True)
class Moved:
    """One time between two poses.

    Attributes:
        params, body: What does not change during the run.
        T_world_start, T_world_end: The two poses.
        T_world_body: The body now; for matrix entries an affine map.
        T_world_before: The body one step earlier; at the start where it is.
        T_world_shortest: Where slerp and lerp have it now.
        way, shortest: The way taken up to now, and all of the way of slerp and lerp.
        off: The angle to the shortest turn's body, degrees.
        by_all: What differs from the body at the start.
    """

    params: Params
    body: Body
    T_world_start: np.ndarray
    T_world_end: np.ndarray
    T_world_body: np.ndarray
    T_world_before: np.ndarray
    T_world_shortest: np.ndarray
    way: Way
    shortest: Way
    off: float
    by_all: tuple[Change, ...]

    @property
    def t(self) -> float:
        """The time now."""
        return float(self.way.times[-1])

    @property
    def volume(self) -> float:
        """The body's volume now, over its volume at the start."""
        return float(self.way.volume[-1])


State = Built | Moved
