"""Angles of pairs and their histograms: laws, an oracle's table, and what has no frame."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from workbench.data.shapes.rabbit import rabbit
from workbench.geometry.features.fpfh import fpfh, pair_angles
from workbench.geometry.motions import apply, exp_so3, motion
from workbench.geometry.points.normals import point_normals


def pairs(seed: int, count: int = 40) -> list[np.ndarray]:
    rng = np.random.default_rng(seed)
    p_i, n_i, p_j, n_j = rng.normal(size=(4, count, 3))
    n_i, n_j = (n / np.linalg.norm(n, axis=1, keepdims=True) for n in (n_i, n_j))
    return [p_i, n_i, p_j, n_j]


def test_the_published_pair():
    n_j = np.array([[0.3, 0.1, 0.95]])
    angles = pair_angles(
        np.zeros((1, 3)),
        np.array([[0.0, 0, 1]]),
        np.array([[0.02, 0.01, 0.003]]),
        n_j / np.linalg.norm(n_j),
    )
    np.testing.assert_allclose(angles, [[0.3177, 0.0492, -0.4360]], atol=1e-4)


@given(seed=st.integers(0, 500))
def test_neither_order_nor_motion_nor_scale_changes_them(seed):
    p_i, n_i, p_j, n_j = pairs(seed)
    angles = pair_angles(p_i, n_i, p_j, n_j)
    np.testing.assert_allclose(pair_angles(p_j, n_j, p_i, n_i), angles, atol=1e-9)
    R = exp_so3(np.random.default_rng(seed).normal(size=3))
    moved = pair_angles(3 * p_i @ R.T + 1, n_i @ R.T, 3 * p_j @ R.T + 1, n_j @ R.T)
    np.testing.assert_allclose(moved, angles, atol=1e-7)


def test_flipped_normals_change_the_signs_of_theta_and_phi():
    p_i, n_i, p_j, n_j = pairs(3)
    np.testing.assert_allclose(
        pair_angles(p_i, -n_i, p_j, -n_j), pair_angles(p_i, n_i, p_j, n_j) * [-1, 1, -1], atol=1e-9
    )


def test_without_a_frame_all_are_zero():
    up = np.array([[0.0, 0, 1]])
    np.testing.assert_array_equal(pair_angles(np.zeros((1, 3)), up, up, up), [[0, 0, 0]])
    np.testing.assert_array_equal(pair_angles(up, up, up, up), [[0, 0, 0]])


def plainly(p: np.ndarray, n: np.ndarray, radius: float) -> np.ndarray:
    """The descriptor in loops, as Open3D's source has it."""
    own = np.zeros((len(p), 33))
    near = []
    for i in range(len(p)):
        d = np.linalg.norm(p - p[i], axis=1)
        near.append([j for j in np.flatnonzero(d <= radius) if j != i])
        for j in near[i]:
            t, a, f = pair_angles(p[[i]], n[[i]], p[[j]], n[[j]])[0]
            for k, x in enumerate(((t + np.pi) / (2 * np.pi), (a + 1) / 2, (f + 1) / 2)):
                own[i, 11 * k + min(10, max(0, int(np.floor(11 * x))))] += 100 / len([*near[i]])
    descriptors = own.copy()
    for i in range(len(p)):
        around = np.sum([own[j] / np.sum((p[j] - p[i]) ** 2) for j in near[i]], axis=0).reshape(
            3, 11
        )
        descriptors[i] += (100 * around / around.sum(axis=1, keepdims=True)).ravel()
    return descriptors


def test_it_is_what_the_loops_give():
    p = rabbit(70, np.random.default_rng(0))
    n = point_normals(p)
    np.testing.assert_allclose(fpfh(p, n, 0.35), plainly(p, n, 0.35), atol=1e-6)


OPEN3D = {  # compute_fpfh_feature of Open3D 0.20 within 0.15 m, at two of the points
    17: [
        0.084,
        0.343,
        0.138,
        0.279,
        18.937,
        103.116,
        48.658,
        15.374,
        12.49,
        0.331,
        0.249,
        10.854,
        17.884,
        17.738,
        28.797,
        30.449,
        25.704,
        31.621,
        18.877,
        7.782,
        7.974,
        2.32,
        15.329,
        18.703,
        7.277,
        32.21,
        37.69,
        5.423,
        57.245,
        14.225,
        11.15,
        0.436,
        0.312,
    ],
    250: [
        0.0,
        0.0,
        0.0,
        0.0,
        1.053,
        127.195,
        71.752,
        0.0,
        0.0,
        0.0,
        0.0,
        0.0,
        0.0,
        0.0,
        2.746,
        65.181,
        94.798,
        33.048,
        3.01,
        0.975,
        0.242,
        0.0,
        0.0,
        0.0,
        0.0,
        5.865,
        168.287,
        20.707,
        2.014,
        2.471,
        0.656,
        0.0,
        0.0,
    ],
}


def test_it_is_what_open3d_gives():
    p = rabbit(400, np.random.default_rng(0))
    descriptors = fpfh(p, point_normals(p), 0.15)
    np.testing.assert_allclose(descriptors[list(OPEN3D)], list(OPEN3D.values()), atol=6e-4)


def test_it_does_not_change_with_a_motion_and_sums_to_600():
    p = rabbit(400, np.random.default_rng(1))
    n = point_normals(p)
    T = motion(exp_so3(np.array([0.5, -1.0, 0.3])), np.array([2.0, 1.0, 0.0]))
    descriptors = fpfh(p, n, 0.2)
    np.testing.assert_allclose(descriptors.sum(axis=1), 600)
    off = np.abs(fpfh(apply(T, p), n @ T[:3, :3].T, 0.2) - descriptors).max(axis=1)
    assert np.mean(off < 1e-6) > 0.95  # an angle on the border of two bins may change sides


def test_points_alone_or_at_one_place_have_zeros():
    p = np.array([[0.0, 0, 0], [5, 0, 0], [5, 0, 0]])
    n = np.tile([0.0, 0, 1], (3, 1))
    np.testing.assert_array_equal(fpfh(p, n, 0.1), np.zeros((3, 33)))


@pytest.mark.parametrize("radius", [0.1, 0.3])
def test_a_plane_has_all_angles_in_the_middle(radius):
    rng = np.random.default_rng(2)
    p = np.column_stack([rng.uniform(size=(200, 2)), np.zeros(200)])
    descriptors = fpfh(p, np.tile([0.0, 0, 1], (200, 1)), radius)
    some = descriptors.sum(axis=1) > 300
    assert some.sum() > 100
    np.testing.assert_allclose(descriptors[some][:, [5, 16, 27]], 200)
