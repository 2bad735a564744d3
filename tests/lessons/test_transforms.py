"""Every claim of the transforms lesson in numbers: presets, questions, scenes, and pictures."""

import itertools
from dataclasses import replace
from typing import Any, get_args, get_type_hints

import numpy as np
import pytest

from lessons.transforms.by_hand import roof
from lessons.transforms.hands import VALUES, arrived, fronts
from lessons.transforms.inputs import Input
from lessons.transforms.lesson import lesson
from lessons.transforms.presets import apart, meeting, missed
from tests.lessons.transforms_runs import of, scene, states
from tests.runs import finished
from workbench.geometry.motions import motion
from workbench.geometry.motions.affine import transform
from workbench.geometry.motions.rotations import euler_to_matrix, rotation_from_axis_angle
from workbench.run.questions import answer
from workbench.run.timeline import Timelines
from workbench.scene import Table, caption_of, is_rigid

NAME = "transforms"


def complete(params: Input) -> Any:
    return next(state for state in of(NAME, params) if state.complete)


def preset(name: str) -> Input:
    return lesson.preset(name).params


class TestFactors:
    def test_one_factor_per_step_and_the_newest_on_the_left(self):
        params = Input(mirror="y", shear=0.3, perspective=0.2, pose=(1, 1, 0, 0.2, 0, 0))
        run = of(NAME, params)
        assert [state.factor.kind for state in run] == [
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
        for before, after in itertools.pairwise(run):
            np.testing.assert_allclose(after.T, after.factor.matrix @ before.T, atol=1e-12)

    def test_turns_of_nothing_are_skipped(self):
        kinds = [state.factor.kind for state in states(NAME, "order")]
        assert kinds == ["start", "turn", "translate", "undo"]

    def test_the_default_run_is_what_its_numbers_say(self):
        state = complete(Input())
        run = states(NAME)
        R = euler_to_matrix(np.radians([30.0, 20.0, 60.0]), "xyz")
        np.testing.assert_allclose(
            state.T, motion(R @ np.diag([1, 1, 1.4]), np.array([1.6, 0.6, 0.3])), atol=1e-15
        )
        assert run[lesson.first_step] is state
        assert run[-1].left < 1e-12
        assert "1.4 times as high" in caption_of(scene(NAME, "default", -1)).text

    @pytest.mark.parametrize("order", ["xyz", "ZXZ"])
    def test_turns_about_fixed_and_carried_axes_come_step_by_step(self, order):
        run = of(NAME, Input(scale=(1, 1, 1), order=order))
        for k, state in enumerate(run[1:4]):
            angles = np.where(np.arange(3) <= k, np.radians([30.0, 20, 60]), 0.0)
            np.testing.assert_allclose(state.T[:3, :3], euler_to_matrix(angles, order), atol=1e-14)

    def test_the_handle_carries_the_body_with_it(self):
        pose = (1.0, -2.0, 0.5, 0.3, -0.4, 1.1)
        w = np.array(pose[3:])
        R = rotation_from_axis_angle(w, float(np.linalg.norm(w)))
        R = R @ euler_to_matrix(np.radians([30.0, 20.0, 60.0]), "xyz")
        state = complete(Input(scale=(1, 1, 1), pose=pose))
        np.testing.assert_allclose(state.T, motion(R, np.array(pose[:3])), atol=1e-14)

    def test_the_two_orders_end_two_metres_apart(self):
        ghost = complete(preset("order")).ghost
        assert ghost.distance == pytest.approx(1.5 * np.sqrt(2))
        swapped = replace(preset("order"), first="translate, then rotate")
        np.testing.assert_allclose(ghost.T, complete(swapped).T, atol=1e-15)

    def test_a_reflection_is_no_rotation(self):
        state = next(s for s in states(NAME, "mirror") if s.factor.kind == "mirror")
        assert np.linalg.det(state.T) == pytest.approx(-1.0)
        assert {c.name for c in state.by_factor if not c.kept} == {"orientation"}
        built = complete(preset("mirror"))
        assert is_rigid(built.ghost.T)
        assert built.ghost.distance == pytest.approx(0.913, abs=5e-4)

    def test_shear_keeps_volume_and_parallels(self):
        state = states(NAME, "shear")[1]
        kept = {change.name for change in state.by_factor if change.kept}
        assert kept == {"volume", "parallel edges", "orientation"}

    def test_a_projective_map_keeps_edges_straight_and_makes_them_meet(self):
        state = states(NAME, "perspective")[1]
        p = transform(state.T, of(NAME, preset("perspective")).subject.solid.p)
        meet = np.array([0.0, 0.0, 2.0])
        np.testing.assert_allclose(np.cross(meet - p[:4], p[4:] - p[:4]), 0.0, atol=1e-12)

    def test_the_wrong_inverse_misses_by_more_than_the_translation(self):
        state = states(NAME, "inverse")[-1]
        assert state.left < 1e-12
        assert state.ghost.distance == pytest.approx(1.97, abs=5e-3)
        assert state.ghost.distance > np.linalg.norm(preset("inverse").pose[:3])

    def test_a_hidden_scale_grows_squared(self):
        ghost = states(NAME, "hidden-scale")[-1].ghost
        np.testing.assert_allclose(ghost.T[:3, :3], 1.69 * np.eye(3), atol=1e-12)
        assert caption_of(scene(NAME, "hidden-scale", -1)).tone == "info"  # it is meant to be

    def test_a_direction_with_w_1_picks_up_the_translation(self):
        shown = scene(NAME, "direction", -2)
        v, w = (np.diff(shown[path].ends[0], axis=0)[0] for path in ("front", "wrong front"))
        np.testing.assert_allclose(w - v, 0.5 * np.array([1.6, 0.6, 0.3]), atol=1e-14)

    @pytest.mark.parametrize("compare", get_args(get_type_hints(Input)["compare"]))
    def test_every_comparison_draws_what_it_says(self, compare):
        run = of(NAME, Input(compare=compare))
        has_ghost = compare not in ("nothing", "direction with w = 1")
        assert any(state.ghost is not None for state in run) == has_ghost

    def test_areas_and_volumes_are_said_as_factors(self):
        table = scene(NAME, "default", 1)["measured"]
        assert isinstance(table, Table)
        rows = {row[0]: row[1:] for row in table.rows}
        assert rows["volume"] == ("× 1.40", "× 1.40")
        assert rows["area"][0] == "× 1.28"

    def test_nothing_to_blame_is_not_blamed(self):
        still = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
        for compare in ("undo by (Rᵀ, −t)", "undo all as if rigid"):
            ghost = of(NAME, Input(scale=(1, 1, 1), pose=still, compare=compare))[-1].ghost
            assert ghost.same
            assert ghost.color == "truth"


class TestHands:
    def test_the_arrows_to_the_front_stand_outside_of_the_house(self):
        for k in (0, 20, 40):
            shown = scene(NAME, "shifting", k)
            tail, tip = shown["front"].ends[0]
            other = shown["wrong front"].ends[0]
            low = shown["body"].p[:, 1].min() + shown["body"].T_world_object[1, 3]
            np.testing.assert_allclose([tail[1], other[0, 1]], low)
            assert tip[1] < low - 1.0
            assert other[1, 1] < low

    def test_of_the_arrows_the_caption_names_those_that_move(self):
        read = next(q for q in lesson.questions if q.name == "read-columns").params
        text = finished(NAME, read)[-1].caption.text
        assert text == "x goes to (0.00, 1.00, 0.00), and y to (−1.00, 0.00, 0.00)."
        assert "z leans by 90°" in caption_of(scene(NAME, "columns", -1)).text

    def test_the_question_takes_back_the_same_motion_as_the_hand(self):
        run = states(NAME, "there")
        undoing = states(NAME, "undoing")[30]
        np.testing.assert_allclose(run[-1].ghost.T, undoing.T_other, atol=1e-12)
        assert run[2].ghost is None

    @pytest.mark.parametrize("stage", VALUES)
    def test_every_value_is_a_step_and_its_own_place_on_the_chart(self, stage):
        name = {"columns": "columns", "order": "orders", "undo": "undoing", "shear": "shearing"}
        name |= {"shift": "shifting", "divide": "dividing"}
        run = states(NAME, name[stage])
        assert [state.value for state in run] == pytest.approx(list(VALUES[stage]))
        for k in (1, len(run) // 2, len(run) - 1):
            shown = scene(NAME, name[stage], k)
            for mark in (
                primitive
                for primitive in shown.values()
                if getattr(primitive, "part", "") == "mark"
            ):
                wholes = [
                    primitive
                    for primitive in shown.values()
                    if getattr(primitive, "part", "") == "whole" and primitive.chart == mark.chart
                ]
                gaps = [abs(np.interp(mark.x[0], whole.x, whole.y) - mark.y[0]) for whole in wholes]
                assert min(gaps) < 1e-9

    def test_the_recipe_of_a_vertex_follows_the_arrows(self):
        for k in (0, 20, 40):
            shown = scene(NAME, "columns", k)
            T = shown["body"].T_world_object
            p = shown["body"].p[8]
            np.testing.assert_allclose(p, [0.15, -0.35, 1.0])
            np.testing.assert_allclose(shown["z part"].ends[-1, 1], transform(T, p[None])[0])
        assert scene(NAME, "columns", 20)["lean"].value == pytest.approx(45.0)
        assert scene(NAME, "columns", 40)["det"].value == pytest.approx(0.0, abs=1e-12)

    def test_an_arrow_turns_evenly_and_an_opposite_one_goes_straight(self):
        x = np.array([1.0, 0.0, 0.0])
        np.testing.assert_allclose(
            arrived(x, np.array([0.0, 3.0, 0.0]), 0.5), np.sqrt(2.0) * np.array([1.0, 1.0, 0.0])
        )
        np.testing.assert_allclose(arrived(x, -x, 0.25), 0.5 * x)
        np.testing.assert_allclose(arrived(x, np.zeros(3), 1.0), 0.0)

    @pytest.mark.parametrize(
        ("angle", "metres"), [(0, 0.0), (30, 0.78), (60, 1.5), (90, 2.12), (180, 3.0)]
    )
    def test_the_orders_are_twice_the_radius_times_the_sine_of_half_the_angle(self, angle, metres):
        state = states(NAME, "orders")[angle // 3]
        gap = np.linalg.norm(state.T[:3, 3] - state.T_other[:3, 3])
        assert gap == pytest.approx(metres, abs=5e-3)
        np.testing.assert_allclose(state.T[:3, :3], state.T_other[:3, :3], atol=1e-15)

    @pytest.mark.parametrize(("angle", "metres"), [(30, 0.72), (60, 1.39), (90, 1.97), (180, 2.79)])
    def test_the_wrong_way_back_misses(self, angle, metres):
        state = states(NAME, "undoing")[angle // 3]
        assert np.linalg.norm(state.T_other[:3, 3]) == pytest.approx(metres, abs=5e-3)
        np.testing.assert_allclose(state.T, np.eye(4), atol=1e-12)

    @pytest.mark.parametrize(
        ("shear", "changes"),
        [(0.4, (21.8, 1.08, 1.18)), (0.8, (38.7, 1.28, 1.38)), (1.2, (50.2, 1.56, 1.57))],
    )
    def test_a_shear_bends_and_stretches(self, shear, changes):
        bend, upright, slope = changes
        shown = scene(NAME, "shearing", round(shear / 0.05) + 30)
        assert 90 - shown["corner angle"].value == pytest.approx(bend, abs=0.05)
        assert shown["upright"].value == pytest.approx(upright, abs=5e-3)
        assert roof(np.array(shear)) == pytest.approx(slope, abs=6e-3)
        assert shown["det"].value == pytest.approx(1.0)
        lengths = shown["edges"].color.values
        assert lengths.max() >= max(upright, slope) - 6e-3

    def test_the_slope_of_the_roof_is_that_of_the_house(self):
        p = states(NAME, "shearing").subject.solid.p
        slope = p[8] - p[4]
        sheared = slope + np.array([0.8 * slope[2], 0.0, 0.0])
        ratio = np.linalg.norm(sheared) / np.linalg.norm(slope)
        assert roof(np.array(0.8)) == pytest.approx(float(ratio))

    @pytest.mark.parametrize(("k", "degrees"), [(0, 0), (10, 26), (20, 49), (40, 76)])
    def test_the_front_with_w_1_errs_the_more_the_farther(self, k, degrees):
        right, taken = fronts(states(NAME, "shifting")[k].T)
        np.testing.assert_allclose(right, [0.0, -1.0, 0.0])
        assert scene(NAME, "shifting", k)["error"].value == pytest.approx(degrees, abs=0.5)
        assert np.linalg.norm(taken) > 0

    @pytest.mark.parametrize(("s", "metres", "apart"), [(0.2, 5, 13.9), (0.5, 2, 33.9)])
    def test_the_upright_edges_meet(self, s, metres, apart):
        shown = scene(NAME, "dividing", round(s / 0.02))
        assert shown["height"].value == pytest.approx(metres)
        assert shown["apart"].value == pytest.approx(apart, abs=0.05)


class TestQuestions:
    def test_right_answers(self):
        timelines = Timelines()
        answers = {q.name: answer(lesson, q, None, timelines=timelines) for q in lesson.questions}
        assert answers["read-columns"].truth == "It turns by 90° about z"
        assert answers["which-order"].value == pytest.approx(2.12, abs=0.01)
        assert answers["undo"].truth == "Unturned, somewhere else"
        assert answers["sheared-volume"].truth == "It stays"
        assert answers["apex"].truth == "2 m"

    def test_each_reads_the_run_and_not_the_page(self):
        assert apart(states(NAME, "orders")) == pytest.approx(1.5 * np.sqrt(2.0))
        assert missed(states(NAME, "there")) == pytest.approx(np.hypot(1.3, 0.5) * np.sqrt(2.0))
        assert meeting(states(NAME, "dividing")) == pytest.approx(2.0)

    def test_known_wrong_answers_are_answered_and_not_right(self):
        for question in lesson.questions:
            right = question.answer(of(NAME, question.params))
            for i in range(len(question.choices)):
                assert bool(question.reply(i)) is (i != right)
            for low, high, _ in question.wrong:
                assert not low <= right + question.tolerance <= high
                assert not low <= right - question.tolerance <= high
