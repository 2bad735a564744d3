"""The mesh of a run, built-in or the person's own, with its true curvature where that is known."""

import functools
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

import numpy as np

from lessons.curvature.params import MOST_OWN, Params, Shape, Up
from workbench.data.files import read_mesh
from workbench.data.surfaces import SURFACES, Surface, inside_out, scaled, with_noise
from workbench.errors import InputError
from workbench.geometry.meshes import check_mesh, edges, on_boundary, vertex_normals, welded
from workbench.geometry.motions import exp_so3
from workbench.geometry.repair import oriented, split_where_sheets_touch, without_repeats

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
        up: Which axis of an own mesh's file points up here.
        mended: What had to be mended in an own mesh, in words.
    """

    name: str
    p: np.ndarray
    faces: np.ndarray
    truth: Surface | None
    edges: np.ndarray
    border: np.ndarray
    front: int
    enlarged: float = 1.0
    up: str = "z"
    mended: tuple[str, ...] = ()

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
        return _own(params.mesh, stamp, params.size, params.inside_out, params.up)
    name, *rest = shape_of(params)
    return _built_in(name, params.vertices, *rest)


def shape_of(params: Params) -> tuple[Shape, float, float, float, bool, int]:
    """Return what a built-in surface is made of beside the number of its vertices; its seed is 0 where nothing strays."""
    seed = params.seed if params.jitter or params.noise else 0
    return params.surface, params.jitter, params.noise, params.size, params.inside_out, seed


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
def _own(path: Path, _stamp: int, size: float, turned: bool, up: Up) -> Subject:
    """Read a mesh, mend what can be mended, stand it up, make it OWN_SIZE long about the origin; anew when it changed."""
    p, faces, mended = _mended(path)
    axis = up if up != "auto" else own_up(p, path.suffix.lower())
    enlarged = size * OWN_SIZE / float(np.ptp(p, axis=0).max())
    p = p @ facing_viewer(p, axis).T
    low, high = p.min(axis=0), p.max(axis=0)
    faces = faces[:, ::-1] if turned else faces
    p = enlarged * (p - (low + high) / 2)
    border = on_boundary(faces, len(p))
    front = front_of(p, vertex_normals(p, faces) * (-1 if turned else 1), border)
    return Subject(path.name, p, faces, None, edges(faces), border, front, enlarged, axis, mended)


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
        (repeats, f"{_count(repeats, 'face')} listed twice left out"),
        (turned, f"{_count(turned, 'face')} turned round to agree with the others"),
        (split, f"{_count(split, 'vertex', 'vertices')} added where sheets only touch, one for each sheet"),
    )
    return placed, faces, tuple(words for count, words in done if count)


def own_up(p: np.ndarray, kind: str) -> Literal["y", "z"]:
    """Return the axis of a file that is likely to point up.

    It is the one on which the mesh stands, its lowest point being near 0 or above while the other axis has the mesh on both
    sides; where neither or both are so, z in stl files (machines and printers), and y in all others (graphics).
    """
    low, size = p.min(axis=0), float(np.ptp(p, axis=0).max())
    stands = low > -0.05 * size
    if stands[1] != stands[2]:
        return "y" if stands[1] else "z"
    return "z" if kind == ".stl" else "y"


def facing_viewer(p: np.ndarray, up: str) -> np.ndarray:
    """Return R_world_file, 3x3: the axis `up` becomes +Z, and the broad side of the mesh turns to the viewer.

    Of the two broad sides it is the one that needs the smaller turn about the vertical.
    """
    axis = {"x": (0.0, -np.pi / 2, 0.0), "y": (np.pi / 2, 0.0, 0.0), "-y": (-np.pi / 2, 0.0, 0.0), "z": (0.0, 0.0, 0.0)}
    R_up = exp_so3(np.array(axis[up]))
    xy = (p @ R_up.T)[:, :2]
    _, _, directions = np.linalg.svd(xy - xy.mean(axis=0), full_matrices=False)
    thin, eye = directions[1], np.array(EYE[:2])
    thin = thin if thin @ eye >= 0 else -thin
    turn = np.arctan2(eye[1], eye[0]) - np.arctan2(thin[1], thin[0])
    return exp_so3(np.array([0.0, 0.0, turn])) @ R_up


def _count(n: int, word: str, words: str = "") -> str:
    return f"{n:,} {word if n == 1 else words or word + 's'}"
