"""The ICP lesson: every claim of its page, presets and questions in numbers, and what moves in the
picture.
"""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from lessons.icp.basin import ANGLES
from lessons.icp.draw import draw
from lessons.icp.lesson import lesson, run
from lessons.icp.presets import END, HOME, end, rmse_falls
from lessons.icp.state import Params, State
from tests.lessons.icp_runs import (
    caption,
    preset,
    scene,
    states,
    timeline,
    tries,
    true,
    two_scans,
    until_stop,
)
from workbench.algorithms.registration.icp import Stop, nearest
from workbench.geometry.motions import apply
from workbench.geometry.motions.alignment import align_rigid
from workbench.scene import Scalar, caption_of


@pytest.fixture
def two_files(tmp_path) -> Params:
    return two_scans(tmp_path)


class TestPresets:
    def test_home(self):
        found = preset("home")
        assert found[0].right < 0.03
        assert rmse_falls(found)
        assert rmse_falls(states(HOME))  # also when the tries follow
        assert end(found).icp.stop is Stop.CONVERGED
        assert end(found).error.rotation < 0.5
        turns = [s.turned for s in found[1:40:2]]
        assert min(turns) > 0.5  # "a degree or so"
        assert max(turns) < 2.0

    def test_far(self):
        found = preset("far")
        assert rmse_falls(found)
        assert end(found).icp.stop is Stop.CONVERGED
        assert end(found).error.rotation > 150
        assert caption_of(draw(found[-1])).tone == "wrong"
        assert caption(lesson.preset("far").params, END).tone == "info"  # it is meant to be wrong
        assert caption(Params(start_angle=121.0), END).tone == "wrong"

    def test_the_sweep_has_starts_from_which_it_comes_home_and_others(self):
        (sweep,) = lesson.sweeps
        assert [end(run(params)).home for params in lesson.swept(sweep)] == [
            angle < 100 for angle in sweep.values
        ]

    def test_plane_takes_a_sixth_of_the_iterations(self):
        slow, fast = end(preset("home")).icp.iteration, end(preset("plane")).icp.iteration
        assert slow == 61  # a question says so
        assert fast <= slow / 6
        assert end(preset("plane")).home

    def test_symmetric(self):
        found = preset("symmetric")
        assert end(found).error.rotation == pytest.approx(90, abs=2)
        assert end(found).icp.rmse < end(until_stop(replace(HOME, gate="all"))).icp.rmse

    def test_slide(self):
        last = end(preset("slide"))
        assert last.error.rotation < 0.1
        assert last.error.translation == pytest.approx(0.314, abs=0.003)
        assert last.scans.error(last.scans.T_start).translation == pytest.approx(
            0.313, abs=0.001
        )  # "as far as it started"
        assert not last.home

    @pytest.mark.parametrize("name", ["slide", "symmetric"])
    def test_a_shape_that_fits_itself_elsewhere_has_no_basin(self, name):
        found = states(lesson.preset(name).params)
        assert found[-1].icp.stop is not None
        assert not found[-1].tries
        assert "home" not in caption(lesson.preset(name).params, -1).text

    def test_a_wrong_scale_is_not_home(self):
        scans = states(HOME)[0].scans
        shrunk = true(states(HOME)[0]) @ np.diag([0.8, 0.8, 0.8, 1.0])
        assert scans.error(shrunk).rotation < 1e-6
        assert not scans.at_home(scans.error(shrunk))

    def test_overlap(self):
        fixed, adaptive, tight = (
            end(preset(f"overlap-{name}")) for name in ("fixed", "adaptive", "tight")
        )
        assert fixed.error.rotation > 0.5
        assert adaptive.error.rotation == pytest.approx(0.064, abs=0.005)
        assert fixed.error.rotation == pytest.approx(0.634, abs=0.005)
        assert tight.error.rotation < adaptive.error.rotation
        assert states(lesson.preset("overlap-tight").params)[-1].edge == 30
        assert (states(lesson.preset("overlap-adaptive").params)[-1].edge or 0) > 60

    def test_outliers(self):
        assert end(preset("outliers")).error.rotation == pytest.approx(14.8, abs=0.1)
        assert end(preset("outliers-trimmed")).home
        assert end(preset("outliers-trimmed")).error.rotation < 0.5
        colors: Any = draw(preset("outliers")[0])["source"].color  # type: ignore[union-attr]
        assert colors.ids.mean() == pytest.approx(0.3)

    def test_rings(self):
        chance, voxel, spread = (
            end(preset(f"rings-{name}")) for name in ("chance", "voxel", "spread")
        )
        assert chance.error.translation == pytest.approx(0.485, abs=0.005)
        assert voxel.error.translation == pytest.approx(0.0364, abs=0.0005)
        assert spread.error.translation == pytest.approx(0.0061, abs=0.0005)

    def test_what_is_quoted_is_at_rest_and_what_is_not_says_so(self, monkeypatch):
        for params in [one.params for one in (*lesson.presets, *lesson.questions)]:
            assert end(until_stop(params)).icp.stop in (Stop.CONVERGED, Stop.CIRCLING), params
        monkeypatch.setattr("lessons.icp.lesson.MAX_ITERATIONS", 5)
        short = end(run(HOME))
        assert short.icp.stop is Stop.MAX_ITERATIONS
        assert Stop.MAX_ITERATIONS.message in caption_of(draw(short)).text

    @pytest.mark.parametrize("seed", [1, 2])
    def test_they_do_not_hang_on_the_seed(self, seed):
        def last(name: str) -> State:
            return end(run(replace(lesson.preset(name).params, seed=seed)))

        assert last("home").home
        assert last("plane").home
        assert last("far").error.rotation > 90
        assert last("symmetric").error.rotation > 80
        assert last("slide").error.translation > 0.2
        assert last("overlap-adaptive").error.rotation < last("overlap-fixed").error.rotation / 2
        assert last("outliers").error.rotation > 8
        assert last("outliers-trimmed").home


