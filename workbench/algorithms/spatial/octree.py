"""An octree of a solid: only cells that the surface may cross are cut in eight. Lengths in metres.

Reference: Meagher, Geometric modeling using octree encoding, Computer Graphics and Image Processing
19, 1982.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float, Int

from workbench.geometry.fields.voxels import Grid
from workbench.tracing import traced

POINTER_BYTES = 72  # a node with eight pointers of 8 bytes, and 8 bytes more


@dataclass(frozen=True, eq=False, kw_only=True)
class Level:
    """The cells of one level; level 0 is the whole cube.

    Attributes:
        grid: All cells of that size, whether the tree has them or not.
        cells: Column, row and layer of the cells that the tree has at this level.
        mixed: Which of them the surface may cross: it is nearer to their middle than their corners.
        bits: The solid as cells of this size, mixed cells by their middle.
        parents: How many cells were cut in eight so far, above this level.
    """

    depth: int
    grid: Grid
    cells: Int[np.ndarray, "n 3"]
    mixed: Bool[np.ndarray, " n"]
    bits: Bool[np.ndarray, "x y z"]
    parents: int

    @property
    def packed_bytes(self) -> int:
        """The tree with two bits for each child of a cell that was cut: empty, full, mixed."""
        return max(1, 2 * self.parents)

    @property
    def pointer_bytes(self) -> int:
        """The tree with a pointer to each child."""
        return POINTER_BYTES * max(1, self.parents)

    @property
    def dense_bytes(self) -> int:
        """All cells of this size with one bit each."""
        return max(1, self.bits.size // 8)


@traced
def grow_octree(
    distance: Callable[[np.ndarray], np.ndarray],
    low: Float[np.ndarray, "3"],
    edge: float,
    *,
    depth: int,
) -> Iterator[Level]:
    """Yield the levels of an octree, from the whole cube down.

    `distance` is the signed distance of points (n, 3) to the surface; `low` and `edge` are the
    cube's.
    """
    cells = np.zeros((1, 3), dtype=np.intp)
    parents = 0
    children = np.stack(np.meshgrid([0, 1], [0, 1], [0, 1], indexing="ij"), axis=-1).reshape(8, 3)
    bits = np.zeros((1, 1, 1), dtype=bool)
    for level in range(depth + 1):
        n = 2**level
        h = edge / n
        away = distance(low + h * (cells + 0.5))
        mixed = np.abs(away) <= h * np.sqrt(3) / 2
        bits = bits.repeat(2, axis=0).repeat(2, axis=1).repeat(2, axis=2) if level else bits.copy()
        bits[tuple(cells.T)] = away < 0
        yield Level(
            depth=level,
            grid=Grid(low, np.full(3, h), (n, n, n)),
            cells=cells,
            mixed=mixed,
            bits=bits,
            parents=parents,
        )
        parents += int(mixed.sum())
        cells = (2 * cells[mixed][:, None] + children).reshape(-1, 3)
