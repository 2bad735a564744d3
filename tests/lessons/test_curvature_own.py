"""Own meshes in the curvature lesson: how they are mended, stood up and said to be, and which are
refused.
"""

import dataclasses
from pathlib import Path

import numpy as np
import pytest
import trimesh

from lessons.curvature.inputs import Input
from lessons.curvature.lesson import lesson
from lessons.curvature.mesh import EYE
from lessons.curvature.presets import GAUSSIAN
from tests.lessons.curvature_runs import STAGES, at, part, states, surface_field, timeline
from workbench.data.files import read_mesh
from workbench.errors import InputError
from workbench.knobs import with_own_files
from workbench.run.timeline import Timeline
from workbench.scene import Curve, Scalar, caption_of


@pytest.mark.parametrize(("name", "chi"), [("bunny", 2), ("fertility", -6)])
def test_scans_are_enlarged_and_their_sum_is_theirs(shared_data, name, chi):
    done = timeline(Input(mesh=shared_data / "curvature" / f"{name}.off"))
    assert [state.stage for state in done.states() if state.stage != "unfolding"] == STAGES[:-1]
    state = states(Input(mesh=shared_data / "curvature" / f"{name}.off"))[-1]
    assert abs(state.now.total - 2 * np.pi * chi) < 1e-9
    p, _ = read_mesh(shared_data / "curvature" / f"{name}.off")
    assert state.subject.enlarged == pytest.approx(2.0 / np.ptp(p, axis=0).max())
    assert abs(state.subject.p.min(axis=0) + state.subject.p.max(axis=0)).max() < 1e-9
    assert state.subject.up == "y"
    assert np.ptp(state.subject.p[:, 2]) == pytest.approx(state.subject.enlarged * np.ptp(p[:, 1]))
    for stage in (
        "gaussian",
        "mean",
        "defect",
    ):  # the colours tell most vertices apart, and the caption says so
        field = surface_field(Input(mesh=shared_data / "curvature" / f"{name}.off"), stage)
        assert np.mean(np.abs(field.values) <= field.high) == pytest.approx(0.9, abs=0.015)
        assert np.std(np.clip(field.values / field.high, -1, 1)) > 0.2
    caption = caption_of(done[GAUSSIAN].scene).text
    limit = surface_field(Input(mesh=shared_data / "curvature" / f"{name}.off"), "gaussian").high
    assert f"colours reach to ±{limit:g} m⁻²; " in caption
    assert not state.errors
    for step in done.known():
        assert not any(isinstance(primitive, Scalar) for primitive in step.scene.values())
    histogram = part(Curve, done[GAUSSIAN].scene, "histogram K")
    assert histogram.y.sum() == len(state.subject.p)


def test_a_soup_is_welded(tmp_path):
    ball = trimesh.creation.icosphere(2)
    soup = trimesh.Trimesh(
        ball.triangles.reshape(-1, 3), np.arange(3 * len(ball.faces)).reshape(-1, 3), process=False
    )
    soup.export(tmp_path / "ball.stl")
    state = at(Input(mesh=tmp_path / "ball.stl"), "total")
    assert len(state.subject.p) == len(ball.vertices)
    assert state.now.total == pytest.approx(4 * np.pi, abs=1e-9)


def written(folder, p, faces, *, name="own.off"):
    rows = [" ".join(f"{x:.17g}" for x in q) for q in p] + [f"3 {a} {b} {c}" for a, b, c in faces]
    (folder / name).write_text("\n".join([f"OFF\n{len(p)} {len(faces)} 0", *rows]))
    return Input(mesh=folder / name)


BALL = trimesh.creation.icosphere(1)


@pytest.mark.parametrize(
    ("p", "faces", "words", "chi"),
    [
        (
            np.vstack([BALL.vertices, 2 * BALL.vertices[0] - BALL.vertices[1:]]),
            np.vstack([BALL.faces, np.where(BALL.faces == 0, 0, BALL.faces + 41)[:, ::-1]]),
            "1 vertex added where sheets only touch, one for each sheet",
            4,
        ),
        (
            BALL.vertices,
            np.vstack([BALL.faces[:70], BALL.faces[70:, ::-1]]),
            "10 faces turned round to agree with the others",
            2,
        ),
        (
            BALL.vertices,
            np.vstack([BALL.faces, BALL.faces[3:5]]),
            "2 faces listed twice left out",
            2,
        ),
        (np.vstack([BALL.vertices, [[9.0, 9.0, 9.0]]]), BALL.faces, "", 2),
        (
            np.vstack([BALL.vertices, BALL.vertices + 5]),
            np.vstack([BALL.faces, BALL.faces + 42]),
            "",
            4,
        ),
        (BALL.vertices, BALL.faces[1:], "", 1),
    ],
    ids=["sheets touch", "turned", "twice", "unused", "two pieces", "open"],
)
def test_awkward_meshes_are_mended_and_the_caption_says_how(tmp_path, p, faces, *, words, chi):
    params = written(tmp_path, p, faces)
    run = timeline(params)
    start = states(params)[0]
    total = states(params)[-1]
    text = caption_of(run[0].scene).text
    assert f"Mended: {words}." in text if words else "Mended" not in text
    assert total.now.chi == chi
    assert total.now.total == pytest.approx(2 * np.pi * total.now.chi, abs=1e-9)
    assert len(start.subject.faces) == len(np.unique(np.sort(faces, axis=1), axis=0))
    assert total.now.H[~start.subject.border].min() > 0  # most faces tell the side


