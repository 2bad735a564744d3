import itertools
from functools import partial

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from workbench.algorithms.transport import best_matching, earth_movers, earth_movers_gradient
from workbench.algorithms.transport.flow import Stop, flow, numeric_gradient, polyak_length, rms
from workbench.geometry.points.shape_distances import chamfer, chamfer_gradient

few = settings(max_examples=10, deadline=None)
seeds = st.integers(0, 10_000)

BOTH = {
    "chamfer": (chamfer, chamfer_gradient),
    "earth mover's": (earth_movers, earth_movers_gradient),
}


def clouds(seed, n, m):
    rng = np.random.default_rng(seed)
    return 0.3 * rng.normal(size=(n, 3)), rng.normal(size=(m, 3))


@pytest.mark.parametrize("name", BOTH)
@few
@example(
    2800, 13
)  # beyond the kink Chamfer is steeper: a step along the mean would be longer than the longest
@given(seeds, st.integers(1, 15))
def test_the_distance_falls_at_every_step(name, seed, n):
    p_a, p_b = clouds(seed, n, n)
    distance, gradient = BOTH[name]
    states = list(flow(p_a, p_b, distance, gradient=gradient, max_steps=25))
    values = [state.value for state in states]
    assert np.all(np.diff(values) < 0)
    assert states[0].p_moving is p_a
    assert [state.step for state in states] == list(range(len(states)))
    assert [state.stop for state in states[:-1]] == [None] * (len(states) - 1)
    assert states[-1].stop is not None
    for before, after in itertools.pairwise(states):
        assert after.moved == pytest.approx(rms(after.p_moving - before.p_moving))
        assert after.moved <= 0.06 + 1e-12
        assert after.value == distance(after.p_moving, p_b)


def nearly_home(seed, n):
    """Targets four metres apart, each with a point at up to a metre, most of them much nearer; rows
    shuffled.

    The best matching is the one to the own target, and stays it while no point is farther than a
    metre from there.
    """
    rng = np.random.default_rng(seed)
    p_b = (
        4.0
        * rng.permutation(np.stack(np.meshgrid(*3 * [np.arange(3.0)]), axis=-1).reshape(-1, 3))[:n]
    )
    ways = rng.normal(size=(n, 3))
    ways /= np.linalg.norm(ways, axis=1, keepdims=True)
    return rng.permutation(p_b + 10 ** rng.uniform(-6, 0, (n, 1)) * ways), p_b


def settled_value(n):
    """The largest mean distance D at which an earth mover's flow of n points may settle: it goes on
    where 0.6 D is a step.

    A step takes every point that is not home the same way s: 0.6 times their mean distance, so that
    one of them at least has s to go. It is lowered in full, or by half of it with those that
    overshoot left out: then a root mean square of s / 2 over the root of n, at the least. That is
    no step where it is below 1e-5 m.
    """
    return 2e-5 * np.sqrt(n) / 0.6


@few
@given(seeds, st.integers(1, 12))
def test_earth_movers_brings_every_point_home(seed, n):
    # the largest distance falls by s / 2 in each step, or to s: by 3 cm, or a share of 0.3 / n, at
    # the least
    p_a, p_b = nearly_home(seed, n)
    distance, gradient = BOTH["earth mover's"]
    most_steps = 1 / 0.03 + np.log(settled_value(n) / (2 * n)) / np.log(1 - 0.3 / n)
    *_, last = flow(p_a, p_b, distance, gradient=gradient, max_steps=int(most_steps))
    assert last.stop is not Stop.MAX_STEPS
    assert last.value <= settled_value(n)


@pytest.mark.parametrize(("seed", "n"), [(995, 9), (20_046, 12), (20_450, 12)])
def test_earth_movers_brings_a_straggler_home(seed, n):
    # all points but one are home early on, and a plain step that is short enough for them takes the
    # last one nowhere
    p_a, p_b = clouds(seed, n, n)
    distance, gradient = BOTH["earth mover's"]
    *_, last = flow(p_a, p_b, distance, gradient=gradient, max_steps=300)
    assert last.stop is Stop.SETTLED
    assert last.value <= settled_value(n)


