"""The ICP lesson: every claim of its page, presets and questions in numbers, own scans, and what moves in the picture."""

from collections.abc import Mapping
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from lessons.icp.basin import ANGLES, Try
from lessons.icp.draw import draw
from lessons.icp.lesson import lesson, run
from lessons.icp.params import Params
from lessons.icp.presets import HOME, end, rmse_falls
from lessons.icp.state import State
from workbench.algorithms.icp import Stop, nearest
from workbench.errors import InputError
from workbench.geometry.alignment import align_rigid
from workbench.geometry.motions import apply, exp_so3, motion
from workbench.scene import Caption, Scalar, caption_of
from workbench.timeline import Timeline


@cache
def timeline(params: Params) -> Timeline:
    found = Timeline(lesson, params).complete()
    assert found.stopped is None, found.failure or found.stopped
    return found


def states(params: Params) -> tuple[State, ...]:
    return timeline(params).states()


@cache
def until_stop(params: Params) -> tuple[State, ...]:
    """Return the steps of ICP itself; the tries afterwards take most of a run's time."""
    found = []
    for state in run(params):
        found.append(state)
        if state.icp.stop:
            break
    return tuple(found)


def preset(name: str) -> tuple[State, ...]:
    return until_stop(lesson.preset(name).params)


def tries(name: str) -> tuple[Try, ...]:
    return states(lesson.preset(name).params)[-1].tries


def scene(params: Params, k: int) -> Mapping[str, Any]:
    return timeline(params)[k].scene


def true(state: State) -> np.ndarray:
    assert state.scans.T_truth is not None
    return state.scans.T_truth


def caption(params: Params, k: int) -> Caption:
    return timeline(params)[k].caption


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

    def test_plane_takes_a_sixth_of_the_iterations(self):
        slow, fast = end(preset("home")).icp.iteration, end(preset("plane")).icp.iteration
        assert slow == 61  # a question says so
        assert fast <= slow / 6
        assert end(preset("plane")).home

    def test_symmetric(self):
        found = preset("symmetric")
        assert end(found).error.rotation == pytest.approx(90, abs=2)
        assert end(found).icp.rmse < end(until_stop(replace(HOME, gate="all"))).icp.rmse
        step = lesson.preset("symmetric").step
        assert step is not None
        shown = states(lesson.preset("symmetric").params)[step]
        assert shown.icp.stop is not None
        assert not shown.tries

    def test_slide(self):
        last = end(preset("slide"))
        assert last.error.rotation < 0.1
        assert last.error.translation == pytest.approx(0.3, abs=0.02)

    def test_overlap(self):
        fixed, adaptive, tight = (end(preset(f"overlap-{name}")) for name in ("fixed", "adaptive", "tight"))
        assert fixed.error.rotation > 0.5
        assert adaptive.error.rotation < fixed.error.rotation / 9
        assert tight.error.rotation < adaptive.error.rotation
        assert states(lesson.preset("overlap-tight").params)[-1].edge == 30
        assert (states(lesson.preset("overlap-adaptive").params)[-1].edge or 0) > 60

    def test_outliers(self):
        assert end(preset("outliers")).error.rotation > 10
        assert end(preset("outliers-trimmed")).home
        assert end(preset("outliers-trimmed")).error.rotation < 0.5
        colors: Any = draw(preset("outliers")[0])["source"].color  # type: ignore[union-attr]
        assert colors.ids.mean() == pytest.approx(0.3)

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

    def test_it_shows_where_the_last_try_ended(self):
        state, shown = states(lesson.preset("far").params)[-1], scene(lesson.preset("far").params, -1)["try"]
        attempt = state.tries[-1]
        placed = apply(shown.T_world_object, shown.p)
        home = apply(true(state), shown.p)
        np.testing.assert_allclose(placed, apply(attempt.T_target_truth, home), atol=1e-9)

    def test_without_a_truth_or_with_ones_own_function_there_is_none(self, two_files):
        assert not any(s.tries for s in states(two_files))
        assert not any(s.tries for s in run(HOME, match=lambda p_target, p_source: nearest(p_target, p_source)))


