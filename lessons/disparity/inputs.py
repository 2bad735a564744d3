"""The inputs of the lesson."""

from pathlib import Path
from typing import Literal

from workbench.errors import InputError
from workbench.lesson import Params, Pick, knob


class Input(Params):
    """A pair of pictures, how it is matched, and the pixel that is followed."""

    stage: Literal[
        "whole map", "jump", "row", "path", "windows", "penalties", "baselines", "one pixel"
    ] = knob(
        "whole map",
        "The whole pair; one point before two cameras; one row; or a knob at all of its values",
    )
    scene: Literal[
        "spheres",
        "planes",
        "posts",
        "plain wall",
        "repeated pattern",
        "boards at three depths",
        "Motorcycle",
    ] = knob("spheres", "What the two cameras look at; the motorcycle is real")
    cost: Literal["SAD", "SSD", "census", "NCC"] = knob("SAD", "How two windows are compared")
    window: int = knob(
        3, "Side of the window over which costs are summed", 1, 21, unit="px", step=2
    )
    smoothness: float = knob(
        1.0,
        "What a jump between neighbours costs, in usual matching costs; 0 leaves the paths out",
        0,
        4,
        step=0.1,
    )
    max_disparity: int = knob(31, "Largest shift that is tried", 3, 127, unit="px")
    baseline: float = knob(0.1, "Distance between the cameras", 0.02, 0.5, unit="m", step=0.005)
    focal_length: float = knob(150.0, "Focal length", 50, 8000, unit="px", step=10)
    noise: float = knob(4.0, "Noise of both sensors, in grey levels of 255", 0, 40, step=0.5)
    disparity_error: float = knob(
        0.0, "Added to every disparity before it becomes a depth", -3, 3, unit="px", step=0.25
    )
    mistake: Literal[
        "none", "pictures exchanged", "rows off by 2 px", "right picture darker", "f not rescaled"
    ] = knob("none", "A classic mistake on the way; the scene stays true")
    pixel: tuple[int, int] = knob(
        (54, 80),
        "The left pixel (u, v) that is followed: click the left picture",
        0,
        639,
        unit="px",
        by=Pick("left/picture"),
    )
    shrink: int = knob(
        4,
        "Average blocks of k × k pixels first (motorcycle and own pairs)",
        1,
        16,
        label="Shrink k times",
        of_files=True,
    )
    doffs: float = knob(
        0.0,
        "Right minus left principal point, in pixels of the files (own pairs)",
        -500,
        500,
        unit="px",
        label="doffs",
        of_files=True,
    )
    own_focal_length: float = knob(
        0.0,
        "Focal length of an own pair, in pixels of its files; 0: not known, so no metres",
        0,
        20000,
        unit="px",
        of_files=True,
    )
    own_baseline: float = knob(
        0.0,
        "Distance between the cameras of an own pair; 0: not known, so no metres",
        0,
        100,
        unit="m",
        step=0.001,
        of_files=True,
    )
    left: Path | None = knob(None, "An own left picture, rectified; give both")
    right: Path | None = knob(None, "An own right picture of the same size")
    seed: int = knob(0, "Which textures and which noise", 0, 99)

    def __post_init__(self) -> None:
        if self.window % 2 == 0:
            raise InputError(
                f"window = {self.window}: a window has a middle pixel, so its side is odd"
            )
