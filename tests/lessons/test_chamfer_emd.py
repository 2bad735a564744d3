"""The lesson on Chamfer and earth mover's: every claim of its page, presets and questions in numbers, slots, own clouds."""

import itertools
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
import scipy

from lessons.chamfer_emd.clouds import YARDSTICKS, clouds_of
from lessons.chamfer_emd.draw import T_WORLD_LEFT, T_WORLD_RIGHT
from lessons.chamfer_emd.exercises.earth_movers import earth_movers_of_copies, points_left_out
from lessons.chamfer_emd.experiments import ONE_WAY, QUESTIONS, flips, nearer_side
from lessons.chamfer_emd.lesson import lesson, run
from lessons.chamfer_emd.state import Lowers, Params, State
from lessons.chamfer_emd.words import metres, squared
from tests.runs import finished
from workbench.algorithms.flow import Stop, flow
from workbench.algorithms.transport import earth_movers
from workbench.errors import InputError
from workbench.exercise.candidate import Candidate
from workbench.geometry.shape_distances import chamfer, one_sided
from workbench.scene import Curve, Scalar, Table
from workbench.timeline import Timeline


def timeline(params: Params) -> Timeline:
    return finished(lesson.name, params)


def states(params: Params) -> tuple[State, ...]:
    return timeline(params).states()


def preset(name: str) -> tuple[State, ...]:
    return states(lesson.preset(name).params)


def line(name: str) -> str:
    return lesson.preset(name).line


def scene(params: Params, k: int) -> Mapping[str, Any]:
    return timeline(params)[k].scene