class TestPicture:
    def test_a_moving_source_is_a_pose(self):
        for name in ("target", "source"):
            assert len({id(scene(HOME, k)[name].p) for k in range(len(timeline(HOME)))}) == 1
        poses = [scene(HOME, k)["source"].T_world_object for k in (0, 1)]
        assert not np.array_equal(poses[0], poses[1])
        again = scene(replace(HOME, start_angle=40.0), 0)
        assert again["target"].p is scene(HOME, 0)["target"].p  # a knob does not send the target anew

    def test_matches_end_at_the_points_they_join(self):
        for k in range(4):
            now, shown = states(HOME)[k].icp, scene(HOME, k)
            ends, source = shown["matches"].ends, shown["source"]
            rows = slice(None, None, 2)  # 1,500 are too many to be drawn
            np.testing.assert_allclose(ends[:, 0], apply(source.T_world_object, source.p[rows]), atol=1e-12)
            np.testing.assert_array_equal(ends[:, 1], shown["target"].p[now.indices[rows]])
            np.testing.assert_array_equal(shown["matches"].color.ids, ~now.kept[rows])

    def test_the_arrow_lies_on_the_true_one_at_home(self):
        shown = scene(HOME, -1)
        np.testing.assert_allclose(shown["true arrow"].T_world_object, np.eye(4), atol=1e-12)
        np.testing.assert_allclose(shown["source arrow"].T_world_object, np.eye(4), atol=0.01)
        start = scene(HOME, 0)["source arrow"].T_world_object
        assert np.degrees(np.arctan2(start[1, 0], start[0, 0])) == pytest.approx(-35)

    def test_truth_stands_beside_the_residual(self):
        charts = {p.name: p for p in scene(HOME, 0).values() if isinstance(p, Scalar)}
        assert charts["rotation error"].value == pytest.approx(35)
        assert charts["rotation error"].color == "truth"
        assert {"RMSE of kept matches", "translation error", "kept", "right among them"} <= set(charts)

    def test_captions_carry_their_numbers(self):
        match, fit = caption(HOME, 0).text, caption(HOME, 1).text
        now = states(HOME)[1]
        assert "1,350 of 1,500" in match
        assert f"{now.error.rotation:.3g}°" in fit
        step = next(i for i, s in enumerate(states(HOME)) if s.icp.stop)
        assert Stop.CONVERGED.message in caption(HOME, step).text
        assert caption(HOME, step).tone == "good"


class TestQuestions:
    def test_their_answers(self):
        answers = {q.name: q.answer(until_stop(q.params)) for q in lesson.questions}
        assert answers["predict-matches"] < 10
        assert answers["predict-far"] == 2
        assert answers["predict-plane"] == 10
        assert answers["predict-vase"] == 1

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
        np.testing.assert_array_equal(end(mine).icp.T_target_source, end(states(HOME)).icp.T_target_source)

    def test_a_transposed_rotation_does_not_come_home(self):
        def align(p_target, p_source):
            T = align_rigid(p_target, p_source)
            T[:3, :3] = T[:3, :3].T
            return T

        assert not end(run(HOME, align=align)).home

    def test_the_plane_step_is_a_slot_too(self):
        still = tuple(run(Params(fit="point-to-plane"), step=lambda p_target, p_source, n_target: np.eye(4)))
        assert end(still).icp.iteration == 1
        assert end(still).error.rotation == pytest.approx(35)


@pytest.fixture
def two_files(tmp_path) -> Params:
    scans = states(HOME)[0].scans
    for name, p in (("a.xyz", scans.p_target), ("b.csv", scans.p_source)):
        np.savetxt(tmp_path / name, 1000 * p + 5000, delimiter="," if name.endswith("csv") else " ")
    return Params(target=tmp_path / "a.xyz", source=tmp_path / "b.csv")


