"""Meetings of lines in homogeneous coordinates, and what homographies keep."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from workbench.geometry.shapes.projective import angle_between_rays, cross_ratio, map_lines, meet

VECTORS = arrays(np.float64, (5, 3), elements=st.floats(-10, 10))
H = np.array([[1.0, 0.2, 0.1], [-0.1, 1.0, 0.3], [0.3, 0.5, 1.0]])


@given(VECTORS, VECTORS)
def test_it_is_the_cross_product_and_lies_on_both(a, b):
    x = meet(a, b)
    np.testing.assert_allclose(x, np.cross(a, b))
    np.testing.assert_allclose((a * x).sum(axis=1), 0, atol=1e-11)
    np.testing.assert_array_equal(meet(a, a), 0.0)


def test_parallels_meet_at_infinity():
    np.testing.assert_array_equal(
        meet(np.array([[0.0, 1, 0]]), np.array([[0.0, 1, -1]])), [[-1, 0, 0]]
    )


@pytest.mark.parametrize(("degrees", "metres"), [(1.0, 57.3), (0.01, 5730), (1e-6, 57.3e6)])
def test_lines_a_metre_apart_meet_far_away(degrees, metres):
    angle = np.radians(degrees)
    x, y, w = meet(
        np.array([[0.0, 1, 0]]), np.array([[np.sin(angle), np.cos(angle), -np.cos(angle)]])
    )[0]
    assert x / w == pytest.approx(metres, rel=1e-3)
    assert y == 0


@given(VECTORS, VECTORS)
def test_what_meets_still_meets(a, b):
    mapped = meet(map_lines(H, a), map_lines(H, b)) * np.linalg.det(H)
    np.testing.assert_allclose(mapped, meet(a, b) @ H.T, atol=1e-9)


def test_the_cross_ratio_is_kept_and_lengths_are_not():
    t = np.array([0.0, 1.0, 3.0, 7.0])
    q = np.column_stack([t, np.zeros(4), np.ones(4)]) @ H.T
    q = q[:, :2] / q[:, 2:]
    s = np.linalg.norm(q - q[0], axis=1)
    assert cross_ratio(t) == pytest.approx(9 / 7)
    assert cross_ratio(s) == pytest.approx(9 / 7)
    assert s[2] / s[1] != pytest.approx(3, abs=0.1)


@given(VECTORS.filter(lambda v: bool((np.linalg.norm(v, axis=1) > 1e-3).all())), st.floats(0.1, 10))
def test_rays_are_the_same_at_any_factor(v, factor):
    np.testing.assert_allclose(angle_between_rays(v, -factor * v), 0, atol=1e-12)


def test_no_ray_has_no_angle():
    zero, ones = np.zeros((1, 3)), np.ones((1, 3))
    assert np.isnan(angle_between_rays(zero, ones)).all()
    assert np.isnan(angle_between_rays(np.full((1, 3), np.inf), ones)).all()
    np.testing.assert_allclose(
        angle_between_rays(np.array([[1.0, 0, 0]]), np.array([[0.0, 2, 0]])), np.pi / 2
    )
