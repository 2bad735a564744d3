"""The inputs of the curvature lesson."""

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Literal

from workbench.data.surfaces import MOST_JITTER
from workbench.knobs import Knob, Pick

Shape = Literal["torus", "sphere", "cylinder", "saddle", "catenoid", "plane"]
Mistake = Literal["none", "2 pi on the border", "defect taken for K", "H without the half"]
Up = Literal["auto", "x", "y", "-y", "z"]

MOST_OWN = 200_000


@dataclass(frozen=True)
class Params:
    """A surface whose curvature is known, or an own mesh; how it is meshed; and the vertex that is looked at."""

    surface: Annotated[Shape, Knob("A surface whose curvature is known in closed form")] = "torus"
    vertices: Annotated[int, Knob("About how many vertices its mesh has", 50, 6000, step=10)] = 400
    jitter: Annotated[
        float, Knob("How far vertices stray along the surface", 0, MOST_JITTER, unit="cells", step=0.01)
    ] = 0.0
    noise: Annotated[float, Knob("How far they stray off the surface (sigma)", 0, 0.02, unit="m", step=0.001)] = 0.0
    size: Annotated[float, Knob("Everything this many times as large", 0.5, 2, unit="×", step=0.05)] = 1.0
    inside_out: Annotated[bool, Knob("Turn all faces round, so that inside is outside")] = False
    mistake: Annotated[Mistake, Knob("Calculate with a classic mistake")] = "none"
    vertex: Annotated[
        int, Knob("The vertex that is looked at: click one; -1 faces you", -1, MOST_OWN - 1, by=Pick("surface"))
    ] = -1
    mesh: Annotated[Path | None, Knob("Own mesh instead: off, obj, ply, stl, glb")] = None
    up: Annotated[Up, Knob("Which axis of an own mesh points up; auto guesses")] = "auto"
    seed: Annotated[int, Knob("Which way the vertices stray", 0, 99)] = 0
