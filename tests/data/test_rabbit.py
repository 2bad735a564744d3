"""The rabbit: its points and its mesh lie on the level of one field, and the mesh is fit for what
lessons do on it.
"""

import numpy as np
import pytest
import scipy

from workbench.data.shapes.rabbit import rabbit, rabbit_field, rabbit_mesh
from workbench.geometry.meshes import check_mesh, corners, euler_characteristic, face_normals


def test_the_rabbit_lies_on_one_smooth_surface_with_few_holes():
    p = rabbit(4000, np.random.default_rng(0))
    assert np.abs(rabbit_field(p)[0]).max() < 1e-3
    gaps = np.asarray(scipy.spatial.KDTree(p).query(p, k=2)[0])[:, 1]
    assert gaps.max() < 6 * np.median(gaps)


def test_the_gradient_is_that_of_the_distance():
    p = rabbit(50, np.random.default_rng(1)) + 0.02
    h = 1e-6
    _, gradient = rabbit_field(p)
    for axis in range(3):
        step = h * np.eye(3)[axis]
        difference = (rabbit_field(p + step)[0] - rabbit_field(p - step)[0]) / (2 * h)
        np.testing.assert_allclose(gradient[:, axis], difference, atol=1e-6)


@pytest.mark.parametrize("spacing", [0.05, 0.03, 0.02])
def test_the_mesh_is_one_closed_surface_on_the_field_with_round_triangles(spacing):
    p, faces = rabbit_mesh(spacing)
    check_mesh(p, faces)
    assert euler_characteristic(faces) == 2
    assert np.abs(rabbit_field(p)[0]).max() < 1e-9
    angles = np.degrees(corners(p, faces).angles)
    assert angles.min() > 14
    assert angles.max() < 140


def test_faces_turn_outwards_and_the_mesh_holds_what_points_cover():
    p, faces = rabbit_mesh()
    _, outwards = rabbit_field(p[faces].mean(axis=1))
    assert (
        np.einsum("ij,ij->i", face_normals(p, faces), outwards)
        > 0.5 * np.linalg.norm(outwards, axis=1)
    ).all()
    cloud = rabbit(4000, np.random.default_rng(0))
    gaps, _ = scipy.spatial.KDTree(p).query(cloud)
    assert np.max(gaps) < 0.03
    assert np.mean(gaps) < 0.015


def test_finer_grids_come_near_one_volume_and_the_same_mesh_comes_again():
    def volume(spacing):
        p, faces = rabbit_mesh(spacing)
        a, b, c = p[faces].transpose(1, 0, 2)
        return np.einsum("ij,ij->", a, np.cross(b, c)) / 6

    coarse, middle, fine = (volume(h) for h in (0.04, 0.02, 0.01))
    assert fine == pytest.approx(0.1398, abs=2e-4)
    assert abs(fine - middle) < 0.3 * abs(middle - coarse)
    p, faces = rabbit_mesh(0.04)
    rabbit_mesh.cache_clear()
    np.testing.assert_array_equal(p, rabbit_mesh(0.04)[0])
    np.testing.assert_array_equal(faces, rabbit_mesh(0.04)[1])
    assert not p.flags.writeable


@pytest.mark.parametrize("spacing", [0.0, 0.009, 0.051, np.nan])
def test_a_grid_that_loses_the_ears_or_takes_for_ever_is_refused(spacing):
    with pytest.raises(ValueError, match=r"0\.01 to 0\.05"):
        rabbit_mesh(spacing)
