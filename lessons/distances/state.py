"""The inputs, what distances are taken on, and what one step holds."""

from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated, Literal

import numpy as np

from workbench.algorithms.surfaces.heat_method import HeatState
from workbench.data.framing import Upward
from workbench.data.shapes.surfaces import MOST_JITTER
from workbench.geometry.points.metrics import Metric
from workbench.knobs import Knob, Pick

Stage = Literal["balls", "axioms", "whiten", "stereo", "grid", "surface", "roll"]
Shape = Literal["sphere", "wrung sphere", "torus", "rabbit"]
Neighbours = Literal["4", "8", "16", "march"]
MOST_OWN = 6000
IN_PLANE = {"stage": ("balls", "axioms")}
ON_SURFACE = {"stage": ("surface",)}


@dataclass(frozen=True)
class Params:
    """What is near, by which distance, and on what."""

    stage: Annotated[
        Stage, Knob("In the plane, in a scatter of points, round a wall, or on a surface")
    ] = "grid"
    metric: Annotated[Metric, Knob("The distance between two points", needs=IN_PLANE)] = "euclid"
    p: Annotated[
        float,
        Knob(
            "Exponent of p and p-sum", 0.5, 8, step=0.1, needs=IN_PLANE | {"metric": ("p", "p-sum")}
        ),
    ] = 0.5
    correlation: Annotated[
        float,
        Knob(
            "Correlation of x and y",
            -0.95,
            0.95,
            step=0.05,
            needs={"stage": ("balls", "axioms", "whiten")},
        ),
    ] = 0.9
    stretch: Annotated[
        int,
        Knob(
            "y is measured in units this much smaller than x",
            1,
            1000,
            unit="×",
            needs={"stage": ("balls",)},
        ),
    ] = 1
    outliers: Annotated[
        int,
        Knob("Points of a second cluster, off to one side", 0, 60, needs={"stage": ("whiten",)}),
    ] = 0
    away: Annotated[
        float,
        Knob(
            "How far away that cluster is", 1, 100, unit="σ", step=0.1, needs={"stage": ("whiten",)}
        ),
    ] = 2.8
    estimate: Annotated[
        Literal["sample", "robust"],
        Knob(
            "Covariance of all points, or of the half that lies closest together",
            needs={"stage": ("whiten",)},
        ),
    ] = "sample"
    points: Annotated[
        int,
        Knob(
            "How many points or vertices",
            4,
            3000,
            needs={"stage": ("balls", "whiten", "surface", "roll")},
        ),
    ] = 642
    grid: Annotated[
        int, Knob("Nodes along a side", 11, 161, step=10, needs={"stage": ("grid",)})
    ] = 41
    neighbours: Annotated[
        Neighbours,
        Knob(
            "Ways along edges to so many neighbours, or fast marching", needs={"stage": ("grid",)}
        ),
    ] = "8"
    wall: Annotated[
        float, Knob("Height of the wall", 0, 0.9, unit="m", step=0.1, needs={"stage": ("grid",)})
    ] = 0.8
    disc: Annotated[
        float,
        Knob(
            "Around the source distances are given within this radius",
            0,
            0.2,
            unit="m",
            step=0.05,
            needs={"stage": ("grid",), "neighbours": ("march",)},
        ),
    ] = 0.0
    shape: Annotated[Shape, Knob("The surface", needs=ON_SURFACE)] = "sphere"
    jitter: Annotated[
        float,
        Knob(
            "How far vertices stray along the sphere",
            0,
            MOST_JITTER,
            unit="cells",
            step=0.05,
            needs=ON_SURFACE | {"shape": ("sphere",)},
        ),
    ] = 0.0
    method: Annotated[
        Literal["edges", "heat"], Knob("Along edges, or by heat", needs=ON_SURFACE)
    ] = "edges"
    extra: Annotated[
        int,
        Knob(
            "Points added on every edge, joined across the faces",
            0,
            4,
            needs=ON_SURFACE | {"method": ("edges",)},
        ),
    ] = 0
    time: Annotated[
        float,
        Knob(
            "How long heat flows, in squared mean edges: log₁₀",
            -2,
            3,
            step=0.5,
            needs=ON_SURFACE | {"method": ("heat",)},
        ),
    ] = 0.0
    delaunay: Annotated[
        bool,
        Knob(
            "Edges are flipped within the surface until no weight is negative",
            needs=ON_SURFACE | {"method": ("heat",)},
        ),
    ] = False
    k: Annotated[
        int, Knob("Neighbours of every point of the roll", 4, 30, needs={"stage": ("roll",)})
    ] = 15
    source: Annotated[
        int,
        Knob(
            "Where distances start: click a place; -1 takes ours",
            -1,
            25_920,
            by=Pick("nodes"),
            needs={"stage": ("balls", "grid", "surface", "roll")},
        ),
    ] = -1
    mesh: Annotated[
        Path | None,
        Knob("Own mesh for the stage surface: off, obj, ply, stl, glb", needs=ON_SURFACE),
    ] = None
    cloud: Annotated[
        Path | None,
        Knob(
            "Own cloud for the stage roll: ply, pcd, obj, xyz, csv, npz", needs={"stage": ("roll",)}
        ),
    ] = None
    up: Annotated[Upward, Knob("Which axis of own files is up; auto guesses", of_files=True)] = (
        "auto"
    )
    seed: Annotated[int, Knob("Where chance puts points", 0, 99)] = 0


