import itertools

import numpy as np
import pytest
import scipy
from hypothesis import given, settings
from hypothesis import strategies as st

from workbench.algorithms.transport import (
    FEW_COPIES,
    best_assignment,
    best_matching,
    best_plan,
    best_plan_by_programme,
    blurred_earth_movers,
    blurred_potentials,
    earth_movers,
    earth_movers_gradient,
)
from workbench.algorithms.transport.flow import numeric_gradient
from workbench.geometry.motions import apply, exp_so3, motion
from workbench.geometry.points.shape_distances import nearest_both_ways

few = settings(max_examples=25, deadline=None)
seeds = st.integers(0, 10_000)
counts = st.integers(1, 40)


def clouds(seed, n, m):
    rng = np.random.default_rng(seed)
    return rng.normal(size=(n, 3)), rng.normal(size=(m, 3)) + 0.5


def optimum(p_a, p_b):
    D = scipy.spatial.distance.cdist(p_a, p_b)
    return D[scipy.optimize.linear_sum_assignment(D)].mean()


@few
@given(seeds, counts)
def test_small_clouds_reach_the_assignment_optimum(seed, n):
    p_a, p_b = clouds(seed, n, n)
    assert earth_movers(p_a, p_b) == pytest.approx(optimum(p_a, p_b), rel=1e-12)


def sphere_and_blob(rng, n):
    v = rng.normal(size=(n, 3))
    return v / np.linalg.norm(v, axis=1, keepdims=True), 1 + 0.1 * rng.normal(size=(n, 3))


def ring_and_line(rng, n):
    t = rng.uniform(0, 2 * np.pi, n)
    return np.column_stack([np.cos(t), np.sin(t), 0 * t]), np.column_stack([t, 0 * t, 0 * t])


def with_twins(rng, n):
    p = rng.integers(0, 6, (n, 3)).astype(float)
    return p, np.roll(p, 1, axis=1)


def far_away(rng, n):
    return rng.normal(size=(n, 3)), 1e5 + rng.normal(size=(n, 3))


def two_scales(rng, n):
    return rng.normal(size=(n, 3)) * np.logspace(-6, 3, n)[:, None], rng.normal(size=(n, 3))


@pytest.mark.parametrize("made", [sphere_and_blob, ring_and_line, with_twins, far_away, two_scales])
@pytest.mark.parametrize("n", [251, 400])
def test_subtracted_potentials_leave_the_optimum_exact(made, n):
    p_a, p_b = made(np.random.default_rng(n), n)
    assert earth_movers(p_a, p_b) == pytest.approx(optimum(p_a, p_b), rel=1e-12)


@pytest.mark.parametrize("relaxation", [1.0, 1.99])
def test_scalings_that_run_away_leave_the_optimum_exact(monkeypatch, relaxation):
    monkeypatch.setattr("workbench.algorithms.transport.exact._RELAXATION", relaxation)
    p_a, p_b = (
        np.random.default_rng(10).normal(size=(2, 400, 3)) + np.array([0.0, 0.3])[:, None, None]
    )
    assert np.isfinite(blurred_potentials(scipy.spatial.distance.cdist(p_a, p_b))).all()
    assert earth_movers(p_a, p_b) == pytest.approx(optimum(p_a, p_b), rel=1e-12)


def test_potentials_are_computed_only_where_they_pay(monkeypatch):
    computed = []
    monkeypatch.setattr(
        "workbench.algorithms.transport.exact.blurred_potentials",
        lambda cost: computed.append(len(cost)) or np.zeros(len(cost)),
    )
    rng = np.random.default_rng(0)
    p = rng.normal(size=(300, 3))
    near = (p + 0.02 * rng.normal(size=p.shape))[rng.permutation(len(p))]
    few = p[:150]
    crowd = 0.1 * few + 1.0  # most of its points have the same few partners cheapest
    for p_a, p_b, pays in (
        (p, near, False),
        (p, p + 0.5, True),
        (few, few + 0.5, False),
        (crowd, few, True),
        (crowd[:60], few[:60], False),
    ):
        computed.clear()
        assert earth_movers(p_a, p_b) == pytest.approx(optimum(p_a, p_b), rel=1e-12)
        assert bool(computed) is pays


def test_few_sweeps_are_enough_for_near_optimal_potentials():
    p_a, p_b = sphere_and_blob(np.random.default_rng(0), 300)
    D = scipy.spatial.distance.cdist(p_a, p_b)
    g = blurred_potentials(D)
    dual = (D - g).min(axis=1).mean() + g.mean()
    best = optimum(p_a, p_b)
    assert dual <= best  # weak duality
    assert dual > 0.999 * best


@few
@given(seeds, st.integers(1, 5))
def test_no_permutation_is_better(seed, n):
    p_a, p_b = clouds(seed, n, n)
    every = (
        np.linalg.norm(p_a - p_b[list(order)], axis=1).mean()
        for order in itertools.permutations(range(n))
    )
    assert earth_movers(p_a, p_b) == pytest.approx(min(every), rel=1e-12)


