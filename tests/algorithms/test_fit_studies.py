"""Fits put to the test: repetition that agrees with a covariance, starts that are counted, medians,
angles.
"""

import numpy as np
import pytest

from lessons.fitting.fit_scenes import arc_points, errors
from lessons.fitting.fit_studies import (
    FATES,
    Basin,
    compare_circles,
    compare_lines,
    repeat_fit,
    try_starts,
)
from lessons.fitting.round_shapes import CIRCLE
from workbench.algorithms.least_squares import Descents, damped_step, descend
from workbench.geometry.shapes.circles_spheres import linearise_sphere


def ended(p: np.ndarray):
    *_, end = descend(
        lambda c: linearise_sphere(c, p), np.add, np.array([0.1, 0.1, 0.8]), damped_step=damped_step
    )
    return end


def test_repetition_agrees_with_the_covariance_where_errors_are_independent_and_not_where_they_are_alike():  # noqa: E501
    rng = np.random.default_rng(0)
    places = arc_points(np.pi, 60)
    end = ended(places + errors(rng, (60, 2), 0.02))
    ratios = []
    for kind in ("independent", "alike in neighbours"):
        first, last = repeat_fit(
            CIRCLE, end, places + errors(rng, (400, 60, 2), 0.02, kind=kind), counts=(400,)
        )
        assert len(first.radii) == 0
        assert first.sigma == pytest.approx(0.02, rel=0.25)
        ratios.append(last.radii.std() / np.sqrt(last.covariance[-1, -1]))
        assert last.wider == pytest.approx(ratios[-1], rel=0.12)
        assert np.ptp(last.predicted) == pytest.approx(2 * 1.645 * np.sqrt(last.covariance[-1, -1]))
        assert np.mean(last.predicted) == pytest.approx(abs(end.unknown[-1]))
        assert (
            (last.repeated[0] < last.radii) & (last.radii < last.repeated[1])
        ).mean() == pytest.approx(0.9, abs=0.01)
    assert ratios[0] == pytest.approx(1.0, abs=0.25)
    assert ratios[1] > 2


def test_without_a_covariance_nothing_is_repeated():
    p = arc_points(6.0, 3)
    assert list(repeat_fit(CIRCLE, ended(p), p[None], counts=(1,))) == []


def test_starts_are_shown_when_asked_and_at_the_end():
    p = arc_points(6.28, 40)
    starts = np.column_stack([np.linspace(-3, 3, 7), np.zeros(7), np.ones(7)])
    basins = list(try_starts(p, starts, np.array([0.0, 0.0, 1.0]), damping=1e-3, shown=(0, 2, 50)))
    assert [basin.now.iteration for basin in basins[:2]] == [0, 2]
    assert basins[-1].now.done.all()
    np.testing.assert_allclose(basins[-1].now.unknowns, np.tile([0, 0, 1], (7, 1)), atol=1e-6)
    assert basins[-1].share("comes home") == 1.0
    assert basins[0].share("under way") == 6 / 7  # one of them begins at home


def test_fates_are_told_by_the_circle_and_not_by_the_sign_of_its_radius():
    ends = np.array([[0, 0, -1], [0, 0, 1.5], [300, 0, 299], [2, 0, 1.0]])
    descents = Descents(5, ends, np.zeros(4), np.array([True, True, False, False]))
    basin = Basin(ends, np.array([0, 0, 1.0]), descents)
    assert [FATES[k] for k in basin.fates] == [
        "comes home",
        "away or lost",
        "away or lost",
        "under way",
    ]
    assert basin.share("away or lost") == 0.5


def test_circles_come_one_by_one_and_medians_arc_by_arc():
    p = arc_points(1.0, 30)
    states = list(compare_circles(p, iter([(90.0, p[None]), (45.0, p[None])])))
    assert [len(state.circles) for state in states] == [1, 2, 3, 4, 5, 5, 5]
    assert states[-1].arcs == (90.0, 45.0)
    np.testing.assert_allclose(states[-1].medians, 1.0, atol=1e-6)
    assert states[0].circles is not states[1].circles


def test_regression_is_too_flat_by_the_formula_and_perpendicular_distances_are_not():
    rng = np.random.default_rng(0)
    turn = np.radians(60)
    along = rng.uniform(-1, 1, 400)
    places = along[:, None] * [np.cos(turn), np.sin(turn)]
    *_, last = compare_lines(places, places + 0.1 * rng.normal(size=(200, 400, 2)))
    v = along.var() * np.cos(turn) ** 2
    medians = {name: float(np.median(angles)) for name, angles in last.angles.items()}
    assert medians["upright"] == pytest.approx(
        np.degrees(np.arctan(np.tan(turn) * v / (v + 0.01))), abs=0.2
    )
    assert medians["perpendicular"] == pytest.approx(60, abs=0.2)
    assert medians["level"] > 60.2
