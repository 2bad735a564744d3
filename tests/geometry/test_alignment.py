"""Alignment of pairs: exactness, equivariance, optimality, and every degenerate input by name."""

import numpy as np
import pytest
import scipy
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.geometry.test_motions import motions
from workbench.geometry.motions import apply, exp_se3, exp_so3, inverse, motion, rotation_angle
from workbench.geometry.motions.alignment import (
    align_affine,
    align_rigid,
    align_similarity,
    degrees_between,
    motion_error,
    nearest_rotation,
    point_to_plane_step,
    rmse,
    similarity_scale,
)

SEEDS = st.integers(0, 10_000)
ALIGN = {"rigid": align_rigid, "similarity": align_similarity, "affine": align_affine}


def cloud(seed: int, n: int = 30) -> np.ndarray:
    return np.random.default_rng(seed).standard_normal((n, 3))


def is_rotation(R: np.ndarray) -> bool:
    return bool(np.allclose(R @ R.T, np.eye(3), atol=1e-9) and np.linalg.det(R) > 0)


@settings(max_examples=40, deadline=None)
@given(SEEDS, motions())
def test_noiseless_pairs_give_the_motion_exactly(seed, T):
    p = cloud(seed)
    for align in ALIGN.values():
        np.testing.assert_allclose(align(apply(T, p), p), T, atol=1e-9)


@settings(max_examples=40, deadline=None)
@given(SEEDS, st.floats(0.05, 20), motions())
def test_similarity_finds_the_scale_and_affine_the_shear(seed, scale, T):
    p = cloud(seed)
    S = T @ np.diag([scale, scale, scale, 1.0])
    np.testing.assert_allclose(align_similarity(apply(S, p), p), S, atol=1e-8)
    A = np.eye(4)
    A[:3] += 0.5 * np.random.default_rng(seed + 1).standard_normal((3, 4))
    np.testing.assert_allclose(align_affine(apply(A, p), p), A, atol=1e-9)


@settings(max_examples=40, deadline=None)
@given(SEEDS, motions(), motions())
def test_moving_target_and_source_moves_the_answer(seed, T_new_target, T_new_source):
    p_target = cloud(seed)
    p_source = cloud(seed + 1)
    p_target = p_source @ exp_so3(np.array([0.3, 0.2, -0.5])).T + 0.1 * p_target
    for align in ALIGN.values():
        T = align(p_target, p_source)
        moved = align(apply(T_new_target, p_target), apply(T_new_source, p_source))
        np.testing.assert_allclose(moved, T_new_target @ T @ inverse(T_new_source), atol=1e-8)


@settings(max_examples=25, deadline=None)
@given(SEEDS, SEEDS)
def test_no_motion_nearby_is_better(seed, other):
    p_target = cloud(seed)
    p_source = cloud(seed + 1)
    T = align_rigid(p_target, p_source)
    best = rmse(T, p_target, p_source)
    for twist in 0.01 * np.random.default_rng(other).standard_normal((10, 6)):
        assert rmse(exp_se3(twist) @ T, p_target, p_source) >= best - 1e-12
    assert rmse(align_affine(p_target, p_source), p_target, p_source) <= best
    assert rmse(align_similarity(p_target, p_source), p_target, p_source) <= best


@settings(max_examples=40, deadline=None)
@given(SEEDS)
def test_rigid_agrees_with_scipy_with_and_without_weights(seed):
    p_target = cloud(seed)
    p_source = cloud(seed + 1)
    weights = np.random.default_rng(seed).random(len(p_target))
    for w in (None, weights):
        mean_t, mean_s = (np.average(p, axis=0, weights=w) for p in (p_target, p_source))
        R, _ = scipy.spatial.transform.Rotation.align_vectors(
            p_target - mean_t, p_source - mean_s, weights=w
        )
        T = align_rigid(p_target, p_source, w)
        np.testing.assert_allclose(T[:3, :3], R.as_matrix(), atol=1e-8)
        np.testing.assert_allclose(T[:3, 3], mean_t - R.as_matrix() @ mean_s, atol=1e-8)


