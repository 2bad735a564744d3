"""The inputs of the lesson, and the body that is turned."""

from dataclasses import dataclass
from pathlib import Path
from typing import Literal

import numpy as np

from workbench.data.own_meshes import read_solid
from workbench.data.shapes.solids import Shape, Solid, solid
from workbench.geometry.motions.rotations import EulerOrder
from workbench.lesson import Gizmo, Params, Pick, cached, knob

MOST_FACES = 50_000
Method = Literal["slerp + lerp", "Euler angles", "matrix entries", "slerp to -q", "screw"]


class Input(Params):
    """Names of a turn, or two poses and the way between them."""

    stage: Literal["poses", "rings", "readings", "chain", "names", "mean"] = knob(
        "poses", "Go between two poses, or look at one name of a turn"
    )
    angles: tuple[float, float, float] = knob(
        (30.0, 20.0, 60.0),
        "Three turns, in the order of the letters below; the start pose when moving",
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
    compare: Literal[
        "four conventions", "fixed and own axes", "other triples", "transpose", "xyzw for wxyz"
    ] = knob("four conventions", "How the same numbers are read otherwise")
    pose: tuple[float, float, float, float, float, float] = knob(
        (1.6, 0.6, 0.3, 0.0, 0.0, 0.0),
        "The end's place (m), and one more turn as a rotation vector (radians), by numbers or"
        " handle",
        -4,
        4,
        by=Gizmo(0.5),
    )
    angles_end: tuple[float, float, float] = knob(
        (0.0, 0.0, -110.0),
        "The three turns of the end pose",
        -180,
        180,
        unit="deg",
        step=1,
        label="End angle",
        parts=("1", "2", "3"),
    )
    method: Method = knob("slerp + lerp", "What runs at constant speed between the two poses")
    steps: int = knob(30, "Steps from one pose to the other", 2, 120)
    point: int = knob(8, "The vertex that is followed", 0, 11, by=Pick("body"))
    shape: Shape = knob("house", "The body")
    mesh: Path | None = knob(None, "Own mesh instead (off, obj, ply, stl, glb), shown 1 m large")


@dataclass(frozen=True, eq=False, kw_only=True)
class Body:
    """What is turned, in its own frame, metres."""

    name: str
    solid: Solid

    def p_followed(self, point: int) -> np.ndarray:
        """Return the vertex that is followed, the last where there are fewer."""
        return self.solid.p[min(point, len(self.solid.p) - 1)]


@cached
def setup(params: Input) -> Body:
    """Return the body, an own mesh scaled to one metre and put on the ground.

    Raises:
        InputError: If the own mesh cannot be used.
    """
    if params.mesh is None:
        return Body(name=params.shape, solid=solid(params.shape))
    return Body(name="mesh", solid=read_solid(params.mesh, MOST_FACES))
