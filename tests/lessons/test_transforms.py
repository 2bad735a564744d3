"""Every claim of the transforms lesson in numbers: presets, questions, page, slots, and what is
drawn.
"""

import dataclasses
import itertools
from typing import get_args

import numpy as np
import pytest

from lessons.transforms.body import numbers_of
from lessons.transforms.lesson import draw, lesson
from lessons.transforms.presets import ENTRIES, directions_left, halfway
from lessons.transforms.state import Compare, Method, Params
from tests.lessons.transforms_runs import (
    MOVE,
    built,
    exp_axis,
    moved,
    opened,
    opened_at,
    preset,
    survivors,
    timeline,
)
from workbench.geometry.motions import inverse, motion, rotation_angle
from workbench.geometry.motions.affine import Kind, kind_of, transform
from workbench.geometry.motions.rotations import (
    angles_apart,
    axis_angle_from_rotation,
    euler_to_matrix,
    rotation_from_axis_angle,
    triple_past_lock,
)
from workbench.scene import Segments, Table, caption_of, is_rigid

# building -----------------------------------------------------------------------------------------


def test_one_factor_per_step_and_the_newest_on_the_left():
    states = timeline(
        Params(mirror="y", shear=0.3, perspective=0.2, pose=(1, 1, 0, 0.2, 0, 0))
    ).states()
    kinds = [state.factor.kind for state in states]
    assert kinds == [
        "start",
        "scale",
        "shear",
        "perspective",
        "mirror",
        *["turn"] * 3,
        "handle",
        "translate",
        "undo",
    ]
    for before, after in itertools.pairwise(states):
        np.testing.assert_allclose(after.T, after.factor.matrix @ before.T, atol=1e-12)


def test_the_default_run_is_what_its_numbers_say():
    state = built(Params())
    R = euler_to_matrix(np.radians([30.0, 20.0, 60.0]), "xyz")
    np.testing.assert_allclose(
        state.T, motion(R @ np.diag([1, 1, 1.4]), np.array([1.6, 0.6, 0.3])), atol=1e-15
    )
    assert timeline(Params())[lesson.first_step].state is state
    assert timeline(Params()).states()[-1].left < 1e-12


@pytest.mark.parametrize("order", ["xyz", "ZXZ"])
def test_turns_about_fixed_and_carried_axes_come_step_by_step(order):
    states = timeline(Params(scale=(1, 1, 1), order=order)).states()
    done = [
        euler_to_matrix(np.where(np.arange(3) <= k, np.radians([30.0, 20, 60]), 0.0), order)
        for k in range(3)
    ]
    for state, R in zip(states[1:4], done, strict=True):
        np.testing.assert_allclose(state.T[:3, :3], R, atol=1e-14)


def test_the_handle_carries_the_body_with_it():
    pose = (1.0, -2.0, 0.5, 0.3, -0.4, 1.1)
    state = built(Params(scale=(1, 1, 1), pose=pose))
    w = np.array(pose[3:])
    T_world_handle = motion(
        rotation_from_axis_angle(w, float(np.linalg.norm(w))), np.array(pose[:3])
    )
    R = euler_to_matrix(np.radians([30.0, 20.0, 60.0]), "xyz")
    np.testing.assert_allclose(state.T, T_world_handle @ motion(R, np.zeros(3)), atol=1e-14)


def test_the_two_orders_end_two_metres_apart():
    (ghost,) = built(preset("order")).ghosts
    assert ghost.distance == pytest.approx(1.5 * np.sqrt(2))
    swapped = dataclasses.replace(preset("order"), first="translate, then rotate")
    np.testing.assert_allclose(ghost.T, built(swapped).T, atol=1e-15)


def test_gimbal_lock_loses_a_direction_and_no_pose():
    params = preset("gimbal")
    assert directions_left(timeline(params).states()) == 2
    ghosts = built(params).ghosts
    assert len(ghosts) == 3
    assert max(ghost.distance for ghost in ghosts) < 1e-12
    numbers = numbers_of(params)
    triple = triple_past_lock(
        numbers.angles, numbers.order, np.radians(1.0)
    )  # one degree more in the lost direction is reached, but from far away
    R = euler_to_matrix(triple, params.order) @ numbers.rotation().T
    assert np.degrees(rotation_angle(R)) == pytest.approx(1.0)
    assert np.degrees(angles_apart(triple, numbers.angles)) > 80
    locked = opened_at(params, -2).caption.text
    assert "Gimbal lock: angles 1 and 3 turn about one axis; (70, 90, 90)° is the same" in locked
    R_named = euler_to_matrix(np.radians([70.0, 90.0, 90.0]), params.order)
    np.testing.assert_allclose(R_named, numbers.rotation(), atol=1e-15)
    near = opened_at(dataclasses.replace(params, angles=(30.0, 88.0, 50.0)), -2)
    assert "Nearly gimbal lock: angles 1 and 3 turn about axes 2° apart." in near.caption.text
    assert (
        directions_left(timeline(dataclasses.replace(params, angles=(30.0, 80.0, 50.0))).states())
        == 3
    )


