"""Cameras: laws, what lies behind, crops and limits, OpenCV's answers, and a real calibration."""

import math
import re

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from workbench.geometry.cameras import (
    OPENGL_FROM_OPENCV,
    back_project,
    camera_center,
    crop_intrinsics,
    depths,
    dolly,
    focal_from_field_of_view,
    in_front,
    intrinsics,
    look_at,
    normalize,
    pixel_rays,
    project,
    project_orthographic,
    ray_lengths,
    resize_intrinsics,
    sphere_outline,
    vanishing_points,
)
from workbench.geometry.cameras.distortion import NONE, Distortion, distort
from workbench.geometry.motions import apply, exp_so3, inverse, motion

LENS = Distortion(-0.26637, -0.038589, 0.0017832, -0.00028122, 0.23839)
K = intrinsics(535.9, 342.3, 235.6)
seeds = st.integers(0, 2**32 - 1)
lenses = st.sampled_from([NONE, LENS])


def any_motion(rng: np.random.Generator) -> np.ndarray:
    return motion(exp_so3(rng.normal(size=3)), rng.normal(size=3))


def seen_points(rng: np.random.Generator, T_camera_world: np.ndarray, n: int = 50) -> np.ndarray:
    p_camera = rng.uniform([-0.5, -0.4, 1.0], [0.5, 0.4, 1.0], (n, 3)) * rng.uniform(
        0.5, 20, (n, 1)
    )
    return apply(inverse(T_camera_world), p_camera)


@settings(max_examples=30, deadline=None)
@given(seed=seeds, lens=lenses)
def test_back_projection_inverts_projection(seed, lens):
    rng = np.random.default_rng(seed)
    T_camera_world = any_motion(rng)
    p_world = seen_points(rng, T_camera_world)
    uv = project(p_world, T_camera_world, K, lens)
    back = back_project(uv, depths(p_world, T_camera_world), T_camera_world, K=K, distortion=lens)
    np.testing.assert_allclose(back, p_world, atol=1e-9)


def test_normalised_coordinates_undo_skew_and_oblong_pixels():
    K_odd = intrinsics(500.0, 320.0, 240.0, fy=430.0, skew=12.0)
    xy = np.random.default_rng(7).uniform(-0.5, 0.5, (30, 2))
    uv = project(np.column_stack([xy, np.ones(30)]), np.eye(4), K_odd, LENS)
    np.testing.assert_allclose(normalize(uv, K_odd, LENS), xy, atol=1e-12)
    uv_h = np.column_stack([distort(xy, *LENS), np.ones(30)]) @ K_odd.T
    np.testing.assert_allclose(uv, uv_h[:, :2], atol=1e-10)


@settings(max_examples=30, deadline=None)
@given(seed=seeds, lens=lenses)
def test_rays_start_at_the_centre_and_meet_the_points_at_ray_length(seed, lens):
    rng = np.random.default_rng(seed)
    T_camera_world = any_motion(rng)
    p_world = seen_points(rng, T_camera_world)
    uv = project(p_world, T_camera_world, K, lens)
    center, n_world = pixel_rays(uv, T_camera_world, K, distortion=lens)
    length = ray_lengths(uv, depths(p_world, T_camera_world), K, distortion=lens)
    np.testing.assert_allclose(center + length[:, None] * n_world, p_world, atol=1e-9)
    np.testing.assert_allclose(np.linalg.norm(n_world, axis=1), 1.0, atol=1e-12)
    assert (length >= depths(p_world, T_camera_world)).all()


@settings(max_examples=30, deadline=None)
@given(seed=seeds)
def test_moving_world_and_camera_together_changes_no_pixel(seed):
    rng = np.random.default_rng(seed)
    T_camera_world, T_other_world = any_motion(rng), any_motion(rng)
    p_world = seen_points(rng, T_camera_world)
    T_camera_other = T_camera_world @ inverse(T_other_world)
    moved = project(apply(T_other_world, p_world), T_camera_other, K, LENS)
    np.testing.assert_allclose(moved, project(p_world, T_camera_world, K, LENS), atol=1e-7)


