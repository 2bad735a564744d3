import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.geometry.test_essential import K, L, pair
from workbench.geometry.cameras.stereo import StereoCamera
from workbench.geometry.motions import exp_so3, motion
from workbench.geometry.motions.alignment import degrees_between
from workbench.geometry.two_views.homography import transform_pixels
from workbench.geometry.two_views.rectification import fitted, growth, rectify, torn, warp

seeds = st.integers(0, 2**32 - 1)
SIZE = (1024, 683)


def beside(heading: float, turn: float = 0.0) -> np.ndarray:
    """A second camera 1 m from the first, at so many degrees from its right towards ahead."""
    R = exp_so3(np.array([0.0, turn, 0.0]))
    angle = np.radians(heading)
    return motion(R, -R @ np.array([np.cos(angle), 0.0, np.sin(angle)]))


@settings(max_examples=30, deadline=None)
@given(seed=seeds)
def test_rows_correspond_and_disparity_is_depth(seed):
    T, p, uv_first, uv_second = pair(seed)
    rectified = rectify(T, K, L)
    uv = transform_pixels(rectified.H_first, uv_first)
    st_ = transform_pixels(rectified.H_second, uv_second)
    np.testing.assert_allclose(uv[:, 1], st_[:, 1], atol=1e-7)
    d = (uv - st_)[:, 0]
    assert (d < 0).all() == rectified.second_is_left
    assert (d > 0).all() == (not rectified.second_is_left)
    camera = StereoCamera(
        rectified.K[0, 0], rectified.K[0, 2], rectified.K[1, 2], float(np.linalg.norm(T[:3, 3]))
    )
    np.testing.assert_allclose(
        camera.depth(np.abs(d)), (p @ rectified.R_rectified_first.T)[:, 2], atol=1e-6
    )
    np.testing.assert_allclose(
        rectified.R_rectified_second @ T[:3, :3], rectified.R_rectified_first, atol=1e-12
    )


def test_a_second_camera_on_the_left_stays_upright_unless_asked_not_to():
    for heading in (180.0, 150.0, 200.0):
        T = beside(heading, -0.1)
        upright = rectify(T, K, K)
        over = rectify(T, K, K, keep_upright=False)
        assert upright.second_is_left
        assert over.second_is_left
        assert degrees_between(upright.R_rectified_first, np.eye(3)) < 40
        assert degrees_between(over.R_rectified_first, np.eye(3)) > 140
    both = [rectify(beside(0.0, 0.1), K, K, keep_upright=keep).H_first for keep in (True, False)]
    np.testing.assert_array_equal(both[0], both[1])


def test_pictures_grow_and_tear_on_the_way_ahead():
    grown = [
        growth(rectify(beside(heading), K, K).H_first, SIZE) for heading in (0, 17, 45, 55, 72, 89)
    ]
    assert grown[0] == pytest.approx(1)
    assert (np.diff(grown[:4]) > 0).all()
    assert grown[2] == pytest.approx(9.5, abs=0.5)
    assert np.isinf(grown[4:]).all()
    assert torn(rectify(beside(72), K, K).H_first, SIZE)
    with pytest.raises(ValueError, match="torn"):
        fitted(
            rectify(beside(72), K, K).H_first,
            np.eye(3),
            size_first=SIZE,
            size_second=SIZE,
            size=(320, 200),
        )


def test_no_baseline_and_one_along_the_axis_are_refused():
    with pytest.raises(ValueError, match="one place"):
        rectify(np.eye(4), K, K)
    with pytest.raises(ValueError, match="optical axes"):
        rectify(beside(90.0), K, K)


@settings(max_examples=20, deadline=None)
@given(seed=seeds)
def test_fitted_pictures_are_inside_and_keep_their_rows(seed):
    T, _, uv_first, uv_second = pair(seed)
    rectified = rectify(T, K, L)
    if torn(rectified.H_first, SIZE) or torn(rectified.H_second, SIZE):
        return
    H, G = fitted(
        rectified.H_first, rectified.H_second, size_first=SIZE, size_second=SIZE, size=(400, 300)
    )
    corners = np.array([[-0.5, -0.5], [1023.5, -0.5], [1023.5, 682.5], [-0.5, 682.5]])
    for homography in (H, G):
        uv = transform_pixels(homography, corners)
        assert (uv > -1).all()
        assert (uv < [400, 300]).all()
    np.testing.assert_allclose(
        transform_pixels(H, uv_first)[:, 1], transform_pixels(G, uv_second)[:, 1], atol=1e-7
    )


def test_a_warped_picture_has_its_colours_where_its_pixels_go():
    rng = np.random.default_rng(0)
    image = rng.integers(0, 256, (30, 40, 3), dtype=np.uint8)
    np.testing.assert_array_equal(warp(image, np.eye(3), (40, 30)), image)
    shifted = warp(image, np.array([[1.0, 0, 5], [0, 1, -3], [0, 0, 1]]), (40, 30))
    np.testing.assert_array_equal(shifted[:27, 5:], image[3:, :35])
    assert (shifted[27:] == 255).all()
    ramp = np.tile(np.arange(40, dtype=np.uint8)[None, :, None] * 4, (30, 1, 3))
    half = warp(ramp, np.diag([2.0, 2.0, 1.0]), (79, 59))
    np.testing.assert_array_equal(half[0, :, 0], np.arange(79) * 2)


def test_opencv_turns_the_cameras_alike():
    cv2 = pytest.importorskip("cv2")
    for seed in range(4):
        T = pair(seed)[0]
        T[:3, 3] *= [1.0, 0.2, 0.3]
        ours = rectify(T, K, K)
        theirs = cv2.stereoRectify(
            K, np.zeros((5, 1)), K, np.zeros((5, 1)), SIZE, T[:3, :3], T[:3, 3:]
        )
        # it halves the turn, we the angle of the axes
        assert degrees_between(ours.R_rectified_first, theirs[0]) < 0.5


def test_the_fountains_rows(shared_data):
    fountain = np.load(shared_data / "ransac" / "fountain-P11" / "gt_and_matches.npz")
    good = np.abs(fountain["gt_sampson"]) < 1
    uv_first = fountain["x1"][good].astype(float)
    uv_second = fountain["x2"][good].astype(float)
    K_ = fountain["K1"]
    T = motion(fountain["R_rel"], fountain["t_rel"])
    ours = rectify(T, K_, K_)
    rows = (
        transform_pixels(ours.H_first, uv_first)[:, 1]
        - transform_pixels(ours.H_second, uv_second)[:, 1]
    )
    assert np.sqrt(np.square(rows).mean()) < 0.25
    assert ours.second_is_left
    cv2 = pytest.importorskip("cv2")
    theirs = cv2.stereoRectify(
        K_, np.zeros((5, 1)), K_, np.zeros((5, 1)), SIZE, T[:3, :3], T[:3, 3:]
    )
    assert degrees_between(ours.R_rectified_first, theirs[0]) < 0.02
