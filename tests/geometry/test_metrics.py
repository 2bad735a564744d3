"""Distances in a space: axioms by hypothesis, scipy beside them, Mahalanobis and its robust
covariance.
"""

import numpy as np
import pytest
import scipy
from hypothesis import given, settings
from hypothesis import strategies as st

from workbench.geometry.points import metrics

METRICS = (
    ("euclid", 2),
    ("manhattan", 2),
    ("chebyshev", 2),
    ("p", 1.5),
    ("p", 6),
    ("p-sum", 0.5),
    ("mahalanobis", 2),
)
C = np.array([[1.0, 0.9], [0.9, 1.0]])


def some(seed, count=60, dims=2):
    return np.random.default_rng(seed).normal(size=(3, count, dims))


@settings(deadline=None, max_examples=20)
@given(st.integers(0, 10_000), st.sampled_from(METRICS))
def test_metrics_keep_the_axioms(seed, which):
    d = metrics.distance_of(which[0], order=which[1], covariance=C)
    a, b, c = some(seed)
    excess, sides = metrics.triangle_excess(d, a, b, c=c)
    assert (excess <= 1e-9 * sides.max()).all()
    np.testing.assert_allclose(d(a, b), d(b, a))
    assert (d(a, a) == 0).all()
    assert (d(a, b) > 0).all()


@pytest.mark.parametrize(
    ("metric", "order", "share"),
    [("squared", 2, 0.242), ("cosine", 2, 0.337), ("p", 0.5, 0.156), ("p-sum", 2, 0.242)],
)
def test_shares_of_broken_triangles(metric, order, share):
    a, b, c = np.random.default_rng(0).random((3, 50_000, 2))
    excess, _ = metrics.triangle_excess(metrics.distance_of(metric, order=order), a, b, c=c)
    assert (excess > 1e-12).mean() == pytest.approx(share, abs=0.006)


def test_squares_break_it_where_the_angle_at_b_is_obtuse():
    a, b, c = some(3, 500)
    excess, _ = metrics.triangle_excess(metrics.distance_of("squared"), a, b, c=c)
    # the law of cosines
    np.testing.assert_allclose(excess, -2 * ((a - b) * (c - b)).sum(axis=1), atol=1e-9)


@pytest.mark.parametrize(
    ("metric", "theirs"),
    [
        ("euclid", "euclidean"),
        ("manhattan", "cityblock"),
        ("chebyshev", "chebyshev"),
        ("squared", "sqeuclidean"),
        ("cosine", "cosine"),
    ],
)
def test_scipy_agrees(metric, theirs):
    a, b, _ = some(1, 20, 4)
    distances = metrics.distance_of(metric)(a[:, None], b[None])
    np.testing.assert_allclose(distances, scipy.spatial.distance.cdist(a, b, theirs), atol=1e-12)
    minkowski = metrics.distance_of("p", order=3.0)(a[:, None], b[None])
    np.testing.assert_allclose(minkowski, scipy.spatial.distance.cdist(a, b, "minkowski", p=3.0))


def test_a_vector_without_length_has_the_cosine_distance_one():
    assert metrics.cosine_distance(np.zeros((1, 2)), np.ones((1, 2))).tolist() == [1.0]


def test_without_a_covariance_mahalanobis_is_euclid():
    a, b, _ = some(2)
    np.testing.assert_allclose(
        metrics.distance_of("mahalanobis")(a, b), np.linalg.norm(a - b, axis=1)
    )


# Mahalanobis --------------------------------------------------------------------------------------


@settings(deadline=None, max_examples=20)
@given(st.integers(0, 10_000), st.integers(1, 6))
def test_mahalanobis_beside_scipy_and_under_any_change_of_units(seed, dims):
    rng = np.random.default_rng(seed)
    A = rng.normal(size=(dims, dims))
    p = rng.normal(size=(9, dims))
    mean = rng.normal(size=dims)
    S = A @ A.T + 0.1 * np.eye(dims)
    distances = metrics.mahalanobis(p, mean, S)
    inverse = np.linalg.inv(S)
    np.testing.assert_allclose(
        distances, [scipy.spatial.distance.mahalanobis(x, mean, inverse) for x in p], rtol=1e-6
    )
    B = rng.normal(size=(dims, dims)) + 3 * np.eye(dims)
    np.testing.assert_allclose(
        metrics.mahalanobis(p @ B.T, B @ mean, B @ S @ B.T), distances, rtol=1e-6
    )
    W = metrics.whitening(S)
    np.testing.assert_allclose(W @ S @ W.T, np.eye(dims), atol=1e-9)


