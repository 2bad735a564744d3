"""Graphs as matrices: closed-form spectra, laws of Laplacians and cuts, neighbours beside scipy and
brute force.
"""

import numpy as np
import pytest
import scipy
from hypothesis import example, given, settings
from hypothesis import strategies as st

from workbench.data import networks
from workbench.data.shapes import surfaces
from workbench.geometry.graphs import adjacency as graphs
from workbench.geometry.graphs.embedding import classical_scaling, stress_layout
from workbench.geometry.graphs.spectra import Laplacian, smallest_eigenpairs
from workbench.geometry.meshes import triangles as meshes


def plain(adjacency):
    return Laplacian(graphs.laplacian(adjacency), np.ones(adjacency.shape[0]))


def of(network):
    return graphs.graph_of(network.edges, len(network.p), network.weights)


def path(count):
    node = np.arange(count - 1)
    return graphs.graph_of(np.column_stack([node, node + 1]), count)


def some_graph(seed, count=30, chance=0.15):
    rng = np.random.default_rng(seed)
    a, b = np.nonzero(np.triu(rng.random((count, count)) < chance, 1))
    return graphs.graph_of(np.column_stack([a, b]), count, rng.uniform(0.5, 3.0, len(a)))


# neighbours ---------------------------------------------------------------------------------------


@settings(deadline=None, max_examples=25)
@given(st.integers(0, 10_000), st.integers(1, 8))
def test_neighbours_are_the_nearest_others(seed, k):
    p = np.random.default_rng(seed).normal(size=(25, 3))
    rows, d = graphs.neighbours(p, k)
    apart = np.linalg.norm(p[:, None] - p, axis=2)
    np.fill_diagonal(apart, np.inf)
    np.testing.assert_allclose(d, np.sort(apart, axis=1)[:, :k])
    np.testing.assert_allclose(d, np.take_along_axis(apart, rows, axis=1))


def test_a_point_is_not_its_own_neighbour_even_where_many_lie_at_one_place():
    p = np.concatenate([np.zeros((9, 3)), np.eye(3)])
    rows, d = graphs.neighbours(p, 3)
    assert (rows != np.arange(12)[:, None]).all()
    assert (d[:9] == 0).all()
    assert (np.diag(graphs.knn_adjacency(p, 3)) == 0).all()


@pytest.mark.parametrize("k", [0, 5, 6])
def test_too_many_or_no_neighbours_are_refused(k):
    with pytest.raises(ValueError, match=f"{k} neighbours of 5"):
        graphs.neighbours(np.eye(5)[:, :3], k)


@settings(deadline=None, max_examples=25)
@given(st.integers(0, 10_000), st.integers(1, 6))
def test_joins_are_nested_and_the_dense_union_is_the_sparse_one(seed, k):
    p = np.random.default_rng(seed).normal(size=(40, 2))
    directed = graphs.directed_graph(graphs.neighbours(p, k)[0])
    union, mutual = (graphs.joined(directed, join).toarray() for join in ("union", "mutual"))
    named = directed.toarray()
    np.testing.assert_array_equal(union, np.maximum(named, named.T))
    np.testing.assert_array_equal(mutual, named * named.T)
    np.testing.assert_array_equal(union, graphs.knn_adjacency(p, k))
    assert graphs.joined(directed, "directed") is directed
    assert graphs.one_way_share(directed) == pytest.approx(1 - mutual.sum() / named.sum())
    assert (named.sum(axis=1) == k).all()


def test_lengths_can_be_weights():
    p = np.array([[0.0, 0], [1, 0], [3, 0]])
    rows, d = graphs.neighbours(p, 1)
    named = graphs.directed_graph(rows, d).toarray()
    np.testing.assert_array_equal(named, [[0, 1, 0], [1, 0, 0], [0, 2, 0]])
    np.testing.assert_array_equal(
        graphs.joined(graphs.directed_graph(rows, d), "union").toarray(),
        [[0, 1, 0], [1, 0, 2], [0, 2, 0]],
    )


@settings(deadline=None, max_examples=25)
@given(st.integers(0, 10_000))
def test_edges_come_back(seed):
    adjacency = some_graph(seed)
    edges = graphs.edges_of(adjacency)
    assert (edges[:, 0] < edges[:, 1]).all()
    a, b = edges.T
    again = graphs.graph_of(edges, 30, np.asarray(adjacency[a, b]).ravel())
    np.testing.assert_array_equal(again.toarray(), adjacency.toarray())


