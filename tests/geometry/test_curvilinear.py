"""Spherical and cylindrical coordinates: inverses, axes, conventions, and what cells hold."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from workbench.geometry.shapes.curvilinear import (
    SYSTEMS,
    cartesian_from_spherical,
    cell_edges,
    read_as,
    spherical_from_cartesian,
    volume_of_cells,
    written_as,
)

POINTS = arrays(np.float64, (7, 3), elements=st.floats(-1e3, 1e3, allow_subnormal=False))
CONVENTIONS = ("ISO", "mathematics", "elevation")


@given(POINTS, st.sampled_from(sorted(SYSTEMS)))
def test_coordinates_put_points_back(p, system):
    of = SYSTEMS[system]
    np.testing.assert_allclose(of.to_points(of.of_points(p)), p, atol=1e-12 * (1 + np.abs(p).max()))


@given(POINTS)
def test_they_are_in_their_ranges_and_zero_where_they_have_no_meaning(p):
    p[0, :2] = 0.0
    r, polar, azimuth = spherical_from_cartesian(p).T
    assert (r >= 0).all()
    assert ((polar >= 0) & (polar <= np.pi)).all()
    assert ((azimuth > -np.pi) & (azimuth <= np.pi)).all()
    assert azimuth[0] == 0


def test_axes_origin_and_signs_of_zeros():
    p = np.array(
        [
            [0, 0, 0],
            [0, 0, 2],
            [0, 0, -2],
            [-1, 0, 0],
            [-1, -0.0, 0],
            [-0.0, 0, 1],
            [-1, -1e-300, 0],
        ],
        float,
    )
    np.testing.assert_allclose(
        spherical_from_cartesian(p),
        [
            [0, 0, 0],
            [2, 0, 0],
            [2, np.pi, 0],
            [1, np.pi / 2, np.pi],
            [1, np.pi / 2, np.pi],
            [1, 0, 0],
            [1, np.pi / 2, np.pi],
        ],
    )
    assert spherical_from_cartesian(np.empty((0, 3))).shape == (0, 3)


@pytest.mark.parametrize("polar", [1e-3, 1e-6, 1e-9, 1e-15])
def test_it_is_exact_near_the_axis_where_arccos_is_not(polar):
    p = np.array([[np.sin(polar), 0.0, np.cos(polar)]])
    assert spherical_from_cartesian(p)[0, 1] == pytest.approx(polar, rel=1e-12)
    by_arccos = np.arccos(p[0, 2] / np.linalg.norm(p))
    assert by_arccos == 0 or polar > 1e-8
    if polar == 1e-6:
        assert 1e-5 < abs(by_arccos / polar - 1) < 1e-3


def test_complex_numbers_say_the_same_in_chunks():
    p = np.random.default_rng(0).normal(size=(10_001, 3))
    flat = p[:, 0] + 1j * p[:, 1]
    np.testing.assert_allclose(spherical_from_cartesian(p)[:, 2], np.angle(flat))
    np.testing.assert_allclose(
        spherical_from_cartesian(p)[:, 1], np.angle(p[:, 2] + 1j * np.abs(flat))
    )


def test_half_of_all_azimuths_are_wrong_by_arctan():
    p = np.random.default_rng(1).normal(size=(100_000, 3))
    off = np.abs(np.arctan(p[:, 1] / p[:, 0]) - spherical_from_cartesian(p)[:, 2]) > 1e-9
    assert off.mean() == pytest.approx(0.5, abs=0.01)


def test_the_known_oracle_is_zero_near_the_axis():
    trimesh = pytest.importorskip("trimesh")
    p = np.array([[np.sin(1e-9), 0.0, np.cos(1e-9)]])
    assert np.abs(trimesh.util.vector_to_spherical(p)).max() == 0  # (azimuth, polar), by arccos
    assert spherical_from_cartesian(p)[0, 1] == pytest.approx(1e-9)


@pytest.mark.parametrize("system", sorted(SYSTEMS))
def test_cells_fill_their_solid(system):
    of = SYSTEMS[system]
    low, high = np.array(of.solid)
    volume, product = volume_of_cells(of, low, high, cells=40)
    assert volume == pytest.approx(of.volume, rel=1e-3)
    assert product == pytest.approx(np.prod(high - low))


def test_the_box_of_a_balls_coordinates_is_two_pi_squared():
    low, high = np.array(SYSTEMS["spherical"].solid)
    assert volume_of_cells(SYSTEMS["spherical"], low, high)[1] == pytest.approx(2 * np.pi**2)


@pytest.mark.parametrize("system", sorted(SYSTEMS))
def test_the_density_is_the_determinant_of_the_derivative(system):
    of = SYSTEMS[system]
    c = np.array([0.7, 0.9, 0.4])
    h = 1e-5
    J = np.column_stack(
        [
            (of.to_points(c[None] + d) - of.to_points(c[None] - d))[0] / (2 * h)
            for d in h * np.eye(3)
        ]
    )
    assert abs(np.linalg.det(J)) == pytest.approx(of.density(c[None])[0], rel=1e-8)


def test_edges_of_a_cell_join_its_corners():
    edges = cell_edges(SYSTEMS["spherical"], np.array([1, 0.5, 0.2]), np.array([1.2, 0.9, 0.6]))
    assert edges.shape == (96, 2, 3)
    ends, times = np.unique(edges.reshape(-1, 3).round(9), axis=0, return_counts=True)
    corners = ends[times == 3]
    assert len(corners) == 8
    np.testing.assert_allclose(np.unique(np.linalg.norm(corners, axis=1).round(9)), [1, 1.2])


@given(arrays(np.float64, 3, elements=st.floats(0.1, 3.0)), st.sampled_from(CONVENTIONS))
def test_what_is_written_is_read_again(c, convention):
    np.testing.assert_allclose(read_as(written_as(c, convention), convention), c)


def test_one_triple_is_three_points():
    numbers = np.array([1.0, np.radians(50), np.radians(30)])
    iso, mathematics, elevation = (
        cartesian_from_spherical(read_as(numbers, name)[None])[0] for name in CONVENTIONS
    )
    np.testing.assert_allclose(iso[2], np.cos(np.radians(50)))
    np.testing.assert_allclose(mathematics[2], np.cos(np.radians(30)))
    np.testing.assert_allclose(elevation[2], np.sin(np.radians(30)))
    assert np.arctan2(elevation[1], elevation[0]) == pytest.approx(np.radians(50))
