"""Principal axes: against eigh, laws of moving and mirroring, closed-form variances, and clouds
that leave axes open.
"""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.geometry.test_motions import motions
from workbench.data.files import read_cloud, read_mesh
from workbench.data.shapes.clouds import box_surface
from workbench.data.shapes.rabbit import rabbit
from workbench.geometry.meshes import corners, face_areas
from workbench.geometry.motions import apply
from workbench.geometry.motions.principal_axes import (
    canonical_signs,
    centroid_and_covariance,
    degrees_between_axes,
    largest_entry_signs,
    principal_axes,
    right_handed_frames,
    third_moments,
)

SEEDS = st.integers(0, 10_000)


def lump(seed: int, n: int = 60) -> np.ndarray:
    """A cloud with three variances that differ and a tail along each axis."""
    return (np.random.default_rng(seed).gamma(2.0, 1.0, (n, 3)) - 2.0) * [0.5, 0.3, 0.15]


@pytest.mark.parametrize("n", [1, 2, 57, 8192, 20_000])
def test_moments_are_those_of_numpy(n):
    p = np.random.default_rng(n).normal(size=(n, 3)) * [3.0, 2.0, 1.0] + 5.0
    mean, covariance = centroid_and_covariance(p)
    np.testing.assert_allclose(mean, p.mean(axis=0), atol=1e-12)
    np.testing.assert_allclose(covariance, np.cov(p.T, bias=True), atol=1e-12)


@pytest.mark.parametrize("offset", [0.0, 1e3, 1e6])
def test_far_from_the_origin_no_digit_of_the_axes_is_lost(offset):
    p = lump(1, 5000)
    away = degrees_between_axes(principal_axes(p + offset), principal_axes(p))
    assert away.max() < 1e-5
    mean = (p + offset).mean(axis=0)
    raw = (p + offset).T @ (p + offset) / len(p)
    vectors = np.linalg.eigh(raw - np.outer(mean, mean))[1][:, ::-1]
    # the usual way
    assert (degrees_between_axes(vectors, principal_axes(p)).max() > 0.1) == (offset == 1e6)


@settings(max_examples=40, deadline=None)
@given(SEEDS, motions())
def test_axes_are_those_of_the_covariance_right_handed_and_move_with_the_cloud(seed, T):
    p = lump(seed)
    V = principal_axes(p)
    values = np.diag(V.T @ np.cov(p.T) @ V)
    np.testing.assert_allclose(V.T @ V, np.eye(3), atol=1e-12)
    assert np.linalg.det(V) == pytest.approx(1)
    assert values[0] >= values[1] >= values[2]
    np.testing.assert_allclose(values, np.linalg.eigvalsh(np.cov(p.T))[::-1], rtol=1e-9)
    np.testing.assert_allclose(
        degrees_between_axes(principal_axes(apply(T, p)), T[:3, :3] @ V), 0.0, atol=1e-5
    )


@settings(max_examples=40, deadline=None)
@given(
    SEEDS,
    motions(),
    st.sampled_from([(a, b, c) for a in (1, -1) for b in (1, -1) for c in (1, -1)]),
)
def test_signs_by_third_moments_move_with_the_cloud_whatever_signs_come_in(seed, T, signs):
    p = lump(seed)
    V = canonical_signs(principal_axes(p), p)
    moved = canonical_signs(principal_axes(apply(T, p)) * signs, apply(T, p))
    np.testing.assert_allclose(moved, T[:3, :3] @ V, atol=1e-6)
    assert np.linalg.det(V) == pytest.approx(1)
    assert (third_moments(V, p)[:2] >= 0).all()


def test_a_mirror_image_has_the_mirrored_axes_but_not_the_third():
    p = lump(3)
    V, W = (canonical_signs(principal_axes(q), q) for q in (p, p * [1, 1, -1]))
    np.testing.assert_allclose(W[:, :2], (V * [[1], [1], [-1]])[:, :2], atol=1e-9)
    np.testing.assert_allclose(W[:, 2], -(V * [[1], [1], [-1]])[:, 2], atol=1e-9)


