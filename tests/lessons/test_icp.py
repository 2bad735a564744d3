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
from workbench.data.lidar import Street, lidar_scan, street
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

    def test_slide(self):
        last = end(preset("slide"))
        assert last.error.rotation < 0.1
        assert last.error.translation == pytest.approx(0.3, abs=0.02)
        assert not last.home

    def test_a_slide_is_not_home_whatever_the_rotation(self):
        found = states(lesson.preset("slide").params)
        slid = [t for t in found[-1].tries if t.error.rotation < 1 and t.error.translation > 0.2]
        assert len(slid) >= 2
        for attempt in slid:
            step = len(found) - len(ANGLES) + found[-1].tries.index(attempt)
            assert "comes home" not in caption(lesson.preset("slide").params, step).text
        edge = found[-1].edge
        assert edge is not None
        assert edge < min(t.start_angle for t in slid)

    def test_a_wrong_scale_is_not_home(self):
        scans = states(HOME)[0].scans
        shrunk = true(states(HOME)[0]) @ np.diag([0.8, 0.8, 0.8, 1.0])
        assert scans.error(shrunk).rotation < 1e-6
        assert not scans.at_home(scans.error(shrunk))

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
        assert not any(s.tries for s in run(HOME, match=nearest))


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
    def test_they_open_the_run_itself_where_the_answer_is_seen(self):
        for question in lesson.questions:
            shown = states(question.params)[question.step or 0]
            assert not shown.tries
            if question.name == "predict-matches":
                assert f"{100 * states(question.params)[0].right:.0f} % of its matches" in caption_of(draw(shown)).text
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