def test_components_are_numbered_by_size():
    edges = np.array([[0, 1], [2, 3], [3, 4]])
    np.testing.assert_array_equal(graphs.components(graphs.graph_of(edges, 6)), [1, 1, 0, 0, 0, 2])


def test_hops():
    np.testing.assert_array_equal(graphs.hops(path(4), np.array([0]))[0], [0, 1, 2, 3])
    assert np.isinf(graphs.hops(graphs.graph_of(np.array([[0, 1]]), 3))[0, 2])


# spectra in closed form ---------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("adjacency", "values"),
    [
        (path(20), 2 - 2 * np.cos(np.pi * np.arange(20) / 20)),
        (path(320), 2 - 2 * np.cos(np.pi * np.arange(12) / 320)),  # by the sparse solver
        (of(networks.ring(20)), networks.ring(20).eigenvalues),
        (of(networks.ring(500)), networks.ring(500).eigenvalues[:9]),
        (of(networks.grid(12, 10)), networks.grid(12, 10).eigenvalues),
        (
            graphs.graph_of(np.array([[0, k] for k in range(1, 6)]), 6),
            np.array([0, 1, 1, 1, 1, 6.0]),
        ),
        (
            graphs.graph_of(np.argwhere(np.triu(np.ones((6, 6)), 1) > 0), 6),
            np.array([0, 6, 6, 6, 6, 6.0]),
        ),
    ],
)
def test_spectra_in_closed_form(adjacency, values):
    eigenvalues, functions = plain(adjacency).smallest(len(values))
    np.testing.assert_allclose(eigenvalues, values, atol=1e-11)
    np.testing.assert_allclose(functions.T @ functions, np.eye(len(values)), atol=1e-9)
    np.testing.assert_allclose(
        graphs.laplacian(adjacency) @ functions, functions * values, atol=1e-9
    )


@settings(deadline=None, max_examples=25)
@given(st.integers(0, 10_000))
def test_laws_of_the_laplacian(seed):
    adjacency = some_graph(seed)
    L = graphs.laplacian(adjacency)
    np.testing.assert_allclose(L.toarray(), graphs.laplacian(adjacency.toarray()))
    np.testing.assert_allclose(L @ np.ones(30), 0, atol=1e-12)
    u = np.random.default_rng(seed).normal(size=30)
    a, b = graphs.edges_of(adjacency).T
    weights = np.asarray(adjacency[a, b]).ravel()
    assert u @ (L @ u) == pytest.approx(weights @ (u[a] - u[b]) ** 2)
    values = np.linalg.eigvalsh(L.toarray())
    assert np.count_nonzero(np.abs(values) < 1e-9) == graphs.components(adjacency).max() + 1
    assert values[-1] <= 2 * graphs.degrees(adjacency).max() + 1e-9
    assert plain(adjacency).largest() == pytest.approx(values[-1])


@settings(deadline=None, max_examples=25)
@given(st.integers(0, 10_000))
def test_the_normalised_spectrum_ends_below_two_and_its_functions_are_orthonormal_in_the_degrees(
    seed,
):
    adjacency = some_graph(seed, chance=0.3)
    d = graphs.degrees(adjacency)
    mass = np.where(d > 0, d, 1.0)
    values, u = Laplacian(graphs.laplacian(adjacency), mass).smallest(30)
    assert values.min() > -1e-9
    assert values.max() < 2 + 1e-9
    np.testing.assert_allclose(u.T @ (mass[:, None] * u), np.eye(30), atol=1e-9)


def test_the_largest_eigenvalue_of_a_large_graph_bounds_steps():
    assert plain(of(networks.grid(20, 20))).largest() == pytest.approx(
        networks.grid(20, 20).eigenvalues[-1], rel=1e-4
    )


def test_what_has_no_eigenvectors_is_told():
    with pytest.raises(np.linalg.LinAlgError):
        smallest_eigenpairs(scipy.sparse.csr_array((400, 400)), 2)
    with pytest.raises(ValueError, match="asked for 5 eigenvectors of 4"):
        plain(path(4)).smallest(5)


