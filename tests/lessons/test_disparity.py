"""The disparity lesson: what its page, presets and questions claim, in numbers; own pairs; slots
that drive the run.
"""

from dataclasses import replace

import numpy as np
import pytest
from PIL import Image

from lessons.disparity.lesson import lesson
from lessons.disparity.pairs import ROWS_OFF, setup_of
from lessons.disparity.presets import (
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
)
from lessons.disparity.state import Params
from lessons.disparity.truth import depth_errors
from tests.lessons.disparity_runs import (
    BARE_PART,
    STRIPED_PART,
    of_stage,
    off_in,
    preset,
    states,
    timeline,
    truth_of,
    visible_in,
)
from workbench.algorithms.stereo.disparity import Stage
from workbench.geometry.cameras.stereo import depth_from_disparity
from workbench.run.picking import picked
from workbench.scene import (
    Caption,
    Curve,
    Field,
    Label,
    Picture,
    Points,
    Primitive,
    Scalar,
    Segments,
)


def edge(picture: Primitive, side: str) -> np.ndarray:
    assert isinstance(picture, Picture)
    return picture.places(np.array([picture.rgb().shape[1] if side == "right" else 0.0, 0.0]))


class TestPresets:
    def test_spheres(self):
        found = preset("spheres")
        assert of_stage(found, Stage.COMPARE).wrong == pytest.approx(0.74, abs=0.005)
        assert of_stage(found, Stage.AGGREGATE).wrong == pytest.approx(0.12, abs=0.005)
        assert found[LAST_CHOICE].wrong == pytest.approx(0.02, abs=0.005)
        hidden_and_given_up = np.isnan(
            of_stage(found, Stage.CHECK).disparity[~visible_in(found[0])]
        ).mean()
        assert hidden_and_given_up == pytest.approx(0.8, abs=0.03)

    def test_textureless_is_flat_and_wrong_at_a_low_cost(self):
        bare, home = (
            preset("textureless")[LAST_CHOICE],
            states(replace(BARE, pixel=(20, 60)))[LAST_CHOICE],
        )
        assert bare.stage is Stage.AGGREGATE
        assert off_in(bare, *BARE_PART) > 0.9
        u, v = bare.setup.pixel
        assert truth_of(bare)[v, u] == pytest.approx(7.54, abs=0.01)
        flat, valley = bare.costs, home.costs
        assert np.nanmax(flat) < 0.3 * np.nanmedian(valley)  # low, whatever the shift
        assert np.nanmin(valley) < 0.4 * np.nanmedian(
            valley
        )  # beside a texture one shift stands out
        assert np.nanmin(flat) > 0.55 * np.nanmedian(flat)

    def test_textureless_and_jumps_forbidden(self):
        found = preset("textureless-smooth")
        assert off_in(found[LAST_CHOICE], *BARE_PART) < 0.03
        assert off_in(of_stage(found, Stage.AGGREGATE), *BARE_PART) > 0.9
        flat = of_stage(found, Stage.AGGREGATE).costs
        assert np.nanmin(flat) > 0.8 * np.sort(flat)[2]

    def test_repeated(self):
        found = preset("repeated")[LAST_CHOICE]
        assert off_in(found, *STRIPED_PART) == pytest.approx(0.8, abs=0.02)
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
        assert not seen[
            10:110, 71:76
        ].any()  # the band left of the second post, which begins at u = 77
        assert seen[10:110, 78:90].all()
        dropped = np.isnan(state.disparity[~seen]).mean()
        assert dropped == pytest.approx(0.8, abs=0.03)

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
            here = (
                np.abs(last.setup.f * last.setup.pair.camera.baseline - truth_of(last) * depth)
                < 1e-6
            )
            assert here.sum() > 1500
            assert depth * depth / (640 * 0.125) == pytest.approx(moved)
        found = boards(last)
        for d, depth in ((80, 1), (16, 5), (4, 20)):  # Z = f B / d with one pixel more
            assert depth - found[depth] == pytest.approx(depth - 80 / (d + 1), rel=0.01)
        fewer = boards(states(replace(ONE_PIXEL, disparity_error=-1.0))[LAST])
        assert fewer[20] - 20 == pytest.approx(80 / 3 - 20, rel=0.02)
        shown = timeline(lesson.preset("one-pixel").params)[LAST].caption.text
        assert "1 m by 12.5 mm, 5 m by 0.313 m, 20 m by 5 m. Measured: 12.3 mm, 0.29" in shown

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
        assert preset("darker")[LAST_CHOICE].wrong == pytest.approx(0.94, abs=0.005)
        assert preset("darker-census")[LAST_CHOICE].wrong < 0.025

    def test_the_sign(self):
        assert preset("exchanged")[LAST_CHOICE].wrong == pytest.approx(0.94, abs=0.005)

    def test_rows(self):
        assert preset("rows-off")[LAST_CHOICE].wrong == pytest.approx(2 / 3, abs=0.02)
        assert states(HOME)[LAST_CHOICE].wrong < 0.03

    def test_motorcycle(self):
        found = preset("motorcycle")
        assert found[LAST_CHOICE].wrong == pytest.approx(0.06, abs=0.005)
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
        calm = timeline(lesson.preset("f-not-rescaled").params)[DEPTH]
        assert calm.caption.tone == "info"  # it was asked for
        assert isinstance(calm.scene["cloud"], Points)


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
        assert abs(20 - 80 / 5 - answer) <= question.tolerance
        tangent, other_side, with_z, with_z_squared = (
            20**2 / 80,
            80 / 3 - 20,
            20 * 0.012,
            400 * 0.012,
        )
        for wrong in (tangent, other_side, with_z, with_z_squared, 0.012, 16.0):
            assert abs(wrong - answer) > question.tolerance
            assert question.reply(wrong)
        assert abs(1.0 - answer) > question.tolerance
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
        assert round(100 * of_stage(found, Stage.COMPARE).wrong) == 74
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


