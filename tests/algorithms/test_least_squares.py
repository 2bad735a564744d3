"""Descents: what each step promises, that damping never lets the sum rise, scipy's answers, and
ends that say why.
"""

import numpy as np
import pytest
import scipy
from hypothesis import given, settings
from hypothesis import strategies as st

from lessons.fitting.fit_scenes import arc_points
from tests.truths.fitting import straight
from workbench.algorithms.least_squares import (
    Stop,
    along_step,
    covariance,
    damped_step,
    descend,
    descend_many,
    with_its_way,
)
from workbench.geometry.shapes.circles_spheres import linearise_sphere

seeds = st.integers(0, 2**32 - 1)
HOME, BEYOND = np.array([0.5, 0.4, 0.7]), np.array([2.5, 0.0, 1.0])


def an_arc(seed: int, arc: float = 90.0, sigma: float = 0.02) -> np.ndarray:
    return arc_points(np.radians(arc), 60) + sigma * np.random.default_rng(seed).normal(
        size=(60, 2)
    )


def moments(p: np.ndarray, start: np.ndarray, damping: float = 1e-3, **more):
    return list(
        descend(
            lambda c: linearise_sphere(c, p),
            np.add,
            start,
            damped_step=damped_step,
            damping=damping,
            **more,
        )
    )


@settings(max_examples=25, deadline=None)
@given(seed=seeds)
def test_damped_the_sum_never_rises_and_every_ending_says_why(seed):
    rng = np.random.default_rng(seed)
    states = moments(
        an_arc(seed, rng.uniform(20, 360)), np.append(rng.uniform(-4, 4, 2), rng.uniform(0.1, 3))
    )
    assert (np.diff([state.cost for state in states]) <= 0).all()
    assert states[-1].stop is not None
    assert states[-1].stop.message
    assert all(state.stop is None for state in states[:-1])


@settings(max_examples=25, deadline=None)
@given(seed=seeds)
def test_a_step_solves_the_damped_system_by_longer_rows(seed):
    rng = np.random.default_rng(seed)
    r = rng.normal(size=12)
    J = rng.normal(size=(12, 4))
    damping = float(rng.uniform(0, 3))
    rows = np.vstack([J, np.sqrt(damping) * np.diag(np.linalg.norm(J, axis=0))])
    by_rows = np.linalg.lstsq(rows, np.append(-r, np.zeros(4)), rcond=None)[0]
    np.testing.assert_allclose(damped_step(r, J, damping), by_rows, atol=1e-8)


def test_a_step_keeps_its_digits_where_the_normal_matrix_would_lose_half_of_them():
    """Columns that differ by a millionth have JᵀJ with a condition of 10¹²; the step is exact here
    to nine digits.
    """
    rng = np.random.default_rng(0)
    a, b = rng.normal(size=20), rng.normal(size=20)
    J = np.stack([a, a + 1e-6 * b], axis=1)
    right = np.array([3.0, -2.0])
    np.testing.assert_allclose(damped_step(-J @ right, J, 0.0), right, rtol=1e-8)


def test_the_step_does_not_depend_on_units():
    rng = np.random.default_rng(0)
    r = rng.normal(size=12)
    J = rng.normal(size=(12, 3))
    units = np.array([1.0, 1000.0, 0.01])
    np.testing.assert_allclose(damped_step(r, J / units, 0.3), units * damped_step(r, J, 0.3))


def test_it_ends_where_scipy_ends():
    for seed in range(5):
        p = an_arc(seed)
        oracle = scipy.optimize.least_squares(
            lambda c, p=p: linearise_sphere(c, p)[0], HOME, xtol=1e-12, ftol=1e-12
        )
        end = moments(p, HOME, tolerance=1e-12)[-1]
        assert end.stop is Stop.CONVERGED
        np.testing.assert_allclose(end.unknown, oracle.x, atol=1e-6)


def test_the_escape_costs_what_the_best_straight_line_costs():
    for seed in range(4):
        p = an_arc(seed)
        end = moments(p, BEYOND)[-1]
        assert end.unknown[2] > 10_000
        assert straight(p) <= end.cost < 1.001 * straight(p)
        assert end.cost > 10 * moments(p, HOME)[-1].cost


def test_undamped_every_step_is_kept():
    states = moments(an_arc(3), BEYOND, 0.0)
    assert "rejected" not in {state.phase for state in states if state.stop is None}
    radii = [state.unknown[2] for state in states if state.phase == "accepted"]
    np.testing.assert_allclose(radii[:2], [7.0, 72.4], rtol=2e-3)


def test_what_was_promised_is_the_linear_problems_sum():
    p = an_arc(3)
    tried = next(state for state in moments(p, HOME) if state.phase == "tried")
    assert tried.step is not None
    along = along_step(tried, lambda c: linearise_sphere(c, p), np.add, shares=np.array([0.0, 1.0]))
    np.testing.assert_allclose(along.costs, [tried.before, tried.trial_cost])
    np.testing.assert_allclose(along.promised, [tried.before, tried.before - tried.predicted])
    assert tried.gain == pytest.approx((tried.before - tried.trial_cost) / tried.predicted)
    with pytest.raises(ValueError, match="no step"):
        along_step(
            moments(p, HOME)[0], lambda c: linearise_sphere(c, p), np.add, shares=np.array([1.0])
        )


