"""The mesh of a run, built-in or the person's own: made, or read and stood up."""

from typing import Any

import numpy as np

from lessons.curvature.inputs import MOST_OWN, Input
from lessons.curvature.state import Subject
from workbench.data.framing import box, broad_side_to, extent, upward
from workbench.data.own_meshes import read_surface
from workbench.data.shapes.surfaces import SURFACES, Surface, inside_out, scaled, with_noise
from workbench.geometry.meshes import edges, on_boundary, vertex_normals
from workbench.lesson import cached

EYE = np.array([2.5, -2.9, 2.3])
UPWARD = np.array([0.46, -0.53, 0.71])
# metres: how long the longest side of an own mesh is made, so that scales and colours fit it
OWN_SIZE = 2.0


@cached
def subject_of(params: Input) -> Subject:
    """Return the mesh that the params describe, the same arrays whatever vertex is looked at.

    Raises:
        InputError: If an own mesh cannot be used.
    """
    return _built_in(params) if params.mesh is None else _own(params)


def _built_in(params: Input) -> Subject:
    surface = surface_of(params, params.vertices)
    return _subject(
        surface.p,
        surface.faces,
        turned=params.inside_out,
        name=f"the {params.surface}",
        truth=surface,
    )


def surface_of(params: Input, count: int) -> Surface:
    """Return a built-in surface of about so many vertices; noise is in metres whatever the size."""
    strays = params.jitter or params.noise
    rng = np.random.default_rng(params.seed if strays else 0)
    made = SURFACES[params.surface](count, jitter=params.jitter, rng=rng)
    surface = scaled(made, params.size)
    surface = with_noise(surface, params.noise, rng) if params.noise else surface
    return inside_out(surface) if params.inside_out else surface


def _subject(p: np.ndarray, faces: np.ndarray, *, turned: bool, **known: Any) -> Subject:
    """Look at a mesh from where it is seen first, whichever side is called outside."""
    border = on_boundary(faces, len(p))
    front = front_of(p, vertex_normals(p, faces) * (-1 if turned else 1), border)
    return Subject(p=p, faces=faces, edges=edges(faces), border=border, front=front, **known)


def front_of(p: np.ndarray, normals: np.ndarray, border: np.ndarray) -> int:
    """Return a vertex in front whose normal points up more than the eye, so that it and the circles
    are seen well.

    It lies inside the border where any vertex does.
    """
    size = max(1.0, float(np.abs(p).max()))
    distance = np.linalg.norm(EYE * size - p, axis=1) / size
    aside = np.abs(p @ np.array([-EYE[1], EYE[0], 0.0])) / np.hypot(*EYE[:2]) / size
    return int(np.argmax(normals @ UPWARD - 0.2 * distance - 0.4 * aside - 1e3 * border))


def _own(params: Input) -> Subject:
    """Read a mesh, mend what can be mended, stand it up, make it OWN_SIZE long about the origin."""
    path = params.mesh
    assert path is not None
    p_file, faces, mended = read_surface(path, MOST_OWN)
    axis = upward(p_file, path, params.up)
    enlarged = params.size * OWN_SIZE / extent(p_file)
    p = p_file @ broad_side_to(p_file, EYE, axis).T
    low, high = box(p)
    p = enlarged * (p - (low + high) / 2)
    faces = faces[:, ::-1] if params.inside_out else faces
    known = {"truth": None, "enlarged": enlarged, "up": axis, "mended": mended}
    return _subject(p, faces, turned=params.inside_out, name=path.name, **known)
