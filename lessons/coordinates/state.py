"""The inputs, and what one step holds."""

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Literal

import numpy as np

from lessons.coordinates.pan_tilt import Followed
from lessons.coordinates.parallels import Met, Scaled, Seen
from lessons.coordinates.placing import Cell, Even, Placed, Ranged, Readings, Scattered, Walked
from lessons.coordinates.voyages import Raised, Travelled
from workbench.data.framing import Up
from workbench.data.places import Places
from workbench.geometry.shapes.curvilinear import Convention, Coordinates
from workbench.knobs import Gizmo, Knob

Stage = Literal["point", "sphere", "radar", "globe", "latitude", "mount", "projective", "project"]
Named = Literal["cartesian", "cylindrical", "spherical", "homogeneous"]
Route = Literal[
    "London – Los Angeles",
    "Frankfurt – Anchorage",
    "Tokyo – London",
    "Suva – Apia",
    "Quito – Kampala",
]
Planet = Literal["Earth", "Mars", "Saturn"]
WALKED = 17  # points of the walk past the axis
SECONDS = 1.6  # that somebody who passes is followed, before and after the middle
TILTS = (0.02, 0.05, 0.1, 0.2, 0.3, 0.4)  # of the homographies that bring the horizon near


@dataclass(frozen=True)
class Params:
    """What is to be named by coordinates, and by which."""

    stage: Annotated[Stage, Knob("What coordinates are tried on")] = "point"
    system: Annotated[
        Named, Knob("By which numbers the point is named", needs={"stage": ("point",)})
    ] = "spherical"
    convention: Annotated[
        Convention,
        Knob("Whose names the angles have", needs={"stage": ("point",), "system": ("spherical",)}),
    ] = "ISO"
    point: Annotated[
        tuple[float, float, float],
        Knob(
            "The point; drag its handle",
            -1.5,
            1.5,
            unit="m",
            by=Gizmo(0.25),
            needs={"stage": ("point",)},
        ),
    ] = (0.66, 0.38, 0.64)
    miss: Annotated[
        float,
        Knob(
            "How far from the axis something passes, as seen from the origin",
            0.1,
            30,
            unit="deg",
            step=0.1,
            needs={"stage": ("point", "mount")},
        ),
    ] = 1.0
    even: Annotated[Even, Knob("What is drawn evenly", needs={"stage": ("sphere",)})] = "angle"
    samples: Annotated[
        int,
        Knob(
            "How many points or measurements are drawn",
            100,
            20_000,
            needs={"stage": ("sphere", "radar")},
        ),
    ] = 4000
    bearing_noise: Annotated[
        float,
        Knob(
            "Standard deviation of a bearing",
            0,
            30,
            unit="deg",
            label="bearing σ",
            needs={"stage": ("radar",)},
        ),
    ] = 20.0
    route: Annotated[Route, Knob("From where to where", needs={"stage": ("globe",)})] = (
        "London – Los Angeles"
    )
    planet: Annotated[Planet, Knob("Whose flattening", needs={"stage": ("latitude",)})] = "Earth"
    angle_between: Annotated[
        float,
        Knob(
            "At what angle the two lines meet in the end",
            0,
            10,
            unit="deg",
            needs={"stage": ("projective",)},
        ),
    ] = 0.0
    distance: Annotated[
        float,
        Knob(
            "How far the eye goes away, in half-depths of the object",
            1.5,
            100,
            needs={"stage": ("project",)},
        ),
    ] = 100.0
    places: Annotated[
        Path | None,
        Knob("Own places instead: csv of latitude, longitude, name", needs={"stage": ("globe",)}),
    ] = None
    cloud: Annotated[
        Path | None,
        Knob(
            "Own object instead of the house: ply, pcd, obj, xyz, csv, npz",
            needs={"stage": ("project",)},
        ),
    ] = None
    up: Annotated[Up, Knob("Which axis of an own object points up", of_files=True)] = "z"
    seed: Annotated[int, Knob("What chance draws", 0, 99, needs={"stage": ("sphere", "radar")})] = 0


@dataclass(frozen=True, eq=False)
class Thing:
    """What is seen from far away: points about the origin, m, its lines where it has any, and its
    half-depth.
    """

    p: np.ndarray
    lines: np.ndarray
    half_depth: float
    name: str


Now = (
    Placed
    | Cell
    | Readings
    | Walked
    | Scaled
    | Scattered
    | Ranged
    | Travelled
    | Raised
    | Followed
    | Met
    | Seen
)


@dataclass(frozen=True, eq=False, kw_only=True)
class State:
    """One step of the lesson.

    Attributes:
        params: The inputs.
        now: What the stage knows.
        subject: What it is about and stays for the whole run: coordinates, places, or a thing; None
            where it needs none.
    """

    params: Params
    now: Now
    subject: Coordinates | Places | Thing | None = None

    @property
    def last(self) -> bool:
        """Whether the run ends here."""
        step, params = self.now, self.params
        match step:
            case Walked():
                return len(step.p) == WALKED
            case Scaled() | Travelled():
                return (step.mean_h if isinstance(step, Scaled) else step.means) is not None
            case Scattered() | Ranged():
                return len(step.p) == params.samples
            case Raised():
                return step.latitude[-1] == np.pi / 2
            case Followed():
                return step.time >= SECONDS - 1e-6
            case Met():
                return step.H[2, 0] == TILTS[-1]
            case Seen():
                return step.times >= params.distance - 1e-9
            case _:
                return False
