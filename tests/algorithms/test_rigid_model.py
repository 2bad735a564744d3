"""Rigid motions from matched points: exact, as good from anywhere, and found among outliers."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from workbench.algorithms.robust.models import RIGID
from workbench.algorithms.robust.ransac import Judge, ransac
from workbench.algorithms.robust.samplers import uniform_samples
from workbench.geometry.motions import apply, exp_so3, inverse, motion
from workbench.geometry.motions.alignment import align_rigid, motion_error


def a_motion(rng: np.random.Generator) -> np.ndarray:
    return motion(exp_so3(2 * rng.normal(size=3)), rng.normal(size=3))


@given(seed=st.integers(0, 200))
def test_three_exact_matches_give_the_motion(seed):
    rng = np.random.default_rng(seed)
    T = a_motion(rng)
    p = rng.normal(size=(3, 3))
    pairs = np.hstack([p, apply(T, p)])
    (T_target_source,) = RIGID.solve(pairs[None])
    np.testing.assert_allclose(RIGID.distances(T_target_source, pairs), 0, atol=1e-9)
    np.testing.assert_allclose(RIGID.refit(pairs), T_target_source, atol=1e-6)
    noisy = np.stack([pairs + 0.01 * rng.normal(size=pairs.shape) for _ in range(4)])
    several = RIGID.solve(noisy)
    assert len(several) <= len(noisy)
    if len(several) == len(noisy):
        np.testing.assert_allclose(
            several, [align_rigid(sample[:, 3:], sample[:, :3]) for sample in noisy], atol=1e-7
        )


@given(seed=st.integers(0, 200))
def test_moving_both_sides_moves_the_answer(seed):
    rng = np.random.default_rng(seed)
    T = a_motion(rng)
    A = a_motion(rng)
    B = a_motion(rng)
    p = rng.normal(size=(3, 3))
    q = apply(T, p) + 0.01 * rng.normal(size=(3, 3))
    (T_target_source,) = RIGID.solve(np.hstack([p, q])[None])
    (again,) = RIGID.solve(np.hstack([apply(A, p), apply(B, q)])[None])
    np.testing.assert_allclose(again, B @ T_target_source @ inverse(A), atol=1e-8)


def test_triangles_of_different_sides_are_dropped():
    p = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]])
    samples = np.stack([np.hstack([p, q]) for q in (p, 1.2 * p, p[:, ::-1], 0 * p, p * [1, -1, 1])])
    motions = RIGID.solve(samples)
    # as it is, exchanged axes, and mirrored, which three points do not tell
    assert motions.shape == (3, 4, 4)
    assert RIGID.solve(np.zeros((1, 3, 6))).shape == (0, 4, 4)


def test_the_refit_is_that_of_all_inliers_and_weights_count():
    rng = np.random.default_rng(3)
    p = rng.normal(size=(20, 3))
    q = rng.normal(size=(20, 3))
    w = rng.uniform(size=20)
    np.testing.assert_allclose(RIGID.refit(np.hstack([p, q]), w), align_rigid(q, p, w))
    several = np.stack([a_motion(rng) for _ in range(4)])
    rows = np.hstack([p, q])
    np.testing.assert_allclose(
        RIGID.distances(several, rows), [RIGID.distances(T, rows) for T in several]
    )


@pytest.mark.parametrize("seed", range(3))
def test_ransac_finds_the_motion_among_three_quarters_of_outliers(seed):
    rng = np.random.default_rng(seed)
    T = a_motion(rng)
    p = rng.normal(size=(120, 3))
    q = apply(T, p) + 0.01 * rng.normal(size=p.shape)
    q[:90] = apply(T, rng.normal(size=(90, 3)))
    rows = np.hstack([p, q])
    samples = uniform_samples(len(rows), 3, np.random.default_rng(seed))
    *_, last = ransac(
        rows, RIGID, samples, judge=Judge(rows, RIGID, 0.05), confidence=0.999, max_iterations=4000
    )
    assert last.best is not None
    assert last.best.inliers[90:].all()
    assert motion_error(last.best.estimate, T, p[90:]).rotation < 1.0
