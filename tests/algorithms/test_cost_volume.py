"""Cost volumes: against their definition, pixel by pixel, and what each cost does not see."""

import numpy as np
import pytest
import scipy
from hypothesis import given, settings
from hypothesis import strategies as st

from workbench.algorithms.stereo import cost_volume
from workbench.algorithms.stereo.cost_volume import (
    box_sum,
    box_sums,
    census,
    census_cost_volume,
    ncc_cost_volume,
    sad_cost_volume,
    ssd_cost_volume,
)

VOLUMES = [sad_cost_volume, ssd_cost_volume, census_cost_volume, ncc_cost_volume]


def pair(
    seed: int = 0, shape: tuple[int, int] = (11, 17), dtype: type = np.uint8
) -> tuple[np.ndarray, np.ndarray]:
    rng = np.random.default_rng(seed)
    return rng.integers(0, 256, shape).astype(dtype), rng.integers(0, 256, shape).astype(dtype)


@pytest.mark.parametrize("window", [1, 3, 5, 9])
@pytest.mark.parametrize("dtype", [np.uint8, float])
@pytest.mark.parametrize("power", [1, 2])
def test_sums_of_differences_are_what_they_say(window, dtype, power):
    left, right = pair(dtype=dtype)
    cost = (sad_cost_volume if power == 1 else ssd_cost_volume)(left, right, 6, window)
    assert cost.shape == (7, 11, 17)
    for d in range(7):
        difference = np.abs(left[:, d:].astype(float) - right[:, : 17 - d].astype(float)) ** power
        padded = np.pad(difference, window // 2, mode="edge")
        expected = np.lib.stride_tricks.sliding_window_view(padded, (window, window)).sum((2, 3))
        assert np.array_equal(cost[d, :, d:], expected)
        assert (cost[d, :, :d] >= cost[np.isfinite(cost)].max()).all()


def test_census_counts_the_bits_that_differ():
    left, right = pair(1)
    cost = census_cost_volume(left, right, 3)
    offsets = [(dy, dx) for dy in range(-2, 3) for dx in range(-2, 3) if (dy, dx) != (0, 0)]
    bits = [
        np.stack(
            [
                np.pad(p, 2, mode="edge")[2 + dy : 13 + dy, 2 + dx : 19 + dx] < p
                for dy, dx in offsets
            ]
        )
        for p in (left, right)
    ]
    for d in range(4):
        expected = (bits[0][:, :, d:] != bits[1][:, :, : 17 - d]).sum(0)
        assert np.array_equal(cost[d, :, d:], expected)


@pytest.mark.parametrize("window", [3, 7])
def test_correlation_is_what_it_says(window):
    left, right = pair(2, dtype=float)
    cost = ncc_cost_volume(left, right, 4, window)
    assert np.isinf(cost[3, :, :3]).all()
    d = 3
    half = window // 2
    for y, x in ((half, d + half), (5, 10), (10 - half, 16 - half)):
        a = left[y - half : y + half + 1, x - half : x + half + 1].ravel()
        b = right[y - half : y + half + 1, x - d - half : x - d + half + 1].ravel()
        assert cost[d, y, x] == pytest.approx(1 - np.corrcoef(a, b)[0, 1], abs=1e-9)


@settings(max_examples=30, deadline=None)
@given(
    seed=st.integers(0, 2**32 - 1),
    window=st.sampled_from([1, 3, 5, 7, 9, 15, 21]),
    h=st.integers(1, 12),
    w=st.integers(1, 12),
)
def test_box_sums_equal_scipys(seed, window, h, *, w):
    image = np.random.default_rng(seed).integers(0, 256, (h, w)).astype(float)
    expected = scipy.ndimage.convolve(image, np.ones((window, window)), mode="nearest")
    assert np.allclose(box_sum(image, window, float), expected, rtol=1e-12)
    assert np.array_equal(box_sum(image.astype(np.uint8), window, np.uint32), expected)


def test_running_sums_serve_several_windows():
    image = np.random.default_rng(0).random((9, 14))
    windows = (5, 1, 21, 7)
    for window, sums in zip(windows, box_sums(image, windows), strict=True):
        assert np.array_equal(sums, box_sum(image, window, float))


@pytest.mark.parametrize("volume", VOLUMES)
@pytest.mark.parametrize("window", [1, 5])
@pytest.mark.parametrize("dtype", [np.uint8, float])
def test_a_shifted_picture_costs_nothing_at_its_shift(volume, window, dtype):
    scene = np.random.default_rng(3).integers(0, 256, (20, 40)).astype(dtype)
    # what is at x in the left is at x - 4 in the right
    left = scene[:, :30]
    right = scene[:, 4:34]
    cost = volume(left, right, 8, window)
    assert np.abs(cost[4, 4:-4, 8:-4]).max() < 1e-9
    assert (np.delete(cost, 4, 0)[:, 4:-4, 12:-4] > 0).mean() > 0.99


@settings(max_examples=30, deadline=None)
@given(st.floats(0.2, 5.0), st.floats(-100, 100), st.integers(0, 1000))
def test_correlation_ignores_gain_and_offset_and_census_every_monotone_change(gain, offset, seed):
    left, right = pair(seed, dtype=float)
    plain = ncc_cost_volume(left, right, 3, 5)
    assert np.allclose(ncc_cost_volume(left, gain * right + offset, 3, 5), plain, atol=1e-7)
    assert np.array_equal(census(gain * right**1.5 + offset), census(right))
    assert not np.allclose(
        sad_cost_volume(left, 1.5 * right + 10, 3, 5), sad_cost_volume(left, right, 3, 5)
    )


def test_a_bare_window_correlates_with_nothing():
    left, right = pair(4, dtype=float)
    left[3:9, 5:12] = 80.0
    cost = ncc_cost_volume(left, right, 2, 3)
    assert np.array_equal(cost[:, 5, 8], [1.0, 1.0, 1.0])
    bare = np.full((6, 8), 9.0)
    assert np.array_equal(ncc_cost_volume(bare, bare, 0, 3), np.ones((1, 6, 8)))


@pytest.mark.parametrize("volume", VOLUMES)
def test_whole_numbers_and_floats_agree(volume):
    left, right = pair(5)
    whole, exact = (
        volume(a, b, 5, 5) for a, b in ((left, right), (left.astype(float), right.astype(float)))
    )
    inside = np.isfinite(exact)
    assert np.allclose(whole[inside], exact[inside])


def test_large_windows_do_not_overflow():
    left = np.full((30, 40), 255, np.uint8)
    right = np.zeros((30, 40), np.uint8)
    assert sad_cost_volume(left, right, 1, 21).max() == 255 * 21**2
    assert ssd_cost_volume(left, right, 1, 21).max() == 255**2 * 21**2


@pytest.mark.parametrize("volume", VOLUMES)
@pytest.mark.parametrize(
    ("max_disparity", "window", "message"),
    [(2, 4, "odd"), (2, -1, "odd"), (8, 3, "8 px wide"), (-1, 3, "8 px wide")],
)
def test_misuse_is_said(volume, max_disparity, window, *, message):
    with pytest.raises(ValueError, match=message):
        volume(np.zeros((9, 8)), np.zeros((9, 8)), max_disparity, window)


def test_pictures_of_two_sizes_are_refused():
    with pytest.raises(ValueError, match=r"differ in size: \(9, 8\) and \(9, 9\)"):
        cost_volume._check(np.zeros((9, 8)), np.zeros((9, 9)), 2, window=3)


@pytest.mark.parametrize("volume", VOLUMES)
def test_the_smallest_pictures(volume):
    assert volume(np.ones((1, 1)), np.ones((1, 1)), 0, 3).shape == (1, 1, 1)
    assert volume(np.ones((1, 4)), np.ones((1, 4)), 3, 5).shape == (4, 1, 4)
