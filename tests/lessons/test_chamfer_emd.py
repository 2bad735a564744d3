"""The lesson on Chamfer and earth mover's: every claim of its page, presets and questions in
numbers, its runs on every shape, and its stages that a hand goes through.
"""

import numpy as np
import pytest
import scipy

from lessons.chamfer_emd.clouds import YARDSTICKS
from lessons.chamfer_emd.inputs import Input
from lessons.chamfer_emd.lesson import lesson, setup
from lessons.chamfer_emd.panels import metres, squared
from lessons.chamfer_emd.point_sets import bunched
from lessons.chamfer_emd.presets import ONE_WAY, ROWS
from lessons.chamfer_emd.questions import QUESTIONS, nearer_side
from lessons.chamfer_emd.state import State
from lessons.chamfer_emd.twelve import ring
from tests.lessons.chamfer_emd_runs import flows, held, line, preset, states, timeline
from workbench.algorithms.transport.flow import Stop, flow
from workbench.geometry.points.shape_distances import chamfer


def flips(state: State) -> bool:
    """Whether Chamfer and earth mover's rank the cloud and the target 5 % larger differently."""
    numbers = state.left.numbers
    larger = state.yardsticks["5 % larger"]
    return (numbers.chamfer < larger.chamfer) != (numbers.earth_movers < larger.earth_movers)


class TestPresets:
    def test_clump(self):
        steps = preset("clump")
        first = steps[0]
        last = steps[-1]
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
        numbers = first.left.numbers
        larger = first.yardsticks["5 % larger"]
        assert (squared(numbers.chamfer), squared(larger.chamfer)) == ("0.0039 m²", "0.0050 m²")
        assert (metres(numbers.earth_movers), metres(larger.earth_movers)) == ("0.98 m", "0.050 m")
        assert numbers.hausdorff < 0.1  # a few points keep every gap short
        assert "flips" in timeline(lesson.preset("flip").params)[0].caption.text

    def test_larger(self):
        numbers = preset("larger")[0].left.numbers
        assert numbers.chamfer == pytest.approx(2 * 0.05**2)
        assert numbers.earth_movers == pytest.approx(0.05)
        assert not flips(preset("larger")[0])

    def test_bump(self):
        first = preset("bump")[0]
        numbers = first.left.numbers
        larger = first.yardsticks["5 % larger"]
        assert squared(numbers.chamfer) == squared(larger.chamfer) == "0.0050 m²"
        assert metres(numbers.earth_movers) == "0.019 m"
        assert "0.019" in line("bump")
        assert numbers.hausdorff == pytest.approx(0.147)
        assert "0.147" in line("bump")
        assert larger.hausdorff == pytest.approx(0.05)

    def test_missing(self):
        steps = preset("missing")
        numbers = steps[0].left.numbers
        last = steps[-1].left
        assert numbers.to_target == 0.0
        assert squared(numbers.to_source) == "0.39 m²"
        assert last.numbers.to_source < 0.01  # lowering both sides fills the missing part
        assert last.flow.p_moving[:, 0].max() > 0.9
        assert (
            steps[-1].right.numbers.earth_movers < 0.01 < 0.6 < steps[0].right.numbers.earth_movers
        )

    def test_one_way_from_the_source_sees_nothing_missing(self):
        steps = states(ONE_WAY)
        assert steps[0].left.flow.stop is Stop.ARRIVED
        assert np.array_equal(steps[-1].left.flow.p_moving, steps[0].left.flow.p_moving)

    def test_outlier(self):
        first = preset("outlier")[0]
        numbers = first.left.numbers
        larger = first.yardsticks["5 % larger"]
        assert numbers.hausdorff == pytest.approx(20 * larger.hausdorff) == pytest.approx(1.0)
        assert numbers.chamfer / larger.chamfer == pytest.approx(2.5, abs=0.05)
        assert numbers.earth_movers / larger.earth_movers == pytest.approx(0.25)
        assert numbers.earth_movers == pytest.approx(0.0125)
        assert round(100 * numbers.f_score) == 99

    def test_shuffled(self):
        numbers = preset("shuffled")[0].left.numbers
        assert (
            numbers.chamfer
            == numbers.earth_movers
            == numbers.hausdorff
            == numbers.to_target
            == numbers.to_source
            == 0.0
        )
        assert all(value == 0.0 for value in numbers.definitions.values())
        assert squared(numbers.index_mse) == "2.3 m²"
        assert len(preset("shuffled")) == 1

    def test_doubled(self):
        numbers = preset("doubled")[0].left.numbers
        assert numbers.chamfer == numbers.hausdorff == 0.0
        assert metres(numbers.earth_movers) == "0.21 m"
        assert np.isnan(numbers.index_mse)

    def test_idle(self):
        last = preset("idle")[-1].left
        assert np.count_nonzero(last.served == 0) == 71
        assert np.count_nonzero(last.served) == 9
        assert last.served.sum() == 80
        start = preset("idle")[0].left.flow.p_moving
        moved = np.linalg.norm(last.flow.p_moving - start, axis=1)[last.served == 0]
        assert np.median(moved) == 0.0

    def test_blurred(self):
        first = preset("blurred")[0].right
        last = preset("blurred")[-1].right
        assert (metres(first.sinkhorn), metres(first.numbers.earth_movers)) == ("0.99 m", "0.81 m")
        assert metres(last.sinkhorn) == "0.54 m"
        assert round(last.numbers.earth_movers, 3) == 0.004

    def test_unequal(self):
        steps = preset("unequal")
        last = steps[-1].right
        assert len(last.flow.p_moving) == 40
        assert np.all(np.bincount(last.matching.i_a) == 2)
        assert np.allclose(last.matching.mass, 1 / 80)
        assert np.median(last.matching.distances) == pytest.approx(0.039, abs=1e-3)
        assert last.matching.distances.max() < 0.05
        D = scipy.spatial.distance.cdist(last.flow.p_moving, steps[-1].clouds.p_target)
        assert 80 - len(scipy.optimize.linear_sum_assignment(D)[1]) == 40  # target points left out

    def test_sphere(self):
        last = preset("sphere")[-1]
        assert round(100 * last.left.numbers.out_of_place) == 72
        assert last.right.numbers.out_of_place < 0.02
        assert last.right.numbers.f_score > 0.98