class TestAwkwardScans:
    """Own files as people have them: in other units, far from the origin, doubled, tiny, or not overlapping at all."""

    def files(self, folder: Path, p_target: np.ndarray, p_source: np.ndarray, **values: Any) -> Params:
        for name, p in (("t.npy", p_target), ("s.npy", p_source)):
            np.save(folder / name, p)
        return Params(target=folder / "t.npy", source=folder / "s.npy", **values)

    def rabbits(self) -> tuple[np.ndarray, np.ndarray]:
        scans = states(HOME)[0].scans
        return scans.p_target, scans.p_source

    @pytest.mark.parametrize(("unit", "per_metre"), [("mm", 1000.0), ("km", 0.001), ("m", 1000.0)])
    def test_any_unit_passes_the_gate_alike_and_is_told_in_metres(self, tmp_path, unit, per_metre):
        gate: Any = {"gate": "max-distance", "max_distance": 0.06, "thinning": "chance"}
        p_target, p_source = self.rabbits()
        metres = next(run(self.files(tmp_path, p_target, p_source, **gate)))
        there = tmp_path / unit
        there.mkdir()
        first = next(run(self.files(there, per_metre * p_target, per_metre * p_source, unit=unit, **gate)))
        assert 0.1 < metres.icp.overlap < 0.9
        assert first.icp.overlap == metres.icp.overlap
        factor = 1.0 if unit != "m" else 1000.0
        assert first.icp.rmse == pytest.approx(factor * metres.icp.rmse)
        assert (caption_of(draw(first)).text == caption_of(draw(metres)).text) is (unit != "m")

    def test_a_pose_is_in_the_unit_of_the_scans(self, tmp_path):
        p_target, p_source = self.rabbits()
        T = true(states(replace(HOME, start_shift=0.2))[0])
        np.savetxt(tmp_path / "T.txt", np.array([[1, 1, 1, 1000]] * 3 + [[1, 1, 1, 1]]) * T)
        params = self.files(tmp_path, 1000 * p_target, 1000 * p_source, unit="mm", truth=tmp_path / "T.txt")
        np.testing.assert_allclose(true(next(run(params))), T, atol=1e-9)

    def test_far_from_the_origin_nothing_changes(self, tmp_path):
        p_target, p_source = self.rabbits()
        far = np.array([512_000.0, 5_403_000.0, 310.0])
        there = tmp_path / "utm"
        there.mkdir()
        for fit in ("point-to-point", "point-to-plane"):
            here = until_stop(self.files(tmp_path, p_target, p_source, fit=fit))[-1]
            utm = until_stop(self.files(there, p_target + far, p_source + far, fit=fit))[-1]
            assert utm.icp.stop is here.icp.stop
            back = motion(np.eye(3), -far) @ utm.icp.T_target_source @ motion(np.eye(3), far)
            np.testing.assert_allclose(back, here.icp.T_target_source, atol=1e-4)

    @pytest.mark.parametrize("thinning", ["voxel", "chance"])
    def test_doubled_points_do_no_harm(self, tmp_path, thinning):
        p_target, p_source = self.rabbits()
        np.savetxt(tmp_path / "T.txt", true(states(HOME)[0]))
        doubled = (np.concatenate([p, p]) for p in (p_target, p_source))
        values: Any = {"thinning": thinning, "truth": tmp_path / "T.txt"}
        last = until_stop(self.files(tmp_path, *doubled, **values))[-1]
        assert last.home
        assert last.right > 0.5

    def test_five_points_are_fitted_or_one_line_says_why_not(self, tmp_path):
        p = np.random.default_rng(0).uniform(0, 1, (5, 3))
        point = until_stop(self.files(tmp_path, p, p + 0.01))[-1]
        assert point.icp.stop is Stop.CONVERGED
        plane = until_stop(self.files(tmp_path, p, p + 0.01, fit="point-to-plane"))[-1]
        assert plane.icp.stop is Stop.TOO_FEW_MATCHES
        assert "too few matches" in caption_of(draw(plane)).text

    def test_scans_that_start_apart_are_told_so(self, tmp_path):
        p_target, p_source = self.rabbits()
        first = next(run(self.files(tmp_path, p_target, p_source + np.array([800.0, 0.0, 0.0]))))
        assert "The scans start 799 m apart, and the target is" in caption_of(draw(first)).text
        none = next(run(self.files(tmp_path, p_target, p_source + np.array([800.0, 0.0, 0.0]), gate="max-distance")))
        assert "0 of 1,500 are kept" in caption_of(draw(none)).text
        assert "nan" not in caption_of(draw(none)).text
        near = next(run(self.files(tmp_path, p_target, p_source)))
        assert "apart, and" not in caption_of(draw(near)).text

    def test_a_target_in_one_place_and_nan_are_one_line(self, tmp_path):
        p_target, p_source = self.rabbits()
        with pytest.raises(InputError, match="all its points lie at one place"):
            next(run(self.files(tmp_path, np.ones((9, 3)), p_source)))
        with pytest.raises(InputError, match="NaN or infinite"):
            next(run(self.files(tmp_path, np.where(p_target > 0.4, np.nan, p_target), p_source)))

    def test_the_grid_is_in_metres_of_the_scans(self, tmp_path):
        p_target, p_source = self.rabbits()
        shown = draw(next(run(self.files(tmp_path, 100 * p_target, 100 * p_source))))
        grid: Any = shown["grid"]
        scale = states(self.files(tmp_path, 100 * p_target, 100 * p_source))[0].scans.scale
        at = np.unique(grid.ends[:, 0, 0].round(9))
        np.testing.assert_allclose(np.diff(at), 20 * scale)  # 20 m
        assert grid.name == "grid 20 m"
        assert shown["size"].text == "a square of the grid is 20 m of the scans"  # type: ignore[union-attr]
        assert scene(HOME, 0)["grid"].name == "grid 0.5 m"

    def test_a_preset_says_what_own_scans_do_not_take_from_it(self, tmp_path):
        p_target, p_source = self.rabbits()
        params = self.files(tmp_path, p_target, p_source)
        words = "Your own scans are open: shape, start angle have no effect on them."
        assert words in caption_of(draw(next(run(replace(params, shape="vase", start_angle=90.0))))).text
        assert "no effect" not in caption_of(draw(next(run(params)))).text