class TestPresets:
    def test_clump(self):
        found = preset("clump")
        first, last = found[0], found[-1]
        assert squared(last.left.numbers.chamfer) == "0.0096 m²"
        assert round(80 * nearer_side(last.left)) == 72
        assert last.left.flow.stop is Stop.SETTLED
        assert round(80 * nearer_side(last.right)) == 40
        assert last.right.numbers.earth_movers < 0.005
        assert last.left.numbers.earth_movers > 0.7
        assert np.shares_memory(first.left.flow.p_moving, first.right.flow.p_moving)

    def test_flip(self):
        first = preset("flip")[0]
        assert flips(first)
        now, larger = first.left.numbers, first.yardsticks["5 % larger"]
        assert (squared(now.chamfer), squared(larger.chamfer)) == ("0.0039 m²", "0.0050 m²")
        assert (metres(now.earth_movers), metres(larger.earth_movers)) == ("0.98 m", "0.050 m")
        assert now.hausdorff < 0.1  # a few points keep every gap short
        assert "flips" in timeline(lesson.preset("flip").params)[0].caption.text

    def test_larger(self):
        now = preset("larger")[0].left.numbers
        assert now.chamfer == pytest.approx(2 * 0.05**2)
        assert now.earth_movers == pytest.approx(0.05)
        assert not flips(preset("larger")[0])

    def test_bump(self):
        first = preset("bump")[0]
        now, larger = first.left.numbers, first.yardsticks["5 % larger"]
        assert squared(now.chamfer) == squared(larger.chamfer) == "0.0050 m²"
        assert metres(now.earth_movers) == "0.019 m"
        assert "0.019" in line("bump")
        assert now.hausdorff == pytest.approx(0.147)
        assert "0.147" in line("bump")
        assert larger.hausdorff == pytest.approx(0.05)

    def test_missing(self):
        found = preset("missing")
        now, last = found[0].left.numbers, found[-1].left
        assert now.to_target == 0.0
        assert squared(now.to_source) == "0.39 m²"
        assert last.numbers.to_source < 0.01  # lowering both sides fills the missing part
        assert last.flow.p_moving[:, 0].max() > 0.9
        assert found[-1].right.numbers.earth_movers < 0.01 < 0.6 < found[0].right.numbers.earth_movers

    def test_one_way_from_the_source_sees_nothing_missing(self):
        found = states(ONE_WAY)
        assert found[0].left.flow.stop is Stop.ARRIVED
        assert np.array_equal(found[-1].left.flow.p_moving, found[0].left.flow.p_moving)

    def test_outlier(self):
        first = preset("outlier")[0]
        now, larger = first.left.numbers, first.yardsticks["5 % larger"]
        assert now.hausdorff == pytest.approx(20 * larger.hausdorff) == pytest.approx(1.0)
        assert now.chamfer / larger.chamfer == pytest.approx(2.5, abs=0.05)
        assert now.earth_movers / larger.earth_movers == pytest.approx(0.25)
        assert now.earth_movers == pytest.approx(0.0125)
        assert round(100 * now.f_score) == 99

    def test_shuffled(self):
        now = preset("shuffled")[0].left.numbers
        assert now.chamfer == now.earth_movers == now.hausdorff == now.to_target == now.to_source == 0.0
        assert all(value == 0.0 for value in now.definitions.values())
        assert squared(now.index_mse) == "2.3 m²"
        assert len(preset("shuffled")) == 1

    def test_doubled(self):
        now = preset("doubled")[0].left.numbers
        assert now.chamfer == now.hausdorff == 0.0
        assert metres(now.earth_movers) == "0.21 m"
        assert np.isnan(now.index_mse)

    def test_idle(self):
        last = preset("idle")[-1].left
        assert np.count_nonzero(last.served == 0) == 71
        assert np.count_nonzero(last.served) == 9
        assert last.served.sum() == 80
        start = preset("idle")[0].left.flow.p_moving
        moved = np.linalg.norm(last.flow.p_moving - start, axis=1)[last.served == 0]
        assert np.median(moved) == 0.0

    def test_blurred(self):
        first, last = preset("blurred")[0].right, preset("blurred")[-1].right
        assert (metres(first.sinkhorn), metres(first.numbers.earth_movers)) == ("0.99 m", "0.81 m")
        assert metres(last.sinkhorn) == "0.54 m"
        assert round(last.numbers.earth_movers, 3) == 0.004

    def test_unequal(self):
        found = preset("unequal")
        last = found[-1].right
        assert len(last.flow.p_moving) == 40
        assert np.all(np.bincount(last.matching.i_a) == 2)
        assert np.allclose(last.matching.mass, 1 / 80)
        assert np.median(last.matching.distances) == pytest.approx(0.039, abs=1e-3)
        assert last.matching.distances.max() < 0.05
        D = scipy.spatial.distance.cdist(last.flow.p_moving, found[-1].clouds.p_target)
        assert 80 - len(scipy.optimize.linear_sum_assignment(D)[1]) == 40  # target points left out

    def test_sphere(self):
        last = preset("sphere")[-1]
        assert round(100 * last.left.numbers.astray) == 72
        assert last.right.numbers.astray < 0.02
        assert last.right.numbers.f_score > 0.98


class TestPage:
    """What page.md says."""

    def test_one_point_is_the_nearest_of_fifteen(self):
        found = preset("clump")
        assert max(s.left.served.max() for s in found) == 15
        assert found[0].left.served.max() == 12
        assert all(len(np.unique(s.right.matching.i_b)) == 80 for s in found)

    def test_a_hundredfold_and_half_astray(self):
        found = preset("clump")
        assert 100 < found[0].left.numbers.chamfer / found[-1].left.numbers.chamfer < 120
        assert found[-1].left.numbers.astray == pytest.approx(0.5, abs=0.05)

    def test_one_pair_of_clouds_has_four_chamfers(self):
        definitions = preset("clump")[-1].left.numbers.definitions
        shown = [f"{value:.2g}" for value in definitions.values()]
        assert shown == ["0.0096", "0.072", "0.77", "5.7"]
        assert all(number in lesson.text() for number in shown)

    def test_no_metric(self):
        zero, pair, one = np.zeros((1, 3)), np.array([[0.0, 0, 0], [1, 0, 0]]), np.array([[1.0, 0, 0]])
        assert chamfer(zero, pair) + chamfer(pair, one) < chamfer(zero, one)

    def test_the_astray_limit_is_the_default(self):
        assert Params().near == 0.1