@settings(max_examples=30, deadline=None)
@given(seed=seeds)
def test_the_camera_centre_is_where_the_camera_takes_to_its_origin(seed):
    T_camera_world = any_motion(np.random.default_rng(seed))
    center = camera_center(T_camera_world)
    np.testing.assert_allclose(apply(T_camera_world, center), 0.0, atol=1e-12)
    np.testing.assert_allclose(center, inverse(T_camera_world)[:3, 3], atol=1e-12)


@settings(max_examples=20, deadline=None)
@given(seed=seeds, left=st.floats(-50, 300), top=st.floats(-50, 300), scale=st.floats(0.1, 4))
def test_crop_shifts_pixels_and_resize_scales_them_about_the_picture_edge(
    seed, left, top, *, scale
):
    rng = np.random.default_rng(seed)
    p = seen_points(rng, np.eye(4))
    uv = project(p, np.eye(4), K, LENS)
    cropped = project(p, np.eye(4), crop_intrinsics(K, left, top), LENS)
    np.testing.assert_allclose(cropped, uv - np.array([left, top]), atol=1e-9)
    resized = project(p, np.eye(4), resize_intrinsics(K, scale, 2 * scale), LENS)
    np.testing.assert_allclose(resized + 0.5, (uv + 0.5) * np.array([scale, 2 * scale]), atol=1e-9)


def test_what_lies_behind_is_nan_though_dividing_anyway_looks_valid():
    p = np.array([[0.5, 0.2, 2.0], [0.5, 0.2, -2.0], [0.5, 0.2, 0.0], [np.nan, 0.0, 1.0]])
    uv = project(p, np.eye(4), K)
    assert np.isfinite(uv[0]).all()
    assert np.isnan(uv[1:]).all()
    mirrored = K[0, 0] * p[1, 0] / p[1, 2] + K[0, 2]
    assert 0 < mirrored < 640
    np.testing.assert_array_equal(in_front(p, np.eye(4)), [True, False, False, False])
    assert np.isnan(project(p, np.eye(4), K, LENS)[1:]).all()
    assert np.isnan(project(p[:1], np.eye(4), K, near=2.0)).all()


def test_what_the_lens_would_fold_back_into_the_picture_is_nan():
    lens = Distortion(-0.3)
    p = np.array([[1.6, 0.0, 1.0], [0.5, 0.0, 1.0]])
    folded = K[0, 0] * distort(p[:1, :2], *lens)[0, 0] + K[0, 2]
    assert 0 < folded < 640
    uv = project(p, np.eye(4), K, lens)
    assert np.isnan(uv[0]).all()
    assert np.isfinite(uv[1]).all()


def test_look_at_puts_the_target_on_the_axis_and_up_upwards():
    eye = np.array([3.0, -2.0, 1.5])
    target = np.array([0.0, 4.0, 1.0])
    T_camera_world = look_at(eye, target)
    uv = project(np.stack([target, target + np.array([0.0, 0.0, 0.5])]), T_camera_world, K)
    np.testing.assert_allclose(uv[0], K[:2, 2], atol=1e-9)
    assert abs(uv[1, 0] - K[0, 2]) < 1e-9
    assert uv[1, 1] < K[1, 2]
    np.testing.assert_allclose(camera_center(T_camera_world), eye, atol=1e-12)
    assert np.linalg.det(T_camera_world[:3, :3]) == pytest.approx(1.0)


@pytest.mark.parametrize("direction", [[0, 0, 1], [0, 0, -1], [0, 0, -3], [1, 0, 0]])
def test_look_at_straight_up_and_down_is_still_a_rigid_motion(direction):
    T_camera_world = look_at(np.zeros(3), np.array(direction, dtype=float))
    np.testing.assert_allclose(
        T_camera_world[:3, :3] @ T_camera_world[:3, :3].T, np.eye(3), atol=1e-12
    )
    assert np.linalg.det(T_camera_world[:3, :3]) == pytest.approx(1.0)


