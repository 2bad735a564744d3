"""Edges flipped within a surface: the triangulation of scipy in the plane, the same surface, and no
negative weight.
"""

import numpy as np
import pytest
import scipy

from workbench.algorithms.surfaces.heat_method import HeatMethod, mean_edge_length
from workbench.data.shapes import surfaces
from workbench.data.shapes.rabbit import rabbit_mesh
from workbench.geometry.meshes import corners
from workbench.geometry.meshes.intrinsic import intrinsic_delaunay
from workbench.geometry.meshes.laplacian import (
    cotangent_laplacian,
    cotangent_laplacian_of,
    negative_weights,
)
from workbench.geometry.polylines import at_height


def sheared(side: int, shear: float) -> tuple[np.ndarray, np.ndarray]:
    """A grid of triangles that becomes obtuse as it is sheared, moved a little so that no four
    points are on a circle.
    """
    x = np.arange(float(side))
    flat = np.stack(np.meshgrid(x, x, indexing="ij"), axis=-1).reshape(-1, 2)
    flat += np.random.default_rng(0).uniform(-0.1, 0.1, flat.shape)
    corner = (np.arange(side - 1)[:, None] * side + np.arange(side - 1)).ravel()
    faces = np.concatenate(
        [corner[:, None] + [0, side, side + 1], corner[:, None] + [0, side + 1, 1]]
    )
    return at_height(flat @ np.array([[1.0, 0.0], [shear, 1.0]])), faces


def wrung(count: int, turn: float) -> tuple[np.ndarray, np.ndarray]:
    ball = surfaces.sphere(count)
    x, y, z = ball.p.T
    return np.column_stack(
        [
            np.cos(turn * z) * x - np.sin(turn * z) * y,
            np.sin(turn * z) * x + np.cos(turn * z) * y,
            z,
        ]
    ), (ball.faces)


def test_in_the_plane_it_is_the_triangulation_of_scipy():
    p, faces = sheared(9, 2.3)
    ours = {tuple(sorted(face)) for face in intrinsic_delaunay(p, faces).vertices.T.tolist()}
    hull = {tuple(sorted(face)) for face in scipy.spatial.Delaunay(p[:, :2]).simplices.tolist()}
    # away from the border
    deep = [face for face in hull if all(1 <= v // 9 <= 7 and 1 <= v % 9 <= 7 for v in face)]
    assert len(deep) > 40
    assert set(deep) <= ours
    assert not set(deep) <= {tuple(sorted(face)) for face in faces.tolist()}


@pytest.mark.parametrize(
    ("p", "faces"),
    [wrung(642, 3.0), rabbit_mesh(0.05), (rabbit_mesh(0.05)[0] * [1, 1, 6], rabbit_mesh(0.05)[1])],
)
def test_no_weight_is_negative_and_the_surface_is_the_same(p, faces):
    before, after = corners(p, faces), intrinsic_delaunay(p, faces)
    assert negative_weights(before) > 0
    assert negative_weights(after) == 0
    assert after.double_areas.sum() == pytest.approx(before.double_areas.sum())
    # round every vertex
    np.testing.assert_allclose(after.sums(after.angles), before.sums(before.angles), atol=1e-6)
    L = cotangent_laplacian_of(after)
    np.testing.assert_allclose(L @ np.ones(len(p)), 0, atol=1e-9)
    rng = np.random.default_rng(1)
    for u in rng.normal(
        size=(5, len(p))
    ):  # Rippa: of all triangulations Delaunay's has the least Dirichlet energy
        assert u @ (L @ u) < u @ (cotangent_laplacian(p, faces) @ u)


def test_a_delaunay_mesh_stays_as_it_is():
    ball = surfaces.sphere(642)
    np.testing.assert_array_equal(
        intrinsic_delaunay(ball.p, ball.faces).vertices, corners(ball.p, ball.faces).vertices
    )


def test_distances_below_zero_are_mended():
    p, faces = rabbit_mesh(0.05)
    p = p * [1, 1, 6]
    time = mean_edge_length(p, faces) ** 2
    source = np.random.default_rng(0).integers(len(p), size=8)
    below = []
    for measured in (corners(p, faces), intrinsic_delaunay(p, faces)):
        method = HeatMethod(measured, time)
        columns = method.heat(source).T
        d = [
            method.distances(method.directions(u), int(s))
            for u, s in zip(columns, source, strict=True)
        ]
        below.append((float(np.mean(np.array(d) < -1e-9)), float(columns.min())))
    assert below[0][0] > 0.02
    assert below[1][0] == 0
    assert below[1][1] > 0 > below[0][1]
