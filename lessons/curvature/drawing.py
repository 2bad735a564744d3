"""What one step looks like: the mesh in the colours of what was measured, and the vertex from close
by.
"""

import numpy as np

from lessons.curvature import ring, row
from lessons.curvature.captions import caption
from lessons.curvature.charts import beside
from lessons.curvature.scales import DEFECT_SCALE, H_SCALE, K_SCALE, arrow, reach, share_within
from lessons.curvature.state import State
from workbench.data.thinning import every
from workbench.geometry.polylines import between
from workbench.numerals import brief
from workbench.scene import Color, Field, Mesh, Points, Primitive, Role, Scene, Segments

MOST_EDGES, MOST_ARROWS, MOST_CROSSES = 6000, 3000, 1500


def draw(state: State) -> Scene:
    """Return the picture of one step."""
    if state.study is not None:
        return row.drawn(state, state.study) | {"caption": caption(state)} | beside(state)
    subject, mesh, stage = state.subject, state.now, state.stage
    edge = ring.edge_length(mesh)
    scene: dict[str, Primitive] = {
        "surface": Mesh(
            subject.p, subject.faces, _color(state), opacity=0.6 if stage == "principal" else 1.0
        ),
        "vertex": Points(
            mesh.p[[mesh.vertex]] + 0.1 * edge * mesh.normals[mesh.vertex],
            "highlight",
            0.1 * edge,
            name=f"vertex {mesh.vertex:,}",
        ),
        "caption": caption(state),
    }
    if len(subject.edges) <= MOST_EDGES:
        scene["edges"] = Segments(subject.p[subject.edges], "neutral", 1, opacity=0.4)
    if stage == "ring":
        scene |= ring.angles(mesh)
    elif stage in ("unfolding", "defect"):
        scene |= ring.flattened(mesh, state.unfolded)
    elif stage == "gaussian":
        scene |= ring.cell(mesh)
    elif stage == "normal":
        scene |= {"normals": _arrows(state)} | ring.pushes(mesh, arrow(state))
    elif stage == "principal":
        scene |= _crosses(state) | ring.circles(mesh)
    elif stage == "quadric":
        scene |= ring.patch(state)
    return scene | beside(state)


def _color(state: State) -> Color:
    mesh, stage = state.now, state.stage
    if stage == "gaussian":
        return _signed(state, mesh.K, K_SCALE, title="Gaussian curvature K", unit="m⁻²")
    if stage == "mean":
        return _signed(state, mesh.H, H_SCALE, title="mean curvature H", unit="m⁻¹")
    if stage in ("defect", "total"):
        return _signed(state, mesh.defects, DEFECT_SCALE, title="angle defect", unit="rad")
    if stage == "quadric" and mesh.quadrics is not None:
        return _signed(
            state, mesh.quadrics.curvatures()[0], K_SCALE, title="K by quadric fit", unit="m⁻²"
        )
    return "neutral"


def _signed(state: State, values: np.ndarray, fixed: float, *, title: str, unit: str) -> Field:
    scale = reach(state, values, fixed)
    title = (
        title
        if state.subject.truth is not None
        else f"{title}, {share_within(values, scale)} of the vertices within"
    )
    return Field(values, -scale, scale, title, unit, "diverging")


def _arrows(state: State) -> Segments:
    """Return the mean-curvature normals of all vertices that have one, or of enough of them."""
    v = state.now.normals_2H
    rows = np.flatnonzero(np.isfinite(v).all(axis=1))
    rows = rows[every(len(rows), MOST_ARROWS)]
    p = state.now.p[rows]
    metres = arrow(state)
    name = f"2 H n ({brief(100 * metres)} cm for 1 m⁻¹)"
    return Segments(between(p, p + metres * v[rows]), "source", 1.5, name=name)


def _crosses(state: State) -> dict[str, Primitive]:
    """Return the two principal directions at all vertices, or at enough of them."""
    mesh = state.now
    rows = every(len(mesh.p), MOST_CROSSES)
    p, n = mesh.p[rows], mesh.normals[rows]
    half = 0.3 * np.median(
        np.linalg.norm(np.diff(mesh.p[state.subject.edges], axis=1)[:, 0], axis=1)
    )
    scene: dict[str, Primitive] = {}
    both: tuple[tuple[str, Role, np.ndarray], ...] = (
        ("k₁", "source", mesh.along_k1),
        ("k₂", "other", mesh.along_k2),
    )
    for name, role, v in both:
        ends = between(p - half * v[rows], p + half * v[rows]) + 0.05 * half * n[:, None]
        scene[f"ticks/{name}"] = Segments(ends, role, 2, name=f"direction of {name}")
    return scene
