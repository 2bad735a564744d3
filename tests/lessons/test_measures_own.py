"""Own meshes and voxels in the measures lesson: their units, what is said of open ones, and which
files are refused.
"""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh

from lessons.measures.lesson import draw, run
from lessons.measures.state import Params
from workbench.data.files import read_mesh, read_voxels
from workbench.errors import InputError
from workbench.geometry.meshes.measures import area_centroid
from workbench.scene import Mesh, caption_of


def last_of(params: Params) -> Any:
    *_, last = run(params)
    return last


@pytest.fixture(scope="module")
def cow(tmp_path_factory) -> Path:
    """A closed mesh in millimetres, far from its origin, as files have it: every face with corners
    of its own.
    """
    path = tmp_path_factory.mktemp("own") / "cow.stl"
    ball = trimesh.creation.icosphere(3, 40.0)
    ball.apply_translation([500, 20, 900])
    ball.export(path)
    return path


def test_numbers_are_in_the_unit_of_the_file(cow):
    last = last_of(Params(mesh=cow, unit="mm"))
    assert last.now.volume == pytest.approx(4 / 3 * np.pi * 40**3, rel=0.01)
    assert last.volume_error == pytest.approx(0, abs=1e-9)
    caption = caption_of(draw(last))
    assert caption.tone == "good"
    assert " mm³ (exact)" in caption.text
    surface = draw(last)["surface"]
    assert isinstance(surface, Mesh)
    shown = surface.p
    assert np.ptp(shown, axis=0).max() == pytest.approx(2.0)
    assert np.abs(shown.min(axis=0) + shown.max(axis=0)).max() < 1e-9


@pytest.mark.parametrize("method", ["voxels", "chance", "lines", "samples"])
def test_every_method_takes_it(cow, method):
    last = last_of(Params(mesh=cow, unit="mm", method=method, throws=3000))
    if method in ("voxels", "chance"):
        assert abs(last.volume_error) < 0.06
    if method == "lines":
        assert abs(last.area_error) < 0.1
    assert caption_of(draw(last)).text


def test_an_open_mesh_has_no_volume_of_its_own(tmp_path):
    ball = trimesh.creation.icosphere(2)
    ball.update_faces(np.arange(len(ball.faces)) > 5)
    ball.export(tmp_path / "open.ply")
    first, *_, last = run(Params(mesh=tmp_path / "open.ply"))
    assert "no volume is its own" in caption_of(draw(first)).text
    assert "encloses nothing" in caption_of(draw(last)).text
    with pytest.raises(InputError, match="open"):
        last_of(Params(mesh=tmp_path / "open.ply", method="chance"))


def test_faces_that_disagree_are_told(tmp_path):
    ball = trimesh.creation.icosphere(2)
    ball.faces[:9] = ball.faces[:9, ::-1]
    trimesh.Trimesh(ball.vertices, ball.faces, process=False).export(tmp_path / "turned.ply")
    first, *_ = run(Params(mesh=tmp_path / "turned.ply"))
    assert "disagree which side is outside" in caption_of(draw(first)).text


# real meshes --------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "hull"),
    [
        ("curvature/bunny.off", 1.66),
        ("curvature/fertility.off", None),
        ("shapes/bunny_npm.ply", None),
    ],
)
def test_scans_are_what_trimesh_says(shared_data, name, hull):
    path = shared_data / name
    last = last_of(Params(mesh=path))
    theirs: Any = trimesh.load(path, process=False)
    assert last.now.volume == pytest.approx(theirs.volume, rel=1e-6)
    assert last.now.area == pytest.approx(theirs.area, rel=1e-6)
    if hull:
        assert theirs.convex_hull.volume / last.now.volume == pytest.approx(hull, abs=0.01)


def test_of_a_bunny_vertices_and_surface_have_middles_of_their_own(shared_data):
    p, faces = read_mesh(shared_data / "curvature/bunny.off")
    mesh = trimesh.Trimesh(p, faces, process=False)
    gap = np.linalg.norm(p.mean(axis=0) - mesh.center_mass) / mesh.scale
    assert gap == pytest.approx(0.04, abs=0.002)
    np.testing.assert_allclose(area_centroid(p, faces), mesh.centroid, atol=1e-9)


