"""Own meshes in the representations lesson: scans, what is open, and which files are refused."""

import gzip
from typing import Any

import numpy as np
import pytest
import trimesh

from lessons.representations.forms import FORMS, Functions
from lessons.representations.lesson import draw, run
from lessons.representations.state import Params
from lessons.representations.subjects import OWN_SIZE, subject_of
from workbench.errors import InputError
from workbench.geometry.fields.signed_distances import box_sdf
from workbench.geometry.level_sets import edge_crossings
from workbench.geometry.meshes.containment import winding_numbers
from workbench.geometry.shapes.bezier import bezier_patch
from workbench.scene import caption_of

OURS = Functions(bezier_patch=bezier_patch, edge_crossings=edge_crossings)


def last_of(params: Params) -> Any:
    """The last step of the form, without the comparison."""
    *_, last = FORMS[params.form](params, subject_of(params, box_sdf), OURS)
    return last


@pytest.fixture(scope="module")
def ball(tmp_path_factory):
    """A closed mesh in millimetres, far from its origin, every face with corners of its own."""
    path = tmp_path_factory.mktemp("own") / "ball.stl"
    made = trimesh.creation.icosphere(3, 40.0)
    made.apply_translation([500, 20, 900])
    made.export(path)
    return path


@pytest.mark.parametrize("form", ["cloud", "mesh", "voxels", "distances", "octree"])
def test_every_form_takes_it(ball, form):
    last = last_of(Params(mesh=ball, form=form, resolution=16, depth=4, points=400))
    assert np.abs(np.ptp(last.subject.p, axis=0) - OWN_SIZE).max() < 0.01
    assert last.errors[-1] < 0.1
    assert caption_of(draw(last)).text
    if last.surface is not None:
        assert last.surface.volume == pytest.approx(1, abs=0.1)


def test_a_network_takes_it_and_stands_beside_other_forms(ball):
    *_, last = run(Params(mesh=ball, form="neural", iterations=100))
    assert last.surface is not None
    assert last.surface.mean < 0.05
    assert set(last.others) == {"cloud", "mesh", "voxels", "distances"}
    assert "ball.stl in" in caption_of(draw(last)).text


def test_an_open_mesh_has_no_inside(tmp_path):
    ball = trimesh.creation.icosphere(2)
    ball.update_faces(np.arange(len(ball.faces)) > 5)
    ball.export(tmp_path / "open.ply")
    for form in ("voxels", "distances", "octree", "neural"):
        with pytest.raises(InputError, match=r"open\.ply is open"):
            next(run(Params(mesh=tmp_path / "open.ply", form=form)))
    *_, last = run(Params(mesh=tmp_path / "open.ply", form="cloud", points=500))
    assert last.subject is not None
    assert not last.subject.closed
    assert set(last.others) == {"mesh"}


def test_files_that_are_none(tmp_path):
    (tmp_path / "note.txt").write_text("no mesh")
    (tmp_path / "empty.off").write_text("OFF\n0 0 0\n")
    (tmp_path / "nan.off").write_text("OFF\n3 1 0\n0 0 0\n1 0 nan\n0 1 0\n3 0 1 2\n")
    (tmp_path / "flat.off").write_text("OFF\n3 1 0\n0 0 0\n1 0 0\n2 0 0\n3 0 1 2\n")
    for name in ("note.txt", "empty.off", "nan.off", "flat.off", "gone.off"):
        with pytest.raises(InputError, match=name.split(".")[0]):
            next(run(Params(mesh=tmp_path / name, form="mesh")))
    big = trimesh.creation.icosphere(6)
    big.export(tmp_path / "big.ply")
    with pytest.raises(InputError, match="at most 50,000"):
        next(run(Params(mesh=tmp_path / "big.ply")))


def test_own_points_are_stored_as_points(tmp_path):
    p = np.random.default_rng(0).normal(size=(300, 3)) * [2000, 500, 100] + 1e5
    np.savetxt(tmp_path / "scan.csv", p, delimiter=",")

    def ends(**options: Any) -> list[Any]:
        return list(run(Params(cloud=tmp_path / "scan.csv", **options)))

    last = ends(form="cloud", points=200)[-1]
    assert last.now.hole in last.subject.p
    assert np.ptp(last.subject.p, axis=0).max() == pytest.approx(OWN_SIZE)
    assert not last.others
    assert "200 points, 2.4 kB. The points of the file are" in caption_of(draw(last)).text
    last = ends(form="neighbours", points=500, neighbours=6)[-1]
    assert len(last.now.p) == 300
    assert "from the nearest point of the file" in caption_of(draw(last)).text
    *_, search, last = ends(form="k-d tree", points=300, dimensions=9)
    tree, query = search.now.tree, search.now.query
    assert tree.p.shape == (300, 3)
    assert search.now.visits[-1].distance == pytest.approx(
        np.linalg.norm(tree.p - query, axis=1).min()
    )
    assert last.growth is not None


def test_points_are_no_solid(tmp_path):
    (tmp_path / "few.xyz").write_text("0 0 0\n1 0 0\n0 1 0\n")
    for form in ("distances", "mesh", "voxels", "octree", "neural"):
        with pytest.raises(InputError, match=r"few\.xyz is points, .* cloud, neighbours, k-d tree"):
            next(run(Params(cloud=tmp_path / "few.xyz", form=form)))
    with pytest.raises(InputError, match="both given"):
        next(run(Params(cloud=tmp_path / "few.xyz", mesh=tmp_path / "few.ply", form="cloud")))
    for form in ("cloud", "neighbours", "k-d tree"):
        assert all(
            caption_of(draw(state)).text
            for state in run(Params(cloud=tmp_path / "few.xyz", form=form))
        )


# real meshes --------------------------------------------------------------------------------------


def test_a_bunny_comes_back_from_its_distances(shared_data):
    last = last_of(Params(mesh=shared_data / "curvature/bunny.off", resolution=16))
    assert last.surface.volume == pytest.approx(1, abs=0.1)
    assert last.surface.mean < 0.02


def test_what_is_open_among_scans_has_no_sign(shared_data):
    path = shared_data / "shapes/teapot_npm.ply"
    with pytest.raises(InputError, match="is open"):
        next(run(Params(mesh=path)))
    last = last_of(Params(mesh=path, form="mesh", points=2000))
    assert last.errors[-1] < 0.02


def test_a_dragon_of_many_parts_has_an_inside_all_the_same(shared_data, tmp_path):
    """It is not watertight, as edges have four faces, but every edge runs as often there as back:
    rays can count.
    """
    path = tmp_path / "dragon.ply"
    path.write_bytes(gzip.decompress((shared_data / "shapes/dragon_vrip_res4.ply.gz").read_bytes()))
    subject = subject_of(Params(mesh=path), box_sdf)
    assert subject.closed
    q = np.random.default_rng(0).uniform(-0.6, 0.6, (40, 3)) * [1, 0.4, 0.7]
    around = winding_numbers(subject.p, subject.faces, q)
    np.testing.assert_array_equal(subject.distance(q) < 0, np.abs(around) > 0.5)
    assert 3 < (np.abs(around) > 0.5).sum() < 37
