"""The stage `balls`: four balls of one radius, ever finer, and the gap at one vertex of each, which
shrinks with the area that the vertex stands for.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from lessons.curvature import ring
from lessons.curvature.functions import Functions, with_mistake
from lessons.curvature.inputs import Input
from lessons.curvature.mesh import front_of
from lessons.curvature.row import ALONG
from lessons.curvature.study import error_of
from workbench.captions import counted, degrees, number, square_metres
from workbench.data.shapes.surfaces import Surface, sphere
from workbench.geometry.meshes import edges, on_boundary
from workbench.geometry.meshes.laplacian import mixed_areas, mixed_cell
from workbench.lesson import Look, say
from workbench.numerals import angle, brief
from workbench.scene import Caption, Chart, Label, Mesh, Primitive, Scene, Segments

COUNTS = (42, 252, 1002, 4002)
BETWEEN = 2.35  # metres from one ball to the next
MOST_EDGES = 1000  # more of them hide the ball
VERTICES = Chart("Vertices")
GAP = Chart("Gap at the vertex", unit="deg")
AREA = Chart("Area of the cell", unit="m²")
CURVATURE = Chart("K at the vertex", unit="m⁻²")
ERROR = Chart("Error of K", unit="%")
FINER = Chart("Error of K on finer balls", "log₁₀ vertices", "log₁₀ error (%)", x_range=(1.5, 3.8))


@dataclass(frozen=True, eq=False)
class Balls:
    """The four balls, and the vertex of each that is looked at."""

    surfaces: tuple[Surface, ...]
    vertices: tuple[int, ...]


@dataclass(frozen=True, eq=False)
class Held:
    """What has been measured, ball after ball.

    Attributes:
        gaps: The angle defects at the vertices, degrees.
        areas: Their cells, m^2.
        K: Gaussian curvature there, 1/m^2; the truth is 1.
        errors: Of all vertices of each ball, relative, RMS.
    """

    gaps: tuple[float, ...]
    areas: tuple[float, ...]
    K: tuple[float, ...]
    errors: tuple[float, ...]


def setup(params: Input) -> Balls:
    """Return the balls, and of each a vertex in front."""
    surfaces = tuple(sphere(count) for count in COUNTS)
    fronts = (
        front_of(surface.p, surface.normals, on_boundary(surface.faces, len(surface.p)))
        for surface in surfaces
    )
    return Balls(surfaces, tuple(fronts))


def run(params: Input, subject: Balls, functions: Functions) -> Iterator[Held]:
    """Measure one ball after the other."""
    functions = with_mistake(params, functions)
    held = Held((), (), (), ())
    for surface, v in zip(subject.surfaces, subject.vertices, strict=True):
        p, faces = surface.p, surface.faces
        K = functions.gaussian(p, faces)
        held = Held(
            (*held.gaps, float(np.degrees(functions.defects(p, faces)[v]))),
            (*held.areas, float(mixed_areas(p, faces)[v])),
            (*held.K, float(K[v])),
            (*held.errors, error_of(surface, np.ones(len(p), dtype=bool), "gaussian", estimate=K)),
        )
        yield held


def draw(look: Look[Input, Balls, Held]) -> Scene:
    """Return the four balls, cell and numbers of those that are measured, and the error of each."""
    state, subject = look.now, look.subject
    scene: dict[str, Primitive] = {}
    for k, surface in enumerate(subject.surfaces):
        scene |= _ball(k, surface)
        if k < len(state.K):
            scene |= _measured(k, subject, state)
    x = np.log10([len(surface.p) for surface in subject.surfaces])
    y = np.full(len(x), np.nan)
    y[: len(state.K)] = np.log10(100 * np.array(state.errors))
    here = slice(len(state.K) - 1, len(state.K))
    return scene | {
        "vertices": VERTICES.scalar(len(subject.surfaces[len(state.K) - 1].p), "vertices"),
        "gap scalar": GAP.scalar(state.gaps[-1], "gap", "other"),
        "area scalar": AREA.scalar(state.areas[-1], "area of the cell", "highlight"),
        "K scalar": CURVATURE.scalar(state.K[-1], "K"),
        "error scalar": ERROR.scalar(100 * state.errors[-1], "error of K"),
        "finer": FINER.curve(x, y, "K from angles"),
        "finer/here": FINER.dots(x[here], y[here], "here"),
        "caption": caption(look),
    }


def _at(k: int) -> np.ndarray:
    """Return where the middle of a ball is."""
    return (k - (len(COUNTS) - 1) / 2) * BETWEEN * ALONG


def _ball(k: int, surface: Surface) -> dict[str, Primitive]:
    p = surface.p + _at(k)
    lines = edges(surface.faces)
    scene: dict[str, Primitive] = {f"balls/{k + 1}": Mesh(p, surface.faces, "neutral", flat=True)}
    if len(lines) <= MOST_EDGES:
        scene[f"balls/{k + 1} edges"] = Segments(p[lines], "neutral", 1, opacity=0.4)
    words = f"{len(p):,} vertices"
    scene[f"balls/{k + 1} words"] = Label(words, _at(k) + np.array([0.0, 0.0, 1.3]))
    return scene


def _measured(k: int, subject: Balls, state: Held) -> dict[str, Primitive]:
    surface, v = subject.surfaces[k], subject.vertices[k]
    around = surface.faces[(surface.faces == v).any(axis=1)]
    quads = mixed_cell(surface.p, around, v) + 0.02 * surface.normals[v]
    below = _at(k) - np.array([0.0, 0.0, 1.5])
    return {
        **ring.cell_of(f"balls/{k + 1} cell", quads + _at(k)),
        f"balls/{k + 1} gap": Label(f"gap {angle(state.gaps[k])}", below, "other"),
        f"balls/{k + 1} K": Label(
            f"K = {brief(state.K[k], 4)} m⁻²", below - np.array([0.0, 0.0, 0.35]), "source"
        ),
    }


def caption(look: Look[Input, Balls, Held]) -> Caption:
    """Say the gap, and what is left of it when it is divided by the area."""
    state, subject = look.now, look.subject
    k = len(state.K) - 1
    if not np.isfinite([state.gaps[k], state.K[k]]).all():
        return say(f"On ball {k + 1} of {len(COUNTS)} the gap or K is no number.", tone="wrong")
    return say(
        "{vertices}: a gap of {gap} on {area} makes K = {K} m⁻².",
        vertices=counted(len(subject.surfaces[k].p), "vertex", "vertices"),
        gap=degrees(state.gaps[k]),
        area=square_metres(state.areas[k]),
        K=number(state.K[k], 4),
    )
