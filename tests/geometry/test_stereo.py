"""Depth from disparity: against projection by two cameras, and the laws of its error."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from workbench.geometry.cameras import project
from workbench.geometry.cameras.stereo import (
    StereoCamera,
    depth_cloud,
    depth_from_disparity,
    depth_interval,
    depth_uncertainty,
    disparity_from_depth,
    points_on_ray,
)
from workbench.geometry.motions import motion

cameras = st.builds(
    StereoCamera,
    f=st.floats(50, 2000),
    cx=st.floats(0, 500),
    cy=st.floats(0, 500),
    baseline=st.floats(0.01, 2.0),
    doffs=st.floats(-30, 30),
)


def pixels_of(p_camera, camera):
    """Return where both cameras see points, by projection alone."""
    K_right = camera.K
    K_right[0, 2] += camera.doffs
    T_right_left = motion(np.eye(3), np.array([-camera.baseline, 0.0, 0.0]))
    return project(p_camera, np.eye(4), camera.K), project(p_camera, T_right_left, K_right)


@settings(max_examples=40, deadline=None)
@given(cameras, st.integers(0, 2**32 - 1))
def test_two_cameras_that_project_a_point_tell_its_depth(camera, seed):
    p_camera = np.random.default_rng(seed).uniform([-3, -3, 0.5], [3, 3, 30], (20, 3))
    uv_left, uv_right = pixels_of(p_camera, camera)
    assert np.allclose(uv_left[:, 1], uv_right[:, 1], atol=1e-9)
    d = uv_left[:, 0] - uv_right[:, 0]
    assert (d + camera.doffs > 0).all()
    depth = depth_from_disparity(d + camera.doffs, camera.f, camera.baseline)
    assert np.allclose(depth, p_camera[:, 2], rtol=1e-7)
    assert np.array_equal(camera.depth(d), depth)
    assert np.allclose(
        disparity_from_depth(depth, camera.f, camera.baseline), d + camera.doffs, rtol=1e-7
    )


@given(st.floats(0.01, 500), st.floats(1.01, 50))
def test_depth_is_inverse_to_disparity_not_proportional(d, factor):
    near, far = depth_from_disparity(np.array([d * factor, d]), 700.0, 0.12)
    assert far == pytest.approx(near * factor)


def test_zero_is_infinitely_far_and_only_nan_is_unknown():
    depth = depth_from_disparity(np.array([0.0, np.nan, -1.0, 4.2, -0.0]), 700.0, 0.12)
    assert depth[0] == np.inf
    assert depth[4] == np.inf
    assert np.isnan(depth[1:3]).all()
    assert depth[3] == pytest.approx(20.0)


def test_one_pixel_costs_more_the_further_away():
    depth = np.array([1.0, 5.0, 20.0])
    error = depth_uncertainty(depth, 700.0, 0.12, disparity_error=1.0)
    assert error == pytest.approx([0.0119, 0.2976, 4.762], rel=1e-3)
    near, far = depth_interval(
        disparity_from_depth(depth, 700.0, 0.12), 700.0, 0.12, disparity_error=1.0
    )
    # exact: longer on the far side
    assert far - near == pytest.approx([0.0238, 0.597, 10.1], rel=0.01)
    assert (far - depth > depth - near).all()


@given(st.floats(0.5, 50), st.floats(100, 2000), st.floats(0.02, 1.0))
def test_the_uncertainty_is_the_slope_of_depth(depth, f, baseline):
    d = disparity_from_depth(np.array([depth]), f, baseline)
    h = 1e-6
    slope = (
        depth_from_disparity(d - h, f, baseline) - depth_from_disparity(d + h, f, baseline)
    ) / (2 * h)
    assert depth_uncertainty(np.array([depth]), f, baseline, disparity_error=1.0) == pytest.approx(
        slope, rel=1e-4
    )


def test_an_error_larger_than_the_disparity_reaches_infinity():
    near, far = depth_interval(np.array([0.4]), 700.0, 0.12, disparity_error=1.0)
    assert np.isfinite(near).all()
    assert far[0] == np.inf


@settings(max_examples=30, deadline=None)
@given(cameras, st.integers(1, 8), st.integers(0, 2**32 - 1))
def test_shrinking_pictures_moves_no_point(camera, k, seed):
    p_camera = np.random.default_rng(seed).uniform([-1, -1, 1], [1, 1, 9], (10, 3))
    small = camera.shrunk(k)
    uv, uv_right = pixels_of(p_camera, camera)
    uv_small, uv_small_right = pixels_of(p_camera, small)
    assert np.allclose(uv_small + 0.5, (uv + 0.5) / k)
    assert np.allclose(uv_small[:, 0] - uv_small_right[:, 0], (uv[:, 0] - uv_right[:, 0]) / k)
    d_small = (uv[:, 0] - uv_right[:, 0]) / k + small.doffs
    assert np.allclose(depth_from_disparity(d_small, small.f, small.baseline), p_camera[:, 2])


@settings(max_examples=30, deadline=None)
@given(cameras, st.integers(0, 2**32 - 1))
def test_the_cloud_projects_back_to_its_pixels(camera, seed):
    rng = np.random.default_rng(seed)
    depth = rng.uniform(0.5, 9.0, (5, 7))
    depth[1, 2] = np.nan
    depth[3, 4] = np.inf
    depth[0, 0] = -1.0
    p_camera, seen = depth_cloud(depth, camera)
    assert p_camera.shape == (5 * 7 - 3, 3)
    assert not seen[1, 2]
    assert not seen[3, 4]
    assert not seen[0, 0]
    v, u = np.nonzero(seen)
    assert np.allclose(project(p_camera, np.eye(4), camera.K), np.column_stack([u, v]), atol=1e-7)
    assert np.array_equal(p_camera[:, 2], depth[seen])


def test_candidates_lie_on_one_ray():
    camera = StereoCamera(150.0, 79.5, 59.5, 0.1)
    depth = depth_from_disparity(np.arange(1.0, 20.0), camera.f, camera.baseline)
    p_camera = points_on_ray((20, 90), depth, camera)
    assert np.allclose(project(p_camera, np.eye(4), camera.K), [20, 90])
    assert np.allclose(np.cross(p_camera, p_camera[0]), 0.0, atol=1e-12)


def test_nothing_known_is_an_empty_cloud():
    p_camera, seen = depth_cloud(np.full((3, 4), np.nan), StereoCamera(100.0, 1.5, 1.0, 0.1))
    assert p_camera.shape == (0, 3)
    assert not seen.any()


@pytest.mark.parametrize(
    ("f", "baseline"), [(0.0, 0.1), (-5.0, 0.1), (100.0, 0.0), (np.inf, 0.1), (100.0, np.nan)]
)
def test_impossible_cameras_are_refused(f, baseline):
    with pytest.raises(ValueError, match="positive and finite"):
        StereoCamera(f, 0.0, 0.0, baseline)