@pytest.mark.parametrize(
    ("name", "right"), [("predict-spread", 1), ("predict-flip", 1), ("predict-missing", 100), ("predict-outlier", 2)]
)
def test_questions_have_the_answer_that_the_run_gives(name, right):
    question = next(q for q in QUESTIONS if q.name == name)
    found = states(question.params)
    assert question.answer(found) == right
    assert any(character.isdigit() for character in question.why(found))


def test_no_number_is_right_when_nothing_was_typed():
    for question in QUESTIONS:
        if not question.choices:
            assert abs(question.answer(states(question.params))) > question.tolerance


class TestRun:
    def test_both_flows_lower_their_own_distance(self):
        for name in ("clump", "idle", "unequal", "sphere"):
            found = preset(name)
            assert np.all(np.diff([s.left.flow.value for s in found]) <= 0)
            assert np.all(np.diff([s.right.flow.value for s in found]) <= 0)

    def test_the_flow_that_ended_waits(self):
        found = preset("doubled")
        ended = [s for s in found if s.left.flow.stop and s.left.flow.step < s.step]
        assert ended
        assert all(s.left is ended[0].left for s in ended)
        assert [s.step for s in found] == list(range(len(found)))
        assert [s.last for s in found] == [False] * (len(found) - 1) + [True]

    def test_no_steps_is_a_picture_of_the_start(self):
        found = states(Params(steps=0))
        assert len(found) == 1
        assert found[0].last

    def test_the_code_shown_is_the_flow(self):
        moment = timeline(Params())[5].moment
        assert moment is not None
        assert moment.function is getattr(flow, "__wrapped__", flow)

    def test_yardsticks_are_what_their_names_say(self):
        known = preset("clump")[0].yardsticks
        assert list(known) == [name for name, _, _ in YARDSTICKS]
        assert known["one point 3 m off"].hausdorff == pytest.approx(3.0)
        assert known["half missing"].to_target == 0.0
        assert known["rows shuffled"].chamfer == 0.0


