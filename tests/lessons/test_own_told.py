"""What lessons say of own files that a person would else have to guess."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import trimesh

from lessons.axes.lesson import lesson as axes
from lessons.axes.scans import scans_of
from lessons.graphs.presets import BALL, VIEW
from workbench.data.shapes.clouds import pair
from workbench.geometry.motions import exp_so3, motion
from workbench.knobs import fields_of
from workbench.lesson import course
from workbench.run.timeline import Timeline

CARS = Path(__file__).resolve().parents[3] / "shared" / "data" / "icp" / "car_cloud400.csv"


def captions(name: str, **own) -> list[str]:
    lesson = course()[name]
    timeline = Timeline(lesson, replace(lesson.params(), **own)).complete()
    assert timeline.stopped is None
    return [step.caption.text for step in timeline.known()]


@pytest.mark.parametrize(("made", "euler"), [("torus", 0), ("icosphere", 2)])
def test_learning_says_where_an_own_mesh_is_not_like_a_sphere(tmp_path, made, euler):
    shape = trimesh.creation.torus(1.0, 0.4) if made == "torus" else trimesh.creation.icosphere(3)
    assert shape.euler_number == euler
    shape.export(tmp_path / "own.off")
    first = captions("learning", task="mesh", scan=tmp_path / "own.off")[0]
    assert ("own.off is not like a sphere (V − E + F = 0, not 2)" in first) == (euler != 2)


def test_graphs_shows_an_own_mesh_from_the_side_and_own_edges_from_above(tmp_path):
    lesson = course()["graphs"]
    for field, view in (("mesh", BALL), ("cloud", BALL), ("edges", VIEW)):
        assert lesson.view_of(replace(lesson.params(), **{field: tmp_path / "own"})) == view


def test_pose_says_which_camera_is_taken(tmp_path):
    rng = np.random.default_rng(0)
    p = rng.uniform([-1, -1, 5], [1, 1, 7], (12, 3))
    uv = np.add(600 * p[:, :2] / p[:, 2:], (319.5, 239.5))
    np.savetxt(tmp_path / "own.txt", np.hstack([p, uv]))
    asked, *_, end = captions("pose", sightings=tmp_path / "own.txt")
    # runs open past the first step
    assert end.endswith("f = 800 px is a guess: set your camera's.")
    assert "What is its focal length? Until you set it, 800 px is taken as a guess" in asked
    first, *others = captions("pose", sightings=tmp_path / "own.txt", focal=600.0)
    assert not any("guess" in text for text in others)
    assert (
        "with the focal length that you say, 600 px, and the principal point (319.5, 239.5)"
        in first
    )
    hint = {field.name: field.knob.hint for field in fields_of(course()["pose"].params)}["focal"]
    assert "800 px is a guess until you give yours" in hint


def test_features_says_why_own_scans_have_no_verdict(tmp_path):
    T = motion(exp_so3(np.array([0.0, 0.0, 0.6])), np.array([0.3, 0.1, 0.0]))
    made = pair("rabbit", 3000, T, rng=np.random.default_rng(0), overlap=0.9, noise=0.002)
    np.save(tmp_path / "a.npy", made.p_target)
    np.save(tmp_path / "b.npy", made.p_source)
    last = captions("features", target=tmp_path / "a.npy", source=tmp_path / "b.npy")[-1]
    assert "have a target point within 40 mm" in last
    assert "Only their known pose could say whether it is right; none is given." in last


def test_a_few_far_points_push_no_cloud_out_of_the_picture(tmp_path):
    rng = np.random.default_rng(0)
    p = np.vstack([rng.uniform(-0.5, 0.5, (2000, 3)), rng.uniform(-6, 6, (20, 3))])
    np.save(tmp_path / "own.npy", p)
    files = [tmp_path / "own.npy", *([CARS] if CARS.is_file() else [])]
    for file in files:
        scans = scans_of(replace(axes.params(), source=file))
        middle = (
            np.median(scans.p_target[:, 0])
            + scans.T_world_target[0, 3]
            + np.median(scans.p_source[:, 0])
        ) / 2
        assert middle == pytest.approx(axes.views["both"].target[0], abs=0.15)