class TestPage:
    """What page.md says."""

    def test_one_point_is_the_nearest_of_fifteen(self):
        steps = preset("clump")
        assert max(s.left.served.max() for s in steps) == 15
        assert steps[0].left.served.max() == 12
        assert all(len(np.unique(s.right.matching.i_b)) == 80 for s in steps)

    def test_a_hundredfold_and_half_out_of_place(self):
        steps = preset("clump")
        assert 100 < steps[0].left.numbers.chamfer / steps[-1].left.numbers.chamfer < 120
        assert steps[-1].left.numbers.out_of_place == pytest.approx(0.5, abs=0.05)

    def test_one_pair_of_clouds_has_four_chamfers(self):
        definitions = preset("clump")[-1].left.numbers.definitions
        shown = [f"{value:.2g}" for value in definitions.values()]
        assert shown == ["0.0096", "0.072", "0.77", "5.7"]
        assert all(number in lesson.text() for number in shown)

    def test_no_metric(self):
        zero = np.zeros((1, 3))
        pair = np.array([[0.0, 0, 0], [1, 0, 0]])
        unit = np.array([[1.0, 0, 0]])
        assert chamfer(zero, pair) + chamfer(pair, unit) < chamfer(zero, unit)

    def test_the_limit_of_places_is_the_default(self):
        assert Input().near == 0.1


