"""The alignment lesson: every preset's claim in its own run, questions, pictures, and students'
functions in it.
"""

from collections.abc import Mapping
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest

from lessons.alignment.axes import many_turns, signed_axes
from lessons.alignment.lesson import lesson, run
from lessons.alignment.scans import scans_of
from lessons.alignment.state import Params, State, Turns
from tests.runs import finished
from tests.truths.alignment import eigenvectors, many, turn_left
from workbench.data.shapes.clouds import box_surface
from workbench.geometry.motions.principal_axes import (
    canonical_signs,
    degrees_between_axes,
    largest_entry_signs,
    principal_axes,
)

HOME = Params()


def states(params: Params) -> Any:
    return finished(lesson.name, params).states()


def preset(name: str) -> Any:
    return states(lesson.preset(name).params)


def scene(params: Params, k: int) -> Mapping[str, Any]:
    return finished(lesson.name, params)[k].scene


def caption(params: Params, k: int) -> str:
    return finished(lesson.name, params)[k].caption.text


def pose(name: str) -> tuple[Any, State]:
    state = next(state for state in preset(name) if state.moment == "pose")
    return state.outcome, state


def turns(name: str) -> Turns:
    return preset(name)[-1].turns


def made(params: Params, **slots: Any) -> list[Any]:
    """The steps of a run with functions of one's own, or of one that no other test looks at."""
    return list(run(params, **slots))


@cache
def turns_of(params: Params) -> Turns:
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
        across = np.abs(eigenvectors(rotated[-1].scans.p_source).T @ rotated[-1].jacobi.V)
        np.testing.assert_allclose(np.sort(across, axis=0)[2], 1.0, atol=1e-9)

    def test_power_iteration_takes_four_times_as_many(self):
        C, v, count = np.cov(preset("home")[0].scans.p_source.T), np.ones(3) / np.sqrt(3), 0
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
        assert turn_left(state) < 1e-6
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
            found = [
                turns_of(Params(shape="box", fresh=True, side=side, seed=seed)).axes[:, 0]
                for seed in range(3)
            ]
            return float(np.median(np.concatenate(found)))

        at = {side: median(side) for side in (0.6, 0.9, 0.99, 1.0)}
        assert at[0.6] < 3 < at[0.9] < 12 < 25 < at[0.99]
        assert at[1.0] > 30
        assert pose("nearly")[0].axes[0] > 30

    def test_the_box_of_a_cube(self):
        assert pose("cube")[1].box == pytest.approx(3.68, abs=0.05)
        found = []
        for seed in range(100):
            p = box_surface(1500, (1.0, 1.0, 1.0), np.random.default_rng(seed))
            found.append(np.prod(np.ptp(p @ principal_axes(p), axis=0)))
        assert 3.2 < np.median(found) < 3.9
        assert max(found) < 3 * np.sqrt(3)  # a cube in its most unlucky box

    def test_density_moves_the_axes_of_a_rabbit_that_stays(self):
        outcome, state = pose("density")
        np.testing.assert_allclose(outcome.axes, [6.3, 6.4, 1.4], atol=0.1)
        assert outcome.rotation > 170  # and the moment of axis 1 lost its sign
        more = len(state.scans.p_source) / len(state.scans.p_target)
        assert 1.2 < more < 1.6

    def test_a_part_has_its_own_frame(self):
        outcome, state = pose("part")
        assert outcome.rotation == pytest.approx(14.4, abs=0.2)
        assert len(state.scans.p_source) == 1200

    def test_one_stray_point(self):
        near, far = pose("stray")[0], pose("far")[0]
        assert near.axes.max() < 2.5
        assert near.rotation > 170
        assert far.axes[0] == pytest.approx(41.3, abs=0.5)
        assert len(preset("stray")[0].scans.p_source) == 1501


