"""Lengths of shortest ways: networkx, closed forms on grids, points on edges, walls."""

import itertools

import networkx
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from workbench.data.shapes import surfaces
from workbench.geometry.meshes import geodesics
from workbench.geometry.meshes import triangles as meshes


def some_graph(seed, count=40, chance=0.12):
    rng = np.random.default_rng(seed)
    a, b = np.nonzero(np.triu(rng.random((count, count)) < chance, 1))
    return np.column_stack([a, b]), rng.uniform(0.1, 3.0, len(a)), count


@settings(deadline=None, max_examples=20)
@given(st.integers(0, 10_000))
def test_distances_are_networkx_s(seed):
    edges, lengths, count = some_graph(seed)
    graph = networkx.Graph()
    graph.add_nodes_from(range(count))
    graph.add_weighted_edges_from(
        (int(a), int(b), w) for (a, b), w in zip(edges, lengths, strict=True)
    )
    theirs = networkx.single_source_dijkstra_path_length(graph, 3)
    expected = [theirs.get(node, np.inf) for node in range(count)]
    np.testing.assert_allclose(geodesics.shortest_distances(edges, lengths, count, 3), expected)


def test_edges_come_either_way_round_twice_and_with_no_length():
    edges = np.array([[2, 0], [0, 2], [1, 2], [3, 1]])
    d = geodesics.shortest_distances(edges, np.array([4.0, 3.0, 1.0, 0.0]), 5, 0)
    np.testing.assert_allclose(d, [0, 4, 3, 4, np.inf])


@settings(deadline=None, max_examples=15)
@given(st.integers(0, 10_000))
def test_a_path_is_as_long_as_its_distance(seed):
    edges, lengths, count = some_graph(seed)
    d = geodesics.shortest_distances(edges, lengths, count, 0)
    goal = int(np.argmax(np.where(np.isfinite(d), d, -1)))
    path = geodesics.shortest_path(edges, lengths, d, goal=goal)
    weight = geodesics.length_graph(edges, lengths, count)
    assert path[0] == 0
    assert path[-1] == goal
    assert sum(weight[a, b] for a, b in itertools.pairwise(path)) == pytest.approx(d[goal])


def test_no_path_leads_out_of_reach():
    edges = np.array([[0, 1]])
    lengths = np.array([1.0])
    d = geodesics.shortest_distances(edges, lengths, 3, 0)
    assert len(geodesics.shortest_path(edges, lengths, d, goal=2)) == 0
    # wrong distances
    assert geodesics.shortest_path(edges, lengths, np.array([0.0, 0.0, 1.0]), goal=2).tolist() == [
        2
    ]


@pytest.mark.parametrize(("neighbours", "worst"), [(4, 41.42), (8, 8.239), (16, 2.749)])
@pytest.mark.parametrize("side", [21, 61])
def test_the_worst_error_on_a_grid_is_that_of_its_directions(neighbours, worst, side):
    x = np.linspace(0, 1, side)
    p = np.stack(np.meshgrid(x, x, indexing="ij"), axis=-1).reshape(-1, 2)
    edges = geodesics.grid_edges(side, neighbours)
    assert len(np.unique(np.sort(edges, axis=1), axis=0)) == len(edges)
    d = geodesics.shortest_distances(edges, geodesics.edge_lengths(p, edges), len(p), 0)
    true = np.linalg.norm(p, axis=1)
    assert 100 * (d[1:] / true[1:] - 1).max() == pytest.approx(worst, abs=0.011)
    assert (d >= true - 1e-12).all()
    if neighbours == 8:
        assert 1 + worst / 100 == pytest.approx(1 / np.cos(np.pi / 8), abs=1e-4)


def test_other_numbers_of_neighbours_are_refused():
    with pytest.raises(ValueError, match="4, 8 or 16"):
        geodesics.grid_edges(5, 6)


# points on edges ----------------------------------------------------------------------------------


def test_points_on_edges_come_near_the_straight_way_over_a_flat_sheet():
    flat = surfaces.plane(200, jitter=0.2, rng=np.random.default_rng(0))
    true = np.linalg.norm(flat.p - flat.p[0], axis=1)
    worst = []
    for count in (0, 1, 3, 6):
        nodes, edges, lengths = geodesics.with_points_on_edges(flat.p, flat.faces, count)
        d = geodesics.shortest_distances(edges, lengths, len(nodes), 0)[: len(flat.p)]
        assert (d >= true - 1e-9).all()
        worst.append((d[1:] / true[1:] - 1).max())
    assert (np.diff(worst) < 0).all()
    assert worst[0] > 0.05
    assert worst[-1] < 0.006


def test_points_on_edges_are_joined_within_faces_only():
    ball = surfaces.sphere(42)
    nodes, edges, lengths = geodesics.with_points_on_edges(ball.p, ball.faces, 2)
    own = len(meshes.edges(ball.faces))
    assert len(nodes) == len(ball.p) + 2 * own
    assert len(edges) == 3 * own + len(ball.faces) * (3 * 4 + 3 * 2)
    assert len(np.unique(np.sort(edges, axis=1), axis=0)) == len(edges)
    mesh_edges = meshes.edges(ball.faces)
    assert (
        lengths.max()
        <= np.linalg.norm(ball.p[mesh_edges[:, 0]] - ball.p[mesh_edges[:, 1]], axis=1).max() + 1e-12
    )
    tangle = nodes[edges].mean(axis=1)
    assert np.linalg.norm(tangle, axis=1).min() > 0.9  # on the faces, not through the ball


def test_over_a_cube_the_way_is_that_of_its_net():
    """From a corner to the opposite one of a unit cube it is sqrt(5), over the middle of an
    edge.
    """
    p = np.array([[x, y, z] for x in (0.0, 1) for y in (0.0, 1) for z in (0.0, 1)])
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    faces = np.array([t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))])
    nodes, edges, lengths = geodesics.with_points_on_edges(p, faces, 9)
    d = geodesics.shortest_distances(edges, lengths, len(nodes), 0)
    assert d[7] == pytest.approx(np.sqrt(5), rel=2e-3)
    assert d[7] >= np.sqrt(5) - 1e-12


# walls --------------------------------------------------------------------------------------------


def test_the_way_round_a_wall():
    tip = np.array([0.0, 0.3])
    q = np.array([-0.3, 0.0])
    p = np.array([[0.3, -0.2], [0.3, 0.6], [-0.2, -0.4], [0.3, 0.61], [0.0, 0.4]])
    d = geodesics.distance_past_wall(p, q, tip)
    straight = np.linalg.norm(p - q, axis=1)
    assert d[0] == pytest.approx(np.hypot(0.3, 0.3) + np.hypot(0.3, 0.5))
    np.testing.assert_allclose(d[1:], straight[1:])  # seen past the tip, or on this side
    back = [geodesics.distance_past_wall(q[None], point, tip)[0] for point in p]
    np.testing.assert_allclose(back, d)


def test_segments_that_cross_the_wall():
    tip = np.array([0.0, 0.3])
    segments = np.array(
        [
            [[-0.1, 0.0], [0.1, 0.0]],
            [[-0.1, 0.29], [0.1, 0.29]],
            [[-0.1, 0.31], [0.1, 0.31]],
            [[-0.1, 0.2], [0.0, 0.3]],
            [[-0.1, 0.0], [-0.2, 0.0]],
            [[0.0, 0.3], [0.0, 0.4]],
            [[0.0, 0.1], [0.0, 0.2]],
        ]
    )
    assert geodesics.crosses_wall(segments, tip).tolist() == [
        True,
        True,
        False,
        False,
        False,
        False,
        True,
    ]
