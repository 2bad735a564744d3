"""The inputs of the pinhole lesson."""

from dataclasses import dataclass
from typing import Annotated, Literal

from workbench.knobs import Gizmo, Knob, Pick

Edit = Literal["none", "cropped", "half size", "cropped, then half size"]
Mistake = Literal[
    "none",
    "pose inverted",
    "divides behind too",
    "OpenGL axes",
    "row before column",
    "lens on pixels",
    "t for the centre",
    "ray length for depth",
]


@dataclass(frozen=True)
class Params:
    """A camera in the street, its lens, what happens to its picture, and the point that is followed."""

    camera: Annotated[
        tuple[float, float, float], Knob("Where the camera is; drag it in the scene", -60, 60, unit="m", by=Gizmo(0.8))
    ] = (0.5, -3.0, 1.7)
    target: Annotated[
        tuple[float, float, float], Knob("What the camera looks at; drag it too", -60, 60, unit="m", by=Gizmo(0.5))
    ] = (0.3, 8.0, 1.0)
    f: Annotated[float, Knob("Focal length in pixels: zoom, without moving", 60, 1000, unit="px", step=5)] = 260.0
    dolly: Annotated[
        float,
        Knob("Move back to this many times the distance, and lengthen f as much", 0.25, 50, unit="×", step=0.05),
    ] = 1.0
    k1: Annotated[float, Knob("Radial: below zero barrel, above zero pincushion", -0.6, 0.6, step=0.01)] = -0.3
    k2: Annotated[float, Knob("Radial, grows further out", -0.3, 0.3, step=0.01)] = 0.06
    p1: Annotated[float, Knob("Tangential along y: a lens off centre", -0.1, 0.1, step=0.005)] = 0.0
    p2: Annotated[float, Knob("Tangential along x", -0.1, 0.1, step=0.005)] = 0.0
    edit: Annotated[Edit, Knob("What was done to the picture after it was taken")] = "none"
    k_follows: Annotated[bool, Knob("Change K as the picture was changed", label="K follows the edit")] = True
    mistake: Annotated[Mistake, Knob("Calculate with a classic mistake; the picture stays true")] = "none"
    point: Annotated[int, Knob("The point that is followed: click one in the scene", 0, 83, by=Pick("points"))] = 2
