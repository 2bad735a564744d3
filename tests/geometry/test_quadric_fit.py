"""Quadric fits: exact on quadrics, convergent on irregular meshes, steady under noise, nan where
nothing fits.
"""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.geometry.mesh_zoo import TETRAHEDRON
from tests.geometry.test_curvature import relative
from workbench.data.shapes.surfaces import SURFACES, plane, torus, with_noise
from workbench.geometry.meshes import quadric_fit
from workbench.geometry.meshes.curvature import curvatures
from workbench.geometry.meshes.quadric_fit import fit_quadrics
from workbench.geometry.motions import exp_so3


def errors(surface, **options):
    K, H = fit_quadrics(surface.p, surface.faces, **options).curvatures()
    return relative(K, surface.gaussian), relative(H, surface.mean)


def test_jittered_torus_at_20k_and_convergence():
    coarse, fine = (
        errors(torus(n, jitter=0.2, rng=np.random.default_rng(0))) for n in (2000, 20_000)
    )
    assert fine[0] < 0.01
    assert fine[1] < 0.01
    # Ten times the vertices: edges 3.2 times shorter, and the error falls at least as much.
    assert fine[0] < coarse[0] / 3.16
    assert fine[1] < coarse[1] / 3.16


@pytest.mark.parametrize("name", ["sphere", "cylinder", "saddle", "catenoid"])
def test_borders_get_an_answer_too(name):
    surface = SURFACES[name](4000, jitter=0.2, rng=np.random.default_rng(1))
    K, H = fit_quadrics(surface.p, surface.faces).curvatures()
    assert np.isfinite(K).all()
    assert np.isfinite(H).all()
    scale = np.abs(surface.k1).max()
    assert np.sqrt(np.mean((K - surface.gaussian) ** 2)) < 0.05 * scale**2
    assert np.sqrt(np.mean((H - surface.mean) ** 2)) < 0.05 * scale


@settings(max_examples=15, deadline=None)
@given(st.integers(0, 10_000))
def test_curvature_of_a_quadric_at_its_summit_is_exact(seed):
    # Over the summit's own tangent plane the surface is a quadric, which the fit reproduces; any
    # pose, any bend.
    rng = np.random.default_rng(seed)
    flat = plane(121, jitter=0.2, rng=rng)
    a, b, c = rng.uniform(-0.4, 0.4, 3)
    middle = 60
    p = flat.p - flat.p[middle]
    p[:, 2] = a * p[:, 0] ** 2 + b * p[:, 0] * p[:, 1] + c * p[:, 1] ** 2
    normal = np.zeros((121, 3))
    normal[:, 2] = 1.0
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(quadric_fit, "vertex_normals", lambda p, faces: normal @ R.T)
        R = exp_so3(rng.uniform(-3, 3, 3))
        fit = fit_quadrics(p @ R.T + 5.0, flat.faces, rings=3)
    K, H = fit.curvatures()
    assert K[middle] == pytest.approx(4 * a * c - b * b, abs=1e-9)
    assert H[middle] == pytest.approx(-(a + c), abs=1e-9)
    k1, k2 = fit.principal_curvatures()
    np.testing.assert_allclose(
        [k2[middle], k1[middle]], np.linalg.eigvalsh([[-2 * a, -b], [-b, -2 * c]]), atol=1e-7
    )


def test_a_slope_in_the_frame_is_accounted_for():
    # Over the horizontal the saddle is a quadric everywhere, steep or not: with upright frames
    # every vertex is exact.
    surface = SURFACES["saddle"](200, bend=2.0, jitter=0.2, rng=np.random.default_rng(5))
    upright = np.broadcast_to([0.0, 0.0, 1.0], surface.p.shape)
    turned = surface.p @ exp_so3(np.array([0, 0, 0.4])).T
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(quadric_fit, "vertex_normals", lambda p, faces: upright)
        K, H = fit_quadrics(turned, surface.faces).curvatures()
    np.testing.assert_allclose(K, surface.gaussian, rtol=1e-7)
    np.testing.assert_allclose(H, surface.mean, rtol=1e-7, atol=1e-9)


