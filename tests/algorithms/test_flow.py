import itertools
from functools import partial

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from workbench.algorithms.flow import Stop, flow, numeric_gradient, polyak_length, rms
from workbench.algorithms.transport import earth_movers, earth_movers_gradient
from workbench.geometry.shape_distances import chamfer, chamfer_gradient

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
@given(seeds, st.integers(1, 15))
def test_the_distance_falls_at_every_step(name, seed, n):
    p_a, p_b = clouds(seed, n, n)
    distance, gradient = BOTH[name]
    states = list(flow(p_a, p_b, distance, gradient, max_steps=25))
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


@few
@given(seeds, st.integers(2, 12))
def test_earth_movers_brings_every_point_home(seed, n):
    p_a, p_b = clouds(seed, n, n)
    distance, gradient = BOTH["earth mover's"]
    *_, last = flow(p_a, p_b, distance, gradient, max_steps=300)
    assert last.value < 0.02 * earth_movers(p_a, p_b)


def test_chamfer_settles_with_points_left_over():
    # two moving points are at the right target, so that one must serve both on the left: no point may change sides
    p_b = np.array([[-1.0, 0, 0], [1, 0, 0], [10, 0, 0]])
    p_a = np.array([[0.1, 0, 0], [9.9, 0, 0], [10.2, 0, 0]])
    distance, gradient = BOTH["chamfer"]
    *_, last = flow(p_a, p_b, distance, gradient, max_steps=2000)
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
    here = [state.p_moving for state in flow(p_a, p_b, distance, gradient, max_steps=10)]
    there = [state.p_moving for state in flow(p_a + v, p_b + v, distance, gradient, max_steps=10)]
    np.testing.assert_allclose(np.array(there) - v, np.array(here), atol=1e-9)


@pytest.mark.parametrize("name", BOTH)
def test_a_distance_without_gradient_flows_the_same_way(name):
    p_a, p_b = clouds(5, 10, 10)
    p_a[:, 1] = p_b[:, 1] = 0.7  # in a plane
    distance, gradient = BOTH[name]
    ours = [state.p_moving for state in flow(p_a, p_b, distance, gradient, max_steps=8)]
    numeric = [state.p_moving for state in flow(p_a, p_b, distance, partial(numeric_gradient, distance), max_steps=8)]
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
        states = list(flow(p, p[::-1].copy(), distance, gradient))
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
    states = list(flow(p_a, p_b, distance, gradient, max_steps=3, longest_step=0.01))
    assert len(states) == 4
    assert states[-1].stop is Stop.MAX_STEPS
    with pytest.raises(ValueError, match="positive"):
        list(flow(p_a, p_b, distance, gradient, longest_step=0.0))
