"""Graphs at their ends: no neighbours, loops, two ways, weights that hops do not count."""

import numpy as np
import pytest
import scipy

from workbench.geometry.graphs import edges_of, hops


def test_an_edge_is_listed_once_smaller_first_and_a_loop_never():
    weights = np.zeros((4, 4))
    for a, b in ((3, 0), (0, 1), (1, 0), (2, 2), (2, 3)):
        weights[a, b] = 0.5
    assert edges_of(scipy.sparse.csr_array(weights)).tolist() == [[0, 1], [0, 3], [2, 3]]


def test_hops_count_edges_whatever_they_weigh_and_whichever_way_they_go():
    adjacency = scipy.sparse.csr_array(
        np.array([[0.0, 5.0, 0.0, 0.0], [0.0, 0.0, 0.1, 0.0], [0.0] * 4, [0.0] * 4])
    )
    np.testing.assert_array_equal(
        hops(adjacency, np.array([0, 2])), [[0, 1, 2, np.inf], [2, 1, 0, np.inf]]
    )
    assert hops(adjacency).shape == (4, 4)
    assert hops(adjacency)[0, 2] == pytest.approx(2)