def test_a_way_has_every_step_kept_and_every_one_taken_back():
    p = an_arc(0, 45.0)

    def linearise(c):
        return linearise_sphere(c, p)

    states = moments(p, np.array([0.9, 0.6, 0.3]))
    walked = list(with_its_way(iter(states), linearise, np.add, shares=np.linspace(0, 1, 3)))
    assert [moment.now for moment in walked] == states
    kept = [state.unknown for state in states if state.phase in ("start", "accepted")]
    back = [state.trial for state in states if state.phase == "rejected"]
    assert len(back) > 0
    np.testing.assert_array_equal(walked[-1].kept, kept)
    np.testing.assert_array_equal(walked[-1].taken_back, back)
    assert all((moment.along is not None) == (moment.now.phase == "tried") for moment in walked)
    assert walked[0].taken_back.shape == (0, 3)


def test_singular_and_infinite_ends_are_told():
    constant = lambda x: (np.ones(3), np.zeros((3, 1)))  # noqa: E731
    assert (
        list(descend(constant, np.add, np.zeros(1), damped_step=damped_step))[-1].stop
        is Stop.SINGULAR
    )

    def steep(x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        return np.exp(np.minimum(x, 800) ** 2) * np.ones(2), np.full((2, 1), 1e-3)

    assert (
        list(
            descend(
                steep,
                np.add,
                np.array([1.0]),
                damped_step=lambda r, J, d: np.array([900.0]),
                damping=0.0,
            )
        )[-1].stop
        is Stop.DIVERGED
    )
    assert moments(an_arc(0), HOME, iterations=1)[-1].stop is Stop.MAX_ITERATIONS


@pytest.mark.parametrize("damping", [1e-3, 0.0])
def test_many_go_as_each_alone(damping):
    p = an_arc(1, 360.0)
    rng = np.random.default_rng(5)
    starts = np.column_stack([rng.uniform(-0.6, 0.6, (6, 2)), rng.uniform(0.5, 1.5, 6)])
    *_, many = descend_many(lambda c: linearise_sphere(c, p), np.add, starts, damping=damping)
    assert many.done.all()
    for start, unknown, cost in zip(starts, many.unknowns, many.costs, strict=True):
        alone = moments(p, start, damping)[-1]
        np.testing.assert_allclose(unknown, alone.unknown, atol=1e-6)
        assert cost == pytest.approx(alone.cost)


def test_one_that_is_lost_leaves_the_others_alone():
    p = an_arc(1, 360.0)
    starts = np.array([[0.1, 0.0, 1.0], [np.nan, 0.0, 1.0], [1e140, 0.0, 1.0]])
    *_, many = descend_many(lambda c: linearise_sphere(c, p), np.add, starts, iterations=30)
    np.testing.assert_allclose(many.unknowns[0], [0, 0, 1], atol=0.02)


def test_the_covariance_is_scipys():
    p = an_arc(3)
    end = moments(p, HOME)[-1]
    x, y = np.zeros(60), np.zeros(60)
    model = lambda _, a, b, r: linearise_sphere(np.array([a, b, r]), p)[0]  # noqa: E731
    _, oracle = scipy.optimize.curve_fit(model, x, y, HOME)
    np.testing.assert_allclose(covariance(end.residuals, end.jacobian), oracle, rtol=1e-3)


def test_the_covariance_is_that_of_repetition_where_all_it_takes_for_granted_holds():
    rng = np.random.default_rng(0)
    places = arc_points(2 * np.pi, 60)
    p = places + 0.02 * rng.normal(size=(2000, 60, 2))
    *_, fits = descend_many(
        lambda c: linearise_sphere(c, p), np.add, np.tile([0.0, 0.0, 1.0], (2000, 1))
    )
    _, jacobian = linearise_sphere(np.array([0.0, 0.0, 1.0]), places)
    predicted = 0.02**2 * np.linalg.inv(jacobian.T @ jacobian)
    np.testing.assert_allclose(np.cov(fits.unknowns.T), predicted, atol=0.08 * predicted.max())


def test_n_less_k_and_not_n():
    """12 points of half a circle, σ = 0.02: the mean of r·r / 9 is σ², that of r·r / 12 is not."""
    rng = np.random.default_rng(1)
    p = arc_points(np.pi, 12) + 0.02 * rng.normal(size=(2000, 12, 2))
    *_, fits = descend_many(
        lambda c: linearise_sphere(c, p), np.add, np.tile([0.0, 0.0, 1.0], (2000, 1))
    )
    assert np.sqrt(fits.costs.mean() / 9) == pytest.approx(0.02, abs=3e-4)
    assert np.sqrt(fits.costs.mean() / 12) == pytest.approx(0.0173, abs=3e-4)


def test_too_few_points_or_a_flat_direction_have_no_covariance():
    assert np.isinf(covariance(np.zeros(3), np.eye(3))).all()
    assert np.isinf(covariance(np.ones(9), np.ones((9, 2)))).all()
