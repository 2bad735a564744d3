"""The steps of Zhang's calibration: what each holds, guesses, refusals, and real corners."""

import itertools
from pathlib import Path

import numpy as np
import pytest
import scipy

from workbench.algorithms.cameras.calibration import State, calibrate, residuals_of
from workbench.data.views import boards
from workbench.geometry.cameras import project
from workbench.geometry.cameras.calibration import reprojection_rms
from workbench.geometry.cameras.distortion import NONE

P = boards.board_points()


def states_of(uv: np.ndarray, **options) -> list[State]:
    return list(calibrate(P, uv, boards.SIZE, **options))


def views(tilt: float = 0.5, sigma: float = 0.0, lens=boards.LENS_TRUE) -> np.ndarray:
    rng = np.random.default_rng(0)
    Ts = boards.board_poses(rng, 4, tilt=tilt, distance=0.4, spread=1.0)
    uv = np.stack([project(P, T, boards.K_TRUE, lens) for T in Ts])
    return uv + sigma * rng.standard_normal(uv.shape)


def test_the_phases_in_their_order():
    states = states_of(views(sigma=0.1), coefficients=2)
    phases = [state.phase for state in states]
    assert phases[:7] == ["homography", *["constraints"] * 4, "poses", "lens"]
    assert set(phases[7:]) == {"refine"}
    assert [len(state.rows) for state in states[:6]] == [0, 2, 4, 6, 8, 8]
    assert [state.K is None for state in states[:3]] == [True, True, False]
    assert "lens" not in [state.phase for state in states_of(views(), coefficients=0)]


def test_without_a_lens_the_closed_form_is_exact():
    poses = next(state for state in states_of(views(lens=NONE)) if state.phase == "poses")
    assert poses.K is not None
    np.testing.assert_allclose(poses.K, boards.K_TRUE, atol=1e-6)
    assert reprojection_rms(poses.residuals.reshape(-1, 2)) < 1e-8


def test_residuals_are_those_of_project():
    uv = views()
    *_, last = states_of(uv)
    assert last.K is not None
    expected = np.stack([project(P, T, last.K, last.lens) for T in last.Ts_camera_board]) - uv
    np.testing.assert_allclose(
        residuals_of(last.K, last.lens, last.Ts_camera_board, p_board=P, uv=uv), expected, atol=1e-9
    )


def test_frontal_boards_give_no_camera_and_f_is_guessed():
    states = states_of(views(tilt=0.0, sigma=0.2), max_iterations=5)
    poses = next(state for state in states if state.phase == "poses")
    assert poses.guessed
    assert poses.K is not None
    assert poses.K[0, 0] == boards.SIZE[0]


@pytest.mark.parametrize(
    ("f", "cx", "likely"),
    [(500.0, 330.0, True), (500.0, 700.0, False), (500.0, -20.0, False), (150.0, 330.0, False)],
)
def test_an_unlikely_camera_is_not_begun_with(f, cx, likely):
    N = np.array([[1 / 640, 0, -0.5], [0, 1 / 640, -240 / 640], [0, 0, 1]])
    K = N @ np.array([[f, 0, cx], [0, f, 240], [0, 0, 1]])
    B = np.linalg.inv(K @ K.T)
    four = scipy.linalg.null_space(
        B[[0, 1, 0, 1, 2], [0, 1, 2, 2, 2]][None]
    ).T  # rows that this camera alone fulfils
    rows = np.insert(four, 1, 0.0, axis=1)
    given = itertools.cycle([rows[:2], rows[2:]])
    states = states_of(views(), constraint_rows=lambda H: next(given), max_iterations=1)
    poses = next(state for state in states if state.phase == "poses")
    assert poses.guessed != likely
    assert poses.K is not None
    assert poses.K[0, 0] == pytest.approx(f if likely else 640.0)


def test_a_replaced_function_drives_the_steps():
    states = states_of(views(), constraint_rows=lambda H: np.zeros((2, 6)), max_iterations=2)
    assert next(state for state in states if state.phase == "poses").guessed
    behind = states_of(
        views(),
        pose_from_homography=lambda K, H: np.diag([1.0, 1, 1, 1]) - np.eye(4, k=1)[[3, 0, 2, 1]],
    )
    assert behind[-1].phase == "refine"


def test_too_few_views_are_refused():
    with pytest.raises(ValueError, match="two views"):
        states_of(views()[:1])


# real corners -------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def left(shared_data: Path) -> tuple[np.ndarray, np.ndarray]:
    arrays = np.load(shared_data / "calibration" / "corners_9x6.npz")
    return arrays["object_points"].astype(float), arrays["left"].astype(float)


def f_of(p: np.ndarray, uv: np.ndarray, **options) -> tuple[float, float]:
    """f and the rms."""
    *_, last = calibrate(p, uv, (640, 480), **options)
    assert last.K is not None
    return float(last.K[0, 0]), reprojection_rms(last.residuals.reshape(-1, 2))


def test_the_linear_lens_of_real_corners_has_the_wrong_sign(left):
    states = list(calibrate(left[0], left[1], (640, 480), max_iterations=1))
    poses, lens = (next(s for s in states if s.phase == phase) for phase in ("poses", "lens"))
    assert states[0].residuals.shape == (1, 54, 2)
    assert reprojection_rms(states[0].residuals[0]) == pytest.approx(0.88, abs=0.01)
    assert lens.lens.k1 == pytest.approx(0.058, abs=0.01)
    assert reprojection_rms(poses.residuals.reshape(-1, 2)) == pytest.approx(2.86, abs=0.02)
    assert reprojection_rms(lens.residuals.reshape(-1, 2)) == pytest.approx(2.75, abs=0.02)


def test_one_bad_view_of_thirteen(left):
    p, uv = left
    *_, last = calibrate(p, uv, (640, 480))
    squares = (last.residuals**2).sum(axis=2)
    assert squares[1].sum() / squares.sum() == pytest.approx(0.685, abs=0.002)
    assert (squares[1] > 1).sum() == 13
    f, rms = f_of(p, np.delete(uv, 1, axis=0))
    assert (f, rms) == (pytest.approx(534.1, abs=0.1), pytest.approx(0.234, abs=0.001))
    assert f_of(p, uv, corner=0.3, coefficients=4)[0] == pytest.approx(533.8, abs=0.3)


def test_views_have_errors_of_their_own(left):
    """Over bootstrapped views f varies by half as much again as the covariance, which takes corners
    for independent.
    """
    p, uv = left
    rng = np.random.default_rng(0)
    f = [
        f_of(p, uv[rng.integers(0, 13, 13)], max_iterations=20, tolerance=1e-6)[0]
        for _ in range(25)
    ]
    assert 1.1 < np.std(f) < 1.9  # the covariance says 0.93