@dataclass(frozen=True, eq=False, kw_only=True)
class Subject:
    """What ways lead over: nodes, edges, and how far apart nodes truly are.

    Attributes:
        name: What it is called in sentences.
        p: Where the nodes are, metres.
        faces: Triangles of a surface or of the square; none for a cloud.
        edges: Between which nodes ways lead.
        lengths: Of the edges, metres.
        source: Where distances start.
        goal: A node to which the way is shown; -1 for the one whose distance is farthest off.
        truth: The true distance of every node; empty where only a reference can be computed, or
            nothing.
        free: Which nodes can be reached; those of a wall cannot.
        shortcuts: Which edges leave the surface; empty where nobody knows.
        h: Mean length of the edges, or spacing of the grid, metres.
        tip: Where the wall ends, in the plane.
        sheet: Where the nodes of a roll lie once it is unrolled, metres.
        is_sphere: Whether ways over great circles are the true ones.
        side: Nodes along a side of a grid.
        radius: Of a node in the picture, metres.
    """

    name: str
    p: np.ndarray
    faces: np.ndarray
    edges: np.ndarray
    lengths: np.ndarray
    source: int
    goal: int = -1
    truth: np.ndarray = field(default_factory=lambda: np.empty(0))
    free: np.ndarray = field(default_factory=lambda: np.empty(0, bool))
    shortcuts: np.ndarray = field(default_factory=lambda: np.empty(0, bool))
    h: float = 0.0
    tip: np.ndarray | None = None
    sheet: np.ndarray = field(default_factory=lambda: np.empty((0, 2)))
    is_sphere: bool = False
    side: int = 0
    radius: float = 0.015


@dataclass(frozen=True, eq=False, kw_only=True)
class Front:
    """How far a front has come.

    Attributes:
        d: Distances, final and tentative; inf or NaN beyond.
        accepted: Which are final.
        reach: Up to where all are.
    """

    d: np.ndarray
    accepted: np.ndarray
    reach: float


@dataclass(frozen=True, eq=False, kw_only=True)
class Found:
    """All distances, beside the truth.

    Attributes:
        d: Distances.
        path: Nodes of the way to the goal.
        error: d over the truth, minus 1, where it means something; NaN elsewhere.
        truth: What they should be; empty where nobody knows.
        asymmetry: How much d(a, b) and d(b, a) differ for some pairs, as a share; none for ways
            along edges.
        broken: The share of triples of these nodes that break the triangle inequality.
        study: Of ever finer grids or meshes: log10 of their spacing, and by method log10 of the
            worst error in per cent.
        times: Of heat: log10 of the time in squared edges, and the mean size of the error in per
            cent.
        negative: Of heat: how many edges have a negative weight.
        eight: Of fast marching: the worst error of ways to 8 neighbours on the same grid; NaN
            elsewhere.
    """

    d: np.ndarray
    path: np.ndarray
    error: np.ndarray
    truth: np.ndarray
    asymmetry: np.ndarray = field(default_factory=lambda: np.empty(0))
    broken: float = float("nan")
    study: dict[str, tuple[np.ndarray, np.ndarray]] = field(default_factory=dict)
    times: tuple[np.ndarray, np.ndarray] | None = None
    negative: int = 0
    eight: float = float("nan")

    @property
    def below(self) -> float:
        """The share of distances below 0, which none can be."""
        return float((self.d < -1e-9).mean())

    @property
    def worst(self) -> float:
        """The error of largest size, with its sign; NaN where nobody knows."""
        known = self.error[np.isfinite(self.error)]
        return float(known[np.abs(known).argmax()]) if len(known) else float("nan")

    @property
    def mean(self) -> float:
        """The mean error; NaN where nobody knows."""
        known = self.error[np.isfinite(self.error)]
        return float(known.mean()) if len(known) else float("nan")


