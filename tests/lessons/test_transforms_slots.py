"""The transforms lesson driven by a student's functions and own meshes, and what it draws."""

import dataclasses

import numpy as np
import pytest
import trimesh

from lessons.transforms.composition import Factor, compose
from lessons.transforms.lesson import draw, lesson, run
from lessons.transforms.presets import complete
from lessons.transforms.state import Built, Moved, Params
from tests.lessons.transforms_runs import MOVE, built, opened, opened_at, preset, timeline
from workbench.errors import InputError
from workbench.geometry.motions import inverse, motion, rotation_angle
from workbench.geometry.motions.affine import transform
from workbench.geometry.motions.rotations import euler_to_matrix, rotation_from_axis_angle
from workbench.run.timeline import Timeline
from workbench.scene import Caption, Mesh, Table, caption_of


def last_built(params: Params, **slots) -> Built:
    state = list(lesson.run(params, **slots))[-1]
    assert isinstance(state, Built)
    return state


def last_moved(params: Params, **slots) -> Moved:
    state = list(lesson.run(params, **slots))[-1]
    assert isinstance(state, Moved)
    return state


def test_the_inverse_of_the_student_undoes_the_run():
    wrong = last_built(Params(), invert_rigid=lambda T: motion(T[:3, :3].T, -T[:3, 3]))
    assert wrong.left > 0.5
    assert caption_of(draw(wrong)).tone == "wrong"
    params = dataclasses.replace(MOVE, method="screw")
    off = last_moved(params, invert_rigid=lambda T: motion(T[:3, :3], -T[:3, 3]))
    assert np.abs(off.T_world_body - off.T_world_end).max() > 0.1


def test_the_rodrigues_of_the_student_turns_the_handle_and_slerp():
    def forgets_to_normalise(axis, angle):
        return rotation_from_axis_angle(axis, angle * np.linalg.norm(axis))

    params = Params(pose=(1.0, 0.0, 0.0, 0.0, 0.0, 0.5))
    ours, theirs = (
        complete(list(lesson.run(params))),
        last_built(params, rotation_from_axis_angle=forgets_to_normalise),
    )
    assert rotation_angle(
        theirs.T_world_body[:3, :3].T @ ours.T_world_body[:3, :3]
    ) == pytest.approx(0.25)
    backwards = last_moved(
        MOVE, rotation_from_axis_angle=lambda axis, angle: rotation_from_axis_angle(axis, -angle)
    )
    assert backwards.off > 10


def test_the_euler_angles_of_the_student_turn_the_body():
    def reversed_product(angles, order):
        return euler_to_matrix(angles, order.swapcase())

    ours, theirs = (
        complete(list(lesson.run(Params()))),
        last_built(Params(), euler_to_matrix=reversed_product),
    )
    assert rotation_angle(theirs.T_world_body[:3, :3].T @ ours.T_world_body[:3, :3]) > 0.3
    params = dataclasses.replace(MOVE, method="Euler angles")
    middle = [
        list(lesson.run(params, **slots))[15]
        for slots in ({}, {"euler_to_matrix": reversed_product})
    ]
    assert np.abs(middle[0].T_world_body - middle[1].T_world_body).max() > 0.1


def test_an_own_mesh(tmp_path):
    path = tmp_path / "ball.ply"
    trimesh.creation.icosphere(subdivisions=3, radius=40.0).apply_translation([7, 8, 9]).export(
        path
    )
    state = built(Params(mesh=path, point=11))
    p = state.body.solid.p
    np.testing.assert_allclose(np.ptp(p, axis=0), 1.0, atol=0.01)
    assert p[:, 2].min() == pytest.approx(0.0, abs=1e-12)
    assert {c.name: c.amount for c in state.by_all}["volume"] == pytest.approx(0.4)
    assert "mesh before anything" in timeline(Params(mesh=path))[0].caption.text


def test_a_bad_mesh_is_one_clear_line(tmp_path):
    missing = Timeline(lesson, Params(mesh=tmp_path / "none.ply")).complete()
    assert missing.failure is None
    assert missing.stopped
    big = tmp_path / "big.ply"
    trimesh.creation.icosphere(subdivisions=6).export(big)
    with pytest.raises(InputError, match="takes up to 50,000"):
        list(lesson.run(Params(mesh=big)))


