"""The lesson on axes: the claims of two scans in their own runs, questions, pictures, and students'
functions in it.
"""

from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest

from lessons.axes.inputs import Input
from lessons.axes.lesson import lesson
from lessons.axes.questions import fallen_most
from lessons.axes.scans import scans_of
from lessons.axes.space import Turns, many_turns
from tests.lessons.axes_runs import HOME, made, preset, scene, states, subject, turns
from tests.runs import finished
from tests.truths.axes import eigenvectors, many, turn_left
from workbench.certain import sure
from workbench.data.shapes.clouds import box_surface
from workbench.geometry.motions.principal_axes import (
    canonical_signs,
    degrees_between_axes,
    largest_entry_signs,
    principal_axes,
)
from workbench.lesson import Choice


def caption(params: Input, k: int) -> str:
    return finished(lesson.name, params)[k].caption.text


def pose(name: str) -> tuple[Any, Any]:
    state = next(state for state in preset(name) if state.moment == "pose")
    return state.outcome, state


@cache
def turns_of(params: Input) -> Turns:
    """The many turns alone."""
    scans = scans_of(params)
    return many_turns(
        params, scans, canonical_signs(principal_axes(scans.p_target), scans.p_target)
    )


class TestAxes:
    def test_a_handful_of_plane_turns_finds_the_axes(self):
        rotated = [state for state in preset("home") if state.moment in ("covariance", "rotation")]
        off = [state.jacobi.off for state in rotated]
        np.testing.assert_allclose(off[:6], [0.31, 0.15, 0.10, 0.039, 0.0042, 0.00029], rtol=0.05)
        assert len(off) == 9
        assert off[6] < 1e-5
        assert off[-1] < 1e-12
        errors = [scene(HOME, 2 + k)["to axes"].value for k in range(len(off))]
        assert (np.diff(errors[1:]) < 0).all()  # the truth falls with what is made small
        across = np.abs(eigenvectors(scans_of(HOME).p_source).T @ rotated[-1].jacobi.V)
        np.testing.assert_allclose(np.sort(across, axis=0)[2], 1.0, atol=1e-9)

    def test_power_iteration_takes_four_times_as_many(self):
        C = np.cov(scans_of(HOME).p_source.T)
        v = np.ones(3) / np.sqrt(3)
        count = 0
        while count < 1000:
            w = C @ v / np.linalg.norm(C @ v)
            count += 1
            if np.linalg.norm(w - v) < 1e-9:
                break
            v = w
        assert 24 < count < 45

    def test_home_is_home_after_every_turn(self):
        outcome, state = pose("home")
        assert outcome.home
        assert turn_left(scans_of(HOME), state) < 1e-6
        assert turns("home").home.all()

    @pytest.mark.parametrize("signs", ["none", "largest-entry"])
    def test_a_rule_that_looks_at_numbers_is_no_better_than_chance(self, signs):
        ended = states(replace(HOME, signs=signs))[-1].turns
        assert 0.17 < ended.home.mean() < 0.33
        assert (ended.axes < 1e-6).all()  # as lines all axes are right
        assert np.isin(ended.degrees.round(3), [0.0, 180.0]).all()

    def test_fresh_samples_have_moments_of_their_own(self):
        ended = turns("fresh")
        assert 0.85 <= ended.home.mean() <= 0.97
        assert ended.degrees[~ended.home].min() > 150
        assert (ended.axes[:, 0] < 10).all()

    def test_a_box_has_no_front(self):
        outcome, state = pose("box")
        assert outcome.rotation > 170
        assert outcome.gap < 0.03  # the points say that all is well
        assert state.box == pytest.approx(1.06, abs=0.02)
        assert 0.1 < turns("box").home.mean() < 0.35
        assert (turns("box").degrees[~turns("box").home] > 150).all()

    def test_a_vase_keeps_its_own_axis_and_no_other(self):
        ended = turns("vase")
        assert (ended.axes[:, 0] < 10).mean() > 0.97
        low, middle, high = np.percentile(ended.degrees, [25, 50, 75])
        assert 25 < low < 65 < middle < 115 < high < 150

    def test_nearly_equal_sides_leave_the_axes_to_noise(self):
        def median(side: float) -> float:
            angles = [
                turns_of(Input(shape="box", fresh=True, side=side, seed=seed)).axes[:, 0]
                for seed in range(3)
            ]
            return float(np.median(np.concatenate(angles)))

        at = {side: median(side) for side in (0.6, 0.9, 0.99, 1.0)}
        assert at[0.6] < 3 < at[0.9] < 12 < 25 < at[0.99]
        assert at[1.0] > 30
        assert pose("nearly")[0].axes[0] > 30

    def test_the_box_of_a_cube(self):
        assert pose("cube")[1].box == pytest.approx(3.68, abs=0.05)
        volumes = []
        for seed in range(100):
            p = box_surface(1500, (1.0, 1.0, 1.0), np.random.default_rng(seed))
            volumes.append(np.prod(np.ptp(p @ principal_axes(p), axis=0)))
        assert 3.2 < np.median(volumes) < 3.9
        assert max(volumes) < 3 * np.sqrt(3)  # a cube in its most unlucky box

    def test_density_moves_the_axes_of_a_rabbit_that_stays(self):
        outcome = pose("density")[0]
        np.testing.assert_allclose(outcome.axes, [6.3, 6.4, 1.4], atol=0.1)
        assert outcome.rotation > 170  # and the moment of axis 1 lost its sign
        more = len(subject("density").p_source) / len(subject("density").p_target)
        assert 1.2 < more < 1.6

    def test_a_part_has_its_own_frame(self):
        outcome = pose("part")[0]
        assert outcome.rotation == pytest.approx(14.4, abs=0.2)
        assert len(subject("part").p_source) == 1200

    def test_one_stray_point(self):
        near, far = pose("stray")[0], pose("far")[0]
        assert near.axes.max() < 2.5
        assert near.rotation > 170
        assert far.axes[0] == pytest.approx(41.3, abs=0.5)
        assert len(subject("stray").p_source) == 1501