@dataclass(frozen=True, eq=False, kw_only=True)
class Ball:
    """All that lies within a radius of one point.

    Attributes:
        p: The points.
        query: Which of them is in the middle.
        d: Their distances from it; inf for itself.
        radius: Of the ball.
        rims: The outline of the ball by this distance, and of Euclid's, closed or open lines.
        nearest: By every distance the nearest of the others, y being in the unit of the params.
        straight: The nearest by Euclid's distance with x and y in metres.
        changed: Of many other queries: which have another nearest point than by Euclid's; empty
            before the end.
        queries: Where these are.
    """

    p: np.ndarray
    query: int
    d: np.ndarray
    radius: float
    rims: tuple[np.ndarray, np.ndarray]
    nearest: dict[str, int] = field(default_factory=dict)
    straight: int = -1
    queries: np.ndarray = field(default_factory=lambda: np.empty((0, 2)))
    changed: np.ndarray = field(default_factory=lambda: np.empty(0, bool))


@dataclass(frozen=True, eq=False, kw_only=True)
class Trials:
    """How often triples of points break the triangle inequality.

    Attributes:
        tried: How many triples so far.
        broken: How many broke it.
        corners: The triple of this step that broke it by most, or kept it by least: a, b, c.
        sides: Its three distances ab, bc, ac.
        axioms: For each axiom the share of tries that broke it.
    """

    tried: int
    broken: int
    corners: np.ndarray
    sides: np.ndarray
    axioms: dict[str, float]


@dataclass(frozen=True, eq=False, kw_only=True)
class Scatter:
    """A scatter of points on its way to a round one.

    Attributes:
        phase: What was done last.
        p: The points as they now lie.
        outlier: Which belong to the second cluster.
        d: Their Mahalanobis distances.
        limit: The radius of 95 % in two dimensions.
        rim: The ellipse at that radius, as it now lies.
        shares: Of fresh points in 1 to 10 dimensions: the share within 2 by chance and in truth.
    """

    phase: Literal["points", "centred", "turned", "scaled", "told", "dimensions"]
    p: np.ndarray
    outlier: np.ndarray
    d: np.ndarray
    limit: float
    rim: np.ndarray
    shares: tuple[np.ndarray, np.ndarray] | None = None

    @property
    def flagged(self) -> np.ndarray:
        """Which points lie beyond the limit."""
        return self.d > self.limit


@dataclass(frozen=True, eq=False, kw_only=True)
class Landmarks:
    """Which landmark each measurement of a stereo camera is taken for.

    Attributes:
        landmarks: Seen from above: across and ahead, metres.
        seen: Where measurements put them.
        true: Which landmark each is in truth.
        euclid: Which is nearest.
        mahalanobis: Which is nearest in standard deviations of the measurement.
        rims: The 95 % ellipse of each of the last measurements.
    """

    landmarks: np.ndarray
    seen: np.ndarray
    true: np.ndarray
    euclid: np.ndarray
    mahalanobis: np.ndarray
    rims: np.ndarray


Now = Front | Found | HeatState | Ball | Trials | Scatter | Landmarks


@dataclass(frozen=True, eq=False, kw_only=True)
class State:
    """One step: the inputs, what ways lead over where there are any, and what was just computed."""

    params: Params
    now: Now
    subject: Subject | None = None
