"""The inputs, what is measured, and what one step holds."""

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated, Literal

import numpy as np

from workbench.algorithms.surfaces.measures import Cells, Sums
from workbench.algorithms.surfaces.monte_carlo import Balls, Lines, Sampled, Throws
from workbench.data.framing import Unit, Upward
from workbench.geometry.fields.voxels import Grid
from workbench.geometry.points.sampling import Draw
from workbench.knobs import Gizmo, Knob

Shape = Literal["rabbit", "sphere", "box", "torus", "lantern", "two spheres"]
Method = Literal["faces", "voxels", "chance", "lines", "samples", "dimensions"]
Pick = Literal["by area", "all alike"]
Place = Literal["with the root", "without the root", "normalised"]
ROUND: tuple[Shape, ...] = ("sphere", "torus", "two spheres")


@dataclass(frozen=True)
class Params:
    """A shape or a person's own, how it is measured, and what goes wrong with it."""

    method: Annotated[Method, Knob("What is added up or counted")] = "faces"
    shape: Annotated[
        Shape,
        Knob(
            "What is measured", needs={"method": ("faces", "voxels", "chance", "lines", "samples")}
        ),
    ] = "rabbit"
    subdivisions: Annotated[
        int, Knob("How often the edges of a round mesh were halved", 0, 5, needs={"shape": ROUND})
    ] = 3
    sectors: Annotated[
        int, Knob("Of the lantern: vertices in a ring", 4, 128, needs={"shape": ("lantern",)})
    ] = 11
    rings: Annotated[
        int, Knob("Of the lantern: bands of triangles", 4, 128, needs={"shape": ("lantern",)})
    ] = 121
    origin: Annotated[
        tuple[float, float, float],
        Knob(
            "The tip of all tetrahedra",
            -20,
            20,
            unit="m",
            by=Gizmo(0.4),
            needs={"method": ("faces",)},
        ),
    ] = (-0.6, -1.5, -0.4)
    hole: Annotated[
        float,
        Knob(
            "Share of the faces that is cut out in one place",
            0,
            0.1,
            step=0.005,
            needs={"method": ("faces",)},
        ),
    ] = 0.0
    flipped: Annotated[
        float,
        Knob(
            "Share of the faces that is turned round",
            0,
            0.2,
            step=0.01,
            needs={"method": ("faces",)},
        ),
    ] = 0.0
    cells: Annotated[
        int, Knob("Cells along the longest side at the end", 8, 64, needs={"method": ("voxels",)})
    ] = 32
    throws: Annotated[
        int,
        Knob(
            "Points thrown or drawn, or lines (of those at most 10,000)",
            100,
            100_000,
            step=100,
            needs={"method": ("chance", "lines", "samples", "dimensions")},
        ),
    ] = 1000
    draw: Annotated[
        Draw, Knob("How points are thrown into the box", needs={"method": ("chance",)})
    ] = "random"
    pick: Annotated[Pick, Knob("How often each face is picked", needs={"method": ("samples",)})] = (
        "by area"
    )
    place: Annotated[
        Place, Knob("How two numbers become a place in a face", needs={"method": ("samples",)})
    ] = "with the root"
    dimension: Annotated[
        int, Knob("The highest dimension of the ball", 3, 20, needs={"method": ("dimensions",)})
    ] = 20
    mesh: Annotated[Path | None, Knob("Own mesh instead: off, obj, ply, stl, glb")] = None
    up: Annotated[
        Upward, Knob("Which axis of an own mesh points up; auto guesses", of_files=True)
    ] = "auto"
    voxels: Annotated[
        Path | None, Knob("Own voxels instead: npy or npz, (x, y, z) of bits or labels")
    ] = None
    spacing: Annotated[
        tuple[float, float, float],
        Knob("Edges of an own voxel along x, y, z", 0.001, 1000, of_files=True),
    ] = (1.0, 1.0, 1.0)
    label: Annotated[
        int, Knob("Which label of own voxels; 0 takes all that are not 0", 0, 65_535, of_files=True)
    ] = 0
    unit: Annotated[Unit, Knob("Unit of the numbers in own files", of_files=True)] = "m"
    seed: Annotated[int, Knob("What chance draws, and where the grid falls", 0, 99)] = 0


