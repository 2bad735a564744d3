"""The second eigenfunction: orthogonal to the constant one, also where 0 is double."""

import numpy as np
import pytest
import scipy

from workbench.geometry.graphs.spectra import Laplacian


def of_path(count: int) -> Laplacian:
    ones = np.ones(count - 1)
    return of(scipy.sparse.diags_array(np.stack([ones, ones]), offsets=[-1, 1]))


def of(adjacency) -> Laplacian:
    mass = np.ones(adjacency.shape[0])
    matrix = scipy.sparse.diags_array(np.asarray(adjacency.sum(axis=1)).ravel()) - adjacency
    return Laplacian(scipy.sparse.csr_array(matrix), mass)


@pytest.mark.parametrize("count", [2, 3, 5])
def test_the_second_of_a_path_is_half_a_wave(count):
    values, second = of_path(12).second(count)
    assert len(values) == count
    expected = np.cos(np.pi * (np.arange(12) + 0.5) / 12)
    expected /= np.linalg.norm(expected)
    np.testing.assert_allclose(second * np.sign(second[0]), expected, atol=1e-9)
    np.testing.assert_allclose(values[1], 2 - 2 * np.cos(np.pi / 12), atol=1e-9)


def test_the_second_of_two_pieces_has_one_value_on_each():
    pair = scipy.sparse.csr_array(np.array([[0.0, 1.0], [1.0, 0.0]]))
    ring = scipy.sparse.csr_array(np.ones((4, 4)) - np.eye(4))
    values, second = of(scipy.sparse.block_diag([pair, ring], format="csr")).second(3)
    np.testing.assert_allclose(values[:2], 0.0, atol=1e-9)
    np.testing.assert_allclose(second.sum(), 0.0, atol=1e-9)
    np.testing.assert_allclose(np.linalg.norm(second), 1.0)
    np.testing.assert_allclose(second[:2], second[0])
    np.testing.assert_allclose(second[2:], second[2])
    assert abs(second[0]) == pytest.approx(2 * abs(second[2]))