@settings(max_examples=40, deadline=None)
@given(SEEDS)
def test_a_weight_of_two_is_the_pair_twice_and_of_zero_not_at_all(seed):
    p_target = cloud(seed)
    p_source = cloud(seed + 1)
    weights = np.array([0.0] * 5 + [2.0] * 5 + [1.0] * 20)
    rows = np.repeat(np.arange(30), weights.astype(int))
    for align in ALIGN.values():
        np.testing.assert_allclose(
            align(p_target, p_source, weights), align(p_target[rows], p_source[rows]), atol=1e-9
        )


@settings(max_examples=40, deadline=None)
@given(SEEDS)
def test_a_mirrored_cloud_gets_the_best_rotation_not_a_reflection(seed):
    p = cloud(seed)
    R = align_rigid(p * [1.0, 1.0, -1.0], p)[:3, :3]
    assert is_rotation(R)
    R = align_similarity(-p, p)[:3, :3]
    assert np.linalg.det(R) > 0


@pytest.mark.parametrize("seed", range(5))
def test_flat_noisy_pairs_never_mirror(seed):
    rng = np.random.default_rng(seed)
    p = rng.standard_normal((40, 3)) * [1, 1, 0]
    R = exp_so3(rng.standard_normal(3))
    estimate = align_rigid(p @ R.T + 0.05 * rng.standard_normal((40, 3)), p)
    assert is_rotation(estimate[:3, :3])
    assert np.degrees(rotation_angle(estimate[:3, :3] @ R.T)) < 3.0


@pytest.mark.parametrize("offset", [1e6, -1e6])
def test_far_from_the_origin_no_digits_are_lost(offset):
    p = cloud(0, 20_000)
    R = exp_so3(np.array([0.1, -0.4, 0.2]))
    p_target = p @ R.T + offset
    for align in ALIGN.values():
        T = align(p_target, p + offset)
        # the points themselves carry 1e-10 at this offset; moments about the origin would be a
        # degree off
        assert np.degrees(rotation_angle(nearest_rotation(T[:3, :3]) @ R.T)) < 1e-7
        assert rmse(T, p_target, p + offset) < 1e-6


def test_chunks_do_not_show(monkeypatch):
    p_target, p_source = cloud(3, 100), cloud(4, 100)
    weights = np.random.default_rng(5).random(100)
    n = p_target / np.linalg.norm(p_target, axis=1, keepdims=True)
    whole = [f(p_target, p_source, weights) for f in ALIGN.values()] + [
        point_to_plane_step(p_target, p_source, n)
    ]
    monkeypatch.setattr("workbench.geometry.motions.alignment.CHUNK", 7)
    parts = [f(p_target, p_source, weights) for f in ALIGN.values()] + [
        point_to_plane_step(p_target, p_source, n)
    ]
    np.testing.assert_allclose(whole, parts, atol=1e-12)


@pytest.mark.parametrize("align", ALIGN.values(), ids=ALIGN)
class TestDegenerate:
    def test_one_pair_is_a_translation(self, align):
        T = align(np.array([[1.0, 2.0, 3.0]]), np.array([[0.0, 0.0, 1.0]]))
        np.testing.assert_allclose(T, motion(np.eye(3), np.array([1.0, 2.0, 2.0])), atol=1e-12)

    def test_duplicates_are_a_translation(self, align):
        T = align(np.ones((5, 3)), np.zeros((5, 3)))
        np.testing.assert_allclose(T, motion(np.eye(3), np.ones(3)), atol=1e-12)

    def test_two_pairs_and_collinear_points_are_brought_together(self, align):
        line = np.outer(np.arange(5.0), [1.0, 2.0, -1.0])
        for p in (line[:2], line):
            p_target = p @ exp_so3(np.array([0.5, 1.0, -2.0])).T + [1.0, 0.0, 2.0]
            T = align(p_target, p)
            assert np.isfinite(T).all()
            np.testing.assert_allclose(apply(T, p), p_target, atol=1e-9)

    def test_coplanar_points_are_brought_together(self, align):
        p = cloud(1) * [1.0, 1.0, 0.0]
        T = motion(exp_so3(np.array([0.5, 1.0, -2.0])), np.array([1.0, 0.0, 2.0]))
        estimate = align(apply(T, p), p)
        np.testing.assert_allclose(apply(estimate, p), apply(T, p), atol=1e-9)
        if align is not align_affine:
            np.testing.assert_allclose(estimate, T, atol=1e-9)

    def test_misuse_is_refused(self, align):
        p = cloud(2)
        with pytest.raises(ValueError, match="no pairs"):
            align(np.empty((0, 3)), np.empty((0, 3)))
        nan = p.copy()
        nan[3, 1] = np.nan
        with pytest.raises(ValueError, match="finite"):
            align(p, nan)
        with pytest.raises(ValueError, match="at least zero"):
            align(p, p, -np.ones(30))
        with pytest.raises(ValueError, match="zero"):
            align(p, p, np.zeros(30))


