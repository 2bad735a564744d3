"""Ways over a globe against independent sums, and latitudes."""

import numpy as np
import pytest

from lessons.coordinates.voyages import to_the_pole, travel
from tests.truths.coordinates import apart, between_means, straight_over_shortest
from workbench.data.places import between_cities
from workbench.geometry.shapes.globe import PLANETS, great_circle_distance


@pytest.mark.parametrize(
    ("route", "more"),
    [("London – Los Angeles", 11.9), ("Frankfurt – Anchorage", 33.6), ("Tokyo – London", 18.8)],
)
def test_straight_on_the_map_is_longer(route, more):
    places = between_cities(route).degrees
    *states, middle = travel(places, 16, great_circle_distance)
    last = states[-1]
    assert 100 * (last.straight_length / last.circle_length - 1) == pytest.approx(more, abs=0.06)
    assert straight_over_shortest(places) == pytest.approx(
        last.straight_length / last.circle_length, abs=1e-4
    )
    assert last.circle_length == pytest.approx(last.direct, rel=1e-9)
    assert middle.apart == pytest.approx(between_means(places), rel=1e-6)
    for state in states[1:]:
        step = apart(state.circle[:-1], state.circle[1:])
        np.testing.assert_allclose(step, last.direct / 192, rtol=1e-6)


def test_the_mean_of_longitudes_is_across_the_world():
    *_, last = travel(between_cities("Suva – Apia").degrees, 4, great_circle_distance)
    assert last.apart / 1e3 == pytest.approx(16_455, abs=1)
    assert last.means is not None
    assert last.means[0][1] == pytest.approx(3.34, abs=0.01)


def test_whatever_measures_drives_the_ways():
    *states, _ = travel(
        np.array([[0.0, 0.0], [10.0, 0.0]]), 2, lambda a, b, radius: np.ones(len(a))
    )
    assert [state.circle_length for state in states] == [0, 12, 24]


def test_both_latitudes_agree_at_equator_and_pole():
    *_, last = to_the_pole(PLANETS["Saturn"], 18)
    np.testing.assert_allclose(last.apart[[0, -1]], 0, atol=1e-6)
    assert (last.apart[1:-1] > 0).all()
