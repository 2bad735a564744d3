"""The joint refinement: its slopes, its invariants, and OpenCV's answer on two real cameras."""

from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
import scipy

from workbench.algorithms.cameras.calibration import calibrate
from workbench.algorithms.least_squares.board_adjustment import (
    SHARED,
    Adjustment,
    Stop,
    adjust,
    linearised,
    loss,
)
from workbench.data.views import boards
from workbench.geometry.cameras import intrinsics, project
from workbench.geometry.cameras.distortion import NONE, Distortion
from workbench.geometry.motions import exp_so3, turns

P = boards.board_points()
LENS = Distortion(-0.27, 0.05, 0.0015, -0.0005, 0.02)
TRUE = np.array([*boards.K_TRUE[[0, 1, 0, 1], [0, 1, 2, 2]], *LENS])


def views(seed: int = 0, count: int = 5, sigma: float = 0.2) -> tuple[np.ndarray, np.ndarray]:
    """Poses, and pixels by `project`, which is tested beside OpenCV."""
    rng = np.random.default_rng(seed)
    Ts = boards.board_poses(rng, count, tilt=0.5, distance=0.4, spread=1.0)
    uv = np.stack([project(P, T, boards.K_TRUE, LENS) for T in Ts])
    return Ts, uv + sigma * rng.standard_normal(uv.shape)


def last_of(uv: np.ndarray, Ts: np.ndarray, **options) -> Adjustment:
    *_, adjustment = adjust(boards.K_TRUE, LENS, Ts, p_board=P, uv=uv, **options)
    return adjustment


def test_residuals_are_projected_minus_measured():
    Ts, uv = views()
    block = linearised(TRUE, Ts[:, :3, :3], Ts[:, :3, 3], p_board=P, uv=uv)
    expected = np.stack([project(P, T, boards.K_TRUE, LENS) for T in Ts]) - uv
    np.testing.assert_allclose(
        block[:, 15], np.concatenate([expected[..., 0], expected[..., 1]], axis=1), atol=1e-9
    )


@pytest.mark.parametrize("row", range(15))
def test_slopes_are_those_of_differences(row):
    Ts, uv = views(1, 2)
    R = Ts[:, :3, :3]
    t = Ts[:, :3, 3]
    h = 1e-6 * (100 if row < 4 else 1)

    def residuals(step: float) -> np.ndarray:
        x = step * np.eye(15)[row]
        moved = turns(np.tile(x[9:12], (2, 1))) @ R, t + x[12:]
        return linearised(TRUE + x[:9], *moved, p_board=P, uv=uv)[:, 15]

    slope = (residuals(h) - residuals(-h)) / (2 * h)
    derivative = linearised(TRUE, R, t, p_board=P, uv=uv)[:, row]
    np.testing.assert_allclose(derivative, slope, atol=1e-6 * max(np.abs(slope).max(), 1.0))


@pytest.mark.parametrize("coefficients", [0, 1, 2, 4, 5])
def test_it_comes_home_and_the_cost_never_rises(coefficients):
    lens = Distortion(*[value if i < coefficients else 0.0 for i, value in enumerate(LENS)])
    Ts, _ = views()
    uv = np.stack([project(P, T, boards.K_TRUE, lens) for T in Ts])
    start = np.stack(
        [
            T @ np.block([[exp_so3(np.full(3, 0.02)), np.zeros((3, 1))], [np.zeros(3), 1]])
            for T in Ts
        ]
    )
    states = list(
        adjust(
            intrinsics(560.0, 330, 240), NONE, start, p_board=P, uv=uv, coefficients=coefficients
        )
    )
    assert states[-1].stop in (Stop.CONVERGED, Stop.STUCK)
    np.testing.assert_allclose(states[-1].K, boards.K_TRUE, atol=1e-5)
    np.testing.assert_allclose(states[-1].lens, lens, atol=1e-6)
    np.testing.assert_allclose(states[-1].Ts_camera_board, Ts, atol=1e-7)
    assert (np.diff([state.cost for state in states]) <= 0).all()
    assert states[-1].deviations[4 + coefficients :].tolist() == [0.0] * (5 - coefficients)
    for before, state in pairwise(states):
        assert state.accepted == (state.cost < before.cost)


def test_the_covariance_is_that_of_all_unknowns_and_of_repetition():
    Ts, uv = views(2, 4)
    adjustment = last_of(uv, Ts)
    assert adjustment.covariance is not None
    block = linearised(
        np.array([*adjustment.K[[0, 1, 0, 1], [0, 1, 2, 2]], *adjustment.lens]),
        adjustment.Ts_camera_board[:, :3, :3],
        adjustment.Ts_camera_board[:, :3, 3],
        p_board=P,
        uv=uv,
    )
    J = np.zeros((uv.size, 9 + 24))
    for k in range(4):
        rows = slice(108 * k, 108 * (k + 1))
        J[rows, :9] = block[k, :9].T
        J[rows, 9 + 6 * k : 15 + 6 * k] = block[k, 9:15].T
    variance = adjustment.cost / (uv.size - 33)
    dense = variance * np.linalg.inv(J.T @ J)[:9, :9]
    np.testing.assert_allclose(adjustment.deviations, np.sqrt(np.diag(dense)), rtol=1e-4)
    clean = np.stack([project(P, T, boards.K_TRUE, LENS) for T in Ts])
    rng = np.random.default_rng(0)
    f = [
        last_of(clean + 0.2 * rng.standard_normal(clean.shape), Ts, tolerance=1e-6).K[0, 0]
        for _ in range(40)
    ]
    assert np.std(f) == pytest.approx(adjustment.deviations[0], rel=0.35)