def test_a_closed_mesh_of_genus_0_has_its_mean_degree():
    ball = surfaces.sphere(642)
    assert graphs.degrees(meshes.adjacency(ball.faces, 642)).mean() == pytest.approx(6 - 12 / 642)


# layers -------------------------------------------------------------------------------------------


@settings(deadline=None, max_examples=25)
@given(st.integers(0, 10_000))
def test_propagation_has_the_largest_eigenvalue_one_along_the_roots_of_degrees(seed):
    adjacency = (some_graph(seed) > 0).astype(float)
    dense = graphs.propagation(adjacency.toarray())
    np.testing.assert_allclose(dense, graphs.propagation(adjacency.tocsr()).toarray())
    np.testing.assert_allclose(dense, dense.T)
    along = np.sqrt(graphs.degrees(adjacency) + 1)
    np.testing.assert_allclose(dense @ along, along)
    values = np.linalg.eigvalsh(dense)
    assert values[0] > -1
    assert values[-1] == pytest.approx(1)


def test_a_layer_of_the_karate_club():
    adjacency = of(networks.karate()).toarray()
    assert graphs.propagation(adjacency)[0, 0] == pytest.approx(1 / 17)
    x = np.eye(34)
    w = np.random.default_rng(0).normal(size=(34, 3))
    layer = graphs.gcn_layer(adjacency, x, w)
    np.testing.assert_allclose(layer, np.maximum(graphs.propagation(adjacency) @ w, 0))
    assert (graphs.gcn_layer(np.zeros((3, 3)), np.eye(3), np.eye(3)) == np.eye(3)).all()


# cuts ---------------------------------------------------------------------------------------------


@settings(deadline=None, max_examples=25)
@given(st.integers(0, 10_000))
@example(217)  # a node without edges comes first
def test_a_sweep_is_every_cut_one_by_one(seed):
    adjacency = some_graph(seed)
    values = np.random.default_rng(seed).normal(size=30)
    order, conductances = graphs.sweep(adjacency, values)
    np.testing.assert_array_equal(order, np.argsort(values))
    for k in range(29):
        side = np.isin(np.arange(30), order[: k + 1])
        phi = graphs.conductance(adjacency, side)
        assert conductances[k] == pytest.approx(1.0 if np.isnan(phi) else phi)  # no edges at a side
        a, b = graphs.edges_of(adjacency).T
        through = side[a] != side[b]
        assert graphs.cut_weight(adjacency, side) == pytest.approx(
            np.asarray(adjacency[a, b]).ravel()[through].sum()
        )


@settings(deadline=None, max_examples=25)
@given(st.integers(0, 10_000))
def test_cheegers_inequality(seed):
    adjacency = (some_graph(seed, chance=0.3) > 0).astype(float).tocsr()
    d = graphs.degrees(adjacency)
    if d.min() == 0:
        return
    values, functions = Laplacian(graphs.laplacian(adjacency), d).smallest(2)
    best = graphs.sweep(adjacency, functions[:, 1])[1].min()
    assert values[1] / 2 - 1e-9 <= best <= np.sqrt(2 * values[1]) + 1e-9


def test_a_side_without_edges_has_no_conductance():
    adjacency = graphs.graph_of(np.array([[0, 1]]), 3)
    assert np.isnan(graphs.conductance(adjacency, np.array([False, False, True])))
    assert np.isnan(graphs.conductance(adjacency, np.zeros(3, bool)))


# embedding ----------------------------------------------------------------------------------------


@settings(deadline=None, max_examples=25)
@given(st.integers(0, 10_000))
def test_distances_of_points_give_the_points_back(seed):
    p = np.random.default_rng(seed).normal(size=(12, 3))
    apart = np.linalg.norm(p[:, None] - p, axis=2)
    points = classical_scaling(apart, 3)
    np.testing.assert_allclose(np.linalg.norm(points[:, None] - points, axis=2), apart, atol=1e-7)


def test_stress_never_rises():
    apart = graphs.hops(of(networks.karate()))
    stress = []
    for iterations in (0, 1, 2, 5, 20, 60):
        p = stress_layout(apart, 2, iterations)
        stress.append(((np.linalg.norm(p[:, None] - p, axis=2) - apart) ** 2).sum())
    assert (np.diff(stress) <= 1e-9).all()
    assert stress[-1] < 0.6 * stress[0]
