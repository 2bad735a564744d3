"""Signed distances: closed forms against nearest points, meshes against every triangle."""

import numpy as np
import pytest
import scipy
import trimesh
from hypothesis import given
from hypothesis import strategies as st

from workbench.data.shapes import solids, surfaces
from workbench.data.shapes.rabbit import rabbit_mesh
from workbench.geometry.fields.signed_distances import box_sdf, face_tree, mesh_sdf, torus_sdf
from workbench.geometry.motions import exp_so3

HALF = np.array([0.5, 0.35, 0.25])


def some(n: int, seed: int = 0) -> np.ndarray:
    return np.random.default_rng(seed).uniform(-1, 1, (n, 3))


def test_a_box_is_as_far_as_its_nearest_point():
    q = some(2000)
    near = np.clip(q, -HALF, HALF)
    inside = (np.abs(q) < HALF).all(axis=1)
    expected = np.where(inside, -(HALF - np.abs(q)).min(axis=1), np.linalg.norm(q - near, axis=1))
    np.testing.assert_allclose(box_sdf(q, HALF), expected, atol=1e-12)


@given(st.integers(0, 1000))
def test_no_two_distances_differ_by_more_than_the_points(seed):
    p = some(20, seed)
    q = some(20, seed + 5000)
    apart = np.linalg.norm(p - q, axis=1) + 1e-12
    assert (np.abs(box_sdf(p, HALF) - box_sdf(q, HALF)) <= apart).all()
    assert (np.abs(torus_sdf(p, 0.6, 0.25) - torus_sdf(q, 0.6, 0.25)) <= apart).all()


def test_a_torus_is_as_far_as_the_nearest_of_many_points_on_it():
    q = some(300, 1)
    u, v = np.meshgrid(np.linspace(0, 2 * np.pi, 600), np.linspace(0, 2 * np.pi, 300))
    out = 0.6 + 0.25 * np.cos(v)
    on = np.stack([out * np.cos(u), out * np.sin(u), 0.25 * np.sin(v)], axis=-1).reshape(-1, 3)
    away = np.asarray(scipy.spatial.cKDTree(on).query(q)[0])
    np.testing.assert_allclose(np.abs(torus_sdf(q, 0.6, 0.25)), away, atol=3e-3)


def all_faces(p: np.ndarray, faces: np.ndarray, q: np.ndarray) -> np.ndarray:
    """Return distances by asking every triangle for every point, with trimesh."""
    corners = p[faces]
    answer = []
    for point in q:
        near = trimesh.triangles.closest_point(corners, np.tile(point, (len(faces), 1)))
        answer.append(np.linalg.norm(near - point, axis=1).min())
    return np.array(answer)


def test_a_mesh_is_as_far_as_the_nearest_of_all_its_triangles():
    p, faces = rabbit_mesh(0.05)
    q = np.concatenate([some(60, 2), p[:20], p[:20] + 0.01])
    np.testing.assert_allclose(
        np.abs(mesh_sdf(face_tree(p, faces, closed=True), q)), all_faces(p, faces, q), atol=1e-12
    )


def test_a_box_of_twelve_triangles_has_the_boxs_distances():
    made = solids.box((1.0, 0.7, 0.5))
    q = some(500, 3)
    p = made.p - [0, 0, 0.25]
    np.testing.assert_allclose(
        mesh_sdf(face_tree(p, made.faces, closed=True), q), box_sdf(q, HALF), atol=1e-12
    )


def test_distances_move_with_the_mesh():
    made = surfaces.torus(300, 0.6, 0.25)
    q = some(200, 4)
    R = exp_so3(np.array([0.3, -1.0, 2.0]))
    here = mesh_sdf(face_tree(made.p, made.faces, closed=True), q)
    moved = mesh_sdf(face_tree(made.p @ R.T + 3, made.faces, closed=True), q @ R.T + 3)
    np.testing.assert_allclose(here, moved, atol=1e-12)


def test_an_open_mesh_has_no_negative_distances():
    made = surfaces.cylinder(200)
    distances = mesh_sdf(face_tree(made.p, made.faces, closed=False), some(50, 5))
    assert (distances >= 0).all()


@pytest.mark.parametrize("corner", [0.0, 1e-9])
def test_a_single_triangle_and_one_without_area(corner):
    p = np.array([[0.0, 0, 0], [1, 0, 0], [0.5, corner, 0]])
    distances = mesh_sdf(
        face_tree(p, np.array([[0, 1, 2]]), closed=False), np.array([[0.5, 0, 2], [3, 0, 0.0]])
    )
    np.testing.assert_allclose(distances, [2, 2], atol=1e-8)


def test_no_points_have_no_distances():
    made = surfaces.sphere(42)
    assert mesh_sdf(face_tree(made.p, made.faces, closed=True), np.empty((0, 3))).shape == (0,)
