"""The inputs of the disparity lesson."""

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Literal

from workbench.errors import InputError
from workbench.knobs import Knob, Pick

Scene = Literal["spheres", "planes", "posts", "plain wall", "repeated pattern", "boards at three depths", "Motorcycle"]
Cost = Literal["SAD", "SSD", "census", "NCC"]
Mistake = Literal["none", "pictures exchanged", "rows off by 2 px", "right picture darker", "f not rescaled"]


@dataclass(frozen=True)
class Params:
    """A pair of pictures, how it is matched, and the pixel that is followed."""

    scene: Annotated[Scene, Knob("What the two cameras look at; the motorcycle is real")] = "spheres"
    cost: Annotated[Cost, Knob("How two windows are compared")] = "SAD"
    window: Annotated[int, Knob("Side of the window over which costs are summed", 1, 21, unit="px", step=2)] = 3
    smoothness: Annotated[
        float,
        Knob("What a jump between neighbours costs, in usual matching costs; 0 leaves the paths out", 0, 4, step=0.1),
    ] = 1.0
    max_disparity: Annotated[int, Knob("Largest shift that is tried", 3, 127, unit="px")] = 31
    baseline: Annotated[float, Knob("Distance between the cameras (made scenes)", 0.02, 0.5, unit="m", step=0.005)] = (
        0.1
    )
    focal_length: Annotated[float, Knob("Focal length (made scenes)", 50, 8000, unit="px", step=10)] = 150.0
    noise: Annotated[float, Knob("Noise of both sensors, in grey levels of 255 (made scenes)", 0, 40, step=0.5)] = 4.0
    disparity_error: Annotated[
        float, Knob("Added to every disparity before it becomes a depth", -3, 3, unit="px", step=0.25)
    ] = 0.0
    mistake: Annotated[Mistake, Knob("A classic mistake on the way; the scene stays true")] = "none"
    pixel: Annotated[
        tuple[int, int], Knob("The left pixel (u, v) that is followed: click the left picture", 0, 639, unit="px",
                              by=Pick("left/picture"))
    ] = (54, 80)  # fmt: skip
    shrink: Annotated[
        int, Knob("Average blocks of k × k pixels first (motorcycle and own pairs)", 1, 16, label="Shrink k times")
    ] = 4
    doffs: Annotated[
        float,
        Knob(
            "Right minus left principal point, in pixels of the files (own pairs)", -500, 500, unit="px", label="doffs"
        ),
    ] = 0.0
    own_focal_length: Annotated[
        float,
        Knob("Focal length of an own pair, in pixels of its files; 0: not known, so no metres", 0, 20000, unit="px"),
    ] = 0.0
    own_baseline: Annotated[
        float,
        Knob("Distance between the cameras of an own pair; 0: not known, so no metres", 0, 100, unit="m", step=0.001),
    ] = 0.0
    left: Annotated[Path | None, Knob("An own left picture, rectified; give both")] = None
    right: Annotated[Path | None, Knob("An own right picture of the same size")] = None
    seed: Annotated[int, Knob("Which textures and which noise", 0, 99)] = 0

    def __post_init__(self) -> None:
        if self.window % 2 == 0:
            raise InputError(f"window = {self.window}: a window has a middle pixel, so its side is odd")
        if (self.left is None) != (self.right is None):
            raise InputError("an own pair is two files: give both --left and --right")