class TestSlots:
    """The student's functions drive the run: step lengths, ends, curves and tables."""

    def test_equal_functions_give_an_equal_run(self):
        params = Params(points=30, steps=15)
        slots = {
            "chamfer": Candidate(brute_chamfer, chamfer),
            "earth_movers": Candidate(plain_earth_movers, earth_movers),
            "one_sided": Candidate(brute_one_sided, one_sided),
        }
        ours, theirs = list(run(params)), list(run(params, **slots))
        assert len(ours) == len(theirs)
        for one, two in zip(ours, theirs, strict=True):
            np.testing.assert_allclose(two.left.flow.p_moving, one.left.flow.p_moving, atol=1e-9)
            np.testing.assert_allclose(two.right.flow.p_moving, one.right.flow.p_moving, atol=1e-9)
            assert two.right.numbers.earth_movers == pytest.approx(one.right.numbers.earth_movers, rel=1e-9)

    def test_a_wrong_chamfer_leads_the_left_flow_elsewhere(self):
        params = Params(points=20, steps=6)
        wrong = list(run(params, chamfer=brute_one_sided))
        as_one_sided = list(run(replace(params, lowers="source to target")))
        for one, two in zip(wrong, as_one_sided, strict=True):
            np.testing.assert_allclose(one.left.flow.p_moving, two.left.flow.p_moving, atol=1e-5)
        ours = list(run(params))
        assert np.abs(wrong[-1].left.flow.p_moving - ours[-1].left.flow.p_moving).max() > 0.1
        assert wrong[-1].right.flow.value == pytest.approx(ours[-1].right.flow.value)

    def test_a_wrong_earth_movers_leads_the_right_flow_elsewhere(self):
        params = Params(points=20, steps=40)
        ours, wrong = list(run(params)), list(run(params, earth_movers=by_index))
        assert np.abs(wrong[-1].right.flow.p_moving - ours[-1].right.flow.p_moving).max() > 0.5
        home = wrong[-1].right.flow.p_moving - wrong[-1].clouds.p_target  # every point to the one with its own index
        assert np.linalg.norm(home, axis=1).max() < 0.3
        assert wrong[-1].right.flow.value < 0.1 < ours[-1].right.numbers.index_mse

    @pytest.mark.parametrize("lowers", ["source to target", "target to source"])
    def test_one_sided_drives_the_left_flow_where_it_lowers_one_side(self, lowers):
        params = Params(points=20, steps=5, lowers=lowers)
        ours, right = list(run(params)), list(run(params, one_sided=brute_one_sided))
        wrong = list(run(params, one_sided=lambda p_a, p_b: brute_one_sided(p_b, p_a)))
        other = list(run(replace(params, lowers=OTHER_SIDE[lowers])))
        for one, two, three, four in zip(ours, right, wrong, other, strict=True):
            np.testing.assert_allclose(two.left.flow.p_moving, one.left.flow.p_moving, atol=1e-9)
            np.testing.assert_allclose(three.left.flow.p_moving, four.left.flow.p_moving, atol=1e-5)
        assert np.abs(ours[-1].left.flow.p_moving - other[-1].left.flow.p_moving).max() > 0.05

    @pytest.mark.parametrize("name", ["unequal", "doubled"])
    def test_a_right_answer_flows_as_ours_does_where_counts_differ(self, name):
        params = replace(lesson.preset(name).params, steps=4)
        ours, theirs = list(run(params)), list(run(params, earth_movers=earth_movers_of_copies))
        assert len(ours[0].clouds.p_source) != len(ours[0].clouds.p_target)
        for one, two in zip(ours, theirs, strict=True):
            np.testing.assert_allclose(two.right.flow.p_moving, one.right.flow.p_moving, atol=1e-9)
        left_out = list(run(params, earth_movers=points_left_out))
        assert left_out[0].right.flow.value < 0.9 * ours[0].right.flow.value


OTHER_SIDE: dict[Lowers, Lowers] = {
    "source to target": "target to source",
    "target to source": "source to target",
}


def brute_one_sided(p_a, p_b):
    return float(np.mean(np.min(np.sum((p_a[:, None] - p_b) ** 2, axis=2), axis=1)))


def brute_chamfer(p_a, p_b):
    return brute_one_sided(p_a, p_b) + brute_one_sided(p_b, p_a)


def plain_earth_movers(p_a, p_b):
    D = np.linalg.norm(p_a[:, None] - p_b, axis=2)
    return float(D[scipy.optimize.linear_sum_assignment(D)].mean())


def by_index(p_a, p_b):
    return float(np.linalg.norm(p_a - p_b, axis=1).mean()) if len(p_a) == len(p_b) else 1.0


