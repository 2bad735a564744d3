"""The cotangent Laplacian and mixed areas: exact on linear functions and spheres, known spectra,
independent sums.
"""

import numpy as np
import pytest
import scipy
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.geometry.mesh_zoo import random_closed
from workbench.data.shapes.surfaces import plane, sphere, torus
from workbench.geometry.meshes import face_angles, face_areas, on_boundary
from workbench.geometry.meshes.laplacian import cotangent_laplacian, eigenpairs, mixed_areas

seeds = st.integers(0, 10_000)


def cotangents_one_by_one(p, faces):
    """The textbook's sum, edge by edge, in plain loops."""
    L = np.zeros((len(p), len(p)))
    angles = face_angles(p, faces)
    for face, at in zip(faces, angles, strict=True):
        for k in range(3):
            a, b = face[(k + 1) % 3], face[(k + 2) % 3]
            w = 1 / np.tan(at[k]) / 2
            L[a, b] -= w
            L[b, a] -= w
            L[a, a] += w
            L[b, b] += w
    return L


@settings(max_examples=15, deadline=None)
@given(seeds)
def test_laplacian_is_the_textbook_sum(seed):
    p, faces = random_closed(np.random.default_rng(seed), 25)
    np.testing.assert_allclose(
        cotangent_laplacian(p, faces).toarray(), cotangents_one_by_one(p, faces), atol=1e-8
    )


@settings(max_examples=20, deadline=None)
@given(seeds)
def test_laplacian_is_symmetric_semidefinite_and_kills_constants(seed):
    p, faces = random_closed(np.random.default_rng(seed), 30)
    L = cotangent_laplacian(p, faces)
    assert abs(L - L.T).max() < 1e-12
    np.testing.assert_allclose(L @ np.ones(len(p)), 0, atol=1e-9)
    assert np.linalg.eigvalsh(L.toarray()).min() > -1e-9


@settings(max_examples=10, deadline=None)
@given(seeds)
def test_linear_functions_on_a_plane_have_no_laplacian(seed):
    rng = np.random.default_rng(seed)
    flat = plane(150, jitter=0.25, rng=rng)
    inside = ~on_boundary(flat.faces, len(flat.p))
    u = flat.p @ rng.standard_normal(3)
    np.testing.assert_allclose((cotangent_laplacian(flat.p, flat.faces) @ u)[inside], 0, atol=1e-10)


@settings(max_examples=20, deadline=None)
@given(seeds)
def test_dirichlet_energy_is_that_of_the_linear_interpolant(seed):
    rng = np.random.default_rng(seed)
    p, faces = random_closed(rng, 30)
    u = rng.standard_normal(len(p))
    energy = 0.0
    for face, area in zip(faces, face_areas(p, faces), strict=True):
        edge = p[face[1:]] - p[face[0]]
        slope = np.linalg.lstsq(edge, u[face[1:]] - u[face[0]], rcond=None)[0]
        energy += area * slope @ slope
    assert u @ cotangent_laplacian(p, faces) @ u == pytest.approx(energy, rel=1e-6)


@settings(max_examples=25, deadline=None)
@given(seeds, st.floats(0.1, 10))
def test_mixed_areas_share_out_the_whole_surface(seed, scale):
    p, faces = random_closed(np.random.default_rng(seed), 40, spread=0.7)
    areas = mixed_areas(p, faces)
    assert areas.min() > 0
    assert areas.sum() == pytest.approx(face_areas(p, faces).sum(), rel=1e-12)
    np.testing.assert_allclose(mixed_areas(scale * p, faces), scale**2 * areas, rtol=1e-9)


def test_mixed_area_of_one_triangle():
    # Acute, right and obtuse: the Voronoi share, and Meyer's halves and quarters.
    face = np.array([[0, 1, 2]])
    equilateral = np.array([[0, 0, 0], [1, 0, 0], [0.5, np.sqrt(0.75), 0]])
    np.testing.assert_allclose(mixed_areas(equilateral, face), np.sqrt(0.75) / 6)
    right = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0.0]])
    np.testing.assert_allclose(mixed_areas(right, face), [0.25, 0.125, 0.125])
    obtuse = np.array([[0, 0, 0], [1, 0, 0], [-1, 1, 0.0]])
    np.testing.assert_allclose(mixed_areas(obtuse, face), [0.25, 0.125, 0.125])


def test_mixed_areas_are_voronoi_areas():
    # Inside a flat mesh without obtuse corners they are the cells that scipy's Voronoi diagram
    # finds.
    flat = plane(81, jitter=0.05, rng=np.random.default_rng(0))
    p = flat.p[:, :2]
    faces = scipy.spatial.Delaunay(p).simplices.astype(np.int64)
    cells = scipy.spatial.Voronoi(p)
    angles, areas = face_angles(flat.p, faces), mixed_areas(flat.p, faces)
    obtuse = np.unique(faces[(angles > np.pi / 2).any(axis=1)])
    inside = np.setdiff1d(np.flatnonzero(~on_boundary(flat.faces, len(p))), obtuse)
    assert len(inside) >= 3
    for i in inside:
        cell = cells.vertices[cells.regions[cells.point_region[i]]]
        assert areas[i] == pytest.approx(scipy.spatial.ConvexHull(cell).volume, rel=1e-9)


def test_spectrum_of_the_sphere():
    # Eigenvalues l (l + 1) / r^2, 2 l + 1 times each.
    ball = sphere(2500, radius=2.0)
    values, vectors = eigenpairs(ball.p, ball.faces, 16)
    true = np.concatenate([np.full(2 * n + 1, n * (n + 1) / 4) for n in range(4)])
    np.testing.assert_allclose(values, true, rtol=0.01, atol=1e-9)
    areas = mixed_areas(ball.p, ball.faces)
    np.testing.assert_allclose(vectors.T @ (areas[:, None] * vectors), np.eye(16), atol=1e-9)
    assert np.ptp(vectors[:, 0]) < 1e-9


def test_spectrum_agrees_with_a_dense_solver():
    ring = torus(400, jitter=0.2, rng=np.random.default_rng(1))
    L = cotangent_laplacian(ring.p, ring.faces).toarray()
    M = np.diag(mixed_areas(ring.p, ring.faces))
    true = scipy.linalg.eigh(L, M, eigvals_only=True)[:12]
    np.testing.assert_allclose(eigenpairs(ring.p, ring.faces, 12)[0], true, atol=1e-9)


def test_as_many_eigenpairs_as_vertices_are_refused():
    ball = sphere(12)
    with pytest.raises(ValueError, match="12 eigenpairs of a mesh with 12"):
        eigenpairs(ball.p, ball.faces, 12)
