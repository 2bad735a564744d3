"""Places on a globe by latitude and longitude: distances, ways and means, flattened globes.

A place is (latitude, longitude) in degrees, north and east positive. A globe's axes: +Z to the
north pole, +X to latitude 0, longitude 0.
Reference: Veness, Movable Type Scripts, "Calculate distance, bearing and more between
latitude/longitude points". Snyder, Map Projections: A Working Manual, USGS 1395, 1987, eq. 3-28 and
5-3. Torge, Geodesy, 3rd ed., 4.1. Mardia and Jupp, Directional Statistics, 2000.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float

from workbench.geometry.polylines import circle, segments

EARTH_RADIUS = 6_371_008.8
"""The mean radius of the Earth (2a + b) / 3, metres."""


def units_of_places(places: Float[np.ndarray, "n 2"]) -> Float[np.ndarray, "n 3"]:
    """Return the unit vectors from the centre of a sphere to places."""
    latitude, longitude = np.radians(places).T
    c = np.cos(latitude)
    return np.column_stack([c * np.cos(longitude), c * np.sin(longitude), np.sin(latitude)])


def places_of_units(p: Float[np.ndarray, "n 3"]) -> Float[np.ndarray, "n 2"]:
    """Return the places below vectors from the centre, not 0; longitudes are in (-180, 180]."""
    x, y, z = p.T
    return np.degrees(np.column_stack([np.arctan2(z, np.hypot(x, y)), np.arctan2(y, x)]))


def great_circle_distance(
    a: Float[np.ndarray, "n 2"], b: Float[np.ndarray, "n 2"], radius: float = EARTH_RADIUS
) -> Float[np.ndarray, " n"]:
    """Return the shortest ways along a sphere between places in the same rows (Snyder, 5-3a).

    Half angles, with both sine and cosine, make it exact for a millimetre and for antipodes alike.
    """
    north, east = np.radians(b - a).T
    lat_a, lat_b = np.radians(a[:, 0]), np.radians(b[:, 0])
    bend = 2.0 * np.sin(east / 2) ** 2 * np.cos(lat_b)
    across = np.cos(lat_b) * np.sin(east)
    along = np.sin(north) + bend * np.sin(lat_a)
    ahead = np.cos(north) - bend * np.cos(lat_a)
    return radius * np.arctan2(np.hypot(across, along), ahead)


def great_circle_places(
    a: Float[np.ndarray, "2"], b: Float[np.ndarray, "2"], t: Float[np.ndarray, " n"]
) -> Float[np.ndarray, "n 2"]:
    """Return places on the shortest way from a (t = 0) to b (t = 1), at shares t of it.

    Raises:
        ValueError: If the places are antipodes: every meridian is a shortest way then.
    """
    p, q = units_of_places(np.stack([a, b]))
    angle = float(great_circle_distance(a[None], b[None], 1.0)[0])
    if np.pi - angle < 1e-9:
        raise ValueError("antipodes have no one shortest way")
    if angle < 1e-12:
        return np.broadcast_to(np.asarray(a, float), (len(t), 2)).copy()
    weights = np.column_stack([np.sin((1.0 - t) * angle), np.sin(t * angle)])
    return places_of_units(weights @ np.stack([p, q]))


def mean_place(places: Float[np.ndarray, "n 2"]) -> Float[np.ndarray, "2"]:
    """Return the place below the mean of the unit vectors (Mardia and Jupp 2000, 9.2).

    Raises:
        ValueError: If the vectors cancel, as for antipodes.
    """
    mean = units_of_places(places).mean(axis=0)
    if np.linalg.norm(mean) < 1e-9:
        raise ValueError("the places cancel: they have no middle")
    return places_of_units(mean[None])[0]


def parallel(polar: float, pieces: int = 72) -> Float[np.ndarray, "n 2 3"]:
    """Return the circle of the unit sphere at a polar angle, radians, as segments."""
    turn = circle(pieces)
    return segments(np.column_stack([np.sin(polar) * turn, np.full(len(turn), np.cos(polar))]))


def graticule(degrees: int) -> Float[np.ndarray, "n 2 3"]:
    """Return the unit sphere's parallels every so many degrees, meridians every twice as many."""
    parallels = [parallel(polar) for polar in np.radians(np.arange(degrees, 180, degrees))]
    latitude = np.linspace(-90.0, 90.0, 37)
    meridians = [
        segments(units_of_places(np.column_stack([latitude, np.full(37, longitude)])))
        for longitude in np.arange(0.0, 360.0, 2 * degrees)
    ]
    return np.concatenate(parallels + meridians)


@dataclass(frozen=True)
class Ellipsoid:
    """A sphere flattened at its poles: equator's radius, m, and the share the poles are nearer."""

    equator: float
    flattening: float

    def meridian(self, latitude: Float[np.ndarray, " n"]) -> Float[np.ndarray, "n 2"]:
        """Return (rho, z) where the normal rises by these latitudes, rad (Torge, 4.13, 4.15)."""
        b = 1.0 - self.flattening
        c, s = np.cos(latitude), np.sin(latitude)
        length = np.hypot(c, b * s)
        return self.equator * np.column_stack([c / length, b * b * s / length])

    def geocentric(self, latitude: Float[np.ndarray, " n"]) -> Float[np.ndarray, " n"]:
        """Return the angles at which these points are seen from the centre, rad (Snyder, 3-28)."""
        b = 1.0 - self.flattening
        return np.arctan2(b * b * np.sin(latitude), np.cos(latitude))


PLANETS = {
    "Earth": Ellipsoid(6_378_137.0, 1 / 298.257223563),  # WGS 84
    "Mars": Ellipsoid(3_396_190.0, 1 / 169.894),  # Archinal et al., IAU working group report 2015
    "Saturn": Ellipsoid(60_268_000.0, 0.09796),
}
