"""Segments of lines and triangles of polygons: nothing is lost and nothing twice."""

import numpy as np
import pytest

from workbench.geometry.polylines import (
    between,
    circle,
    cylinder_rings,
    fan,
    near_arc,
    rectangle,
    segments,
    sphere_rings,
)


@pytest.mark.parametrize("closed", [False, True])
@pytest.mark.parametrize("n", [1, 2, 5])
def test_each_segment_starts_where_the_one_before_ends(n, closed):
    p = np.random.default_rng(n).normal(size=(n, 3))
    pieces = segments(p, closed=closed)
    assert len(pieces) == (n if closed else n - 1)
    np.testing.assert_array_equal(pieces[:, 0], p[: len(pieces)])
    np.testing.assert_array_equal(pieces[1:, 0], pieces[:-1, 1])
    if closed:
        np.testing.assert_array_equal(pieces[-1, 1], p[0])


@pytest.mark.parametrize("n", [3, 4, 9])
def test_a_fan_has_the_area_of_its_polygon(n):
    turn = 2 * np.pi * np.arange(n) / n
    corners = np.column_stack([np.cos(turn), np.sin(turn)])
    a, b, c = (corners[fan(n)[:, k]] for k in range(3))
    areas = 0.5 * ((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0])
    assert (areas > 0).all()
    assert areas.sum() == pytest.approx(0.5 * n * np.sin(2 * np.pi / n))


def test_a_line_and_a_point_have_no_triangle():
    assert fan(2).shape == fan(1).shape == (0, 3)


def test_partners_are_joined_row_by_row_and_two_points_too():
    p, q = np.random.default_rng(0).normal(size=(2, 4, 3))
    np.testing.assert_array_equal(between(p, q), [[a, b] for a, b in zip(p, q, strict=True)])
    np.testing.assert_array_equal(between(p[0], q[0]), [[p[0], q[0]]])


def test_a_rectangle_goes_round_its_middle_once():
    corners = rectangle(np.array([-1.0, 2.0]), np.array([3.0, 5.0]))
    edges = np.diff(np.vstack([corners, corners[:1]]), axis=0)
    np.testing.assert_array_equal(np.abs(edges), [[4, 0], [0, 3], [4, 0], [0, 3]])
    assert (edges[0, 0], edges[1, 1]) == (4, 3)


def test_a_circle_is_round_closed_and_evenly_divided():
    points = circle(12)
    np.testing.assert_allclose(np.linalg.norm(points, axis=1), 1, atol=1e-12)
    np.testing.assert_allclose(
        np.diff(np.unwrap(np.arctan2(points[:, 1], points[:, 0]))), np.pi / 6, atol=1e-12
    )


def test_the_rings_of_a_sphere_lie_on_it():
    centre = np.array([1.0, -2.0, 0.5])
    ends = sphere_rings(centre, 0.7, 16)
    assert ends.shape == (5 * 16, 2, 3)
    np.testing.assert_allclose(np.linalg.norm(ends - centre, axis=-1), 0.7, atol=1e-12)


@pytest.mark.parametrize("circle_", [[0.3, -0.2, 0.8], [0.3, -0.2, -0.8], [4000.0, 300.0, 4010.0]])
def test_an_arc_lies_on_its_circle_and_passes_the_origin_nearest(circle_):
    c = np.array(circle_)
    p = near_arc(c, 4.0)
    np.testing.assert_allclose(np.linalg.norm(p - c[:2], axis=1), abs(c[2]))
    nearest = abs(np.linalg.norm(c[:2]) - abs(c[2]))
    assert np.linalg.norm(p, axis=1).min() == pytest.approx(nearest, abs=1e-3)
    length = np.linalg.norm(np.diff(p, axis=0), axis=1).sum()
    assert length == pytest.approx(min(2 * np.pi * abs(c[2]), 8.0), rel=1e-3)


def test_rings_of_a_cylinder_lie_on_it():
    turn = np.linalg.qr(np.random.default_rng(0).normal(size=(3, 3)))[0]
    p_axis = np.array([1.0, 2.0, 3.0])
    p = (cylinder_rings(p_axis, turn, 0.5).reshape(-1, 3) - p_axis) @ turn
    np.testing.assert_allclose(np.hypot(p[:, 0], p[:, 1]), 0.5)
    assert np.ptp(p[:, 2]) == pytest.approx(1.0)
