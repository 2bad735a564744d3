"""Fast marching: the one solution of its equation, whatever the bands; a heap beside it; published
figures.
"""

import heapq
import itertools

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from workbench.algorithms.surfaces.fast_marching import eikonal_update, march


def by_heap(start, free, h):
    """Node by node, as Sethian has it."""
    n, m = start.shape
    T = start.copy()
    done = np.zeros((n, m), bool)
    heap = [(T[i, j], i, j) for i, j in zip(*np.nonzero(np.isfinite(T)), strict=True)]
    heapq.heapify(heap)
    given_ = np.isfinite(start)

    def at(i, j):
        return T[i, j] if 0 <= i < n and 0 <= j < m and done[i, j] else np.inf

    while heap:
        _, i, j = heapq.heappop(heap)
        if done[i, j]:
            continue
        done[i, j] = True
        for a, b in ((i + 1, j), (i - 1, j), (i, j + 1), (i, j - 1)):
            if 0 <= a < n and 0 <= b < m and not done[a, b] and free[a, b] and not given_[a, b]:
                x = min(at(a - 1, b), at(a + 1, b))
                y = min(at(a, b - 1), at(a, b + 1))
                low, high = min(x, y), max(x, y)
                u = (
                    low + h
                    if high - low >= h
                    else (low + high + np.sqrt(2 * h * h - (high - low) ** 2)) / 2
                )
                if u < T[a, b]:
                    T[a, b] = u
                    heapq.heappush(heap, (u, a, b))
    return T


@settings(deadline=None, max_examples=12)
@given(st.integers(0, 10_000), st.floats(0.01, 2.0))
def test_bands_give_what_a_heap_gives(seed, band):
    rng = np.random.default_rng(seed)
    free = rng.random((13, 17)) > 0.25
    free[3, 4] = True
    start = np.full(free.shape, np.inf)
    start[3, 4] = 0.0
    *_, last = march(start, free, 0.1, band=band)
    np.testing.assert_allclose(last.d, by_heap(start, free, 0.1), atol=1e-12)
    assert (last.accepted == np.isfinite(last.d)).all()


def corner(side, disc=0.0):
    x = np.linspace(0, 1, side)
    true = np.hypot(*np.meshgrid(x, x, indexing="ij"))
    start = np.where(true <= disc, true, np.inf)
    *_, last = march(start, np.ones((side, side), bool), 1 / (side - 1), band=0.1)
    return 100 * (last.d / np.where(true > 0, true, 1) - 1)[true > 0.2].max()


def test_the_error_falls_slowly_and_faster_from_an_exact_disc():
    np.testing.assert_allclose([corner(side) for side in (21, 41, 81)], [12.1, 8.0, 5.3], atol=0.05)
    np.testing.assert_allclose(
        [corner(side, 0.1) for side in (21, 41, 81)], [8.1, 3.6, 1.7], atol=0.06
    )


def test_what_is_accepted_stays():
    start = np.full((15, 15), np.inf)
    start[7, 2] = 0.0
    states = list(march(start, np.ones((15, 15), bool), 1.0, band=2.0))
    for before, after in itertools.pairwise(states):
        assert (after.accepted[before.accepted]).all()
        np.testing.assert_array_equal(after.d[before.accepted], before.d[before.accepted])
        assert (after.d <= before.d).all()
        assert not (after.trial & after.accepted).any()
    assert (start[start < np.inf] == 0).all()


def test_a_straight_front_is_exact():
    start = np.full((5, 9), np.inf)
    start[:, 0] = 0.0
    *_, last = march(start, np.ones((5, 9), bool), 0.5, band=10.0)
    np.testing.assert_allclose(last.d, np.broadcast_to(0.5 * np.arange(9), (5, 9)))


def test_what_is_walled_in_is_never_reached():
    free = np.ones((7, 7), bool)
    free[2:5, 2] = free[2:5, 4] = free[2, 2:5] = free[4, 2:5] = False
    start = np.full((7, 7), np.inf)
    start[0, 0] = 0.0
    *_, last = march(start, free, 1.0, band=1.0)
    assert np.isinf(last.d[3, 3])
    assert np.isfinite(last.d[6, 6])
    assert not last.accepted[3, 3]


@settings(deadline=None, max_examples=30)
@given(st.floats(0, 10), st.floats(0, 10), st.floats(0.01, 5))
def test_the_update_solves_its_equation(a, b, h):
    u = float(eikonal_update(np.array([a]), np.array([b]), h)[0])
    assert u >= max(min(a, b), 0)
    if abs(a - b) < h * (1 - 1e-9):
        assert (u - a) ** 2 + (u - b) ** 2 == pytest.approx(h * h, rel=1e-6)
        assert u >= max(a, b) - 1e-9
    else:
        assert u == pytest.approx(min(a, b) + h)


def test_one_neighbour_is_enough():
    assert eikonal_update(np.array([np.inf, 1.0]), np.array([2.0, np.inf]), 0.5).tolist() == [
        2.5,
        1.5,
    ]
