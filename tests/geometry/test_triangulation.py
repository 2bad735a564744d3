import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.geometry.test_essential import K, L, pair
from workbench.geometry.cameras import normalize
from workbench.geometry.motions import motion
from workbench.geometry.two_views.triangulation import (
    before_both,
    camera_matrix,
    midpoints,
    triangulate,
    triangulation_covariances,
)

seeds = st.integers(0, 2**32 - 1)


@settings(max_examples=30, deadline=None)
@given(seed=seeds)
def test_exact_pixels_give_the_points_in_both_ways(seed):
    T, p, uv_first, uv_second = pair(seed)
    P = camera_matrix(K, np.eye(4))
    Q = camera_matrix(L, T)
    np.testing.assert_allclose(triangulate(P, Q, uv_first, uv_second), p, atol=1e-7)
    np.testing.assert_allclose(triangulate(-3 * P, 0.1 * Q, uv_first, uv_second), p, atol=1e-7)
    np.testing.assert_allclose(
        midpoints(T, normalize(uv_first, K), normalize(uv_second, L)), p, atol=1e-8
    )
    assert before_both(p, T).all()


def test_covariances_are_what_repetition_shows():
    T = motion(np.eye(3), np.array([-1.0, 0.0, 0.0]))
    P = camera_matrix(K, np.eye(4))
    Q = camera_matrix(K, T)
    p = np.array([0.5, -0.3, 8.0])
    n = 4000
    sigma = 0.5
    rng = np.random.default_rng(0)
    uv = [np.divide(*np.split(p_h, [2])) for p_h in (P @ [*p, 1], Q @ [*p, 1])]
    triangulated = triangulate(P, Q, *(x + sigma * rng.normal(size=(n, 2)) for x in uv))
    predicted = triangulation_covariances(P, Q, p[None], sigma=sigma)[0]
    np.testing.assert_allclose(np.cov(triangulated.T), predicted, atol=0.06 * predicted[2, 2])
    # Z² sigma_d / (f b)
    assert np.sqrt(predicted[2, 2]) == pytest.approx(8**2 / 900 * sigma * np.sqrt(2), rel=0.02)


def test_depth_errors_go_with_one_over_the_baseline_and_some_land_behind():
    P = camera_matrix(K, np.eye(4))
    p = np.array([0.0, 0.0, 8.0])
    rng = np.random.default_rng(1)
    spread, behind = {}, {}
    for baseline in (1.0, 0.5, 0.02):
        Q = camera_matrix(K, motion(np.eye(3), np.array([-baseline, 0.0, 0.0])))
        uv = [np.divide(*np.split(p_h, [2])) for p_h in (P @ [*p, 1], Q @ [*p, 1])]
        z = triangulate(P, Q, *(x + rng.normal(size=(3000, 2)) for x in uv))[:, 2]
        spread[baseline] = (np.percentile(z, 75) - np.percentile(z, 25)) / 1.349
        behind[baseline] = (z < 0).mean()
    assert spread[1.0] == pytest.approx(0.10, abs=0.01)
    assert spread[0.5] == pytest.approx(0.20, abs=0.02)
    assert behind[1.0] == behind[0.5] == 0
    assert 0.03 < behind[0.02] < 0.09


def test_parallel_rays_have_no_point_and_no_covariance():
    T = motion(np.eye(3), np.array([-1.0, 0.0, 0.0]))
    P = camera_matrix(K, np.eye(4))
    Q = camera_matrix(K, T)
    uv = np.array([[512.0, 341.0]])
    far = triangulate(P, Q, uv, uv)
    assert not np.isfinite(far).all() or np.abs(far).max() > 1e9
    assert not np.isfinite(midpoints(T, normalize(uv, K), normalize(uv, K))).any()
    assert np.isnan(triangulation_covariances(P, Q, np.array([[0.0, 0.0, 1e12]]), sigma=1.0)).all()
    assert not before_both(np.array([[np.nan] * 3, [0, 0, -1.0]]), np.eye(4)).any()
    assert triangulation_covariances(P, Q, np.empty((0, 3)), sigma=1.0).shape == (0, 3, 3)


def test_opencv_triangulates_alike():
    cv2 = pytest.importorskip("cv2")
    T, _, uv_first, uv_second = pair(3, 60, 0.5)
    P = camera_matrix(K, np.eye(4))
    Q = camera_matrix(L, T)
    x = cv2.triangulatePoints(P, Q, uv_first.T, uv_second.T)
    np.testing.assert_allclose(triangulate(P, Q, uv_first, uv_second), (x[:3] / x[3]).T, atol=0.03)