@pytest.mark.parametrize(
    ("name", "right"),
    [
        ("whose-row", 0),
        ("predict-missing", 100),
        ("predict-flip", 1),
        ("predict-spread", 1),
        ("predict-outlier", 0),
        ("blurred-home", pytest.approx(0.54, abs=0.005)),
    ],
)
def test_questions_have_the_answer_that_the_run_gives(name, right):
    question = next(q for q in QUESTIONS if q.name == name)
    steps = timeline(question.params).states()
    assert question.answer(steps) == right
    assert any(character.isdigit() for character in question.why(steps))


def test_no_number_is_right_when_nothing_was_typed():
    for question in QUESTIONS:
        if not question.choices:
            assert abs(question.answer(timeline(question.params).states())) > question.tolerance


class TestRun:
    def test_both_flows_lower_their_own_distance(self):
        for name in ("clump", "idle", "unequal", "sphere"):
            steps = preset(name)
            assert np.all(np.diff([s.left.flow.value for s in steps]) <= 0)
            assert np.all(np.diff([s.right.flow.value for s in steps]) <= 0)

    def test_the_flow_that_ended_waits(self):
        steps = preset("doubled")
        ended = [s for s in steps if s.left.flow.stop and s.left.flow.step < s.step]
        assert ended
        assert all(s.left is ended[0].left for s in ended)
        assert [s.step for s in steps] == list(range(len(steps)))
        assert [s.last for s in steps] == [False] * (len(steps) - 1) + [True]

    def test_no_steps_is_a_picture_of_the_start(self):
        steps = states(Input(steps=0))
        assert len(steps) == 1
        assert steps[0].last

    def test_the_code_shown_is_the_flow(self):
        moment = timeline(Input())[5].moment
        assert moment is not None
        assert moment.function is getattr(flow, "__wrapped__", flow)

    def test_yardsticks_are_what_their_names_say(self):
        known = preset("clump")[0].yardsticks
        assert list(known) == [name for name, _, _ in YARDSTICKS]
        assert known["one point 3 m off"].hausdorff == pytest.approx(3.0)
        assert known["half missing"].to_target == 0.0
        assert known["rows shuffled"].chamfer == 0.0


@pytest.mark.parametrize("shape", ["ring", "two discs", "spiral", "sphere", "torus"])
def test_on_every_shape_only_one_flow_spreads(shape):
    last = states(Input(shape=shape, points=60))[-1]
    assert last.left.numbers.out_of_place > 0.4
    assert last.right.numbers.out_of_place < 0.05


@pytest.mark.parametrize("count", [1, 2, 37, 200])
def test_any_number_of_source_points(count):
    steps = flows(Input(source_points=count, points=20, steps=2))
    assert len(steps[0].left.flow.p_moving) == count