@few
@given(seeds, st.integers(1, 12), st.integers(1, 12))
def test_unequal_counts_agree_with_an_assignment_of_copies(seed, n, m):
    p_a, p_b = clouds(seed, n, m)
    copies = np.lcm(n, m)
    many_a, many_b = np.repeat(p_a, copies // n, axis=0), np.repeat(p_b, copies // m, axis=0)
    best = optimum(many_a, many_b)
    assert earth_movers(p_a, p_b) == pytest.approx(best, rel=1e-9)
    D = scipy.spatial.distance.cdist(p_a, p_b)
    assert np.vdot(best_plan_by_programme(D), D) == pytest.approx(best, rel=1e-9)


def test_counts_without_a_small_common_multiple_go_through_the_programme():
    p_a, p_b = clouds(0, 37, 41)
    assert np.lcm(37, 41) > FEW_COPIES
    best = best_matching(p_a, p_b)
    np.testing.assert_allclose(np.bincount(best.i_a, best.mass), 1 / 37, atol=1e-9)
    np.testing.assert_allclose(np.bincount(best.i_b, best.mass), 1 / 41, atol=1e-9)
    assert best.cost == pytest.approx(
        optimum(np.repeat(p_a, 41, axis=0), np.repeat(p_b, 37, axis=0)), rel=1e-9
    )


@pytest.mark.parametrize("made", [sphere_and_blob, ring_and_line, with_twins, far_away, two_scales])
@pytest.mark.parametrize(("n", "m"), [(83, 61), (40, 171)])
def test_pairs_that_a_programme_leaves_out_would_not_make_it_cheaper(monkeypatch, made, *, n, m):
    p_a, p_b = made(np.random.default_rng(n), max(n, m))
    D = scipy.spatial.distance.cdist(p_a[:n], p_b[:m])
    some = best_plan_by_programme(D)
    monkeypatch.setattr("workbench.algorithms.transport.exact._FEW_PAIRS", D.size)
    assert np.vdot(some, D) == pytest.approx(np.vdot(best_plan_by_programme(D), D), rel=1e-8)
    np.testing.assert_allclose(some.sum(axis=0), 1 / m, rtol=1e-9)
    np.testing.assert_allclose(some.sum(axis=1), 1 / n, rtol=1e-9)


@few
@given(seeds, counts, counts)
def test_every_point_gives_and_gets_its_share(seed, n, m):
    p_a, p_b = clouds(seed, n, m)
    best = best_matching(p_a, p_b)
    np.testing.assert_allclose(np.bincount(best.i_a, best.mass, minlength=n), 1 / n, atol=1e-9)
    np.testing.assert_allclose(np.bincount(best.i_b, best.mass, minlength=m), 1 / m, atol=1e-9)
    assert np.array_equal(
        best.distances, scipy.spatial.distance.cdist(p_a, p_b)[best.i_a, best.i_b]
    )


@few
@given(seeds, st.integers(1, 20))
def test_it_is_a_metric_that_moves_and_scales_with_the_clouds(seed, n):
    rng = np.random.default_rng(seed)
    a, b, c = rng.normal(size=(3, n, 3))
    T = motion(exp_so3(rng.normal(size=3)), rng.normal(size=3))
    assert earth_movers(a, a[rng.permutation(n)]) == 0.0
    assert earth_movers(b, a) == pytest.approx(earth_movers(a, b), rel=1e-12)
    assert earth_movers(a, c) <= earth_movers(a, b) + earth_movers(b, c) + 1e-12
    assert earth_movers(apply(T, a), apply(T, b)) == pytest.approx(earth_movers(a, b), rel=1e-9)
    assert earth_movers(2 * a, 2 * b) == pytest.approx(2 * earth_movers(a, b), rel=1e-12)
    v = rng.normal(size=3)
    assert earth_movers(a, a + v) == pytest.approx(np.linalg.norm(v), rel=1e-9)


@few
@given(seeds, counts)
def test_it_is_between_its_bounds(seed, n):
    p_a, p_b = clouds(seed, n, n)
    value = earth_movers(p_a, p_b)
    assert value >= np.linalg.norm(p_a.mean(axis=0) - p_b.mean(axis=0)) - 1e-12
    assert value >= nearest_both_ways(p_a, p_b).one_sided("mean of distances") - 1e-12


@pytest.mark.parametrize(("n", "m"), [(1, 1), (9, 9), (20, 20), (6, 9), (10, 4)])
def test_the_gradient_agrees_with_finite_differences(n, m):
    p_a, p_b = clouds(n, n, m)
    slope = earth_movers_gradient(p_a, p_b)
    np.testing.assert_allclose(slope, numeric_gradient(earth_movers, p_a, p_b), atol=1e-8)


def test_pairs_that_coincide_do_not_pull():
    p = np.random.default_rng(0).normal(size=(6, 3))
    assert earth_movers(p, p) == 0.0
    assert not earth_movers_gradient(p, p).any()


def test_blurred_transport_costs_more_and_converges_to_the_exact():
    p_a, p_b = clouds(0, 30, 24)
    exact = earth_movers(p_a, p_b)
    costs = [blurred_earth_movers(p_a, p_b, blur, tolerance=1e-7) for blur in (1.0, 0.1, 0.01)]
    assert costs[0] > costs[1] > costs[2] > exact
    assert costs[2] < 1.01 * exact


def test_bad_input_is_refused_in_words():
    p = np.ones((3, 3))
    with pytest.raises(ValueError, match="no points"):
        earth_movers(p, np.empty((0, 3)))
    with pytest.raises(ValueError, match="not finite"):
        earth_movers(p, np.full((3, 3), np.inf))
    with pytest.raises(ValueError, match="not 2 x 3"):
        best_assignment(np.ones((2, 3)))
    with pytest.raises(ValueError, match="501 and 500 points is too large"):
        best_plan(np.ones((501, 500)))
