"""The lesson on pairs: what its scenes, presets and questions claim, its charts, and a student's
function.
"""

from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest

from lessons.pairs.flat import bands_of
from lessons.pairs.inputs import Input
from lessons.pairs.lesson import lesson, run, setup
from lessons.pairs.presets import SCALE, START
from lessons.pairs.space import Scans, State
from tests.runs import finished
from workbench.algorithms.turning import cost_of_pairs
from workbench.certain import as_a
from workbench.data.files import read_cloud
from workbench.data.shapes.rabbit import rabbit
from workbench.errors import InputError
from workbench.geometry.motions import exp_so3, motion
from workbench.geometry.motions.alignment import degrees_between
from workbench.run.questions import answer
from workbench.run.timeline import Timelines

TIMELINES = Timelines()
R = exp_so3(np.array([0.4, -0.9, 0.6]))


@cache
def states(params: Input) -> Any:
    return finished(lesson.name, params).states()


def preset(name: str) -> Any:
    return states(lesson.preset(name).params)


def scene(name: str, k: int) -> Any:
    return finished(lesson.name, lesson.run_params(name))[k].scene


class TestFlat:
    def test_twice_the_radius_times_the_sine_of_half_the_angle(self):
        errors = {s.angle: s.rmse for s in preset("turned")}
        whole = errors[180.0]
        for angle, rmse in ((60.0, 0.416), (120.0, 0.72), (-60.0, 0.416)):
            assert errors[angle] == pytest.approx(rmse, abs=5e-4)
            assert errors[angle] == pytest.approx(whole * abs(np.sin(np.radians(angle) / 2)))
        assert errors[0.0] == pytest.approx(0.0, abs=1e-12)

    def test_it_opens_where_the_words_say_and_the_ball_is_on_the_curve(self):
        assert preset("turned")[START].angle == -60.0
        shown = scene("turned", START)
        curve, ball = shown["pull/curve"], shown["pull/ball"]
        assert np.interp(ball.x[0], curve.x, curve.y) == pytest.approx(ball.y[0])
        assert shown["angle"].value == -60.0

    def test_any_other_shift_adds_its_square(self):
        bands = setup(lesson.preset("turned").params)
        shift = np.array([0.03, -0.04])
        here = cost_of_pairs(bands.p_target, bands.p_source, 50.0) ** 2
        moved = cost_of_pairs(bands.p_target + shift, bands.p_source, 50.0) ** 2
        assert float(moved - here) == pytest.approx(0.05**2)

    @pytest.mark.parametrize(
        ("pull", "degrees"), [(0.25, 3.8), (0.5, 7.6), (1.0, 15.2), (2.0, 29.1)]
    )
    def test_one_far_partner_turns_them_all(self, pull, degrees):
        assert bands_of(pull).best == pytest.approx(degrees, abs=0.05)

    def test_the_picture_turns_as_the_mark_on_the_chart_moves(self):
        """Seen from +y, x runs to the left: a positive turn takes the top of the rabbit to the
        right.
        """
        T = scene("turned", START + 30)["source"].T_world_object
        assert states(lesson.preset("turned").params)[START + 30].angle == 30.0
        assert (T[:3, :3] @ [0.0, 0.0, 1.0])[0] < 0


