import numpy as np
import pytest
import scipy
from hypothesis import given, settings
from hypothesis import strategies as st

from workbench.geometry.shapes.circles_spheres import (
    circle_from_points,
    costs_of_centers,
    fit_sphere,
    sphere_distances,
    sphere_from_points,
)

seeds = st.integers(0, 2**32 - 1)
MINIMAL = {2: circle_from_points, 3: sphere_from_points}


def on_sphere(rng, count: int, sphere: np.ndarray) -> np.ndarray:
    v = rng.normal(size=(count, len(sphere) - 1))
    return sphere[:-1] + sphere[-1] * v / np.linalg.norm(v, axis=1, keepdims=True)


@pytest.mark.parametrize("d", [2, 3])
@settings(max_examples=40, deadline=None)
@given(seed=seeds)
def test_the_minimal_fit_recovers_the_sphere(d, seed):
    rng = np.random.default_rng(seed)
    sphere = np.append(rng.normal(size=d), rng.uniform(0.1, 3.0))
    p = on_sphere(rng, d + 1, sphere)
    fitted = MINIMAL[d](p)
    if np.isnan(fitted).any():  # four points of a sphere can happen to lie nearly in one plane
        return
    np.testing.assert_allclose(sphere_distances(fitted, p), 0.0, atol=1e-6 * max(1.0, fitted[-1]))


def test_a_known_circle_and_sphere():
    np.testing.assert_allclose(
        circle_from_points(np.array([[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0]])), [0, 0, 1]
    )
    four = np.array([[1.0, 0, 0], [-1.0, 0, 0], [0, 1.0, 0], [0, 0, 1.0]]) * 2 + [1.0, 2.0, 3.0]
    np.testing.assert_allclose(sphere_from_points(four), [1, 2, 3, 2])


@pytest.mark.parametrize("d", [2, 3])
def test_many_samples_give_what_each_gives_alone(d):
    p = np.random.default_rng(0).normal(size=(6, d + 1, d))
    np.testing.assert_array_equal(MINIMAL[d](p)[4], MINIMAL[d](p[4]))


def test_degenerate_samples_have_no_answer():
    assert np.isnan(circle_from_points(np.array([[0.0, 0.0], [1.0, 1.0], [2.0, 2.0]]))).all()
    assert np.isnan(circle_from_points(np.ones((3, 2)))).all()
    flat = np.array([[0.0, 0, 5], [1.0, 0, 5], [0, 1.0, 5], [1.0, 1.0, 5]])
    assert np.isnan(sphere_from_points(flat)).all()


def test_distances_are_negative_inside():
    np.testing.assert_allclose(
        sphere_distances(np.array([0.0, 0.0, 2.0]), np.array([[0.0, 0.0], [3.0, 0.0], [0.0, 2.0]])),
        [-2, 1, 0],
    )


@pytest.mark.parametrize("d", [2, 3])
def test_the_fit_is_exact_on_a_short_arc_without_noise(d):
    rng = np.random.default_rng(3)
    sphere = np.append(np.full(d, 1e4), 2.0)
    p = on_sphere(rng, 4000, sphere)
    arc = p[p[:, 0] > sphere[0] + 1.9]
    np.testing.assert_allclose(fit_sphere(arc), sphere, atol=1e-6)


@settings(max_examples=15, deadline=None)
@given(seed=seeds, d=st.sampled_from([2, 3]))
def test_the_fit_is_the_geometric_optimum(seed, d):
    rng = np.random.default_rng(seed)
    p = on_sphere(rng, 40, np.append(rng.normal(size=d), 1.0)) + 0.05 * rng.normal(size=(40, d))
    weights = rng.random(40) + 0.1
    fitted = fit_sphere(p, weights)
    oracle = scipy.optimize.least_squares(
        lambda s: np.sqrt(weights) * sphere_distances(s, p), fitted + 0.01
    )
    np.testing.assert_allclose(fitted, oracle.x, atol=1e-4)


def test_the_geometric_fit_beats_the_algebraic_one_on_a_noisy_arc():
    radii = []
    for seed in range(20):
        rng = np.random.default_rng(seed)
        angle = rng.uniform(0.0, 1.0, 60)
        p = np.column_stack([np.cos(angle), np.sin(angle)]) + 0.02 * rng.normal(size=(60, 2))
        rows = np.column_stack([2 * p, np.ones(60)])
        x, y, k = np.linalg.lstsq(rows, np.square(p).sum(1), rcond=None)[0]
        radii.append((np.sqrt(k + x * x + y * y), fit_sphere(p)[-1]))
    algebraic, geometric = np.median(radii, axis=0)
    assert abs(geometric - 1.0) < 0.5 * abs(algebraic - 1.0)


def test_a_start_is_refined_to_the_same_optimum():
    p = on_sphere(np.random.default_rng(4), 50, np.array([1.0, 2.0, 3.0])) + 0.01
    np.testing.assert_allclose(
        fit_sphere(p, start=np.array([1.2, 1.9, 2.5])), fit_sphere(p), atol=1e-6
    )


def test_too_few_points_are_refused():
    with pytest.raises(ValueError, match="3 points"):
        fit_sphere(np.zeros((2, 2)))


@pytest.mark.parametrize("d", [2, 3])
def test_the_cost_of_a_centre_is_that_of_its_best_radius(d):
    rng = np.random.default_rng(0)
    p = rng.normal(size=(30, d))
    centers = 3 * rng.normal(size=(50, d))
    for center, cost in zip(centers, costs_of_centers(p, centers), strict=True):
        ways = np.linalg.norm(p - center, axis=1)
        best = scipy.optimize.minimize_scalar(lambda r, ways=ways: np.square(ways - r).sum())
        assert cost == pytest.approx(best.fun, rel=1e-9)
    sphere = fit_sphere(p)
    least = np.square(sphere_distances(sphere, p)).sum()
    near = sphere[:-1] + 1e-3 * rng.normal(size=(20, d))
    assert costs_of_centers(p, sphere[None, :-1])[0] == pytest.approx(least, rel=1e-9)
    assert (costs_of_centers(p, near) >= least).all()
    round_about = on_sphere(rng, 20, np.array([*np.ones(d), 2.0]))
    assert costs_of_centers(round_about, np.ones((1, d)))[0] == pytest.approx(0, abs=1e-12)
