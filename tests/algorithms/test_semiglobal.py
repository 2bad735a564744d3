"""Semi-global paths: against the recursion written pixel by pixel, and against every map there
is.
"""

import itertools

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from workbench.algorithms.stereo import semiglobal
from workbench.algorithms.stereo.disparity_map import winner_takes_all
from workbench.algorithms.stereo.semiglobal import (
    DIRECTIONS,
    energy,
    path_costs,
    prepare,
    semi_global,
)


def slowly(cost, direction, P1, *, P2):
    """Return L_r as equation 13 has it, one pixel at a time."""
    n, h, w = cost.shape
    down, right = direction
    L = np.zeros(cost.shape)
    for y, x in itertools.product(range(h)[:: down or 1], range(w)[:: right or 1]):
        before_y, before_x = y - down, x - right
        L[:, y, x] = cost[:, y, x]
        if 0 <= before_y < h and 0 <= before_x < w:
            before = L[:, before_y, before_x]
            step = np.abs(np.subtract.outer(np.arange(n), np.arange(n)))
            penalty = np.where(step == 0, 0, np.where(step == 1, P1, P2))
            L[:, y, x] += (before + penalty).min(1) - before.min()
    return L


def total_of(cost: np.ndarray, P1: float, P2: float) -> np.ndarray:
    """Return the sum over all eight directions."""
    return list(semi_global(cost, P1, P2))[-1].total


def volume(seed: int, shape=(5, 6, 7), dtype: type = np.uint8, *, top: int = 25) -> np.ndarray:
    return np.random.default_rng(seed).integers(0, top, shape).astype(dtype)


@pytest.mark.parametrize("direction", DIRECTIONS)
@pytest.mark.parametrize("dtype", [np.uint8, np.uint16, float])
def test_a_path_follows_the_recursion(direction, dtype):
    for seed, shape in enumerate([(5, 6, 7), (3, 1, 8), (4, 8, 1), (1, 3, 4), (2, 9, 3)]):
        cost = volume(seed, shape, dtype)
        prepared, jumps = prepare(cost, 3, 9)
        assert np.array_equal(
            path_costs(prepared, direction, jumps), slowly(cost.astype(float), direction, 3, P2=9)
        )


@settings(max_examples=30, deadline=None)
@given(
    seed=st.integers(0, 10**6),
    shape=st.tuples(*[st.integers(1, 7)] * 3),
    P1=st.integers(0, 10),
    more=st.integers(0, 60),
    whole=st.booleans(),
)
def test_the_total_is_the_sum_of_the_steps(seed, shape, P1, *, more, whole):
    cost = volume(seed, shape, np.uint8 if whole else float)
    states = list(semi_global(cost, P1, P1 + more))
    assert [state.direction for state in states] == list(DIRECTIONS)
    assert np.array_equal(sum(state.path.astype(float) for state in states), states[-1].total)


def test_a_state_is_not_changed_by_the_next():
    states, copies = [], []
    for state in semi_global(volume(0), 2, 5):
        states.append(state)
        copies.append(state.total.copy())
    assert all(
        np.array_equal(state.total, copy) for state, copy in zip(states, copies, strict=True)
    )


def test_a_large_volume_has_the_same_paths_in_the_same_order(monkeypatch):
    together = [(state.direction, state.path) for state in semi_global(volume(0), 2, 5)]
    monkeypatch.setattr(semiglobal, "CELLS_TOGETHER", 0)
    for (direction, path), state in zip(together, semi_global(volume(0), 2, 5), strict=True):
        assert direction == state.direction
        assert np.array_equal(path, state.path)


@settings(max_examples=20, deadline=None)
@given(st.integers(0, 10**6))
def test_without_penalties_nothing_is_smoothed(seed):
    cost = volume(seed)
    assert np.array_equal(total_of(cost, 0, 0), 8 * cost.astype(int))


@settings(max_examples=20, deadline=None)
@given(st.integers(0, 10**6))
def test_turning_the_picture_turns_the_answer(seed):
    cost = volume(seed)
    total = total_of(cost, 4, 11)
    for flip in (
        lambda a: a[:, ::-1],
        lambda a: a[:, :, ::-1],
        lambda a: a.transpose(0, 2, 1),
        lambda a: a[::-1],
    ):
        assert np.array_equal(total_of(np.ascontiguousarray(flip(cost)), 4, 11), flip(total))


