"""Angle defects and cotangents: exact cases, analytic surfaces, laws of scale and sign,
Gauss-Bonnet, borders.
"""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.geometry.mesh_zoo import CUBE, TETRAHEDRON, random_closed
from workbench.data.files import read_mesh
from workbench.data.shapes.surfaces import SURFACES, cylinder, plane, scaled, sphere, torus
from workbench.geometry.meshes import curvature, on_boundary, vertex_normals
from workbench.geometry.meshes.laplacian import cotangent_laplacian, mixed_areas
from workbench.geometry.motions import exp_so3

seeds = st.integers(0, 10_000)


def relative(estimate, true):
    """Relative L2 error over the vertices where both are known."""
    known = np.isfinite(estimate)
    return np.linalg.norm((estimate - true)[known]) / np.linalg.norm(true[known])


def test_polyhedra_by_hand():
    # Three right angles meet at a cube's corner, three of 60 degrees at a tetrahedron's.
    np.testing.assert_allclose(curvature.angle_defects(*CUBE), np.pi / 2)
    np.testing.assert_allclose(curvature.angle_defects(*TETRAHEDRON), np.pi)
    area = 4 * np.sqrt(3) / 4 * 8 / 4
    np.testing.assert_allclose(curvature.gaussian_curvature(*TETRAHEDRON), np.pi / area)


def test_inscribed_spheres_have_exactly_their_mean_curvature():
    # Where no triangle is obtuse, sum w |e|^2 / 2 r = 2 A / r: the cotangent formula is exact in
    # the direction of n.
    ball = sphere(600, radius=2.0, jitter=0.1, rng=np.random.default_rng(0))
    outward = np.einsum(
        "vx,vx->v", curvature.mean_curvature_normals(ball.p, ball.faces), ball.normals
    )
    np.testing.assert_allclose(outward, 2 / 2.0, rtol=1e-12)


@pytest.mark.parametrize(("K", "H"), [(0.0005, 0.0003)])
def test_regular_torus_at_20k(K, H):
    ring = torus(20_000)
    curvatures = curvature.curvatures(ring.p, ring.faces)
    assert relative(curvatures.gaussian, ring.gaussian) < K
    assert relative(curvatures.mean, ring.mean) < H
    assert relative(curvatures.k1, ring.k1) < 0.001
    assert relative(curvatures.k2, ring.k2) < 0.001


def test_errors_of_a_regular_mesh_fall_with_the_square_of_its_edges():
    errors = [
        relative(curvature.gaussian_curvature(s.p, s.faces), s.gaussian)
        for s in map(torus, (500, 2000, 8000))
    ]
    np.testing.assert_allclose(np.log2(np.array(errors[:-1]) / errors[1:]), 2.0, atol=0.15)


def test_errors_of_an_irregular_mesh_stay():
    rings = [torus(count, jitter=0.2, rng=np.random.default_rng(0)) for count in (2000, 20_000)]
    curvatures = [curvature.curvatures(ring.p, ring.faces) for ring in rings]
    for ring, c in zip(rings, curvatures, strict=True):
        assert 0.08 < relative(c.gaussian, ring.gaussian) < 0.16
        assert 0.07 < relative(c.mean, ring.mean) < 0.16


@pytest.mark.parametrize("name", ["sphere", "cylinder", "saddle", "catenoid", "plane"])
def test_regular_meshes_of_known_surfaces(name):
    surface = SURFACES[name](5000)
    curvatures = curvature.curvatures(surface.p, surface.faces)
    inside = ~curvatures.border
    for estimate, true in (
        (curvatures.gaussian, surface.gaussian),
        (curvatures.mean, surface.mean),
    ):
        assert np.isnan(estimate[curvatures.border]).all()
        scale = max(1.0, np.abs(true).max())
        assert np.sqrt(np.mean((estimate - true)[inside] ** 2)) < 0.002 * scale


