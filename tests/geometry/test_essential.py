import unittest.mock

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from workbench.geometry.cameras import intrinsics
from workbench.geometry.motions import angle_between, apply, exp_so3, motion, skew
from workbench.geometry.motions.alignment import degrees_between
from workbench.geometry.two_views.epipolar import (
    fit_fundamental,
    fundamental_from_cameras,
    sampson_distances,
)
from workbench.geometry.two_views.essential import (
    equal_singular_values,
    essential_from_fundamental,
    essential_to_poses,
    refine_motion,
)
from workbench.geometry.two_views.triangulation import before_both, camera_matrix, triangulate

seeds = st.integers(0, 2**32 - 1)
K = intrinsics(900.0, 512.0, 341.0)
L = intrinsics(860.0, 500.0, 350.0, fy=870.0)


def pair(seed: int, n: int = 40, sigma: float = 0.0):
    """Two cameras, what they see of some points, and the points."""
    rng = np.random.default_rng(seed)
    p = np.column_stack([rng.uniform(-3, 3, n), rng.uniform(-2, 2, n), rng.uniform(5, 12, n)])
    R = exp_so3(0.1 * rng.normal(size=3))
    T = motion(R, -R @ (np.array([1.0, 0.2, 0.3]) * rng.choice([-1, 1], 3)))
    uv = [np.divide(*np.split(q @ K_.T, [2], axis=1)) for K_, q in ((K, p), (L, apply(T, p)))]
    return T, p, *(x + sigma * rng.normal(size=x.shape) for x in uv)


@settings(max_examples=30, deadline=None)
@given(seed=seeds)
def test_the_true_motion_is_one_of_four_and_alone_puts_points_in_front(seed):
    T, p, uv_first, uv_second = pair(seed)
    E = essential_from_fundamental(fundamental_from_cameras(K, L, T), K, L)
    values = np.linalg.svd(E)[1]
    np.testing.assert_allclose(values / values[0], [1, 1, 0], atol=1e-9)
    Ts = essential_to_poses(E)
    assert len(Ts) == 4
    counts = [
        before_both(
            triangulate(
                camera_matrix(K, np.eye(4)), camera_matrix(L, candidate), uv_first, uv_second
            ),
            candidate,
        ).sum()
        for candidate in Ts
    ]
    assert sorted(counts) == [0, 0, 0, len(p)]
    chosen = Ts[int(np.argmax(counts))]
    assert degrees_between(chosen, T) < 1e-6
    assert angle_between(chosen[:3, 3], T[:3, 3]) < 1e-8


@settings(max_examples=40, deadline=None)
@given(seed=seeds)
def test_all_four_are_motions_of_any_matrix(seed):
    E = np.random.default_rng(seed).normal(size=(3, 3))
    nearest = equal_singular_values(E)
    for T in essential_to_poses(E):
        R = T[:3, :3]
        t = T[:3, 3]
        np.testing.assert_allclose(R.T @ R, np.eye(3), atol=1e-12)
        assert np.linalg.det(R) == pytest.approx(1)
        assert np.linalg.norm(t) == pytest.approx(1)
        G = skew(t) @ R
        np.testing.assert_allclose(
            np.abs((G * nearest).sum()), np.linalg.norm(G) * np.linalg.norm(nearest), rtol=1e-9
        )
    Ts = essential_to_poses(E)
    np.testing.assert_allclose(
        essential_to_poses(-2.0 * E)[:, :3, :3].sum(axis=0), Ts[:, :3, :3].sum(axis=0), atol=1e-9
    )
    assert degrees_between(Ts[0], Ts[2]) == pytest.approx(180, abs=1e-4)


def test_equal_singular_values_are_the_nearest_by_chance():
    rng = np.random.default_rng(0)
    E = rng.normal(size=(3, 3))
    best = np.linalg.norm(E - equal_singular_values(E))
    for _ in range(300):
        axis, t = rng.normal(size=(2, 3))
        other = skew(t) @ exp_so3(axis)
        scale = (E * other).sum() / (other * other).sum()
        assert np.linalg.norm(E - scale * other) >= best - 1e-9


