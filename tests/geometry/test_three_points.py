import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.geometry.views import triples
from workbench.geometry.cameras.camera_motions import reprojection_errors
from workbench.geometry.cameras.three_points import (
    p3p,
    quartics,
    solution_counts,
    three_point_lengths,
    unit_rays,
)
from workbench.geometry.motions import apply, exp_se3, inverse

OTHERS_COUNT = (0, 106, 3563, 11, 320)
"""How many of `triples(4000)` have no, one, ..., four solutions, by poselib 2.0.5 and by OpenCV
5.0.0's solveP3P alike.
"""


@pytest.fixture(scope="module")
def many():
    Ts, p_world, xy = triples(4000)
    return Ts, p_world, xy, *p3p(p_world, xy)


def test_as_many_solutions_as_poselib_and_opencv_count(many):
    assert tuple(solution_counts(many[1], many[2])) == OTHERS_COUNT


def test_each_triple_has_as_many_solutions_as_poselib_finds(many):
    poselib = pytest.importorskip("poselib", reason="poselib is not installed")
    _, p_world, xy, _, of_sample = many
    ours = np.bincount(of_sample, minlength=4000)
    theirs = [
        len(poselib.p3p(list(rays), list(p)))
        for rays, p in zip(unit_rays(xy), p_world, strict=True)
    ]
    np.testing.assert_array_equal(ours, theirs)


def test_each_triple_has_as_many_solutions_as_opencv_finds(many):
    cv2 = pytest.importorskip("cv2", reason="opencv-python-headless is not installed")
    _, p_world, xy, _, of_sample = many
    ours = np.bincount(of_sample, minlength=4000)
    theirs = [
        cv2.solveP3P(p[:, None], uv[:, None].copy(), np.eye(3), None, cv2.SOLVEPNP_P3P)[0]
        for p, uv in zip(p_world, xy, strict=True)
    ]
    np.testing.assert_array_equal(ours, theirs)


def test_the_truth_is_always_among_them(many):
    Ts_true, _, _, Ts, of_sample = many
    off = np.full(4000, np.inf)
    np.minimum.at(off, of_sample, np.abs(Ts - Ts_true[of_sample]).max(axis=(1, 2)))
    assert off.max() < 1e-6


def test_every_solution_sees_the_points_where_they_were_seen(many):
    _, p_world, xy, Ts, of_sample = many
    errors = reprojection_errors(Ts, p_world[of_sample], xy[of_sample])
    assert errors.max() < 1e-6  # also: none of them is behind
    np.testing.assert_allclose(np.linalg.det(Ts[:, :3, :3]), 1.0)
    np.testing.assert_allclose(
        Ts[:, :3, :3] @ np.swapaxes(Ts[:, :3, :3], 1, 2),
        np.eye(3)[None].repeat(len(Ts), 0),
        atol=1e-9,
    )


def test_the_quartic_is_zero_at_its_solutions():
    _, p_world, xy = triples(200, seed=3)
    rays = unit_rays(xy)
    s, of_sample = three_point_lengths(p_world, rays)
    for coefficients, v in zip(quartics(p_world, rays)[of_sample], s[:, 2] / s[:, 0], strict=True):
        scale = np.abs(coefficients * v ** np.arange(4, -1, -1)).sum()
        assert abs(np.polyval(coefficients, v)) < 1e-7 * scale


@settings(max_examples=25, deadline=None)
@given(seed=st.integers(0, 10_000))
def test_moving_the_world_moves_the_answer(seed):
    _, p_world, xy = triples(1, seed)
    T_moved = exp_se3(np.random.default_rng(seed).normal(size=6))
    Ts, _ = p3p(p_world, xy)
    again, _ = p3p(apply(T_moved, p_world), xy)
    assert len(again) == len(Ts)
    for T in Ts:
        assert np.abs(again - T @ inverse(T_moved)).max(axis=(1, 2)).min() < 1e-5


@pytest.mark.parametrize(
    "p",
    [[[0, 0, 0], [1, 0, 0], [2, 0, 0]], [[0, 0, 0], [0, 0, 0], [1, 0, 0]], [[1, 1, 1]] * 3],
    ids=["line", "pair", "one"],
)
def test_points_that_determine_nothing_give_nothing(p):
    xy = np.array([[[0.0, 0.0], [0.1, 0.0], [0.2, 0.05]]])
    Ts, of_sample = p3p(np.array(p, float)[None], xy)
    assert len(Ts) == len(of_sample) == 0


def test_four_cameras_above_a_triangle_see_it_alike():
    angles = np.radians([90, 210, 330])
    p_world = np.column_stack([np.cos(angles), np.sin(angles), np.zeros(3)])[None]
    p_camera = p_world * [1, -1, -1] + [0, 0, 2.0]  # straight above
    Ts, _ = p3p(p_world, p_camera[..., :2] / p_camera[..., 2:])
    assert len(Ts) == 4
    heights = sorted(float(-(T[:3, :3].T @ T[:3, 3])[2]) for T in Ts)
    assert heights[-1] == pytest.approx(2.0)
    assert heights[0] == pytest.approx(heights[2])  # the three others, by symmetry
