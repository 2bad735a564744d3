"""Write how far apart places on a globe are. Both travellers' ways are measured with it, piece by
piece, and so is how far a mean of numbers is from the middle.
"""

import numpy as np
from jaxtyping import Float

from lessons.coordinates.exercises import STUDENTS, numbers, row_by_row
from workbench.exercise import (
    Function,
    Verdict,
    alternative,
    check,
    contract,
    left_alone,
    mistake,
    worst,
)
from workbench.geometry.shapes import globe


@contract(
    slot="great_circle_distance",
    preset="great-circle",
    examples=(
        ("great_circle_distance(np.array([[0.0, 0.0]]), np.array([[0.0, 90.0]]), 2.0)", "[3.1416]"),
        (
            (
                "great_circle_distance(np.array([[51.5074, -0.1278]]), np.array([[34.0522,"
                " -118.2437]]), 6371.0088)"
            ),
            "[8755.6]",
        ),
    ),
)
def great_circle_distance(
    a: Float[np.ndarray, "n 2"], b: Float[np.ndarray, "n 2"], radius: float
) -> Float[np.ndarray, " n"]:
    """Return the shortest ways along a sphere between places in the same rows, in the unit of the
    radius.

    It is exact to a millionth of itself, also for places a millimetre apart on the Earth; a place
    and itself are 0 apart, antipodes half the circumference (to a tenth of a metre on the Earth),
    and rounding makes neither NaN.

    Args:
        a: One row (latitude, longitude) per place, degrees, north and east positive.
        b: Likewise.
        radius: Of the sphere.
    """
    return globe.great_circle_distance(a, b, radius)


EARTH = 6_371_008.8
HINT = "Haversine, in radians: 2 R asin √(sin²(Δlat / 2) + cos lat₁ cos lat₂ sin²(Δlon / 2))."
FINE = "Differences of cosines near 1 have no digits: the haversine and atan2 have."


def judged(
    candidate: Function, a: np.ndarray, b: np.ndarray, radius: float = EARTH, hint: str = HINT
) -> Verdict:
    """Judge distances as shares of the right ones, where these are short of half round."""
    got = candidate(a, b, radius)
    right = globe.great_circle_distance(a, b, radius)
    off = np.abs(got - right) / np.maximum(right, 1e-12 * radius)
    asked = [
        f"{numbers(p)} to {numbers(q)}, R = {numbers(np.array(radius))}"
        for p, q in zip(a, b, strict=True)
    ]
    return row_by_row(asked, got, right, off, hint, good=3e-6, fair=1e-3)


def places(seed: int, n: int = 8) -> np.ndarray:
    """Return places anywhere."""
    rng = np.random.default_rng(seed)
    return np.column_stack([rng.uniform(-80.0, 80.0, n), rng.uniform(-180.0, 180.0, n)])


@check(3)
def cities(candidate: Function) -> Verdict:
    """Cities of all continents are as far apart as they are."""
    cities = np.array(list(globe_cities().values()))
    return judged(candidate, cities, np.roll(cities, 1, axis=0))


def globe_cities() -> dict[str, tuple[float, float]]:
    """Return some cities."""
    return {
        "London": (51.5074, -0.1278),
        "Los Angeles": (34.0522, -118.2437),
        "Tokyo": (35.6762, 139.6503),
        "Suva": (-18.1248, 178.4501),
        "Apia": (-13.8333, -171.7667),
        "Quito": (-0.1807, -78.4678),
    }


@check(2)
def other_radii(candidate: Function) -> Verdict:
    """On a sphere of another radius, ways are in its unit."""
    return judged(candidate, places(STUDENTS), places(STUDENTS + 1), 3389.5)


@check(1)
def places_are_left_alone(candidate: Function) -> Verdict:
    """The places that come in are not changed."""
    return left_alone(candidate, judged(candidate, places(STUDENTS + 2), places(STUDENTS + 3)))


@check(2)
def short_ways(candidate: Function) -> Verdict:
    """Places a millimetre, a metre and a kilometre apart are that far apart."""
    return worst(short(candidate, 0, metres) for metres in (1e-3, 1.0, 1e3))


def short(candidate: Function, axis: int, metres: float) -> Verdict:
    """Judge a short way to the north (0) or east (1), in a call of its own: beside a long one it
    would not count.

    It begins at (0, 0), where what a cosine loses does not depend on how a machine rounds.
    """
    a = np.zeros((1, 2))
    b = a + np.degrees(metres / EARTH) * np.eye(2)[[axis]]
    return judged(candidate, a, b, EARTH, FINE)