def test_one_triple_is_four_rotations():
    ghosts = built(preset("conventions")).ghosts
    assert sum(ghost.distance < 1e-12 for ghost in ghosts) == 1
    rotations = [ghost.T[:3, :3] for ghost in ghosts]
    apart = [rotation_angle(a @ b.T) for i, a in enumerate(rotations) for b in rotations[:i]]
    assert len(apart) == 6
    assert np.degrees(min(apart)) > 10


def test_fixed_axes_are_carried_axes_backwards():
    same, other = built(preset("fixed-own")).ghosts
    assert same.name == "ZYX (70, 30, 40)°"
    assert same.distance < 1e-12
    assert other.distance > 0.5


def test_a_reflection_is_no_rotation():
    state = next(s for s in timeline(preset("mirror")).states() if s.factor.kind == "mirror")
    assert np.linalg.det(state.T) == pytest.approx(-1.0)
    assert {c.name for c in state.by_factor if not c.kept} == {"orientation"}
    (ghost,) = built(preset("mirror")).ghosts
    assert is_rigid(ghost.T)
    assert ghost.distance > 0.5
    p, q = state.body.solid.p, transform(built(preset("mirror")).T, state.body.solid.p)
    rng = np.random.default_rng(0)
    best = np.sum((transform(ghost.T, p) - q) ** 2)
    for _ in range(200):  # no rigid motion near it, or anywhere, does better
        R = rotation_from_axis_angle(rng.normal(size=3), rng.uniform(0, np.pi))
        moved_p = (p - p.mean(axis=0)) @ R.T + q.mean(axis=0)
        assert np.sum((moved_p - q) ** 2) >= best - 1e-12


def test_shear_keeps_volume_and_parallels():
    state = opened_at(preset("shear"), 1).state
    assert state.factor.kind == "shear"
    assert survivors(state) == {"volume", "parallel edges", "orientation"}


def test_a_projective_map_keeps_edges_straight_and_makes_them_meet():
    state = opened("perspective").state
    assert survivors(state) == {"orientation"}
    p = transform(state.T, state.body.solid.p)
    feet, tops = p[:4], p[4:]
    meeting = np.array([0.0, 0.0, 1 / 0.5])  # where lines along z go: d / (slope . d)
    np.testing.assert_allclose(np.cross(meeting - feet, tops - feet), 0.0, atol=1e-12)


def test_the_transpose_turns_the_other_way():
    (ghost,) = built(preset("transpose")).ghosts
    R = built(preset("transpose")).T[:3, :3]
    assert np.degrees(rotation_angle(ghost.T[:3, :3].T @ R)) == pytest.approx(80)


def test_the_wrong_inverse_misses_by_more_than_the_translation():
    state = timeline(preset("inverse")).states()[-1]
    (ghost,) = state.ghosts
    assert state.left < 1e-12
    assert ghost.distance > np.linalg.norm(preset("inverse").pose[:3])
    p_body = transform(ghost.T, state.body.solid.p) - state.body.solid.p
    R, t = state.T_world_body[:3, :3], state.T_world_body[:3, 3]
    np.testing.assert_allclose(p_body, np.tile(R.T @ t - t, (len(p_body), 1)), atol=1e-14)


def test_a_hidden_scale_grows_squared():
    state = timeline(preset("hidden-scale")).states()[-1]
    (ghost,) = state.ghosts
    np.testing.assert_allclose(ghost.T[:3, :3], 1.69 * np.eye(3), atol=1e-12)
    assert ghost.distance > 0.5
    assert caption_of(draw(state)).tone == "wrong"
    assert opened("hidden-scale").caption.tone == "info"  # it is meant to be


def test_a_misread_quaternion_is_another_rotation():
    (ghost,) = built(preset("xyzw")).ghosts
    axis, angle = axis_angle_from_rotation(ghost.T[:3, :3])
    assert np.degrees(angle) == pytest.approx(140.0)
    assert abs(axis[2]) < 0.01


