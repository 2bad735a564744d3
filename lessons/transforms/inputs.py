"""The inputs of the lesson, and the body that is moved."""

from dataclasses import dataclass
from pathlib import Path
from typing import Literal

import numpy as np

from workbench.data.own_meshes import read_solid
from workbench.data.shapes.solids import Shape, Solid, solid
from workbench.geometry.motions.rotations import EulerOrder
from workbench.lesson import Gizmo, Params, Pick, cached, knob

MOST_FACES = 50_000
FRONT = np.array([0.0, -1.0, 0.0])
Tip = tuple[float, float, float]


class Input(Params):
    """The factors of a map, or one number of a map that a hand turns."""

    stage: Literal["factors", "columns", "order", "undo", "shear", "shift", "divide"] = knob(
        "factors", "Build a map factor by factor, or turn one number of a map by hand"
    )
    x_tip: Tip = knob((1.0, 0.0, 0.0), "Where x goes: column 1", -2, 2, by=Gizmo(0.3))
    y_tip: Tip = knob((0.0, 1.0, 0.0), "Where y goes: column 2", -2, 2, by=Gizmo(0.3))
    z_tip: Tip = knob((0.0, 0.0, 1.0), "Where z goes: column 3", -2, 2, by=Gizmo(0.3))
    angles: tuple[float, float, float] = knob(
        (30.0, 20.0, 60.0),
        "Three turns, in the order of the letters below",
        -180,
        180,
        unit="deg",
        step=1,
        label="Angle",
        parts=("1", "2", "3"),
    )
    order: EulerOrder = knob(
        "xyz", "Axes of the three turns: lower case fixed in the world, upper case carried along"
    )
    pose: tuple[float, float, float, float, float, float] = knob(
        (1.6, 0.6, 0.3, 0.0, 0.0, 0.0),
        "Translation (m), and one more turn as a rotation vector (radians), by numbers or handle",
        -4,
        4,
        by=Gizmo(0.5),
    )
    first: Literal["rotate, then translate", "translate, then rotate"] = knob(
        "rotate, then translate", "Which comes first"
    )
    scale: tuple[float, float, float] = knob(
        (1.0, 1.0, 1.4), "Factors along x, y and z, before all else", 0.2, 2, step=0.05
    )
    shear: float = knob(0.0, "Shift x by so much per metre of height", -1.5, 1.5, step=0.05)
    perspective: float = knob(
        0.0, "Divide by w = 1 + so much times z", 0, 0.6, unit="1/m", step=0.02
    )
    mirror: Literal["none", "x", "y", "z"] = knob("none", "The coordinate that changes its sign")
    compare: Literal[
        "nothing",
        "the other order",
        "best rigid motion",
        "direction with w = 1",
        "undo by (Rᵀ, −t)",
        "undo all as if rigid",
    ] = knob("nothing", "A second reading drawn beside the map")
    point: int = knob(8, "The vertex that is followed", 0, 11, by=Pick("body"))
    shape: Shape = knob("house", "The body: only the house differs from its mirror image")
    mesh: Path | None = knob(None, "Own mesh instead (off, obj, ply, stl, glb), shown 1 m large")


@dataclass(frozen=True, eq=False, kw_only=True)
class Body:
    """What is moved, in its own frame, metres."""

    name: str
    solid: Solid

    @property
    def p_door(self) -> np.ndarray:
        """Where the arrow to the front starts."""
        low = self.solid.p.min(axis=0)
        high = self.solid.p.max(axis=0)
        return np.array([(low[0] + high[0]) / 2, low[1], (low[2] + high[2]) / 4])

    def followed(self, point: int) -> int:
        """Return the vertex that is followed: the last where there are fewer."""
        return min(point, len(self.solid.p) - 1)


@cached
def setup(params: Input) -> Body:
    """Return the body, an own mesh scaled to one metre and put on the ground.

    Raises:
        InputError: If the own mesh cannot be used.
    """
    if params.mesh is None:
        return Body(name=params.shape, solid=solid(params.shape))
    return Body(name="mesh", solid=read_solid(params.mesh, MOST_FACES))