def test_pairs_must_be_as_many_on_both_sides():
    from workbench.geometry.motions.alignment import _check_pairs

    with pytest.raises(ValueError, match="3 and 4"):
        _check_pairs(np.zeros((3, 3)), np.zeros((4, 3)))


def on_a_sphere(n: int) -> np.ndarray:
    u = np.random.default_rng(12345).standard_normal((n, 3))
    return u / np.linalg.norm(u, axis=1, keepdims=True)


@settings(max_examples=30, deadline=None)
@given(SEEDS)
def test_the_plane_step_solves_the_linear_problem(seed):
    rng = np.random.default_rng(seed)
    p_target = cloud(seed)
    p_source = cloud(seed) + 0.01 * rng.random((30, 3))
    n = on_a_sphere(30)
    jacobian = np.hstack([np.cross(p_source - p_source.mean(0), n), n])
    x = np.linalg.lstsq(jacobian, np.einsum("ij,ij->i", p_target - p_source, n), rcond=None)[0]
    R = exp_so3(x[:3])
    centre = p_source.mean(0)
    expected = motion(R, centre + x[3:] - R @ centre)
    np.testing.assert_allclose(point_to_plane_step(p_target, p_source, n), expected, atol=1e-9)


def test_plane_steps_converge_to_the_motion_quadratically():
    p = cloud(7, 200)
    n = on_a_sphere(200)
    T = exp_se3(np.array([0.1, -0.2, 0.05, 0.2, -0.1, 0.3]))
    p_target = apply(T, p)
    n_target = n @ T[:3, :3].T
    estimate = np.eye(4)
    errors = []
    for _ in range(5):
        estimate = point_to_plane_step(p_target, apply(estimate, p), n_target) @ estimate
        errors.append(rotation_angle(estimate[:3, :3] @ T[:3, :3].T))
    assert errors[1] < errors[0] ** 2 * 10
    np.testing.assert_allclose(estimate, T, atol=1e-12)


def test_the_plane_step_is_equivariant_and_right_far_away():
    p = cloud(8, 500)
    n = on_a_sphere(500)
    p_target = p + 0.01 * cloud(9, 500)
    step = point_to_plane_step(p_target, p, n)
    T = motion(exp_so3(np.array([1.0, -0.5, 2.0])), np.array([3.0, 1.0, -2.0]))
    moved = point_to_plane_step(apply(T, p_target), apply(T, p), n @ T[:3, :3].T)
    np.testing.assert_allclose(moved, T @ step @ inverse(T), atol=1e-10)
    far = point_to_plane_step(p_target + 1e6, p + 1e6, n)
    np.testing.assert_allclose(far[:3, :3], step[:3, :3], atol=1e-9)


def test_a_single_plane_holds_only_three_directions():
    rng = np.random.default_rng(2)
    p = rng.uniform(-1, 1, (100, 3)) * [1, 1, 0]
    step = point_to_plane_step(p, p + np.array([0.3, 0.2, 0.1]), np.tile([0.0, 0.0, 1.0], (100, 1)))
    np.testing.assert_allclose(step, motion(np.eye(3), np.array([0.0, 0.0, -0.1])), atol=1e-12)


