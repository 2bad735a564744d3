"""The inputs of the lesson."""

from typing import Literal

from workbench.lesson import Gizmo, Params, Pick, knob

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


class Input(Params):
    """A camera in the street, its lens, its picture, and the point that is followed."""

    camera: tuple[float, float, float] = knob(
        (0.5, -3.0, 1.7),
        "Where the camera is; drag it in the scene",
        -60,
        60,
        unit="m",
        by=Gizmo(0.8),
    )
    target: tuple[float, float, float] = knob(
        (0.3, 8.0, 1.0), "What the camera looks at; drag it too", -60, 60, unit="m", by=Gizmo(0.5)
    )
    turn: float = knob(
        0.0, "Turn the camera to the right, about the vertical", -60, 60, unit="deg", step=1
    )
    aside: float = knob(0.0, "Let it step to its right, without turning", -4, 4, unit="m", step=0.1)
    f: float = knob(
        260.0, "Focal length in pixels: zoom, without moving", 60, 1000, unit="px", step=5
    )
    pane: float = knob(
        2.0, "How far in front of the camera the pane stands", 0.5, 12, unit="m", step=0.1
    )
    dolly: float = knob(
        1.0,
        "Move back to this many times the distance, and lengthen f as much",
        0.25,
        50,
        unit="×",
        step=0.05,
    )
    heights: bool = knob(False, "Draw the rays to the crate and to the tower from the side")
    k1: float = knob(-0.3, "Radial: below zero barrel, above zero pincushion", -0.6, 0.6, step=0.01)
    k2: float = knob(0.06, "Radial, grows further out", -0.3, 0.3, step=0.01)
    p1: float = knob(0.0, "Tangential along y: a lens off centre", -0.1, 0.1, step=0.005)
    p2: float = knob(0.0, "Tangential along x", -0.1, 0.1, step=0.005)
    edit: Edit = knob("none", "What was done to the picture after it was taken")
    cut: int = knob(60, "Columns that the crop takes away at the left", 0, 120, unit="px")
    k_follows: bool = knob(True, "Change K as the picture was changed", label="K follows the edit")
    mistake: Mistake = knob("none", "Calculate with a classic mistake; the picture stays true")
    point: int = knob(
        2, "The point that is followed: click one in the scene", 0, 83, by=Pick("points")
    )
    z: float = knob(
        0.0,
        "Hang the lamp on that point's ray at this depth, and follow it; 0: leave it",
        -16,
        16,
        unit="m",
        step=0.5,
    )

    @property
    def forgets_k(self) -> bool:
        """Whether the picture was edited and K was left as it was."""
        return self.edit != "none" and not self.k_follows
