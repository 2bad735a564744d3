"""Lines and planes cut at a window: all that is inside is kept, and nothing else."""

import numpy as np
import pytest
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st

from workbench.geometry.clipping import clip_lines, plane_in_box, segments_inside
from workbench.geometry.shapes.lines_planes import plane_from_points

LOW = np.array([-1.0, -2.0, -0.5])
HIGH = np.array([1.5, 1.0, 2.0])
SEEDS = st.integers(0, 10_000)


def inside(p: np.ndarray, d: int) -> np.ndarray:
    return np.asarray(((p >= LOW[:d] - 1e-9) & (p <= HIGH[:d] + 1e-9)).all(axis=-1))


@settings(max_examples=60, deadline=None)
@given(angle=st.floats(0, 2 * np.pi), offset=st.floats(-3, 3))
@example(angle=7e-69, offset=1.0)  # along a side
def test_a_clipped_line_is_what_dense_points_of_it_show(angle, offset):
    line = np.array([np.cos(angle), np.sin(angle), offset])
    slope = np.abs(line[:2]).min()
    foot = -offset * line[:2]
    on_a_side = np.isclose([foot, foot], [LOW[:2], HIGH[:2]], rtol=0.0, atol=1e-8).any()
    # at these slopes `inside` takes points of a line beside a side that are just outside
    assume(not (on_a_side and 1e-13 < slope < 1e-8))
    along = np.linspace(-6, 6, 4001)[:, None] * [-line[1], line[0]] - offset * line[:2]
    seen = along[inside(along, 2)]
    parts = clip_lines(line[None], LOW[:2], HIGH[:2])
    if len(seen) > 1:
        assert np.linalg.norm(parts[0] - seen[[0, -1]], axis=1).max() < 0.005
    if len(parts):
        assert inside(parts, 2).all()
        np.testing.assert_allclose(parts @ line[:2] + offset, 0.0, atol=1e-9)


@pytest.mark.parametrize(
    ("line", "count"), [([0.0, 1.0, 0.5], 1), ([1.0, 0.0, 0.5], 1), ([0.0, 1.0, 9.0], 0)]
)
def test_lines_along_the_sides(line, count):
    assert len(clip_lines(np.array([line]), LOW[:2], HIGH[:2])) == count


@settings(max_examples=60, deadline=None)
@given(SEEDS)
def test_a_polygon_is_convex_on_its_plane_and_ends_at_the_box(seed):
    plane = plane_from_points(np.random.default_rng(seed).uniform(LOW, HIGH, (3, 3)))
    corners = plane_in_box(plane, LOW, HIGH)
    assert 3 <= len(corners) <= 6
    np.testing.assert_allclose(corners @ plane[:3] + plane[3], 0.0, atol=1e-9)
    assert inside(corners, 3).all()
    at_a_side = (np.abs(corners - LOW) < 1e-9) | (np.abs(corners - HIGH) < 1e-9)
    assert (at_a_side.sum(axis=1) >= 2).all(), "corners lie on edges of the box"
    steps = np.roll(corners, -1, axis=0) - corners
    turns = np.cross(steps, np.roll(steps, -1, axis=0)) @ plane[:3]
    assert (turns > 0).all() or (turns < 0).all(), "convex, in order"


@settings(max_examples=30, deadline=None)
@given(SEEDS)
def test_a_polygon_does_not_depend_on_the_side_of_the_normal(seed):
    plane = plane_from_points(np.random.default_rng(seed).uniform(LOW, HIGH, (3, 3)))
    corners = plane_in_box(plane, LOW, HIGH)
    np.testing.assert_allclose(plane_in_box(-plane, LOW, HIGH), corners, atol=1e-9)
    np.testing.assert_allclose(plane_in_box(plane * (1.0 + 1e-15), LOW, HIGH), corners, atol=1e-9)


def test_a_plane_that_passes_by_has_no_corner():
    assert plane_in_box(np.array([0.0, 0.0, 1.0, -50.0]), LOW, HIGH).shape == (0, 3)


def test_only_whole_and_finite_segments_are_inside():
    inside = [[0.0, 0.0], [1.0, 2.0]]
    ends = np.array(
        [inside, [[0.0, 0.0], [1.0, 2.1]], [[np.nan, 0.0], [0.0, 0.0]], [[-0.1, 0.0], [0.0, 0.0]]]
    )
    np.testing.assert_array_equal(
        segments_inside(ends, np.zeros(2), np.array([1.0, 2.0])), [inside]
    )