def test_a_direction_with_w_1_picks_up_the_translation():
    scene = opened("direction").scene
    right, wrong = scene["front"], scene["wrong front"]
    assert isinstance(right, Segments)
    assert isinstance(wrong, Segments)
    v, w = np.diff(right.ends[0], axis=0)[0], np.diff(wrong.ends[0], axis=0)[0]
    np.testing.assert_allclose(w - v, 0.5 * np.array(preset("direction").pose[:3]), atol=1e-14)
    assert np.degrees(np.arccos(v @ w / np.linalg.norm(v) / np.linalg.norm(w))) > 30


@pytest.mark.parametrize("compare", get_args(Compare))
def test_every_comparison_draws_what_it_says(compare):
    run = timeline(Params(compare=compare))
    ghosts = [len(step.state.ghosts) for step in run.known()]
    assert (max(ghosts) > 0) == (compare not in ("nothing", "direction with w = 1"))
    for step in run.known():
        assert sum(path.startswith("ghost") for path in step.scene) == 2 * len(step.state.ghosts)


# moving -------------------------------------------------------------------------------------------


@pytest.mark.parametrize("method", get_args(Method))
def test_every_way_starts_and_ends_at_the_poses(method):
    states = moved(dataclasses.replace(MOVE, method=method, pose=(1.0, 0.5, 0.2, 0.3, -0.2, 0.9)))
    assert len(states) == MOVE.steps + 1
    np.testing.assert_allclose(states[0].T_world_body, states[0].T_world_start, atol=1e-12)
    np.testing.assert_allclose(states[-1].T_world_body, states[-1].T_world_end, atol=1e-12)
    assert all(
        is_rigid(state.T_world_body) == (method != "matrix entries") for state in states[1:-1]
    )


def test_the_handle_carries_the_end_pose():
    pose = (1.0, 0.5, 0.2, 0.3, -0.2, 0.9)
    w = np.array(pose[3:])
    R_end = rotation_from_axis_angle(w, float(np.linalg.norm(w))) @ euler_to_matrix(
        np.radians(MOVE.angles_end), "xyz"
    )
    state = moved(dataclasses.replace(MOVE, pose=pose))[0]
    np.testing.assert_allclose(state.T_world_end, motion(R_end, np.array(pose[:3])), atol=1e-14)


def test_slerp_is_the_shortest_turn_at_constant_speed():
    states = moved(MOVE)
    assert max(state.off for state in states) < 1e-6
    speed = np.diff(states[-1].way.turned)
    assert np.ptp(speed) < 1e-9
    total = rotation_angle(states[0].T_world_start[:3, :3].T @ states[0].T_world_end[:3, :3])
    assert states[-1].way.turned[-1] == pytest.approx(np.degrees(total))
    for method in get_args(Method):
        assert (
            moved(dataclasses.replace(MOVE, method=method))[-1].way.turned[-1]
            >= np.degrees(total) - 1e-6
        )


def test_minus_q_goes_the_long_way_to_the_same_end():
    last = moved(preset("minus-q"))[-1]
    assert last.shortest.turned[-1] == pytest.approx(60)
    assert last.way.turned[-1] == pytest.approx(300)
    np.testing.assert_allclose(last.T_world_body, last.T_world_end, atol=1e-12)


def test_euler_angles_wobble():
    states = moved(preset("wobble"))
    speed = np.diff(states[-1].way.turned)
    assert max(state.off for state in states) > 45
    assert speed.max() / speed.min() > 1.5
    assert states[-1].way.turned[-1] > 1.3 * states[-1].shortest.turned[-1]


def test_the_mean_of_170_and_minus_170():
    states = moved(preset("average"))
    assert states[-1].way.turned[-1] == pytest.approx(340)
    assert states[-1].shortest.turned[-1] == pytest.approx(20)
    middle = halfway(states)
    np.testing.assert_allclose(middle.T_world_body[:3, :3], np.eye(3), atol=1e-12)
    np.testing.assert_allclose(
        middle.T_world_shortest[:3, :3], np.diag([-1.0, -1.0, 1.0]), atol=1e-12
    )


def test_averaged_matrices_are_flat():
    middle = halfway(moved(preset("entries")))
    assert middle.volume == pytest.approx(np.cos(np.radians(85)) ** 2)
    assert middle.volume < 0.01
    assert kind_of(middle.T_world_body) is Kind.AFFINE
    assert caption_of(draw(middle)).tone == "wrong"