def radians(a: np.ndarray, b: np.ndarray) -> tuple[np.ndarray, ...]:
    """Return both latitudes and both longitudes in radians."""
    return *np.radians(a).T, *np.radians(b).T


@mistake(
    "You measured the chord, straight through the sphere. The way along it is 2 R asin(chord /"
    " 2 R)."
)
def chord(a: np.ndarray, b: np.ndarray, radius: float) -> np.ndarray:
    """Goes through the ground."""
    return 2 * radius * np.sin(globe.great_circle_distance(a, b, 1.0) / 2)


@mistake(
    "You took latitude and longitude for lengths in a plane. A degree of longitude shrinks with cos"
    " of the latitude."
)
def flat_degrees(a: np.ndarray, b: np.ndarray, radius: float) -> np.ndarray:
    """Pythagoras on degrees."""
    return radius * np.hypot(*np.radians(b - a).T)


@mistake(
    "You shrink longitudes with the cosine of one latitude and go on in a plane: that holds for"
    " short ways only."
)
def plane_with_cosine(a: np.ndarray, b: np.ndarray, radius: float) -> np.ndarray:
    """Takes the mean latitude."""
    lat_a, lon_a, lat_b, lon_b = radians(a, b)
    return radius * np.hypot(lat_b - lat_a, np.cos((lat_a + lat_b) / 2) * (lon_b - lon_a))


@mistake("You gave degrees to sine and cosine. They take radians: np.radians first.")
def degrees_as_radians(a: np.ndarray, b: np.ndarray, radius: float) -> np.ndarray:
    """Forgets to convert."""
    return globe.great_circle_distance(np.degrees(a), np.degrees(b), radius)


@mistake("You swapped latitude and longitude. Rows are (latitude, longitude).")
def swapped(a: np.ndarray, b: np.ndarray, radius: float) -> np.ndarray:
    """Takes longitude first."""
    return globe.great_circle_distance(a[:, ::-1], b[:, ::-1], radius)


@mistake(
    "You used the law of cosines, or arccos of a dot product: for short ways that cosine is 1 but"
    " for rounding, and a millimetre becomes 0 or decimetres."
)
def law_of_cosines(a: np.ndarray, b: np.ndarray, radius: float) -> np.ndarray:
    """Takes the arc cosine, clipped."""
    lat_a, lon_a, lat_b, lon_b = radians(a, b)
    cosine = np.sin(lat_a) * np.sin(lat_b) + np.cos(lat_a) * np.cos(lat_b) * np.cos(lon_b - lon_a)
    return radius * np.arccos(np.clip(cosine, -1.0, 1.0))


@mistake(
    "Your way is half as long as the right one: the haversine gives half the angle. Multiply the"
    " arc sine by 2."
)
def half_the_angle(a: np.ndarray, b: np.ndarray, radius: float) -> np.ndarray:
    """Forgets the 2."""
    return globe.great_circle_distance(a, b, radius) / 2


@mistake("You return the angle at the centre, not the way: multiply it by the radius.")
def without_the_radius(a: np.ndarray, b: np.ndarray, radius: float) -> np.ndarray:
    """Forgets the radius."""
    return globe.great_circle_distance(a, b, 1.0)


@mistake("You return degrees times the radius. The angle at the centre has to be in radians.")
def angle_in_degrees(a: np.ndarray, b: np.ndarray, radius: float) -> np.ndarray:
    """Multiplies degrees."""
    return np.degrees(globe.great_circle_distance(a, b, radius))


@alternative
def haversine(a: np.ndarray, b: np.ndarray, radius: float) -> np.ndarray:
    """Takes the arc sine of a root."""
    lat_a, lon_a = np.radians(a).T
    lat_b, lon_b = np.radians(b).T
    h = (
        np.sin((lat_b - lat_a) / 2) ** 2
        + np.cos(lat_a) * np.cos(lat_b) * np.sin((lon_b - lon_a) / 2) ** 2
    )
    return 2 * radius * np.arcsin(np.sqrt(np.clip(h, 0.0, 1.0)))


@alternative
def by_vectors(a: np.ndarray, b: np.ndarray, radius: float) -> np.ndarray:
    """Takes the angle between unit vectors from their chord and their sum (Kahan)."""
    p, q = globe.units_of_places(a), globe.units_of_places(b)
    return 2 * radius * np.arctan2(np.linalg.norm(p - q, axis=1), np.linalg.norm(p + q, axis=1))
