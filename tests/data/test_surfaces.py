"""Surfaces of known curvature: their vertices, normals and directions agree with finite differences
of themselves.
"""

import numpy as np
import pytest

from workbench.data.shapes.surfaces import (
    SURFACES,
    inside_out,
    plane,
    scaled,
    sphere,
    torus,
    with_noise,
)
from workbench.errors import InputError
from workbench.geometry.meshes import (
    check_mesh,
    corners,
    euler_characteristic,
    face_areas,
    vertex_normals,
)

NAMES = tuple(SURFACES)


def implicit(name, p):
    """A function that is zero on the surface, and its gradient by complex steps."""
    functions = {
        "sphere": lambda x, y, z: x**2 + y**2 + z**2 - 1,
        "torus": lambda x, y, z: (np.sqrt(x**2 + y**2) - 1) ** 2 + z**2 - 0.16,
        "cylinder": lambda x, y, z: x**2 + y**2 - 0.25,
        "saddle": lambda x, y, z: z - (x**2 - y**2) / 2,
        "plane": lambda x, y, z: z + 0 * x,
        "catenoid": lambda x, y, z: x**2 + y**2 - 0.25 * np.cosh(2 * z) ** 2,
    }
    F = functions[name]
    gradient = np.stack([F(*(p + 1e-30j * np.eye(3)[k]).T).imag / 1e-30 for k in range(3)], axis=1)
    return F(*p.T), gradient


def normal_curvature(name, p, direction, *, h=1e-4):
    """How fast the unit gradient turns in a direction: n'(t) . t, by central differences."""
    unit = lambda p: (lambda g: g / np.linalg.norm(g, axis=1, keepdims=True))(implicit(name, p)[1])  # noqa: E731
    return np.einsum("vx,vx->v", unit(p + h * direction) - unit(p - h * direction), direction) / (
        2 * h
    )


@pytest.mark.parametrize("jitter", [0.0, 0.25])
@pytest.mark.parametrize("name", NAMES)
def test_vertices_normals_and_curvatures_are_those_of_the_surface(name, jitter):
    s = SURFACES[name](300, jitter=jitter, rng=np.random.default_rng(0))
    value, gradient = implicit(name, s.p)
    np.testing.assert_allclose(value, 0, atol=1e-12)
    np.testing.assert_allclose(
        gradient / np.linalg.norm(gradient, axis=1, keepdims=True), s.normals, atol=1e-12
    )
    np.testing.assert_allclose(np.einsum("vx,vx->v", s.along_k1, s.normals), 0, atol=1e-12)
    np.testing.assert_allclose(np.linalg.norm(s.along_k1, axis=1), 1)
    assert (s.k1 >= s.k2).all()
    np.testing.assert_allclose(normal_curvature(name, s.p, s.along_k1), s.k1, atol=1e-6)
    np.testing.assert_allclose(
        normal_curvature(name, s.p, np.cross(s.normals, s.along_k1)), s.k2, atol=1e-6
    )
    np.testing.assert_allclose(s.gaussian, s.k1 * s.k2)
    np.testing.assert_allclose(s.mean, (s.k1 + s.k2) / 2)


@pytest.mark.parametrize("count", [50, 1000, 20_000])
@pytest.mark.parametrize("name", NAMES)
def test_size_orientation_and_shape_of_triangles(name, count):
    s = SURFACES[name](count, jitter=0.25, rng=np.random.default_rng(1))
    check_mesh(s.p, s.faces)
    assert count / 1.3 < len(s.p) < 1.3 * count
    measured = corners(s.p, s.faces)
    if count >= 1000:
        assert (np.einsum("xf,fx->f", measured.normals, s.normals[s.faces[:, 0]]) > 0).all()


@pytest.mark.parametrize("frequency", range(1, 13))
def test_geodesic_spheres_have_all_their_vertices(frequency):
    ball = sphere(10 * frequency**2 + 2)
    assert len(ball.p) == 10 * frequency**2 + 2
    assert euler_characteristic(ball.faces) == 2


def test_regular_grids_have_nearly_square_cells():
    for name in ("torus", "cylinder", "catenoid", "plane"):
        s = SURFACES[name](2000)
        areas = face_areas(s.p, s.faces)
        edges = np.sqrt(corners(s.p, s.faces).squared_edges)
        assert np.median(edges.min(axis=0) ** 2 / areas) > 0.8, name


def test_jitter_is_reproducible_and_leaves_borders_alone():
    first, second = (plane(100, jitter=0.2, rng=np.random.default_rng(7)) for _ in range(2))
    np.testing.assert_array_equal(first.p, second.p)
    border = np.abs(plane(100).p).max(axis=1) == 1
    np.testing.assert_array_equal(np.abs(first.p[border, :2]).max(axis=1), 1)
    assert np.abs(first.p - plane(100).p)[~border].max() > 0.01


def test_scaled_surfaces_and_noise():
    ring = torus(200)
    large = scaled(ring, 2.0)
    np.testing.assert_allclose(large.gaussian, ring.gaussian / 4)
    np.testing.assert_allclose(large.mean, ring.mean / 2)
    np.testing.assert_array_equal(large.p, 2 * ring.p)
    off = with_noise(ring, 0.01, np.random.default_rng(0)).p - ring.p
    np.testing.assert_allclose(np.cross(off, ring.normals), 0, atol=1e-12)
    assert np.sqrt(np.mean((off**2).sum(axis=1))) == pytest.approx(0.01, rel=0.2)


def test_inside_out_turns_h_and_not_k():
    ring = torus(300)
    turned = inside_out(torus(300))
    np.testing.assert_allclose(turned.gaussian, ring.gaussian)
    np.testing.assert_allclose(turned.mean, -ring.mean)
    assert (turned.k1 >= turned.k2).all()
    np.testing.assert_allclose(
        vertex_normals(turned.p, turned.faces), -vertex_normals(ring.p, ring.faces), atol=1e-12
    )
    np.testing.assert_allclose(
        -normal_curvature("torus", ring.p, turned.along_k1), turned.k1, atol=1e-6
    )


@pytest.mark.parametrize("jitter", [-0.1, 0.26, np.nan])
def test_jitter_out_of_range_is_refused(jitter):
    with pytest.raises(InputError, match="jitter"):
        torus(100, jitter=jitter, rng=np.random.default_rng(0))


def test_no_size_is_refused():
    with pytest.raises(InputError, match="size must be positive"):
        scaled(torus(100), 0.0)


def test_jitter_without_rng_is_refused():
    with pytest.raises(ValueError, match="rng"):
        sphere(100, jitter=0.1)