def test_cauchy_is_scipys_loss_and_lets_far_corners_go():
    Ts, uv = views(3)
    uv[1, [0, 9, 18]] += [40.0, 30.0]
    plain = last_of(uv, Ts)
    robust = last_of(uv, Ts, corner=0.5)
    clean = np.delete(np.arange(54), [0, 9, 18])
    assert np.abs(plain.residuals[1, clean]).max() > 5
    assert np.abs(robust.residuals[1, clean]).max() < 1.5
    assert robust.weights[1, [0, 9, 18]].max() < 1e-3
    e2 = (robust.residuals**2).sum(axis=2)
    assert robust.cost == pytest.approx(0.25 * np.log1p(e2 / 0.25).sum())
    slope = scipy.optimize.approx_fprime(
        e2.ravel()[:3], lambda x: 0.25 * np.log1p(x / 0.25).sum(), 1e-7
    )
    np.testing.assert_allclose(robust.weights.ravel()[:3], slope, atol=1e-5)
    block = linearised(TRUE, Ts[:, :3, :3], Ts[:, :3, 3], p_board=P, uv=uv)
    cost, weights = loss(block, None)
    assert cost == pytest.approx((block[:, 15] ** 2).sum())
    assert (weights == 1).all()


def test_what_the_views_do_not_determine_has_no_covariance_or_a_huge_one():
    T = np.stack([np.eye(4)] * 2)
    # two boards, both frontal: f is anybody's guess
    T[:, :3, 3] = [[-0.1, -0.06, 0.4], [-0.1, -0.06, 0.6]]
    uv = np.stack([project(P, T_camera_board, boards.K_TRUE) for T_camera_board in T])
    uv += 0.2 * np.random.default_rng(0).standard_normal(uv.shape)
    adjustment = last_of(uv, T, coefficients=0, max_iterations=30)
    assert not adjustment.deviations[0] < 100


def test_a_start_from_which_nothing_can_be_projected_stops():
    Ts, uv = views()
    Ts[:, 2, 3] = 0.0
    adjustment = last_of(uv, Ts, max_iterations=3)
    assert adjustment.stop is Stop.MAX_ITERATIONS
    assert not adjustment.accepted


# two real cameras ---------------------------------------------------------------------------------


@pytest.fixture(scope="module", params=["left", "right"])
def real(request, shared_data: Path) -> tuple[str, np.ndarray, np.ndarray]:
    arrays = np.load(shared_data / "calibration" / "corners_9x6.npz")
    return request.param, arrays["object_points"].astype(float), arrays[request.param].astype(float)


def test_equals_opencv_on_real_cameras(real):
    cv2 = pytest.importorskip("cv2", reason="opencv-python-headless is not installed")
    _, p, uv = real
    *_, state = calibrate(p, uv, (640, 480))
    adjustment = state.adjustment
    assert adjustment is not None
    theirs = cv2.calibrateCameraExtended(
        [p.astype(np.float32)] * len(uv),
        [pixels.astype(np.float32)[:, None] for pixels in uv],
        (640, 480),
        None,
        None,
    )
    assert np.sqrt(adjustment.cost / (uv.size / 2)) == pytest.approx(theirs[0], abs=1e-4)
    np.testing.assert_allclose(adjustment.K, theirs[1], atol=1e-3)
    np.testing.assert_allclose(adjustment.lens, theirs[2].ravel()[:5], atol=1e-5)
    np.testing.assert_allclose(adjustment.deviations, theirs[5].ravel()[:9], atol=1e-3)
    per_view = np.sqrt((adjustment.residuals**2).sum(axis=2).mean(axis=1))
    np.testing.assert_allclose(per_view, theirs[7].ravel(), atol=1e-4)


def test_what_is_known_of_the_real_cameras(real):
    name, p, uv = real
    states = [state for state in calibrate(p, uv, (640, 480)) if state.adjustment is not None]
    adjustment = states[-1].adjustment
    assert adjustment is not None
    rms = np.sqrt(adjustment.cost / (uv.size / 2))
    rejected = sum(not s.adjustment.accepted for s in states if s.adjustment)
    if name == "left":
        assert rms == pytest.approx(0.40877, abs=1e-5)
        assert dict(zip(SHARED, adjustment.deviations, strict=True))["fx"] == pytest.approx(
            0.93, abs=0.01
        )
        # left_intrinsics.yml, which has fx = fy
        assert adjustment.K[0, 0] == pytest.approx(535.9, abs=0.5)
        np.testing.assert_allclose(adjustment.K[:2, 2], [342.3, 235.6], atol=0.3)
    else:
        assert rms == pytest.approx(0.4587, abs=1e-4)
        assert rejected == 3
