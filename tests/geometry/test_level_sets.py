"""Level sets: marching cubes outwards, exact on planes, second order on curved surfaces, places
made by a function.
"""

import numpy as np
import pytest

from workbench.geometry.fields.signed_distances import torus_sdf
from workbench.geometry.fields.voxels import Grid, marched_surface
from workbench.geometry.level_sets import edge_crossings, level_lines, level_surface
from workbench.geometry.meshes import euler_characteristic
from workbench.geometry.meshes.measures import encloses, signed_volume


def cube(n: int) -> Grid:
    return Grid(np.full(3, -1.0), np.full(3, 2 / n), (n, n, n))


def torus(n: int) -> tuple[np.ndarray, Grid]:
    grid = cube(n)
    return torus_sdf(grid.centres(), 0.6, 0.25).reshape(grid.shape), grid


def test_crossings_of_linear_fields_are_exact_and_do_not_depend_on_the_order():
    rng = np.random.default_rng(0)
    a = rng.normal(size=(200, 3))
    b = rng.normal(size=(200, 3))
    n = np.array([1.0, -2, 0.5])
    f_a, f_b = a @ n - 0.1, b @ n - 0.1
    cross = f_a * f_b < 0
    p = edge_crossings(a[cross], b[cross], f_a[cross], f_b[cross])
    np.testing.assert_allclose(p @ n, 0.1, atol=1e-12)
    np.testing.assert_allclose(
        p, edge_crossings(b[cross], a[cross], f_b[cross], f_a[cross]), atol=1e-12
    )


def test_zero_at_both_ends_is_the_middle():
    zero = np.zeros(1)
    np.testing.assert_allclose(edge_crossings(np.zeros((1, 3)), np.ones((1, 3)), zero, zero), 0.5)


def test_a_closed_surface_comes_back_outwards_and_with_its_hole():
    p, faces = level_surface(*torus(24))
    assert signed_volume(p, faces) == pytest.approx(2 * np.pi**2 * 0.6 * 0.25**2, rel=0.04)
    assert encloses(faces)
    assert euler_characteristic(faces) == 0


def test_half_the_edge_is_a_quarter_of_the_error():
    errors = [
        np.abs(torus_sdf(level_surface(*torus(n))[0], 0.6, 0.25)).mean() for n in (16, 32, 64)
    ]
    np.testing.assert_allclose(np.array(errors[:-1]) / errors[1:], 4, rtol=0.15)


def test_middles_give_what_bits_give():
    values, grid = torus(20)
    p, faces = level_surface(values, grid, lambda a, b, f_a, f_b: (a + b) / 2)
    of_bits = marched_surface(values < 0, grid)
    assert signed_volume(p, faces) == pytest.approx(signed_volume(*of_bits), rel=0.02)
    halves = (p - grid.low) / grid.spacing * 2
    np.testing.assert_allclose(halves, np.rint(halves), atol=1e-9)


@pytest.mark.parametrize("values", [np.ones((4, 4, 4)), -np.ones((4, 4, 4)), np.ones((1, 4, 4))])
def test_one_sign_has_no_surface(values):
    p, faces = level_surface(values, Grid(np.zeros(3), np.ones(3), values.shape))
    assert (p.shape, faces.shape) == ((0, 3), (0, 3))


def test_lines_lie_where_the_field_has_their_values():
    x, y = np.meshgrid(np.linspace(-2, 2, 81), np.linspace(-1, 3, 81))
    ends = level_lines(
        np.hypot(x, y - 1), np.array([0.5, 1.0]), np.array([-2.0, -1.0]), spacing=0.05
    )
    away = np.hypot(ends[..., 0], ends[..., 1] - 1)
    np.testing.assert_allclose(np.abs(away - 0.75), 0.25, atol=1e-3)
    lengths = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
    assert lengths.sum() == pytest.approx(2 * np.pi * 1.5, rel=1e-3)
    assert level_lines(np.hypot(x, y), np.array([99.0]), np.zeros(2), spacing=1.0).shape == (
        0,
        2,
        2,
    )
