"""What is known at each iteration of the joint refinement, and where it ends."""

import numpy as np
import pytest

from tests.algorithms.test_board_adjustment import LENS, TRUE, P, last_of, views
from workbench.algorithms.least_squares.board_adjustment import (
    adjust,
    linearised,
    shared_information,
)
from workbench.data.views import boards


def test_deviations_are_unknown_until_the_end_and_zero_for_what_is_fixed():
    Ts, uv = views(2)
    *before, last = adjust(boards.K_TRUE, LENS, Ts, p_board=P, uv=uv, coefficients=2)
    assert before
    for state in before:
        assert np.isnan(state.deviations[:6]).all()
        assert state.deviations[6:].tolist() == [0.0] * 3
    assert last.covariance is not None
    np.testing.assert_allclose(last.deviations[:6] ** 2, np.diag(last.covariance))
    assert last.deviations[6:].tolist() == [0.0] * 3


def test_it_ends_at_rest_unless_told_otherwise():
    Ts, uv = views(3)
    start = boards.K_TRUE * np.array([[1.2, 1.0, 1.0], [1.0, 1.2, 1.0], [1.0, 1.0, 1.0]])
    *_, adjustment = adjust(start, LENS, Ts, p_board=P, uv=uv)
    *_, finer = adjust(start, LENS, Ts, p_board=P, uv=uv, tolerance=1e-15)
    *_, coarse = adjust(start, LENS, Ts, p_board=P, uv=uv, tolerance=0.5)
    assert adjustment.cost == pytest.approx(finer.cost, rel=1e-7)
    np.testing.assert_allclose(adjustment.K, finer.K, atol=1e-4)
    assert coarse.cost > adjustment.cost * (1 + 1e-5)


def test_information_of_what_is_shared_is_what_the_poses_leave():
    Ts, uv = views(4, count=3)
    block = linearised(TRUE, Ts[:, :3, :3], Ts[:, :3, 3], p_board=P, uv=uv)
    free = np.arange(9) < 6
    whole = np.zeros((6 + 3 * 6, 6 + 3 * 6))
    for k, rows in enumerate(block):
        slopes = np.zeros((6 + 3 * 6, rows.shape[1]))
        slopes[:6] = rows[:9][free]
        slopes[6 + 6 * k : 12 + 6 * k] = rows[9:15]
        whole += slopes @ slopes.T
    poses = whole[6:, 6:]
    expected = whole[:6, :6] - whole[:6, 6:] @ np.linalg.solve(poses, whole[6:, :6])
    information = shared_information(block, free)
    np.testing.assert_allclose(information, expected, rtol=1e-6, atol=1e-6 * np.abs(expected).max())
    assert last_of(uv, Ts, coefficients=2).covariance is not None
