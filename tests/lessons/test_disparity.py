"""The disparity lesson: what its page, presets and questions claim, in numbers; own pairs; slots that drive the run."""

import re
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from PIL import Image

from lessons.disparity.charts import framed, patches
from lessons.disparity.experiments import (
    BARE,
    BOARDS,
    CHECKED,
    DEPTH,
    DOUBLE,
    HALF,
    HOME,
    LAST,
    LAST_CHOICE,
    MOTORCYCLE,
    ONE_PIXEL,
    PLANES,
    POSTS,
    STRIPES,
    boards,
    hidden,
    mean_depths,
    near_edges,
    of_stage,
)
from lessons.disparity.lesson import lesson, run
from lessons.disparity.pairs import MOST_CELLS, setup_of
from lessons.disparity.state import Params, State
from lessons.disparity.words import depth_errors
from tests.runs import finished
from workbench.algorithms.cost_volume import sad_cost_volume
from workbench.algorithms.disparity import Stage
from workbench.algorithms.disparity_map import winner_takes_all
from workbench.errors import InputError
from workbench.geometry.stereo import depth_from_disparity
from workbench.knobs import make
from workbench.scene import Caption, Curve, Field, Picture, Points, Scalar, Segments
from workbench.timeline import Timeline


def timeline(params: Params) -> Timeline:
    return finished(lesson.name, params)


@cache
def states(params: Params) -> tuple[State, ...]:
    return tuple(run(params))


def preset(name: str) -> tuple[State, ...]:
    return states(lesson.preset(name).params)


def truth_of(state: State) -> np.ndarray:
    assert state.setup.pair.disparity is not None
    return state.setup.pair.disparity


def visible_in(state: State) -> np.ndarray:
    assert state.setup.pair.visible is not None
    return state.setup.pair.visible


def off_in(state: State, rows: slice, columns: slice) -> float:
    """Return the share of a part of the map that is over 1 px off."""
    return float((np.abs(state.disparity - truth_of(state)) > 1.0)[rows, columns].mean())


BARE_PART = (slice(30, 90), slice(46, 88))
STRIPED_PART = (slice(30, 90), slice(60, 110))


