"""What is true of a run of the coordinates lesson, by vectors and closed forms, from the states
alone.
"""

from typing import Any

import numpy as np

from lessons.coordinates.pan_tilt import Followed
from lessons.coordinates.parallels import Met
from lessons.coordinates.placing import Scattered, Walked
from lessons.coordinates.voyages import Travelled

EARTH = 6_371_008.8
CAPS = 1 - np.cos(np.pi / 6)  # the share of a sphere's area within 30 degrees of a pole


def units(places: np.ndarray) -> np.ndarray:
    """Unit vectors of places."""
    lat, lon = np.radians(np.atleast_2d(places)).T
    return np.column_stack([np.cos(lat) * np.cos(lon), np.cos(lat) * np.sin(lon), np.sin(lat)])


def apart(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Metres along the Earth between places, by the angle between vectors."""
    p, q = units(a), units(b)
    return EARTH * np.arctan2(np.linalg.norm(np.cross(p, q), axis=1), (p * q).sum(axis=1))


def between_means(places: np.ndarray) -> float:
    """Metres from the mean of the numbers to the place below the mean of the vectors."""
    p = units(places.mean(axis=0))[0]
    q = units(places).mean(axis=0)
    return float(EARTH * np.arctan2(np.linalg.norm(np.cross(p, q)), p @ q))


def straight_over_shortest(places: np.ndarray, pieces: int = 20_000) -> float:
    """How many times as long the straight line on the map is."""
    t = np.linspace(0, 1, pieces)[:, None]
    way = places[0] + t * (places[-1] - places[0])
    return float(apart(way[:-1], way[1:]).sum() / apart(places[:1], places[-1:])[0])


def in_caps(p: np.ndarray) -> float:
    """The share of points within 30 degrees of a pole, by their angles with it."""
    polar = np.degrees(np.arctan2(np.linalg.norm(p[:, :2], axis=1), p[:, 2]))
    return float(((polar < 30) | (polar > 150)).mean())


def put_back(walked: Walked) -> float:
    """How far points are from where their spherical, cylindrical or Cartesian coordinates put them,
    whichever is least.
    """
    a, b, c = walked.c.T
    formulas = (
        (a * np.sin(b) * np.cos(c), a * np.sin(b) * np.sin(c), a * np.cos(b)),
        (a * np.cos(b), a * np.sin(b), c),
        (a, b, c),
    )
    return min(float(np.linalg.norm(np.column_stack(p) - walked.p, axis=1).max()) for p in formulas)


def fastest(miss: float, height: float = 10.0, speed: float = 10.0) -> tuple[float, float]:
    """The largest rates of pan axis and line of sight, degrees per second, for a miss in
    degrees.
    """
    beside = height * np.tan(np.radians(miss))
    return float(np.degrees(speed / beside)), float(np.degrees(speed / np.hypot(height, beside)))


def is_right(state: Any) -> bool | None:
    """Whether what a state shows is right, wrong, or not claimed to be either."""
    step, params = state.now, state.params
    if isinstance(step, Walked) and len(step.p) == 17:
        return put_back(step) < 1e-6
    if isinstance(step, Scattered) and len(step.p) == params.samples:
        return bool(abs(in_caps(step.p) - CAPS) < 4 * np.sqrt(CAPS * (1 - CAPS) / params.samples))
    if isinstance(step, Travelled) and step.means is not None:
        return between_means(state.subject.degrees) < 1e4
    if isinstance(step, Followed) and step.time >= 1.5999:
        n = np.array(
            [
                np.cos(step.tilt) * np.cos(step.pan),
                np.cos(step.tilt) * np.sin(step.pan),
                np.sin(step.tilt),
            ]
        )
        return bool(np.linalg.norm(n - step.p / np.linalg.norm(step.p)) < 1e-6)
    if isinstance(step, Met) and step.H[2, 0] == 0.4:
        x = np.cross(*step.lines)
        return bool(
            np.linalg.norm(np.cross(x, step.x_h))
            < 1e-9 * np.linalg.norm(x) * np.linalg.norm(step.x_h)
        )
    return None