def test_the_plane_step_refuses_what_it_cannot_use():
    p, n = cloud(1), on_a_sphere(30)
    with pytest.raises(ValueError, match="no pairs"):
        point_to_plane_step(p[:0], p[:0], n[:0])
    n[0] = np.nan
    with pytest.raises(ValueError, match="finite"):
        point_to_plane_step(p, p, n)


@settings(max_examples=40, deadline=None)
@given(SEEDS)
def test_the_nearest_rotation_is_the_polar_one(seed):
    A = np.random.default_rng(seed).standard_normal((3, 3))
    if np.linalg.det(A) > 0:
        np.testing.assert_allclose(nearest_rotation(A), scipy.linalg.polar(A)[0], atol=1e-8)
    assert is_rotation(nearest_rotation(A))


@settings(max_examples=40, deadline=None)
@given(motions(), motions(), motions())
def test_the_angle_between_motions_is_a_distance_that_no_common_motion_changes(A, B, C):
    theirs = scipy.spatial.transform.Rotation.from_matrix(A[:3, :3].T @ B[:3, :3]).magnitude()
    assert degrees_between(A, B) == pytest.approx(np.degrees(theirs), abs=1e-6)
    assert degrees_between(A[:3, :3], B[:3, :3]) == pytest.approx(degrees_between(B, A), abs=1e-9)
    assert degrees_between(C @ A, C @ B) == pytest.approx(degrees_between(A, B), abs=1e-6)
    assert degrees_between(A, A) < 1e-6


@pytest.mark.parametrize("degrees", [0.0, 1e-7, 90.0, 180.0 - 1e-7, 180.0])
def test_scale_and_shear_do_not_count_as_turning(degrees):
    turned = exp_so3(np.radians([0.0, degrees, 0.0]))
    assert degrees_between(turned @ np.diag([2.0, 3.0, 0.5]), np.eye(3)) == pytest.approx(
        degrees, rel=1e-6, abs=1e-12
    )


def test_the_error_of_a_motion_is_what_was_added_to_the_truth():
    rng = np.random.default_rng(0)
    p = rng.normal(size=(50, 3))
    T_true = motion(exp_so3(rng.normal(size=3)), rng.normal(size=3))
    shifted = motion_error(motion(np.eye(3), np.array([0.3, 0.0, 0.4])) @ T_true, T_true, p)
    assert (shifted.rotation, shifted.translation, shifted.displacement) == pytest.approx(
        (0, 0.5, 0.5), abs=1e-9
    )
    centre = apply(T_true, p).mean(axis=0)
    turn = exp_so3(np.array([0.0, 0.0, np.radians(20)]))
    turned = motion_error(motion(turn, centre - turn @ centre) @ T_true, T_true, p)
    assert (turned.rotation, turned.translation) == pytest.approx((20, 0), abs=1e-9)
    # a chord of 20 degrees at each radius
    far = np.linalg.norm((apply(T_true, p) - centre)[:, :2], axis=1)
    assert turned.displacement == pytest.approx(
        2 * np.sin(np.radians(10)) * np.sqrt(np.mean(far**2))
    )
    unknown = motion_error(T_true, None, p)
    assert np.isnan([unknown.rotation, unknown.translation, unknown.displacement]).all()


@settings(max_examples=40, deadline=None)
@given(seed=SEEDS, scale=st.floats(0.05, 20), T=motions(), noise=st.floats(0, 0.5))
def test_the_scale_is_that_of_the_similarity_and_noise_makes_there_and_back_less_than_one(
    seed, scale, T, *, noise
):
    p = cloud(seed)
    q = scale * (apply(T, p) + noise * cloud(seed + 1))
    S = align_similarity(q, p)
    assert similarity_scale(q, p) == pytest.approx(np.cbrt(np.linalg.det(S[:3, :3])))
    product = similarity_scale(q, p) * similarity_scale(p, q)
    assert product <= 1 + 1e-12
    assert product == pytest.approx(1) or noise > 0


def test_a_scale_that_nothing_tells_is_one_and_no_pairs_have_none():
    p = cloud(0)
    assert similarity_scale(p, np.ones_like(p)) == 1
    assert similarity_scale(p[:1], p[:1]) == 1
    with pytest.raises(ValueError, match="no pairs"):
        similarity_scale(p[:0], p[:0])