def test_orthographic_is_the_limit_of_the_dolly_at_rate_one_over_factor():
    rng = np.random.default_rng(4)
    T_camera_world = look_at(np.array([0.0, -4.0, 1.0]), np.array([0.0, 0.0, 1.0]))
    depth = 4.0
    p_world = rng.uniform(-1, 1, (40, 3)) + np.array([0.0, 0.0, 1.0])
    K_flat = K.copy()
    K_flat[:2, :2] /= depth
    flat = project_orthographic(p_world, T_camera_world, K_flat)
    gap = [
        np.abs(project(p_world, *dolly(T_camera_world, K, depth, factor=factor)) - flat).max()
        for factor in (1, 10, 100, 1000)
    ]
    assert gap[0] > 20
    assert gap[3] < 0.1
    assert gap[1] / gap[2] == pytest.approx(10, rel=0.15)
    assert gap[2] / gap[3] == pytest.approx(10, rel=0.02)


@settings(max_examples=20, deadline=None)
@given(factor=st.floats(0.5, 50))
def test_the_dolly_keeps_every_point_of_the_subjects_plane(factor):
    T_camera_world = look_at(np.array([1.0, -4.0, 2.0]), np.array([0.0, 0.0, 1.0]))
    rng = np.random.default_rng(5)
    p_camera = np.column_stack([rng.uniform(-1, 1, (20, 2)), np.full(20, 3.0)])
    p_world = apply(inverse(T_camera_world), p_camera)
    before = project(p_world, T_camera_world, K)
    after = project(p_world, *dolly(T_camera_world, K, 3.0, factor=factor))
    np.testing.assert_allclose(after, before, atol=1e-8)


@settings(max_examples=20, deadline=None)
@given(seed=seeds, lens=lenses)
def test_far_points_of_a_line_tend_to_its_vanishing_point(seed, lens):
    rng = np.random.default_rng(seed)
    T_camera_world = any_motion(rng)
    v_camera = np.append(rng.uniform(-0.4, 0.4, 2), 1.0)
    v_world = v_camera @ T_camera_world[:3, :3]
    far = rng.normal(size=(2, 3)) + 1e8 * v_world
    limit = vanishing_points(
        np.stack([v_world, -3.0 * v_world]), T_camera_world, K, distortion=lens
    )
    np.testing.assert_allclose(project(far, T_camera_world, K, lens), limit, atol=1e-3)


def test_lines_parallel_to_the_picture_have_no_vanishing_point():
    assert np.isnan(
        vanishing_points(
            np.array([[1.0, 2.0, 0.0], [1.0, 2.0, 1e-15], [0.0, 0.0, 0.0]]), np.eye(4), K
        )
    ).all()


@settings(max_examples=20, deadline=None)
@given(seed=seeds)
def test_the_outline_of_a_sphere_is_where_rays_graze_it_and_is_an_ellipse(seed):
    rng = np.random.default_rng(seed)
    T_camera_world = any_motion(rng)
    radius = 0.6
    center = apply(inverse(T_camera_world), np.array([1.2, -0.7, 3.0]))
    outline = sphere_outline(center, radius, T_camera_world)
    to_center = outline - center
    to_camera = outline - camera_center(T_camera_world)
    np.testing.assert_allclose(np.linalg.norm(to_center, axis=1), radius, atol=1e-12)
    np.testing.assert_allclose(np.einsum("ni,ni->n", to_center, to_camera), 0.0, atol=1e-12)
    u, v = normalize(project(outline, T_camera_world, K), K).T
    conic = np.linalg.lstsq(
        np.column_stack([u * u, u * v, v * v, u, v]), np.ones(len(u)), rcond=None
    )
    a, b, c = conic[0][:3]
    assert np.abs(np.column_stack([u * u, u * v, v * v, u, v]) @ conic[0] - 1).max() < 1e-9
    axes = np.abs(np.linalg.eigvalsh(np.array([[a, b / 2], [b / 2, c]])))
    assert 4 * a * c > b * b
    assert math.sqrt(axes.max() / axes.min()) > 1.05


def test_inside_a_sphere_there_is_no_outline():
    with pytest.raises(ValueError, match="inside the sphere"):
        sphere_outline(np.array([0.0, 0.0, 0.1]), 0.5, np.eye(4))