def test_no_variance_in_some_direction_is_refused():
    with pytest.raises(ValueError, match="not positive definite"):
        metrics.mahalanobis(np.ones((2, 2)), np.zeros(2), np.ones((2, 2)))


def test_chi_squared():
    assert [round(metrics.share_within(2, d), 3) for d in (1, 2, 3, 10)] == [
        0.954,
        0.865,
        0.739,
        0.053,
    ]
    assert metrics.radius_of_share(0.95, 2) == pytest.approx(2.4477, abs=1e-4)
    assert metrics.share_within(metrics.radius_of_share(0.7, 5), 5) == pytest.approx(0.7)


@pytest.mark.parametrize("n", [5, 10, 20])
def test_no_point_of_n_is_farther_than_this(n):
    p = np.random.default_rng(n).normal(size=(n, 2))
    p[0] = [1e6, 0]
    d = metrics.mahalanobis(p, *metrics.mean_and_covariance(p))
    assert d.max() == pytest.approx((n - 1) / np.sqrt(n), rel=1e-4)


def test_mean_and_covariance_are_numpys():
    p = some(5, 30, 3)[0]
    mean, S = metrics.mean_and_covariance(p)
    np.testing.assert_allclose(mean, p.mean(axis=0))
    np.testing.assert_allclose(S, np.cov(p.T))


def masked(seed, outliers=40):
    rng = np.random.default_rng(seed)
    good = rng.multivariate_normal([0, 0], C, 200)
    return good, np.array([2.0, -2.0]) + 0.1 * rng.normal(size=(outliers, 2)), rng


@pytest.mark.parametrize("seed", range(4))
def test_outliers_hide_in_the_sample_covariance_and_not_in_the_robust_one(seed):
    good, bad, rng = masked(seed)
    p = np.concatenate([good, bad])
    sample = metrics.mahalanobis(bad, *metrics.mean_and_covariance(p))
    robust = metrics.mahalanobis(bad, *metrics.robust_mean_and_covariance(p, rng))
    clean = metrics.mahalanobis(bad, *metrics.mean_and_covariance(good))
    assert (sample < 2.448).mean() > 0.9
    assert sample.mean() == pytest.approx(2.15, abs=0.08)
    assert 0.85 < robust.mean() / clean.mean() < 1.3
    assert robust.min() > 6


def test_the_robust_covariance_of_a_clean_scatter_is_the_sample_one_nearly():
    p = np.random.default_rng(0).multivariate_normal([1, 2], C, 2000)
    mean, S = metrics.robust_mean_and_covariance(p, np.random.default_rng(1))
    np.testing.assert_allclose(mean, [1, 2], atol=0.08)
    np.testing.assert_allclose(S, C, atol=0.12)


def test_the_robust_covariance_moves_with_the_points():
    good, bad, _ = masked(9)
    p = np.concatenate([good, bad])
    A = np.array([[2.0, 0.3], [0.0, 0.5]])
    t = np.array([10.0, -3.0])
    mean, S = metrics.robust_mean_and_covariance(p, np.random.default_rng(2))
    moved, T = metrics.robust_mean_and_covariance(p @ A.T + t, np.random.default_rng(2))
    np.testing.assert_allclose(moved, A @ mean + t, atol=1e-6)
    np.testing.assert_allclose(T, A @ S @ A.T, atol=1e-6)


def test_half_of_the_points_on_a_line_are_refused():
    p = np.column_stack([np.arange(20.0), np.zeros(20)])
    p[15:, 1] = 1.0
    with pytest.raises(ValueError, match="hyperplane"):
        metrics.robust_mean_and_covariance(p, np.random.default_rng(0))
