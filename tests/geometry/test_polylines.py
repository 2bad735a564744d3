"""Segments of lines and triangles of polygons: nothing is lost and nothing twice."""

import numpy as np
import pytest

from workbench.geometry.polylines import fan, segments


@pytest.mark.parametrize("closed", [False, True])
@pytest.mark.parametrize("n", [1, 2, 5])
def test_each_segment_starts_where_the_one_before_ends(n, closed):
    p = np.random.default_rng(n).normal(size=(n, 3))
    found = segments(p, closed=closed)
    assert len(found) == (n if closed else n - 1)
    np.testing.assert_array_equal(found[:, 0], p[: len(found)])
    np.testing.assert_array_equal(found[1:, 0], found[:-1, 1])
    if closed:
        np.testing.assert_array_equal(found[-1, 1], p[0])


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
