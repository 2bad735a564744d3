"""What is measured: a built-in shape, spoilt or not, or a person's own mesh or voxels."""

import functools
from dataclasses import replace
from pathlib import Path

import numpy as np

from lessons.measures import measurables
from lessons.measures.measurables import Measurable
from lessons.measures.state import Params, Subject
from workbench.data.files import read_voxels, stamp
from workbench.data.framing import UPRIGHT, Unit, Upward, box, extent, upward
from workbench.data.own_meshes import read_welded
from workbench.data.shapes.rabbit import rabbit_mesh
from workbench.errors import InputError
from workbench.geometry.fields.voxels import (
    Grid,
    counted_volume,
    grid_over,
    marched_surface,
    occupied,
)
from workbench.geometry.meshes.containment import columns, windings
from workbench.geometry.meshes.measures import encloses, signed_volume, surface_area
from workbench.knobs import called

RABBIT, SPACING = 2.0, 0.04  # times as large as it is made, with edges of so many metres before
OWN_SIZE = 2.0  # metres of the picture that an own shape is long
MOST_OWN = 400_000  # faces
MOST_VOXELS = 40_000_000
FINE = 96  # voxels along the longest side of which the surface of own voxels is made
HOLE = np.array([-0.2, -1.0, 0.1])  # where faces are cut out: on the side that is seen


def subject_of(params: Params) -> Subject:
    """Return what the params describe.

    Raises:
        InputError: If an own file cannot be used, or the shape has no volume where one is asked
            for.
    """
    if params.mesh is not None and params.voxels is not None:
        raise InputError(
            f"{called('mesh')} and {called('voxels')} are both given: one of them is measured"
        )
    if params.voxels is not None:
        subject = _voxels(
            params.voxels,
            stamp(params.voxels),
            params.spacing,
            label=params.label,
            unit=params.unit,
        )
    elif params.mesh is not None:
        subject = _own(params.mesh, stamp(params.mesh), params.up, unit=params.unit)
    else:
        subject = built_in(params.shape, params.subdivisions, params.sectors, rings=params.rings)
    if params.method in ("voxels", "chance") and subject.inside is None:
        raise InputError(
            f"{subject.name} is open: it has an area and no volume, and no point is inside it"
        )
    if params.method == "voxels" and not subject.grids:
        return replace(subject, grids=_grids(subject, params))
    if params.method == "faces" and (params.hole or params.flipped):
        return replace(subject, faces=_spoilt(subject, params))
    return subject


def built_in(shape: str, subdivisions: int, sectors: int, *, rings: int) -> Subject:
    """Return a built-in shape."""
    if shape == "rabbit":
        return _rabbit()
    if shape == "lantern":
        return _smooth("the lantern", measurables.lantern(sectors, rings))
    if shape == "box":
        return _smooth("the box", measurables.box())
    make = {
        "sphere": measurables.sphere,
        "torus": measurables.torus,
        "two spheres": measurables.two_spheres,
    }[shape]
    name = "the pair of spheres" if shape == "two spheres" else f"the {shape}"
    return _smooth(name, make(subdivisions))


@functools.lru_cache(maxsize=32)
def _smooth(name: str, made: Measurable) -> Subject:
    inside = made.inside
    return Subject(
        name=name,
        p=made.p,
        faces=made.faces,
        whole=made.faces,
        low=made.low,
        high=made.high,
        smooth=True,
        area=made.area,
        volume=made.volume,
        inside=inside,
        full=None if inside is None else lambda grid: inside(grid.centres()).reshape(grid.shape),
    )


@functools.cache
def _rabbit() -> Subject:
    p, faces = rabbit_mesh(SPACING)
    return _of_mesh("the rabbit", RABBIT * (p - (p.min(axis=0) + p.max(axis=0)) / 2), faces)


def _of_mesh(
    name: str,
    p: np.ndarray,
    faces: np.ndarray,
    *,
    unit: str = "m",
    scale: float = 1.0,
    note: str = "",
):
    """Return a mesh that is measured against itself: all its faces, as they are."""
    closed = encloses(faces)
    mesh = columns(p, faces)
    return Subject(
        name=name,
        p=p,
        faces=faces,
        whole=faces,
        low=p.min(axis=0),
        high=p.max(axis=0),
        smooth=False,
        area=surface_area(p, faces),
        volume=signed_volume(p, faces) if closed else float("nan"),
        inside=(lambda q: windings(mesh, q) != 0) if closed else None,
        full=(lambda grid: occupied(p, faces, grid)) if closed else None,
        unit=unit,
        scale=scale,
        note=note,
    )