@few
@given(seeds, st.integers(1, 12))
def test_earth_movers_has_no_minimum_but_home(seed, n):
    # as far as the nearest point is from home, the distance falls along its slope in a straight
    # line
    p_a, p_b = clouds(seed, n, n)
    distance, gradient = BOTH["earth mover's"]
    for state in flow(p_a, p_b, distance, gradient=gradient, max_steps=25):
        squared = np.vdot(state.slope, state.slope)
        length = n * best_matching(state.p_moving, p_b).distances.min()
        lower = distance(state.p_moving - length * state.slope, p_b)
        assert lower <= state.value - length * squared + 1e-12


def test_chamfer_settles_with_points_left_over():
    # two moving points are at the right target, so that one must serve both on the left: no point
    # may change sides
    p_b = np.array([[-1.0, 0, 0], [1, 0, 0], [10, 0, 0]])
    p_a = np.array([[0.1, 0, 0], [9.9, 0, 0], [10.2, 0, 0]])
    distance, gradient = BOTH["chamfer"]
    *_, last = flow(p_a, p_b, distance, gradient=gradient, max_steps=2000)
    assert last.stop is Stop.SETTLED
    assert last.value > 0.5
    assert rms(last.slope) < 1e-3
    assert np.allclose(last.p_moving[1:], p_b[2], atol=0.01)
    assert earth_movers(last.p_moving, p_b) > 3.0


@pytest.mark.parametrize("name", BOTH)
def test_a_moved_scene_flows_the_same_way(name):
    p_a, p_b = clouds(4, 12, 12)
    distance, gradient = BOTH[name]
    v = np.array([3.0, -1.0, 2.0])
    here = [state.p_moving for state in flow(p_a, p_b, distance, gradient=gradient, max_steps=10)]
    moved = [
        state.p_moving
        for state in flow(p_a + v, p_b + v, distance, gradient=gradient, max_steps=10)
    ]
    np.testing.assert_allclose(np.array(moved) - v, np.array(here), atol=1e-9)


@pytest.mark.parametrize("name", BOTH)
def test_a_distance_without_gradient_flows_the_same_way(name):
    p_a, p_b = clouds(5, 10, 10)
    p_a[:, 1] = p_b[:, 1] = 0.7  # in a plane
    distance, gradient = BOTH[name]
    ours = [state.p_moving for state in flow(p_a, p_b, distance, gradient=gradient, max_steps=8)]
    numeric = [
        state.p_moving
        for state in flow(
            p_a, p_b, distance, gradient=partial(numeric_gradient, distance), max_steps=8
        )
    ]
    np.testing.assert_allclose(np.array(numeric), np.array(ours), atol=1e-5)


def test_numeric_gradient_of_a_known_function_leaves_its_input_alone():
    p_a, p_b = clouds(6, 5, 3)
    before = p_a.copy()
    slope = numeric_gradient(lambda p, q: float(np.sum(p**3) + np.sum(q)), p_a, p_b)
    np.testing.assert_allclose(slope, 3 * before**2, atol=1e-8)
    assert np.array_equal(p_a, before)


def test_equal_clouds_have_arrived():
    p, _ = clouds(7, 5, 5)
    for distance, gradient in BOTH.values():
        states = list(flow(p, p[::-1].copy(), distance, gradient=gradient))
        assert len(states) == 1
        assert states[0].stop is Stop.ARRIVED
        assert states[0].stop.message.startswith("arrived")


def test_polyak_goes_to_zero_of_a_cone_and_half_way_down_a_square():
    p = np.array([[3.0, 0, 4]])
    assert polyak_length(5.0, p / 5.0, 1.0) == pytest.approx(5.0)  # |p|, slope of length 1
    assert np.allclose(p - polyak_length(25.0, 2 * p, 1.0) * 2 * p, p / 2)
    assert polyak_length(5.0, np.zeros((1, 3)), 1.0) == 0.0


def test_the_limits_are_kept():
    p_a, p_b = clouds(8, 6, 6)
    distance, gradient = BOTH["earth mover's"]
    states = list(flow(p_a, p_b, distance, gradient=gradient, max_steps=3, longest_step=0.01))
    assert len(states) == 4
    assert states[-1].stop is Stop.MAX_STEPS
    with pytest.raises(ValueError, match="positive"):
        list(flow(p_a, p_b, distance, gradient=gradient, longest_step=0.0))
