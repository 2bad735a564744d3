"""The inputs, the mesh to measure, and what one step holds."""

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Literal

import numpy as np

from workbench.algorithms.surfaces.curvature import Measured
from workbench.data.framing import Upward
from workbench.data.shapes.surfaces import MOST_JITTER, Surface
from workbench.geometry.meshes import vertices_within
from workbench.knobs import Knob, Pick

Shape = Literal["torus", "sphere", "cylinder", "saddle", "catenoid", "plane"]
Mistake = Literal["none", "2 pi on the border", "defect taken for K", "H without the half"]

MOST_OWN = 200_000


@dataclass(frozen=True)
class Params:
    """A surface whose curvature is known, or an own mesh; how it is meshed; and the vertex that is
    looked at.
    """

    surface: Annotated[Shape, Knob("A surface whose curvature is known in closed form")] = "torus"
    vertices: Annotated[int, Knob("About how many vertices its mesh has", 50, 6000, step=10)] = 400
    jitter: Annotated[
        float,
        Knob("How far vertices stray along the surface", 0, MOST_JITTER, unit="cells", step=0.01),
    ] = 0.0
    noise: Annotated[
        float, Knob("How far they stray off the surface (sigma)", 0, 0.02, unit="m", step=0.001)
    ] = 0.0
    size: Annotated[
        float, Knob("Everything this many times as large", 0.5, 2, unit="×", step=0.05)
    ] = 1.0
    inside_out: Annotated[bool, Knob("Turn all faces round, so that inside is outside")] = False
    mistake: Annotated[Mistake, Knob("Calculate with a classic mistake")] = "none"
    vertex: Annotated[
        int,
        Knob(
            "The vertex that is looked at: click one; -1 faces you",
            -1,
            MOST_OWN - 1,
            by=Pick("surface"),
        ),
    ] = -1
    mesh: Annotated[Path | None, Knob("Own mesh instead: off, obj, ply, stl, glb")] = None
    up: Annotated[
        Upward, Knob("Which axis of an own mesh points up; auto guesses", of_files=True)
    ] = "auto"
    seed: Annotated[int, Knob("Which way the vertices stray", 0, 99)] = 0


@dataclass(frozen=True, eq=False, kw_only=True)
class Subject:
    """A mesh to measure.

    Attributes:
        name: What it is called in sentences.
        p: Vertices, metres.
        faces: Triangles, counterclockwise seen from outside.
        truth: The surface from which it was made, with its analytic curvature; None for an own
            mesh.
        edges: Every edge once.
        border: Which vertices lie on its border.
        front: The vertex inside the border that faces the viewer best.
        enlarged: How many times larger than in its file an own mesh is.
        up: Which axis of an own mesh's file points up here.
        mended: What had to be mended in an own mesh, in words.
    """

    name: str
    p: np.ndarray
    faces: np.ndarray
    truth: Surface | None
    edges: np.ndarray
    border: np.ndarray
    front: int
    enlarged: float = 1.0
    up: str = "z"
    mended: tuple[str, ...] = ()

    @property
    def inside(self) -> np.ndarray:
        """Which vertices do not lie on the border."""
        return ~self.border


@dataclass(frozen=True, eq=False, kw_only=True)
class Study:
    """Relative errors of four estimates on ever finer meshes of one surface.

    Attributes:
        counts: How many vertices the meshes have.
        K, H: Errors of the angle defects and the cotangents.
        K_fit, H_fit: Errors of the quadric fits.
    """

    counts: np.ndarray
    K: np.ndarray
    H: np.ndarray
    K_fit: np.ndarray
    H_fit: np.ndarray


@dataclass(frozen=True, eq=False, kw_only=True)
class State:
    """One step of the lesson: what was measured, or at the end how errors depend on the mesh.

    Attributes:
        params: The inputs.
        subject: The mesh, the same for the whole run.
        now: What is measured so far.
        errors: Relative errors so far, by name; none for an own mesh.
        study: Errors on ever finer meshes, in the last step.
        unfolded: How far the ring of the vertex is laid flat, up to 1.
    """

    params: Params
    subject: Subject
    now: Measured
    errors: dict[str, float]
    study: Study | None = None
    unfolded: float = 1.0

    @property
    def stage(self) -> str:
        """The stage by name."""
        return (
            "finer"
            if self.study is not None
            else "unfolding"
            if self.unfolded < 1
            else self.now.stage
        )

    @property
    def on_border(self) -> bool:
        """Whether the vertex that is looked at lies on the border."""
        return bool(self.subject.border[self.now.vertex])

    @property
    def two_rings(self) -> np.ndarray:
        """The vertices at most two edges away from the one that is looked at, itself included."""
        return vertices_within(self.subject.edges, self.now.vertex, 2)

    def true(self, name: str) -> float:
        """Return the analytic `gaussian`, `mean`, `k1` or `k2` at the vertex; NaN where nobody
        knows.
        """
        surface = self.subject.truth
        return float("nan") if surface is None else float(getattr(surface, name)[self.now.vertex])


def at_stage(states, stage: str) -> State:
    """Return the state of a run at a stage."""
    return next(state for state in states if state.stage == stage)
