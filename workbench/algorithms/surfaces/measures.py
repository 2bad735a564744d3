"""Area and volume as sums over the faces of a mesh, or over the cells of ever finer grids.

Reference: Zhang and Chen, Efficient feature extraction for 2D/3D objects in mesh representation,
ICIP 2001.
"""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float, Int

from workbench.geometry.fields.voxels import Grid, counted_area, counted_volume, marched_surface
from workbench.geometry.meshes import face_areas
from workbench.geometry.meshes.measures import surface_area, tetrahedra
from workbench.tracing import traced

SignedVolume = Callable[[np.ndarray, np.ndarray], float]
"""signed_volume(p, faces) -> the sum of the signed tetrahedra to the origin of coordinates, m^3."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Sums:
    """The sums over the faces so far, metres.

    Attributes:
        order: All faces, in the order in which they are added.
        parts: The signed volume of the tetrahedron of each face.
        areas: The area of each face.
        count: How many faces were added.
        new: How many of them at this step.
        volume: The sum of their tetrahedra.
        area: The sum of their areas.
    """

    order: Int[np.ndarray, " f"]
    parts: Float[np.ndarray, " f"]
    areas: Float[np.ndarray, " f"]
    count: int = 0
    new: int = 0
    volume: float = 0.0
    area: float = 0.0


@traced
def sum_faces(
    p: Float[np.ndarray, "v 3"],
    faces: Int[np.ndarray, "f 3"],
    origin: Float[np.ndarray, "3"],
    *,
    signed_volume: SignedVolume,
    order: Int[np.ndarray, " f"],
    counts: Iterable[int],
) -> Iterator[Sums]:
    """Yield area and volume of the faces that were added so far: V = sum of a . (b x c) / 6.

    Args:
        faces: Counterclockwise seen from outside.
        origin: The common tip of the tetrahedra, m.
        signed_volume: Sums the tetrahedra of some faces.
        order: The faces, in the order in which they are added.
        counts: How many are added at each step, ever more.
    """
    parts = tetrahedra(p, faces, origin)
    areas = face_areas(p, faces)
    before = 0
    for count in counts:
        added = faces[order[:count]]
        volume = float(signed_volume(p - origin, added)) if count else 0.0
        area = float(areas[order[:count]].sum())
        yield Sums(
            order=order,
            parts=parts,
            areas=areas,
            count=count,
            new=count - before,
            volume=volume,
            area=area,
        )
        before = count


@dataclass(frozen=True, eq=False, kw_only=True)
class Cells:
    """A solid in the cells of one grid, and what the coarser grids before gave, metres.

    Attributes:
        bits: Which of the grid's cells are full.
        across: How many cells lay along the longest side, now and before.
        volumes: The volume of the full cells, now and before.
        areas: The area of the cell faces around them.
        marched: The area of marching cubes' surface through them; NaN where no cell is full.
    """

    grid: Grid
    bits: Bool[np.ndarray, "x y z"]
    across: tuple[int, ...] = ()
    volumes: tuple[float, ...] = ()
    areas: tuple[float, ...] = ()
    marched: tuple[float, ...] = ()


@traced
def count_cells(
    grids: Iterable[tuple[int, Grid]], full: Callable[[Grid], np.ndarray]
) -> Iterator[Cells]:
    """Yield a solid in ever finer cells; each grid comes with its cells along the longest side."""
    across, volumes, areas, marched = (), (), (), ()
    for n, grid in grids:
        bits = full(grid)
        across += (n,)
        volumes += (counted_volume(bits, grid.spacing),)
        areas += (counted_area(bits, grid.spacing),)
        marched += (surface_area(*marched_surface(bits, grid)) if bits.any() else float("nan"),)
        yield Cells(
            grid=grid, bits=bits, across=across, volumes=volumes, areas=areas, marched=marched
        )
