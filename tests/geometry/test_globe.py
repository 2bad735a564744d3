"""Distances, ways and means on a sphere; latitudes of a flattened globe."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from tests.truths.coordinates import apart
from workbench.geometry.shapes.globe import (
    EARTH_RADIUS,
    PLANETS,
    Ellipsoid,
    graticule,
    great_circle_distance,
    great_circle_places,
    mean_place,
    parallel,
    places_of_units,
    units_of_places,
)

LATITUDES, LONGITUDES = st.floats(-90, 90), st.floats(-180, 180)
PLACES = st.tuples(LATITUDES, LONGITUDES).map(np.array)
LONDON, LOS_ANGELES = np.array([51.5074, -0.1278]), np.array([34.0522, -118.2437])


def distance(a: np.ndarray, b: np.ndarray, radius: float = EARTH_RADIUS) -> float:
    return float(great_circle_distance(a[None], b[None], radius)[0])


@given(PLACES, PLACES, PLACES)
def test_it_is_a_metric_that_longitude_does_not_matter_to(a, b, c):
    assert distance(a, b, 1.0) == pytest.approx(distance(b, a, 1.0), abs=1e-12)
    assert distance(a, c, 1.0) <= distance(a, b, 1.0) + distance(b, c, 1.0) + 1e-12
    turn = np.array([0.0, 77.0])
    assert distance(a + turn, b + turn, 1.0) == pytest.approx(distance(a, b, 1.0), abs=1e-12)
    assert distance(a, a) == 0


@given(PLACES, PLACES)
def test_vectors_say_the_same(a, b):
    assert distance(a, b) == pytest.approx(float(apart(a, b)[0]), abs=1e-6)


def test_known_ways():
    assert distance(LONDON, LOS_ANGELES) / 1e3 == pytest.approx(8755.6, abs=0.1)
    assert distance(np.zeros(2), np.array([0.0, 180.0]), 1.0) == pytest.approx(np.pi)
    rng = np.random.default_rng(3)
    a = np.column_stack([rng.uniform(-90, 90, 200), rng.uniform(-180, 0, 200)])
    far = great_circle_distance(a, np.column_stack([-a[:, 0], a[:, 1] + 180]), 1.0)
    np.testing.assert_allclose(far, np.pi, atol=1e-14)


@pytest.mark.parametrize("metres", [1e-3, 0.1, 1.0, 1e3])
@pytest.mark.parametrize("course", [0.0, 0.7, np.pi / 2])
def test_short_ways_are_exact_where_the_law_of_cosines_is_not(metres, course):
    lat = np.radians(48.0)
    step = np.degrees(
        metres / EARTH_RADIUS * np.array([np.cos(course), np.sin(course) / np.cos(lat)])
    )
    a = np.array([48.0, 0.0])
    assert distance(a, a + step) == pytest.approx(metres, rel=1e-3 if metres > 10 else 1e-6)
    if metres == 1e-3:
        b = np.radians(a + step)
        cosine = np.sin(lat) * np.sin(b[0]) + np.cos(lat) * np.cos(b[0]) * np.cos(b[1])
        assert abs(EARTH_RADIUS * np.arccos(min(cosine, 1.0)) / metres - 1) > 0.9


def test_pyproj_says_the_same_of_a_sphere_and_a_little_else_of_the_earth():
    pyproj = pytest.importorskip("pyproj")
    rng = np.random.default_rng(0)
    a, b = (
        np.column_stack([rng.uniform(-90, 90, 500), rng.uniform(-180, 180, 500)]) for _ in range(2)
    )
    of_sphere = pyproj.Geod(a=EARTH_RADIUS, f=0.0).inv(a[:, 1], a[:, 0], b[:, 1], b[:, 0])[2]
    ours = great_circle_distance(a, b)
    np.testing.assert_allclose(ours, of_sphere, atol=1e-6)
    of_earth = pyproj.Geod(ellps="WGS84").inv(a[:, 1], a[:, 0], b[:, 1], b[:, 0])[2]
    off = np.abs(ours / of_earth - 1)
    assert 0.001 < off.mean() < 0.0025
    assert off.max() < 0.0057


@given(PLACES, PLACES, st.floats(0, 1))
def test_places_on_the_way_divide_it(a, b, t):
    way = distance(a, b, 1.0)
    if way > np.pi - 1e-4:
        return
    p = great_circle_places(a, b, np.array([t]))[0]
    assert distance(a, p, 1.0) == pytest.approx(t * way, abs=1e-7)
    assert distance(p, b, 1.0) == pytest.approx((1 - t) * way, abs=1e-7)


def test_antipodes_have_no_way_and_no_middle():
    a = np.array([10.0, 20.0])
    b = np.array([-10.0, -160.0])
    with pytest.raises(ValueError, match="antipodes"):
        great_circle_places(a, b, np.array([0.5]))
    with pytest.raises(ValueError, match="cancel"):
        mean_place(np.stack([a, b]))
    np.testing.assert_allclose(great_circle_places(a, a, np.array([0.0, 0.5])), [a, a])


def test_the_mean_is_the_middle_on_both_sides_of_the_date_line_and_turns_with_the_globe():
    np.testing.assert_allclose(
        mean_place(np.array([[0.0, 179.0], [0.0, -179.0]])), [0, 180], atol=1e-9
    )
    places = np.array([[10.0, 170.0], [-20.0, -150.0], [40.0, 160.0]])
    R = Rotation.from_rotvec([0.3, -0.8, 1.1]).as_matrix()
    turned = mean_place(places_of_units(units_of_places(places) @ R.T))
    np.testing.assert_allclose(
        units_of_places(turned[None])[0], R @ units_of_places(mean_place(places)[None])[0]
    )


@given(PLACES)
def test_units_and_places_are_inverse(place):
    p = units_of_places(place[None])
    np.testing.assert_allclose(np.linalg.norm(p), 1)
    np.testing.assert_allclose(units_of_places(places_of_units(3 * p)), p, atol=1e-12)


def test_latitude_is_the_normals_angle():
    globe = Ellipsoid(2.0, 0.3)
    latitude = np.linspace(-1.5, 1.5, 11)
    rho, z = globe.meridian(latitude).T
    np.testing.assert_allclose((rho / 2.0) ** 2 + (z / 1.4) ** 2, 1)
    # the gradient of that
    np.testing.assert_allclose(np.arctan2(z / 1.4**2, rho / 2.0**2), latitude)
    np.testing.assert_allclose(np.arctan2(z, rho), globe.geocentric(latitude))


def test_the_earth_differs_most_near_45_degrees():
    latitude = np.radians(np.linspace(0, 90, 9001))
    apart = np.degrees(latitude - PLANETS["Earth"].geocentric(latitude))
    assert apart.max() == pytest.approx(0.1924, abs=1e-4)
    assert np.degrees(latitude[apart.argmax()]) == pytest.approx(45.1, abs=0.02)
    assert np.radians(apart.max()) * 6371 == pytest.approx(21.4, abs=0.05)


def test_the_net_lies_on_the_sphere():
    np.testing.assert_allclose(np.linalg.norm(graticule(30), axis=2), 1)
    np.testing.assert_allclose(parallel(0.3)[..., 2], np.cos(0.3))