class TestSpace:
    @pytest.mark.parametrize(
        ("flip", "rmse"),
        [("least", 0.290), ("middle", 0.401), ("largest", 0.547), ("whole", 0.737)],
    )
    def test_which_direction_is_flipped_decides_the_price(self, flip, rmse):
        run_ = states(replace(lesson.preset("mirrored").params, flip=flip))
        assert run_[4].now.mirror
        assert run_[4].now.rmse < 1e-9
        assert run_[5].now.rmse == pytest.approx(rmse, abs=5e-4)

    def test_in_and_out_come_home(self):
        run_ = preset("pairs")
        assert [s.now.stage for s in run_] == [
            "pairs",
            "centre",
            "cross",
            "in",
            "out",
            "flip",
            "scale",
        ]
        assert [round(s.now.rmse, 3) for s in run_[2:5]] == [0.490, 0.437, 0.024]
        T = run_[-1].now.T_target_source
        assert run_.subject.at_home(T, run_[-1].now.scale)
        # "the noise of the two scans"
        assert run_[-1].now.rmse == pytest.approx(0.01 * np.sqrt(6), rel=0.05)

    def test_noise_raises_the_rmse_and_hardly_the_turn(self):
        ends = [states(replace(Input(), noise=noise)) for noise in (0.01, 0.1)]
        few, many = (s.subject.degrees_off(s[4].now.T_target_source) for s in ends)
        assert many < 0.5
        assert ends[1][4].now.rmse / ends[0][4].now.rmse == pytest.approx(10, rel=0.01)
        assert few < many

    def test_a_plate_is_mirrored_by_noise_alone(self):
        params = lesson.preset("flat").params
        mirrored = [states(replace(params, seed=seed))[4].now.mirror for seed in range(30)]
        assert mirrored[0]
        assert 6 < sum(mirrored) < 26

    def test_noise_in_the_source_dilutes_the_scale(self):
        last, clean = preset("scale")[-1], preset("scale-clean")[-1]
        assert last.now.scale == pytest.approx(1.425, abs=0.002)
        assert last.back == pytest.approx(0.650, abs=0.002)
        assert clean.now.scale == pytest.approx(1.5, rel=0.01)
        p = setup(Input(noise=0.0)).p_source
        spread = np.mean(np.sum((p - p.mean(axis=0)) ** 2, axis=1))
        theory = 1.5 * spread / (spread + 3 * 0.05**2)
        assert last.now.scale == pytest.approx(theory, rel=0.01)

    def test_the_chart_of_the_scale_has_the_runs_own_numbers(self):
        shown = scene("scale", -1)
        curve, mark = shown["scale/there"], shown["scale/mark"]
        assert curve.y[0] == pytest.approx(1.5)
        assert mark.y[0] == pytest.approx(preset("scale")[-1].now.scale)
        assert mark.knob == "noise"
        at = np.argmin(np.abs(curve.x - 0.05))
        assert 1 / shown["scale/back"].y[at] == pytest.approx(preset("scale")[-1].back)

    def test_up_to_seven_in_ten_wrong_partners_the_turn_is_a_few_degrees_off(self):
        for seed in range(4):
            params = replace(lesson.preset("half-wrong-pairs").params, seed=seed)
            off = as_a(Scans, setup(params)).off
            assert off["shuffled"][:8].max() < 5.5
            assert off["shuffled"][9] > 2
            assert off["together"][1] == pytest.approx(7.1, abs=0.3)

    def test_the_mark_of_wrong_partners_is_where_the_run_ends(self):
        for name in ("half-wrong-pairs", "together"):
            shown = scene(name, 5)
            run_ = preset(name)
            error = run_.subject.degrees_off(run_[5].now.T_target_source)
            assert shown["wrong/mark"].y[0] == pytest.approx(error)
            assert shown["rotation error"].value == pytest.approx(error)

    def test_the_chart_of_wrong_partners_begins_at_none(self):
        last = scene("pairs", 5)
        mark = last["wrong/mark"]
        error = last["rotation error"]
        assert (mark.x[0], mark.y[0]) == (0.0, pytest.approx(error.value))

    def test_noise_leaves_the_first_scan_where_it_is_shown(self):
        quiet, loud = (
            as_a(Scans, setup(Input(noise=noise))).T_world_target for noise in (0.0, 0.1)
        )
        np.testing.assert_array_equal(quiet, loud)

    def test_shuffled_partners_are_nobodys_own(self):
        runs = Input(), lesson.preset("half-wrong-pairs").params
        clean, wrong = (as_a(Scans, setup(params)) for params in runs)
        same = np.linalg.norm(clean.p_target - wrong.p_target, axis=1) == 0
        np.testing.assert_array_equal(same, ~wrong.is_wrong)

    def test_a_mirror_image_is_shown_as_one(self):
        colors = [scene("mirrored", k)["source"].color for k in range(7)]
        assert colors == ["source"] * 4 + ["wrong"] + ["source"] * 2
        price = scene("mirrored", 4)["price"].y / 1e4
        assert price[2] == pytest.approx(preset("mirrored")[5].now.rmse ** 2)
        assert price.sum() == pytest.approx(preset("negated")[5].now.rmse ** 2)

    def test_bands_end_at_their_points(self):
        for k in (0, 3, 6):
            shown = scene("pairs", k)
            T = shown["source"].T_world_object
            p = shown["source"].p[:: -(-1500 // 80)]
            ends = shown["bands"].ends
            np.testing.assert_allclose(ends[:, 0], p @ T[:3, :3].T + T[:3, 3], atol=1e-9)


class TestQuestions:
    def test_their_answers(self):
        answers = {q.name: answer(lesson, q, None, timelines=TIMELINES) for q in lesson.questions}
        assert answers["how-many-valleys"].truth == "One"
        assert answers["predict-negated"].value == pytest.approx(0.737, abs=1e-3)
        assert answers["predict-product"].truth == "less than 1"
        assert answers["half-wrong"].truth == "Less than 5°"

    def test_every_wrong_answer_is_answered_and_none_is_right(self):
        for question in lesson.questions:
            right = answer(lesson, question, None, timelines=TIMELINES).value
            for i in range(len(question.choices)):
                assert bool(question.reply(i)) is (i != right)
            for low, high, _ in question.wrong:
                assert not low <= right + question.tolerance <= high
                assert not low <= right - question.tolerance <= high


class TestSlots:
    def test_a_scale_of_ones_own_goes_there_and_back(self):
        asked = []

        def scale(p_target, p_source):
            asked.append((p_target, p_source))
            return 2.0

        *_, last = run(SCALE, setup(SCALE), similarity_scale=scale)
        last = as_a(State, last)
        assert last.now.scale == last.back == 2.0
        assert asked[0][0] is asked[1][1]


class TestOwn:
    def files(self, folder, **clouds: np.ndarray) -> dict[str, Any]:
        for name, p in clouds.items():
            np.save(folder / f"{name}.npy", p)
        return {name: folder / f"{name}.npy" for name in clouds}

    @pytest.fixture(scope="class")
    def shape(self) -> np.ndarray:
        return rabbit(900, np.random.default_rng(4))

    def test_two_clouds_go_row_by_row(self, tmp_path, shape):
        files = self.files(tmp_path, target=1.4 * shape @ R.T + 9.0, source=shape)
        run_ = states(Input(**files, points=400))
        assert len(run_.subject.p_source) == 400
        assert run_[-1].now.scale == pytest.approx(1.4)
        assert run_[-1].now.rmse < 1e-9

    @pytest.mark.parametrize("up", ["z", "y"])
    def test_a_known_pose_is_the_truth(self, tmp_path, shape, up):
        T = motion(R, np.array([0.2, 3.0, -1.0]))
        np.savetxt(tmp_path / "pose.txt", T)
        files = self.files(tmp_path, target=shape @ R.T + T[:3, 3], source=shape)
        run_ = states(Input(**files, truth=tmp_path / "pose.txt", up=up))
        true = run_.subject.T_target_source
        np.testing.assert_allclose(run_[-1].now.T_target_source, true, atol=1e-9)

    def test_one_cloud_takes_the_place_of_the_rabbit(self, tmp_path, shape):
        run_ = states(Input(**self.files(tmp_path, source=1000.0 * shape + 5e5), noise=0.0))
        assert np.ptp(run_.subject.p_source, axis=0).max() < 1.5
        true = run_.subject.T_target_source
        assert degrees_between(run_[-1].now.T_target_source, true) < 1e-6

    def test_what_cannot_be_used_is_refused_in_one_line(self, tmp_path, shape):
        holed = np.where(shape > 0.4, np.nan, shape)
        files = self.files(tmp_path, target=shape, source=shape[:30], holed=holed)
        for params, words in (
            (Input(target=files["target"]), "give “source” too"),
            (Input(source=files["source"], truth=files["target"]), "give “target” too"),
            (Input(source=tmp_path / "none.ply"), "no such file"),
            (Input(source=files["source"], target=files["target"]), "pairs go row by row"),
            (Input(source=files["holed"], target=files["target"]), "NaN"),
        ):
            with pytest.raises(InputError, match=words):
                setup(params)

    def test_a_file_that_changed_is_read_anew(self, tmp_path, shape):
        params = Input(**self.files(tmp_path, source=shape), points=100)
        first = setup(params).p_target
        assert setup(params).p_target is first
        self.files(tmp_path, source=shape[:50])
        assert len(setup(params).p_target) == 50
        assert len(read_cloud(tmp_path / "source.npy")) == 50
