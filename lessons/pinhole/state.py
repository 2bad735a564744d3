"""The inputs, the true camera's shot, and one stage of the calculation beside it."""

from dataclasses import dataclass
from typing import Annotated, Literal

import numpy as np

from lessons.pinhole import following as pinhole
from workbench.data.views.street import street
from workbench.geometry.cameras.distortion import Distortion
from workbench.knobs import Gizmo, Knob, Pick

Edit = Literal["none", "cropped", "half size", "cropped, then half size"]
EDITS = ("cropped", "half size", "cropped, then half size")
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
    """A camera in the street, its lens, what happens to its picture, and the point that is
    followed.
    """

    camera: Annotated[
        tuple[float, float, float],
        Knob("Where the camera is; drag it in the scene", -60, 60, unit="m", by=Gizmo(0.8)),
    ] = (0.5, -3.0, 1.7)
    target: Annotated[
        tuple[float, float, float],
        Knob("What the camera looks at; drag it too", -60, 60, unit="m", by=Gizmo(0.5)),
    ] = (0.3, 8.0, 1.0)
    f: Annotated[
        float, Knob("Focal length in pixels: zoom, without moving", 60, 1000, unit="px", step=5)
    ] = 260.0
    dolly: Annotated[
        float,
        Knob(
            "Move back to this many times the distance, and lengthen f as much",
            0.25,
            50,
            unit="×",
            step=0.05,
        ),
    ] = 1.0
    k1: Annotated[
        float, Knob("Radial: below zero barrel, above zero pincushion", -0.6, 0.6, step=0.01)
    ] = -0.3
    k2: Annotated[float, Knob("Radial, grows further out", -0.3, 0.3, step=0.01)] = 0.06
    p1: Annotated[float, Knob("Tangential along y: a lens off centre", -0.1, 0.1, step=0.005)] = 0.0
    p2: Annotated[float, Knob("Tangential along x", -0.1, 0.1, step=0.005)] = 0.0
    edit: Annotated[Edit, Knob("What was done to the picture after it was taken")] = "none"
    k_follows: Annotated[
        bool,
        Knob(
            "Change K as the picture was changed", label="K follows the edit", needs={"edit": EDITS}
        ),
    ] = True
    mistake: Annotated[
        Mistake, Knob("Calculate with a classic mistake; the picture stays true")
    ] = "none"
    point: Annotated[
        int, Knob("The point that is followed: click one in the scene", 0, 83, by=Pick("points"))
    ] = 2


@dataclass(frozen=True, eq=False, kw_only=True)
class Shot:
    """What the true camera sees.

    Attributes:
        T_camera_world: Where it is, the dolly included.
        K: Its intrinsics, for the picture after the edit.
        K_first: Its intrinsics before the edit.
        lens: Its lens.
        picture: The photograph after the edit, (h, w, 3).
        uv: Pixels of the followed points, NaN where it does not see them.
        xy: Ideal normalised coordinates of the points, NaN likewise.
        crate, tower: Heights of an edge in this picture, pixels; NaN where an end of it has no
            pixel.
        crate_before, tower_before: The same at a dolly of 1.
        ball_ratio: Length over width of the ball's outline, without the lens; NaN where it is not
            in the picture.
        vanishing: Pixel in which the rails meet, NaN where they do not.
        gaps: For each of FACTORS, how far the corners that are in front are from their orthographic
            pixels, at most, before the edit and without the lens.
        gap: The same at the dolly of this shot.
    """

    T_camera_world: np.ndarray
    K: np.ndarray
    K_first: np.ndarray
    lens: Distortion
    picture: np.ndarray
    uv: np.ndarray
    xy: np.ndarray
    crate: float
    tower: float
    crate_before: float
    tower_before: float
    ball_ratio: float
    vanishing: np.ndarray
    gaps: np.ndarray
    gap: float


@dataclass(frozen=True, eq=False, kw_only=True)
class State:
    """One stage of all points through the calculation, beside the true shot.

    Attributes:
        params: The inputs.
        shot: The true camera and its photograph.
        now: How far the calculation has come.
        picture: The photograph with the outlines and points on it that this stage has calculated,
            if it has any.
        error: Median distance to the true pixels, as far as the stage tells, px; NaN before the
            division.
        found, missed, false: How many points have a calculated pixel; how many lack one that the
            camera does see; and how many have one that the camera does not see.
    """

    params: Params
    shot: Shot
    now: pinhole.State
    picture: np.ndarray
    error: float
    found: int
    missed: int
    false: int


def name_of(k: int) -> str:
    """Return what a point is called."""
    names = street().names
    return names[k] if k < len(names) else f"point {k}"