class TestQuestions:
    def test_their_answers(self):
        answers = {q.name: q.answer(states(q.params)) for q in lesson.questions}
        assert 17 < answers.pop("predict-signs") < 33
        assert (answers["predict-rotations"], answers["predict-frames"]) == (8, 4)
        assert (answers["second"], answers["one-stray"], answers["which-wins"]) == (0, 2, 0)

    def test_the_rmse_that_fell_most_is_half_a_turn_off(self):
        race = states(lesson.preset("starts").params)
        fallen = fallen_most(race)
        assert race[-1].off[fallen] > 170
        assert race[0].rmse[fallen] > np.sort(race[0].rmse)[1]

    def test_known_wrong_answers_are_answered_and_not_right(self):
        for question in lesson.questions:
            right = question.answer(states(question.params))
            for k, choice in enumerate(question.choices):
                is_known = isinstance(choice, Choice) and bool(choice.why)
                assert is_known == (k != right), (question.name, choice)
            for low, high, words in question.wrong:
                assert words
                assert min(abs(low - right), abs(high - right)) > question.tolerance
                assert not low <= right <= high

    def test_the_first_to_be_lowest_is_not_always_home(self):
        ended = states(Input(stage="starts", fresh=True, seen=0.7, seed=4))
        assert ended[-1].off[ended[-1].winner] < 1.0
        assert int(ended[0].rmse.argmin()) != ended[-1].winner

    def test_the_many_turns_are_what_their_picture_shows(self):
        for name in ("signs", "vase"):
            state = preset(name)[-1]
            np.testing.assert_allclose(many(state), state.turns.degrees, atol=1e-4)
            shown = scene(lesson.preset(name).params, -1)["tips"]
            np.testing.assert_array_equal(shown.color.ids[::2] == 0, state.turns.degrees < 10)