@pytest.mark.parametrize("unit", [1e-6, 1e-3, 1e3])
def test_a_mesh_in_any_unit_looks_the_same_and_its_size_is_said_without_exponents(tmp_path, unit):
    run = timeline(written(tmp_path, unit * BALL.vertices, BALL.faces))
    state = run.states()[-1]
    np.testing.assert_allclose(
        state.now.K,
        timeline(written(tmp_path, BALL.vertices, BALL.faces, name="1.off"))[-1].state.now.K,
    )
    assert f"{1 / unit:,.10g} m here" in caption_of(run[0].scene).text.replace("1.00", "1")
    for step in run.known():
        assert "e+" not in caption_of(step.scene).text
        assert "e-" not in caption_of(step.scene).text


def tower(lying):
    """A slab 3 high, 2 broad, 1 deep, standing at height 0 on the axis `lying`."""
    box = trimesh.creation.box((2.0, 1.0, 3.0)).subdivide()
    p = np.array(box.vertices) + np.array([0.0, 0.0, 1.5])
    return (p if lying == "z" else np.stack([p[:, 0], p[:, 2], -p[:, 1]], 1)), np.array(box.faces)


@pytest.mark.parametrize("lying", ["z", "y"])
def test_an_own_mesh_stands_upright_and_turns_its_broad_side_to_the_viewer(tmp_path, lying):
    params = written(tmp_path, *tower(lying))
    state = states(params)[0]
    assert state.subject.up == lying
    p = state.subject.p
    eye = np.array([*EYE[:2], 0.0]) / np.hypot(*EYE[:2])
    assert np.ptp(p[:, 2]) == pytest.approx(2.0)
    assert np.ptp(p @ eye) == pytest.approx(2 / 3)  # the thin side is along the line of sight
    assert np.ptp(p @ np.cross(eye, [0, 0, 1])) == pytest.approx(4 / 3)
    upside = states(dataclasses.replace(params, up="x"))[0].subject.p
    assert np.ptp(upside[:, 2]) == pytest.approx(4 / 3)


def test_which_axis_points_up_is_kept_with_an_own_mesh():
    mine = Input(mesh=Path("mine.stl"), up="-y", size=2.0)
    assert with_own_files(Input(), mine) == Input(mesh=Path("mine.stl"), up="-y")


def test_minus_y_stands_it_on_its_head(tmp_path):
    params = written(tmp_path, *tower("y"))
    upright, two = (states(dataclasses.replace(params, up=up))[0].subject for up in ("y", "-y"))
    np.testing.assert_allclose(two.p[:, 2], -upright.p[:, 2], atol=1e-9)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (
            "OFF\n5 3 0\n0 0 0\n1 0 0\n0 1 0\n0 -1 0\n0 0 1\n3 0 1 2\n3 1 0 3\n3 0 1 4\n",
            "bad.off: .*more than two faces",
        ),
        (  # a Moebius strip of five triangles
            "OFF\n5 5 0\n1 0 0\n0.3 1 0.3\n-0.8 0.6 -0.3\n-0.8 -0.6 0.3\n0.3 -1 -0.3\n"
            "3 0 1 2\n3 1 2 3\n3 2 3 4\n3 3 4 0\n3 4 0 1\n",
            "bad.off: .*which side is outside",
        ),
        ("OFF\n3 1 0\n0 0 0\n1 0 0\n2 0 0\n3 0 1 2\n", "bad.off: .*no area"),
        ("OFF\n3 1 0\n0 0 0\n0 0 0\n0 0 0\n3 0 1 2\n", "bad.off: .*empty"),
        ("OFF\n3 0 0\n0 0 0\n1 0 0\n2 0 0\n", "bad.off"),
        ("nonsense", "bad.off"),
    ],
)
def test_meshes_without_curvature_are_refused_in_one_line(tmp_path, text, words):
    (tmp_path / "bad.off").write_text(text)
    run = Timeline(lesson, Input(mesh=tmp_path / "bad.off")).complete()
    assert run.failure is None
    with pytest.raises(InputError, match=words):
        run.states()


def test_a_missing_file_is_named(tmp_path):
    with pytest.raises(InputError, match="no such file"):
        Timeline(lesson, Input(mesh=tmp_path / "gone.off")).states()