class TestOwnScans:
    def test_they_are_shown_a_metre_wide_about_the_middle_whatever_their_unit(self, two_files):
        p = scene(two_files, 0)["target"].p
        assert 1.0 < (p.max(axis=0) - p.min(axis=0)).max() < 1.5
        assert np.abs((p.max(axis=0) + p.min(axis=0)) / 2).max() < 0.1
        state, source = states(two_files)[-1], scene(two_files, -1)["source"]
        gap = np.linalg.norm(apply(source.T_world_object, source.p) - p[state.icp.indices], axis=1)
        np.testing.assert_allclose(gap, state.scans.scale * state.icp.distances, atol=1e-9)

    @pytest.mark.parametrize(("up", "axis"), [("z", [0, 0, 1]), ("y", [0, 1, 0]), ("-y", [0, -1, 0])])
    def test_they_stand_upright(self, two_files, up, axis):
        params = replace(two_files, up=up)
        scans, shown = states(params)[0].scans, scene(params, 0)
        middle = scans.p_target.mean(axis=0)
        above = int(np.argmax(scans.p_target @ axis))
        height = (scans.p_target[above] - middle) @ axis
        p = shown["target"].p
        assert p[above, 2] - p[:, 2].mean() == pytest.approx(scans.scale * height)
        for k in (0, -1):
            state, source = states(params)[k], scene(params, k)["source"]
            gap = np.linalg.norm(apply(source.T_world_object, source.p) - p[state.icp.indices], axis=1)
            np.testing.assert_allclose(gap, scans.scale * state.icp.distances, atol=1e-9)
        assert "of the scans" in shown["size"].text

    def test_the_handle_turns_about_the_middle_of_the_picture(self, two_files):
        guess = (0.1, 0.0, 0.0, 0.0, 0.0, 1.0)
        T = scene(replace(two_files, up="y", guess=guess), 0)["source"].T_world_object
        np.testing.assert_allclose(T, motion(exp_so3(np.array([0.0, 0.0, 1.0])), np.array([0.1, 0.0, 0.0])), atol=1e-9)

    def test_a_known_pose_is_the_truth(self, two_files, tmp_path):
        shift = np.eye(4)
        shift[:3, 3] = 5000
        T = shift @ np.diag([1000, 1000, 1000, 1]) @ true(states(HOME)[0]) @ np.diag([0.001, 0.001, 0.001, 1])
        T = T @ np.linalg.inv(shift)
        np.savetxt(tmp_path / "pose.txt", T)
        found = states(replace(two_files, truth=tmp_path / "pose.txt"))
        assert found[0].error.rotation == pytest.approx(35)
        assert end(found).home
        first = found[-1].tries[0]  # started at the truth, so its end as seen from the truth is no motion at all
        np.testing.assert_allclose(first.T_target_truth[:3, :3], np.eye(3), atol=0.02)
        off = apply(first.T_target_truth, found[0].scans.centre) - found[0].scans.centre
        assert np.linalg.norm(off) < 10  # of about 1000

    def test_the_initial_guess_is_set_by_hand(self):
        guess = (0.0, 0.0, 0.0, 0.0, 0.0, np.radians(35))
        assert states(replace(HOME, guess=guess))[0].error.rotation < 1e-9
        found = states(replace(HOME, start_angle=120.0, guess=(0.0, 0.0, 0.0, 0.0, 0.0, 1.5)))
        assert end(found).home

    def test_bad_input_is_one_line(self, two_files, tmp_path):
        one = tmp_path / "one.xyz"
        one.write_text("1 2 3\n")
        for params, words in (
            (replace(two_files, source=None), "both"),
            (Params(truth=Path("pose.txt")), "both"),
            (replace(two_files, target=tmp_path / "no.ply"), "no such file"),
            (replace(two_files, source=one), "1 point"),
            (replace(two_files, truth=tmp_path / "no.txt"), "no such file"),
        ):
            with pytest.raises(InputError, match=words):
                next(run(params))


class TestRealScans:
    @pytest.mark.parametrize("fit", ["point-to-point", "point-to-plane"])
    @pytest.mark.parametrize(
        ("target", "source", "truth", "most_metres"),
        [
            ("bun000.ply", "bun045.ply", "bun.conf", 0.0005),
            ("car_cloud400.csv", "car_cloud401.csv", "carCloudList.csv", 0.03),
        ],
    )
    def test_the_defaults_come_home(self, shared_data, target, source, truth, most_metres, fit):
        folder = shared_data / "icp"
        params = Params(target=folder / target, source=folder / source, truth=folder / truth, fit=fit)
        state = end(run(params))
        assert state.error.rotation < 0.3
        assert state.error.translation < most_metres
        off = np.linalg.norm(state.icp.T_target_source[:3, 3] - true(state)[:3, 3])
        assert off < most_metres
