"""Every claim of the fitting lesson in numbers: presets, questions and slots."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from lessons.fitting.lesson import lesson, run
from lessons.fitting.presets import ALIKE, EDGE, LARGE
from lessons.fitting.questions import iterations_to
from lessons.fitting.state import Params
from tests.lessons.fitting_runs import of, states
from tests.truths.fitting import cost, least, plane_error, straight, wider
from workbench.algorithms.least_squares import Stop, Walked
from workbench.errors import InputError
from workbench.geometry.shapes.circles_spheres import linearise_sphere
from workbench.scene import Segments, caption_of


def last(name: str) -> Any:
    return of(name)[-1].now


def moments(name: str) -> list[Any]:
    return [state.now.now for state in of(name) if isinstance(state.now, Walked)]


def tone(name: str) -> str:
    return caption_of(lesson.draw(of(name)[-1])).tone


# presets ------------------------------------------------------------------------------------------


def test_home_goes_down_and_says_what_it_is_worth():
    descent = moments("home")
    kept = [moment.cost for moment in descent if moment.phase in ("start", "accepted")]
    assert kept[:4] == pytest.approx([3.73, 1.04, 0.0379, 0.0320], rel=5e-3)
    assert descent[-1].iteration == 5
    assert descent[-1].unknown[2] == pytest.approx(1.019, abs=1e-3)
    assert kept[-1] == pytest.approx(least(of("home")[0]), rel=1e-4)
    assert np.sqrt(last("home").covariance[2, 2]) == pytest.approx(0.032, abs=1e-3)
    assert [moment.phase for moment in descent[:4]] == ["start", "linearised", "tried", "accepted"]
    assert of("home")[10].now.radii.size == 0  # where the page sends a reader for the covariance


def test_where_errors_are_independent_repetition_agrees():
    for name in ("home", "repetition", "sphere", "cylinder", "large-errors"):
        assert 0.75 < wider(of(name)[-1]) < 1.35
        assert tone(name) == "good"


def test_where_neighbours_err_alike_it_does_not():
    assert wider(of("alike")[-1]) == pytest.approx(3.7, abs=0.1)
    assert tone("alike") == "wrong"
    # where the preset opens
    assert "too narrow" not in caption_of(lesson.draw(of("alike")[10])).text


def test_on_twenty_degrees_radii_scatter_to_one_side():
    spread = last("twenty")
    low, high = np.percentile(spread.radii, [5, 95])
    assert (low, high) == (pytest.approx(0.53, abs=0.05), pytest.approx(8.0, abs=2.5))
    assert high - np.median(spread.radii) > 5 * (np.median(spread.radii) - low)
    assert tone("twenty") == "wrong"


def test_the_escape_is_a_straight_line_of_equal_cost():
    descent = moments("escape")
    p = of("escape")[0].subject.p
    assert (np.diff([moment.cost for moment in descent]) <= 0).all()
    assert descent[-1].unknown[2] > 40_000
    assert descent[-1].cost == pytest.approx(straight(p), rel=1e-3)
    assert descent[-1].cost > 15 * least(of("escape")[0])
    scene = lesson.draw(of("escape")[-1])
    line, circle = scene["straight"], scene["estimate"]
    assert isinstance(line, Segments)
    assert isinstance(circle, Segments)
    way = line.ends[0, 1] - line.ends[0, 0]
    across = np.array([-way[1], way[0], 0]) / np.linalg.norm(way)
    near = np.abs(circle.ends.reshape(-1, 3)[:, :2]).max(axis=1) < 3
    assert near.sum() > 20
    assert np.abs((circle.ends.reshape(-1, 3)[near] - line.ends[0, 0]) @ across).max() < 0.02
    assert tone("escape") == "wrong"


def test_undamped_it_jumps():
    """From one start: the first step of Gauss-Newton raises the sum eightfold, and in five the
    circle is a line.
    """
    kept = [moment for moment in moments("jumps") if moment.phase in ("start", "accepted")]
    assert [moment.cost for moment in kept[:4]] == pytest.approx(
        [147.8, 1198.6, 7.677, 6.385], rel=1e-3
    )
    assert kept[4].unknown[2] == pytest.approx(427e3, rel=2e-3)
    assert moments("jumps")[-1].stop is Stop.SINGULAR
    assert tone("jumps") == "wrong"


def test_damped_it_comes_home_from_there():
    end = next(moment for moment in moments("damped") if moment.stop)
    assert (end.iteration, end.stop) == (6, Stop.CONVERGED)
    assert end.cost == pytest.approx(0.0320, abs=5e-5)
    assert abs(moments("damped")[0].unknown - moments("jumps")[0].unknown).max() == 0.0


def test_a_radius_below_zero_is_nonsense_and_said_to_be():
    assert last("twenty").predicted[0] < 0
    assert (
        "The covariance said −0.229 m to 3.01 m" in caption_of(lesson.draw(of("twenty")[-1])).text
    )
    assert "no circle has a radius below 0" in caption_of(lesson.draw(of("twenty")[-1])).text


def share_home(name: str) -> float:
    basin = last(name)
    return float(
        (np.abs(np.abs(basin.now.unknowns) - np.abs(basin.best)).max(axis=1) < 0.02).mean()
    )


def test_basins():
    assert share_home("basin-full") == 1.0
    assert share_home("basin") == pytest.approx(0.6, abs=0.03)
    assert share_home("basin-jumps") < 0.33


def test_closed_forms_over_arcs():
    rivals = last("short-arc")
    kasa = dict(zip(rivals.arcs, (row[0] for row in rivals.medians), strict=True))
    assert [kasa[arc] for arc in (90, 60, 45, 30)] == pytest.approx(
        [0.96, 0.83, 0.60, 0.26], abs=0.02
    )
    others = np.array(
        [row[1:] for arc, row in zip(rivals.arcs, rivals.medians, strict=True) if arc >= 30]
    )
    assert np.abs(others - 1).max() < 0.05


def test_biases_all_round():
    rivals = last("bias")
    of_name = dict(zip(rivals.circles, rivals.medians[-1], strict=True))
    for name, theory in (("geometric", 0.005), ("Taubin", 0.010), ("Pratt", 0.020), ("Hyper", 0.0)):
        assert of_name[name] - 1 == pytest.approx(theory, abs=0.0017)


def test_a_coin():
    rivals = last("coin")
    of_name = dict(zip(rivals.circles, rivals.medians[-1], strict=True))
    assert of_name["Kåsa"] == pytest.approx(0.936, abs=0.01)
    assert of_name["Taubin"] == pytest.approx(0.992, abs=0.01)
    assert of_name["geometric"] == pytest.approx(0.995, abs=0.01)


def test_over_many_coins_kasas_is_small_and_the_others_are_not():
    coins = [
        (335, 43),
        (155, 51),
        (276, 52),
        (337, 125),
        (348, 186),
        (102, 196),
        (154, 198),
        (46, 260),
        (114, 266),
    ]
    medians = []
    for coin in coins:
        *_, end = run(Params(stage="coin", arc=60.0, coin=coin))
        assert not isinstance(end.now, Walked)
        medians.append(end.now.medians[-1])  # type: ignore[union-attr]
    kasa, _, taubin, _, geometric = np.median(medians, axis=0)
    assert kasa < 0.97
    assert abs(taubin - 1) < 0.025
    assert abs(geometric - 1) < 0.025


def test_a_line_by_three_distances():
    lines = last("line")
    assert np.median(lines.angles["upright"]) == pytest.approx(57.1, abs=0.6)
    assert np.median(lines.angles["perpendicular"]) == pytest.approx(60, abs=0.5)
    assert np.median(lines.angles["level"]) > 60.3


def test_the_plane_turns_on_edge_above_a_quarter():
    tilts = {}
    for share in (0.15, 0.3):
        *_, end = run(replace(EDGE, outliers=share))
        tilts[share] = np.degrees(np.arccos(abs(end.now.now.estimate[2])))  # type: ignore[union-attr]
    assert tilts[0.15] < 20
    assert tilts[0.3] > 60
    assert plane_error(last("edge-on").now.estimate) == pytest.approx(0.59, abs=0.01)


def test_losses_on_one_plane():
    errors = {
        name: 1e3 * plane_error(last(name).now.estimate) for name in ("drift", "tukey", "cascade")
    }
    assert errors == {
        "drift": pytest.approx(39.3, abs=0.5),
        "tukey": pytest.approx(157, abs=1),
        "cascade": pytest.approx(2.4, abs=0.1),
    }
    assert 1e3 * of("drift")[-1].plane_errors[1] == pytest.approx(132, abs=1)
    assert [tone(name) for name in ("drift", "tukey", "cascade", "edge-on")] == [
        "wrong",
        "wrong",
        "good",
        "wrong",
    ]


def test_gauss_newton_is_quick_where_residuals_are_small():
    little = replace(LARGE, noise=Params().noise)
    small, large = (
        [np.abs(moment.unknown - descent[0].subject.best).max() for moment in kept(descent)]
        for descent in (states(little), states(LARGE))
    )
    assert small[3] / small[2] < 0.005
    assert 0.05 < large[4] / large[3] < 0.4
    assert 0.05 < large[5] / large[4] < 0.4
    assert iterations_to(states(little), 1e-5) == 3


def kept(descent: tuple[Any, ...]) -> list[Any]:
    return [
        s.now.now
        for s in descent
        if isinstance(s.now, Walked) and s.now.now.phase in ("start", "accepted")
    ]


def test_runs_are_short():
    assert all(len(of(preset.name)) < 60 for preset in lesson.presets)


# questions ----------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "answer", "within"),
    [
        ("predict-kasa", 0.60, 0.01),
        ("predict-end", 2, 0),
        ("predict-iterations", 6, 0),
        ("predict-slope", 56.8, 0.1),
        ("predict-alike", 3.7, 0.1),
        ("predict-tukey", 2, 0),
    ],
)
def test_answers(name, answer, within):
    question = next(question for question in lesson.questions if question.name == name)
    assert question.answer(states(question.params)) == pytest.approx(answer, abs=within)


def test_answers_are_read_off_the_run():
    asked = {question.name: question for question in lesson.questions}
    assert asked["predict-end"].answer(of("home")) == 0
    assert asked["predict-tukey"].answer(of("cascade")) == 0
    assert asked["predict-tukey"].answer(of("drift")) == 1
    assert asked["predict-alike"].answer(
        states(replace(ALIKE, errors="independent"))
    ) == pytest.approx(0.82, abs=0.05)


# slots --------------------------------------------------------------------------------------------


def end_of(params: Params, **slots: Any) -> Any:
    walked = [state for state in run(params, **slots) if isinstance(state.now, Walked)]
    return walked[-1]


def test_a_wrong_linear_problem_ends_elsewhere():
    def squared(circle, p):
        v = p - circle[:2]
        return (v**2).sum(1) - circle[2] ** 2, np.column_stack(
            [-2 * v, np.full(len(p), -2 * circle[2])]
        )

    def uphill(circle, p):
        residuals, jacobian = linearise_sphere(circle, p)
        return residuals, -jacobian

    for wrong in (squared, uphill):
        end = end_of(Params(arc=45.0), circle_linearised=wrong)
        assert cost(end, end.now.now.unknown) > 1.05 * least(end)
        assert caption_of(lesson.draw(end)).tone != "good"
    kasa = end_of(Params(arc=45.0), circle_linearised=squared).now.now.unknown
    assert kasa[2] < 0.75


def test_a_wrong_step_is_taken_back_or_goes_astray():
    def up(residuals, jacobian, damping):
        return jacobian.T @ residuals

    end = end_of(Params(), damped_step=up).now.now
    assert end.cost == pytest.approx(3.73, abs=0.01)
    assert end.phase == "rejected"
    lost = end_of(Params(), damped_step=lambda r, J, d: np.full(3, np.nan))
    assert caption_of(lesson.draw(lost)).tone == "wrong"


def test_wrong_weights_show_in_the_plane():
    right = of("drift")[-1].plane_errors[0]
    *_, end = run(lesson.preset("drift").params, huber_weights=lambda r, c: c / np.maximum(r, c))
    assert abs(end.plane_errors[0] - right) > 0.01  # type: ignore[union-attr]
    with pytest.raises(InputError, match="nothing is left to fit"):
        list(run(lesson.preset("drift").params, huber_weights=lambda r, c: np.zeros(len(r))))