@settings(max_examples=15, deadline=None)
@given(seed=seeds)
def test_refinement_lowers_the_distances_and_stays_at_the_truth_without_noise(seed):
    T, _, uv_first, uv_second = pair(seed, 40, 0.7)
    start = motion(exp_so3(np.full(3, 0.01)) @ T[:3, :3], T[:3, 3] + 0.05)

    def cost(T_second_first: np.ndarray) -> float:
        return float(
            np.square(
                sampson_distances(
                    fundamental_from_cameras(K, L, T_second_first), uv_first, uv_second
                )
            ).sum()
        )

    refined = refine_motion(start, uv_first, uv_second, K_first=K, K_second=L)
    assert np.linalg.norm(refined[:3, 3]) == pytest.approx(1)
    assert cost(refined) <= cost(T) + 1e-9
    for axis in np.eye(3):  # a minimum: every small step raises the cost
        for step in (1e-4, -1e-4):
            assert (
                cost(motion(exp_so3(step * axis) @ refined[:3, :3], refined[:3, 3]))
                >= cost(refined) - 1e-9
            )
            assert (
                cost(motion(refined[:3, :3], refined[:3, 3] + step * axis)) >= cost(refined) - 1e-9
            )
    T, _, uv_first, uv_second = pair(seed)
    refined = refine_motion(
        motion(exp_so3(np.full(3, 0.01)) @ T[:3, :3], T[:3, 3]),
        uv_first,
        uv_second,
        K_first=K,
        K_second=L,
    )
    assert degrees_between(refined, T) < 1e-5
    assert angle_between(refined[:3, 3], T[:3, 3]) < 1e-6


def test_a_motion_that_only_turns_is_refused():
    with pytest.raises(ValueError, match="without translation"):
        refine_motion(np.eye(4), np.ones((9, 2)), np.ones((9, 2)), K_first=K, K_second=K)


def test_the_fountains_motion(shared_data):
    fountain = np.load(shared_data / "ransac" / "fountain-P11" / "gt_and_matches.npz")
    good = np.abs(fountain["gt_sampson"]) < 1
    uv_first = fountain["x1"][good].astype(float)
    uv_second = fountain["x2"][good].astype(float)
    K_ = fountain["K1"]
    E = essential_from_fundamental(fit_fundamental(uv_first, uv_second), K_, K_)
    Ts = essential_to_poses(E)
    P = camera_matrix(K_, np.eye(4))
    counts = [
        before_both(triangulate(P, camera_matrix(K_, T), uv_first, uv_second), T).sum() for T in Ts
    ]
    assert sorted(counts) == [0, 0, 0, 1365]
    T = refine_motion(Ts[int(np.argmax(counts))], uv_first, uv_second, K_first=K_, K_second=K_)
    assert degrees_between(T[:3, :3], fountain["R_rel"]) < 0.05
    assert np.degrees(angle_between(T[:3, 3], fountain["t_rel"])) < 0.2
    everything = triangulate(
        P, camera_matrix(K_, T), fountain["x1"].astype(float), fountain["x2"].astype(float)
    )
    assert before_both(everything, T).sum() == pytest.approx(1428, abs=3)


@given(st.integers(0, 10_000))
def test_the_four_motions_come_in_one_order_whatever_basis_a_library_takes(seed):
    rng = np.random.default_rng(seed)
    R = exp_so3(rng.normal(size=3))
    t = rng.normal(size=3)
    E = skew(t) @ R
    expected = essential_to_poses(E)
    U, s, Vt = np.linalg.svd(E)
    turn = np.eye(3)
    turn[:2, :2] = [[np.cos(seed), -np.sin(seed)], [np.sin(seed), np.cos(seed)]]
    signs = np.diag(rng.choice([-1.0, 1.0], 3))
    # as good a decomposition, since two singular values are equal
    other = (U @ turn @ signs, s, signs @ turn.T @ Vt)
    np.testing.assert_allclose(other[0] @ np.diag(s) @ other[2], E, atol=1e-12)
    with unittest.mock.patch("numpy.linalg.svd", return_value=other):
        Ts = essential_to_poses(E)
    np.testing.assert_allclose(Ts, expected, atol=1e-9)
    assert np.trace(expected[0, :3, :3]) >= np.trace(expected[2, :3, :3])
