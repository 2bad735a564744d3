"""What is drawn close to the vertex: its angles, its faces laid flat, its area, circles that bend
as it does.
"""

import numpy as np

from lessons.curvature.state import State
from workbench.algorithms.surfaces.curvature import Measured
from workbench.certain import sure
from workbench.geometry.meshes.laplacian import mixed_cell, vertex_pushes
from workbench.geometry.polylines import between, fan, segments
from workbench.numerals import brief
from workbench.scene import Label, Mesh, Points, Primitive, Role, Segments

LIFT = 0.03  # how far things float above the surface, in edges
ASIDE = 1.0  # edges: how far to the right a ring is laid flat
FARTHEST = 1.3  # metres from the vertex that a circle's centre is drawn
CIRCLE = 2 * np.pi * np.arange(97) / 96


def edge_length(mesh: Measured) -> float:
    """Return the mean length of the edges at the vertex, the measure of all that is drawn there."""
    return float(np.linalg.norm(mesh.p[neighbours(mesh)] - mesh.p[mesh.vertex], axis=1).mean())


def neighbours(mesh: Measured) -> np.ndarray:
    """Return the ring; before it is known, the vertices of the faces around."""
    if len(mesh.ring):
        return mesh.ring
    return np.setdiff1d(mesh.faces[(mesh.faces == mesh.vertex).any(axis=1)], mesh.vertex)


def angles(mesh: Measured) -> dict[str, Primitive]:
    """Return the faces around the vertex, an arc in each, and its degrees."""
    centre = _lifted(mesh)
    lift = LIFT * edge_length(mesh) * mesh.normals[mesh.vertex]
    v = mesh.p[mesh.ring] - mesh.p[mesh.vertex]
    radius = 0.35 * np.linalg.norm(v, axis=1).min()
    used, name = np.unique(mesh.faces[mesh.ring_faces], return_inverse=True)
    scene: dict[str, Primitive] = {
        "ring": Mesh(
            mesh.p[used] + lift, name.reshape(-1, 3), "highlight", opacity=0.55, flat=True
        ),
    }
    arcs = []
    for i, angle in enumerate(mesh.angles):
        a = v[i] / np.linalg.norm(v[i])
        b = v[(i + 1) % len(v)] - (v[(i + 1) % len(v)] @ a) * a
        b /= np.linalg.norm(b) or 1.0
        turn = np.linspace(0.06, 0.94, 9)[:, None] * angle
        arcs.append(segments(centre + radius * (np.cos(turn) * a + np.sin(turn) * b)))
        middle = np.cos(angle / 2) * a + np.sin(angle / 2) * b
        scene[f"angle {i}"] = Label(
            f"{np.degrees(angle):.1f}°", centre + 1.75 * radius * middle, "highlight"
        )
    scene["arcs"] = Segments(np.concatenate(arcs), "highlight", 3)
    return scene


