import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from workbench.geometry.motions import exp_so3
from workbench.geometry.shapes.lines_planes import (
    angle_between_planes,
    fit_hyperplane,
    fit_hyperplanes,
    hyperplane_distances,
    line_from_points,
    plane_from_points,
)

seeds = st.integers(0, 2**32 - 1)
MINIMAL = {2: line_from_points, 3: plane_from_points}


@pytest.mark.parametrize("d", [2, 3])
@settings(max_examples=40, deadline=None)
@given(seed=seeds)
def test_the_minimal_fit_passes_through_its_points(d, seed):
    p = np.random.default_rng(seed).normal(size=(d, d))
    hyperplane = MINIMAL[d](p)
    assert np.linalg.norm(hyperplane[:-1]) == pytest.approx(1.0)
    np.testing.assert_allclose(hyperplane_distances(hyperplane, p), 0.0, atol=1e-9)


def test_the_normal_follows_the_turn_of_the_points():
    np.testing.assert_allclose(
        plane_from_points(np.array([[0.0, 0.0, 2.0], [1.0, 0.0, 2.0], [0.0, 1.0, 2.0]])),
        [0, 0, 1, -2],
    )
    np.testing.assert_allclose(line_from_points(np.array([[0.0, 3.0], [1.0, 3.0]])), [0, 1, -3])


@pytest.mark.parametrize("d", [2, 3])
def test_many_samples_give_what_each_gives_alone(d):
    p = np.random.default_rng(0).normal(size=(4, 5, d, d))
    together = MINIMAL[d](p)
    assert together.shape == (4, 5, d + 1)
    np.testing.assert_array_equal(together[2, 3], MINIMAL[d](p[2, 3]))


@settings(max_examples=40, deadline=None)
@given(seed=seeds)
def test_a_plane_moves_with_its_points(seed):
    rng = np.random.default_rng(seed)
    p = rng.normal(size=(3, 3))
    R = exp_so3(rng.normal(size=3))
    t = rng.normal(size=3)
    before = plane_from_points(p)
    after = plane_from_points(p @ R.T + t)
    np.testing.assert_allclose(after[:3], R @ before[:3], atol=1e-7)
    assert after[3] == pytest.approx(before[3] - R @ before[:3] @ t, abs=1e-6)


@pytest.mark.parametrize(
    "p",
    [
        np.ones((3, 3)),
        np.array([[0.0, 0.0, 0.0], [1.0, 2.0, 3.0], [2.0, 4.0, 6.0]]),
        np.array([[0.0, 0.0, 0.0], [1.0, 2.0, 3.0], [1.0, 2.0, 3.0]]),
        np.array([[1e6, 1e6, 0.0], [1e6 + 1, 1e6, 0.0], [1e6 + 2, 1e6, 0.0]]),
    ],
)
def test_three_points_on_one_line_have_no_plane(p):
    assert np.isnan(plane_from_points(p)).all()


def test_two_equal_points_have_no_line():
    assert np.isnan(line_from_points(np.full((2, 2), 7.0))).all()


def test_a_small_or_a_far_triangle_is_not_degenerate():
    triangle = np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
    for p in (1e-9 * triangle, triangle + 1e6):
        np.testing.assert_allclose(plane_from_points(p)[:3], [0, 0, 1], atol=1e-9)


@settings(max_examples=30, deadline=None)
@given(seed=seeds, d=st.sampled_from([2, 3]))
def test_no_small_change_betters_the_least_squares_fit(seed, d):
    rng = np.random.default_rng(seed)
    p = rng.normal(size=(20, d)) * np.linspace(0.2, 1.0, d)
    weights = rng.random(20)
    best = fit_hyperplane(p, weights)
    cost = weights @ hyperplane_distances(best, p) ** 2
    for _ in range(10):
        other = best + 1e-3 * rng.normal(size=d + 1)
        other /= np.linalg.norm(other[:-1])
        assert weights @ hyperplane_distances(other, p) ** 2 >= cost * (1 - 1e-12)


def test_the_fit_equals_the_smallest_principal_direction_and_minimal_fit():
    rng = np.random.default_rng(1)
    p = rng.normal(size=(30, 3)) * [1.0, 0.7, 0.1] + 1e5
    normal = np.linalg.svd(p - p.mean(0))[2][-1]
    assert abs(fit_hyperplane(p)[:3] @ normal) == pytest.approx(1.0)
    three = rng.normal(size=(3, 3))
    assert angle_between_planes(fit_hyperplane(three), plane_from_points(three)) == pytest.approx(
        0.0, abs=1e-7
    )


def test_weight_zero_is_absence_and_weight_two_is_twice():
    rng = np.random.default_rng(2)
    p = rng.normal(size=(12, 3))
    weights = np.array([0.0] * 2 + [1.0] * 5 + [2.0] * 5)
    repeated = np.concatenate([p[2:7], p[7:], p[7:]])
    np.testing.assert_allclose(fit_hyperplane(p, weights), fit_hyperplane(repeated), atol=1e-12)


@pytest.mark.parametrize("d", [2, 3])
def test_many_weights_give_what_each_gives_alone(d):
    rng = np.random.default_rng(4)
    p = rng.normal(size=(40, d)) * np.array([1.0, 1.0, 0.01])[-d:] + 1e3
    weights = rng.random((6, 40))
    weights[1] = weights[1] > 0.5
    weights[2] = 0.0
    weights[2, : d - 1] = 1.0
    together = fit_hyperplanes(p, weights)
    assert np.isnan(together[2]).all()
    for k in (0, 1, 3, 4, 5):
        np.testing.assert_allclose(together[k], fit_hyperplane(p, weights[k]), rtol=1e-9)
    np.testing.assert_allclose(fit_hyperplanes(p, weights[1:2] > 0), together[1:2], rtol=1e-12)


def test_too_few_points_are_refused():
    with pytest.raises(ValueError, match="3 points"):
        fit_hyperplane(np.zeros((2, 3)))
    with pytest.raises(ValueError, match="got 2"):
        fit_hyperplane(np.zeros((5, 3)), np.array([1.0, 1.0, 0.0, 0.0, 0.0]))


@settings(max_examples=30, deadline=None)
@given(angle=st.floats(0.0, np.pi / 2), seed=seeds)
def test_the_angle_between_planes_is_that_of_their_normals_without_sign(angle, seed):
    rng = np.random.default_rng(seed)
    n_a, axis = np.eye(3)[rng.permutation(3)[:2]]
    plane_a = np.append(n_a, 1.0)
    plane_b = np.append(exp_so3(angle * axis) @ n_a, 3.0)
    for sign in (1.0, -1.0):
        assert angle_between_planes(plane_a, sign * plane_b) == pytest.approx(angle, abs=1e-9)