def test_cylinder_is_flat_to_gauss_and_bent_to_the_mean():
    tube = cylinder(2000, radius=0.25)
    curvatures = curvature.curvatures(tube.p, tube.faces)
    np.testing.assert_allclose(curvatures.gaussian[~curvatures.border], 0, atol=1e-9)
    np.testing.assert_allclose(curvatures.mean[~curvatures.border], 1 / (2 * 0.25), rtol=2e-3)


@settings(max_examples=20, deadline=None)
@given(seeds, st.floats(0.05, 20))
def test_motion_scale_and_orientation(seed, scale):
    rng = np.random.default_rng(seed)
    p, faces = random_closed(rng, 40, spread=0.3)
    R = exp_so3(rng.uniform(-3, 3, 3))
    here = curvature.curvatures(p, faces)
    moved = curvature.curvatures(scale * p @ R.T + [3, 2, 1], faces)
    np.testing.assert_allclose(moved.gaussian * scale**2, here.gaussian, rtol=1e-7, atol=1e-7)
    np.testing.assert_allclose(moved.mean * scale, here.mean, rtol=1e-7, atol=1e-7)
    turned = curvature.curvatures(p, faces[:, ::-1])
    np.testing.assert_allclose(turned.gaussian, here.gaussian, rtol=1e-9, atol=1e-9)
    np.testing.assert_allclose(turned.mean, -here.mean, rtol=1e-9, atol=1e-9)
    np.testing.assert_allclose(turned.k1, -here.k2, rtol=1e-6, atol=1e-6)


@settings(max_examples=20, deadline=None)
@given(seeds)
def test_mean_curvature_normal_is_the_laplacian_of_position(seed):
    p, faces = random_closed(np.random.default_rng(seed), 40)
    true = (cotangent_laplacian(p, faces) @ p) / mixed_areas(p, faces)[:, None]
    np.testing.assert_allclose(
        curvature.mean_curvature_normals(p, faces), true, rtol=1e-7, atol=1e-7
    )


@settings(max_examples=10, deadline=None)
@given(seeds)
def test_mean_curvature_normal_is_the_gradient_of_area(seed):
    # Moving vertex i by t changes the area by A_i (2 H n) . t: by finite differences.
    from workbench.geometry.meshes import face_areas

    rng = np.random.default_rng(seed)
    p, faces = random_closed(rng, 20)
    t = 1e-6 * rng.standard_normal(p.shape)
    change = (face_areas(p + t, faces).sum() - face_areas(p - t, faces).sum()) / 2
    slope = (mixed_areas(p, faces)[:, None] * curvature.mean_curvature_normals(p, faces) * t).sum()
    assert change == pytest.approx(slope, rel=1e-4, abs=1e-12)


@settings(max_examples=30, deadline=None)
@given(seeds, st.integers(8, 60))
def test_gauss_bonnet_on_any_closed_mesh(seed, count):
    total, expected = curvature.gauss_bonnet(
        *random_closed(np.random.default_rng(seed), count, spread=0.9)
    )
    assert total == pytest.approx(expected, abs=1e-9)
    assert expected == pytest.approx(4 * np.pi)


@pytest.mark.parametrize(
    ("name", "chi"), [("torus", 0), ("plane", 1), ("saddle", 1), ("cylinder", 0), ("catenoid", 0)]
)
def test_gauss_bonnet_with_holes_and_borders(name, chi):
    surface = SURFACES[name](3000, jitter=0.25, rng=np.random.default_rng(2))
    total, expected = curvature.gauss_bonnet(surface.p, surface.faces)
    assert expected == pytest.approx(2 * np.pi * chi)
    assert total == pytest.approx(expected, abs=1e-9)


