import numpy as np
import pytest
import scipy
from hypothesis import given, settings
from hypothesis import strategies as st

from workbench.algorithms.models import HOMOGRAPHY, LINE, PLANE, rms_distance
from workbench.algorithms.robust import Settled, huber_fit, huber_loss, huber_weights, mixture_fit
from workbench.algorithms.scores import inlier_distance_for
from workbench.data.robust import line_scene, match_scene, plane_scene


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
    states = list(huber_fit(scene.p, PLANE, corner=0.03, max_iterations=300))
    assert (np.diff([state.cost for state in states]) <= 1e-9).all()
    assert states[-1].stop is Settled.CONVERGED
    assert states[-1].stop.message
    assert all(state.stop is None for state in states[:-1])
    assert [state.iteration for state in states] == list(range(len(states)))


def test_it_ends_at_the_minimum_of_hubers_loss():
    scene = line_scene(np.random.default_rng(1), count=100, outlier_ratio=0.2, sigma=0.02)
    *_, end = huber_fit(scene.p, LINE, corner=0.04, tolerance=1e-8, max_iterations=500)

    def cost(x):
        line = np.array([np.cos(x[0]), np.sin(x[0]), x[1]])
        return huber_loss(LINE.distances(line, scene.p), 0.04).sum()

    start = [np.arctan2(end.estimate[1], end.estimate[0]), end.estimate[2]]
    oracle = scipy.optimize.minimize(cost, start, method="Nelder-Mead", options={"xatol": 1e-9, "fatol": 1e-12})
    assert end.cost == pytest.approx(oracle.fun, rel=1e-6)


def test_without_outliers_it_stays_at_least_squares():
    scene = plane_scene(np.random.default_rng(2), count=200, outlier_ratio=0.0, sigma=0.01)
    *_, end = huber_fit(scene.p, PLANE, corner=1.0)
    assert end.iteration == 1
    np.testing.assert_allclose(end.estimate, PLANE.refit(scene.p), atol=1e-12)


def test_huber_lies_between_least_squares_and_a_fit_to_the_inliers():
    errors = []
    for seed in range(10):
        scene = plane_scene(np.random.default_rng(seed), count=400, outlier_ratio=0.3, sigma=0.01)
        *_, end = huber_fit(scene.p, PLANE, corner=0.02)
        fits = PLANE.refit(scene.p), end.estimate, PLANE.refit(scene.p[scene.is_inlier])
        errors.append([rms_distance(PLANE, fit, scene.p_true) for fit in fits])
    squares, huber, clean = np.median(errors, axis=0)
    assert clean < 0.1 * huber < 0.05 * squares


def test_one_round_only_says_so():
    scene = plane_scene(np.random.default_rng(0), count=200, outlier_ratio=0.5, sigma=0.01)
    *_, end = huber_fit(scene.p, PLANE, corner=0.02, max_iterations=1)
    assert end.stop is Settled.MAX_ITERATIONS


def test_the_mixture_does_not_depend_on_the_inlier_distance():
    errors = {0.7: [], 1.0: [], 2.0: []}
    for seed in range(8):
        scene = match_scene(np.random.default_rng(seed), count=400, outlier_ratio=0.5, sigma=1.0, flat=True)
        oracle = HOMOGRAPHY.refit(scene.p[scene.is_inlier], start=scene.truth)
        best = rms_distance(HOMOGRAPHY, oracle, scene.p_true)
        for factor in errors:
            distance = factor * inlier_distance_for(np.sqrt(2.0), directions=2)
            found = mixture_fit(scene.p, HOMOGRAPHY, scene.truth, inlier_distance=distance, rounds=10)
            errors[factor].append(rms_distance(HOMOGRAPHY, found, scene.p_true) / best)
    for factor in errors:
        assert np.median(errors[factor]) < 1.1


def test_the_mixture_leaves_alone_what_it_cannot_better():
    p = np.random.default_rng(0).normal(size=(20, 3)) + np.array([0.0, 0.0, 100.0])
    floor = np.array([0.0, 0.0, 1.0, 0.0])
    np.testing.assert_array_equal(mixture_fit(p, PLANE, floor, inlier_distance=0.1), floor)


def test_a_second_plane_nearby_does_not_pull():
    rng = np.random.default_rng(0)
    floor = np.column_stack([rng.uniform(-1, 1, (300, 2)), 0.01 * rng.normal(size=300)])
    shelf = np.column_stack([rng.uniform(-1, 1, (150, 2)), 0.15 + 0.01 * rng.normal(size=150)])
    found = mixture_fit(
        np.concatenate([floor, shelf]), PLANE, np.array([0.0, 0.0, 1.0, 0.0]), inlier_distance=0.03, rounds=10
    )
    assert PLANE.distances(found, np.zeros((1, 3)))[0] < 0.002
