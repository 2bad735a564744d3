"""Areas, volumes and middles of meshes: laws, closed forms, trimesh, and what is open."""

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st

from workbench.data.shapes import surfaces
from workbench.data.shapes.rabbit import rabbit_mesh
from workbench.data.shapes.solids import house, l_block
from workbench.geometry.meshes.measures import (
    area_centroid,
    encloses,
    signed_volume,
    surface_area,
    tetrahedra,
    volume_about,
    volume_centroid,
)
from workbench.geometry.motions import exp_so3

RABBIT = rabbit_mesh(0.05)
seeds = st.integers(0, 2**32 - 1)


@settings(max_examples=25, deadline=None)
@given(seeds)
def test_motions_keep_and_sizes_multiply(seed):
    p, faces = RABBIT
    rng = np.random.default_rng(seed)
    factor = rng.uniform(0.1, 10)
    moved = p @ exp_so3(rng.normal(size=3) * 2).T + rng.normal(size=3) * 100
    assert signed_volume(moved, faces) == pytest.approx(signed_volume(p, faces), rel=1e-9)
    assert surface_area(moved, faces) == pytest.approx(surface_area(p, faces), rel=1e-9)
    assert signed_volume(factor * p, faces) == pytest.approx(factor**3 * signed_volume(p, faces))
    assert surface_area(factor * p, faces) == pytest.approx(factor**2 * surface_area(p, faces))
    assert signed_volume(p, faces[:, ::-1]) == pytest.approx(-signed_volume(p, faces))
    assert volume_about(p, faces, 50 * rng.normal(size=3)) == pytest.approx(
        signed_volume(p, faces), rel=1e-7
    )


@pytest.mark.parametrize(
    "mesh", [RABBIT, (house().p, house().faces), (l_block().p, l_block().faces)]
)
def test_trimesh_measures_the_same(mesh):
    p, faces = mesh
    theirs = trimesh.Trimesh(p, faces, process=False)
    assert signed_volume(p, faces) == pytest.approx(theirs.volume, rel=1e-9)
    assert surface_area(p, faces) == pytest.approx(theirs.area, rel=1e-9)
    np.testing.assert_allclose(area_centroid(p, faces), theirs.centroid, atol=1e-12)
    np.testing.assert_allclose(volume_centroid(p, faces), theirs.center_mass, atol=1e-12)
    assert encloses(faces)


def test_a_torus_of_many_blocks_comes_close_to_its_closed_form():
    ring = surfaces.torus(20_000)
    assert len(ring.faces) > 30_000
    assert surface_area(ring.p, ring.faces) == pytest.approx(4 * np.pi**2 * 0.4, rel=4e-4)
    assert signed_volume(ring.p, ring.faces) == pytest.approx(2 * np.pi**2 * 0.16, rel=2e-3)
    assert tetrahedra(ring.p, ring.faces, np.ones(3)).sum() == pytest.approx(
        signed_volume(ring.p, ring.faces)
    )


def test_far_from_the_origin_no_digits_are_lost():
    p, faces = RABBIT
    assert signed_volume(p + 1e6, faces) == pytest.approx(signed_volume(p, faces), rel=1e-7)


def test_of_an_open_mesh_the_origin_decides():
    p, faces = RABBIT
    with_hole = faces[40:]
    assert not encloses(with_hole)
    assert abs(volume_about(p, with_hole, np.full(3, 20.0)) / signed_volume(p, faces) - 1) > 0.01


def test_a_face_turned_round_or_listed_twice_leaves_edges_without_partner():
    _, faces = RABBIT
    assert not encloses(np.concatenate([faces[:1, ::-1], faces[1:]]))
    assert not encloses(np.concatenate([faces, faces[:1]]))
    assert encloses(np.concatenate([faces, faces + faces.max() + 1]))


def test_what_has_no_size():
    p = np.eye(3)
    nothing = np.empty((0, 3), dtype=int)
    assert surface_area(p, nothing) == signed_volume(p, nothing) == 0
    with pytest.raises(ValueError, match="no area"):
        area_centroid(p, nothing)
    with pytest.raises(ValueError, match="no volume"):
        volume_centroid(p, nothing)
