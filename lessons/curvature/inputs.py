"""The inputs of the lesson."""

from pathlib import Path
from typing import Literal

from workbench.data.framing import Upward
from workbench.data.shapes.surfaces import MOST_JITTER
from workbench.lesson import Params, Pick, knob

MOST_OWN = 200_000


class Input(Params):
    """A surface whose curvature is known, or an own mesh; how it is meshed; and the vertex that is
    looked at.
    """

    stage: Literal["mesh", "paper", "balls"] = knob(
        "mesh", "A mesh to measure; a ring of paper that a hand bends; or four balls, ever finer"
    )
    surface: Literal["torus", "sphere", "cylinder", "saddle", "catenoid", "plane"] = knob(
        "torus", "A surface whose curvature is known in closed form"
    )
    vertices: int = knob(400, "About how many vertices its mesh has", 50, 6000, step=10)
    jitter: float = knob(
        0.0, "How far vertices stray along the surface", 0, MOST_JITTER, unit="cells", step=0.01
    )
    noise: float = knob(
        0.0, "How far they stray off the surface (sigma)", 0, 0.02, unit="m", step=0.001
    )
    size: float = knob(1.0, "Everything this many times as large", 0.5, 2, unit="×", step=0.05)
    inside_out: bool = knob(False, "Turn all faces round, so that inside is outside")
    mistake: Literal["none", "2 pi on the border", "defect taken for K", "H without the half"] = (
        knob("none", "Calculate with a classic mistake")
    )
    vertex: int = knob(
        -1,
        "The vertex that is looked at: click one; -1 faces you",
        -1,
        MOST_OWN - 1,
        by=Pick("surface"),
    )
    mesh: Path | None = knob(None, "Own mesh instead: off, obj, ply, stl, glb")
    up: Upward = knob("auto", "Which axis of an own mesh points up; auto guesses", of_files=True)
    seed: int = knob(0, "Which way the vertices stray", 0, 99)