def test_opengl_axes_are_half_a_turn_about_x():
    np.testing.assert_array_equal(
        apply(OPENGL_FROM_OPENCV, np.array([1.0, 2.0, 3.0])), [1.0, -2.0, -3.0]
    )
    np.testing.assert_array_equal(OPENGL_FROM_OPENCV @ OPENGL_FROM_OPENCV, np.eye(4))


def test_the_focal_length_comes_from_the_field_of_view():
    assert focal_from_field_of_view(math.pi / 2, 640) == pytest.approx(320)
    with pytest.raises(ValueError, match="field of view"):
        focal_from_field_of_view(math.pi, 640)


@pytest.mark.parametrize("f", [0.0, -1.0, math.nan, math.inf])
def test_a_focal_length_must_be_positive(f):
    with pytest.raises(ValueError, match="focal"):
        intrinsics(f, 0.0, 0.0)


def test_impossible_cameras_are_refused():
    with pytest.raises(ValueError, match="coincide"):
        look_at(np.ones(3), np.ones(3))
    with pytest.raises(ValueError, match="positive"):
        resize_intrinsics(K, 0.0, 1.0)


def test_no_points_give_no_pixels():
    assert project(np.zeros((0, 3)), np.eye(4), K, LENS).shape == (0, 2)
    assert back_project(np.zeros((0, 2)), np.zeros(0), np.eye(4), K=K, distortion=LENS).shape == (
        0,
        3,
    )


def test_agrees_with_opencv():
    cv2 = pytest.importorskip("cv2", reason="opencv-python-headless is not installed")
    rng = np.random.default_rng(6)
    T_camera_world = any_motion(rng)
    p_world = seen_points(rng, T_camera_world, 20_000)
    rotation = cv2.Rodrigues(T_camera_world[:3, :3])[0]
    for lens in (NONE, LENS):
        theirs = cv2.projectPoints(p_world, rotation, T_camera_world[:3, 3], K, np.array(lens))[0][
            :, 0
        ]
        np.testing.assert_allclose(project(p_world, T_camera_world, K, lens), theirs, atol=1e-7)


def bow(rows: np.ndarray) -> float:
    """The median over board rows of how far, in pixels, the middle corner is from the line through
    the outer ones.
    """
    way = rows[..., -1, :] - rows[..., 0, :]
    middle = rows[..., 4, :] - rows[..., 0, :]
    cross = way[..., 0] * middle[..., 1] - way[..., 1] * middle[..., 0]
    return float(np.median(np.abs(cross) / np.linalg.norm(way, axis=-1)))


def test_a_real_calibration_projects_its_chessboards_onto_their_corners(shared_data):
    """Thirteen photographs, 25 mm squares: the file's own K, lens and poses leave the error that it
    states.
    """
    text = (shared_data / "calibration" / "left_intrinsics.yml").read_text()

    def matrix(name: str) -> np.ndarray:
        body = re.search(name + r":.*?data: \[(.*?)\]", text, re.DOTALL)
        assert body
        return np.array([float(number) for number in body.group(1).split(",")])

    K_real = matrix("camera_matrix").reshape(3, 3)
    lens = Distortion(*matrix("distortion_coefficients"))
    stated = matrix("per_view_reprojection_errors")
    poses = matrix("extrinsic_parameters").reshape(-1, 6)
    board = np.load(shared_data / "calibration" / "corners_9x6.npz")
    p_board = board["object_points"].astype(float)
    rms = np.zeros(13)
    for view, corners in enumerate(board["left"].astype(float)):
        T_camera_board = motion(exp_so3(poses[view, :3]), poses[view, 3:])
        miss = project(p_board, T_camera_board, K_real, lens) - corners
        rms[view] = np.sqrt((miss**2).sum(axis=1).mean())
    # The corners were found again, by another detector: one view of the thirteen differs more than
    # a little.
    assert np.sort(np.abs(rms / stated - 1))[:-1].max() < 0.05
    assert rms.max() < 1.3
    assert np.median(rms) < 0.21

    rows = board["left"].astype(float).reshape(13, 6, 9, 2)
    straight = normalize(rows.reshape(-1, 2), K_real, lens) * K_real[0, 0]
    assert bow(straight.reshape(rows.shape)) < 0.2
    assert bow(rows) > 4 * bow(straight.reshape(rows.shape))