@pytest.mark.parametrize("name", ["torus", "cylinder", "saddle", "catenoid"])
def test_principal_directions(name):
    surface = SURFACES[name](4000, jitter=0.2, rng=np.random.default_rng(2))
    along_k1, along_k2 = fit_quadrics(surface.p, surface.faces).principal_directions()
    cosine = np.abs(np.einsum("vx,vx->v", along_k1, surface.along_k1))
    assert np.degrees(np.arccos(np.minimum(np.median(cosine), 1))) < 1.0
    np.testing.assert_allclose(np.einsum("vx,vx->v", along_k1, along_k2), 0, atol=1e-12)


def test_scale_and_orientation():
    ring = torus(1000, jitter=0.2, rng=np.random.default_rng(3))
    K, H = fit_quadrics(ring.p, ring.faces).curvatures()
    K_large, H_large = fit_quadrics(1000 * ring.p, ring.faces).curvatures()
    np.testing.assert_allclose(1e6 * K_large, K, rtol=1e-6, atol=1e-9)
    np.testing.assert_allclose(1e3 * H_large, H, rtol=1e-6, atol=1e-9)
    K_turned, H_turned = fit_quadrics(ring.p, ring.faces[:, ::-1]).curvatures()
    np.testing.assert_allclose(K_turned, K, rtol=1e-6, atol=1e-9)
    np.testing.assert_allclose(H_turned, -H, rtol=1e-6, atol=1e-9)


def test_noise_hurts_it_less_than_the_triangles_and_less_with_more_rings():
    noisy = with_noise(torus(5000), 0.001, np.random.default_rng(0))
    by_triangles = curvatures(noisy.p, noisy.faces)
    two = errors(noisy)
    three = errors(noisy, rings=3)
    assert two[0] < relative(by_triangles.gaussian, noisy.gaussian) / 4
    assert two[1] < relative(by_triangles.mean, noisy.mean) / 4
    assert three[0] < two[0] / 2


def test_blocks_do_not_show():
    ring = torus(2 * quadric_fit.BLOCK + 100)
    whole = fit_quadrics(ring.p, ring.faces).coefficients
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(quadric_fit, "BLOCK", 10**9)
        np.testing.assert_allclose(
            fit_quadrics(ring.p, ring.faces).coefficients, whole, rtol=1e-9, atol=1e-9
        )


def test_agrees_with_least_squares_one_by_one():
    surface = torus(200, jitter=0.2, rng=np.random.default_rng(4))
    fit = fit_quadrics(surface.p, surface.faces, rings=1)
    from workbench.geometry.meshes import adjacency

    near = adjacency(surface.faces, len(surface.p)).toarray() > 0
    for i in range(0, len(surface.p), 17):
        step = surface.p[np.flatnonzero(near[i] | (np.arange(len(surface.p)) == i))] - surface.p[i]
        x, y, z = step @ fit.right[i], step @ fit.up[i], step @ fit.normals[i]
        A = np.stack([np.ones(len(x)), x, y, x * x, x * y, y * y], axis=1)
        w = np.exp(-(x**2 + y**2) / (x**2 + y**2).mean())
        true = np.linalg.lstsq(np.sqrt(w)[:, None] * A, np.sqrt(w) * z, rcond=None)[0]
        np.testing.assert_allclose(fit.coefficients[i], true, rtol=1e-6, atol=1e-9)
        assert fit.neighbours[i] == len(x)


def test_too_few_neighbours_or_a_conic_give_nan():
    assert np.isnan(fit_quadrics(*TETRAHEDRON).coefficients).all()
    # Six points that lie on no conic are just enough: a pentagon and its centre.
    angle = 2 * np.pi * np.arange(5) / 5
    p = np.vstack([[0, 0, 0.3], np.c_[np.cos(angle), np.sin(angle), 0 * angle]])
    faces = np.array([[0, 1 + k, 1 + (k + 1) % 5] for k in range(5)])
    assert np.isfinite(fit_quadrics(p, faces).coefficients[0]).all()
    line = np.c_[np.linspace(0, 1, 8), np.zeros(8), np.zeros(8)]
    flat = np.vstack([line, line + np.array([0, 1, 0])])
    strip = np.array([[k, k + 1, k + 9] for k in range(7)] + [[k, k + 9, k + 8] for k in range(7)])
    assert np.isnan(
        fit_quadrics(flat, strip, rings=3).coefficients
    ).all()  # two parallel lines are a conic


def test_no_ring_is_refused():
    with pytest.raises(ValueError, match="first ring"):
        fit_quadrics(*TETRAHEDRON, rings=0)
