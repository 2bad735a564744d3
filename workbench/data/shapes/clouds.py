"""Seeded clouds for registration: with no symmetry, with one, one that slides, and scans of them.

Lengths in metres, +Z up, every shape about a metre in size.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float

from workbench.data.shapes.rabbit import rabbit
from workbench.geometry.motions import apply, inverse

Cloud = Float[np.ndarray, "n 3"]


@dataclass(frozen=True, eq=False)
class ScanPair:
    """Two scans of one shape, their true motion, and which source points are not the shape's."""

    p_target: Float[np.ndarray, "m 3"]
    p_source: Float[np.ndarray, "n 3"]
    T_target_source: Float[np.ndarray, "4 4"]
    is_outlier: Bool[np.ndarray, "n"]


def vase(count: int, rng: np.random.Generator) -> Cloud:
    """Return points on a surface of revolution about z: nothing tells how far it was turned."""
    z = np.linspace(-0.45, 0.45, 400)
    area = _vase_radius(z) * np.hypot(1.0, np.gradient(_vase_radius(z), z))
    height = np.interp(rng.random(count), np.cumsum(area) / area.sum(), z)
    angle = rng.uniform(0.0, 2.0 * np.pi, count)
    radius = _vase_radius(height)
    return np.column_stack([radius * np.cos(angle), radius * np.sin(angle), height])


def corner(count: int, rng: np.random.Generator) -> Cloud:
    """Return points on a floor and a wall, 2 m long: only the ends hold a slide along x."""
    floor = np.arange(count) < 0.55 * count
    x = rng.uniform(-1.0, 1.0, count)
    s = rng.uniform(0.0, 0.8, count)
    return np.column_stack([x, np.where(floor, s, 0.0) - 0.3, np.where(floor, 0.0, s) - 0.3])


def box_surface(count: int, size: tuple[float, float, float], rng: np.random.Generator) -> Cloud:
    """Return points on the surface of a box about the origin; a box of height 0 is a plate."""
    x, y, z = size
    areas = np.array([y * z, x * z, x * y])
    across = rng.choice(3, count, p=areas / areas.sum())  # the axis that the point's face is across
    p = rng.uniform(-0.5, 0.5, (count, 3))
    p[np.arange(count), across] = rng.choice([-0.5, 0.5], count)
    return p * size


SHAPES = {"rabbit": rabbit, "vase": vase, "corner": corner}


def pair(
    shape: str,
    count: int,
    T_target_source: Float[np.ndarray, "4 4"],
    *,
    rng: np.random.Generator,
    overlap: float = 1.0,
    noise: float = 0.0,
    outliers: float = 0.0,
) -> ScanPair:
    """Return two scans of a shape, each of its own random points, the second in its own frame.

    Args:
        shape: One of `SHAPES`.
        overlap: Share of the source scan that the target scan saw too; the two lose opposite ends.
        noise: Standard deviation of each coordinate, in both scans, metres.
        outliers: Share of the source points that lie anywhere in twice the shape's box.

    Raises:
        ValueError: If the shape is unknown, or a share is out of range.
    """
    if shape not in SHAPES or not 0 < overlap <= 1 or not 0 <= outliers < 1 or count < 1:
        raise ValueError(f"shape {shape!r}, count {count}, overlap {overlap}, outliers {outliers}")
    # each scan keeps 1 - cut of the shape; 1 - 2 cut of it is in both
    cut = (1.0 - overlap) / (2.0 - overlap)
    more = int(np.ceil(count / (1.0 - cut)))
    first, second = (SHAPES[shape](more, rng) for _ in range(2))  # both in the target frame
    first = first[np.argsort(first[:, 0], kind="stable")[:count]]
    second = second[np.argsort(-second[:, 0], kind="stable")[:count]]
    first, second = (
        rng.permutation(p) + noise * rng.standard_normal(p.shape) for p in (first, second)
    )
    is_outlier = np.arange(count) < round(outliers * count)
    low, high = second.min(axis=0), second.max(axis=0)
    anywhere = rng.uniform(low - 0.5 * (high - low), high + 0.5 * (high - low), (count, 3))
    second = np.where(is_outlier[:, None], anywhere, second)
    return ScanPair(first, apply(inverse(T_target_source), second), T_target_source, is_outlier)


def _vase_radius(z: np.ndarray) -> np.ndarray:
    return 0.24 + 0.10 * np.sin(6.0 * z + 0.6) - 0.08 * z
