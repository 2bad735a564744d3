"""The inputs of the transforms lesson."""

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Literal

from workbench.data.solids import Shape
from workbench.geometry.rotations import EulerOrder
from workbench.knobs import Gizmo, Knob, Pick

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

    half: Annotated[Half, Knob("Build one map factor by factor, or go from one pose to another")] = "build a map"
    angles: Annotated[
        tuple[float, float, float],
        Knob("Three turns, in the order of the letters below; the start pose when moving", -180, 180, unit="deg", step=1,
             label="Angle", parts=("1", "2", "3")),
    ] = (30.0, 20.0, 60.0)  # fmt: skip
    order: Annotated[
        EulerOrder, Knob("Axes of the three turns: lower case fixed in the world, upper case carried by the body")
    ] = "xyz"
    pose: Annotated[
        tuple[float, float, float, float, float, float],
        Knob(
            "Translation (m), and one more turn as a rotation vector (radians), by numbers or handle",
            -4,
            4,
            by=Gizmo(0.5),
        ),
    ] = (1.6, 0.6, 0.3, 0.0, 0.0, 0.0)
    first: Annotated[First, Knob("Which comes first")] = "rotate, then translate"
    scale: Annotated[
        tuple[float, float, float], Knob("Factors along x, y and z, before all else", 0.2, 2, step=0.05)
    ] = (1.0, 1.0, 1.4)
    shear: Annotated[float, Knob("Shift x by so much per metre of height", -1.5, 1.5, step=0.05)] = 0.0
    perspective: Annotated[float, Knob("Divide by w = 1 + so much times z", 0, 0.6, unit="1/m", step=0.02)] = 0.0
    mirror: Annotated[Mirror, Knob("The coordinate that changes its sign")] = "none"
    compare: Annotated[Compare, Knob("A second reading drawn beside, while building")] = "nothing"
    angles_end: Annotated[
        tuple[float, float, float],
        Knob("The three turns of the end pose, when moving", -180, 180, unit="deg", step=1,
             label="End angle", parts=("1", "2", "3")),
    ] = (0.0, 0.0, -110.0)  # fmt: skip
    method: Annotated[Method, Knob("What runs at constant speed between the two poses")] = "slerp + lerp"
    steps: Annotated[int, Knob("Steps from one pose to the other", 2, 120)] = 30
    point: Annotated[int, Knob("The vertex that is followed", 0, 11, by=Pick("body"))] = 8
    shape: Annotated[Shape, Knob("The body: only the house differs from its mirror image")] = "house"
    mesh: Annotated[Path | None, Knob("Own mesh instead (off, obj, ply, stl, glb), shown 1 m large")] = None
