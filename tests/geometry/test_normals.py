"""Normals of clouds: known surfaces, an oracle, and degenerate neighbourhoods."""

import numpy as np
import pytest
import scipy
from hypothesis import given, settings
from hypothesis import strategies as st

from workbench.geometry.motions import exp_so3
from workbench.geometry.points.normals import (
    Normals,
    _directions,
    _neighbourhoods,
    point_normals,
    surface_variation,
)


def angles(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    return np.degrees(
        np.arctan2(np.linalg.norm(np.cross(a, b), axis=1), np.abs(np.einsum("ij,ij->i", a, b)))
    )


def sphere(n: int, seed: int = 0) -> np.ndarray:
    u = np.random.default_rng(seed).standard_normal((n, 3))
    return u / np.linalg.norm(u, axis=1, keepdims=True)


def test_a_plane_is_exact_wherever_it_lies():
    rng = np.random.default_rng(0)
    R = exp_so3(np.array([0.7, -0.3, 0.2]))
    p = rng.uniform(-1, 1, (500, 3)) * [1, 1, 0] @ R.T + 1e5
    assert angles(point_normals(p), np.tile(R[:, 2], (500, 1))).max() < 1e-4


def test_a_sphere_points_outwards_and_nearly_radially():
    p = sphere(5000)
    normals = point_normals(p + np.array([3.0, -2.0, 1.0]))
    np.testing.assert_allclose(np.linalg.norm(normals, axis=1), 1.0, atol=1e-12)
    assert np.einsum("ij,ij->i", normals, p).min() > 0
    assert np.median(angles(normals, p)) < 1.0


def test_normals_face_the_viewpoint():
    p = sphere(1000)
    assert np.all(np.einsum("ij,ij->i", point_normals(p, viewpoint=np.zeros(3)), p) < 0)


@settings(max_examples=20, deadline=None)
@given(st.integers(0, 1000))
def test_the_closed_form_agrees_with_eigh(seed):
    rng = np.random.default_rng(seed)
    X = rng.standard_normal((200, 8, 3)) * 10.0 ** rng.uniform(-4, 1, (200, 1, 3))
    C = np.einsum("nki,nkj->nij", X, X)
    normals, _ = _directions(
        np.stack([C[:, i, j] for i, j in ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))])
    )
    np.testing.assert_allclose(np.linalg.norm(normals, axis=1), 1.0, atol=1e-9)
    values = np.linalg.eigvalsh(C)
    # Rayleigh: how much worse than the best direction
    quotient = np.einsum("ni,nij,nj->n", normals, C, normals)
    assert np.all(quotient - values[:, 0] <= 1e-10 * values[:, 2])


def test_they_turn_with_the_cloud():
    rng = np.random.default_rng(1)
    p = rng.standard_normal((300, 3)) * [1.0, 0.6, 0.2]
    R = exp_so3(np.array([0.4, 1.2, -0.7]))
    assert angles(point_normals(p @ R.T), point_normals(p) @ R.T).max() < 1e-5


@pytest.mark.parametrize(
    "p",
    [
        np.outer(np.arange(20.0), [1.0, 1.0, 0.0]),
        np.ones((20, 3)),
        np.repeat(sphere(5), 10, axis=0),
        np.eye(3),
    ],
    ids=["collinear", "coinciding", "duplicates", "three points"],
)
def test_degenerate_clouds_give_some_unit_vector(p):
    normals = point_normals(p)
    np.testing.assert_allclose(np.linalg.norm(normals, axis=1), 1.0, atol=1e-9)


def test_on_a_line_the_normal_is_orthogonal_to_it():
    line = np.array([1.0, 2.0, -0.5])
    normals = point_normals(np.outer(np.linspace(0, 1, 30), line))
    np.testing.assert_allclose(normals @ line, 0.0, atol=1e-7)


def test_misuse_is_refused():
    with pytest.raises(ValueError, match="at least 3 points"):
        point_normals(np.zeros((2, 3)))
    with pytest.raises(ValueError, match="at least 3 points"):
        point_normals(np.zeros((9, 3)), k=2)
    with pytest.raises(ValueError, match="finite"):
        point_normals(np.full((9, 3), np.nan))


