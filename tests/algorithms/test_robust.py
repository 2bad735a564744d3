import numpy as np
import pytest
import scipy
from hypothesis import given, settings
from hypothesis import strategies as st

from lessons.ransac.robust_scenes import line_scene, plane_scene
from workbench.algorithms.robust import (
    HUBER,
    LOSSES,
    Settled,
    cascade,
    huber_loss,
    huber_weights,
    reweighted_fit,
)
from workbench.algorithms.robust.models import LINE, PLANE, rms_distance


def test_a_cascade_goes_on_from_where_the_loss_before_ended():
    scene = plane_scene(np.random.default_rng(3), count=300, outlier_ratio=0.45, sigma=0.01)
    huber, tukey = LOSSES["Huber"], LOSSES["Tukey"]
    rounds = list(
        cascade(scene.p, PLANE, [(huber, 0.02), (tukey, 0.05)], max_iterations=60, tolerance=1e-3)
    )
    alone = list(
        reweighted_fit(scene.p, PLANE, huber, corner=0.02, max_iterations=60, tolerance=1e-3)
    )
    split = sum(trusted.loss is huber for trusted in rounds)
    assert split == len(alone)
    np.testing.assert_array_equal(rounds[split - 1].now.estimate, alone[-1].estimate)
    then = list(
        reweighted_fit(
            scene.p,
            PLANE,
            tukey,
            corner=0.05,
            start=alone[-1].estimate,
            max_iterations=60,
            tolerance=1e-3,
        )
    )
    assert [trusted.now.iteration for trusted in rounds[split:]] == [
        state.iteration for state in then[1:]
    ]
    np.testing.assert_array_equal(rounds[-1].now.estimate, then[-1].estimate)
    assert [trusted.last for trusted in rounds] == [False] * (len(rounds) - 1) + [True]
    assert all(np.array_equal(trusted.first, alone[0].estimate) for trusted in rounds)


@settings(max_examples=50, deadline=None)
@given(distance=st.floats(0.001, 10), corner=st.floats(0.01, 5))
def test_the_weights_give_least_squares_the_slope_of_the_loss(distance, corner):
    d = np.array([distance])
    h = 1e-6 * distance
    slope = (huber_loss(d + h, corner) - huber_loss(d - h, corner)) / (2 * h)
    np.testing.assert_allclose(huber_weights(d, corner) * d, slope, rtol=1e-4)


@settings(max_examples=10, deadline=None)
@given(seed=st.integers(0, 1000))
def test_the_cost_never_rises_and_it_settles(seed):
    scene = plane_scene(np.random.default_rng(seed), count=200, outlier_ratio=0.3, sigma=0.01)
    states = list(reweighted_fit(scene.p, PLANE, HUBER, corner=0.03, max_iterations=300))
    assert (np.diff([state.cost for state in states]) <= 1e-9).all()
    assert states[-1].stop is Settled.CONVERGED
    assert states[-1].stop.message
    assert all(state.stop is None for state in states[:-1])
    assert [state.iteration for state in states] == list(range(len(states)))


def test_it_ends_at_the_minimum_of_hubers_loss():
    scene = line_scene(np.random.default_rng(1), count=100, outlier_ratio=0.2, sigma=0.02)
    *_, end = reweighted_fit(scene.p, LINE, HUBER, corner=0.04, tolerance=1e-8, max_iterations=500)

    def cost(x):
        line = np.array([np.cos(x[0]), np.sin(x[0]), x[1]])
        return huber_loss(LINE.distances(line, scene.p), 0.04).sum()

    start = [np.arctan2(end.estimate[1], end.estimate[0]), end.estimate[2]]
    oracle = scipy.optimize.minimize(
        cost, start, method="Nelder-Mead", options={"xatol": 1e-9, "fatol": 1e-12}
    )
    assert end.cost == pytest.approx(oracle.fun, rel=1e-6)


def test_without_outliers_it_stays_at_least_squares():
    scene = plane_scene(np.random.default_rng(2), count=200, outlier_ratio=0.0, sigma=0.01)
    *_, end = reweighted_fit(scene.p, PLANE, HUBER, corner=1.0)
    assert end.iteration == 1
    np.testing.assert_allclose(end.estimate, PLANE.refit(scene.p), atol=1e-12)


def test_huber_lies_between_least_squares_and_a_fit_to_the_inliers():
    errors = []
    for seed in range(10):
        scene = plane_scene(np.random.default_rng(seed), count=400, outlier_ratio=0.3, sigma=0.01)
        *_, end = reweighted_fit(scene.p, PLANE, HUBER, corner=0.02)
        fits = PLANE.refit(scene.p), end.estimate, PLANE.refit(scene.p[scene.is_inlier])
        errors.append([rms_distance(PLANE, fit, scene.p_true) for fit in fits])
    squares, huber, clean = np.median(errors, axis=0)
    assert clean < 0.1 * huber < 0.05 * squares


def test_one_round_only_says_so():
    scene = plane_scene(np.random.default_rng(0), count=200, outlier_ratio=0.5, sigma=0.01)
    *_, end = reweighted_fit(scene.p, PLANE, HUBER, corner=0.02, max_iterations=1)
    assert end.stop is Settled.MAX_ITERATIONS


@pytest.mark.parametrize("loss", LOSSES.values(), ids=LOSSES)
@settings(max_examples=25, deadline=None)
@given(distance=st.floats(-10, 10), corner=st.floats(0.05, 5))
def test_all_weights_are_slopes_divided_by_distances(loss, distance, corner):
    r = np.array([distance])
    h = 1e-5
    slope = (loss.cost(r + h, corner) - loss.cost(r - h, corner)) / (2 * h)
    np.testing.assert_allclose(loss.weights(r, corner) * r, slope, atol=1e-4)


@pytest.mark.parametrize("loss", LOSSES.values(), ids=LOSSES)
def test_efficient_corners_cost_five_per_cent(loss):
    """Asymptotic efficiency at normal errors, (E ψ')² / E ψ², by sums; Holland and Welsch 1977,
    table 1.
    """
    x = np.linspace(-8, 8, 20_001)
    density = np.exp(-(x**2) / 2) / np.sqrt(2 * np.pi) * (x[1] - x[0])
    corner = loss.efficient_corner if np.isfinite(loss.efficient_corner) else 1.0
    pull = loss.weights(x, corner) * x
    efficiency = (pull * x * density).sum() ** 2 / (pull**2 * density).sum()
    assert efficiency == pytest.approx(1.0 if loss.name == "squares" else 0.95, abs=2e-4)


def test_tukey_ends_where_it_starts():
    scene = plane_scene(np.random.default_rng(0), count=300, outlier_ratio=0.5, sigma=0.01)
    errors = []
    for start in (None, PLANE.refit(scene.p[scene.is_inlier])):
        *_, end = reweighted_fit(scene.p, PLANE, LOSSES["Tukey"], corner=0.05, start=start)
        errors.append(rms_distance(PLANE, end.estimate, scene.p_true))
    assert errors[1] < 0.005 < 0.05 < errors[0]