class TestPicture:
    def test_a_moving_scan_is_a_pose_and_the_same_arrays_stay(self):
        shown = [scene(HOME, k) for k in range(len(states(HOME)))]
        for name in ("target", "source"):
            assert len({id(drawn[name].p) for drawn in shown if name in drawn}) == 1
        assert scene(replace(HOME, signs="none"), 0)["source"].p is shown[0]["source"].p
        T = shown[-1]["source"].T_world_object
        p = shown[-1]["source"].p @ T[:3, :3].T + T[:3, 3]
        target = shown[-1]["target"]
        np.testing.assert_allclose(p, target.p + target.T_world_object[:3, 3], atol=1e-9)

    def test_an_axis_is_a_line_until_it_has_a_sign(self):
        k = next(k for k, state in enumerate(states(HOME)) if state.moment == "order")
        line = scene(HOME, k)["frame/1"].ends
        arrow = scene(HOME, k + 1)["frame/1"].ends
        assert len(line) == 1
        assert len(arrow) == 5
        np.testing.assert_allclose(line[0].mean(axis=0), arrow[0, 0], atol=1e-12)

    def test_the_ellipsoid_is_two_standard_deviations_large(self):
        state = states(HOME)[2]
        shown = scene(HOME, 2)["ellipsoid"]
        off = shown.p - state.p_centre
        C = np.cov(scans_of(HOME).p_source.T, bias=True)
        np.testing.assert_allclose(
            np.einsum("ni,ij,nj->n", off, np.linalg.inv(C), off), 4.0, rtol=1e-6
        )

    def test_variance_by_direction_marks_its_extremum(self):
        for k in (3, 4, 5):
            curve = scene(HOME, k)["variance"]
            at = float(np.interp(curve.marks[0], curve.x, curve.y))
            near = np.abs(curve.x - curve.marks[0]) < 30
            assert at == pytest.approx(curve.y[near].max(), rel=1e-3) or at == pytest.approx(
                curve.y[near].min(), rel=1e-3
            )

    def test_what_is_wrong_points_to_where_it_belongs(self):
        params = lesson.preset("box").params
        shown = scene(params, -2)
        scans = scans_of(params)
        ends = shown["missed"].ends
        T = scans.T_world_target
        p = scans.p_source[:: -(-len(scans.p_source) // 40)]
        true = p @ sure(scans.T_target_source)[:3, :3].T + T[:3, 3]
        np.testing.assert_allclose(ends[:, 1], true, atol=1e-9)
        assert "missed" not in scene(HOME, -2)

    def test_what_is_left_is_a_ratio_of_norms(self):
        C = np.cov(scans_of(HOME).p_source.T, bias=True)
        left = np.linalg.norm(C - np.diag(np.diag(C))) / np.linalg.norm(C)
        shown_caption = finished(lesson.name, HOME)[2].caption
        assert shown_caption.values["left"] == pytest.approx(left)
        assert (round(100 * left), round(100 * left**2)) == (31, 10)
        assert "nothing but rounding" in caption(HOME, 10)

    def test_cells_are_the_covariance_in_the_frame(self):
        A = states(HOME)[4].jacobi.A
        for i in range(3):
            for j in range(3):
                words = scene(HOME, 4)[f"matrix/{i}{j}"].text.replace("−", "-")
                assert float(words) == pytest.approx(1e4 * A[i, j], abs=0.51)

    def test_the_stray_point_is_where_it_was_dragged(self):
        params = lesson.preset("stray").params
        np.testing.assert_allclose(scene(params, 0)["stray"].p[0], params.stray)
        np.testing.assert_allclose(scene(params, 0)["source"].p[-1], params.stray)


class TestSlots:
    def test_the_lesson_runs_on_ones_own_functions(self):
        def axes(p):
            return np.linalg.svd(p - p.mean(0))[2].T * [1, 1, -1] if len(p) else p

        mine = made(HOME, principal_axes=lambda p: right(axes(p)))
        assert [state.moment for state in mine] == [state.moment for state in states(HOME)[:-1]]
        assert mine[-1].outcome.home
        np.testing.assert_allclose(mine[-1].axes, states(HOME)[-1].axes, atol=1e-9)

    def test_a_sign_that_hangs_on_coordinates_lands_half_a_turn_away(self):
        mine = made(HOME, canonical_signs=lambda axes, p: largest_entry_signs(axes))
        assert mine[-1].outcome.rotation == pytest.approx(180, abs=1e-6)


def right(axes: np.ndarray) -> np.ndarray:
    return axes * [1, 1, np.sign(np.linalg.det(axes))]


def test_axes_of_both_scans_agree_up_to_their_signs_whatever_the_turn():
    for turn in (0.0, 45.0, 180.0):
        state = next(
            state for state in made(replace(HOME, turn=turn, points=300)) if state.moment == "order"
        )
        R = sure(scans_of(replace(HOME, turn=turn, points=300)).T_target_source)[:3, :3]
        assert degrees_between_axes(R @ state.axes, state.axes_target).max() < 1e-6
