"""Voxels: occupancy by columns and by points agree, counts and surfaces measure the same, areas do
not converge.
"""

import numpy as np
import pytest

from lessons.measures.measurables import sphere, two_spheres
from workbench.data.shapes.rabbit import rabbit_mesh
from workbench.geometry.fields.voxels import (
    Grid,
    counted_area,
    counted_surface,
    counted_volume,
    grid_over,
    marched_surface,
    occupied,
    windings_on,
)
from workbench.geometry.meshes import euler_characteristic
from workbench.geometry.meshes.containment import inside
from workbench.geometry.meshes.measures import encloses, signed_volume, surface_area


def grid_around(p: np.ndarray, cells: int, seed: int = 0) -> Grid:
    return grid_over(
        p.min(axis=0), p.max(axis=0), cells, shift=np.random.default_rng(seed).random(3)
    )


def test_columns_fill_the_cells_whose_middles_are_inside():
    p, faces = rabbit_mesh(0.05)
    grid = grid_around(p, 20)
    by_points = inside(p, faces, grid.centres()).reshape(grid.shape)
    np.testing.assert_array_equal(occupied(p, faces, grid), by_points)
    assert by_points.sum() > 500


def test_a_grid_smaller_than_the_mesh_knows_its_own_cells():
    p, faces = rabbit_mesh(0.05)
    grid = Grid(np.array([-0.1, -0.1, -0.1]), np.full(3, 0.05), (5, 6, 7))
    np.testing.assert_array_equal(
        occupied(p, faces, grid), inside(p, faces, grid.centres()).reshape(grid.shape)
    )


def test_where_solids_overlap_the_winding_is_two():
    two = two_spheres(2)
    grid = grid_around(two.p, 16)
    assert set(np.unique(windings_on(two.p, two.faces, grid)).tolist()) == {0, 1, 2}


def test_counts_are_those_of_the_surface_around_the_cells():
    rng = np.random.default_rng(3)
    bits = rng.random((5, 6, 4)) < 0.4
    spacing = np.array([1.0, 0.5, 2.0])
    grid = Grid(np.array([3.0, -1.0, 0.0]), spacing, bits.shape)
    p, faces = counted_surface(bits, grid)
    assert encloses(faces)
    assert signed_volume(p, faces) == pytest.approx(counted_volume(bits, spacing))
    assert surface_area(p, faces) == pytest.approx(counted_area(bits, spacing))


def test_one_cell():
    bits = np.ones((1, 1, 1), bool)
    spacing = np.array([1.0, 2.0, 3.0])
    assert counted_volume(bits, spacing) == 6
    assert counted_area(bits, spacing) == 2 * (2 + 3 + 6)
    p, faces = counted_surface(bits, Grid(np.zeros(3), spacing, (1, 1, 1)))
    np.testing.assert_array_equal([p.min(axis=0), p.max(axis=0)], [[0, 0, 0], [1, 2, 3]])
    p, faces = marched_surface(bits, Grid(np.zeros(3), spacing, (1, 1, 1)))
    # an octahedron with half-axes of half a spacing
    assert signed_volume(p, faces) == pytest.approx(1.0)


def test_no_cell_at_all():
    bits = np.zeros((2, 2, 2), bool)
    grid = Grid(np.zeros(3), np.ones(3), (2, 2, 2))
    assert counted_volume(bits, grid.spacing) == counted_area(bits, grid.spacing) == 0
    assert len(counted_surface(bits, grid)[1]) == 0
    with pytest.raises(ValueError, match="no cell"):
        marched_surface(bits, grid)
    with pytest.raises(ValueError, match="cells"):
        grid_over(np.zeros(3), np.zeros(3), 8, shift=np.zeros(3))


def test_a_ball_the_volume_converges_and_no_area_of_bits_does():
    ball = sphere(4)
    for cells, within in ((16, 0.03), (64, 0.005)):
        bits = occupied(ball.p, ball.faces, grid := grid_around(ball.p, cells))
        assert counted_volume(bits, grid.spacing) == pytest.approx(
            signed_volume(ball.p, ball.faces), rel=within
        )
        assert counted_area(bits, grid.spacing) / ball.area == pytest.approx(1.5, abs=0.02)
        p, faces = marched_surface(bits, grid)
        assert signed_volume(p, faces) > 0
        assert euler_characteristic(faces) == 2
        assert surface_area(p, faces) / ball.area == pytest.approx(1.085, abs=0.01)
