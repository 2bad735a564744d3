"""ICP in the flat: the numbers of the story's first scenes, its landscape, and what is drawn of
it.
"""

from functools import cache
from typing import Any

import numpy as np
import pytest

from lessons.icp.flat import COST, FINE, outlines
from lessons.icp.inputs import Input
from lessons.icp.lesson import lesson, run, setup
from lessons.icp.presets import START
from tests.runs import finished
from workbench.algorithms.turning import cost, turned
from workbench.certain import sure
from workbench.run.questions import answer
from workbench.run.timeline import Timelines

TIMELINES = Timelines()


@cache
def states(name: str) -> Any:
    return finished(lesson.name, lesson.run_params(name)).states()


def scene(name: str, k: int) -> Any:
    return finished(lesson.name, lesson.run_params(name))[k].scene


def ends(start: float, **values: Any) -> Any:
    params = Input(stage="flat", start_angle=start, **values)
    *_, last = run(params, setup(params))
    return last


class TestNumbers:
    def test_from_45_it_comes_home(self):
        run_ = states("from-45")
        assert [round(-s.turned, 1) for s in run_[1:8:2]] == [2.4, 2.6, 2.7, 2.8]
        assert run_[-1].iteration == 19
        assert run_[-1].angle == pytest.approx(0.58, abs=0.01)
        assert 1000 * run_[-1].rmse == pytest.approx(18.4, abs=0.1)

    def test_from_75_it_ends_in_another_valley(self):
        last = states("from-75")[-1]
        assert last.angle == pytest.approx(94.6, abs=0.1)
        assert 1000 * last.rmse == pytest.approx(116, abs=0.5)

    def test_the_basin_is_what_the_runs_say(self):
        low, high = outlines(lesson.preset("from-45").params).basin
        assert (low, high) == (-50.0, 63.0)
        assert abs(ends(low).angle) < 5
        assert abs(ends(high).angle) < 5
        assert abs(ends(low - 1).angle) > 45
        assert abs(ends(high + 1).angle) > 45

    def test_the_rim_is_where_the_answer_says(self):
        lines = outlines(lesson.preset("from-45").params)
        right = np.where(FINE > 0, lines.rmse, 0)
        assert FINE[right.argmax()] == 68

    def test_lines_swing_farther_and_need_fewer_rounds(self):
        point, line = states("from-45"), states("lines-45")
        assert -line[1].turned == pytest.approx(6.7, abs=0.05)
        assert line[-1].iteration < point[-1].iteration / 2
        assert abs(line[-1].angle) < 1

    def test_far_from_home_lines_may_go_round_in_a_circle(self):
        assert ends(75.0, fit="point-to-plane").stop.name == "CIRCLING"

    def test_no_partner_lies_inside_the_circle(self):
        shown = scene("from-45", 0)
        lines = outlines(lesson.preset("from-45").params)
        ring = shown["ring/circle"].ends[:, 0][:, [0, 2]]
        middle = ring.mean(axis=0)
        radius = np.linalg.norm(ring[0] - middle)
        gaps = np.linalg.norm(lines.p_target - middle, axis=1)
        assert gaps.min() == pytest.approx(radius, rel=1e-3)
        assert "ring/circle" not in scene("from-45", 1)


class TestLandscape:
    def test_the_ball_is_on_the_curve_at_a_match_and_on_the_frozen_one_at_a_fit(self):
        for k in (0, 1, 2, 3, 20):
            shown = scene("from-45", k)
            ball = shown["cost/ball"]
            curve = shown["cost/" + ("frozen" if k % 2 else "curve")]
            assert np.interp(ball.x[0], curve.x, curve.y) == pytest.approx(ball.y[0], abs=0.5)

    def test_the_frozen_curve_is_nowhere_below_the_true_one(self):
        shown = scene("from-45", 0)
        frozen, true = shown["cost/frozen"], shown["cost/curve"]
        assert np.all(frozen.y >= np.interp(frozen.x, true.x, true.y) - 1e-9)

    def test_the_curve_is_the_cost_at_every_angle(self):
        lines = setup(lesson.preset("hand").params)
        for angle in (-120.0, 0.0, 77.0):
            y = scene("hand", 0)["cost/curve"].y[int(angle + 180)]
            assert y == pytest.approx(1000 * cost(lines.p_target, lines.p_source, angle))
        assert max(scene("hand", 0)["cost/curve"].y) < sure(COST.y_range)[1]

    def test_the_hand_begins_where_the_words_say(self):
        assert START == 38
        assert states("hand")[START].angle == -66
        assert scene("hand", START)["cost/ball"].steps == "angle"
        assert "cost/frozen" not in scene("hand", START)

    def test_the_drawing_turns_as_the_ball_moves(self):
        """Seen from +y, x runs to the left: a turn to the right is to the right on the chart."""
        shown = scene("from-45", 0)
        lines = outlines(lesson.preset("from-45").params)
        T = shown["source"].T_world_object
        p = shown["source"].p @ T[:3, :3].T + T[:3, 3]
        np.testing.assert_allclose(p[:, [0, 2]], turned(lines.p_source, 45.0), atol=1e-12)
        assert (T[:3, :3] @ [0.0, 0.0, 1.0])[0] < 0
        assert shown["cost/ball"].x[0] == 45


class TestQuestions:
    def test_their_answers(self):
        answers = {
            q.name: answer(lesson, q, None, timelines=TIMELINES) for q in lesson.questions[:3]
        }
        assert answers["how-many-now"].truth == "More than one"
        assert answers["predict-matches"].truth == "Fewer than one in ten"
        assert answers["where-it-rests"].value == pytest.approx(94.6, abs=0.1)
        assert "4 of 50" in answers["predict-matches"].why
