"""The mesh of a run, built-in or the person's own, with its true curvature where that is known."""

import functools
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from lessons.curvature.params import MOST_OWN, Params
from workbench.data.files import read_mesh
from workbench.data.surfaces import SURFACES, Surface, inside_out, scaled, with_noise
from workbench.errors import InputError
from workbench.geometry.meshes import check_mesh, edges, on_boundary, vertex_normals, welded

EYE = (2.5, -2.9, 2.3)
UPWARD = np.array([0.46, -0.53, 0.71])
OWN_SIZE = 2.0  # metres: how long the longest side of an own mesh is made, so that scales and colours fit it


@dataclass(frozen=True, eq=False)
class Subject:
    """A mesh to measure.

    Attributes:
        name: What it is called in sentences.
        p: Vertices, metres.
        faces: Triangles, counterclockwise seen from outside.
        truth: The surface from which it was made, with its analytic curvature; None for an own mesh.
        edges: Every edge once.
        border: Which vertices lie on its border.
        front: The vertex inside the border that faces the viewer best.
        enlarged: How many times larger than in its file an own mesh is.
    """

    name: str
    p: np.ndarray
    faces: np.ndarray
    truth: Surface | None
    edges: np.ndarray
    border: np.ndarray
    front: int
    enlarged: float = 1.0

    @property
    def inside(self) -> np.ndarray:
        """Which vertices do not lie on the border."""
        return ~self.border


def subject_of(params: Params) -> Subject:
    """Return the mesh that the params describe, the same arrays whatever vertex is looked at.

    Raises:
        InputError: If an own mesh cannot be used.
    """
    if params.mesh is not None:
        stamp = params.mesh.stat().st_mtime_ns if params.mesh.is_file() else 0
        return _own(params.mesh, stamp, params.size, params.inside_out)
    shape = params.surface, params.vertices, params.jitter, params.noise, params.size, params.inside_out, params.seed
    return _built_in(*shape)


@functools.lru_cache(maxsize=16)
def _built_in(*shape) -> Subject:
    surface = surface_of(*shape)
    p, faces = surface.p, surface.faces
    border = on_boundary(faces, len(p))
    # Seen from where the mesh is seen first, whichever side is called outside.
    front = front_of(p, vertex_normals(p, faces) * (-1 if shape[-2] else 1), border)
    return Subject(f"the {shape[0]}", p, faces, surface, edges(faces), border, front)


def front_of(p: np.ndarray, normals: np.ndarray, border: np.ndarray) -> int:
    """Return a vertex in front whose normal points up more than the eye, so that it and the circles are seen well.

    It lies inside the border where any vertex does.
    """
    size = max(1.0, float(np.abs(p).max()))
    distance = np.linalg.norm(np.array(EYE) * size - p, axis=1) / size
    aside = np.abs(p @ np.array([-EYE[1], EYE[0], 0.0])) / np.hypot(*EYE[:2]) / size
    return int(np.argmax(normals @ UPWARD - 0.2 * distance - 0.4 * aside - 1e3 * border))


def surface_of(name: str, vertices: int, jitter: float, noise: float, size: float, turned: bool, seed: int) -> Surface:
    """Return a built-in surface; noise is in metres whatever the size."""
    rng = np.random.default_rng(seed)
    surface = scaled(SURFACES[name](vertices, jitter=jitter, rng=rng), size)
    surface = with_noise(surface, noise, rng) if noise else surface
    return inside_out(surface) if turned else surface


@functools.lru_cache(maxsize=4)
def _own(path: Path, _stamp: int, size: float, turned: bool) -> Subject:
    """Read a mesh, make it OWN_SIZE long and put its middle at the origin; anew when the file has changed."""
    p, faces = read_mesh(path)
    if len(faces) > 2 * MOST_OWN:
        raise InputError(f"{path.name}: {len(faces):,} faces; at most {2 * MOST_OWN:,} are measured, simplify it first")
    p, faces = welded(p, faces)
    if len(p) > MOST_OWN:
        raise InputError(f"{path.name}: {len(p):,} vertices; at most {MOST_OWN:,} are measured, simplify it first")
    try:
        check_mesh(p, faces)
    except InputError as error:
        raise InputError(f"{path.name}: {error}") from None
    low, high = p.min(axis=0), p.max(axis=0)
    enlarged = size * OWN_SIZE / float((high - low).max())
    faces = faces[:, ::-1] if turned else faces
    p = enlarged * (p - (low + high) / 2)
    border = on_boundary(faces, len(p))
    front = front_of(p, vertex_normals(p, faces) * (-1 if turned else 1), border)
    return Subject(path.name, p, faces, None, edges(faces), border, front, enlarged)