def test_the_bunny_by_voxels_and_by_lines(shared_data):
    path = shared_data / "shapes/bunny_npm.ply"
    assert abs(last_of(Params(mesh=path, method="voxels", cells=64)).volume_error) < 0.01
    last = last_of(Params(mesh=path, method="lines", throws=2000))
    assert abs(last.area_error) < 3 * last.now.estimates.errors[-1] / last.subject.area


def test_the_teapot_is_open(shared_data):
    first, *_, last = run(Params(mesh=shared_data / "shapes/teapot_npm.ply"))
    assert np.isnan(last.subject.volume)
    assert "no volume is its own" in caption_of(draw(first)).text


# voxels -------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def organ(tmp_path_factory) -> Path:
    """Two labels on a grid that is coarser along z: a ball of radius 12 mm, and a slab."""
    path = tmp_path_factory.mktemp("voxels") / "organ.npz"
    x, y, z = np.meshgrid(np.arange(40), np.arange(40), np.arange(20), indexing="ij")
    labels = np.where((x - 20) ** 2 + (y - 20) ** 2 + (2 * (z - 10)) ** 2 < 144, 3, 0)
    labels[:, :, 0] = 7
    np.savez_compressed(path, labels=labels.astype(np.uint8))
    return path


def test_one_label_is_measured_with_its_spacing(organ):
    last = last_of(
        Params(voxels=organ, spacing=(1.0, 1.0, 2.0), label=3, unit="mm", method="voxels")
    )
    labels = read_voxels(organ)
    assert last.subject.volume == pytest.approx(2.0 * (labels == 3).sum())
    assert last.now.volumes[-1] == last.subject.volume
    assert last.subject.volume == pytest.approx(4 / 3 * np.pi * 12**3, rel=0.02)
    assert 1.3 < last.now.areas[-1] / (4 * np.pi * 12**2) < 1.6
    assert 1.0 < last.now.marched[-1] / (4 * np.pi * 12**2) < 1.15
    assert last.now.across == (3, 6, 11, 23)
    assert " mm³" in caption_of(draw(last)).text


def test_its_surface_is_measured_by_faces_too(organ):
    last = last_of(Params(voxels=organ, spacing=(1.0, 1.0, 2.0), label=3))
    assert abs(last.now.volume / last.subject.volume - 1) < 0.05
    slab = last_of(Params(voxels=organ, label=7))
    assert slab.subject.volume == 1600


def test_all_labels_together(organ):
    labels = read_voxels(organ)
    first, *_ = run(Params(voxels=organ))
    assert first.subject.volume == (labels != 0).sum()


@pytest.mark.parametrize(
    ("arrays", "label", "message"),
    [
        ({"labels": np.ones((3, 3, 3), np.uint8)}, 9, "no voxel has the label 9; there are 1"),
        ({"labels": np.zeros((3, 3, 3), bool)}, 0, "none but 0"),
        ({"labels": np.ones((3, 3))}, 0, "no array of three axes"),
        (
            {"a": np.ones((3, 3, 3), bool), "b": np.ones((2, 2, 2), bool)},
            0,
            "2 arrays of three axes",
        ),
        ({"labels": np.ones((3, 3, 3))}, 0, "no array of three axes"),
    ],
)
def test_voxels_that_cannot_be_used_are_refused_in_one_line(tmp_path, arrays, label, *, message):
    np.savez(tmp_path / "bad.npz", **arrays)
    with pytest.raises(InputError, match=message):
        next(run(Params(voxels=tmp_path / "bad.npz", label=label)))


def test_files_that_are_none(tmp_path, cow, organ):
    (tmp_path / "note.txt").write_text("no voxels")
    with pytest.raises(InputError, match="npy and npz"):
        next(run(Params(voxels=tmp_path / "note.txt")))
    with pytest.raises(InputError, match="one of them"):
        next(run(Params(voxels=organ, mesh=cow)))
    with pytest.raises(InputError, match="no such file"):
        next(run(Params(voxels=tmp_path / "gone.npz")))
