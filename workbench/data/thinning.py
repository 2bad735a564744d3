"""Fewer rows: one per voxel, some by chance, or evenly spaced; and how far apart points are."""

import numpy as np
from jaxtyping import Float

from workbench.geometry.meshes import distinct_rows
from workbench.geometry.points.nearest import tree_of


def voxel_means(p: Float[np.ndarray, "n 3"], size: float) -> Float[np.ndarray, "m 3"]:
    """Return the mean of the points in each occupied cube of a grid, in the order of the cubes.

    The grid begins at the smallest coordinates; its `size` is in the points' unit.

    Raises:
        ValueError: If the size is not positive.
    """
    if not size > 0:
        raise ValueError(f"a voxel has a positive size, not {size}")
    columns = np.ascontiguousarray(p.T)  # long rows: sums over short ones are slow
    # stay floats: a far stray point would overflow whole numbers
    voxels = np.floor((columns - columns.min(axis=1, keepdims=True)) / size)
    nx, ny, nz = voxels.max(axis=1) + 1
    if nx * ny * nz < 2**53:  # each has a number of its own, in the same order
        voxels = ((voxels[0] * ny + voxels[1]) * nz + voxels[2])[None]
    order = np.lexsort(voxels[::-1])
    starts = np.flatnonzero(np.r_[True, (np.diff(voxels[:, order], axis=1) != 0).any(axis=0)])
    columns = columns.take(order, axis=1)
    # means about a point of the voxel keep their digits far from the origin
    origin = columns.take(starts, axis=1)
    counts = np.diff(np.r_[starts, len(p)])
    offsets = columns - np.repeat(origin, counts, axis=1)
    return np.ascontiguousarray((origin + np.add.reduceat(offsets, starts, axis=1) / counts).T)


def some_points(
    p: Float[np.ndarray, "n d"], most: int, rng: np.random.Generator
) -> Float[np.ndarray, "m d"]:
    """Return so many points drawn by chance, in their order; all, without a draw, if not more."""
    return p if len(p) <= most else p[np.sort(rng.choice(len(p), most, replace=False))]


def every(count: int, most: int) -> slice:
    """Return the slice of every so many rows, from the first, that takes `most` at most."""
    return slice(None, None, max(1, -(-count // most)))


def evenly(count: int, most: int) -> np.ndarray:
    """Return at most `most` of `count` indices, evenly spaced, first and last included."""
    return np.unique(np.linspace(0, count - 1, min(most, count)).round().astype(int))


def spacing(p: Float[np.ndarray, "n 3"]) -> float:
    """Return the median distance to the nearest other place with a point; 1e-9 without one.

    A few hundred points tell it.
    """
    places = p[distinct_rows(p)[0]]
    some = places[:: max(1, len(places) // 400)]
    distances = np.asarray(tree_of(places).query(some, k=min(2, len(places)))[0])
    return float(np.median(distances.reshape(len(some), -1)[:, -1])) or 1e-9


def growing(most: int, per_power: int = 8) -> tuple[int, ...]:
    """Return ever larger counts: 10, so many for each power of ten, and `most`."""
    counts = np.rint(10 ** np.arange(1, np.log10(most) - 1e-9, 1 / per_power)).astype(int)
    return (*counts.tolist(), most)
