"""The disparity lesson's stages beside the whole map: the row, the path, and one knob at all of its
values.
"""

from dataclasses import replace
from typing import Any, TypeVar

import numpy as np
import pytest
from PIL import Image

from lessons.disparity.above import ERRORS
from lessons.disparity.inputs import Input
from lessons.disparity.lesson import lesson
from lessons.disparity.presets import BASELINES, JUMP, NET, PATH, PRICES, ROW, SINGLE, WINDOWS
from lessons.disparity.row import BLOCK
from lessons.disparity.swept import WINDOWS as SIDES
from lessons.disparity.swept import winners_by_window
from tests.lessons.disparity_runs import states as states_of
from tests.lessons.disparity_runs import timeline
from workbench.algorithms.stereo.cost_volume import sad_cost_volume
from workbench.algorithms.stereo.disparity import Stage
from workbench.algorithms.stereo.disparity_map import winner_takes_all
from workbench.run.timeline import Timeline
from workbench.scene import Curve, Label, Mesh, Picture, Points, Scalar, Scene, Segments

Kind = TypeVar("Kind")


def states(params: Input) -> Any:
    """The states of a stage, with its params and its subject."""
    return states_of(params)


def part(scene: Scene, path: str, kind: type[Kind]) -> Kind:
    primitive = scene[path]
    assert isinstance(primitive, kind)
    return primitive


