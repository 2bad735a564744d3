"""Own data in the picture: of any size and place they come to the same frame, and motions go along
with their points.
"""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.geometry.test_motions import motions
from workbench.data.framing import (
    UPRIGHT,
    Up,
    box,
    extent,
    frame,
    ground_grid,
    likely_up,
    round_below,
)
from workbench.geometry.motions import apply

UPS = st.sampled_from(sorted(UPRIGHT))
SEEDS = st.integers(0, 10_000)


def cloud(seed: int, n: int = 60) -> np.ndarray:
    return np.random.default_rng(seed).uniform(-1, 1, (n, 3)) * [1.0, 2.0, 3.0]


@pytest.mark.parametrize(
    ("up", "v_file"), [("z", [0, 0, 1]), ("y", [0, 1, 0]), ("-y", [0, -1, 0]), ("x", [1, 0, 0])]
)
def test_the_named_axis_points_up(up, v_file):
    R = UPRIGHT[up]
    np.testing.assert_array_equal(R @ v_file, [0.0, 0.0, 1.0])
    np.testing.assert_array_equal(R @ R.T, np.eye(3))
    assert np.linalg.det(R) == 1.0


@settings(max_examples=40, deadline=None)
@given(seed=SEEDS, up=UPS, width=st.floats(0.1, 10.0))
def test_the_box_is_so_wide_and_about_the_origin(seed, up: Up, width):
    p = cloud(seed)
    low, high = box(frame(p, width, up=up).shown(p))
    np.testing.assert_allclose(low + high, 0.0, atol=1e-9 * width)
    assert (high - low).max() == pytest.approx(width)


@settings(max_examples=40, deadline=None)
@given(seed=SEEDS, up=UPS, size=st.floats(1e-3, 1e3), far=st.sampled_from([0.0, 2.0]))
def test_size_and_place_of_a_file_do_not_show(seed, up: Up, size, *, far):
    p = cloud(seed)
    q = size * (p + np.array([3.0, -5.0, 7.0]))
    shown = frame(p, 2.0, up=up, far=far).shown(p)
    np.testing.assert_allclose(frame(q, 2.0, up=up, far=far).shown(q), shown, atol=1e-9)


@settings(max_examples=40, deadline=None)
@given(seed=SEEDS, up=UPS, T=motions(), floor=st.floats(-2.0, 2.0))
def test_a_motion_goes_along_with_its_points(seed, up: Up, T, *, floor):
    p = cloud(seed)
    how = frame(p, 1.2, up=up).standing(p, floor)
    np.testing.assert_allclose(
        apply(how.shown_motion(T), how.shown(p)), how.shown(apply(T, p)), atol=1e-9
    )


@settings(max_examples=40, deadline=None)
@given(seed=SEEDS, up=UPS, floor=st.floats(-2.0, 2.0))
def test_what_stands_has_its_lowest_point_on_the_floor(seed, up: Up, floor):
    p = cloud(seed)
    free = frame(p, 1.2, up=up)
    stands = frame(p, 1.2, up=up).standing(p, floor)
    assert stands.shown(p)[:, 2].min() == pytest.approx(floor, abs=1e-9)
    np.testing.assert_allclose((stands.shown(p) - free.shown(p))[:, :2], 0.0, atol=1e-12)


def test_a_few_far_points_do_not_shrink_the_rest():
    p = cloud(0, 500)
    strayed = np.concatenate([p, [[1e3, 1e3, 1e3]]])
    assert frame(strayed, 1.0, far=2.0).scale == pytest.approx(
        frame(p, 1.0, far=2.0).scale, rel=0.05
    )
    assert frame(strayed, 1.0).scale < 0.01 * frame(p, 1.0).scale


def test_degenerate_clouds_have_a_frame():
    place = np.tile([5.0, 5.0, 5.0], (4, 1))
    assert extent(place) == 0.0
    np.testing.assert_array_equal(frame(place, 1.2).shown(place), np.zeros((4, 3)))
    assert frame(place, 1.2).scale == 1.2
    # the box without far points is one place
    nearly = np.concatenate([np.zeros((200, 3)), [[4.0, 0.0, 0.0]]])
    assert extent(nearly, far=2.0) == 4.0


@pytest.mark.parametrize(
    ("lift", "kind", "up"),
    [
        ([0.0, 1.0, 0.0], ".obj", "y"),
        ([0.0, 0.0, 1.0], ".obj", "z"),
        ([0.0, 1.0, 0.0], ".stl", "y"),
        ([0.0, 0.0, 0.0], ".obj", "y"),
        ([0.0, 0.0, 0.0], ".stl", "z"),
        ([1.0, 1.0, 1.0], ".stl", "z"),
    ],
)
def test_what_stands_on_an_axis_has_it_upwards(lift, kind, up):
    p = np.random.default_rng(0).uniform(-1, 1, (300, 3)) + np.array(lift)
    assert likely_up(p, kind) == up
    assert likely_up(1000 * p, kind) == up


@given(st.floats(1e-6, 1e6))
def test_round_below_is_round_and_below(length):
    rounded = round_below(length)
    assert rounded <= length * (1 + 1e-6)
    assert length < 2.5 * rounded * (1 + 1e-6)
    assert f"{rounded:.3e}"[:5] in ("1.000", "2.000", "5.000")


@pytest.mark.parametrize(
    ("length", "rounded"), [(1.0, 1.0), (0.1, 0.1), (0.5 / 0.024, 20.0), (9.99, 5.0), (0.3, 0.2)]
)
def test_round_below(length, rounded):
    assert round_below(length) == pytest.approx(rounded, rel=1e-12)


def test_a_grid_has_lines_both_ways_in_its_cells():
    lines = ground_grid(0.4, -0.35)
    assert lines.shape == (2 * 9, 2, 3)  # four cells of 0.4 m reach 1.5 m
    assert (lines[..., 2] == -0.35).all()
    assert np.abs(lines[..., :2]).max() == pytest.approx(1.6)
    np.testing.assert_allclose(np.diff(np.unique(lines[:9, 0, 0])), 0.4)
    np.testing.assert_array_equal(lines[9:], lines[:9][:, :, [1, 0, 2]])
