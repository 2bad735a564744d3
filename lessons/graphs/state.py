"""The inputs, the graph of a run, and what one step holds."""

from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated, Literal

import numpy as np

from workbench.algorithms.graphs.diffusion import Heat, Smoothed
from workbench.algorithms.graphs.spectral_cut import Cut
from workbench.algorithms.learning.graph_network import Layer, Trained
from workbench.data.framing import Upward
from workbench.geometry.graphs import Join, Sparse, one_way_share
from workbench.geometry.graphs.spectra import Laplacian
from workbench.knobs import Knob, Pick

GraphName = Literal[
    "dumbbell",
    "karate",
    "grid",
    "ring",
    "sphere",
    "uneven sphere",
    "rabbit",
    "rabbit mesh",
    "star and square",
    "hexagon and triangles",
]
Stage = Literal["graph", "matrix", "spectrum", "cut", "heat", "smooth", "network", "training"]
Kind = Literal["plain", "normalised", "cotangent"]

CLOUDS = ("dumbbell", "uneven sphere", "rabbit")
PAIRS = ("star and square", "hexagon and triangles")
MOST_OWN = 20_000
LONGEST_NAME = 24  # letters of a node's name in sentences
OF_CLOUDS = {"graph": CLOUDS}
OF_L = {"stage": ("matrix", "spectrum", "cut", "heat")}


@dataclass(frozen=True)
class Params:
    """A graph, what is done with it, and how."""

    graph: Annotated[GraphName, Knob("Built-in points, meshes and graphs")] = "dumbbell"
    stage: Annotated[Stage, Knob("What is done with the graph")] = "cut"
    points: Annotated[
        int,
        Knob("How many points", 30, 3000, step=10, needs={"graph": (*CLOUDS, "ring", "sphere")}),
    ] = 400
    k: Annotated[int, Knob("Neighbours that every point names", 1, 20, needs=OF_CLOUDS)] = 6
    join: Annotated[
        Join, Knob("An edge if either end names the other, both do, or one-way", needs=OF_CLOUDS)
    ] = "union"
    share: Annotated[
        float,
        Knob(
            "Share of the points in the left half",
            0.5,
            0.95,
            step=0.05,
            needs={"graph": ("dumbbell",)},
        ),
    ] = 0.5
    bridge: Annotated[
        int, Knob("Points between the halves; 0 is a gap", 0, 40, needs={"graph": ("dumbbell",)})
    ] = 14
    columns: Annotated[
        int, Knob("Columns of the grid, which has 10 rows", 2, 20, needs={"graph": ("grid",)})
    ] = 12
    jitter: Annotated[
        float,
        Knob(
            "How far vertices stray along the sphere",
            0,
            0.25,
            unit="cells",
            needs={"graph": ("sphere",)},
        ),
    ] = 0.0
    weighted: Annotated[
        bool, Knob("Friends count by how often they met", needs={"graph": ("karate",)})
    ] = False
    laplacian: Annotated[Kind, Knob("Which Laplacian; cotangents need triangles", needs=OF_L)] = (
        "plain"
    )
    modes: Annotated[
        int, Knob("How many eigenvectors are shown", 2, 30, needs={"stage": ("spectrum",)})
    ] = 8
    step_size: Annotated[
        float,
        Knob(
            "Length of a step of heat",
            0.1,
            2.5,
            unit="/ λmax",
            step=0.01,
            needs={"stage": ("heat",)},
        ),
    ] = 1.0
    steps: Annotated[int, Knob("How many steps", 1, 200, needs={"stage": ("heat", "smooth")})] = 50
    filter: Annotated[
        Literal["laplace", "taubin"], Knob("How to smooth", needs={"stage": ("smooth",)})
    ] = "laplace"
    noise: Annotated[
        float,
        Knob(
            "Noise before smoothing (sigma)",
            0,
            0.5,
            unit="edges",
            step=0.05,
            needs={"stage": ("smooth",)},
        ),
    ] = 0.3
    layers: Annotated[
        int, Knob("Layers of the network", 0, 64, needs={"stage": ("network", "training")})
    ] = 2
    vertex: Annotated[
        int,
        Knob(
            "The node that is looked at: click one; -1 takes ours",
            -1,
            MOST_OWN - 1,
            by=Pick("nodes"),
        ),
    ] = -1
    numbering: Annotated[
        int, Knob("In which order nodes are numbered; 0 as they were made", 0, 99)
    ] = 0
    edges: Annotated[
        Path | None, Knob("Own graph: csv or txt, two names and maybe a weight per line")
    ] = None
    mesh: Annotated[Path | None, Knob("Own mesh: off, obj, ply, stl, glb")] = None
    cloud: Annotated[Path | None, Knob("Own cloud: ply, pcd, obj, xyz, csv, npz")] = None
    up: Annotated[Upward, Knob("Which axis of own points is up; auto guesses", of_files=True)] = (
        "auto"
    )
    seed: Annotated[int, Knob("Where chance puts points, noise and first weights", 0, 99)] = 0