def _grids(subject: Subject, params: Params) -> tuple[tuple[int, Grid], ...]:
    """Return grids whose cells are halved every second step, each beginning at a place of its
    own.
    """
    rng = np.random.default_rng(params.seed)
    steps = np.arange(4, 2 * np.log2(params.cells) - 1e-9)
    across = [*np.unique(np.rint(2 ** (steps / 2)).astype(int)).tolist(), params.cells]
    return tuple((n, grid_over(subject.low, subject.high, n, shift=rng.random(3))) for n in across)


def _spoilt(subject: Subject, params: Params) -> np.ndarray:
    """Return the faces with a hole, and some of them turned round."""
    faces = subject.whole
    rng = np.random.default_rng(params.seed)
    turned = rng.random(len(faces)) < params.flipped
    faces = np.where(turned[:, None], faces[:, ::-1], faces)
    middles = subject.p[faces].mean(axis=1)
    center = middles[np.argmax(middles @ HOLE)]
    away = np.linalg.norm(middles - center, axis=1)
    return faces[np.sort(np.argsort(away, kind="stable")[round(params.hole * len(faces)) :])]


@functools.lru_cache(maxsize=4)
def _own(path: Path, _stamp: tuple[int, int], up: Upward, *, unit: Unit) -> Subject:
    p, faces = read_welded(path, MOST_OWN, "measured")
    axis = upward(p, path, up)
    low, high = box(p)
    p = (p - (low + high) / 2) @ UPRIGHT[axis].T
    note = (
        ""
        if encloses(faces)
        else " It is open or its faces disagree which side is outside: no volume is its own."
    )
    return _of_mesh(path.name, p, faces, unit=unit, scale=OWN_SIZE / extent(p), note=note)


@functools.lru_cache(maxsize=2)
def _voxels(
    path: Path,
    _stamp: tuple[int, int],
    spacing: tuple[float, float, float],
    *,
    label: int,
    unit: Unit,
) -> Subject:
    """Return labelled voxels: their surface for what needs one, the bits themselves for
    counting.
    """
    labels = read_voxels(path)
    bits = labels == label if label else labels != 0
    if not bits.any():
        known = ", ".join(str(name) for name in np.unique(labels[labels != 0])[:12]) or "none but 0"
        raise InputError(f"{path.name}: no voxel has the label {label}; there are {known}")
    bits = bits[np.ix_(*(_used(bits.any(axis=tuple({0, 1, 2} - {axis}))) for axis in range(3)))]
    if bits.size > MOST_VOXELS:
        raise InputError(
            f"{path.name}: {bits.size:,} voxels around the label; at most {MOST_VOXELS:,} are"
            " measured"
        )
    edges = np.array(spacing)
    low = -edges * np.array(bits.shape) / 2
    finest = max(1, -(-max(bits.shape) // FINE))
    p, faces = marched_surface(*_every(bits, low, edges, n=finest))
    grids = tuple(
        _every(bits, low, edges, n=every)[1] for every in (8, 4, 2, 1) if min(bits.shape) >= every
    )

    def full(grid: Grid) -> np.ndarray:
        return _every(bits, low, edges, n=round(float(grid.spacing[0] / edges[0])))[0]

    subject = _of_mesh(
        path.name, p, faces, unit=unit, scale=OWN_SIZE / float((edges * bits.shape).max())
    )
    every = "" if finest == 1 else f" Its picture is made of one voxel in {finest} along each axis."
    return replace(
        subject,
        smooth=True,
        area=(
            surface_area(*marched_surface(*_every(bits, low, edges, n=1)))
            if finest > 1
            else subject.area
        ),
        volume=counted_volume(bits, edges),
        full=full,
        grids=tuple((max(grid.shape), grid) for grid in grids),
        note=f" Its volume is that of {np.count_nonzero(bits):,} voxels.{every}",
    )


def _used(any_full: np.ndarray) -> np.ndarray:
    indices = np.flatnonzero(any_full)
    return np.arange(indices[0], indices[-1] + 1)


def _every(
    bits: np.ndarray, low: np.ndarray, edges: np.ndarray, *, n: int
) -> tuple[np.ndarray, Grid]:
    """Return every n-th voxel along each axis, each standing for n x n x n."""
    some = bits[n // 2 :: n, n // 2 :: n, n // 2 :: n]
    return some, Grid(low, n * edges, some.shape)
