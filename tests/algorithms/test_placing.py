"""Points placed, walked, scattered and measured."""

import itertools

import numpy as np
import pytest

from lessons.coordinates.placing import measure, place, scatter, walk
from workbench.geometry.shapes.curvilinear import SYSTEMS


@pytest.mark.parametrize("name", sorted(SYSTEMS))
def test_three_coordinates_lead_from_the_origin_to_the_point(name):
    system = SYSTEMS[name]
    p = np.array([0.4, -0.7, 0.3])
    c = system.of_points(p[None])[0]
    states = list(place(c, system, 3))
    assert len(states) == 10
    np.testing.assert_array_equal(states[0].p, 0)
    np.testing.assert_allclose(states[-1].p, p)
    np.testing.assert_allclose(states[-1].c, c)
    for before, after in itertools.pairwise(states):
        assert (before.c != after.c).sum() == 1
        np.testing.assert_array_equal(after.path[: len(before.path)], before.path)


def test_a_walk_past_the_axis_turns_the_azimuth_and_puts_points_back():
    x = np.linspace(-1, 1, 9)
    p = np.column_stack([x, np.full(9, 1e-3), np.ones(9)])
    *_, last = walk(p, SYSTEMS["spherical"])
    assert np.ptp(last.c[:, 2]) > 3.13
    assert np.abs(np.diff(last.c[:, 1])).max() < 0.26
    assert last.misses.max() < 1e-12


@pytest.mark.parametrize(("even", "share"), [("angle", 1 / 3), ("area", 1 - np.cos(np.pi / 6))])
def test_even_angles_crowd_the_poles_and_even_heights_do_not(even, share):
    *_, last = scatter((10, 20_000), even, np.random.default_rng(0))
    assert (np.abs(last.p[:, 2]) > np.cos(np.pi / 6)).mean() == pytest.approx(share, abs=0.012)
    np.testing.assert_allclose(np.linalg.norm(last.p, axis=1), 1)


@pytest.mark.parametrize(("degrees", "short"), [(10, 0.15), (20, 0.59), (30, 1.28)])
def test_the_mean_of_bearings_is_short_of_the_point(degrees, short):
    *_, last = measure(
        10.0, np.radians(degrees), 0.02, counts=(200_000,), rng=np.random.default_rng(0)
    )
    assert 10 - last.mean[0] == pytest.approx(short, abs=0.01)
    assert 10 - last.expected[0] == pytest.approx(short, abs=0.005)
    assert last.debiased[0] == pytest.approx(10, abs=0.012)
    assert np.linalg.norm(last.polar_mean - last.true) < 0.03


def test_without_noise_the_mean_is_the_point():
    *_, last = measure(10.0, 0.0, 0.0, counts=(5,), rng=np.random.default_rng(0))
    np.testing.assert_allclose(last.mean, last.true)