@dataclass(frozen=True, eq=False, kw_only=True)
class Subject:
    """The graph of a run, or the points of which it is made.

    Attributes:
        name: What it is called in sentences.
        p: Where the nodes are, metres.
        edges: The given edges, each once; None for a cloud, whose edges come from neighbours.
        weights: One per given edge.
        faces: Triangles of a mesh; none elsewhere.
        classes: Which of two groups each node truly belongs to; empty where nobody knows.
        eigenvalues: What the smallest eigenvalues truly are, ascending; empty where nobody knows.
        of_surface: Whether these are of the surface, to which a graph's can be compared up to a
            factor only.
        front: The node that is looked at by default.
        labelled: Two nodes whose class a network is told.
        names: What an own graph calls its nodes.
        radius: Of a node in the picture, metres.
        flat: Whether all lie at z = 0.
    """

    name: str
    p: np.ndarray
    edges: np.ndarray | None = None
    weights: np.ndarray = field(default_factory=lambda: np.empty(0))
    faces: np.ndarray = field(default_factory=lambda: np.empty((0, 3), int))
    classes: np.ndarray = field(default_factory=lambda: np.empty(0, int))
    eigenvalues: np.ndarray = field(default_factory=lambda: np.empty(0))
    of_surface: bool = False
    front: int = 0
    labelled: tuple[int, int] = (0, 1)
    names: tuple[str, ...] = ()
    radius: float = 0.02
    flat: bool = True

    def called(self, node: int) -> str:
        """Return what sentences call a node."""
        if not self.names:
            return f"{node:,}"
        name = self.names[node]
        return name if len(name) <= LONGEST_NAME else f"{name[: LONGEST_NAME - 1]}…"


@dataclass(frozen=True, eq=False, kw_only=True)
class Grown:
    """A graph that grows: with one neighbour more per point, or a part more of its given edges.

    Attributes:
        k: Neighbours per point; 0 where edges are given.
        adjacency: The graph.
        directed: Who names whom; as `adjacency` where edges are given.
        parts: The component of each node, 0 being the largest.
    """

    k: int
    adjacency: Sparse
    directed: Sparse
    parts: np.ndarray

    @property
    def count(self) -> int:
        """How many components there are."""
        return int(self.parts.max(initial=-1)) + 1

    @property
    def one_way(self) -> float:
        """The share of namings that are not returned."""
        return one_way_share(self.directed)


@dataclass(frozen=True, eq=False, kw_only=True)
class Matrix:
    """One of the matrices of a graph; `part` says which, or that L is applied to the nodes' places
    along x.
    """

    part: Literal["adjacency", "degrees", "laplacian", "applied", "ordered"]
    laplacian: Laplacian
    shown: Sparse
    order: np.ndarray


@dataclass(frozen=True, eq=False, kw_only=True)
class Mode:
    """One eigenvector: its number from 0, all eigenvalues that are shown, and of a pair of graphs
    both spectra.

    `values` are in the unit of the truth; `spectra` are the eigenvalues of A and of L of each graph
    of a pair.
    """

    index: int
    values: np.ndarray
    functions: np.ndarray
    spectra: tuple[tuple[np.ndarray, np.ndarray], ...] = ()


ITERATIONS = 200
"""How long a network is trained."""
Now = Grown | Matrix | Mode | Cut | Heat | Smoothed | Layer | Trained


@dataclass(frozen=True, eq=False, kw_only=True)
class State:
    """One step: the graph, what was just computed, and what is known of the truth.

    Attributes:
        params: The inputs.
        subject: The nodes, the same for the whole run.
        adjacency: The graph.
        now: What this step computed.
        first: What the first step of this stage held, to compare.
    """

    params: Params
    subject: Subject
    adjacency: Sparse
    now: Now
    first: Now

    @property
    def vertex(self) -> int:
        """The node that is looked at."""
        return (
            self.subject.front
            if self.params.vertex < 0
            else self.params.vertex % len(self.subject.p)
        )

    @property
    def last(self) -> bool:
        """Whether the run ends here."""
        result, params = self.now, self.params
        match result:
            case Grown():
                return (
                    result.k == params.k
                    if result.k
                    else result.adjacency.sum() >= 2 * self.subject.weights.sum() - 1e-9
                )
            case Matrix():
                return result.part == "ordered"
            case Mode():
                return result.index == len(result.values) - 1
            case Cut():
                return result.phase == "best"
            case Heat() | Smoothed():
                return result.step == params.steps
            case Layer():
                return result.layer == params.layers and result.part in ("layer", "input")
            case Trained():
                return result.iteration == ITERATIONS
