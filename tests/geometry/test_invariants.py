import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st

from workbench.data.shapes.solids import house, solid
from workbench.geometry.meshes.invariants import changes, measure, signed_volume
from workbench.geometry.motions import exp_se3
from workbench.geometry.motions.affine import perspective, reflection, scaling, shear, transform

SHAPES = ["house", "L block", "box"]
twists = st.tuples(*[st.floats(-3, 3)] * 6).map(np.array)


def kept(H: np.ndarray) -> dict[str, bool]:
    s = house()
    return {
        c.name: c.kept for c in changes(measure(s.p, s.faces), measure(transform(H, s.p), s.faces))
    }


@pytest.mark.parametrize("shape", SHAPES)
def test_measures_agree_with_trimesh(shape):
    s = solid(shape)
    mesh = trimesh.Trimesh(s.p, s.faces, process=False)
    measures = measure(s.p, s.faces)
    assert mesh.is_watertight
    assert mesh.is_winding_consistent
    assert measures.volume == pytest.approx(mesh.volume)
    assert measures.area == pytest.approx(mesh.area)
    np.testing.assert_allclose(np.sort(measures.lengths), np.sort(mesh.edges_unique_length))
    # trimesh loses digits in an arc cosine
    np.testing.assert_allclose(measures.angles, mesh.face_angles, atol=1e-7)


@settings(max_examples=40, deadline=None)
@given(twists)
def test_a_rigid_motion_keeps_everything(twist):
    assert all(kept(exp_se3(twist)).values())


NAMES = ["edge lengths", "angles", "parallel edges", "area", "volume", "orientation"]


@pytest.mark.parametrize(
    ("H", "survivors"),
    [
        (np.eye(4), NAMES),
        (reflection(np.array([1.0, 0, 0])), NAMES[:5]),
        (scaling(np.full(3, 1.5)), ["angles", "parallel edges", "orientation"]),
        (scaling(np.array([2.0, 0.5, 1.0])), ["parallel edges", "volume", "orientation"]),
        (shear("x", "z", 0.5), ["parallel edges", "volume", "orientation"]),
        (scaling(np.array([1.0, 1.0, -2.0])), ["parallel edges"]),
        (perspective(np.array([0.0, 0.0, 0.4])), ["orientation"]),
    ],
    ids=["identity", "mirror", "similarity", "stretch", "shear", "mirrored stretch", "projective"],
)
def test_what_survives_which_map(H, survivors):
    assert [name for name, is_kept in kept(H).items() if is_kept] == survivors


def test_amounts_are_what_was_done():
    s = house()
    before = measure(s.p, s.faces)
    after = measure(transform(scaling(np.full(3, 1.5)), s.p), s.faces)
    amounts = {c.name: c.amount for c in changes(before, after)}
    assert amounts["edge lengths"] == pytest.approx(0.5)
    assert amounts["area"] == pytest.approx(1.25)
    assert amounts["volume"] == pytest.approx(2.375)


@settings(max_examples=30, deadline=None)
@given(st.lists(st.floats(-2, 2), min_size=9, max_size=9))
def test_volume_goes_with_the_determinant(row):
    s = house()
    A = np.array(row).reshape(3, 3)
    assert signed_volume(s.p @ A.T, s.faces) == pytest.approx(
        np.linalg.det(A) * signed_volume(s.p, s.faces), abs=1e-12
    )


def test_volume_far_from_the_origin():
    s = house()
    assert signed_volume(s.p + 1e6, s.faces) == pytest.approx(signed_volume(s.p, s.faces), rel=1e-8)


def test_an_open_mesh_has_no_volume():
    s = house()
    measures = measure(s.p, s.faces[1:])
    assert np.isnan(measures.volume)
    assert [c.name for c in changes(measures, measures)] == NAMES[:4]
