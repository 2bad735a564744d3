"""The inputs, what is stored, and what one step holds."""

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated, Literal

import numpy as np

from workbench.algorithms.learning.neural_field import Activation, Target, Trained
from workbench.algorithms.spatial.kd_tree import Tree, Visit
from workbench.algorithms.spatial.octree import Level
from workbench.data.framing import Upward
from workbench.geometry.fields.voxels import Grid
from workbench.knobs import Gizmo, Knob

Form = Literal[
    "cloud", "neighbours", "mesh", "voxels", "distances", "octree", "k-d tree", "patches", "neural"
]
Shape = Literal["torus", "box", "rabbit", "plate", "two boxes"]
SHAPED = {"form": ("cloud", "neighbours", "mesh", "voxels", "distances", "octree", "neural")}
NEURAL = {"form": ("neural",)}
OF_CLOUDS: dict[str, tuple[Form, ...]] = {"form": ("cloud", "neighbours", "k-d tree")}


@dataclass(frozen=True)
class Params:
    """A shape or a person's own, and how it is stored."""

    form: Annotated[Form, Knob("How the shape is stored")] = "distances"
    shape: Annotated[Shape, Knob("What is stored", needs=SHAPED)] = "torus"
    resolution: Annotated[
        int,
        Knob(
            "Cells along an edge of the cube at the end",
            8,
            64,
            needs={"form": ("voxels", "distances")},
        ),
    ] = 32
    depth: Annotated[
        int, Knob("How often cells of the octree are cut", 3, 7, needs={"form": ("octree",)})
    ] = 5
    points: Annotated[
        int,
        Knob(
            "Points at the end, of a mesh vertices at most",
            100,
            100_000,
            step=100,
            needs={"form": ("cloud", "neighbours", "mesh", "k-d tree")},
        ),
    ] = 4000
    neighbours: Annotated[
        int, Knob("How many each point is joined to", 1, 16, needs={"form": ("neighbours",)})
    ] = 8
    thickness: Annotated[
        float,
        Knob(
            "Of the plate, in cells of the last grid",
            0.2,
            2,
            unit="cells",
            step=0.1,
            needs={"shape": ("plate",)},
        ),
    ] = 0.5
    iterations: Annotated[int, Knob("Steps of Adam", 100, 1500, step=25, needs=NEURAL)] = 300
    width: Annotated[int, Knob("Numbers in each of two hidden layers", 8, 64, needs=NEURAL)] = 32
    features: Annotated[
        int,
        Knob("Octaves of sine and cosine of each coordinate that go in too", 0, 5, needs=NEURAL),
    ] = 2
    target: Annotated[Target, Knob("What the network is asked for", needs=NEURAL)] = "sdf"
    activation: Annotated[Activation, Knob("What follows each hidden layer", needs=NEURAL)] = "tanh"
    rational: Annotated[bool, Knob("Control points have weights", needs={"form": ("patches",)})] = (
        False
    )
    place: Annotated[
        tuple[float, float],
        Knob("Where on the first patch", 0, 1, parts=("u", "v"), needs={"form": ("patches",)}),
    ] = (0.4, 0.6)
    dimensions: Annotated[
        int, Knob("Coordinates of each point", 2, 20, needs={"form": ("k-d tree",)})
    ] = 3
    query: Annotated[
        tuple[float, float, float],
        Knob(
            "Whose nearest point is looked for",
            -1,
            1,
            unit="m",
            by=Gizmo(0.3),
            needs={"form": ("k-d tree",)},
        ),
    ] = (0.35, -0.6, 0.25)
    mesh: Annotated[Path | None, Knob("Own mesh instead: off, obj, ply, stl, glb")] = None
    cloud: Annotated[
        Path | None, Knob("Own points instead: ply, pcd, obj, xyz, csv, npz", needs=OF_CLOUDS)
    ] = None
    up: Annotated[
        Upward, Knob("Which axis of an own file points up; auto guesses", of_files=True)
    ] = "auto"
    seed: Annotated[int, Knob("What chance draws, and how the plate lies", 0, 99)] = 0


