"""The disparity lesson's whole map: what its page, presets and questions claim, in numbers."""

from dataclasses import replace

import numpy as np
import pytest
from PIL import Image

from lessons.disparity.inputs import Input
from lessons.disparity.lesson import lesson
from lessons.disparity.pairs import ROWS_OFF, pictures_of
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
    POSTS,
    STRIPES,
)
from lessons.disparity.questions import boards, mean_depths
from lessons.disparity.study import hidden
from lessons.disparity.truth import depth_errors
from tests.lessons.disparity_runs import (
    BARE_PART,
    PLANES,
    STRIPED_PART,
    chosen_of,
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


def errors(maps, step: int) -> np.ndarray:
    return depth_errors(maps.subject, maps[step].depth)


class TestPresets:
    def test_spheres(self):
        maps = preset("spheres")
        assert of_stage(maps, Stage.COMPARE).wrong == pytest.approx(0.74, abs=0.005)
        assert of_stage(maps, Stage.AGGREGATE).wrong == pytest.approx(0.12, abs=0.005)
        assert maps[LAST_CHOICE].wrong == pytest.approx(0.02, abs=0.005)
        given_up = np.isnan(of_stage(maps, Stage.CHECK).disparity[~visible_in(maps)]).mean()
        assert given_up == pytest.approx(0.8, abs=0.03)

    def test_textureless_is_flat_and_wrong_at_a_low_cost(self):
        maps = preset("textureless")
        bare = maps[LAST_CHOICE]
        home = states(replace(BARE, pixel=(20, 60)))[LAST_CHOICE]
        assert bare.stage is Stage.AGGREGATE
        assert off_in(maps, bare, BARE_PART) > 0.9
        u, v = maps.subject.pixel
        assert truth_of(maps)[v, u] == pytest.approx(7.54, abs=0.01)
        flat, valley = bare.costs, home.costs
        assert np.nanmax(flat) < 0.3 * np.nanmedian(valley)  # low, whatever the shift
        assert np.nanmin(valley) < 0.4 * np.nanmedian(valley)  # beside a texture one stands out
        assert np.nanmin(flat) > 0.55 * np.nanmedian(flat)

    def test_textureless_and_jumps_forbidden(self):
        maps = preset("textureless-smooth")
        summed = of_stage(maps, Stage.AGGREGATE)
        assert off_in(maps, maps[LAST_CHOICE], BARE_PART) < 0.03
        assert off_in(maps, summed, BARE_PART) > 0.9
        assert np.nanmin(summed.costs) > 0.8 * np.sort(summed.costs)[2]

    def test_repeated(self):
        maps = preset("repeated")
        costs = maps[LAST_CHOICE].costs
        assert off_in(maps, maps[LAST_CHOICE], STRIPED_PART) == pytest.approx(0.8, abs=0.02)
        inner = costs[1:-1]
        valleys = 1 + np.flatnonzero((inner < costs[:-2]) & (inner < costs[2:]))
        assert np.diff(valleys).tolist() == [6] * (len(valleys) - 1)
        assert len(valleys) == 5
        assert costs[valleys].max() < 1.15 * costs[valleys].min()
        assert costs[valleys].max() < 0.5 * np.median(costs)

    def test_repeated_with_paths(self):
        maps = preset("repeated-paths")
        assert off_in(maps, maps[LAST_CHOICE], STRIPED_PART) < 0.01

    def test_occlusion(self):
        maps = preset("occlusion")
        state = maps[CHECKED]
        seen = visible_in(maps)
        assert state.stage is Stage.CHECK
        u, v = maps.subject.pixel
        assert not seen[v, u]
        assert not seen[10:110, 71:76].any()  # the band left of the second post, from u = 77 on
        assert seen[10:110, 78:90].all()
        assert np.isnan(state.disparity[~seen]).mean() == pytest.approx(0.8, abs=0.03)

    def test_window_21_fattens(self):
        small = preset("window-3")[LAST_CHOICE]
        maps = preset("window-21")
        large = maps[LAST_CHOICE]
        truth = truth_of(maps)
        seen = visible_in(maps)
        assert small.wrong == pytest.approx(1 / 3, abs=0.03)
        assert large.wrong < small.wrong / 3.5
        wall = np.isclose(truth, 150 * 0.1 / 2.6) & seen
        floor = np.isclose(truth, 0.1 * (np.arange(120)[:, None] - 59.5) / 0.5)
        grown = wall & (large.disparity > truth + 1)
        shrunk = ~wall & ~floor & seen & (large.disparity < truth - 1)
        assert grown.sum() > 5 * shrunk.sum()

    def test_baselines(self):
        off, lost = {}, {}
        for params in (HALF, PLANES, DOUBLE):
            maps = states(params)
            off[params.baseline] = np.median(errors(maps, LAST))
            lost[params.baseline] = hidden(maps.subject.pair)
            assert np.nanmedian(truth_of(maps)) == pytest.approx(
                np.nanmedian(truth_of(states(PLANES))) * params.baseline / 0.1
            )
        assert off[0.05] / off[0.1] == pytest.approx(2.0, rel=0.15)
        assert off[0.2] / off[0.1] == pytest.approx(0.5, rel=0.15)
        assert lost[0.05] / lost[0.1] == pytest.approx(0.5, rel=0.1)
        assert lost[0.2] / lost[0.1] == pytest.approx(2.0, rel=0.1)

    def test_one_pixel(self):
        maps = preset("one-pixel")
        assert maps[LAST].disparity_error == 1.0
        seen = boards(maps)
        for d, depth in ((80, 1), (16, 5), (4, 20)):  # Z = f B / d with one pixel more
            assert (np.abs(80 - truth_of(maps) * depth) < 1e-6).sum() > 1500
            assert depth - seen[depth] == pytest.approx(depth - 80 / (d + 1), rel=0.01)
        fewer = boards(states(replace(ONE_PIXEL, disparity_error=-1.0)))
        assert fewer[20] - 20 == pytest.approx(80 / 3 - 20, rel=0.02)
        shown = timeline(lesson.preset("one-pixel").params)[LAST].caption.text
        assert "1 m by 12.5 mm, 5 m by 0.313 m, 20 m by 5 m. Measured: 12.3 mm, 0.29" in shown

    def test_the_boards_are_found_where_they_stand_whatever_the_seed(self):
        for seed in (1, 5, 9):
            depths = boards(states(replace(BOARDS, seed=seed)))
            assert depths == {z: pytest.approx(z, rel=0.002) for z in (1, 5, 20)}

    def test_sky(self):
        maps = preset("sky")
        u, v = maps.subject.pixel
        assert truth_of(maps)[v, u] == 0.0
        assert chosen_of(maps, DEPTH) == 0.0
        assert np.isinf(maps[DEPTH].depth[v, u])
        assert np.isinf(maps[DEPTH].depth).sum() > 5000
        assert np.isnan(maps[DEPTH].depth).any()
        text = timeline(lesson.preset("sky").params)[DEPTH].caption.text
        assert "infinitely far, not missing" in text

    def test_exposure(self):
        assert preset("darker")[LAST_CHOICE].wrong == pytest.approx(0.94, abs=0.005)
        assert preset("darker-census")[LAST_CHOICE].wrong < 0.025

    def test_the_sign_and_the_rows(self):
        assert preset("exchanged")[LAST_CHOICE].wrong == pytest.approx(0.94, abs=0.005)
        assert preset("rows-off")[LAST_CHOICE].wrong == pytest.approx(2 / 3, abs=0.02)

    def test_motorcycle(self):
        maps = preset("motorcycle")
        assert maps[LAST_CHOICE].wrong == pytest.approx(0.06, abs=0.005)
        camera = maps.subject.pair.camera
        assert camera.f == pytest.approx(994.978 / 4)
        assert camera.doffs == pytest.approx(31.086 / 4)
        assert camera.baseline == pytest.approx(0.193001)
        assert np.median(errors(maps, DEPTH)) < 0.05

    def test_f_of_the_large_pictures(self):
        right, wrong = preset("motorcycle"), preset("f-not-rescaled")
        assert np.array_equal(right[DEPTH].disparity, wrong[DEPTH].disparity, equal_nan=True)
        known = np.isfinite(right[DEPTH].depth)
        assert np.allclose(wrong[DEPTH].depth[known], 4 * right[DEPTH].depth[known])
        calm = timeline(lesson.preset("f-not-rescaled").params)[DEPTH]
        assert calm.caption.tone == "info"  # it was asked for
        assert isinstance(calm.scene["cloud"], Points)


class TestPage:
    def test_averages(self):
        of_depths, of_disparities = mean_depths(states(BOARDS))
        assert of_depths > 3 * of_disparities

    def test_the_energy_falls_along_the_paths_and_the_error_with_it(self):
        maps = [state for state in states(HOME) if state.stage in (Stage.AGGREGATE, Stage.PATHS)]
        assert np.all(np.diff([state.energy for state in maps]) < 0)
        assert maps[-1].wrong < maps[0].wrong / 3
        lowest = [state.lowest for state in states(HOME) if state.stage is Stage.COMPARE]
        assert np.all(np.diff(lowest) <= 0)

    def test_parabolas_pull_to_whole_pixels(self):
        depths = boards(states(replace(BOARDS, focal_length=700.0, baseline=0.12)))
        assert depths[20] > 20.2
        assert 4.0 < 84 / depths[20] < 4.15
        assert (np.abs([84 / depths[20] - 4.2, 84 / depths[5] - 16.8]) > 0.03).all()

    def test_sub_pixel_halves_the_error(self):
        maps = states(HOME)
        assert of_stage(maps, Stage.REFINE).error < 0.65 * of_stage(maps, Stage.CHECK).error

    def test_the_measured_error_follows_the_square(self):
        scene = timeline(PLANES)[LAST].scene
        predicted, measured = scene["error/predicted"], scene["error/measured"]
        assert isinstance(predicted, Curve)
        assert isinstance(measured, Curve)
        near = measured.x < 1.5
        far = measured.x > 2.2
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
        last = timeline(HOME)[LAST].scene
        assert "swept" not in last
        assert {"bars", "law", "error/predicted", "error/measured"} <= last.keys()

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
        # pixels where the scene is 727 high, as at 1440 x 900
        assert across / (2 * np.tan(np.radians(22.5))) * 727 > 640

    def test_the_row_crosses_both_pictures_and_holds_the_pixel_and_its_partner(self):
        for name, beside in (("spheres", 0), ("rows-off", ROWS_OFF)):
            params = lesson.preset(name).params
            maps = preset(name)
            scene = timeline(params)[LAST_CHOICE].scene
            left, right, row = (scene[path] for path in ("left/picture", "right/picture", "row"))
            assert isinstance(left, Picture)
            assert isinstance(right, Picture)
            assert isinstance(row, Segments)
            u, v = params.pixel
            ends = [left.places(np.array([-0.5, v])), right.places(np.array([159.5, v]))]
            assert np.allclose(row.ends[0], ends, atol=0.01)
            for path, picture, at in (
                ("left/window", left, (u, v)),
                ("right/window", right, (u - chosen_of(maps, LAST_CHOICE), v)),
                ("right/truth", right, (u - truth_of(maps)[v, u], v + beside)),
            ):
                window = scene[path]
                assert isinstance(window, Segments)
                middle = window.ends.mean(axis=(0, 1))
                assert np.allclose(middle, picture.places(np.array(at)), atol=0.02), path
        for name in ("occlusion", "exchanged"):  # nothing is seen there
            assert "right/truth" not in timeline(lesson.preset(name).params)[CHECKED].scene

    def test_whatever_the_depth_it_fits_the_stage_and_is_measured_in_metres(self):
        for params in (HOME, BOARDS, MOTORCYCLE):
            scene = timeline(params)[LAST].scene
            scale = states(params).subject.scale
            assert isinstance(scene["cloud"], Points)
            assert 1.2 < scene["cloud"].p[:, 1].max() < 2.31
            marks = [
                primitive for path, primitive in scene.items() if path.startswith("label/depth")
            ]
            assert 2 <= len(marks) <= 5
            for mark in marks:
                assert isinstance(mark, Label)
                depth = float(mark.text.removesuffix(" m"))
                assert mark.p[2] == pytest.approx(scale * depth, abs=0.06)

    def test_no_posed_thing_stands_under_another(self):
        for step in (timeline(HOME)[10], timeline(HOME)[LAST]):
            paths = set(step.scene)
            posed = [p for p in paths if p.startswith(("chosen", "swept", "cloud"))]
            assert not [p for p in posed if p.rsplit("/", 1)[0] in paths - {p}]

    def test_candidates_are_on_the_ray_and_the_cloud_is_where_the_truth_is(self):
        scene = timeline(HOME)[LAST].scene
        candidates, ray, cloud = scene["candidates"], scene["ray"], scene["cloud"]
        assert isinstance(candidates, Points)
        assert isinstance(ray, Segments)
        assert isinstance(cloud, Points)
        direction = ray.ends[0, 1] / np.linalg.norm(ray.ends[0, 1])
        assert np.allclose(np.cross(candidates.p, direction), 0, atol=1e-9)
        d = 15.0 / (candidates.p[:, 2] / states(HOME).subject.scale)
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
        params = Input(left=tmp_path / "l.png", right=tmp_path / "r.png", shrink=1)
        run = timeline(params)
        assert np.isnan(run[LAST].state.wrong)
        assert "map/error" not in run[LAST].scene
        assert "truth" not in run[LAST].scene
        assert run[LAST].caption.tone in ("info", "wrong")


def test_disparities_are_not_searched_beyond_the_picture():
    pictures = pictures_of(replace(MOTORCYCLE, shrink=16, max_disparity=127))
    assert pictures.max_disparity == pictures.left.shape[1] - 1
    assert pictures_of(replace(POSTS, pixel=(639, 639))).pixel == (159, 119)


def test_the_valleys_are_6_px_apart_because_the_stripes_are():
    assert pictures_of(STRIPES).pair.camera.f * 6 * 1.99 / 150 == pytest.approx(6 * 1.99)
    maps = states(HOME)
    u, v = maps.subject.pixel
    d = np.array([chosen_of(maps, DEPTH)])
    depth = depth_from_disparity(d, 150.0, 0.1)[0]
    assert depth == pytest.approx(maps[DEPTH].depth[v, u])
