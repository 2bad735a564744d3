import numpy as np
import pytest
import scipy
from hypothesis import given, settings
from hypothesis import strategies as st

from workbench.algorithms.transport import earth_movers
from workbench.algorithms.transport.sinkhorn import Stop, sinkhorn, sinkhorn_steps, tight_potentials

few = settings(max_examples=25, deadline=None)
seeds = st.integers(0, 10_000)


def costs(seed, n, m, *, offset=0.5):
    rng = np.random.default_rng(seed)
    return scipy.spatial.distance.cdist(rng.normal(size=(n, 3)), rng.normal(size=(m, 3)) + offset)


def log_domain(cost, regularisation, g, *, sweeps):
    """Sinkhorn's updates of the potentials themselves, Peyre and Cuturi 2019, equations 4.40 and
    4.41.
    """
    n, m = cost.shape
    f = np.zeros(n)
    for _ in range(sweeps):
        f = -regularisation * (
            scipy.special.logsumexp((g - cost) / regularisation, axis=1) + np.log(n)
        )
        g = -regularisation * (
            scipy.special.logsumexp((f[:, None] - cost) / regularisation, axis=0) + np.log(m)
        )
    return f, g


@few
@given(
    seed=seeds,
    n=st.integers(1, 20),
    m=st.integers(1, 20),
    regularisation=st.sampled_from([0.003, 0.05, 0.3, 2.0]),
)
def test_every_sweep_is_that_of_the_log_domain(seed, n, m, *, regularisation):
    cost = costs(seed, n, m)
    _, g = tight_potentials(cost, np.zeros(m))
    before = 0
    f = np.zeros(n)
    for state in sinkhorn_steps(cost, regularisation, max_sweeps=25, tolerance=0.0):
        f, g = log_domain(cost, regularisation, g, sweeps=state.sweep - before)
        before = state.sweep
        np.testing.assert_allclose(state.f, f, atol=1e-9)
        np.testing.assert_allclose(state.g, g, atol=1e-9)


@few
@given(seed=seeds, n=st.integers(1, 20), m=st.integers(1, 20), blur=st.floats(1, 5))
def test_the_plan_does_not_depend_on_the_start(seed, n, m, *, blur):
    # with as much blur as the largest cost a sweep shrinks Hilbert's distance of two scalings by
    # tanh(1/2)^2, below 1/4: Peyre and Cuturi 2019, theorem 4.1
    cost = costs(seed, n, m)
    regularisation = blur * cost.max()
    blurred = sinkhorn(cost, regularisation, tolerance=1e-13, max_sweeps=40)
    f, g = log_domain(cost, regularisation, np.random.default_rng(seed).normal(size=m), sweeps=40)
    np.testing.assert_allclose(
        blurred.plan(cost), np.exp((f[:, None] + g - cost) / regularisation), atol=1e-12
    )


@few
@given(
    seed=seeds,
    n=st.integers(1, 20),
    m=st.integers(1, 20),
    max_sweeps=st.sampled_from([3, 30, 10_000]),
)
def test_sums_are_as_right_as_it_says_and_the_cost_is_above_the_optimum(seed, n, m, *, max_sweeps):
    rng = np.random.default_rng(seed)
    p_a = rng.normal(size=(n, 3))
    p_b = rng.normal(size=(m, 3)) + 0.5
    cost = scipy.spatial.distance.cdist(p_a, p_b)
    blurred = sinkhorn(cost, 0.2, max_sweeps=max_sweeps)
    assert blurred.stop is (Stop.CONVERGED if blurred.marginal_error <= 1e-9 else Stop.MAX_SWEEPS)
    plan = blurred.plan(cost)
    assert np.abs(plan.sum(axis=1) - 1 / n).sum() == pytest.approx(
        blurred.marginal_error, abs=1e-12
    )
    np.testing.assert_allclose(plan.sum(axis=0), 1 / m, atol=1e-12)
    # what it costs at most to give all masses their place
    missing = 2 * blurred.marginal_error * cost.max()
    assert blurred.cost(cost) >= earth_movers(p_a, p_b) - missing - 1e-12