class TestPresets:
    def test_spheres(self):
        found = preset("spheres")
        assert of_stage(found, Stage.COMPARE).wrong > 0.7
        assert of_stage(found, Stage.AGGREGATE).wrong == pytest.approx(0.12, abs=0.01)
        assert found[LAST_CHOICE].wrong == pytest.approx(0.02, abs=0.005)
        assert np.isnan(of_stage(found, Stage.CHECK).disparity[~visible_in(found[0])]).mean() > 0.7

    def test_textureless_is_flat_and_wrong_at_a_low_cost(self):
        bare, home = preset("textureless")[LAST_CHOICE], states(replace(BARE, pixel=(20, 60)))[LAST_CHOICE]
        assert bare.stage is Stage.AGGREGATE
        assert off_in(bare, *BARE_PART) > 0.9
        u, v = bare.setup.pixel
        assert truth_of(bare)[v, u] == pytest.approx(7.54, abs=0.01)
        flat, valley = bare.costs, home.costs
        assert np.nanmax(flat) < 0.3 * np.nanmedian(valley)  # low, whatever the shift
        assert np.nanmin(valley) < 0.4 * np.nanmedian(valley)  # beside a texture one shift stands out
        assert np.nanmin(flat) > 0.55 * np.nanmedian(flat)

    def test_textureless_and_jumps_forbidden(self):
        found = preset("textureless-smooth")
        assert off_in(found[LAST_CHOICE], *BARE_PART) < 0.03
        assert off_in(of_stage(found, Stage.AGGREGATE), *BARE_PART) > 0.9
        flat = of_stage(found, Stage.AGGREGATE).costs
        assert np.nanmin(flat) > 0.8 * np.sort(flat)[2]

    def test_repeated(self):
        found = preset("repeated")[LAST_CHOICE]
        assert off_in(found, *STRIPED_PART) > 0.5
        inner = found.costs[1:-1]
        valleys = 1 + np.flatnonzero((inner < found.costs[:-2]) & (inner < found.costs[2:]))
        assert np.diff(valleys).tolist() == [6] * (len(valleys) - 1)
        assert len(valleys) == 5
        assert found.costs[valleys].max() < 1.15 * found.costs[valleys].min()
        assert found.costs[valleys].max() < 0.5 * np.median(found.costs)

    def test_repeated_with_paths(self):
        assert off_in(preset("repeated-paths")[LAST_CHOICE], *STRIPED_PART) < 0.01

    def test_occlusion(self):
        state = preset("occlusion")[CHECKED]
        assert state.stage is Stage.CHECK
        u, v = state.setup.pixel
        seen = visible_in(state)
        assert not seen[v, u]
        assert not seen[10:110, 71:76].any()  # the band left of the second post, which begins at u = 77
        assert seen[10:110, 78:90].all()
        dropped = np.isnan(state.disparity[~seen]).mean()
        assert 0.7 < dropped < 0.95

    def test_window_3_scatters(self):
        state = preset("window-3")[LAST_CHOICE]
        assert state.wrong == pytest.approx(1 / 3, abs=0.03)
        of_wrong, of_all = near_edges(state)
        assert of_wrong < 1.3 * of_all  # everywhere

    def test_window_21_fattens(self):
        small, large = preset("window-3")[LAST_CHOICE], preset("window-21")[LAST_CHOICE]
        assert large.wrong < small.wrong / 3.5
        of_wrong, of_all = near_edges(large)
        assert of_wrong > 0.95
        assert of_all < 0.65
        wall = np.isclose(truth_of(large), 150 * 0.1 / 2.6) & visible_in(large)
        floor = np.isclose(truth_of(large), 0.1 * (np.arange(120)[:, None] - 59.5) / 0.5)
        balls = ~wall & ~floor & visible_in(large)
        grown = wall & (large.disparity > truth_of(large) + 1)
        shrunk = balls & (large.disparity < truth_of(large) - 1)
        assert grown.sum() > 5 * shrunk.sum()

    def test_baselines(self):
        errors = {}
        for params in (HALF, PLANES, DOUBLE):
            found = states(params)[LAST]
            errors[params.baseline] = np.median(depth_errors(found))
            assert np.nanmedian(truth_of(found)) == pytest.approx(
                np.nanmedian(truth_of(states(PLANES)[0])) * params.baseline / 0.1
            )
        assert errors[0.05] / errors[0.1] == pytest.approx(2.0, rel=0.15)
        assert errors[0.2] / errors[0.1] == pytest.approx(0.5, rel=0.15)
        assert hidden(HALF) / hidden(PLANES) == pytest.approx(0.5, rel=0.1)
        assert hidden(DOUBLE) / hidden(PLANES) == pytest.approx(2.0, rel=0.1)

    def test_one_pixel(self):
        last = preset("one-pixel")[LAST]
        assert last.disparity_error == 1.0
        for depth, moved in ((1.0, 0.0125), (5.0, 0.3125), (20.0, 5.0)):
            here = np.abs(last.setup.f * last.setup.pair.camera.baseline - truth_of(last) * depth) < 1e-6
            assert here.sum() > 1500
            assert depth * depth / (640 * 0.125) == pytest.approx(moved)
        found = boards(last)
        for d, depth in ((80, 1), (16, 5), (4, 20)):  # Z = f B / d with one pixel more
            assert depth - found[depth] == pytest.approx(depth - 80 / (d + 1), rel=0.01)
        fewer = boards(states(replace(ONE_PIXEL, disparity_error=-1.0))[LAST])
        assert fewer[20] - 20 == pytest.approx(80 / 3 - 20, rel=0.02)
        shown = timeline(lesson.preset("one-pixel").params)[LAST].caption.text
        assert "1 m by 12.5 mm, 5 m by 0.312 m, 20 m by 5 m. Measured: 12.3 mm, 0.29" in shown

    def test_the_boards_are_found_where_they_stand_whatever_the_seed(self):
        for seed in (1, 5, 9):
            found = boards(states(replace(BOARDS, seed=seed))[DEPTH])
            assert found == {
                1: pytest.approx(1, rel=0.002),
                5: pytest.approx(5, rel=0.002),
                20: pytest.approx(20, rel=0.002),
            }

    def test_sky(self):
        state = preset("sky")[DEPTH]
        u, v = state.setup.pixel
        assert truth_of(state)[v, u] == 0.0
        assert state.chosen == 0.0
        assert np.isinf(state.depth[v, u])
        assert np.isinf(state.depth).sum() > 5000
        assert np.isnan(state.depth).any()
        assert (
            "infinitely far, not missing (truth: infinitely far)"
            in timeline(lesson.preset("sky").params)[DEPTH].caption.text
        )

    def test_exposure(self):
        assert preset("darker")[LAST_CHOICE].wrong > 0.9
        assert preset("darker-census")[LAST_CHOICE].wrong < 0.025

    def test_the_sign(self):
        assert preset("exchanged")[LAST_CHOICE].wrong > 0.9

    def test_rows(self):
        assert preset("rows-off")[LAST_CHOICE].wrong > 0.6
        assert states(HOME)[LAST_CHOICE].wrong < 0.03

    def test_motorcycle(self):
        found = preset("motorcycle")
        assert found[LAST_CHOICE].wrong < 0.1
        camera = found[0].setup.pair.camera
        assert camera.f == pytest.approx(994.978 / 4)
        assert camera.doffs == pytest.approx(31.086 / 4)
        assert camera.baseline == pytest.approx(0.193001)
        assert np.median(depth_errors(found[DEPTH])) < 0.05

    def test_f_of_the_large_pictures(self):
        right, wrong = preset("motorcycle"), preset("f-not-rescaled")
        assert np.array_equal(right[DEPTH].disparity, wrong[DEPTH].disparity, equal_nan=True)
        known = np.isfinite(right[DEPTH].depth)
        assert np.allclose(wrong[DEPTH].depth[known], 4 * right[DEPTH].depth[known])
        assert timeline(lesson.preset("f-not-rescaled").params)[DEPTH].caption.tone == "wrong"
        assert isinstance(timeline(lesson.preset("f-not-rescaled").params)[DEPTH].scene["cloud"], Points)


