"""Every claim of the rotations lesson in numbers: presets, questions, slots, and pictures."""

import itertools
from dataclasses import replace
from typing import Any, get_args

import numpy as np
import pytest

from lessons.rotations.drawing import steps_of
from lessons.rotations.inputs import Input, Method, setup
from lessons.rotations.lesson import lesson
from lessons.rotations.names import axles, knob_degrees, whole_turn
from lessons.rotations.presets import LOCKED
from lessons.rotations.questions import jump_out_of_lock
from tests.lessons.transforms_runs import of, scene, states
from workbench.geometry.motions import exp_so3, inverse, motion, rotation_angle
from workbench.geometry.motions.alignment import degrees_between
from workbench.geometry.motions.rotations import euler_to_matrix, rotation_from_axis_angle
from workbench.lesson import Look
from workbench.run.questions import answer
from workbench.run.timeline import Timeline, Timelines
from workbench.scene import caption_of, is_rigid

NAME = "rotations"
MOVE = Input()


class TestRings:
    @pytest.mark.parametrize(("pitch", "apart"), [(30, 60), (80, 10), (90, 0), (-90, 0), (0, 90)])
    def test_the_outer_and_the_inner_axle_come_together(self, pitch, apart):
        shown = scene(NAME, "gimbal", (pitch + 90) // 2)
        assert shown["pitch"].value == pitch
        assert shown["apart"].value == pytest.approx(apart, abs=1e-6)

    @pytest.mark.parametrize(("pitch", "degrees"), [(0, 1), (60, 2.73), (80, 8.1), (89, 81)])
    def test_the_knobs_turn_far_in_the_worst_direction(self, pitch, degrees):
        change = knob_degrees(axles(lesson.preset("gimbal").params, pitch))
        assert change == pytest.approx(degrees, rel=0.01)
        sine = abs(np.sin(np.radians(pitch)))
        assert change == pytest.approx(1 / np.sqrt(1 - sine))
        assert np.isinf(knob_degrees(axles(lesson.preset("gimbal").params, 90.0)))

    def test_in_gimbal_lock_no_angle_is_enough(self):
        for k in (45, 89, 90):
            shown = scene(NAME, "gimbal", k)
            assert ("knob/mark" in shown) == ("knob/second" not in shown) == (k != 90)
        for k in (0, 90):
            rims = scene(NAME, "gimbal", k)["knob/second"].x
            assert set(rims.tolist()) == {-90.0, 90.0}

    def test_each_ring_holds_its_own_axle_and_the_next(self):
        for k in (0, 20, 45, 70, 90):
            shown = scene(NAME, "gimbal", k)
            for ring, own, carried in (
                ("outer", "outer", "middle"),
                ("middle", "middle", "inner"),
                ("inner", "inner", "inner"),
            ):
                corners = shown[f"{ring} ring"].ends[:, 0]
                normal = np.cross(corners[0], corners[20])
                for axle in (own, carried):
                    line = shown[f"{axle} axle"].ends[0]
                    assert line[0] @ normal == pytest.approx(0.0, abs=1e-9)

    def test_two_rings_fall_into_one_plane_at_the_end_and_only_there(self):
        normals = []
        for k in (45, 90):
            rings = [
                scene(NAME, "gimbal", k)[f"{ring} ring"].ends[:, 0] for ring in ("outer", "middle")
            ]
            planes = [np.cross(ring[0], ring[20]) for ring in rings]
            planes = [v / np.linalg.norm(v) for v in planes]
            normals.append(abs(planes[0] @ planes[1]))
        assert normals[0] == pytest.approx(0.0, abs=1e-9)
        assert normals[1] == pytest.approx(1.0)

    def test_no_ring_turns_the_house_about_the_dashed_line(self):
        shown = scene(NAME, "gimbal", -1)
        dead = np.ptp(shown["dead"].ends.reshape(-1, 3), axis=0)
        axes = axles(lesson.preset("gimbal").params, 90.0)
        along = shown["dead"].ends[0, 1] - shown["dead"].ends[0, 0]
        np.testing.assert_allclose(axes @ along, 0.0, atol=1e-9)
        assert np.linalg.norm(dead) > 2

    def test_the_house_hangs_in_the_rings_as_its_angles_say(self):
        shown = scene(NAME, "gimbal", 60)
        state = states(NAME, "gimbal")[60]
        R = euler_to_matrix(np.radians([30.0, 30.0, 50.0]), "xyz")
        np.testing.assert_allclose(state.R, R, atol=1e-14)
        T = shown["body"].T_world_object
        np.testing.assert_allclose(T[:3, :3], 0.5 * R, atol=1e-14)

    def test_no_pose_is_lost(self):
        family = states(NAME, "family")
        assert len(family) == 4
        assert max(state.off for state in family) < 1e-6
        assert family[1].name == "(70, 90, 90)°"
        assert jump_out_of_lock() == "(120, 89, 140)°"
        R, R_jump = (
            euler_to_matrix(np.radians(angles), "xyz") for angles in (LOCKED, (120.0, 89.0, 140.0))
        )
        assert np.degrees(rotation_angle(R_jump @ R.T)) == pytest.approx(1.0)


class TestReadings:
    def test_how_far_each_reading_is_off(self):
        off = {
            name: [state.off for state in states(NAME, name)[1:]]
            for name in ("conventions", "fixed-own", "transpose", "xyzw")
        }
        assert off["conventions"] == pytest.approx([0, 58.2, 51.8, 73.5], abs=0.05)
        assert off["fixed-own"] == pytest.approx([0, 58.2, 51.8], abs=0.05)
        assert off["transpose"] == pytest.approx([80])
        R = states(NAME, "xyzw")[1].R
        w = np.degrees(rotation_angle(R))
        assert w == pytest.approx(140.0)
        assert abs(R[0, 0]) == pytest.approx(1.0, abs=0.01), "about x, but for a little"

    def test_the_arc_turns_the_house_into_the_outline(self):
        shown = scene(NAME, "conventions", 2)
        meant, read = (shown[path].T_world_object for path in ("body", "ghost"))
        assert degrees_between(meant, read) == pytest.approx(58.2, abs=0.05)
        assert shown["turn/words"].text == "58.2°"
        assert shown["ghost"].color == "wrong"
        assert scene(NAME, "conventions", 1)["ghost"].color == "truth"

    def test_the_house_carries_the_thick_axes_and_the_thin_ones_stay(self):
        shown = scene(NAME, "conventions", 2)
        R = shown["body"].T_world_object[:3, :3]
        for path, letters, columns in (("fixed", "xyz", np.eye(3)), ("carried", "XYZ", R)):
            tips = [shown[f"{path}/{letter}"].ends[0, 1] for letter in letters]
            units = [tip / np.linalg.norm(tip) for tip in tips]
            np.testing.assert_allclose(units, columns.T, atol=1e-12)
        assert shown["carried/X"].width > 2 * shown["fixed/x"].width

    def test_the_three_rings_hold_the_pose_that_was_meant(self):
        ringed = states(NAME, "three-rings")[60]
        np.testing.assert_allclose(ringed.R, states(NAME, "fixed-own")[0].R, atol=1e-12)


class TestChain:
    def test_two_quarter_turns_are_a_third(self):
        axis, angle = whole_turn(lesson.preset("chain").params)
        np.testing.assert_allclose(axis, np.ones(3) / np.sqrt(3.0), atol=1e-12)
        assert np.degrees(angle) == pytest.approx(120.0)
        last = states(NAME, "chain")[-1]
        np.testing.assert_allclose(
            last.R, euler_to_matrix(np.radians([90.0, 0.0, 90.0]), "xyz"), atol=1e-12
        )

    def test_three_arrows_lead_to_the_vertex(self):
        for k in (0, 30, 60):
            shown = scene(NAME, "chain", k)
            R = states(NAME, "chain")[k].R
            p = shown["body"].p[8]
            np.testing.assert_allclose(shown["terms/3"].ends[0, 1], R @ p, atol=1e-12)
            for term, other in itertools.pairwise(range(1, 4)):
                before = shown[f"terms/{term}"].ends[0, 1]
                after = shown[f"terms/{other}"].ends[0, 0]
                np.testing.assert_allclose(before, after)

    @pytest.mark.parametrize("order", ["xyz", "ZXZ", "yzx"])
    def test_the_grey_arcs_are_the_turns_one_by_one(self, order):
        params = Input(stage="chain", order=order)
        R = np.eye(3)
        for about, angle in steps_of(params):
            R = exp_so3(np.radians(angle) * about) @ R
        np.testing.assert_allclose(R, euler_to_matrix(np.radians(params.angles), order), atol=1e-12)

    def test_small_turns_nearly_add_as_arrows(self):
        small = whole_turn(Input(angles=(30.0, 0.0, 30.0)))[1]
        assert np.degrees(small) == pytest.approx(42.2, abs=0.05)


class TestNames:
    def test_q_and_minus_q_stand_on_opposite_sides(self):
        shown = scene(NAME, "halves", 12)
        middle = np.array([-1.35, 0.0, 0.55])
        q = shown["hands"].ends[1, 1] - middle
        far = shown["hands"].ends[2, 1] - middle
        np.testing.assert_allclose(q, -far, atol=1e-12)
        assert np.degrees(np.arctan2(q[2], q[0])) == pytest.approx(30.0)
        assert shown["far/dial/words"].text == "150°"
        assert shown["far/house/words"].text == "300°"

    def test_at_half_a_turn_both_ways_are_equally_long(self):
        shown = scene(NAME, "halves", 36)
        for which in ("dial", "house"):
            assert shown[f"far/{which}/words"].text == shown[f"near/{which}/words"].text

    def test_minus_q_goes_the_long_way_to_the_same_end(self):
        last = states(NAME, "minus-q")[-1]
        assert last.shortest.turned[-1] == pytest.approx(60)
        assert last.way.turned[-1] == pytest.approx(300)
        np.testing.assert_allclose(last.T_world_body, last.T_world_end, atol=1e-12)


class TestPoses:
    @pytest.mark.parametrize("method", get_args(Method))
    def test_every_way_starts_and_ends_at_the_poses(self, method):
        run = of(NAME, replace(MOVE, method=method, pose=(1.0, 0.5, 0.2, 0.3, -0.2, 0.9)))
        assert len(run) == MOVE.steps + 1
        np.testing.assert_allclose(run[0].T_world_body, run[0].T_world_start, atol=1e-12)
        np.testing.assert_allclose(run[-1].T_world_body, run[-1].T_world_end, atol=1e-12)
        assert all(is_rigid(s.T_world_body) == (method != "matrix entries") for s in run[1:-1])

    def test_the_handle_carries_the_end_pose(self):
        pose = (1.0, 0.5, 0.2, 0.3, -0.2, 0.9)
        w = np.array(pose[3:])
        R = rotation_from_axis_angle(w, float(np.linalg.norm(w)))
        R = R @ euler_to_matrix(np.radians(MOVE.angles_end), "xyz")
        state = of(NAME, replace(MOVE, pose=pose))[0]
        np.testing.assert_allclose(state.T_world_end, motion(R, np.array(pose[:3])), atol=1e-14)

    def test_slerp_is_the_shortest_turn_at_constant_speed(self):
        run = of(NAME, MOVE)
        assert max(state.off for state in run) < 1e-6
        assert np.ptp(np.diff(run[-1].way.turned)) < 1e-9
        total = rotation_angle(run[0].T_world_start[:3, :3].T @ run[0].T_world_end[:3, :3])
        assert run[-1].way.turned[-1] == pytest.approx(np.degrees(total))
        for method in get_args(Method):
            whole = of(NAME, replace(MOVE, method=method))[-1].way.turned[-1]
            assert whole >= np.degrees(total) - 1e-6

    def test_euler_angles_wobble(self):
        run = states(NAME, "wobble")
        speed = np.diff(run[-1].way.turned)
        assert speed.max() / speed.min() > 1.5
        assert run[-1].way.turned[-1] == pytest.approx(192.7, abs=0.05)
        assert run[-1].shortest.turned[-1] == pytest.approx(139.1, abs=0.05)
        assert run[15].off == pytest.approx(62, abs=1)

    def test_the_vertex_stays_on_its_globe(self):
        shown = scene(NAME, "wobble", -1)
        radius = np.linalg.norm(shown["globe"].ends[:40], axis=2)
        path = np.linalg.norm(shown["path"].ends, axis=2)
        np.testing.assert_allclose(path, radius.max(), atol=1e-9)
        assert "globe" not in scene(NAME, "screw", -1)

    def test_the_mean_of_170_and_minus_170(self):
        run = states(NAME, "average")
        assert run[-1].way.turned[-1] == pytest.approx(340)
        assert run[-1].shortest.turned[-1] == pytest.approx(20)
        np.testing.assert_allclose(run[15].T_world_body[:3, :3], np.eye(3), atol=1e-12)

    def test_a_screw_takes_the_origin_along_an_arc(self):
        run = states(NAME, "screw")
        origins = np.array([state.T_world_body[:3, 3] for state in run])
        straight = np.linspace(origins[0], origins[-1], len(origins))
        assert np.linalg.norm(origins - straight, axis=1).max() > 0.3
        steps = [b.T_world_body @ inverse(a.T_world_body) for a, b in itertools.pairwise(run)]
        # one screw all along
        np.testing.assert_allclose(steps, np.broadcast_to(steps[0], (len(steps), 4, 4)), atol=1e-12)
        drawn = [scene(NAME, "screw", k)["axis"].ends[0] for k in range(1, 31)]
        along = drawn[0][1] - drawn[0][0]
        for line in drawn:
            np.testing.assert_allclose(np.cross(line - drawn[0][0], along), 0.0, atol=1e-9)

    def test_a_blend_that_was_no_rotation_does_not_end_well(self):
        step = Timeline(lesson, lesson.preset("entries").params).complete()
        assert step[-1].caption.tone == "info"
        assert step[-1].caption.values["lowest"] == pytest.approx(np.cos(np.radians(85)) ** 2)
        assert Timeline(lesson, MOVE).complete()[-1].caption.tone == "good"

    def test_all_ways_survive_half_a_turn(self):
        for method in get_args(Method):
            params = Input(angles=(0.0, 0.0, 0.0), angles_end=(180.0, 0.0, 0.0), method=method)
            assert of(NAME, params)[-1].way.turned[-1] == pytest.approx(180, abs=1e-6)


class TestMean:
    @pytest.mark.parametrize(
        ("apart", "left"), [(20, 97), (60, 75), (90, 50), (120, 25), (170, 0.76), (180, 0)]
    )
    def test_the_volume_falls_to_the_square_of_a_cosine(self, apart, left):
        shown = scene(NAME, "means", apart // 5)
        assert shown["volume"].value == pytest.approx(left, abs=0.05)
        assert shown["left mark"].y[0] == pytest.approx(shown["volume"].value)

    def test_the_mean_lies_in_the_middle_of_the_chord(self):
        shown = scene(NAME, "means", 24)
        state = states(NAME, "means")[24]
        p = shown["body"].p[8]
        np.testing.assert_allclose(state.R @ p, shown["chord"].ends[0].mean(axis=0), atol=1e-12)


class TestQuestions:
    def test_right_answers(self):
        timelines = Timelines()
        answers = {q.name: answer(lesson, q, None, timelines=timelines) for q in lesson.questions}
        assert answers["lost-direction"].truth == "2"
        assert answers["same-turn"].truth == "Z Y X with (70, 30, 40)°"
        assert answers["sum-of-turns"].value == pytest.approx(120)
        assert answers["long-way"].value == pytest.approx(300)
        assert answers["mean-heading"].value == pytest.approx(340)
        assert answers["mean-matrix"].value == pytest.approx(0.76, abs=0.01)

    def test_known_wrong_answers_are_answered_and_not_right(self):
        for question in lesson.questions:
            right = question.answer(of(NAME, question.params))
            for i in range(len(question.choices)):
                assert bool(question.reply(i)) is (i != right)
            for low, high, _ in question.wrong:
                assert not low <= right + question.tolerance <= high
                assert not low <= right - question.tolerance <= high


def driven(params: Input, slots: Any) -> Any:
    """The states of a run that a student's functions drive."""
    return tuple(lesson.form.states(params, slots))


class TestSlots:
    def test_the_rodrigues_of_the_student_turns_the_chain_and_slerp(self):
        def backwards(axis, angle):
            return rotation_from_axis_angle(axis, -angle)

        for params in (lesson.preset("chain").params, MOVE):
            ours, theirs = (
                driven(params, slots) for slots in ({}, {"rotation_from_axis_angle": backwards})
            )
            both = [
                state.R if params.stage == "chain" else state.T_world_body[:3, :3]
                for state in (ours[15], theirs[15])
            ]
            assert np.degrees(rotation_angle(both[0].T @ both[1])) > 10
        *past, last = theirs
        look = Look(params=MOVE, subject=setup(MOVE), now=last, past=tuple(past))
        caption = caption_of(lesson.form.draw(look))
        assert caption.tone == "wrong"
        assert "The end is missed" in caption.text

    def test_the_euler_angles_of_the_student_turn_the_rings_and_the_poses(self):
        def reversed_product(angles, order):
            return euler_to_matrix(angles, order.swapcase())

        slots = {"euler_to_matrix": reversed_product}
        rings = driven(lesson.preset("gimbal").params, slots)[60]
        assert rotation_angle(rings.R.T @ states(NAME, "gimbal")[60].R) > 0.3
        params = replace(MOVE, method="Euler angles")
        ours, theirs = (driven(params, functions)[15] for functions in ({}, slots))
        assert np.abs(ours.T_world_body - theirs.T_world_body).max() > 0.1