def test_a_screw_takes_the_origin_along_an_arc():
    states = moved(preset("screw"))
    origins = np.array([state.T_world_body[:3, 3] for state in states])
    straight = np.linspace(origins[0], origins[-1], len(origins))
    assert np.linalg.norm(origins - straight, axis=1).max() > 0.3
    aside = np.linalg.norm(origins - straight, axis=1)
    assert f"its origin {aside[15]:.3f} m from where lerp has it" in opened("screw").caption.text
    line = exp_axis(states[0], states[-1])
    from_line = np.linalg.norm(np.cross(origins - line[0], line[1]), axis=1)
    np.testing.assert_allclose(
        from_line, from_line[0]
    )  # a helix: at one distance from the line that it goes along
    assert (origins[-1] - origins[0]) @ line[1] == pytest.approx(0.3)
    for step in timeline(preset("screw")).known()[1:]:
        drawn = step.scene["axis"]
        assert isinstance(drawn, Segments)
        np.testing.assert_allclose(
            np.cross(drawn.ends[0] - line[0], line[1]), 0.0, atol=1e-9
        )  # it stays put
    lerp = np.array(
        [
            s.T_world_body[:3, 3]
            for s in moved(dataclasses.replace(preset("screw"), method="slerp + lerp"))
        ]
    )
    np.testing.assert_allclose(lerp, straight, atol=1e-12)
    steps = [b.T_world_body @ inverse(a.T_world_body) for a, b in itertools.pairwise(states)]
    np.testing.assert_allclose(
        steps, np.broadcast_to(steps[0], (len(steps), 4, 4)), atol=1e-12
    )  # one screw all along


def test_areas_and_volumes_are_said_as_factors():
    """A volume of "40 %" was meant as changed by that, where the captions mean left over."""
    rows = {row[0]: row[1:] for row in survives(Params(), 1)}
    assert rows["volume"] == ("× 1.40", "× 1.40")
    assert rows["area"][0] == "× 1.28"
    assert rows["edge lengths"][0] == "by up to 40 %"
    middle = {row[0]: row[1:] for row in survives(ENTRIES, 15)}
    assert middle["volume"] == ("× 0.0076",)
    assert "the volume is 0.76 % of the start's" in timeline(ENTRIES)[15].caption.text


def survives(params: Params, k: int):
    tables = [one for one in timeline(params)[k].scene.values() if isinstance(one, Table)]
    return next(table.rows for table in tables if table.title == "What survives")


@pytest.mark.parametrize(
    "params", [Params(), *(p.params for p in lesson.presets if p.params.half == "build a map")]
)
def test_the_last_step_says_what_is_not_taken_back(params):
    """All vertices were called back in green above a house 1.4 times as high as the first."""
    last = timeline(params)[-1]
    first, now = (step.state for step in (timeline(params)[0], last))
    lies = np.allclose(now.T, np.eye(4)) and np.allclose(first.T, np.eye(4))
    assert lies == ("came before it and stay" not in last.caption.text)
    if last.caption.tone == "good":
        assert lies


def test_known_wrong_answers_are_answered_and_not_right():
    asked = {question.name: question for question in lesson.questions}
    right = {
        name: question.answer(timeline(question.params).states())
        for name, question in asked.items()
    }
    for name, given in (
        ("which-order", (0.0, 1.5, 3.0)),
        ("mean-heading", (0.0, 20.0, 170.0)),
        ("mean-matrix", (8.7, 50.0, 100.0)),
    ):
        for number in given:
            assert asked[name].reply(number), (name, number)
            assert abs(number - right[name]) > asked[name].tolerance
    for question in lesson.questions:
        for i, choice in enumerate(question.choices):
            assert bool(question.reply(i)) == (i != right[question.name]), choice


def test_all_ways_survive_half_a_turn():
    for method in get_args(Method):
        params = dataclasses.replace(
            MOVE, angles=(0.0, 0.0, 0.0), angles_end=(180.0, 0.0, 0.0), method=method
        )
        assert moved(params)[-1].way.turned[-1] == pytest.approx(180, abs=1e-6)


# the questions, the slots, the files --------------------------------------------------------------


def test_right_answers():
    answers = {q.name: q.answer(timeline(q.params).states()) for q in lesson.questions}
    assert answers["which-order"] == pytest.approx(2.12, abs=0.01)
    assert answers["lost-direction"] == 1  # the second choice: two directions
    assert answers["sheared-volume"] == 1  # it stays
    assert answers["mean-heading"] == pytest.approx(340)
    assert answers["mean-matrix"] == pytest.approx(0.76, abs=0.01)
    for question in lesson.questions:
        assert 20 < len(question.why(timeline(question.params).states())) < 250