class TestQuestions:
    def answer(self, name: str) -> float:
        question = next(question for question in lesson.questions if question.name == name)
        return question.answer(states(question.params))

    def test_a_quarter_of_the_disparity_is_four_times_the_depth(self):
        assert self.answer("quarter") == pytest.approx(20.0, abs=1.0)
        assert abs(self.answer("quarter") - 5 / 4) > 10  # what Z proportional to d would say

    def test_nearer(self):
        question = next(question for question in lesson.questions if question.name == "nearer")
        answer = self.answer("nearer")
        assert answer == pytest.approx(20 - 80 / 5, abs=0.03)
        for right in (20 - 80 / 5, 20**2 / 80):  # exactly, and by the formula of the page
            assert abs(right - answer) <= question.tolerance
        for wrong in (20 * 0.0125, 20.0, 80 / 3 - 20, 1.0, 16.0):  # linear growth, the wrong side, other numbers
            assert abs(wrong - answer) > question.tolerance
        why = question.why(states(question.params))
        assert "80 / 5 = 16 m: it came 4 m" in why
        assert "which says 5 m" in why
        assert timeline(question.params)[question.step or 0].caption.text.endswith("of the truth.")
        assert "Measured: " in timeline(question.params)[question.step or 0].caption.text

    def test_averages(self):
        assert self.answer("averages") == 0
        of_depths, of_disparities = mean_depths(states(BOARDS))
        assert of_depths > 3 * of_disparities

    def test_baseline_and_window(self):
        assert self.answer("baseline") == 2
        assert self.answer("window") == 1


class TestPage:
    def test_what_each_idea_is_worth(self):
        found = states(HOME)
        assert of_stage(found, Stage.COMPARE).wrong > 0.7
        assert round(100 * of_stage(found, Stage.AGGREGATE).wrong) == 12
        assert round(100 * found[LAST_CHOICE].wrong) == 2

    def test_the_energy_falls_along_the_paths_and_the_error_with_it(self):
        found = [state for state in states(HOME) if state.stage in (Stage.AGGREGATE, Stage.PATHS)]
        assert np.all(np.diff([state.energy for state in found]) < 0)
        assert found[-1].wrong < found[0].wrong / 3
        lowest = [state.lowest for state in states(HOME) if state.stage is Stage.COMPARE]
        assert np.all(np.diff(lowest) <= 0)

    def test_parabolas_pull_to_whole_pixels(self):
        found = boards(states(replace(BOARDS, focal_length=700.0, baseline=0.12))[DEPTH])
        assert found[20] > 20.2
        assert 4.0 < 84 / found[20] < 4.15
        errors = np.abs([84 / found[20] - 4.2, 84 / found[5] - 16.8])
        assert (errors > 0.03).all()

    def test_sub_pixel_halves_the_error(self):
        found = states(HOME)
        assert of_stage(found, Stage.REFINE).error < 0.65 * of_stage(found, Stage.CHECK).error

    def test_the_measured_error_follows_the_square(self):
        scene = timeline(PLANES)[LAST].scene
        predicted, measured = scene["error/predicted"], scene["error/measured"]
        assert isinstance(predicted, Curve)
        assert isinstance(measured, Curve)
        near, far = measured.x < 1.5, measured.x > 2.2
        growth = np.median(measured.y[far]) / np.median(measured.y[near])
        assert 2.0 < growth < 8.0
        at = np.interp(4.0, predicted.x * 4.0 / predicted.x[-1], predicted.y)
        assert at == pytest.approx(predicted.x[-1] ** 2 / 15.0 * 0.5)