class TestPicture:
    def test_both_matchings_are_drawn_where_the_clouds_are(self):
        params = Params()
        state, shown = states(params)[8], scene(params, 8)
        p, p_target = state.left.flow.p_moving, state.clouds.p_target
        there = shown["left/to target"].ends
        assert np.array_equal(there[:, 0], p)
        np.testing.assert_allclose(
            np.linalg.norm(there[:, 1] - there[:, 0], axis=1), scipy.spatial.distance.cdist(p, p_target).min(axis=1)
        )
        back = shown["left/to source"].ends
        assert np.array_equal(back[:, 0], p_target)
        np.testing.assert_allclose(
            np.linalg.norm(back[:, 1] - back[:, 0], axis=1), scipy.spatial.distance.cdist(p, p_target).min(axis=0)
        )
        pairs = shown["right/pairs"].ends
        assert np.linalg.norm(pairs[:, 1] - pairs[:, 0], axis=1).mean() == pytest.approx(state.right.flow.value)
        assert {tuple(q) for q in pairs[:, 1]} == {tuple(q) for q in p_target}
        for path, primitive in shown.items():
            if path.startswith(("left/", "right/")) and not isinstance(primitive, (Scalar, Curve)):
                T = T_WORLD_LEFT if path.startswith("left/") else T_WORLD_RIGHT
                assert np.array_equal(primitive.T_world_object, T), path

    def test_the_target_is_sent_once(self):
        params = Params()
        assert scene(params, 0)["left/target"].p is scene(params, 9)["right/target"].p

    def test_only_the_side_that_is_lowered_is_drawn(self):
        assert "left/to source" not in scene(Params(lowers="source to target", steps=2), 1)
        assert "left/to target" not in scene(Params(lowers="target to source", steps=2), 1)

    def test_idle_points_are_marked_and_the_busiest_is_named(self):
        params = lesson.preset("idle").params
        shown = scene(params, -1)
        assert np.count_nonzero(shown["left/source"].color.ids) == 71
        served = states(params)[-1].left.served.max()
        assert shown["left/busiest word"].text == f"nearest of {served} target points"

    def test_bars_count_every_point(self):
        shown = scene(Params(), 8)
        assert shown["left/served"].y.sum() == shown["right/served"].y.sum() == 80
        assert np.vdot(shown["right/served"].x, shown["right/served"].y) <= 80

    def test_tables_hold_every_number(self):
        table = scene(Params(), 8)["numbers"]
        assert isinstance(table, Table)
        names = " ".join(row[0] for row in table.rows)
        for word in ("mean of squares", "sum of squares", "sum of distances", "only source", "only target", "exact",
                     "Sinkhorn, blur 0.05 m", "Hausdorff", "F-score", "index"):  # fmt: skip
            assert word in names
        assert len(scene(Params(), 8)["yardsticks"].rows) == 5

    def test_captions_say_both_changes(self):
        text = timeline(Params())[8].caption.text
        before, now = states(Params())[7], states(Params())[8]
        assert f"{squared(before.left.numbers.chamfer)} → {squared(now.left.numbers.chamfer)}" in text
        assert f"{metres(before.right.numbers.earth_movers)} → {metres(now.right.numbers.earth_movers)}" in text
        assert timeline(Params())[-1].caption.tone == "wrong"
        assert timeline(Params(start="larger", amount=0.05))[-1].caption.tone == "good"

    def test_an_end_state_that_covers_its_target_looks_covered(self):
        """Every target point's disc has a source dot in it, drawn smaller and nearer to the viewer: a dot in a ring."""
        last = states(Params())[-1].right
        shown = scene(Params(), -1)
        target, source = shown["right/target"], shown["right/source"]
        assert source.radius < 0.6 * target.radius
        assert (source.p[:, 1] < target.p[:, 1].min() - 0.01).all()
        seen = np.linalg.norm(
            (source.p - target.p[last.matching.i_b[np.argsort(last.matching.i_a)]])[:, [0, 2]], axis=1
        )
        assert np.mean(seen < target.radius - source.radius) == pytest.approx(1 - last.numbers.astray, abs=0.03)

    def test_clumps_look_like_clumps(self):
        shown, p = scene(Params(), -1), states(Params())[-1].left.flow.p_moving
        discs = [primitive for path, primitive in shown.items() if path.startswith("left/clumps")]
        dot = shown["left/source"].radius
        area = sum(len(disc.p) * (disc.radius / dot) ** 2 for disc in discs)
        shared = (scipy.spatial.distance.cdist(p, p) < 1e-3).sum(axis=1) > 1
        assert shared.sum() <= area <= 2 * shared.sum()  # an area for each point, rounded up to a power of two
        assert shared.sum() > 40
        assert not [path for path in shown if path.startswith("right/clumps")]

    def test_points_that_share_a_place_do_not_fight_for_depth(self):
        state, shown = states(Params())[-1], scene(Params(), -1)
        heights = [shown[f"left/{name}"].p[:, 1] for name in ("target", "source", "clumps of 8")]
        idle = state.left.served == 0
        levels = [heights[1][~idle], heights[1][idle], heights[2], heights[0]]
        assert all(front.max() < behind.min() - 1e-3 for front, behind in itertools.pairwise(levels))

    def test_numbers_never_have_an_exponent(self):
        assert [squared(x) for x in (99.96, 3243.0, 0.0, 2.34, 9.96)] == [
            "100 m²",
            "3,200 m²",
            "0 m²",
            "2.3 m²",
            "10 m²",
        ]

    def test_a_run_that_ends_far_from_home_is_not_called_good(self):
        assert timeline(Params(steps=3))[-1].caption.tone == "info"