def test_less_blur_is_nearer_to_the_optimum():
    rng = np.random.default_rng(0)
    p_a = rng.normal(size=(60, 3))
    p_b = rng.normal(size=(60, 3)) + 0.5
    cost = scipy.spatial.distance.cdist(p_a, p_b)
    exact = earth_movers(p_a, p_b)
    excess = [
        sinkhorn(cost, blur, tolerance=1e-6).cost(cost) / exact - 1
        for blur in (1.0, 0.3, 0.1, 0.03, 0.01)
    ]
    assert np.all(np.diff(excess) < 0)
    assert excess[0] > 0.2
    assert 0 < excess[-1] < 0.002


def test_much_blur_is_the_plan_of_everyone_to_everyone():
    cost = costs(1, 8, 5)
    np.testing.assert_allclose(sinkhorn(cost, 1e6).plan(cost), 1 / 40, rtol=1e-4)


def test_scalings_that_would_overflow_are_absorbed():
    cost = costs(2, 30, 30, offset=100.0)  # exp(-cost / regularisation) is zero everywhere
    regularisation = 2e-3
    assert not np.exp(-cost / regularisation).any()
    blurred = sinkhorn(cost, regularisation, max_sweeps=20_000, tolerance=1e-6)
    assert np.isfinite(blurred.f).all()
    assert np.isfinite(blurred.g).all()
    assert blurred.marginal_error < 1e-3
    rows, columns = scipy.optimize.linear_sum_assignment(cost)
    assert blurred.cost(cost) == pytest.approx(cost[rows, columns].mean(), rel=1e-3)


def test_a_gradual_climb_of_the_scalings_is_absorbed():
    # a chain of points that must all shift by one: the potentials climb along it, beyond what exp
    # can hold
    cost = np.abs(np.arange(40.0)[:, None] - np.arange(40.0) - 0.9)
    blurred = sinkhorn(cost, 0.004, max_sweeps=3000, tolerance=1e-6)
    assert np.ptp(blurred.f) / blurred.regularisation > 1000
    plan = blurred.plan(cost)
    assert np.isfinite(plan).all()
    np.testing.assert_allclose(plan.sum(axis=0), 1 / 40, rtol=1e-6)
    assert blurred.stop is Stop.MAX_SWEEPS


def test_the_error_falls_and_the_last_state_says_why():
    cost = costs(3, 40, 50)
    states = list(sinkhorn_steps(cost, 0.05))
    assert [state.sweep for state in states] == list(range(10, 10 * len(states) + 1, 10))
    assert np.all(np.diff([state.marginal_error for state in states]) < 0)
    assert [state.stop for state in states[:-1]] == [None] * (len(states) - 1)
    assert states[-1].stop is Stop.CONVERGED
    assert "sum" in states[-1].stop.message
    assert sinkhorn(cost, 0.05, max_sweeps=7).stop is Stop.MAX_SWEEPS


@few
@given(seeds, st.integers(1, 10), st.integers(1, 10))
def test_potentials_are_tight(seed, n, m):
    cost = costs(seed, n, m)
    f, g = tight_potentials(cost, np.random.default_rng(seed).normal(size=m))
    slack = cost - f[:, None] - g
    assert slack.min() >= -1e-12
    np.testing.assert_allclose(slack.min(axis=0), 0, atol=1e-12)
    np.testing.assert_allclose(slack.min(axis=1), 0, atol=1e-12)


def test_bad_input_is_refused_in_words():
    with pytest.raises(ValueError, match="regularisation > 0"):
        sinkhorn(np.ones((2, 2)), 0.0)
    with pytest.raises(ValueError, match="0 x 3 has nothing"):
        sinkhorn(np.ones((0, 3)), 1.0)
    with pytest.raises(ValueError, match="not finite"):
        sinkhorn(np.full((2, 2), np.nan), 1.0)
    with pytest.raises(ValueError, match="too large"):
        sinkhorn(np.broadcast_to(np.ones(1), (10_000, 10_000)), 1.0)
