"""The disparity lesson driven by a student's functions, and with own pairs."""

import re
from dataclasses import replace

import numpy as np
import pytest
from PIL import Image

from lessons.disparity.inputs import Input
from lessons.disparity.lesson import lesson
from lessons.disparity.pairs import MOST_CELLS, pictures_of
from lessons.disparity.presets import CHECKED, DEPTH, HOME, LAST, LAST_CHOICE, MOTORCYCLE
from tests.lessons.disparity_runs import PLANES, states, timeline
from workbench.algorithms.stereo.cost_volume import sad_cost_volume
from workbench.algorithms.stereo.disparity_map import winner_takes_all
from workbench.errors import InputError
from workbench.knobs import make, with_own_files
from workbench.page.legend import legend_html
from workbench.run.timeline import Timeline
from workbench.scene import Field, Points


def run(params: Input, **slots) -> list:
    """The states of a run with functions in the place of ours."""
    return list(lesson.form.states(params, slots))


class TestSlots:
    def test_depth(self):
        wrong = run(PLANES, depth=lambda d, f, baseline: d * f * baseline)
        assert np.allclose(
            wrong[DEPTH].depth, states(PLANES)[DEPTH].disparity * 15.0, equal_nan=True
        )
        assert np.array_equal(wrong[20].disparity, states(PLANES)[20].disparity)
        assert np.array_equal(wrong[20].depth, wrong[20].disparity * 15.0)

    def test_cost_volume(self):
        calls = []

        def doubled(left, right, max_disparity, window):  # noqa: PLR0917
            calls.append((left.shape, max_disparity, window, left.dtype))
            return 2 * sad_cost_volume(left, right, max_disparity, window)

        maps = run(PLANES, cost_volume=doubled)
        assert calls == [((120, 160), 31, 1, np.float64), ((120, 160), 31, 3, np.float64)]
        assert maps[31].lowest == pytest.approx(2 * states(PLANES)[31].lowest)
        assert np.nansum(maps[32].costs) == pytest.approx(2 * np.nansum(states(PLANES)[32].costs))
        assert np.array_equal(maps[LAST_CHOICE].disparity, states(PLANES)[LAST_CHOICE].disparity)
        calls.clear()
        run(replace(PLANES, cost="census"), cost_volume=doubled)
        assert calls == []

    def test_a_volume_with_the_wrong_sign_finds_nothing(self):
        def mirrored(left, right, max_disparity, window):  # noqa: PLR0917
            return sad_cost_volume(left[:, ::-1], right[:, ::-1], max_disparity, window)[:, :, ::-1]

        assert run(PLANES, cost_volume=mirrored)[LAST_CHOICE].wrong > 0.9

    def test_choose(self):
        maps = run(
            PLANES, choose=lambda cost: winner_takes_all(-np.where(np.isfinite(cost), cost, 0.0))
        )
        assert maps[LAST_CHOICE].wrong > 0.9
        same = run(PLANES, choose=lambda cost: np.argmin(cost, axis=0))
        assert all(
            np.array_equal(a.disparity, b.disparity, equal_nan=True)
            for a, b in zip(same, states(PLANES), strict=True)
        )

    def test_a_function_of_the_wrong_shape_ends_the_run_with_a_reason(self):
        attempt = Timeline(lesson, PLANES, {"choose": lambda cost: np.zeros(3)}).complete()
        assert attempt.stopped is not None
        assert "\n" not in attempt.stopped