class TestQuestions:
    def test_their_answers(self):
        answers = {q.name: q.answer(states(q.params)) for q in lesson.questions}
        assert answers["predict-rotations"] == 8
        assert answers["predict-frames"] == 4
        assert 17 < answers["predict-signs"] < 33

    def test_known_wrong_answers_are_answered_and_not_right(self):
        asked = {q.name: q for q in lesson.questions}
        for name, wrong in (
            ("predict-rotations", (3, 20)),
            ("predict-frames", (1, 2, 8)),
            ("predict-signs", (0, 50, 100)),
        ):
            right = asked[name].answer(states(asked[name].params))
            for given in wrong:
                assert asked[name].reply(given), (name, given)
                assert abs(given - right) > asked[name].tolerance

    def test_the_many_turns_are_what_their_picture_shows(self):
        for name in ("signs", "vase"):
            state = preset(name)[-1]
            np.testing.assert_allclose(many(state), state.turns.degrees, atol=1e-4)
            shown = scene(lesson.preset(name).params, -1)["tips"]
            np.testing.assert_array_equal(shown.color.ids[::2] == 0, state.turns.degrees < 10)


class TestPicture:
    def test_a_moving_scan_is_a_pose_and_the_same_arrays_stay_under_other_signs(self):
        last = len(states(HOME)) - 1
        for name in ("target", "source"):
            assert len({id(scene(HOME, k)[name].p) for k in range(last)}) == 1
        assert scene(replace(HOME, signs="none"), 0)["source"].p is scene(HOME, 0)["source"].p
        T = scene(HOME, last)["source"].T_world_object
        p = scene(HOME, last)["source"].p @ T[:3, :3].T + T[:3, 3]
        shown = scene(HOME, last)["target"]
        np.testing.assert_allclose(p, shown.p + shown.T_world_object[:3, 3], atol=1e-9)

    def test_an_axis_is_a_line_until_it_has_a_sign(self):
        k = next(k for k, state in enumerate(states(HOME)) if state.moment == "order")
        assert len(scene(HOME, k)["frame/1"].ends) == 1
        assert len(scene(HOME, k + 1)["frame/1"].ends) == 3
        line, arrow = scene(HOME, k)["frame/1"].ends[0], scene(HOME, k + 1)["frame/1"].ends[0]
        np.testing.assert_allclose(line.mean(axis=0), arrow[0], atol=1e-12)

    def test_the_ellipsoid_is_two_standard_deviations_large(self):
        state, shown = states(HOME)[2], scene(HOME, 2)["ellipsoid"]
        off = shown.p - state.p_centre
        C = np.cov(state.scans.p_source.T, bias=True)
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
        shown, state = scene(params, -2), states(params)[-2]
        ends = shown["missed"].ends
        T = state.scans.T_world_target
        p = state.scans.p_source[:: -(-len(state.scans.p_source) // 40)]
        true = p @ state.scans.T_target_source[:3, :3].T + T[:3, 3]
        np.testing.assert_allclose(ends[:, 1], true, atol=1e-9)
        assert "missed" not in scene(HOME, -2)

    def test_captions_carry_their_numbers(self):
        assert "34.4° in its y-z plane" in caption(HOME, 3)
        assert "as a share of the norm: 31 % → 15 %" in caption(HOME, 3)
        C = np.cov(states(HOME)[2].scans.p_source.T, bias=True)
        share = np.linalg.norm(C - np.diag(np.diag(C))) / np.linalg.norm(
            C
        )  # of the sums of squares it is 10 %
        assert f"off the diagonal is {100 * share:.0f} % of the norm of all" in caption(HOME, 2)
        assert round(100 * share**2) == 10
        assert "nothing but rounding" in caption(HOME, 10)

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
        np.testing.assert_allclose(mine[-1].axes, signed_axes(states(HOME)[-1])[0], atol=1e-9)

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
        R = state.scans.T_target_source[:3, :3]
        axes, axes_target = signed_axes(state)
        assert degrees_between_axes(R @ axes, axes_target).max() < 1e-6
