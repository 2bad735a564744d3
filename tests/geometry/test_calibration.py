"""Zhang's constraints, poses and the linear lens, on exact pictures and beside the camera
itself.
"""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from workbench.data.views.boards import board_points
from workbench.geometry.cameras import intrinsics, project
from workbench.geometry.cameras.calibration import (
    constraint_rows,
    intrinsics_from_constraints,
    linear_lens,
    pose_from_homography,
    reprojection_rms,
)
from workbench.geometry.cameras.distortion import Distortion
from workbench.geometry.motions import exp_so3, motion

P = board_points()


def camera(rng: np.random.Generator) -> np.ndarray:
    f = rng.uniform(300, 1500)
    return intrinsics(f, rng.uniform(250, 390), rng.uniform(180, 300), fy=f * rng.uniform(0.9, 1.1))


def pose(rng: np.random.Generator) -> np.ndarray:
    return motion(
        exp_so3(rng.uniform(-0.6, 0.6, 3)),
        np.array([*rng.uniform(-0.1, 0.1, 2), rng.uniform(0.3, 1.0)]),
    )


def homography(K: np.ndarray, T: np.ndarray, scale: float = 1.0) -> np.ndarray:
    return scale * K @ T[:3, [0, 1, 3]]


@settings(max_examples=30, deadline=None)
@given(st.integers(0, 10**6))
def test_rows_are_products_with_b_and_0_for_the_camera(seed):
    rng = np.random.default_rng(seed)
    H, S = rng.normal(size=(2, 3, 3))
    B = S + S.T
    b = B[[0, 0, 1, 0, 1, 2], [0, 1, 1, 2, 2, 2]]
    h1, h2 = H[:, 0], H[:, 1]
    np.testing.assert_allclose(
        constraint_rows(H) @ b, [h1 @ B @ h2, h1 @ B @ h1 - h2 @ B @ h2], atol=1e-12
    )
    K = camera(rng)
    rows = constraint_rows(homography(K, pose(rng)))
    B = np.linalg.inv(K @ K.T)
    b = B[[0, 0, 1, 0, 1, 2], [0, 1, 1, 2, 2, 2]]
    assert (np.abs(rows @ b) < 1e-10 * (np.abs(rows) @ np.abs(b))).all()


@settings(max_examples=20, deadline=None)
@given(st.integers(0, 10**6))
def test_exact_views_give_the_camera_and_the_poses(seed):
    rng = np.random.default_rng(seed)
    K = camera(rng)
    Ts = [pose(rng) for _ in range(5)]
    N = np.diag([1 / 640, 1 / 640, 1.0])
    Hs = [homography(K, T, rng.uniform(0.1, 9) * rng.choice([-1, 1])) for T in Ts]
    rows = np.concatenate([constraint_rows(N @ H / np.linalg.norm(H)) for H in Hs])
    estimate = intrinsics_from_constraints(rows)
    assert estimate is not None
    np.testing.assert_allclose(np.linalg.inv(N) @ estimate, K, rtol=1e-6, atol=1e-4)
    for T, H in zip(Ts, Hs, strict=True):
        np.testing.assert_allclose(pose_from_homography(K, H), T, atol=1e-9)


def test_parallel_boards_are_one_view():
    rng = np.random.default_rng(0)
    K, T = camera(rng), pose(rng)
    others = [motion(T[:3, :3], T[:3, 3] + shift) for shift in rng.uniform(-0.1, 0.1, (4, 3))]
    N = np.diag([1 / 640, 1 / 640, 1.0])
    rows = np.concatenate([constraint_rows(N @ homography(K, other)) for other in others])
    assert np.linalg.matrix_rank(rows, 1e-9 * np.abs(rows).max()) == 2


def test_no_camera_where_there_is_none():
    rng = np.random.default_rng(1)
    assert intrinsics_from_constraints(rng.normal(size=(2, 6))) is None  # one view
    assert intrinsics_from_constraints(np.full((6, 6), np.nan)) is None
    S = np.diag([1.0, -1.0, 1.0])  # not definite
    b = S[[0, 0, 1, 0, 1, 2], [0, 1, 1, 2, 2, 2]]
    A = rng.normal(size=(8, 6))
    A[:, 1] = 0
    assert intrinsics_from_constraints(A - np.outer(A @ b, b) / (b @ b)) is None


def test_a_noisy_homography_gives_a_rotation_before_the_camera():
    rng = np.random.default_rng(2)
    K, T = camera(rng), pose(rng)
    H = homography(K, T) * (1 + 0.01 * rng.normal(size=(3, 3)))
    for sign in (1, -1):
        estimate = pose_from_homography(K, sign * H)
        np.testing.assert_allclose(estimate[:3, :3] @ estimate[:3, :3].T, np.eye(3), atol=1e-12)
        assert np.linalg.det(estimate[:3, :3]) > 0
        assert estimate[2, 3] > 0
    with pytest.raises(ValueError, match="no inverse"):
        pose_from_homography(np.zeros((3, 3)), H)
    with pytest.raises(ValueError, match="zero"):
        pose_from_homography(K, np.zeros((3, 3)))


def test_the_linear_lens_is_exact_where_camera_and_poses_are():
    rng = np.random.default_rng(3)
    K = camera(rng)
    lens = Distortion(k1=-0.2, k2=0.07)
    Ts = np.stack([pose(rng) for _ in range(3)])
    uv = np.stack([project(P, T, K, lens) for T in Ts])
    np.testing.assert_allclose(linear_lens(K, Ts, P, uv=uv), [-0.2, 0.07], atol=1e-10)
    assert linear_lens(K, Ts, P, uv=uv, terms=1).shape == (1,)


def test_the_rms_is_per_point():
    residuals = np.random.default_rng(4).normal(size=(100_000, 2))
    assert reprojection_rms(residuals) == pytest.approx(np.sqrt(2), rel=0.01)