def flattened(mesh: Measured, share: float = 1.0) -> dict[str, Primitive]:
    """Return the ring, cut along an edge and laid flat beside the vertex to a share of the way; no
    triangle is bent.

    Where it is flat and does not close, the gap is the defect.
    """
    n = mesh.normals[mesh.vertex]
    edge = edge_length(mesh)
    defect = float(mesh.defects[mesh.vertex])
    inner = len(mesh.ring) == len(mesh.angles)
    rim = mesh.p[mesh.ring] - mesh.p[mesh.vertex]
    rim = np.vstack([rim, rim[:1]]) if inner else rim
    lengths = np.linalg.norm(rim, axis=1)
    turned = np.concatenate([[0.0], np.cumsum(mesh.angles)])
    right = rim[0] - (rim[0] @ n) * n
    right /= np.linalg.norm(right)
    up = np.cross(n, right)
    centre = mesh.p[mesh.vertex] + edge * ((LIFT + share) * n + ASIDE * share * _aside(n))
    rise = 0.02 * share * edge * (defect < 0)  # for each radian: keeps faces apart that overlap

    def flat(turn: np.ndarray) -> np.ndarray:
        return np.cos(turn)[:, None] * right + np.sin(turn)[:, None] * up

    def at(
        along: np.ndarray, turn: np.ndarray, radius: np.ndarray | float, *, height: float = 0.0
    ) -> np.ndarray:
        return (
            centre
            + np.reshape(radius, (-1, 1)) * along
            + (height * edge + rise * turn)[:, None] * n
        )

    along = flat(turned)
    if share < 1:
        along = _unbent((1 - share) * rim / lengths[:, None] + share * along, mesh.angles)
    p = np.vstack([centre, at(along, turned, lengths)])
    scene: dict[str, Primitive] = {
        "flat ring": Mesh(p, fan(len(p)), "highlight", opacity=0.5, flat=True),
        "flat edges": Segments(between(centre, p[1:]), "highlight", 2),
        "stalk": Segments(between(mesh.p[mesh.vertex], centre), "correspondence", 1),
    }
    if share < 1:
        return scene
    full = np.array([turned[-1] + defect])
    gap = np.linspace(min(turned[-1], full[0]), max(turned[-1], full[0]), 25)
    end = at(flat(full), full, lengths[-1])
    word = "gap" if defect > 0 else "overlap"
    return scene | {
        "gap": Segments(
            segments(at(flat(gap), gap, 0.8 * lengths.min(), height=0.02)),
            "other",
            5,
            name="angle defect",
        ),
        "gap edge": Segments(between(centre, end), "other", 3),
        "gap label": Label(
            f"{word} {abs(np.degrees(defect)):.2f}°",
            at(flat(full), full, 1.1 * lengths.max())[0],
            "other",
        ),
    }


def _aside(n: np.ndarray) -> np.ndarray:
    """Return the level direction to the right of who looks against a normal."""
    right = np.cross([0.0, 0.0, 1.0], n)
    length = float(np.linalg.norm(right))
    return right / length if length > 1e-6 else np.array([1.0, 0.0, 0.0])


def _unbent(along: np.ndarray, angles: np.ndarray) -> np.ndarray:
    """Return directions near those given, each at its angle from the one before, so that triangles
    keep their shape.
    """
    directions = [along[0] / np.linalg.norm(along[0])]
    for wanted, angle in zip(along[1:], angles, strict=True):
        aside = wanted - (wanted @ directions[-1]) * directions[-1]
        directions.append(
            np.cos(angle) * directions[-1]
            + np.sin(angle) * aside / max(float(np.linalg.norm(aside)), 1e-12)
        )
    return np.array(directions)


def cell(mesh: Measured) -> dict[str, Primitive]:
    """Return the mixed area of the vertex, and how large it is."""
    lift = 2 * LIFT * edge_length(mesh) * mesh.normals[mesh.vertex]
    text = f"A = {brief(mesh.areas[mesh.vertex])} m²"
    return {
        **cell_of("cell", mixed_cell(mesh.p, mesh.faces[mesh.ring_faces], mesh.vertex) + lift),
        "cell label": Label(text, _lifted(mesh, 0.5), "highlight"),
    }


def cell_of(name: str, quads: np.ndarray) -> dict[str, Primitive]:
    """Return a mixed area (f, 4, 3), piece by piece: its part of each face around."""
    start = 4 * np.arange(len(quads))[:, None]
    faces = (start + np.array([[0, 1, 2, 0, 2, 3]])).reshape(-1, 3)
    rim = np.concatenate([np.stack([q[[1, 2]], q[[2, 3]]]) for q in quads])
    return {
        name: Mesh(quads.reshape(-1, 3), faces, "highlight", opacity=0.6, flat=True),
        f"{name} rim": Segments(rim, "highlight", 3),
    }


def pushes(mesh: Measured, scale: float) -> dict[str, Primitive]:
    """Return what each neighbour adds to the mean-curvature normal of the vertex, and their sum."""
    start = _lifted(mesh)
    total = mesh.normals_2H[mesh.vertex]
    scene: dict[str, Primitive] = {}
    if np.isfinite(total).all():
        parts = scale * vertex_pushes(
            mesh.p[mesh.vertex], mesh.p[mesh.ring], mesh.areas[mesh.vertex]
        )
        scene["pushes"] = Segments(
            between(np.broadcast_to(start, parts.shape), start + parts),
            "other",
            5,
            name="what each neighbour pushes: cotangents × edge",
        )
        tip = start + scale * total
        scene["mean normal"] = Segments(
            between(start, tip), "highlight", 6, name="their sum: 2 H n"
        )
        scene["mean label"] = Label(
            f"|2 H n| = {brief(float(np.linalg.norm(total)))} m⁻¹",
            start + 1.25 * (tip - start),
            "highlight",
        )
    return scene