@pytest.mark.parametrize(("name", "chi"), [("bunny", 2), ("fertility", -6)])
def test_gauss_bonnet_on_scans(shared_data, name, chi):
    total, expected = curvature.gauss_bonnet(*read_mesh(shared_data / "curvature" / f"{name}.off"))
    assert expected == pytest.approx(2 * np.pi * chi)
    assert abs(total - expected) < 1e-9


def test_a_border_takes_pi_and_two_pi_would_not_do():
    flat = plane(100)
    defects = curvature.angle_defects(flat.p, flat.faces)
    border = on_boundary(flat.faces, 100)
    corners = np.abs(flat.p[:, :2]).min(axis=1) == 1
    np.testing.assert_allclose(defects[corners], np.pi / 2)
    np.testing.assert_allclose(defects[~corners], 0, atol=1e-12)
    assert (defects + np.pi * border).sum() == pytest.approx(2 * np.pi + 36 * np.pi)


@settings(max_examples=20, deadline=None)
@given(seeds)
def test_principal_curvatures_give_back_both(seed):
    rng = np.random.default_rng(seed)
    a, b = rng.standard_normal((2, 50))
    k1, k2 = curvature.principal_curvatures(a * b, (a + b) / 2)
    np.testing.assert_allclose(k1, np.maximum(a, b), atol=1e-7)
    np.testing.assert_allclose(k2, np.minimum(a, b), atol=1e-7)


def test_impossible_pairs_count_as_umbilic():
    k1, k2 = curvature.principal_curvatures(np.array([4.0]), np.array([1.0]))
    np.testing.assert_array_equal([k1, k2], 1.0)


@pytest.mark.parametrize("name", ["torus", "cylinder", "saddle", "catenoid"])
def test_principal_directions_of_known_surfaces(name):
    surface = SURFACES[name](5000, jitter=0.1, rng=np.random.default_rng(3))
    normals = vertex_normals(surface.p, surface.faces)
    along_k1, along_k2 = curvature.principal_directions(surface.p, surface.faces, normals)
    np.testing.assert_allclose(np.einsum("vx,vx->v", along_k1, along_k2), 0, atol=1e-12)
    np.testing.assert_allclose(np.linalg.norm(along_k1, axis=1), 1)
    np.testing.assert_allclose(np.einsum("vx,vx->v", along_k1, normals), 0, atol=1e-12)
    inside = ~on_boundary(surface.faces, len(surface.p))
    cosine = np.abs(np.einsum("vx,vx->v", along_k1, surface.along_k1))[inside]
    assert np.degrees(np.arccos(np.minimum(np.median(cosine), 1))) < 1.5


@settings(max_examples=30, deadline=None)
@given(seeds)
def test_tangents_make_a_right_handed_frame(seed):
    n = np.random.default_rng(seed).standard_normal((20, 3))
    n = np.vstack([n / np.linalg.norm(n, axis=1, keepdims=True), np.eye(3), -np.eye(3)])
    right, up = curvature.tangents(n)
    np.testing.assert_allclose(np.cross(right, up), n, atol=1e-12)
    np.testing.assert_allclose(np.linalg.norm(right, axis=1), 1)


def test_doubling_the_size():
    ring = torus(2000)
    original, two = (curvature.curvatures(s.p, s.faces) for s in (ring, scaled(ring, 2.0)))
    np.testing.assert_allclose(two.gaussian, original.gaussian / 4, rtol=1e-9, atol=1e-9)
    np.testing.assert_allclose(two.mean, original.mean / 2, rtol=1e-9, atol=1e-9)
    np.testing.assert_allclose(two.defects, original.defects, atol=1e-12)


def test_unused_vertices_get_nan_and_disturb_nobody():
    p, faces = TETRAHEDRON
    curvatures = curvature.curvatures(np.vstack([p, [9, 9, 9]]), faces)
    np.testing.assert_allclose(curvatures.gaussian[:4], curvature.gaussian_curvature(p, faces))
    assert np.isnan(curvatures.gaussian[4])
    assert np.isnan(curvatures.mean[4])
