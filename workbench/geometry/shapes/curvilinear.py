"""Points of space in cylindrical and spherical coordinates, and what a cell of them holds.

Spherical coordinates are (r, polar, azimuth), cylindrical ones (rho, azimuth, z): the polar angle
from +Z in [0, pi], the azimuth from +X towards +Y in (-pi, pi], 0 on the axis where it has no
meaning. Metres and radians.
Reference: ISO 80000-2:2019, 2-17.2 and 2-17.3. Weisstein, MathWorld, "Spherical Coordinates", for
what others call them.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Literal

import numpy as np
from jaxtyping import Float

from workbench.geometry.polylines import segments

System = Literal["cartesian", "cylindrical", "spherical"]
Convention = Literal["ISO", "mathematics", "elevation"]
CHUNK = 4096  # rows whose columns stay in the cache


def spherical_from_cartesian(p: Float[np.ndarray, "n 3"]) -> Float[np.ndarray, "n 3"]:
    """Return (r, polar, azimuth) of points, exact near the axis too; the origin is (0, 0, 0).

    Examples:
        >>> spherical_from_cartesian(np.array([[0.0, 2.0, 0.0], [0.0, 0.0, -1.0]])).round(
        ...     3
        ... ).tolist()
        [[2.0, 1.571, 1.571], [1.0, 3.142, 0.0]]
    """
    c = np.empty(p.shape)
    for k in range(0, len(p), CHUNK):
        # Takes the sign of zeros away, which arctan2 would listen to
        x, y, z = p[k : k + CHUNK].T + 0.0
        out = c[k : k + CHUNK]
        rho = np.hypot(x, y)
        out[:, 0] = np.hypot(rho, z)
        out[:, 1] = np.arctan2(rho, z)
        out[:, 2] = _azimuth(x, y)
    return c


def cartesian_from_spherical(c: Float[np.ndarray, "n 3"]) -> Float[np.ndarray, "n 3"]:
    """Return the points with these (r, polar, azimuth)."""
    r, polar, azimuth = c.T
    rho = r * np.sin(polar)
    return np.column_stack([rho * np.cos(azimuth), rho * np.sin(azimuth), r * np.cos(polar)])


def cylindrical_from_cartesian(p: Float[np.ndarray, "n 3"]) -> Float[np.ndarray, "n 3"]:
    """Return (rho, azimuth, z) of points."""
    x, y, z = p.T + 0.0
    return np.column_stack([np.hypot(x, y), _azimuth(x, y), z])


def cartesian_from_cylindrical(c: Float[np.ndarray, "n 3"]) -> Float[np.ndarray, "n 3"]:
    """Return the points with these (rho, azimuth, z)."""
    rho, azimuth, z = c.T
    return np.column_stack([rho * np.cos(azimuth), rho * np.sin(azimuth), z])


def _azimuth(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    azimuth = np.arctan2(y, x)
    azimuth[azimuth <= -np.pi] = np.pi
    return azimuth


@dataclass(frozen=True, kw_only=True)
class Coordinates:
    """A system of three coordinates, both ways, its density, and a solid of 1 m about the origin.

    `density` is the volume of a small cell over the product of its three sides.
    """

    names: tuple[str, str, str]
    angles: tuple[bool, bool, bool]
    of_points: Callable[[np.ndarray], np.ndarray]
    to_points: Callable[[np.ndarray], np.ndarray]
    density: Callable[[np.ndarray], np.ndarray]
    solid: tuple[tuple[float, float, float], tuple[float, float, float]]
    volume: float


SYSTEMS: Mapping[System, Coordinates] = {
    "cartesian": Coordinates(
        names=("x", "y", "z"),
        angles=(False, False, False),
        of_points=np.array,
        to_points=np.array,
        density=lambda c: np.ones(len(c)),
        solid=((-1.0, -1.0, -1.0), (1.0, 1.0, 1.0)),
        volume=8.0,
    ),
    "cylindrical": Coordinates(
        names=("ρ", "φ", "z"),
        angles=(False, True, False),
        of_points=cylindrical_from_cartesian,
        to_points=cartesian_from_cylindrical,
        density=lambda c: c[:, 0],
        solid=((0.0, -np.pi, -1.0), (1.0, np.pi, 1.0)),
        volume=2 * np.pi,
    ),
    "spherical": Coordinates(
        names=("r", "θ", "φ"),
        angles=(False, True, True),
        of_points=spherical_from_cartesian,
        to_points=cartesian_from_spherical,
        density=lambda c: c[:, 0] ** 2 * np.sin(c[:, 1]),
        solid=((0.0, 0.0, -np.pi), (1.0, np.pi, np.pi)),
        volume=4 / 3 * np.pi,
    ),
}


def cell_edges(
    system: Coordinates,
    low: Float[np.ndarray, "3"],
    high: Float[np.ndarray, "3"],
    *,
    pieces: int = 8,
) -> Float[np.ndarray, "n 2 3"]:
    """Return the twelve edges of the cell between coordinates as segments, bent along angles."""
    t = np.linspace(0.0, 1.0, pieces + 1)
    edges = []
    for along in range(3):
        for bits in np.ndindex(2, 2):
            share = np.insert(np.tile(np.array(bits, float), (len(t), 1)), along, t, axis=1)
            edges.append(segments(system.to_points(low + share * (high - low))))
    return np.concatenate(edges)


def volume_of_cells(
    system: Coordinates,
    low: Float[np.ndarray, "3"],
    high: Float[np.ndarray, "3"],
    *,
    cells: int = 24,
) -> tuple[float, float]:
    """Return the volume between coordinates, m^3, as a sum over cells, and without density."""
    middles = [
        a + (b - a) * (np.arange(cells) + 0.5) / cells for a, b in zip(low, high, strict=True)
    ]
    c = np.stack(np.meshgrid(*middles, indexing="ij"), axis=-1).reshape(-1, 3)
    product = float(np.prod((high - low) / cells))
    return product * float(system.density(c).sum()), product * len(c)


def read_as(numbers: Float[np.ndarray, "3"], convention: Convention) -> Float[np.ndarray, "3"]:
    """Return the (r, polar, azimuth) that a radius and two angles mean.

    ISO: (r, polar, azimuth). Mathematics: (r, azimuth, polar), as MathWorld has it. Elevation: (r,
    azimuth, elevation) with the last from the x-y plane upwards, as in MATLAB's `sph2cart`.
    """
    r, first, second = numbers
    if convention == "ISO":
        return np.array([r, first, second])
    return np.array([r, second if convention == "mathematics" else np.pi / 2 - second, first])


def written_as(c: Float[np.ndarray, "3"], convention: Convention) -> Float[np.ndarray, "3"]:
    """Return the three numbers that (r, polar, azimuth) are in a convention; undoes `read_as`."""
    r, polar, azimuth = c
    if convention == "ISO":
        return np.array([r, polar, azimuth])
    return np.array([r, azimuth, polar if convention == "mathematics" else np.pi / 2 - polar])