@dataclass(frozen=True, eq=False, kw_only=True)
class Subject:
    """What is stored, in the cube from -1 to 1 along each axis, metres.

    Attributes:
        name: What it is called in sentences.
        p: Vertices of a fine mesh of it; of an own cloud its points.
        faces: Counterclockwise seen from outside; none of a cloud.
        distance: The true distance of points to it, negative inside; nowhere negative where it is
            open.
        field: What is stored as its distance.
        inside: Which points it encloses.
        area: The true area.
        volume: The true volume; NaN where it encloses nothing.
        on: Points spread over it.
        quick: Whether its distances are a formula, so that thousands of them cost nothing.
        unsigned: The distance without its sign, where that is found sooner.
    """

    name: str
    p: np.ndarray
    faces: np.ndarray
    distance: Callable[[np.ndarray], np.ndarray]
    field: Callable[[np.ndarray], np.ndarray]
    inside: Callable[[np.ndarray], np.ndarray]
    area: float
    volume: float
    on: np.ndarray
    quick: bool = True
    unsigned: Callable[[np.ndarray], np.ndarray] | None = None

    def away(self, q: np.ndarray) -> np.ndarray:
        """Return how far points are from it, inside or outside, m."""
        return np.abs(self.distance(q)) if self.unsigned is None else self.unsigned(q)

    @property
    def closed(self) -> bool:
        """Whether there is an inside."""
        return bool(np.isfinite(self.volume))


@dataclass(frozen=True, eq=False, kw_only=True)
class Surface:
    """A surface that came back from a form, beside the true one.

    Attributes:
        p: Vertices, m; none where no surface came back.
        faces: Counterclockwise seen from outside.
        mean: How far its points are from the true surface on average, m.
        worst: The farthest.
        area: Its area over the true one.
        volume: Its volume over the true one; NaN where there is none.
        tilt: The mean angle between its normals and the true ones, degrees.
    """

    p: np.ndarray
    faces: np.ndarray
    mean: float
    worst: float
    area: float
    volume: float
    tilt: float


@dataclass(frozen=True, eq=False, kw_only=True)
class Cloud:
    """Points, and how far points of the true surface are from the nearest of them, m."""

    p: np.ndarray
    mean: float
    worst: float
    hole: np.ndarray


@dataclass(frozen=True, eq=False, kw_only=True)
class Joined:
    """Points, each joined to its k nearest: edges (e, 2), pieces, how far middles of edges are off,
    m, whose is worst.
    """

    p: np.ndarray
    k: int
    edges: np.ndarray
    pieces: int
    mean: float = 0.0
    worst: float = 0.0
    bridge: int = -1


@dataclass(frozen=True, eq=False, kw_only=True)
class Cells:
    """One number for each cell of a grid: bits, or distances. `walls` is the area of the walls of
    full cells, m^2.
    """

    grid: Grid
    values: np.ndarray
    walls: float = float("nan")


@dataclass(frozen=True, eq=False, kw_only=True)
class Patches:
    """Patches of a torus: their control points (w x, w y, w z, w), and which of them were
    evaluated.

    Attributes:
        control: The control points.
        net: The different ones.
        levels: De Casteljau's points so far: those of the four rows, and then of the column that
            they give.
        point: Where the student's function says that the place is.
        count: How many patches were evaluated.
    """

    control: np.ndarray
    net: np.ndarray
    levels: tuple[np.ndarray, ...] = ()
    point: np.ndarray | None = None
    count: int = 0


@dataclass(frozen=True, eq=False, kw_only=True)
class Built:
    """A k-d tree down to one level of cuts."""

    tree: Tree
    depth: int


@dataclass(frozen=True, eq=False, kw_only=True)
class Searched:
    """A k-d tree and a query, d coordinates, up to some visits; `done` where the search ended."""

    tree: Tree
    query: np.ndarray
    visits: tuple[Visit, ...]
    done: bool


@dataclass(frozen=True, eq=False, kw_only=True)
class Fitted:
    """A network after some iterations, and its field on a grid."""

    trained: Trained
    grid: Grid
    values: np.ndarray


@dataclass(frozen=True, eq=False, kw_only=True)
class Growth:
    """How many points a search looks at on average: of ever more points in 3 dimensions, of 4,000
    in ever more of them.
    """

    counts: np.ndarray
    looked: np.ndarray
    dimensions: np.ndarray
    shares: np.ndarray


@dataclass(frozen=True, eq=False, kw_only=True)
class State:
    """One step of the lesson.

    Attributes:
        params: The inputs.
        subject: What is stored; None of a k-d tree.
        now: The form so far.
        surface: What came back from it at this step.
        bytes: What the form takes at this step.
        sizes: Bytes of the forms so far.
        errors: Their mean errors, m.
        others: Bytes and errors of other forms of the same shape, at the end.
        mixed: Of an octree: how many cells the surface may cross, level by level above this one.
        growth: How searches grow, at the end of a k-d tree.
    """

    params: Params
    subject: Subject | None
    now: Cloud | Joined | Cells | Level | Patches | Built | Searched | Fitted | None = None
    surface: Surface | None = None
    bytes: int = 0
    sizes: tuple[int, ...] = ()
    errors: tuple[float, ...] = ()
    others: dict[str, tuple[np.ndarray, np.ndarray]] = field(default_factory=dict)
    mixed: tuple[int, ...] = ()
    growth: Growth | None = None