class TestSlots:
    def test_depth(self):
        wrong = list(run(PLANES, depth=lambda d, f, baseline: d * f * baseline))
        assert np.allclose(wrong[DEPTH].depth, states(PLANES)[DEPTH].disparity * 15.0, equal_nan=True)
        assert np.array_equal(wrong[20].disparity, states(PLANES)[20].disparity)
        assert np.array_equal(wrong[20].depth, wrong[20].disparity * 15.0)

    def test_cost_volume(self):
        calls = []

        def doubled(left, right, max_disparity, window):
            calls.append((left.shape, max_disparity, window, left.dtype))
            return 2 * sad_cost_volume(left, right, max_disparity, window)

        found = list(run(PLANES, cost_volume=doubled))
        assert calls == [((120, 160), 31, 1, np.float64), ((120, 160), 31, 3, np.float64)]
        assert found[31].lowest == pytest.approx(2 * states(PLANES)[31].lowest)
        assert np.nansum(found[32].costs) == pytest.approx(2 * np.nansum(states(PLANES)[32].costs))
        assert np.array_equal(found[LAST_CHOICE].disparity, states(PLANES)[LAST_CHOICE].disparity)
        calls.clear()
        list(run(replace(PLANES, cost="census"), cost_volume=doubled))
        assert calls == []

    def test_a_volume_with_the_wrong_sign_finds_nothing(self):
        def mirrored(left, right, max_disparity, window):
            return sad_cost_volume(left[:, ::-1], right[:, ::-1], max_disparity, window)[:, :, ::-1]

        assert list(run(PLANES, cost_volume=mirrored))[LAST_CHOICE].wrong > 0.9

    def test_choose(self):
        found = list(run(PLANES, choose=lambda cost: winner_takes_all(-np.where(np.isfinite(cost), cost, 0.0))))
        assert found[LAST_CHOICE].wrong > 0.9
        same = list(run(PLANES, choose=lambda cost: np.argmin(cost, axis=0)))
        assert all(
            np.array_equal(a.disparity, b.disparity, equal_nan=True) for a, b in zip(same, states(PLANES), strict=True)
        )

    def test_a_function_of_the_wrong_shape_ends_the_run_with_a_reason(self):
        found = Timeline(lesson, PLANES, {"choose": lambda cost: np.zeros(3)}).complete()
        assert found.stopped is not None
        assert "\n" not in found.stopped


