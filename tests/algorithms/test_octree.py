"""The octree: its cells cover the surface, its bits are those of a dense grid, and its bytes grow
with the surface.
"""

import numpy as np
import pytest

from workbench.algorithms.spatial.octree import POINTER_BYTES, grow_octree
from workbench.geometry.fields.signed_distances import box_sdf, torus_sdf
from workbench.geometry.fields.voxels import Grid

LOW = np.full(3, -1.0)


def torus(q: np.ndarray) -> np.ndarray:
    return torus_sdf(q, 0.6, 0.25)


def levels(depth: int = 6):
    return list(grow_octree(torus, LOW, 2.0, depth=depth))


def test_bits_are_those_of_all_cells():
    for level in levels(5):
        grid = Grid(LOW, level.grid.spacing, level.grid.shape)
        np.testing.assert_array_equal(level.bits, (torus(grid.centres()) < 0).reshape(grid.shape))


def test_no_cell_that_the_surface_crosses_is_left_out():
    box = lambda q: box_sdf(q, np.array([0.52, 0.33, 0.21]))  # noqa: E731
    *_, last = grow_octree(box, LOW, 2.0, depth=4)
    corners = np.stack(np.meshgrid(*[np.linspace(-1, 1, 17)] * 3, indexing="ij"), axis=-1)
    inside = (box(corners.reshape(-1, 3)) < 0).reshape(17, 17, 17)
    cells = np.stack(
        [inside[i : 16 + i, j : 16 + j, k : 16 + k] for i in (0, 1) for j in (0, 1) for k in (0, 1)]
    )
    crossed = cells.any(axis=0) & ~cells.all(axis=0)
    mixed = np.zeros_like(crossed)
    mixed[tuple(last.cells[last.mixed].T)] = True
    assert not (crossed & ~mixed).any()


def test_the_surface_takes_four_times_the_cells_at_each_level():
    tree = levels(7)
    mixed = np.array([int(level.mixed.sum()) for level in tree])
    assert mixed[5:].tolist() == [2688, 10_744, 42_552]
    np.testing.assert_allclose(mixed[5:] / mixed[4:-1], 4, rtol=0.02)
    assert len(tree[5].cells) == 8 * mixed[4] == 5376


def test_bytes():
    tree = levels(7)
    assert [level.packed_bytes for level in tree[3:]] == [82, 402, 1746, 7122, 28_610]
    assert [level.dense_bytes for level in tree[3:]] == [64, 512, 4096, 32_768, 262_144]
    assert (
        tree[5].pointer_bytes
        == POINTER_BYTES * 873
        == pytest.approx(15 * tree[5].dense_bytes, rel=0.03)
    )


def test_nothing_near_is_a_tree_of_one_cell():
    *_, last = grow_octree(lambda q: np.full(len(q), 9.0), LOW, 2.0, depth=3)
    assert (len(last.cells), last.parents, bool(last.bits.any())) == (0, 0, False)