class TestBasin:
    def test_home_to_75_degrees_then_lost(self):
        found = tries("home")
        assert [t.start_angle for t in found] == list(ANGLES)
        assert states(HOME)[-1].edge == 75
        lost = [t for t in found if t.start_angle > 75]
        assert all(t.error.rotation > 80 for t in lost)
        right = found[0].rmse
        assert all(2.5 < t.rmse / right < 3.7 for t in lost)  # "only three times"

    def test_it_grows_by_one_start_a_step_and_does_not_depend_on_the_start(self):
        here, far = states(HOME), states(lesson.preset("far").params)
        assert [len(s.tries) for s in here[-len(ANGLES) :]] == list(range(1, len(ANGLES) + 1))
        np.testing.assert_array_equal(
            [t.error.rotation for t in here[-1].tries], [t.error.rotation for t in far[-1].tries]
        )

    def test_its_captions_say_that_it_is_another_experiment(self):
        """The tries once passed for the run's own ends: they were thinned, turned the other way,
        and never shifted.
        """
        for name, others in (
            ("home", ", turned the other way"),
            ("rings-chance", ", turned the other way, not shifted"),
        ):
            params = lesson.preset(name).params
            state = states(params)[-1]
            p_try = scene(params, -1)["try"]
            n = len(p_try.p)
            assert 290 < n <= 300
            assert p_try.name == f"end from another start, {n} points"
            assert (
                f"with {n} of the source's points{others}: from 180° away"
                in caption(params, -1).text
            )
            start = state.scans.T_start @ np.linalg.inv(true(state))
            assert (
                Rotation.from_matrix(start[:3, :3]).as_rotvec()[2] < 0
            )  # the dial's angles are positive
        assert "turned the other way" not in caption(Params(start_angle=0.0), -1).text

    def test_it_shows_where_the_last_try_ended(self):
        state, shown = (
            states(lesson.preset("far").params)[-1],
            scene(lesson.preset("far").params, -1)["try"],
        )
        attempt = state.tries[-1]
        placed = apply(shown.T_world_object, shown.p)
        home = apply(true(state), shown.p)
        np.testing.assert_allclose(placed, apply(attempt.T_target_truth, home), atol=1e-9)

    def test_its_dial_is_green_where_icp_comes_home(self):
        for name in ("home", "overlap-tight"):
            params = lesson.preset(name).params
            at_home = [states(params)[0].scans.at_home(one.error) for one in tries(name)]
            dial = scene(params, -1)["dial"]
            np.testing.assert_array_equal(dial.color.ids[1::3] == 0, at_home)
            middles = dial.ends[1::3].mean(axis=1)
            np.testing.assert_allclose(
                np.degrees(np.arctan2(middles[:, 1], middles[:, 0])), ANGLES, atol=1e-9
            )

    def test_without_a_truth_or_with_ones_own_function_there_is_none(self, two_files):
        assert not any(s.tries for s in states(two_files))
        assert not any(s.tries for s in run(HOME, match=nearest))