@pytest.mark.parametrize(
    ("top", "P2", "dtype"),
    [
        (25, 60, np.uint8),
        (25, 230, np.uint8),
        (130, 125, np.uint8),
        (250, 250, np.uint8),
        (60000, 60000, np.uint16),
    ],
)
def test_narrow_numbers_do_not_overflow(top, P2, dtype):
    cost = volume(1, (6, 9, 9), dtype, top=top)
    for P1 in (P2 // 3, P2):
        assert np.array_equal(total_of(cost, P1, P2), total_of(cost.astype(float), P1, P2))
    path, jumps = prepare(cost, P2 // 3, P2)
    for direction in DIRECTIONS:
        assert (path_costs(path, direction, jumps) <= cost.astype(float) + P2).all()


@settings(max_examples=10, deadline=None)
@given(st.integers(0, 10**6), st.integers(0, 8), st.integers(0, 8))
def test_along_one_line_it_finds_the_best_of_all_maps(seed, P1, more):
    P2 = P1 + more
    cost = (
        volume(seed, (3, 1, 5), float, top=12)
        + np.random.default_rng(seed).random((3, 1, 5)) * 1e-3
    )
    prepared, jumps = prepare(cost, P1, P2)
    # C counted once
    both = path_costs(prepared, (0, 1), jumps) + path_costs(prepared, (0, -1), jumps) - prepared
    best = min(
        energy(cost, np.array([line], float), P1, P2=P2)
        for line in itertools.product(range(3), repeat=5)
    )
    assert energy(cost, winner_takes_all(both).astype(float), P1, P2=P2) == pytest.approx(
        best, rel=1e-5
    )


def test_smoothing_lowers_the_energy_and_the_error_of_a_noisy_step():
    rng = np.random.default_rng(0)
    truth = np.where(np.arange(40) < 20, 2, 7)[None].repeat(30, 0)
    cost = rng.integers(0, 20, (10, 30, 40)).astype(np.uint8)
    np.put_along_axis(cost, truth[None], rng.integers(0, 6, (1, 30, 40)).astype(np.uint8), 0)
    raw = winner_takes_all(cost)
    smooth = winner_takes_all(total_of(cost, 6, 20))
    assert energy(cost, smooth.astype(float), 6, P2=20) < 0.5 * energy(
        cost, raw.astype(float), 6, P2=20
    )
    assert (raw != truth).mean() > 0.3
    assert (smooth != truth).mean() < 0.02


def test_energy_is_what_it_says():
    cost = np.array(
        [[[1.0, 2.0], [3.0, np.inf]], [[5.0, 6.0], [7.0, 8.0]], [[0.0, 0.0], [0.0, 9.0]]]
    )
    # four pixels: costs 1, 6, 0, 9; steps 1 (right), 2 (down), 2 (right), 1 (down), 0 and 2 ... on
    # six pairs
    disparity = np.array([[0.0, 1.0], [2.0, 2.0]])
    steps = [abs(a - b) for a, b in [(0, 1), (2, 2), (0, 2), (1, 2), (0, 2), (1, 2)]]
    expected = 1 + 6 + 0 + 9 + 10 * steps.count(1) + 100 * steps.count(2)
    assert energy(cost, disparity, 10, P2=100) == pytest.approx(expected / 4)
    assert energy(cost, np.array([[np.nan, 1.0], [2.0, np.nan]]), 10, P2=100) == pytest.approx(
        (6 + 0 + 10) / 2
    )
    assert energy(cost, np.array([[0.0, 0.0], [0.0, 0.0]]), 10, P2=100) == pytest.approx(
        (1 + 2 + 3 + 9) / 4
    )
    assert energy(cost, np.full((2, 2), np.nan), 10, P2=100) == 0.0


@pytest.mark.parametrize(("P1", "P2"), [(5, 4), (-1, 3), (np.nan, 3)])
def test_penalties_out_of_order_are_refused(P1, P2):
    with pytest.raises(ValueError, match="P1 <= P2"):
        total_of(volume(0), P1, P2)


def test_infinite_cells_never_poison_a_path():
    cost = volume(3, dtype=float)
    cost[3:, :, :3] = np.inf
    total = total_of(cost, 2, 6)
    assert np.isfinite(total).all()
    assert np.array_equal(total, total_of(np.minimum(cost, cost[np.isfinite(cost)].max()), 2, 6))
