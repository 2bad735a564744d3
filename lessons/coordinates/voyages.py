"""Ways over a globe: straight in latitude and longitude beside the great circle; a walk from the
equator to a pole.

Reference: Veness, Movable Type Scripts, "Calculate distance, bearing and more between
latitude/longitude points". Snyder, Map Projections: A Working Manual, USGS 1395, 1987, eq. 3-28.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float

from workbench.geometry.shapes.globe import EARTH_RADIUS, Ellipsoid, great_circle_places, mean_place
from workbench.tracing import traced

Distance = Callable[[np.ndarray, np.ndarray, float], np.ndarray]
"""great_circle_distance(a, b, radius) -> (n,), in the unit of the radius; places in degrees."""
PIECES = 12  # of a way in each step


@dataclass(frozen=True, eq=False, kw_only=True)
class Travelled:
    """Two travellers on their ways, and in the end the middle of all places.

    Attributes:
        share: Of their ways, from 0 to 1.
        straight: Where the one was that changes latitude and longitude evenly, degrees.
        circle: Where the other was, on the great circle.
        straight_length: How far the first has come, m.
        circle_length: How far the second has come, m.
        direct: The distance from start to end, m.
        means: The mean of the numbers and the mean of the places, degrees; None while they travel.
        apart: How far these two are apart, m.
    """

    share: float
    straight: Float[np.ndarray, "n 2"]
    circle: Float[np.ndarray, "n 2"]
    straight_length: float
    circle_length: float
    direct: float
    means: Float[np.ndarray, "2 2"] | None = None
    apart: float = float("nan")


@traced
def travel(
    places: Float[np.ndarray, "m 2"], steps: int, great_circle_distance: Distance
) -> Iterator[Travelled]:
    """Yield two ways from the first place to the last, and then the two means of all places.

    Args:
        places: Latitudes and longitudes, degrees.
        steps: How many steps the ways take.
        great_circle_distance: Measures every piece of a way.
    """
    start = places[0]
    end = places[-1]
    t = np.linspace(0.0, 1.0, PIECES * steps + 1)
    straight = start + t[:, None] * (end - start)
    circle = great_circle_places(start, end, t)
    along_straight, along_circle = (
        np.concatenate([[0.0], np.cumsum(great_circle_distance(way[:-1], way[1:], EARTH_RADIUS))])
        for way in (straight, circle)
    )
    direct = float(great_circle_distance(start[None], end[None], EARTH_RADIUS)[0])
    for k in range(0, len(t), PIECES):
        yield Travelled(
            share=k / (len(t) - 1),
            straight=straight[: k + 1],
            circle=circle[: k + 1],
            straight_length=float(along_straight[k]),
            circle_length=float(along_circle[k]),
            direct=direct,
        )
    means = np.stack([places.mean(axis=0), mean_place(places)])
    apart = float(great_circle_distance(means[:1], means[1:], EARTH_RADIUS)[0])
    yield Travelled(
        share=1.0,
        straight=straight,
        circle=circle,
        straight_length=float(along_straight[-1]),
        circle_length=float(along_circle[-1]),
        direct=direct,
        means=means,
        apart=apart,
    )


@dataclass(frozen=True, eq=False, kw_only=True)
class Raised:
    """A walk from the equator towards a pole of a flattened globe, so far.

    Attributes:
        latitude: Angles of the plumb line with the plane of the equator, radians.
        geocentric: Angles of the line to the centre, radians.
        apart: What the difference is along the ground, taken as a sphere of the mean radius, m.
    """

    latitude: Float[np.ndarray, " n"]
    geocentric: Float[np.ndarray, " n"]
    apart: Float[np.ndarray, " n"]


@traced
def to_the_pole(planet: Ellipsoid, steps: int) -> Iterator[Raised]:
    """Yield both latitudes of places ever farther north.

    Args:
        planet: The flattened globe.
        steps: How many steps there are from the equator to the pole.
    """
    latitude = np.linspace(0.0, np.pi / 2, steps + 1)
    geocentric = planet.geocentric(latitude)
    apart = planet.equator * (1.0 - planet.flattening / 3.0) * (latitude - geocentric)
    for n in range(1, steps + 2):
        yield Raised(latitude=latitude[:n], geocentric=geocentric[:n], apart=apart[:n])
