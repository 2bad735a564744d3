import numpy as np
import pytest
import scipy
from hypothesis import given, settings
from hypothesis import strategies as st

from workbench.algorithms.robust.scores import count_score, mlesac_score, msac_score

distances = st.lists(st.floats(0, 10), min_size=1, max_size=30).map(np.array)


@settings(max_examples=50, deadline=None)
@given(distances=distances, limit=st.floats(0.1, 5))
def test_the_scores_by_their_definitions(distances, limit):
    assert count_score(distances, limit) == sum(d <= limit for d in distances)
    truncated = sum(min(d * d / limit**2, 1.0) for d in distances)
    assert msac_score(distances, limit) == pytest.approx(len(distances) - truncated)


@settings(max_examples=30, deadline=None)
@given(distances=distances, limit=st.floats(0.1, 5))
def test_nearer_points_never_score_less(distances, limit):
    for score in (count_score, msac_score):
        assert score(0.9 * distances, limit) >= score(distances, limit) - 1e-9


def test_counts_forget_how_near_and_msac_does_not():
    near, far = np.full(10, 0.1), np.full(10, 0.9)
    assert count_score(near, 1.0) == count_score(far, 1.0)
    assert msac_score(near, 1.0) > 5 * msac_score(far, 1.0)


def test_mlesac_is_the_largest_likelihood_over_the_share_of_inliers():
    rng = np.random.default_rng(0)
    residuals = np.abs(np.concatenate([0.5 * rng.normal(size=70), rng.uniform(0, 20, 30)]))
    sigma = 1.0 / 1.96
    span = 20.0
    shares = np.linspace(0.001, 0.999, 999)[:, None]
    density = scipy.stats.norm.pdf(residuals, scale=sigma)
    best = np.log(shares * density * span + 1 - shares).sum(1).max()
    assert mlesac_score(residuals, 1.0, span=span, steps=100) == pytest.approx(best, rel=1e-4)
    assert mlesac_score(residuals, 1.0, span=span) == pytest.approx(best, rel=0.02)
    assert mlesac_score(0.9 * residuals, 1.0, span=span) > mlesac_score(residuals, 1.0, span=span)


@pytest.mark.parametrize("score", [count_score, msac_score])
def test_rows_of_candidates_and_single_precision(score):
    rows = np.random.default_rng(1).uniform(0, 2, (5, 40))
    together = score(rows, 1.0)
    np.testing.assert_allclose(together, [score(row, 1.0) for row in rows])
    np.testing.assert_allclose(score(rows.astype(np.float32), 1.0), together, rtol=1e-5)


def test_a_point_at_infinity_is_an_outlier():
    d = np.array([0.0, np.inf])
    assert count_score(d, 1.0) == 1
    assert msac_score(d, 1.0) == 1
    assert np.isfinite(mlesac_score(d, 1.0, span=10.0))
