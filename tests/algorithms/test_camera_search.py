import numpy as np
import pytest

from tests.geometry.views import view
from workbench.algorithms.cameras.camera_search import (
    Stop,
    by_plane,
    by_three_points,
    choose_pose,
    downhill,
)
from workbench.geometry.cameras.camera_motions import gauss_newton_step, rms_reprojection
from workbench.geometry.motions import exp_se3


def test_three_points_and_a_fourth_give_the_pose():
    for seed in range(10):
        T, p_world, xy = view(seed, 6)
        states = list(by_three_points(p_world, xy))
        solutions = len(states[1].lengths)
        assert [state.phase for state in states] == [
            "rays",
            "quartic",
            *["root"] * solutions,
            "choose",
        ]
        assert len(states[-1].candidates) == solutions
        assert states[-1].T is not None
        np.testing.assert_allclose(states[-1].T, T, atol=1e-5)
        assert states[-1].error < 1e-6


def test_of_a_plane_the_better_of_two_is_chosen():
    T, p_world, xy = view(3, 8, flat=True)
    both, chosen = by_plane(p_world, xy)
    assert both.candidates.shape == (2, 4, 4)
    assert chosen.T is not None
    np.testing.assert_allclose(chosen.T, T, atol=1e-6)


def test_downhill_every_step_lowers_the_error():
    T, p_world, xy = view(5, 10, sigma=2e-3)
    start = exp_se3(np.array([0.5, -0.4, 0.8, 0.3, 0.2, -0.3])) @ T
    states = list(downhill(start, p_world, xy, pose_step=gauss_newton_step))
    errors = [float(rms_reprojection(start, p_world, xy)), *(state.error for state in states[:-1])]
    assert (np.diff(errors) < 0).all()
    assert states[-1].stop is Stop.SETTLED
    assert states[-1].steps == len(states) - 1


def test_a_step_too_long_is_halved():
    T, p_world, xy = view(6, 10)
    start = exp_se3(np.array([0.1, 0.0, 0.2, 0.0, 0.1, 0.0])) @ T
    whole = gauss_newton_step(start, p_world, xy) @ np.linalg.inv(start)
    threefold = list(
        downhill(start, p_world, xy, pose_step=lambda T, p, xy: whole @ whole @ whole @ T, most=1)
    )
    assert threefold[0].phase == "step"
    assert threefold[0].share == 0.5


def test_the_way_ends_with_a_reason():
    T, p_world, xy = view(7, 8)
    away = exp_se3(np.array([0.2, 0.0, 0.0, 0.0, 0.0, 0.0])) @ T

    def uphill(T, p, xy):
        return T @ np.linalg.inv(gauss_newton_step(T, p, xy)) @ T

    assert list(downhill(away, p_world, xy, pose_step=uphill))[-1].stop is Stop.NOT_LOWER
    assert (
        list(downhill(away, p_world, xy, pose_step=gauss_newton_step, most=1))[-1].stop
        is Stop.MOST_STEPS
    )
    assert list(downhill(None, p_world, xy, pose_step=gauss_newton_step))[-1].stop is Stop.NO_POSE
    assert (
        list(downhill(np.diag([-1.0, 1, -1, 1]) @ T, p_world, xy, pose_step=gauss_newton_step))[
            -1
        ].stop
        is Stop.BEHIND
    )
    nan = list(downhill(away, p_world, xy, pose_step=lambda T, p, xy: np.full((4, 4), np.nan)))[-1]
    assert nan.stop is Stop.NOT_LOWER
    assert all(stop.message for stop in Stop)


@pytest.mark.parametrize("behind", [0, 1])
def test_a_pose_with_points_behind_is_not_chosen(behind):
    T, p_world, xy = view(8, 8)
    poses = [exp_se3(np.full(6, 0.01)) @ T, np.diag([-1.0, 1, -1, 1]) @ T]
    order = [poses[1], poses[0]] if behind == 0 else poses
    np.testing.assert_array_equal(choose_pose(np.stack(order), p_world, xy), poses[0])
