"""Jacobi's rotations: laws of every step, eigenvalues against numpy, and matrices that need none or
never end.
"""

import itertools

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from workbench.algorithms.registration.jacobi import TOLERANCE, jacobi

MATRICES = st.tuples(st.integers(0, 10_000), st.integers(2, 6))


def symmetric(seed: int, n: int = 3) -> np.ndarray:
    A = np.random.default_rng(seed).normal(size=(n, n))
    return A + A.T


@settings(max_examples=30, deadline=None)
@given(MATRICES)
def test_every_rotation_takes_one_entry_and_twice_its_square(drawn):
    C = symmetric(*drawn)
    for before, after in itertools.pairwise(jacobi(C)):
        i, j = after.plane or (0, 0)
        aside = np.abs(before.A - np.diag(np.diag(before.A)))
        assert aside[i, j] == pytest.approx(aside.max())
        assert abs(after.A[i, j]) < 1e-12 * np.linalg.norm(C)
        assert abs(after.angle) <= np.pi / 4 + 1e-12
        norm = float(np.linalg.norm(C))
        assert (after.off * norm) ** 2 == pytest.approx(
            (before.off * norm) ** 2 - 2 * before.A[i, j] ** 2, abs=1e-10 * norm**2
        )
        np.testing.assert_allclose(after.V.T @ C @ after.V, after.A, atol=1e-11 * norm)
        np.testing.assert_allclose(after.V.T @ after.V, np.eye(len(C)), atol=1e-12)
        assert np.linalg.det(after.V) == pytest.approx(1)


@settings(max_examples=30, deadline=None)
@given(MATRICES)
def test_the_end_is_the_eigenvalues(drawn):
    C = symmetric(*drawn)
    *_, last = jacobi(C)
    assert last.off < 10 * TOLERANCE
    np.testing.assert_allclose(
        np.sort(np.diag(last.A)), np.linalg.eigvalsh(C), atol=1e-10 * float(np.linalg.norm(C))
    )


def test_three_by_three_takes_five_to_ten_rotations():
    counts = [len(list(jacobi(symmetric(seed)))) - 1 for seed in range(300)]
    assert min(counts) >= 4
    assert max(counts) <= 10
    assert 6 <= np.median(counts) <= 8


@pytest.mark.parametrize(
    "C", [np.diag([3.0, 2, 1]), np.eye(3), np.zeros((3, 3)), np.diag([1.0, 1, 2]), np.eye(1)]
)
def test_a_diagonal_matrix_is_left_as_it_is(C):
    (only,) = jacobi(C)
    assert only.off == 0
    assert only.plane is None


def test_a_matrix_that_is_no_number_ends_at_once():
    assert len(list(jacobi(np.full((3, 3), np.nan)))) == 1


def test_equal_eigenvalues_and_tiny_matrices_end_too():
    R = np.linalg.qr(np.random.default_rng(0).normal(size=(3, 3)))[0]
    for scale in (1e-20, 1.0, 1e20):
        *_, last = jacobi(scale * (R @ np.diag([2.0, 2.0, 1.0]) @ R.T))
        np.testing.assert_allclose(np.sort(np.diag(last.A)), scale * np.array([1, 2, 2]), rtol=1e-9)