def circles(mesh: Measured) -> dict[str, Primitive]:
    """Return the two osculating circles at the vertex: radius 1/|k|, on the side to which the
    surface bends.
    """
    scene: dict[str, Primitive] = {}
    here, n = mesh.p[mesh.vertex], mesh.normals[mesh.vertex]
    both: tuple[tuple[str, Role, np.ndarray, np.ndarray], ...] = (
        ("k₁", "source", mesh.k1, mesh.along_k1),
        ("k₂", "other", mesh.k2, mesh.along_k2),
    )
    for name, role, k, along in both:
        k = float(k[mesh.vertex])
        t = along[mesh.vertex]
        if not np.isfinite(k):
            continue
        # An arc of at most a full turn and at most 2.5 m: nearly straight where k is nearly 0.
        s = np.minimum(np.pi, 1.25 * abs(k)) * (CIRCLE / np.pi - 1)
        if abs(k) > 1e-6:
            path = here + np.sin(s)[:, None] / k * t - (1 - np.cos(s))[:, None] / k * n
        else:
            path = here + 1.25 * (CIRCLE / np.pi - 1)[:, None] * t
        radius = f"radius {brief(1 / abs(k))} m" if abs(k) > 1e-3 else "straight"
        scene[f"circle {name}"] = Segments(segments(path), role, 4)
        seen = abs(k) * FARTHEST > 1.0
        words = f"{name} = {brief(k)} m⁻¹, {radius}"
        scene[f"label {name}"] = Label(words, path[3 * len(path) // 4], role)  # on its own arc
        if seen:
            centre = here - n / k
            scene[f"centre {name}"] = Points(centre[None], role, 0.025 / abs(k) ** 0.5)
            scene[f"radius {name}"] = Segments(between(here, centre), role, 2)
    return scene


def patch(state: State) -> dict[str, Primitive]:
    """Return the quadric at the vertex over its two rings, and the vertices it was fitted to."""
    mesh = state.now
    quadrics = sure(state.now.quadrics)
    near = state.two_rings
    scene: dict[str, Primitive] = {
        "fitted": Points(
            mesh.p[near] + 0.1 * edge_length(mesh) * mesh.normals[near],
            "truth",
            0.12 * edge_length(mesh),
            name="vertices of the fit",
        )
    }
    c = quadrics.coefficients[mesh.vertex]
    if np.isfinite(c).all():
        right, up, n = (
            axis[mesh.vertex] for axis in (quadrics.right, quadrics.up, quadrics.normals)
        )
        reach = 0.8 * np.linalg.norm(mesh.p[near] - mesh.p[mesh.vertex], axis=1).max()
        r, t = (
            g.ravel()[:, None]
            for g in np.meshgrid(reach * np.arange(9) / 8, CIRCLE[::4], indexing="ij")
        )
        x, y = r * np.cos(t), r * np.sin(t)
        z = c[0] + c[1] * x + c[2] * y + c[3] * x**2 + c[4] * x * y + c[5] * y**2
        i, j = (g.ravel() for g in np.meshgrid(np.arange(8), np.arange(24), indexing="ij"))
        a = 25 * i + j
        b = 25 * (i + 1) + j
        faces = np.concatenate([np.stack([a, b, b + 1], 1), np.stack([a, b + 1, a + 1], 1)])
        p = mesh.p[mesh.vertex] + x * right + y * up + z * n
        scene["patch"] = Mesh(p, faces, "highlight", opacity=0.7, name="quadric")
    return scene


def _lifted(mesh: Measured, edges: float = LIFT) -> np.ndarray:
    return mesh.p[mesh.vertex] + edges * edge_length(mesh) * mesh.normals[mesh.vertex]