class TestPicture:
    def test_what_a_step_shows(self):
        scene = timeline(HOME)[10].scene
        for path, kind in {
            "cloud": Points,
            "candidates": Points,
            "chosen": Points,
            "truth": Points,
            "ray": Segments,
            "swept": Segments,
            "left/picture": Picture,
            "right/picture": Picture,
            "map/disparity": Picture,
            "map/slice": Picture,
            "windows": Picture,
            "costs": Curve,
            "costs/truth": Curve,
            "wrong": Scalar,
            "unknown": Scalar,
            "lowest": Scalar,
            "energy": Scalar,
            "caption": Caption,
        }.items():
            assert isinstance(scene[path], kind), path
        assert "swept" not in timeline(HOME)[LAST].scene
        assert {"bars", "law", "error/predicted", "error/measured"} <= timeline(HOME)[
            LAST
        ].scene.keys()

    def test_the_pictures_stand_upright_before_the_eye_and_a_click_finds_the_pixel(self):
        for params in (HOME, MOTORCYCLE):
            scene = timeline(params)[10].scene
            eye = np.array(lesson.view.eye)
            for path in ("left/picture", "right/picture", "map/disparity"):
                picture = scene[path]
                assert isinstance(picture, Picture)
                assert picture.T_world_object is not None
                ahead = np.array(lesson.view.target) - eye
                assert np.allclose(picture.T_world_object[:3, 2], ahead / np.linalg.norm(ahead))
                assert picture.T_world_object[2, 1] < -0.8  # rows run down
                place = picture.places(np.array([31.0, 47.0]))
                assert picked(picture, eye, place - eye) == (31, 47)
            across = np.linalg.norm(
                edge(scene["right/picture"], "right") - edge(scene["left/picture"], "left")
            )
            across /= (picture.T_world_object[:3, 3] - eye) @ ahead / np.linalg.norm(ahead)
        assert (
            across / (2 * np.tan(np.radians(22.5))) * 727 > 640
        )  # pixels where the scene is 727 high, as at 1440 x 900

    def test_the_row_crosses_both_pictures_and_holds_the_pixel_and_its_partner(self):
        for params, beside in ((HOME, 0), (preset("rows-off")[0].setup.params, ROWS_OFF)):
            step = timeline(params)[LAST_CHOICE]
            left, right, row = (
                step.scene[path] for path in ("left/picture", "right/picture", "row")
            )
            assert isinstance(left, Picture)
            assert isinstance(right, Picture)
            assert isinstance(row, Segments)
            u, v = params.pixel
            ends = [left.places(np.array([-0.5, v])), right.places(np.array([159.5, v]))]
            assert np.allclose(row.ends[0], ends, atol=0.01)
            for path, picture, at in (
                ("left/window", left, (u, v)),
                ("right/window", right, (u - step.state.chosen, v)),
                ("right/truth", right, (u - truth_of(step.state)[v, u], v + beside)),
            ):
                window = step.scene[path]
                assert isinstance(window, Segments)
                assert np.allclose(
                    window.ends.mean(axis=(0, 1)), picture.places(np.array(at)), atol=0.02
                ), path
        assert (
            "right/truth" not in timeline(lesson.preset("occlusion").params)[CHECKED].scene
        )  # nothing is seen there
        assert "right/truth" not in timeline(lesson.preset("exchanged").params)[CHECKED].scene

    def test_whatever_the_depth_it_fits_the_stage_and_is_measured_in_metres(self):
        for params in (HOME, BOARDS, MOTORCYCLE):
            scene, scale = timeline(params)[LAST].scene, states(params)[0].setup.scale
            assert isinstance(scene["cloud"], Points)
            assert 1.2 < scene["cloud"].p[:, 1].max() < 2.31
            marks = [one for path, one in scene.items() if path.startswith("label/depth")]
            assert 2 <= len(marks) <= 5
            for mark in marks:
                assert isinstance(mark, Label)
                assert mark.p[2] == pytest.approx(
                    scale * float(mark.text.removesuffix(" m")), abs=0.06
                )

    def test_no_posed_thing_stands_under_another(self):
        for step in (timeline(HOME)[10], timeline(HOME)[LAST]):
            paths = set(step.scene)
            assert not [
                p
                for p in paths
                if p.rsplit("/", 1)[0] in paths - {p} and p.startswith(("chosen", "swept", "cloud"))
            ]

    def test_candidates_are_on_the_ray_and_the_cloud_is_where_the_truth_is(self):
        scene = timeline(HOME)[LAST].scene
        candidates, ray, cloud = scene["candidates"], scene["ray"], scene["cloud"]
        assert isinstance(candidates, Points)
        assert isinstance(ray, Segments)
        assert isinstance(cloud, Points)
        direction = ray.ends[0, 1] / np.linalg.norm(ray.ends[0, 1])
        assert np.allclose(np.cross(candidates.p, direction), 0, atol=1e-9)
        d = 15.0 / (candidates.p[:, 2] / states(HOME)[0].setup.scale)
        assert np.allclose(d, np.rint(d))
        assert isinstance(cloud.color, Field)
        assert np.median(cloud.color.values) < 0.05

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
