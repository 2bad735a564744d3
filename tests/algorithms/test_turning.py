"""ICP that only turns: its fits against a search, its costs, its stops."""

import numpy as np
import pytest

from workbench.algorithms.registration.icp import Stop
from workbench.algorithms.turning import (
    basin,
    best_turn,
    cost,
    cost_of_pairs,
    icp_turn,
    nearest,
    turn_along_lines,
    turned,
    within_half,
)
from workbench.data.rabbit_outline import along, normals_along, rabbit_outline

ANGLES = np.linspace(-180.0, 180.0, 7201)


@pytest.fixture(scope="module")
def lines():
    outline = rabbit_outline()
    p = along(outline, 60)
    q = along(outline, 50, 0.4)
    return p - p.mean(axis=0), q - q.mean(axis=0), normals_along(p)


def test_the_best_turn_is_the_lowest_of_a_fine_search(lines):
    p_target, p_source, _ = lines
    q = p_target[nearest(p_target, turned(p_source, 45.0))]
    searched = [np.sqrt(np.mean(np.sum((turned(p_source, a) - q) ** 2, axis=1))) for a in ANGLES]
    assert best_turn(q, p_source) == pytest.approx(ANGLES[np.argmin(searched)], abs=0.03)
    assert np.allclose(cost_of_pairs(q, p_source, ANGLES), searched, atol=1e-12)


def test_frozen_partners_touch_the_true_cost_and_lie_above_it(lines):
    p_target, p_source, _ = lines
    q = p_target[nearest(p_target, turned(p_source, 45.0))]
    frozen = cost_of_pairs(q, p_source, ANGLES[::40])
    true = np.array([cost(p_target, p_source, a) for a in ANGLES[::40]])
    assert np.all(frozen >= true - 1e-12)
    assert float(cost_of_pairs(q, p_source, 45.0)) == pytest.approx(cost(p_target, p_source, 45.0))


def test_nearest_agrees_with_a_search_one_by_one(lines):
    p_target, p_source, _ = lines
    indices = nearest(p_target, p_source)
    assert indices.dtype == np.intp
    assert indices.tolist() == [
        int(np.argmin(np.linalg.norm(p_target - p, axis=1))) for p in p_source
    ]


def test_a_turn_along_lines_is_the_least_squares_of_small_turns(lines):
    p_target, p_source, n = lines
    p = turned(p_source, 20.0)
    partners = nearest(p_target, p)
    q, n_match = p_target[partners], n[partners]
    across = np.column_stack([-p[:, 1], p[:, 0]])
    rows = np.einsum("ij,ij->i", across, n_match)
    wanted = np.linalg.lstsq(rows[:, None], np.einsum("ij,ij->i", q - p, n_match), rcond=None)[0]
    assert turn_along_lines(q, p, n_match) == pytest.approx(np.degrees(wanted[0]))


@pytest.mark.parametrize("start", [-170.0, -90.0, -30.0, 45.0, 75.0, 120.0, 180.0])
def test_no_sub_step_raises_the_cost_and_the_run_converges(lines, start):
    p_target, p_source, _ = lines
    states = list(icp_turn(p_target, p_source, start))
    assert np.all(np.diff([s.rmse for s in states]) <= 1e-12)
    assert states[-1].stop is Stop.CONVERGED
    assert [s.phase for s in states[:4]] == ["match", "fit", "match", "fit"]


def test_lines_come_home_from_45_in_fewer_rounds(lines):
    p_target, p_source, n = lines
    *_, point = icp_turn(p_target, p_source, 45.0)
    *_, line = icp_turn(p_target, p_source, 45.0, n_target=n)
    assert abs(point.angle) < 1.0
    assert abs(line.angle) < 1.0
    assert line.iteration <= point.iteration / 2


def test_a_circle_of_matches_and_the_last_round_stop_a_run(lines):
    p_target, p_source, n = lines
    *_, end = icp_turn(p_target, p_source, 75.0, n_target=n)
    assert end.stop is Stop.CIRCLING
    *_, end = icp_turn(p_target, p_source, 45.0, max_iterations=3)
    assert (end.iteration, end.stop) == (3, Stop.MAX_ITERATIONS)


@pytest.mark.parametrize("sliding", [False, True])
def test_the_basin_is_what_trying_each_start_says(lines, sliding):
    p_target, p_source, n_target = lines

    def end_of(start: float) -> float:
        *_, end = icp_turn(p_target, p_source, start, n_target=n_target if sliding else None)
        return end.angle

    low, high = basin(end_of)
    home = [a for a in range(-180, 181) if abs(within_half(end_of(a))) <= 5.0]
    assert (low, high) == (home[0], home[-1])
    assert home == list(range(home[0], home[-1] + 1))


@pytest.mark.parametrize("edge", [0, 1, 5, 6, 7, 60, 179, 180])
def test_the_basin_ends_before_a_gap_of_six_starts(edge):
    gap = (edge + 0.5, edge + 6.5)

    def end_of(start: float) -> float:
        return 90.0 if gap[0] < abs(start) < gap[1] else 0.0

    assert basin(end_of) == (-edge, edge)