# the picture --------------------------------------------------------------------------------------


def test_the_table_shows_the_matrix():
    step = timeline(Params())[lesson.first_step]
    table = step.scene["matrix"]
    assert isinstance(table, Table)
    shown = [[float(cell.replace("−", "-")) for cell in row] for row in table.rows]
    np.testing.assert_allclose(shown, step.state.T, atol=0.005)


def test_a_mirrored_body_is_not_drawn_inside_out():
    step = next(s for s in timeline(preset("mirror")).known() if s.state.factor.kind == "mirror")
    mesh = step.scene["body"]
    assert isinstance(mesh, Mesh)
    assert mesh.T_world_object is not None
    shown = trimesh.Trimesh(transform(mesh.T_world_object, mesh.p), mesh.faces, process=False)
    assert shown.volume > 0


def test_a_moved_body_keeps_its_arrays():
    for params in (Params(), MOVE):
        meshes = [step.scene["body"] for step in timeline(params).known()]
        assert all(isinstance(mesh, Mesh) for mesh in meshes)
        assert len({id(mesh.p) for mesh in meshes if isinstance(mesh, Mesh)}) == 1


def test_captions_name_the_number():
    for p in lesson.presets:
        for step in timeline(p.params).known():
            assert isinstance(step.caption, Caption)
            assert any(character.isdigit() for character in step.caption.text), step.caption.text


def test_nothing_to_blame_is_not_blamed():
    """A wrong reading that changes nothing here is called the same, not "0.00 m off"."""
    still = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    for compare in ("undo by (Rᵀ, −t)", "undo all as if rigid"):
        last = timeline(Params(scale=(1, 1, 1), pose=still, compare=compare))[-1].caption
        assert last.tone == "good"
        assert "does the same" in last.text
    front = opened_at(Params(pose=still, compare="direction with w = 1"), -2).caption
    assert front.tone == "info"
    assert "is the same here" in front.text
    one_turn = Params(scale=(1, 1, 1), angles=(0.0, 0.0, 40.0), compare="four conventions")
    assert (
        "3 of 4 the same, the other: farthest vertex" in opened_at(one_turn, -2).caption.text
    )  # ZYX turns about x
    still_turns = opened_at(Params(angles=(30.0, 0.0, 0.0), scale=(1, 1, 1)), 2).caption.text
    assert still_turns == "Turned 0° about the world's y, that is not at all: nothing moved."


def test_a_students_wrong_function_is_not_said_to_be_right():
    def shrinking(angles, order):
        return 0.9 * euler_to_matrix(angles, order)

    turned = list(run(Params(scale=(1, 1, 1)), euler_to_matrix=shrinking))[1]
    caption = caption_of(draw(turned))
    assert caption.tone == "wrong"
    assert "edge lengths" in caption.text
    backwards = last_moved(
        MOVE, rotation_from_axis_angle=lambda axis, angle: rotation_from_axis_angle(axis, -angle)
    )
    end = caption_of(draw(backwards))
    assert end.tone == "wrong"
    assert "The end is missed" in end.text


def test_a_blend_that_was_no_rotation_does_not_end_well():
    caption = timeline(preset("entries"))[-1].caption
    assert caption.tone == "info"
    assert "the volume fell to 0.76 %" in caption.text
    assert timeline(MOVE)[-1].caption.tone == "good"


def test_a_projective_map_is_not_said_to_have_a_stretch():
    table = opened("perspective").scene["numbers"]
    assert isinstance(table, Table)
    assert not {"stretch", "det T"} & {row[0] for row in table.rows}
    mirrored = opened("mirror").scene["numbers"]
    assert isinstance(mirrored, Table)
    assert ("det T", "−1.00") in mirrored.rows


def test_compose_undoes_only_the_motion():
    A, T = (
        Factor("scale", "", np.diag([2.0, 1, 1, 1])),
        Factor("turn", "", motion(np.eye(3)[[1, 2, 0]], np.ones(3))),
    )
    *_, done, undone = compose([A], [T], inverse)
    np.testing.assert_allclose(done.T, T.matrix @ A.matrix)
    np.testing.assert_allclose(undone.T, A.matrix, atol=1e-15)