def test_the_largest_entry_does_not_move_with_the_cloud():
    p = rabbit(300, np.random.default_rng(0))
    different = 0
    V = largest_entry_signs(principal_axes(p))
    rng = np.random.default_rng(1)
    for _ in range(100):
        R = np.linalg.qr(rng.normal(size=(3, 3)))[0]
        R *= np.linalg.det(R)
        different += np.abs(largest_entry_signs(principal_axes(p @ R.T)) - R @ V).max() > 1e-6
    assert 60 < different < 90


def test_four_frames_are_right_handed_and_half_a_turn_apart():
    frames = right_handed_frames(principal_axes(lump(0)))
    np.testing.assert_allclose(np.linalg.det(frames), 1.0)
    assert len(frames) == len(np.unique(frames.round(9), axis=0)) == 4
    for frame in frames[1:]:
        assert np.trace(frames[0].T @ frame) == pytest.approx(-1)  # half a turn


def test_the_surface_of_a_box_has_its_variances_in_closed_form():
    a, b, c = 1.0, 0.6, 0.4
    areas = np.array([b * c, a * c, a * b])
    sides = np.array([a, b, c])
    # Across its own pair of faces a coordinate is at the ends, across the others it is even.
    variances = (areas * sides**2 / 4 + (areas.sum() - areas) * sides**2 / 12) / areas.sum()
    p = box_surface(200_000, (a, b, c), np.random.default_rng(0))
    assert np.abs(p).max(axis=0).tolist() == [0.5, 0.3, 0.2]
    np.testing.assert_allclose(np.diag(centroid_and_covariance(p)[1]), variances, rtol=0.01)
    assert degrees_between_axes(principal_axes(p), np.eye(3)).max() < 1.0


def test_a_box_without_height_is_a_plate():
    p = box_surface(500, (1.0, 0.5, 0.0), np.random.default_rng(0))
    assert (p[:, 2] == 0).all()
    assert np.abs(principal_axes(p)[2, 2]) == pytest.approx(1)


@pytest.mark.parametrize(
    "p", [np.ones((1, 3)), np.ones((5, 3)), np.outer(np.arange(4.0), [1.0, 2.0, 2.0])]
)
def test_where_directions_are_open_a_frame_comes_all_the_same(p):
    V = principal_axes(p)
    np.testing.assert_allclose(V.T @ V, np.eye(3), atol=1e-12)
    assert np.linalg.det(V) == pytest.approx(1)
    assert np.isfinite(canonical_signs(V, p)).all()


@pytest.mark.parametrize(
    "p", [np.empty((0, 3)), np.array([[np.nan, 0, 0], [1, 1, 1]]), np.array([[np.inf, 0, 0]])]
)
def test_clouds_without_axes_are_refused(p):
    with (
        pytest.raises(ValueError, match=r"no centroid|not a finite"),
        np.errstate(invalid="ignore"),
    ):
        principal_axes(p)


@pytest.mark.parametrize(("name", "far"), [("bunny.off", (6.3, 6.8, 2.7)), ("fertility.off", None)])
def test_vertices_of_a_real_mesh_are_not_its_area(shared_data, name, far):
    p, faces = read_mesh(shared_data / "curvature" / name)
    drawn = np.random.default_rng(0).choice(
        len(faces), 60_000, p=face_areas(p, faces) / corners(p, faces).double_areas.sum() * 2
    )
    weights = np.random.default_rng(1).dirichlet((1, 1, 1), len(drawn))
    area = np.einsum("nk,nkx->nx", weights, p[faces[drawn]])
    off = degrees_between_axes(principal_axes(p), principal_axes(area))
    if far is None:
        assert off.max() < 3
    else:
        np.testing.assert_allclose(off, far, atol=0.8)


def test_a_real_scan_keeps_its_frame_under_a_turn(shared_data):
    p = read_cloud(shared_data / "icp" / "bun000.ply")
    R = np.linalg.qr(np.random.default_rng(2).normal(size=(3, 3)))[0]
    R *= np.linalg.det(R)
    V, W = (canonical_signs(principal_axes(q), q) for q in (p, p @ R.T + 7.0))
    np.testing.assert_allclose(W, R @ V, atol=1e-6)
