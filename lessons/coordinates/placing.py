"""Points placed by their coordinates, walked over the axis, scattered by angles, and measured by
range and bearing.

Reference: ISO 80000-2:2019, 2-17. Marsaglia, Choosing a Point from the Surface of a Sphere, 1972.
Lerro and Bar-Shalom, Tracking with Debiased Consistent Converted Measurements versus EKF, 1993, eq.
4.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Literal, get_args

import numpy as np
from jaxtyping import Float

from workbench.geometry.shapes.curvilinear import (
    Convention,
    Coordinates,
    cartesian_from_spherical,
    read_as,
    volume_of_cells,
    written_as,
)
from workbench.tracing import traced

Spherical = Callable[[np.ndarray], np.ndarray]
"""spherical_from_cartesian(p) -> (n, 3): r, polar, azimuth; metres and radians."""
Even = Literal["angle", "area"]
ARC = 6  # pieces of the way that one step goes


@dataclass(frozen=True, eq=False, kw_only=True)
class Placed:
    """A point on its way from the origin, one coordinate after the other.

    Attributes:
        c: Its coordinates so far.
        p: Where it is, m.
        path: The way it came, m.
        moves: Which coordinate grows; None before the first.
    """

    c: Float[np.ndarray, "3"]
    p: Float[np.ndarray, "3"]
    path: Float[np.ndarray, "n 3"]
    moves: int | None = None


@traced
def place(c: Float[np.ndarray, "3"], system: Coordinates, steps: int) -> Iterator[Placed]:
    """Yield a point that moves by its first coordinate, then by its second, then by its third.

    Args:
        c: The coordinates that it gets.
        system: What they mean.
        steps: Into how many steps each coordinate is cut.
    """
    reached = np.zeros(3)
    path = np.zeros((1, 3))
    yield Placed(c=reached, p=path[0], path=path)
    for k in range(3):
        for step in range(steps):
            arc = np.tile(reached, (ARC, 1))
            arc[:, k] = c[k] * (step + np.arange(1, ARC + 1) / ARC) / steps
            path = np.concatenate([path, system.to_points(arc)])
            reached = arc[-1]
            yield Placed(c=reached, p=path[-1], path=path, moves=k)


@dataclass(frozen=True, eq=False, kw_only=True)
class Cell:
    """A small cell, and the solid that such cells fill.

    Attributes:
        low: Its lowest coordinates.
        high: Its highest.
        volume: What it holds, m^3.
        product: What its three sides multiply to, in units of their own.
        solid: The sum over the cells of a solid about the origin with the density, m^3, and of the
            products alone.
    """

    low: Float[np.ndarray, "3"]
    high: Float[np.ndarray, "3"]
    volume: float
    product: float
    solid: tuple[float, float]


def cell_at(c: Float[np.ndarray, "3"], sides: Float[np.ndarray, "3"], system: Coordinates) -> Cell:
    """Return the cell with its lowest corner at a point.

    Args:
        c: Coordinates of the point.
        sides: Of the cell, in the units of the coordinates.
        system: What they mean.
    """
    volume, product = volume_of_cells(system, c, c + sides)
    low, high = np.array(system.solid)
    return Cell(
        low=c,
        high=c + sides,
        volume=volume,
        product=product,
        solid=volume_of_cells(system, low, high),
    )


@dataclass(frozen=True, eq=False)
class Readings:
    """Three numbers, and the points that they mean by each convention, m."""

    numbers: Float[np.ndarray, "3"]
    p: Mapping[str, np.ndarray]


def read_by_all(c: Float[np.ndarray, "3"], convention: Convention) -> Readings:
    """Return what (r, polar, azimuth), written in a convention, mean by all of them."""
    numbers = written_as(c, convention)
    return Readings(
        numbers,
        {
            name: cartesian_from_spherical(read_as(numbers, name)[None])[0]
            for name in get_args(Convention)
        },
    )


@dataclass(frozen=True, eq=False, kw_only=True)
class Walked:
    """A straight walk, by points and by their coordinates, so far.

    Attributes:
        p: Where it was, m.
        c: Their coordinates.
        misses: How far the points with these coordinates are from where it was, m.
    """

    p: Float[np.ndarray, "n 3"]
    c: Float[np.ndarray, "n 3"]
    misses: Float[np.ndarray, " n"]


@traced
def walk(p: Float[np.ndarray, "n 3"], system: Coordinates) -> Iterator[Walked]:
    """Yield ever more points of a walk with the coordinates of each, and how well these tell where
    it is.
    """
    c = system.of_points(p)
    misses = np.linalg.norm(system.to_points(c) - p, axis=1)
    for n in range(1, len(p) + 1):
        yield Walked(p=p[:n], c=c[:n], misses=misses[:n])


@dataclass(frozen=True, eq=False, kw_only=True)
class Scattered:
    """Points of the unit sphere, drawn so far."""

    p: Float[np.ndarray, "n 3"]


@traced
def scatter(counts: Iterable[int], even: Even, rng: np.random.Generator) -> Iterator[Scattered]:
    """Yield ever more points of the unit sphere.

    Args:
        counts: How many there are at each step.
        even: `angle` draws polar angle and azimuth uniformly; `area` draws z and azimuth so
            (Archimedes: a band's area goes with its height).
        rng: Chance.
    """
    counts = tuple(counts)
    u = rng.random(max(counts))
    azimuth = rng.uniform(-np.pi, np.pi, max(counts))
    polar = np.pi * u if even == "angle" else np.arccos(1.0 - 2.0 * u)
    p = cartesian_from_spherical(np.column_stack([np.ones(len(u)), polar, azimuth]))
    for n in counts:
        yield Scattered(p=p[:n])


@dataclass(frozen=True, eq=False, kw_only=True)
class Ranged:
    """Measurements of one point by range and bearing from the origin, so far.

    Attributes:
        true: The point, m.
        p: The measured points, m.
        mean: Their mean.
        debiased: Their mean divided by exp(-sigma^2 / 2), sigma being the bearing's standard
            deviation.
        polar_mean: The point at the mean range and the mean bearing.
        expected: Where the mean tends to.
    """

    true: Float[np.ndarray, "2"]
    p: Float[np.ndarray, "n 2"]
    mean: Float[np.ndarray, "2"]
    debiased: Float[np.ndarray, "2"]
    polar_mean: Float[np.ndarray, "2"]
    expected: Float[np.ndarray, "2"]


@traced
def measure(
    distance: float,
    sigma: float,
    sigma_range: float,
    *,
    counts: Iterable[int],
    rng: np.random.Generator,
) -> Iterator[Ranged]:
    """Yield what ever more measurements of a point ahead say of where it is.

    Args:
        distance: To the point, which lies on +X, m.
        sigma: Standard deviation of a bearing, radians.
        sigma_range: Standard deviation of a range, m.
        counts: How many measurements there are at each step.
        rng: Chance.
    """
    counts = tuple(counts)
    bearing = sigma * rng.standard_normal(max(counts))
    r = distance + sigma_range * rng.standard_normal(max(counts))
    p = np.column_stack([r * np.cos(bearing), r * np.sin(bearing)])
    true = np.array([distance, 0.0])
    shrink = np.exp(-(sigma**2) / 2)
    for n in counts:
        mean = p[:n].mean(axis=0)
        ahead = bearing[:n].mean()
        yield Ranged(
            true=true,
            p=p[:n],
            mean=mean,
            debiased=mean / shrink,
            polar_mean=r[:n].mean() * np.array([np.cos(ahead), np.sin(ahead)]),
            expected=shrink * true,  # E[cos] = exp(-sigma^2 / 2)
        )
