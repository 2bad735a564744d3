"""The mesh of a run, built-in or the person's own: made, or read and stood up."""

import functools
from pathlib import Path
from typing import Any

import numpy as np

from lessons.curvature.state import MOST_OWN, Params, Subject
from workbench.data.files import stamp
from workbench.data.framing import Upward, box, broad_side_to, extent, upward
from workbench.data.own_meshes import read_surface
from workbench.data.shapes.surfaces import SURFACES, Surface, inside_out, scaled, with_noise
from workbench.geometry.meshes import edges, on_boundary, vertex_normals
from workbench.knobs import only

EYE = np.array([2.5, -2.9, 2.3])
UPWARD = np.array([0.46, -0.53, 0.71])
# metres: how long the longest side of an own mesh is made, so that scales and colours fit it
OWN_SIZE = 2.0


def subject_of(params: Params) -> Subject:
    """Return the mesh that the params describe, the same arrays whatever vertex is looked at.

    Raises:
        InputError: If an own mesh cannot be used.
    """
    if params.mesh is None:
        return _built_in(shape_of(params))
    how = {"size": params.size, "turned": params.inside_out, "up": params.up}
    return _own(params.mesh, stamp(params.mesh), **how)


def shape_of(params: Params) -> Params:
    """Return the params with nothing but what makes a built-in surface; its seed is 0 where nothing
    strays.
    """
    chance = ("seed",) if params.jitter or params.noise else ()
    return only(params, "surface", "vertices", "jitter", "noise", "size", "inside_out", *chance)


@functools.lru_cache(maxsize=16)
def _built_in(shape: Params) -> Subject:
    surface = surface_of(shape)
    return _subject(
        surface.p,
        surface.faces,
        turned=shape.inside_out,
        name=f"the {shape.surface}",
        truth=surface,
    )


def surface_of(shape: Params) -> Surface:
    """Return a built-in surface; noise is in metres whatever the size."""
    rng = np.random.default_rng(shape.seed)
    surface = scaled(
        SURFACES[shape.surface](shape.vertices, jitter=shape.jitter, rng=rng), shape.size
    )
    surface = with_noise(surface, shape.noise, rng) if shape.noise else surface
    return inside_out(surface) if shape.inside_out else surface


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


@functools.lru_cache(maxsize=4)
def _own(path: Path, _stamp: tuple[int, int], *, size: float, turned: bool, up: Upward) -> Subject:
    """Read a mesh, mend what can be mended, stand it up, make it OWN_SIZE long about the origin;
    anew when it changed.
    """
    p_file, faces, mended = read_surface(path, MOST_OWN)
    axis = upward(p_file, path, up)
    enlarged = size * OWN_SIZE / extent(p_file)
    p = p_file @ broad_side_to(p_file, EYE, axis).T
    low, high = box(p)
    p, faces = enlarged * (p - (low + high) / 2), faces[:, ::-1] if turned else faces
    known = {"truth": None, "enlarged": enlarged, "up": axis, "mended": mended}
    return _subject(p, faces, turned=turned, name=path.name, **known)
