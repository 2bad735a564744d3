"""The steps of the least-squares similarity: their end, the cost of every flip, and libraries to
distrust.
"""

import numpy as np
import pytest
import scipy
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.geometry.test_motions import motions
from workbench.algorithms.registration.procrustes import FLIPPED, Flip, procrustes
from workbench.data.shapes.rabbit import rabbit
from workbench.geometry.motions.alignment import (
    align_rigid,
    align_similarity,
    rmse,
    similarity_scale,
)
from workbench.geometry.motions.principal_axes import principal_axes

SEEDS = st.integers(0, 10_000)


def cloud(seed: int, n: int = 30) -> np.ndarray:
    return np.random.default_rng(seed).standard_normal((n, 3)) * [0.5, 0.3, 0.2]


def steps(p, q, flip: Flip = "least"):
    return {state.stage: state for state in procrustes(p, q, similarity_scale, flip=flip)}


@settings(max_examples=40, deadline=None)
@given(
    seed=SEEDS,
    T=motions(),
    scale=st.floats(0.2, 5),
    noise=st.floats(0, 0.3),
    mirrored=st.booleans(),
)
def test_the_end_is_the_best_similarity_and_the_step_before_the_best_motion(
    seed, T, scale, *, noise, mirrored
):
    p = cloud(seed)
    q = (
        (p * [1, 1, -1 if mirrored else 1]) @ T[:3, :3].T * scale
        + T[:3, 3]
        + noise * cloud(seed + 1)
    )
    states = steps(q, p)
    np.testing.assert_allclose(states["scale"].T_target_source, align_similarity(q, p), atol=1e-8)
    np.testing.assert_allclose(states["flip"].T_target_source, align_rigid(q, p), atol=1e-8)
    for state in states.values():
        assert state.rmse == pytest.approx(rmse(state.T_target_source, q, p))
    assert states["scale"].rmse <= states["flip"].rmse + 1e-12


@settings(max_examples=15, deadline=None)
@given(SEEDS, st.booleans())
def test_what_a_flip_costs_is_told_by_the_singular_values(seed, mirrored):
    p = cloud(seed)
    q = cloud(seed) * [1, 1, -1 if mirrored else 1] + 0.1 * cloud(seed + 7)
    a, b = p - p.mean(0), q - q.mean(0)
    errors = {}
    for flip in FLIPPED:
        state = steps(p, q, flip)["flip"]
        D, S = state.D, state.S
        assert D is not None
        assert S is not None
        expected = (a**2).sum(1).mean() + (b**2).sum(1).mean() - 2 * D @ S
        assert state.rmse**2 == pytest.approx(expected)
        errors[flip] = state.rmse
        handed = np.linalg.det(state.T_target_source[:3, :3])
        assert handed == pytest.approx(-1 if flip == "none" and state.mirror else 1)
    assert errors["least"] <= errors["middle"] <= errors["largest"] <= errors["whole"] + 1e-12


def test_v_turns_in_and_u_turns_out():
    p = cloud(1)
    R = scipy.spatial.transform.Rotation.from_rotvec([0.3, -1.0, 0.7]).as_matrix()
    states = steps(p @ R.T, p)
    turned_in = states["in"].T_target_source[:3, :3]
    assert np.linalg.det(turned_in) == pytest.approx(1)
    np.testing.assert_allclose(turned_in @ states["in"].V, np.eye(3), atol=1e-12)
    np.testing.assert_allclose(states["out"].T_target_source[:3, :3], R, atol=1e-12)
    assert states["out"].mirror is False


def test_two_libraries_call_a_mirror_image_a_perfect_fit():
    p = rabbit(500, np.random.default_rng(0))
    q = p * [1.0, 1.0, -1.0]
    T, _, cost = trimesh.registration.procrustes(p, q)
    assert np.linalg.det(T[:3, :3]) < 0
    assert cost < 1e-12
    assert scipy.spatial.procrustes(q, p)[2] < 1e-12
    assert steps(q, p)["scale"].rmse > 0.2
    # right in its turn, and the ratio of sizes for scale
    T, _, _ = trimesh.registration.procrustes(p, q, reflection=False)
    S = align_similarity(q, p)
    np.testing.assert_allclose(
        T[:3, :3] / np.cbrt(np.linalg.det(T[:3, :3])), steps(q, p)["flip"].T_target_source[:3, :3]
    )
    assert np.cbrt(np.linalg.det(T[:3, :3])) == pytest.approx(1, abs=1e-3)
    assert np.cbrt(np.linalg.det(S[:3, :3])) < 0.7


def test_a_library_s_smallest_box_is_larger_than_that_along_principal_axes():
    p = rabbit(1500, np.random.default_rng(0))
    along_axes = np.prod(np.ptp(p @ principal_axes(p), axis=0))
    _, extents = trimesh.bounds.oriented_bounds(p)
    assert along_axes == pytest.approx(0.515, abs=0.005)
    assert np.prod(extents) > 1.05 * along_axes


def test_flat_clouds_with_noise_are_mirrored_half_of_the_time():
    for n in (3, 10, 100):
        mirrored = 0
        for seed in range(300):
            rng = np.random.default_rng(seed)
            p = rng.normal(size=(n, 3)) * [0.5, 0.3, 0.0]
            q = p + 0.02 * rng.normal(size=p.shape)
            H = (q - q.mean(0)).T @ (p + 0.02 * rng.normal(size=p.shape) - p.mean(0))
            mirrored += np.linalg.det(H) < 0
        assert 0.4 < mirrored / 300 < 0.6
