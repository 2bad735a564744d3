"""The transforms lesson driven by a student's inverse and by own meshes."""

import numpy as np
import pytest
import trimesh

from lessons.transforms.composition import Factor, compose
from lessons.transforms.inputs import Input, setup
from lessons.transforms.lesson import lesson
from workbench.errors import InputError
from workbench.geometry.motions import inverse, motion
from workbench.geometry.motions.affine import transform
from workbench.lesson import Look
from workbench.run.timeline import Timeline
from workbench.scene import Mesh, caption_of


def wrong_inverse(T):
    return motion(T[:3, :3].T, -T[:3, 3])


@pytest.mark.parametrize("name", ["default", "undoing"])
def test_the_inverse_of_the_student_undoes_the_run(name):
    params = lesson.run_params(name)
    run = lesson.form.states(params, {"invert_rigid": wrong_inverse})
    *past, last = run
    look = Look(params=params, subject=setup(params), now=last, past=tuple(past))
    assert caption_of(lesson.form.draw(look)).tone == "wrong"
    *past, last = lesson.form.states(params, {"invert_rigid": inverse})
    look = Look(params=params, subject=setup(params), now=last, past=tuple(past))
    assert caption_of(lesson.form.draw(look)).tone != "wrong"


def test_an_own_mesh(tmp_path):
    path = tmp_path / "ball.ply"
    ball = trimesh.creation.icosphere(subdivisions=3, radius=40.0).apply_translation([7, 8, 9])
    ball.export(path)
    params = Input(mesh=path, point=11)
    p = setup(params).solid.p
    np.testing.assert_allclose(np.ptp(p, axis=0), 1.0, atol=0.01)
    assert p[:, 2].min() == pytest.approx(0.0, abs=1e-12)
    run = Timeline(lesson, params).complete()
    assert {c.name: c.amount for c in run[5].state.by_all}["volume"] == pytest.approx(0.4)
    assert "The mesh before anything" in run[0].caption.text


@pytest.mark.parametrize("stage", ["columns", "order", "undo", "shear", "shift", "divide"])
def test_an_own_mesh_goes_under_every_hand(tmp_path, stage):
    path = tmp_path / "ball.ply"
    trimesh.creation.icosphere(subdivisions=1).export(path)
    run = Timeline(lesson, Input(mesh=path, stage=stage)).complete()
    assert run.failure is None
    assert run[len(run) // 2].caption.text


def test_a_bad_mesh_is_one_clear_line(tmp_path):
    missing = Timeline(lesson, Input(mesh=tmp_path / "none.ply")).complete()
    assert missing.failure is None
    assert missing.stopped
    big = tmp_path / "big.ply"
    trimesh.creation.icosphere(subdivisions=6).export(big)
    with pytest.raises(InputError, match="takes up to 50,000"):
        setup(Input(mesh=big))


def test_a_mirrored_body_is_not_drawn_inside_out():
    run = Timeline(lesson, lesson.preset("mirror").params).complete()
    mesh = next(step for step in run.known() if step.state.factor.kind == "mirror").scene["body"]
    assert isinstance(mesh, Mesh)
    assert mesh.T_world_object is not None
    shown = trimesh.Trimesh(transform(mesh.T_world_object, mesh.p), mesh.faces, process=False)
    assert shown.volume > 0


def test_compose_undoes_only_the_motion():
    A = Factor("scale", "", np.diag([2.0, 1, 1, 1]))
    T = Factor("turn", "", motion(np.eye(3)[[1, 2, 0]], np.ones(3)))
    *_, done, undone = compose([A], [T], inverse)
    np.testing.assert_allclose(done.T, T.matrix @ A.matrix)
    np.testing.assert_allclose(undone.T, A.matrix, atol=1e-15)
