import numpy as np
import pytest

from tests.geometry.views import view
from workbench.algorithms.camera_model import camera_model
from workbench.algorithms.ransac import Judge, Stop, iterations_needed, ransac
from workbench.algorithms.samplers import uniform_samples
from workbench.geometry.alignment import degrees_between
from workbench.geometry.cameras import intrinsics
from workbench.geometry.motions import exp_se3

K = intrinsics(800.0, 320.0, 240.0)


def rows(seed: int, outliers: float, n: int = 100) -> tuple[np.ndarray, np.ndarray]:
    T, p_world, xy = view(seed, n, sigma=1 / 800)
    rng = np.random.default_rng(seed + 1000)
    wrong = int(outliers * n)
    xy[:wrong] = rng.uniform([-0.4, -0.3], [0.4, 0.3], (wrong, 2))
    return T, np.column_stack([p_world, 800 * xy + [320, 240]])


@pytest.mark.parametrize(("outliers", "seeds"), [(0.3, 3), (0.7, 1)])
def test_ransac_finds_the_camera_among_outliers(outliers, seeds):
    for seed in range(seeds):
        T, table = rows(seed, outliers)
        model = camera_model(K)
        samples = uniform_samples(len(table), model.sample_size, np.random.default_rng(seed))
        *_, last = ransac(table, model, samples, Judge(table, model, 3.0))
        assert last.stop is Stop.ENOUGH
        assert last.best is not None
        assert degrees_between(last.best.estimate, T) < 0.5
        assert last.best.inliers[: int(100 * outliers)].sum() <= 2


def test_distances_are_pixels_and_infinite_behind():
    T, table = rows(0, 0.0, 10)
    model = camera_model(K)
    assert np.median(model.distances(T, table)) == pytest.approx(1.2, abs=0.6)
    both = model.distances(np.stack([T, np.diag([-1.0, 1, -1, 1]) @ T]), table)
    assert both.shape == (2, 10)
    assert np.isinf(both[1]).all()


def test_a_refit_goes_down_from_its_start_and_without_one_from_sqpnp():
    T, table = rows(1, 0.0, 20)
    model = camera_model(K)
    start = exp_se3(np.array([0.1, -0.1, 0.2, 0.05, 0.02, -0.03])) @ T
    np.testing.assert_allclose(model.refit(table), model.refit(table, start=start), atol=1e-5)
    weights = np.r_[np.zeros(10), np.ones(10)]
    np.testing.assert_allclose(model.refit(table, weights, start), model.refit(table[10:], start=start), atol=1e-4)


def test_three_points_need_fewer_samples_than_six():
    assert [iterations_needed(0.5, size, 0.99) for size in (3, 6)] == [35, 293]
    assert [iterations_needed(0.3, size, 0.99) for size in (3, 6)] == [169, 6315]