class TestPicture:
    def test_a_moving_source_is_a_pose(self):
        steps = range(len(timeline(HOME)) - len(ANGLES))
        for name in ("target", "source"):
            assert len({id(scene(HOME, k)[name].p) for k in steps}) == 1
        poses = [scene(HOME, k)["source"].T_world_object for k in (0, 1)]
        assert not np.array_equal(poses[0], poses[1])
        again = scene(replace(HOME, start_angle=40.0), 0)
        assert (
            again["target"].p is scene(HOME, 0)["target"].p
        )  # a knob does not send the target anew

    def test_matches_end_at_the_points_they_join(self):
        for k in range(4):
            now, shown = states(HOME)[k].icp, scene(HOME, k)
            ends, source = shown["matches"].ends, shown["source"]
            rows = slice(None, None, 2)  # 1,500 are too many to be drawn
            np.testing.assert_allclose(
                ends[:, 0], apply(source.T_world_object, source.p[rows]), atol=1e-12
            )
            np.testing.assert_array_equal(ends[:, 1], shown["target"].p[now.indices[rows]])
            np.testing.assert_array_equal(shown["matches"].color.ids, ~now.kept[rows])

    def test_the_arrow_lies_on_the_true_one_at_home(self):
        shown = scene(HOME, END)
        np.testing.assert_allclose(shown["true arrow"].T_world_object, np.eye(4), atol=1e-12)
        np.testing.assert_allclose(shown["source arrow"].T_world_object, np.eye(4), atol=0.01)
        start = scene(HOME, 0)["source arrow"].T_world_object
        assert np.degrees(np.arctan2(start[1, 0], start[0, 0])) == pytest.approx(-35)

    def test_truth_stands_beside_the_residual(self):
        charts = {p.name: p for p in scene(HOME, 0).values() if isinstance(p, Scalar)}
        assert charts["rotation error"].value == pytest.approx(35)
        assert charts["rotation error"].color == "truth"
        assert {"RMSE of kept matches", "translation error", "kept", "right among them"} <= set(
            charts
        )

    def test_captions_carry_their_numbers(self):
        match, fit = caption(HOME, 0).text, caption(HOME, 1).text
        now = states(HOME)[1]
        assert "1,350 of 1,500" in match
        assert f"{now.error.rotation:.3g}°" in fit
        step = next(i for i, s in enumerate(states(HOME)) if s.icp.stop)
        assert Stop.CONVERGED.message in caption(HOME, step).text
        assert caption(HOME, step).tone == "good"


class TestQuestions:
    def test_they_open_the_run_itself_where_the_answer_is_seen(self):
        for question in lesson.questions:
            shown = states(question.params)[-1 if question.step is None else question.step]
            assert not shown.tries
            if question.name == "predict-matches":
                assert (
                    f"{100 * states(question.params)[0].right:.0f} % of its matches"
                    in caption_of(draw(shown)).text
                )
            else:
                assert shown.icp.stop is not None

    def test_the_first_match_does_not_tell_how_many_are_right(self):
        assert "right" not in caption(HOME, 0).text
        assert np.isnan(scene(HOME, 0)["right"].value)
        assert scene(HOME, 1)["right"].value == pytest.approx(100 * states(HOME)[0].right)

    def test_other_starts_are_calm_wherever_they_end(self):
        assert {caption(HOME, -1 - i).tone for i in range(len(ANGLES))} == {"info"}

    def test_their_answers(self):
        answers = {q.name: q.answer(until_stop(q.params)) for q in lesson.questions}
        assert answers["predict-matches"] < 10
        assert answers["predict-far"] == 2
        assert answers["predict-plane"] == 10
        assert answers["predict-vase"] == 1

    def test_what_is_known_to_be_wrong_is_not_right(self):
        """A half of the first matches, or as many iterations as without planes, were once near
        enough.
        """
        asked = {q.name: q for q in lesson.questions}
        for name, wrong in (
            ("predict-matches", (9, 20, 50, 100)),
            ("predict-plane", (2, 18, 30, 61)),
        ):
            truth = asked[name].answer(until_stop(asked[name].params))
            for given in wrong:
                assert abs(given - truth) > asked[name].tolerance
        assert all(asked["predict-plane"].reply(given) for given in (2, 30, 61))
        assert all(asked["predict-matches"].reply(given) for given in (9, 20, 50, 100))
        for question in asked.values():
            right = question.answer(until_stop(question.params))
            assert [bool(question.reply(i)) for i in range(len(question.choices))] == [
                i != right for i in range(len(question.choices))
            ]

    def test_a_guess_that_knows_nothing_is_wrong(self):
        for question in lesson.questions:
            if not question.choices:
                truth = question.answer(until_stop(question.params))
                assert abs(truth - 50) > question.tolerance


class TestSlots:
    def test_the_lesson_runs_on_ones_own_functions(self):
        calls = []

        def align(p_target, p_source):
            calls.append(len(p_target))
            return align_rigid(p_target, p_source)

        mine = list(run(HOME, align=align))
        assert calls == [1350] * end(mine).icp.iteration
        np.testing.assert_array_equal(
            end(mine).icp.T_target_source, end(states(HOME)).icp.T_target_source
        )

    def test_a_transposed_rotation_does_not_come_home(self):
        def align(p_target, p_source):
            T = align_rigid(p_target, p_source)
            T[:3, :3] = T[:3, :3].T
            return T

        assert not end(run(HOME, align=align)).home

    def test_the_plane_step_is_a_slot_too(self):
        still = tuple(
            run(Params(fit="point-to-plane"), step=lambda p_target, p_source, n_target: np.eye(4))
        )
        assert end(still).icp.iteration == 1
        assert end(still).error.rotation == pytest.approx(35)