class TestRow:
    def test_a_dot_stands_below_the_window_that_it_belongs_to(self):
        for d in (0, 7, 15, 31):
            scene = timeline(ROW)[d].scene
            window = part(scene, "right/window", Segments)
            here = part(scene, "costs/here", Points)
            assert here.p[0, 0] == pytest.approx(window.ends[..., 0].mean(), abs=1e-9)

    def test_the_costs_are_drawn_as_high_as_they_are(self):
        run = states(ROW)
        scene = timeline(ROW)[31].scene
        p = part(scene, "costs", Points).p
        costs = run[31].costs
        assert np.corrcoef(p[:, 2], costs)[0, 1] == pytest.approx(1.0)
        assert np.all(np.diff(p[:, 0]) < 0)  # a larger shift lies to the left

    def test_the_rays_cross_at_f_b_over_d(self):
        for d in (5, 15, 31):
            scene = timeline(SINGLE)[d].scene
            name = part(scene, "crossing/name", Label).text
            assert float(name.removesuffix(" m")) == pytest.approx(15.0 / d, rel=2e-3)

    def test_a_row_costs_what_the_whole_volume_says(self):
        for params in (SINGLE, ROW, replace(ROW, window=9), replace(ROW, pixel=(54, 1))):
            run = states(params)
            pictures = run.subject
            u, v = run.subject.pixel
            whole = sad_cost_volume(pictures.left, pictures.right, 31, params.window)[:, v, u]
            assert np.allclose(run[0].costs, whole)

    def test_the_strips_show_the_pixels_themselves(self):
        scene = timeline(ROW)[15].scene
        pictures = states(ROW).subject
        strip = part(scene, "left/strip", Picture).rgb()
        u, v = pictures.pixel
        first = u - 31 - 6
        middle = strip[strip.shape[0] // 2, BLOCK * (u - first) + BLOCK // 2]
        assert np.array_equal(middle, pictures.pair.left[v, u])

    def test_a_shift_beyond_the_picture_has_no_partner(self):
        run = timeline(replace(ROW, pixel=(10, 60))).states()
        assert np.isfinite(run[0].costs[:11]).all()
        assert np.isnan(run[0].costs[11:]).all()
        assert "no partner" in timeline(replace(ROW, pixel=(10, 60)))[20].caption.text

    def test_a_students_costs_are_used(self):
        def doubled(left, right, *rest):
            return 2 * sad_cost_volume(left, right, *rest)

        for params in (ROW, PATH, WINDOWS):
            mine = Timeline(lesson, params, {"cost_volume": doubled}).complete()
            assert mine.stopped is None
            if params is ROW:
                assert np.allclose(mine.states()[0].costs, 2 * states(ROW)[0].costs)


class TestPath:
    def test_no_other_path_of_the_row_is_cheaper(self):
        run = states(PATH)
        tape = run[-1].tape
        path = run[-1].path
        P1, P2 = tape.penalties

        def price(shifts: np.ndarray) -> float:
            steps = np.abs(np.diff(shifts))
            toll = P1 * (steps == 1).sum() + P2 * (steps > 1).sum()
            return float(tape.costs[shifts, np.arange(len(shifts))].sum() + toll)

        least = price(path)
        rng = np.random.default_rng(0)
        for _ in range(200):
            other = path.copy()
            start, stop = np.sort(rng.integers(0, len(path) + 1, 2))
            other[start:stop] = rng.integers(0, 32)
            assert price(other) >= least - 1e-3
        assert price(tape.alone) > 1.5 * least

    def test_it_finds_the_stripes_where_each_alone_does_not(self):
        values = timeline(PATH)[-1].caption.values
        assert values["off"] < 0.02 < 0.2 < values["alone"]


class TestKnobAtAllValues:
    def test_the_map_is_that_of_the_whole_run(self):
        maps = states(WINDOWS)
        for side in (3, 21):
            whole = states(Input(smoothness=0.0, window=side))
            same = [state for state in whole if state.stage is Stage.AGGREGATE][-1]
            k = SIDES.index(side)
            assert np.array_equal(maps[k].disparity, same.disparity)
        priced = states(PRICES)
        whole = states(Input(scene="repeated pattern", pixel=(80, 60)))
        same = [state for state in whole if state.stage is Stage.PATHS][-1]
        assert np.array_equal(priced[6].disparity, same.disparity)  # a price of 1

    def test_winners_of_all_windows_are_those_of_each(self):
        left, right = np.random.default_rng(0).integers(0, 256, (2, 30, 50)).astype(float)
        maps = winners_by_window(left, right, 31)
        for side, winner in zip(SIDES, maps, strict=True):
            cost = sad_cost_volume(left, right, 31, side)
            assert np.array_equal(winner, winner_takes_all(cost))

    def test_there_is_a_best_window(self):
        for noise, best in ((4.0, 7), (8.0, 9)):
            share = [state.share for state in states(replace(WINDOWS, noise=noise))]
            assert SIDES[int(np.argmin(share))] == best

    def test_the_shadow_is_as_wide_as_the_jumps_differ(self):
        maps = states(BASELINES)
        for k, state in enumerate(maps):
            d = state.disparity[60]
            post = d.max()
            wall = np.median(d[d < d.max() - 1])
            width = part(timeline(BASELINES)[k].scene, "band", Scalar)
            assert width.value == pytest.approx(post - wall, abs=0.05)


class TestFromAbove:
    def test_the_jump_is_f_b_over_the_distance(self):
        for state in states(JUMP):
            assert state.jump * state.depth == pytest.approx(80.0)

    def test_a_cell_reaches_from_one_pixel_more_to_one_pixel_less(self):
        scene = timeline(NET)[8].scene
        corners = part(scene, "cell/20", Mesh).p
        foot = part(scene, "left eye", Segments).ends[..., 2].max()
        high = (corners[:, 2] - foot) * 30.0 / 2.3
        assert high.min() == pytest.approx(16.0)
        assert high.max() == pytest.approx(80.0 / 3.0)

    def test_an_error_moves_the_board(self):
        for k, error in enumerate(ERRORS):
            values = timeline(NET)[k].caption.values
            assert values["found"] == pytest.approx(80.0 / (4.0 + error))


def test_the_curves_of_the_prices_grow_with_the_steps():
    maps = states(PRICES)
    for k in (0, 4, 10):
        curve = part(timeline(PRICES)[k].scene, "prices/plain wall", Curve)
        assert np.isfinite(curve.y).tolist() == [step <= k for step in range(11)]
        assert curve.y[k] == maps[k].wrong["plain wall"]
    assert curve.y == pytest.approx(
        [29.6, 24.7, 20.2, 15.5, 9.0, 5.2, 2.2, 0.7, 0.5, 0.5, 0.5], abs=0.05
    )
    for state in maps:  # its pictures are those of the curve
        assert state.wrong["repeated pattern"] == pytest.approx(100 * state.share)


def test_an_own_pair_of_450_by_375_pixels_is_shown_step_by_step(tmp_path):
    rng = np.random.default_rng(0)
    picture = rng.integers(0, 255, (375, 450), dtype=np.uint8)
    for name, shown in (("l.png", picture), ("r.png", np.roll(picture, -20, axis=1))):
        Image.fromarray(shown).save(tmp_path / name)
    params = Input(left=tmp_path / "l.png", right=tmp_path / "r.png", shrink=1, max_disparity=63)
    run = Timeline(lesson, params).complete()
    assert run.stopped is None
    assert len(run) == 78
    assert np.median(run.states()[-1].disparity[:, 64:]) == pytest.approx(20.0, abs=0.05)
    for stage in ("row", "path", "windows"):
        own = Timeline(lesson, replace(params, stage=stage)).complete()
        assert own.stopped is None, stage
        assert own[3].scene