class TestOwnPairs:
    @pytest.fixture
    def files(self, tmp_path):
        pair = pictures_of(HOME).pair
        for name, picture in (("left.png", pair.left), ("right.png", pair.right)):
            Image.fromarray(np.repeat(np.repeat(picture, 2, 0), 2, 1)).save(tmp_path / name)
        return tmp_path / "left.png", tmp_path / "right.png"

    def test_a_pair_shrinks_and_gives_the_same_depths(self, files):
        left, right = files
        own = Input(left=left, right=right, shrink=2, own_focal_length=300.0, own_baseline=0.1)
        shrunk, made = states(own), states(HOME)
        assert np.array_equal(shrunk[LAST_CHOICE].disparity, made[LAST_CHOICE].disparity)
        assert np.allclose(shrunk[DEPTH].depth, made[DEPTH].depth, equal_nan=True)

    def test_a_preset_keeps_a_pair_and_how_it_is_read(self, files):
        left, right = files
        mine = Input(
            left=left,
            right=right,
            shrink=2,
            doffs=3.0,
            own_focal_length=500.0,
            own_baseline=0.2,
            window=9,
        )
        kept = with_own_files(lesson.preset("motorcycle").params, mine)
        of_pair = ("left", "right", "shrink", "doffs", "own_focal_length", "own_baseline")
        assert [getattr(kept, name) for name in of_pair] == [
            getattr(mine, name) for name in of_pair
        ]
        assert kept.window == 3

    @pytest.mark.parametrize("known", [{}, {"own_focal_length": 300.0}, {"own_baseline": 0.1}])
    def test_without_its_cameras_an_own_pair_has_no_metres(self, files, known):
        own = timeline(Input(left=files[0], right=files[1], shrink=2, **known))
        asked = "give own_focal_length and own_baseline for metres"
        assert asked in own[DEPTH].caption.text
        assert "whatever the cameras: at " in own[LAST].caption.text
        for step in (own[10], own[DEPTH], own[LAST]):
            assert step.caption.tone == "info"
            for path, primitive in step.scene.items():
                texts = [
                    getattr(primitive, name, "") for name in ("text", "unit", "x_label", "y_label")
                ]
                texts += [
                    getattr(getattr(primitive, name, None), "unit", "")
                    for name in ("color", "image")
                ]
                texts += [cell for row in getattr(primitive, "rows", ()) for cell in row]
                assert not [words for words in texts if re.search(r"(^|\d )m\b", str(words))], (
                    path,
                    texts,
                )
            assert not {"law", "error/predicted"} & step.scene.keys()
            assert "grid" not in legend_html(step.scene, lesson.view.grid)
        cloud = own[LAST].scene["cloud"]
        assert isinstance(cloud, Points)
        assert isinstance(cloud.color, Field)
        assert (cloud.color.unit, cloud.name) == (
            "%",
            "depth cloud by its error; its size is made up",
        )
        metric = states(
            Input(left=files[0], right=files[1], shrink=2, own_focal_length=300.0, own_baseline=0.1)
        )
        assert np.array_equal(own[DEPTH].state.disparity, metric[DEPTH].disparity, equal_nan=True)

    @pytest.mark.parametrize("known", [{}, {"own_focal_length": 300.0, "own_baseline": 0.1}])
    def test_exchanged_pictures_are_noticed(self, files, known):
        left, right = files
        for pair, noticed in (((left, right), False), ((right, left), True)):
            own = timeline(Input(left=pair[0], right=pair[1], shrink=2, **known))
            assert ("is the left one the right one?" in own[CHECKED].caption.text) is noticed

    def test_real_pairs_are_never_taken_for_exchanged_but_when_they_are(self, shared_data):
        cones = [shared_data / "stereo" / "cones" / name for name in ("im2.png", "im6.png")]
        for shrink in (3, 6):
            for pair, noticed in ((cones, False), (cones[::-1], True)):
                assert (
                    pictures_of(Input(left=pair[0], right=pair[1], shrink=shrink)).seem_exchanged
                    is noticed
                )
        assert not pictures_of(MOTORCYCLE).seem_exchanged
        assert pictures_of(replace(MOTORCYCLE, mistake="pictures exchanged")).seem_exchanged

    def test_awkward_files(self, files, tmp_path):
        left, _ = files
        picture = Image.open(left)
        picture.convert("L").save(tmp_path / "grey.png")
        picture.resize((300, 240)).save(tmp_path / "narrow.png")
        Image.fromarray(np.zeros((240, 320), np.uint16)).save(tmp_path / "deep.png")
        Image.fromarray(np.zeros((4100, 4000), np.uint8)).save(tmp_path / "large.png")
        assert timeline(Input(left=left, right=tmp_path / "grey.png", shrink=4)).complete()
        for name, words in (
            ("narrow.png", "320 x 240 pixels, narrow.png 300 x 240"),
            ("deep.png", "deep.png: more than 8 bits a pixel; save it with 8 bits"),
            ("large.png", "4000 x 4100 pixels; a pair may have at most 16,000,000 each"),
        ):
            with pytest.raises(InputError) as refused:
                pictures_of(Input(left=left, right=tmp_path / name))
            assert words in str(refused.value)
            assert "\n" not in str(refused.value)

    def test_refusals(self, files, tmp_path):
        left, right = files
        with pytest.raises(InputError, match="its side is odd"):
            make(Input, {"window": 4})
        (tmp_path / "text.png").write_text("no picture")
        for params, words in (
            (Input(left=left), "give both “Left” and “Right”"),
            (make(Input, {"right": str(right)}), "give both “Left” and “Right”"),
            (Input(left=left, right=tmp_path / "text.png"), "text.png: not readable as an image"),
            (Input(left=left, right=tmp_path / "missing.png"), "missing.png"),
            (Input(left=left, right=right, shrink=16), None),
            (replace(MOTORCYCLE, shrink=1, max_disparity=80), "raise shrink"),
        ):
            attempt = Timeline(lesson, params)
            while attempt.extend() and len(attempt) < 3:
                pass
            assert attempt.failure is None
            assert (attempt.stopped is None) == (words is None)
            assert words is None or words in str(attempt.stopped)
        assert f"{MOST_CELLS:,}" in str(
            Timeline(lesson, replace(MOTORCYCLE, shrink=1, max_disparity=80)).complete().stopped
        )

    def test_a_changed_file_is_read_again(self, files):
        left, right = files
        params = Input(left=left, right=right, shrink=2)
        before = pictures_of(params).left
        Image.fromarray(np.zeros((240, 320, 3), np.uint8)).save(left)
        assert not np.array_equal(pictures_of(params).left, before)
