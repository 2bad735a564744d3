"""Own meshes in the learning lesson: a real one, their unit and upward axis, and files that must be
refused.
"""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh

from lessons.learning.lesson import lesson, run
from lessons.learning.state import Params
from tests.truths.learning import folded, to_given
from workbench.errors import InputError
from workbench.scene import caption_of


def own(path: Path, updates: int = 0, **changes: Any) -> list[Any]:
    return list(run(Params(task="mesh", scan=path, updates=updates, **changes)))


@pytest.fixture(scope="module")
def box(tmp_path_factory) -> Path:
    """A closed mesh in millimetres, far from its origin, as files have it."""
    path = tmp_path_factory.mktemp("own") / "statue.stl"
    mesh = trimesh.creation.box((30, 40, 90))
    mesh.apply_translation([500, 20, 900])
    mesh.export(path)
    return path


def test_the_bunny_is_folded_without_a_laplacian_and_smooth_with_it(shared_data):
    bunny = shared_data / "shapes" / "bunny_npm.ply"
    crumpled, smooth = (own(bunny, laplacian=laplacian)[-1] for laplacian in (0.0, 10.0))
    assert folded(crumpled) > 0.25
    assert folded(smooth) < 0.03
    assert to_given(crumpled) < to_given(smooth)
    assert smooth.now.to_truth < crumpled.now.to_truth
    assert "the given points of bunny_npm.ply" in caption_of(lesson.draw(smooth)).text


def test_a_mesh_of_any_unit_is_brought_to_the_size_of_the_scene(box):
    first, *_, last = own(box, updates=20)
    given = first.about.given
    assert np.ptp(given, axis=0).max() == pytest.approx(1.2, abs=0.3)
    assert np.abs(given.mean(axis=0)).max() < 0.3
    assert last.now.to_given < 0.5 * first.now.to_given
    assert "statue.stl" in caption_of(lesson.draw(last)).text
    np.testing.assert_array_equal(own(box, updates=2)[-1].now.p, own(box, updates=2)[-1].now.p)


def test_an_own_mesh_stands_as_it_is_told(box):
    tall = {
        up: int(np.ptp(own(box, updates=1, up=up, noise=0.0)[0].about.given, axis=0).argmax())
        for up in ("y", "z")
    }
    assert tall["z"] == 2
    assert tall["y"] != 2


def test_other_tasks_leave_it_alone(box):
    assert len(list(run(Params(task="sets", scan=box, updates=1)))) == 2


@pytest.mark.parametrize(
    ("name", "text", "says"),
    [
        ("empty.obj", "", "empty.obj"),
        ("words.ply", "hello, I am no mesh", "words.ply"),
        ("flat.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n2 0 0\n3 0 1 2\n", "no area"),
        ("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n", "points.obj"),
        ("nan.off", "OFF\n3 1 0\n0 0 nan\n1 0 0\n0 1 0\n3 0 1 2\n", "nan.off"),
        ("beyond.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n", "beyond.off"),
    ],
)
def test_what_is_no_mesh_is_refused(tmp_path, name, text, *, says):
    (tmp_path / name).write_text(text)
    with pytest.raises(InputError, match=says):
        own(tmp_path / name)


def test_a_mesh_of_too_many_faces_is_refused(tmp_path, monkeypatch, box):
    monkeypatch.setattr("lessons.learning.tasks.MOST_OWN", 5)
    copy = tmp_path / "large.stl"
    copy.write_bytes(box.read_bytes())
    with pytest.raises(InputError, match="simplify"):
        own(copy)