@dataclass(frozen=True, eq=False, kw_only=True)
class Subject:
    """What is measured. Lengths are in its `unit`; the picture is `scale` times as large, in
    metres.

    Attributes:
        name: What it is called in sentences.
        p: Vertices about the origin.
        faces: Counterclockwise seen from outside.
        whole: The faces before a hole was cut or faces were turned round.
        low, high: The corners of its box.
        smooth: Whether area and volume are those of a smooth shape or of voxels, not of the mesh.
        area: The true area.
        volume: The true volume; NaN where nothing is enclosed.
        inside: Which points lie inside; None where nothing is enclosed.
        full: Which cells of a grid are full.
        grids: How many cells lie along the longest side, and the grid, ever finer.
        unit: Of lengths.
        scale: Metres of the picture per unit.
        note: What else a person should know of their own file, a sentence.
    """

    name: str
    p: np.ndarray
    faces: np.ndarray
    whole: np.ndarray
    low: np.ndarray
    high: np.ndarray
    smooth: bool
    area: float
    volume: float
    inside: Callable[[np.ndarray], np.ndarray] | None
    full: Callable[[Grid], np.ndarray] | None = None
    grids: tuple[tuple[int, Grid], ...] = ()
    unit: str = "m"
    scale: float = 1.0
    note: str = ""

    @property
    def diagonal(self) -> float:
        """The diagonal of its box."""
        return float(np.linalg.norm(self.high - self.low))


@dataclass(frozen=True, eq=False, kw_only=True)
class Study:
    """Errors of area and volume, relative, on ever finer meshes of one shape.

    Attributes:
        faces: How many faces the meshes have.
        errors: By name, one for each mesh; areas as shares of the true one where the mesh is a
            lantern.
    """

    faces: np.ndarray
    errors: dict[str, np.ndarray]


@dataclass(frozen=True, eq=False, kw_only=True)
class State:
    """One step of the lesson.

    Attributes:
        params: The inputs.
        subject: What is measured, the same for the whole run.
        now: What the method knows.
        in_triangle: Whether points are drawn in a single triangle, to see how.
        quarters: The shares of those points in its three corner quarters and the middle one.
        half_share: The share of the area that lies in the half with small faces.
        half_hits: The share of the points there.
        middle: The middle of the surface.
        study: Errors on ever finer meshes, in the last step.
        peeked: Of many more runs like this one, in the last step: the share whose interval misses
            the truth there, and the share where it did so at one step or more.
    """

    params: Params
    subject: Subject
    now: Sums | Cells | Throws | Lines | Sampled | Balls
    in_triangle: bool = False
    quarters: np.ndarray = field(default_factory=lambda: np.empty(0))
    half_share: float = float("nan")
    half_hits: float = float("nan")
    middle: np.ndarray = field(default_factory=lambda: np.zeros(3))
    study: Study | None = None
    peeked: tuple[float, float] | None = None

    @property
    def volume_error(self) -> float:
        """The relative error of a volume that was just measured; NaN where none was or the truth is
        not known.
        """
        result = self.now
        true = self.subject.volume
        if isinstance(result, Sums):
            return (
                result.volume / true - 1
                if result.count == len(self.subject.faces)
                else float("nan")
            )
        if isinstance(result, Cells):
            return result.volumes[-1] / true - 1
        return (
            result.estimates.values[-1] / true - 1 if isinstance(result, Throws) else float("nan")
        )

    @property
    def area_error(self) -> float:
        """The relative error of an area that was just measured; NaN where none was."""
        result = self.now
        true = self.subject.area
        if isinstance(result, Sums):
            return (
                result.area / true - 1 if result.count == len(self.subject.faces) else float("nan")
            )
        if isinstance(result, Cells):
            return result.areas[-1] / true - 1
        return result.estimates.values[-1] / true - 1 if isinstance(result, Lines) else float("nan")
