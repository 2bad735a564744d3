"""What one step looks like: the mesh in the colours of what was measured, and the vertex from close by."""

import numpy as np

from lessons.curvature import ring
from lessons.curvature.charts import beside
from lessons.curvature.state import State
from lessons.curvature.words import caption
from workbench.scene import Color, Field, Mesh, Points, Primitive, Role, Scene, Segments

# Fixed, so that the same colour means the same curvature in every run.
K_SCALE, H_SCALE, DEFECT_SCALE, ERROR_SCALE = 5.0, 2.5, 0.2, 1.0
ARROW = 0.06  # metres of arrow per m⁻¹
MOST_EDGES, MOST_ARROWS, MOST_CROSSES = 6000, 3000, 1500


def draw(state: State) -> Scene:
    """Return the picture of one step."""
    subject, now, stage = state.subject, state.now, state.stage
    edge = ring.edge_length(now)
    scene: dict[str, Primitive] = {
        "surface": Mesh(subject.p, subject.faces, _color(state), name=subject.name),
        "vertex": Points(
            now.p[[now.vertex]] + 0.1 * edge * now.normals[now.vertex],
            "highlight",
            0.15 * edge,
            name=f"vertex {now.vertex:,}",
        ),
        "caption": caption(state),
    }
    if len(subject.edges) <= MOST_EDGES:
        scene["edges"] = Segments(subject.p[subject.edges], "neutral", 1, opacity=0.5, name="edges")
    if stage == "ring":
        scene |= ring.angles(now)
    elif stage == "defect":
        scene |= ring.flattened(now)
    elif stage == "gaussian":
        scene |= ring.cell(now)
    elif stage == "normal":
        scene |= {"mean normals": _arrows(state)} | ring.pulls(now, ARROW)
    elif stage == "principal":
        scene |= _crosses(state) | ring.circles(now)
    elif stage == "quadric":
        scene |= ring.patch(state)
    return scene | beside(state)


def _color(state: State) -> Color:
    now, stage, truth = state.now, state.stage, state.subject.truth
    if stage == "gaussian":
        return _signed(now.K, K_SCALE, "Gaussian curvature K", "m⁻²")
    if stage in ("mean", "principal"):
        return _signed(now.H, H_SCALE, "mean curvature H", "m⁻¹")
    if stage in ("defect", "total"):
        return _signed(now.defects, DEFECT_SCALE, "angle defect", "rad")
    if stage == "quadric" and now.quadrics is not None:
        return _signed(now.quadrics.curvatures()[0], K_SCALE, "K by quadric fit", "m⁻²")
    if stage == "finer" and truth is not None:
        error = np.where(state.subject.border, np.nan, now.K - truth.gaussian)
        return _signed(error, ERROR_SCALE, "error of K from angles", "m⁻²")
    return "neutral"


def _signed(values: np.ndarray, scale: float, title: str, unit: str) -> Field:
    return Field(values, -scale, scale, title, unit, "diverging")


def _arrows(state: State) -> Segments:
    """Return the mean-curvature normals of all vertices that have one, or of enough of them."""
    v = state.now.normals_2H
    rows = np.flatnonzero(np.isfinite(v).all(axis=1))
    rows = rows[:: max(1, -(-len(rows) // MOST_ARROWS))]
    p = state.now.p[rows]
    return Segments(np.stack([p, p + ARROW * v[rows]], axis=1), "source", 1.5, name="2 H n (6 cm for m⁻¹)")


def _crosses(state: State) -> dict[str, Primitive]:
    """Return the two principal directions at all vertices, or at enough of them."""
    now = state.now
    every = max(1, -(-len(now.p) // MOST_CROSSES))
    p, n = now.p[::every], now.normals[::every]
    half = 0.3 * np.median(np.linalg.norm(np.diff(now.p[state.subject.edges], axis=1)[:, 0], axis=1))
    scene: dict[str, Primitive] = {}
    both: tuple[tuple[str, Role, np.ndarray], ...] = (
        ("along k1", "source", now.along_k1),
        ("along k2", "other", now.along_k2),
    )
    for name, role, v in both:
        ends = np.stack([p - half * v[::every], p + half * v[::every]], axis=1) + 0.05 * half * n[:, None]
        scene[name] = Segments(ends, role, 2, name=f"direction of {name[-2:]}")
    return scene
