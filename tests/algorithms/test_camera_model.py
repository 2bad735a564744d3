from dataclasses import fields, replace
from itertools import islice, zip_longest
from typing import Any

import numpy as np
import pytest

from tests.geometry.views import view
from workbench.algorithms.robust.camera_model import camera_model
from workbench.algorithms.robust.ransac import (
    TOGETHER,
    Judge,
    State,
    Stop,
    iterations_needed,
    ransac,
)
from workbench.algorithms.robust.samplers import uniform_samples
from workbench.geometry.cameras import intrinsics
from workbench.geometry.motions import exp_se3
from workbench.geometry.motions.alignment import degrees_between

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
        *_, last = ransac(table, model, samples, judge=Judge(table, model, 3.0))
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
    np.testing.assert_allclose(
        model.refit(table, weights, start), model.refit(table[10:], start=start), atol=1e-4
    )


def values(state: State) -> list[Any]:
    """What a state and its fits hold."""
    held = (state, *(fit for fit in (state.trial, state.best) if fit))
    names = [(holder, field.name) for holder in held for field in fields(holder)]
    return [getattr(holder, name) for holder, name in names if name not in ("trial", "best")]


def alike(state: State, other: State) -> bool:
    """Whether two states hold the same, to the last bit."""
    return all(np.array_equal(a, b) for a, b in zip_longest(values(state), values(other)))


@pytest.mark.parametrize(
    ("seed", "outliers", "most"),
    [(0, 0.5, 500), (1, 0.7, 500), (2, 0.7, TOGETHER + 5), (3, 0.8, 20)],
)
def test_many_samples_solved_together_give_the_states_of_one_by_one(seed, outliers, most):
    _, table = rows(seed, outliers)
    # samples of three of these are degenerate
    table[:6, :3] = np.arange(6)[:, None] * [0.1, 0.2, 0.3]
    model = camera_model(K)
    runs = []
    for variant in (model, replace(model, solve_each=None)):
        chosen = [np.array([0, 1, 2]), np.array([50, 60, 70]), np.array([50, 60, 70])]
        drawn = uniform_samples(len(table), 3, np.random.default_rng(seed))
        samples = iter([*chosen, *islice(drawn, 600)])
        runs.append(
            list(
                ransac(
                    table, variant, samples, judge=Judge(table, variant, 3.0), max_iterations=most
                )
            )
        )
    together, apart = runs
    assert len(together) == len(apart) > 40
    assert together[1].phase == "degenerate"
    assert all(alike(a, b) for a, b in zip(together, apart, strict=True))
    assert not alike(together[0], together[1])


def test_samples_that_are_used_up_are_all_tried():
    _, table = rows(0, 0.9)
    for count in (1, TOGETHER, TOGETHER + 1):
        samples = islice(uniform_samples(len(table), 3, np.random.default_rng(0)), count)
        *_, last = ransac(
            table, camera_model(K), samples, judge=Judge(table, camera_model(K), 1e-9)
        )
        assert last.iteration == count
    *_, last = ransac(table, camera_model(K), iter([]), judge=Judge(table, camera_model(K), 1.0))
    assert (last.stop, last.iteration) == (Stop.NO_MODEL, 0)


def test_three_points_need_fewer_samples_than_six():
    assert [iterations_needed(0.5, size, 0.99) for size in (3, 6)] == [35, 293]
    assert [iterations_needed(0.3, size, 0.99) for size in (3, 6)] == [169, 6315]