class TestOwnClouds:
    def write(self, folder, name, p):
        np.savetxt(folder / name, p)
        return folder / name

    def test_two_files_are_scaled_together(self, tmp_path):
        rng = np.random.default_rng(0)
        p = 500.0 + 100.0 * rng.random((300, 3))
        target, source = (
            self.write(tmp_path, "a.xyz", p),
            self.write(tmp_path, "b.xyz", p[:200] + np.array([30.0, 0, 0])),
        )
        params = Params(target=target, source=source, points=50, source_points=40, steps=5)
        found = states(params)
        clouds = found[0].clouds
        assert clouds.p_target.shape == (50, 3)
        assert clouds.p_source.shape == (40, 3)
        assert np.abs(clouds.p_target).max() < 1.1
        assert clouds.scale == pytest.approx(2 / 96, rel=0.05)
        assert clouds.p_source[:, 0].mean() - clouds.p_target[:, 0].mean() == pytest.approx(30 * clouds.scale, abs=0.2)
        assert "b.xyz" in timeline(params)[0].caption.text
        assert "unit of your files" in timeline(params)[0].caption.text

    @pytest.mark.parametrize("start", ["blob", "bunched", "part missing", "doubled points", "shuffled rows", "larger"])
    def test_an_own_target_takes_the_built_in_changes(self, tmp_path, start):
        target = self.write(tmp_path, "a.xyz", np.random.default_rng(1).normal(size=(60, 3)))
        for source_points in (0, 25):
            params = Params(target=target, start=start, amount=0.5, points=40, source_points=source_points, steps=3)
            assert len(states(params)) >= 1

    def test_equal_points_do_not_divide_by_zero(self, tmp_path):
        target = self.write(tmp_path, "a.xyz", np.ones((20, 3)))
        assert states(Params(target=target, start="larger", steps=2))[0].left.numbers.chamfer == 0.0

    def test_trouble_is_one_clear_line(self, tmp_path):
        with pytest.raises(InputError, match="needs an own target"):
            clouds_of(Params(source=tmp_path / "b.xyz"))
        with pytest.raises(InputError, match=r"a\.xyz"):
            clouds_of(Params(target=tmp_path / "a.xyz"))
        bad = self.write(tmp_path, "nan.xyz", np.full((5, 3), np.nan))
        with pytest.raises(InputError, match=r"nan\.xyz"):
            clouds_of(Params(target=bad))

    def test_two_real_scans(self, shared_data):
        folder = shared_data / "icp"
        params = Params(target=folder / "bun000.ply", source=folder / "bun045.ply", points=100, steps=20)
        first, last = states(params)[0], states(params)[-1]
        assert last.right.numbers.earth_movers < 0.3 * first.right.numbers.earth_movers
        assert last.left.numbers.chamfer < 0.3 * first.left.numbers.chamfer


@pytest.mark.parametrize("shape", ["ring", "two discs", "spiral", "sphere", "torus"])
def test_on_every_shape_only_one_flow_spreads(shape):
    last = states(Params(shape=shape, points=60))[-1]
    assert last.left.numbers.astray > 0.4
    assert last.right.numbers.astray < 0.05


@pytest.mark.parametrize("count", [1, 2, 37, 200])
def test_any_number_of_source_points(count):
    found = list(run(Params(source_points=count, points=20, steps=2)))
    assert len(found[0].left.flow.p_moving) == count