def yard(rng: np.random.Generator) -> Street:
    """Four walls, crates and poles."""
    half = rng.uniform(15, 30, 2)
    walls = [[s * half[0], 0, 3, 0.5, half[1], 3, 0] for s in (-1, 1)]
    walls += [[0, s * half[1], 3, half[0], 0.5, 3, 0] for s in (-1, 1)]
    crates = [
        [*rng.uniform([-0.7, 0.2], [0.7, 0.7]) * half * [1, s], 0.6, *rng.uniform(0.3, 1, 2), 0.6, rng.uniform(-1, 1)]
        for s in rng.choice([-1, 1], 8)
    ]
    poles = [[*rng.uniform([-0.8, 0.3], [0.8, 0.8]) * half * [1, s], 0.15] for s in rng.choice([-1, 1], 8)]
    return Street(np.array(walls + crates, float), np.array(poles, float))


class TestRings:
    """Scans whose rings move with the scanner, through files, by the defaults."""

    def motion(self, rng: np.random.Generator) -> np.ndarray:
        axis, way = rng.normal(size=3) * [0.2, 0.2, 1.0], rng.normal(size=3) * [1.0, 1.0, 0.1]
        return motion(exp_so3(np.radians(0.7) * axis / np.linalg.norm(axis)), 0.5 * way / np.linalg.norm(way))

    def pair(self, scene: Street, rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        T, sensor = self.motion(rng), motion(exp_so3(np.array([0, 0, 0.2])), np.array([0.0, 0.0, 1.73]))
        return lidar_scan(scene, sensor, rng), lidar_scan(scene, sensor @ T, rng), T

    @pytest.mark.parametrize(("place", "kind"), [(street, "ply"), (yard, "csv"), (street, "pcd"), (yard, "npy")])
    def test_two_scans_of_rings_meet(self, tmp_path, place, kind):
        rng = np.random.default_rng(["ply", "csv", "pcd", "npy"].index(kind))
        p_target, p_source, T = self.pair(place(rng), rng)
        assert 55_000 < len(p_source) < 75_000
        for name, p in (("t", p_target), ("s", p_source)):
            write(tmp_path / f"{name}.{kind}", p.astype(np.float32))
        np.savetxt(tmp_path / "T.txt", T)
        files = {name: tmp_path / f"{name[0]}.{kind}" for name in ("target", "source")}
        last = until_stop(Params(truth=tmp_path / "T.txt", fit="point-to-plane", **files))[-1]
        assert last.error.rotation < 0.3
        assert last.error.translation < 0.02
        assert np.linalg.norm(last.icp.T_target_source[:3, 3] - T[:3, 3]) < 0.02
        assert last.home

    def test_three_ways_to_thin(self):
        chance, voxel, spread = (end(preset(f"rings-{name}")) for name in ("chance", "voxel", "spread"))
        assert chance.error.translation > 0.4
        assert not chance.home
        assert voxel.error.displacement < 0.1
        assert spread.error.displacement < 0.02

    def test_where_the_scanner_drives_decides_what_the_tries_see(self):
        params = replace(lesson.preset("rings-spread").params, seed=1)
        last = states(params)[-1]
        assert last.scans.at_home(last.tries[0].error)
        assert len(last.tries) == len(ANGLES)


def write(path: Path, p: np.ndarray) -> None:
    """Write a cloud of 32-bit floats in the format that the name says."""
    head = (
        f"# .PCD v0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH {len(p)}\nHEIGHT 1\nPOINTS {len(p)}\n"
    )
    ply = f"ply\nformat binary_little_endian 1.0\nelement vertex {len(p)}\n"
    match path.suffix:
        case ".npy":
            np.save(path, p)
        case ".csv":
            path.write_text("\n".join(f"{x:.4f},{y:.4f},{z:.4f}" for x, y, z in p.tolist()))
        case ".pcd":
            path.write_bytes((head + "DATA binary\n").encode() + p.tobytes())
        case ".ply":
            path.write_bytes(
                (ply + "".join(f"property float {c}\n" for c in "xyz") + "end_header\n").encode() + p.tobytes()
            )


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