class TestByHand:
    """The stages that a hand goes through, held against whole distance matrices."""

    def both(self, p: np.ndarray, target: np.ndarray) -> tuple[float, float]:
        D = scipy.spatial.distance.cdist(p, target)
        i, j = scipy.optimize.linear_sum_assignment(D)
        return (D.min(axis=1) ** 2).mean() + (D.min(axis=0) ** 2).mean(), D[i, j].mean()

    def test_twelve_dots_on_a_heap(self):
        steps = held("twelve")
        assert [step.heaped for step in steps] == list(range(12))
        for step in steps:
            assert (step.chamfer, step.earth_movers) == pytest.approx(self.both(step.p, ring()))
        # 2, 1.5, ... m: chords of the unit circle, every 30 degrees
        chords = 2 * np.sin(np.radians(15) * np.arange(1, 12))
        assert steps[-1].earth_movers == pytest.approx(chords.sum() / 12)
        assert steps[1].chamfer == pytest.approx(chords[0] ** 2 / 12)

    def test_a_dragged_dot_answers_both_rules(self):
        far = states_of(Input(stage="twelve", dot=(0.0, 1.4)))[0]
        assert far.earth_movers == pytest.approx(0.4 / 12)
        assert far.chamfer == pytest.approx(2 * 0.4**2 / 12)
        inside = states_of(Input(stage="twelve", dot=(0.0, 0.0)))[0]
        assert inside.earth_movers == pytest.approx(1 / 12)
        chord = 2 * np.sin(np.radians(15))
        assert inside.chamfer == pytest.approx((1 + chord**2) / 12)

    def test_shuffled_rows_change_the_pairs_by_row_alone(self):
        in_order, shuffled, *_ = states_of(ROWS)
        assert in_order.by_row == 0.0
        assert (shuffled.chamfer, shuffled.earth_movers) == (0.0, 0.0)
        assert shuffled.by_row == pytest.approx(np.mean(np.sum((shuffled.p - ring()) ** 2, axis=1)))
        assert shuffled.by_row > 1
        assert sorted(map(tuple, shuffled.p)) == sorted(map(tuple, ring()))

    def test_a_bunch_is_closer_by_chamfer_until_over_four_fifths(self):
        steps = held("bunch")
        closer = {step.share: step.chamfer < step.larger_chamfer for step in steps}
        assert closer[0.8]
        assert not closer[0.85]
        assert all(step.earth_movers > step.larger_emd for step in steps if step.share >= 0.05)
        target = timeline(lesson.preset("bunch").params).states().subject.p_target
        by_count = {
            crowd: self.both(bunched("ring", 140, crowd / 140), target)
            for crowd in (5, 6, 114, 115)
        }
        assert by_count[114][0] < 0.005 < by_count[115][0], "at 82 %"
        assert by_count[5][1] < 0.05 < by_count[6][1], "from 4 % on"

    def test_a_far_dot_rules_the_largest_distance(self):
        target = timeline(lesson.preset("far-dot").params).states().subject.p_target
        for step in held("far-dot"):
            of_chamfer, of_emd = self.both(step.p, target)
            assert of_emd == pytest.approx(step.off / 80)
            assert step.times == pytest.approx([step.off / 0.05, of_chamfer / 0.005, of_emd / 0.05])
        assert held("far-dot")[10].times[1] == pytest.approx(2.5, abs=0.05)

    def test_blur_is_never_below_the_exact_distance(self):
        steps = held("blur")
        pairs = timeline(lesson.preset("blur").params).states().subject
        for step in steps:
            assert (step.costs >= pairs.exact - 1e-4).all()
            for plan in step.plans:
                assert plan.sum(axis=0) == pytest.approx(np.ones(80), abs=1e-9)
        assert np.all(np.diff([step.costs[1] for step in steps]) > 0)
        assert pairs.exact == pytest.approx([0.815, 0.00437], abs=1e-4 * 5)

    @pytest.mark.parametrize("stage", ["twelve", "bunch", "far-dot"])
    def test_a_students_functions_are_what_the_numbers_say(self, stage):
        params = lesson.preset(stage).params
        subject = setup(params)
        slots = {"chamfer": lambda p, q: 7.0, "earth_movers": lambda p, q: 3.0}
        ours, theirs = (list(lesson.run(params, subject, **given))[3] for given in ({}, slots))
        if stage == "far-dot":
            assert theirs.times[1:].tolist() == [1.0, 1.0] != ours.times[1:].tolist()
        else:
            assert (theirs.chamfer, theirs.earth_movers) == (7.0, 3.0)
            assert ours.chamfer != 7.0


def states_of(params: Input):
    return timeline(params).states()


def test_a_blur_of_two_metres_finds_home_farther_than_the_blob():
    """As the page says: with little blur the cloud at home is nearer, with the widest it is not."""
    held = tuple(lesson.form.states(Input(stage="blur")))
    assert held[-1].blur == 2.0
    assert held[0].costs[1] < held[0].costs[0]
    assert held[-1].costs[1] > held[-1].costs[0]
