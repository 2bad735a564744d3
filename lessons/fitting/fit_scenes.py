"""Places on circles, spheres, cylinders, lines and planes of known size, and errors to add to them.
Metres.
"""

from typing import Literal

import numpy as np
from jaxtyping import Float

Errors = Literal["independent", "alike in neighbours"]
ALIKE = 10  # neighbours that share their error
HALF_LENGTH = 1.0  # of the cylinder
_GOLDEN = (np.sqrt(5.0) - 1.0) / 2.0


def arc_points(arc: float, count: int) -> Float[np.ndarray, "n 2"]:
    """Return places evenly along an arc, radians, of the unit circle, its middle at (1, 0); a full
    circle has no double.
    """
    turn = arc * ((np.arange(count) + 0.5) / count - 0.5)
    return np.column_stack([np.cos(turn), np.sin(turn)])


def cap_points(arc: float, count: int) -> Float[np.ndarray, "n 3"]:
    """Return places evenly over a cap of the unit sphere that is an arc, radians, across; its
    middle is (1, 0, 0).
    """
    height = 1.0 - (1.0 - np.cos(arc / 2.0)) * (np.arange(count) + 0.5) / count
    turn = 2.0 * np.pi * _GOLDEN * np.arange(count)
    wide = np.sqrt(1.0 - height**2)
    return np.column_stack([height, wide * np.cos(turn), wide * np.sin(turn)])


def pipe_points(arc: float, count: int) -> Float[np.ndarray, "n 3"]:
    """Return places evenly over an arc, radians, of a cylinder of radius 1 about the z axis, 2 m
    long.
    """
    turn = arc * (_GOLDEN * np.arange(count) % 1.0 - 0.5)
    height = HALF_LENGTH * (2.0 * (np.arange(count) + 0.5) / count - 1.0)
    return np.column_stack([np.cos(turn), np.sin(turn), height])


def line_points(rng: np.random.Generator, slope: float, count: int) -> Float[np.ndarray, "n 2"]:
    """Return places along a line through the origin, 2 m long, by chance; its slope is an angle,
    radians.
    """
    return rng.uniform(-1.0, 1.0, count)[:, None] * np.array([np.cos(slope), np.sin(slope)])


def errors(
    rng: np.random.Generator, shape: tuple[int, ...], sigma: float, *, kind: Errors = "independent"
) -> np.ndarray:
    """Return normal errors of one standard deviation in every coordinate.

    Args:
        rng: Where chance comes from.
        shape: (..., n, d), n rows of d coordinates.
        sigma: The standard deviation, metres.
        kind: Independent, or means of independent ones over ten rows, so that neighbours err alike;
            as large as the others.
    """
    if kind == "independent":
        return sigma * rng.normal(size=shape)
    *more, n, d = shape
    summed = np.cumsum(rng.normal(size=(*more, n + ALIKE, d)), axis=-2)
    return sigma * (summed[..., ALIKE:, :] - summed[..., :-ALIKE, :]) / np.sqrt(ALIKE)


def outlying_plane(
    rng: np.random.Generator,
    count: int,
    sigma: float,
    *,
    outliers: float,
    reach: float,
    both_sides: bool,
) -> tuple[Float[np.ndarray, "n 3"], np.ndarray]:
    """Return points of the plane z = 0, 2 m by 2 m, some of which lie off it, and which ones these
    are.

    Args:
        rng: Where chance comes from.
        count: How many points.
        sigma: Standard deviation of the heights of the others, metres.
        outliers: Which share lies off.
        reach: Up to how high, metres; evenly from 0 on.
        both_sides: Whether they lie below, too.
    """
    p = np.column_stack([rng.uniform(-1.0, 1.0, (count, 2)), sigma * rng.normal(size=count)])
    off = np.arange(count) < round(outliers * count)
    p[off, 2] = rng.uniform(-reach if both_sides else 0.0, reach, int(off.sum()))
    return p, off
