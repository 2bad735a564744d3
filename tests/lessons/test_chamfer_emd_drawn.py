"""The lesson on Chamfer and earth mover's as it is drawn: what its pictures, bars, tables and
captions show is what its runs say.
"""

import itertools

import numpy as np
import pytest
import scipy

from lessons.chamfer_emd.inputs import Input
from lessons.chamfer_emd.lesson import lesson
from lessons.chamfer_emd.panels import T_WORLD_LEFT, T_WORLD_RIGHT, squared
from tests.lessons.chamfer_emd_runs import scene, states, timeline
from workbench.scene import Curve, Scalar, Table


class TestPicture:
    def test_both_matchings_are_drawn_where_the_clouds_are(self):
        params = Input()
        state = states(params)[8]
        shown = scene(params, 8)
        p = state.left.flow.p_moving
        p_target = state.clouds.p_target
        to_target = shown["left/to target"].ends
        assert np.array_equal(to_target[:, 0], p)
        np.testing.assert_allclose(
            np.linalg.norm(to_target[:, 1] - to_target[:, 0], axis=1),
            scipy.spatial.distance.cdist(p, p_target).min(axis=1),
        )
        back = shown["left/to source"].ends
        assert np.array_equal(back[:, 0], p_target)
        np.testing.assert_allclose(
            np.linalg.norm(back[:, 1] - back[:, 0], axis=1),
            scipy.spatial.distance.cdist(p, p_target).min(axis=0),
        )
        pairs = shown["right/pairs"].ends
        assert np.linalg.norm(pairs[:, 1] - pairs[:, 0], axis=1).mean() == pytest.approx(
            state.right.flow.value
        )
        assert {tuple(q) for q in pairs[:, 1]} == {tuple(q) for q in p_target}
        for path, primitive in shown.items():
            if path.startswith(("left/", "right/")) and not isinstance(primitive, (Scalar, Curve)):
                T = T_WORLD_LEFT if path.startswith("left/") else T_WORLD_RIGHT
                assert np.array_equal(primitive.T_world_object, T), path

    def test_the_pairs_are_unrolled_fans_on_the_left_and_one_to_one_on_the_right(self):
        for params in (Input(), lesson.preset("unequal").params, lesson.preset("sphere").params):
            state = states(params)[-1]
            shown = scene(params, -1)
            n, m = len(state.clouds.p_source), len(state.clouds.p_target)
            for side in ("left", "right"):
                for row, count in (("target row", m), ("source row", n)):
                    places = shown[f"{side}/unrolled/{row}"].p
                    assert len(np.unique(places[:, 0])) == count
                    assert len({*places[:, 2]}) == 1
            nearest, matched = (
                shown[f"{side}/unrolled/pairing"].ends for side in ("left", "right")
            )
            assert len(nearest) == m
            serving = len(np.unique(nearest[:, 1, 0]))
            assert shown["left/unrolled/pairing words"].text == f"{serving} of {n} serve all {m}"
            assert serving == np.count_nonzero(state.left.served) < n
            assert len(np.unique(matched[:, 1, 0])) == n
            assert len(matched) == n if n == m else len(matched) >= m
            order = np.argsort(shown["right/unrolled/target row"].p[:, 0])
            angles = np.arctan2(
                *(state.clouds.p_target - state.clouds.p_target.mean(axis=0)).T[[2, 0]]
            )[order]
            assert (np.diff(angles) >= -1e-6).all()

    def test_the_end_state_shows_where_the_mass_out_of_place_belongs(self):
        state = states(Input())[-1]
        shown = scene(Input(), -1)
        ends = shown["left/owed"].ends
        assert len(ends) == round(80 * state.left.numbers.out_of_place)
        assert np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1).min() > Input().near
        assert "left/owed" not in scene(Input(), -2)

    def test_it_is_flat_seen_straight_and_without_a_floor(self):
        view = lesson.view
        away = np.array(view.target) - view.eye
        assert away[0] == away[2] == 0.0
        assert view.grid is None
        assert not view.axes

    def test_the_target_is_sent_once(self):
        params = Input()
        assert scene(params, 0)["left/target"].p is scene(params, 9)["right/target"].p

    def test_only_the_side_that_is_lowered_is_drawn(self):
        assert "left/to source" not in scene(Input(lowers="source to target", steps=2), 1)
        assert "left/to target" not in scene(Input(lowers="target to source", steps=2), 1)

    def test_idle_points_are_marked_and_the_busiest_is_named(self):
        params = lesson.preset("idle").params
        shown = scene(params, -1)
        assert np.count_nonzero(shown["left/source"].color.ids) == 71
        served = states(params)[-1].left.served.max()
        assert shown["left/busiest/word"].text == f"nearest of {served} places"

    def test_bars_count_every_point(self):
        shown = scene(Input(), 8)
        assert shown["left/served"].y.sum() == shown["right/served"].y.sum() == 80
        assert np.vdot(shown["right/served"].x, shown["right/served"].y) <= 80

    def test_tables_hold_every_number(self):
        table = scene(Input(), 8)["numbers"]
        assert isinstance(table, Table)
        names = " ".join(row[0] for row in table.rows)
        for word in (
            "mean of squares",
            "sum of squares",
            "sum of distances",
            "only source",
            "only target",
            "exact",
            "Sinkhorn, blur 0.05 m",
            "Hausdorff",
            "F-score",
            "index",
        ):
            assert word in names
        assert len(scene(Input(), 8)["yardsticks"].rows) == 5

    def test_captions_say_how_much_is_out_of_place(self):
        caption = timeline(Input())[8].caption
        state = states(Input())[8]
        assert caption.values["left"] == state.left.numbers.out_of_place
        assert caption.values["other"] == state.right.numbers.out_of_place
        assert timeline(Input())[-1].caption.tone == "info"
        assert {timeline(preset.params)[0].caption.tone for preset in lesson.presets} == {"info"}
        assert timeline(Input(start="larger", amount=0.05))[-1].caption.tone == "good"

    def test_an_end_state_that_covers_its_target_looks_covered(self):
        """Every target point's disc has a source dot in it, drawn smaller and nearer to the viewer:
        a dot in a ring.
        """
        last = states(Input())[-1].right
        shown = scene(Input(), -1)
        target, source = shown["right/target"], shown["right/source"]
        assert source.radius < 0.6 * target.radius
        assert (source.p[:, 1] < target.p[:, 1].min() - 0.01).all()
        seen = np.linalg.norm(
            (source.p - target.p[last.matching.i_b[np.argsort(last.matching.i_a)]])[:, [0, 2]],
            axis=1,
        )
        assert np.mean(seen < target.radius - source.radius) == pytest.approx(
            1 - last.numbers.out_of_place, abs=0.03
        )

    def test_clumps_look_like_clumps(self):
        shown = scene(Input(), -1)
        p = states(Input())[-1].left.flow.p_moving
        discs = [primitive for path, primitive in shown.items() if path.startswith("left/clumps")]
        dot = shown["left/source"].radius
        area = sum(len(disc.p) * (disc.radius / dot) ** 2 for disc in discs)
        shared = (scipy.spatial.distance.cdist(p, p) < 1e-3).sum(axis=1) > 1
        # an area for each point, rounded up to a power of two
        assert shared.sum() <= area <= 2 * shared.sum()
        assert shared.sum() > 40
        assert not [path for path in shown if path.startswith("right/clumps")]

    def test_points_that_share_a_place_do_not_fight_for_depth(self):
        state = states(Input())[-1]
        shown = scene(Input(), -1)
        heights = [shown[f"left/{name}"].p[:, 1] for name in ("target", "source", "clumps of 8")]
        idle = state.left.served == 0
        levels = [heights[1][~idle], heights[1][idle], heights[2], heights[0]]
        assert all(
            front.max() < behind.min() - 1e-3 for front, behind in itertools.pairwise(levels)
        )

    def test_numbers_never_have_an_exponent(self):
        assert [squared(x) for x in (99.96, 3243.0, 0.0, 2.34, 9.96)] == [
            "100 m²",
            "3,200 m²",
            "0 m²",
            "2.3 m²",
            "10 m²",
        ]

    def test_a_run_that_ends_far_from_home_is_not_called_good(self):
        assert timeline(Input(steps=3))[-1].caption.tone == "info"
