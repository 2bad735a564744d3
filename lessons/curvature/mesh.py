"""The mesh of a run, built-in or the person's own: made, or read, mended and stood up."""

import functools
from pathlib import Path
from typing import Any

import numpy as np

from lessons.curvature.state import MOST_OWN, Params, Subject, Upward
from workbench.data.files import read_mesh, stamp
from workbench.data.framing import UPRIGHT, Up, box, extent, likely_up
from workbench.data.surfaces import SURFACES, Surface, inside_out, scaled, with_noise
from workbench.errors import InputError
from workbench.geometry.meshes import check_mesh, edges, on_boundary, vertex_normals, welded
from workbench.geometry.motions import exp_so3
from workbench.geometry.repair import oriented, split_where_sheets_touch, without_repeats
from workbench.knobs import only
from workbench.numerals import counted

EYE = (2.5, -2.9, 2.3)
UPWARD = np.array([0.46, -0.53, 0.71])
OWN_SIZE = 2.0  # metres: how long the longest side of an own mesh is made, so that scales and colours fit it


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
    """Return the params with nothing but what makes a built-in surface; its seed is 0 where nothing strays."""
    chance = ("seed",) if params.jitter or params.noise else ()
    return only(params, "surface", "vertices", "jitter", "noise", "size", "inside_out", *chance)


@functools.lru_cache(maxsize=16)
def _built_in(shape: Params) -> Subject:
    surface = surface_of(shape)
    return _subject(surface.p, surface.faces, turned=shape.inside_out, name=f"the {shape.surface}", truth=surface)


def surface_of(shape: Params) -> Surface:
    """Return a built-in surface; noise is in metres whatever the size."""
    rng = np.random.default_rng(shape.seed)
    surface = scaled(SURFACES[shape.surface](shape.vertices, jitter=shape.jitter, rng=rng), shape.size)
    surface = with_noise(surface, shape.noise, rng) if shape.noise else surface
    return inside_out(surface) if shape.inside_out else surface


def _subject(p: np.ndarray, faces: np.ndarray, *, turned: bool, **known: Any) -> Subject:
    """Look at a mesh from where it is seen first, whichever side is called outside."""
    border = on_boundary(faces, len(p))
    front = front_of(p, vertex_normals(p, faces) * (-1 if turned else 1), border)
    return Subject(p=p, faces=faces, edges=edges(faces), border=border, front=front, **known)


def front_of(p: np.ndarray, normals: np.ndarray, border: np.ndarray) -> int:
    """Return a vertex in front whose normal points up more than the eye, so that it and the circles are seen well.

    It lies inside the border where any vertex does.
    """
    size = max(1.0, float(np.abs(p).max()))
    distance = np.linalg.norm(np.array(EYE) * size - p, axis=1) / size
    aside = np.abs(p @ np.array([-EYE[1], EYE[0], 0.0])) / np.hypot(*EYE[:2]) / size
    return int(np.argmax(normals @ UPWARD - 0.2 * distance - 0.4 * aside - 1e3 * border))


@functools.lru_cache(maxsize=4)
def _own(path: Path, _stamp: tuple[int, int], *, size: float, turned: bool, up: Upward) -> Subject:
    """Read a mesh, mend what can be mended, stand it up, make it OWN_SIZE long about the origin; anew when it changed."""
    p_file, faces, mended = _mended(path)
    axis = likely_up(p_file, path.suffix.lower()) if up == "auto" else up
    enlarged = size * OWN_SIZE / extent(p_file)
    p = p_file @ facing_viewer(p_file, axis).T
    low, high = box(p)
    p, faces = enlarged * (p - (low + high) / 2), faces[:, ::-1] if turned else faces
    known = {"truth": None, "enlarged": enlarged, "up": axis, "mended": mended}
    return _subject(p, faces, turned=turned, name=path.name, **known)


def _mended(path: Path) -> tuple[np.ndarray, np.ndarray, tuple[str, ...]]:
    """Read a mesh and mend it where its surface stays as it is; return also what was done, in words.

    Raises:
        InputError: If it is too large, or is no surface whose curvature could be told.
    """
    p, faces = read_mesh(path)
    if len(faces) > 2 * MOST_OWN:
        raise InputError(f"{path.name}: {len(faces):,} faces; at most {2 * MOST_OWN:,} are measured, simplify it first")
    p, welded_faces = welded(p, faces)
    once = without_repeats(welded_faces)
    agreeing = oriented(once)
    placed, faces = split_where_sheets_touch(p, agreeing)
    if len(placed) > MOST_OWN:
        raise InputError(f"{path.name}: {len(placed):,} vertices; at most {MOST_OWN:,} are measured, simplify it first")
    try:
        check_mesh(placed, faces)
    except InputError as error:
        raise InputError(f"{path.name}: {error}") from None
    repeats, turned = len(welded_faces) - len(once), int((agreeing != once).any(axis=1).sum())
    split = len(placed) - len(p)
    done = (
        (repeats, f"{counted(repeats, 'face')} listed twice left out"),
        (turned, f"{counted(turned, 'face')} turned round to agree with the others"),
        (split, f"{counted(split, 'vertex', 'vertices')} added where sheets only touch, one for each sheet"),
    )
    return placed, faces, tuple(words for count, words in done if count)


def facing_viewer(p: np.ndarray, up: Up) -> np.ndarray:
    """Return R_world_file, 3x3: the axis `up` becomes +Z, and the broad side of the mesh turns to the viewer.

    Of the two broad sides it is the one that needs the smaller turn about the vertical.
    """
    R_up = UPRIGHT[up]
    xy = (p @ R_up.T)[:, :2]
    _, _, directions = np.linalg.svd(xy - xy.mean(axis=0), full_matrices=False)
    thin, eye = directions[1], np.array(EYE[:2])
    thin = thin if thin @ eye >= 0 else -thin
    turn = np.arctan2(eye[1], eye[0]) - np.arctan2(thin[1], thin[0])
    return exp_so3(np.array([0.0, 0.0, turn])) @ R_up