def test_the_oracle_of_plain_principal_components():
    p = sphere(400, 3) * [1.0, 0.7, 0.4]
    neighbours = scipy.spatial.KDTree(p).query(p, k=12)[1]
    X = p[neighbours] - p[neighbours].mean(axis=1, keepdims=True)
    expected = np.linalg.svd(X)[2][:, 2]
    assert angles(point_normals(p, k=12), expected).max() < 1e-4


@pytest.mark.parametrize("spread", [False, True])
def test_normals_of_some_points_are_those_of_all(spread):
    rng = np.random.default_rng(3)
    on_lines = rng.uniform(-1, 1, (6000, 3)) * [1, 1e-3, 1e-3]
    for p in (np.concatenate([on_lines, rng.normal(size=(3000, 3))]), on_lines):
        some = Normals(p, spread=spread)
        for rows in (np.array([5, 3, 3]), rng.integers(0, len(p), 4000), np.arange(len(p))):
            np.testing.assert_allclose(
                some.at(rows), point_normals(p, spread=spread)[rows], atol=1e-12
            )


def lines(p: np.ndarray) -> np.ndarray:
    on_line = np.zeros(len(p), bool)
    everywhere = np.ones(len(p), bool)
    for rows, covariances in _neighbourhoods(p, scipy.spatial.KDTree(p), 16, wanted=everywhere):
        on_line[rows] = _directions(covariances)[1]
    return on_line


def test_points_on_rings_lie_on_lines_and_points_on_a_surface_do_not():
    rng = np.random.default_rng(0)
    angle = np.linspace(0, 2 * np.pi, 400, endpoint=False)
    rings = np.concatenate(
        [r * np.column_stack([np.cos(angle), np.sin(angle), 0 * angle]) for r in (8.0, 10.0)]
    )
    plane = rng.uniform(-1, 1, (600, 3)) * [1, 1, 0]
    lump = rng.normal(size=(600, 3))
    assert lines(rings + 0.005 * rng.normal(size=rings.shape)).all()
    assert lines(plane).mean() < 0.03
    assert lines(lump).mean() < 0.1
    assert lines(np.ones((20, 3))).all()
    mixed = np.concatenate([plane, rings])
    np.testing.assert_array_equal(
        point_normals(mixed, spread=True), point_normals(mixed) * ~lines(mixed)[:, None]
    )
    np.testing.assert_array_equal(point_normals(rings, spread=True), point_normals(rings))


@pytest.mark.parametrize("size", [1e-6, 1.0, 1e6])
@pytest.mark.parametrize("spread", [(1, 1, 1), (1, 0.45, 0.1), (1, 0.45, 0), (1, 1e-8, 0)])
def test_a_line_is_told_by_the_variances_that_lapack_finds(spread, size):
    v = np.random.default_rng(0).normal(size=(2000, 16, 3)) * spread * size
    v = (v - v.mean(axis=1, keepdims=True)) @ exp_so3(np.array([0.3, -0.8, 1.1]))
    scatter = np.einsum("nij,nik->njk", v, v)
    _, second, largest = np.linalg.eigvalsh(scatter).T
    of_lapack = second <= 0.2 * largest
    six = scatter[:, [0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]].T
    np.testing.assert_array_equal(_directions(six)[1], of_lapack)
    assert of_lapack.any()


@settings(max_examples=25, deadline=None)
@given(st.integers(0, 10_000), st.floats(0.01, 100.0))
def test_surface_variation_does_not_depend_on_place_turn_or_size(seed, size):
    rng = np.random.default_rng(seed)
    p = rng.normal(size=(30, 3)) * [1.0, 0.7, 0.3]
    moved = size * (p @ exp_so3(rng.uniform(-3, 3, 3)).T + rng.uniform(-5, 5, 3))
    assert surface_variation(moved) == pytest.approx(surface_variation(p), rel=1e-6)
    assert 0.0 < surface_variation(p) <= 1.0 / 3.0


def test_surface_variation_of_the_flat_the_even_and_one_place():
    corners = np.array(list(np.ndindex(2, 2, 2)), dtype=float)
    assert surface_variation(corners) == pytest.approx(1.0 / 3.0)
    assert surface_variation(corners[corners[:, 2] == 0]) == pytest.approx(0.0, abs=1e-12)
    assert surface_variation(np.ones((4, 3))) == 0.0