class TestPicture:
    def test_what_a_step_shows(self):
        scene = timeline(HOME)[10].scene
        for path, kind in {
            "cloud": Points, "candidates": Points, "chosen": Points, "truth": Points, "ray": Segments, "swept": Segments,
            "left/picture": Picture, "right/picture": Picture, "map/disparity": Picture, "map/slice": Picture,
            "windows": Picture,
            "costs": Curve, "costs/truth": Curve, "wrong": Scalar, "unknown": Scalar, "lowest": Scalar, "energy": Scalar,
            "caption": Caption,
        }.items():  # fmt: skip
            assert isinstance(scene[path], kind), path
        assert "swept" not in timeline(HOME)[LAST].scene
        assert {"bars", "law", "error/predicted", "error/measured"} <= timeline(HOME)[LAST].scene.keys()

    def test_no_posed_thing_stands_under_another(self):
        for step in (timeline(HOME)[10], timeline(HOME)[LAST]):
            paths = set(step.scene)
            assert not [
                p for p in paths if p.rsplit("/", 1)[0] in paths - {p} and p.startswith(("chosen", "swept", "cloud"))
            ]

    def test_candidates_are_on_the_ray_and_the_cloud_is_where_the_truth_is(self):
        scene = timeline(HOME)[LAST].scene
        candidates, ray, cloud = scene["candidates"], scene["ray"], scene["cloud"]
        assert isinstance(candidates, Points)
        assert isinstance(ray, Segments)
        assert isinstance(cloud, Points)
        direction = ray.ends[0, 1] / np.linalg.norm(ray.ends[0, 1])
        assert np.allclose(np.cross(candidates.p, direction), 0, atol=1e-9)
        d = 15.0 / candidates.p[:, 2]
        assert np.allclose(d, np.rint(d))
        assert isinstance(cloud.color, Field)
        assert np.median(cloud.color.values) < 0.05

    def test_the_windows_are_the_pixels_of_both_pictures(self):
        rng = np.random.default_rng(0)
        left, right = rng.integers(0, 256, (2, 20, 30, 3)).astype(np.uint8)
        image = patches(left, right, (15, 10), 4, 5)
        assert image.shape == (9, 9 + 2 + 9, 3)
        assert np.abs(image[2:7, 2:7] - 1.0 * left[8:13, 13:18]).max() <= 6  # already as bright as can be
        assert np.abs(image[2:7, 13:18] - 1.0 * right[8:13, 9:14]).max() <= 6
        dim = patches(left // 4, right // 4, (15, 10), 4, 5)
        assert np.abs(dim[2:7, 2:7] - 1.0 * image[2:7, 2:7]).max() <= 12
        outside = patches(left, right, (1, 10), 4, 5)[:, 11:]
        assert (outside[:, 0] == 128).all()
        assert (outside[2:7, 2:7] == 128).all()
        assert np.array_equal(framed(left, (-50, 5), 3), left)

    def test_a_curve_has_gaps_where_nothing_was_compared(self):
        costs = timeline(HOME)[10].scene["costs"]
        assert isinstance(costs, Curve)
        assert np.isfinite(costs.y[:11]).all()
        assert np.isnan(costs.y[11:]).all()

    def test_scenes_without_truth_and_without_anything_known(self, tmp_path):
        bare = np.full((24, 40, 3), 90, np.uint8)
        for name in ("l.png", "r.png"):
            Image.fromarray(bare).save(tmp_path / name)
        params = Params(left=tmp_path / "l.png", right=tmp_path / "r.png", shrink=1, doffs=0.0)
        found = timeline(params)
        assert np.isnan(found[LAST].state.wrong)
        assert "map/error" not in found[LAST].scene
        assert "truth" not in found[LAST].scene
        assert found[LAST].caption.tone in ("info", "wrong")


class TestOwnPairs:
    @pytest.fixture
    def files(self, tmp_path):
        pair = setup_of(HOME).pair
        for name, picture in (("left.png", pair.left), ("right.png", pair.right)):
            Image.fromarray(np.repeat(np.repeat(picture, 2, 0), 2, 1)).save(tmp_path / name)
        return tmp_path / "left.png", tmp_path / "right.png"

    def test_a_pair_shrinks_and_gives_the_same_depths(self, files):
        left, right = files
        own = Params(left=left, right=right, shrink=2, own_focal_length=300.0, own_baseline=0.1)
        found, made = states(own), states(HOME)
        assert np.array_equal(found[LAST_CHOICE].disparity, made[LAST_CHOICE].disparity)
        assert np.allclose(found[DEPTH].depth, made[DEPTH].depth, equal_nan=True)

    @pytest.mark.parametrize("known", [{}, {"own_focal_length": 300.0}, {"own_baseline": 0.1}])
    def test_without_its_cameras_an_own_pair_has_no_metres(self, files, known):
        own = timeline(Params(left=files[0], right=files[1], shrink=2, **known))
        asked = "give own_focal_length and own_baseline for metres"
        assert asked in own[DEPTH].caption.text
        assert "of itself, whatever the cameras: at " in own[LAST].caption.text
        for step in (own[10], own[DEPTH], own[LAST]):
            assert step.caption.tone == "info"
            for path, primitive in step.scene.items():
                said = [getattr(primitive, name, "") for name in ("text", "unit", "x_label", "y_label")]
                said += [getattr(getattr(primitive, name, None), "unit", "") for name in ("color", "image")]
                said += [cell for row in getattr(primitive, "rows", ()) for cell in row]
                assert not [words for words in said if re.search(r"(^|\d )m\b", str(words))], (path, said)
            assert not {"law", "error/predicted"} & step.scene.keys()
        cloud = own[LAST].scene["cloud"]
        assert isinstance(cloud, Points)
        assert isinstance(cloud.color, Field)
        assert (cloud.color.unit, cloud.name) == ("%", "depth cloud by its error; its size is made up")
        metric = states(Params(left=files[0], right=files[1], shrink=2, own_focal_length=300.0, own_baseline=0.1))
        assert np.array_equal(own[DEPTH].state.disparity, metric[DEPTH].disparity, equal_nan=True)

    @pytest.mark.parametrize("known", [{}, {"own_focal_length": 300.0, "own_baseline": 0.1}])
    def test_exchanged_pictures_are_noticed(self, files, known):
        left, right = files
        for pair, noticed in (((left, right), False), ((right, left), True)):
            own = timeline(Params(left=pair[0], right=pair[1], shrink=2, **known))
            assert ("is the left one the right one?" in own[CHECKED].caption.text) is noticed

    def test_real_pairs_are_never_taken_for_exchanged_but_when_they_are(self, shared_data):
        cones = [shared_data / "stereo" / "cones" / name for name in ("im2.png", "im6.png")]
        for shrink in (3, 6):
            for pair, noticed in ((cones, False), (cones[::-1], True)):
                assert setup_of(Params(left=pair[0], right=pair[1], shrink=shrink)).seem_exchanged is noticed
        assert not setup_of(MOTORCYCLE).seem_exchanged
        assert setup_of(replace(MOTORCYCLE, mistake="pictures exchanged")).seem_exchanged

    def test_awkward_files(self, files, tmp_path):
        left, _ = files
        picture = Image.open(left)
        picture.convert("L").save(tmp_path / "grey.png")
        picture.resize((300, 240)).save(tmp_path / "narrow.png")
        Image.fromarray(np.zeros((240, 320), np.uint16)).save(tmp_path / "deep.png")
        Image.fromarray(np.zeros((4100, 4000), np.uint8)).save(tmp_path / "large.png")
        assert timeline(Params(left=left, right=tmp_path / "grey.png", shrink=4)).complete()
        for name, words in (
            ("narrow.png", "320 x 240 pixels, narrow.png 300 x 240"),
            ("deep.png", "deep.png: more than 8 bits a pixel; save it with 8 bits"),
            ("large.png", "4000 x 4100 pixels; a pair may have at most 16,000,000 each"),
        ):
            with pytest.raises(InputError) as refused:
                setup_of(Params(left=left, right=tmp_path / name))
            assert words in str(refused.value)
            assert "\n" not in str(refused.value)

    def test_refusals(self, files, tmp_path):
        left, right = files
        with pytest.raises(InputError, match="give both"):
            Params(left=left)
        with pytest.raises(InputError, match="give both"):
            make(Params, {"right": str(right)})
        with pytest.raises(InputError, match="its side is odd"):
            make(Params, {"window": 4})
        (tmp_path / "text.png").write_text("no picture")
        for params, words in (
            (Params(left=left, right=tmp_path / "text.png"), "text.png: not readable as an image"),
            (Params(left=left, right=tmp_path / "missing.png"), "missing.png"),
            (Params(left=left, right=right, shrink=16), None),
            (replace(MOTORCYCLE, shrink=1), "raise shrink"),
        ):
            found = Timeline(lesson, params)
            while found.extend() and len(found) < 3:
                pass
            assert found.failure is None
            assert (found.stopped is None) == (words is None)
            assert words is None or words in str(found.stopped)
        assert f"{MOST_CELLS:,}" in str(Timeline(lesson, replace(MOTORCYCLE, shrink=1)).complete().stopped)

    def test_a_changed_file_is_read_again(self, files):
        left, right = files
        params = Params(left=left, right=right, shrink=2)
        before = setup_of(params).left
        Image.fromarray(np.zeros((240, 320, 3), np.uint8)).save(left)
        assert not np.array_equal(setup_of(params).left, before)


def test_disparities_are_not_searched_beyond_the_picture():
    setup = setup_of(replace(MOTORCYCLE, shrink=16, max_disparity=127))
    assert setup.max_disparity == setup.left.shape[1] - 1
    assert setup_of(replace(POSTS, pixel=(639, 639))).pixel == (159, 119)


def test_the_valleys_are_6_px_apart_because_the_stripes_are():
    assert setup_of(STRIPES).pair.camera.f * 6 * 1.99 / 150 == pytest.approx(6 * 1.99)
    found = states(HOME)[DEPTH]
    assert depth_from_disparity(np.array([found.chosen]), 150.0, 0.1)[0] == pytest.approx(
        found.depth[found.setup.pixel[1], found.setup.pixel[0]]
    )
