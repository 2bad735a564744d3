"""Seeded synthetic clouds for registration: one shape with no symmetry, one with, one that slides, and scans of them.

Lengths in metres, +Z up, every shape about a metre in size.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float

from workbench.geometry.motions import apply, exp_so3, inverse

Cloud = Float[np.ndarray, "n 3"]


@dataclass(frozen=True, eq=False)
class Pair:
    """Two scans of one shape and the motion between them.

    Attributes:
        p_target: Scan in the target frame.
        p_source: Scan in the source frame.
        T_target_source: The true motion.
        is_outlier: Whether a source point is none of the shape's.
    """

    p_target: Float[np.ndarray, "m 3"]
    p_source: Float[np.ndarray, "n 3"]
    T_target_source: Float[np.ndarray, "4 4"]
    is_outlier: Bool[np.ndarray, "n"]


# centre, radii, rotation vector (radians)
_RABBIT = (
    ((0.0, 0.0, -0.05), (0.36, 0.25, 0.27), (0.0, -0.25, 0.0)),  # body
    ((0.27, 0.02, 0.24), (0.18, 0.14, 0.15), (0.0, 0.3, 0.0)),  # head
    ((0.20, 0.09, 0.50), (0.05, 0.075, 0.23), (-0.2, -0.25, 0.1)),  # left ear, upright
    ((0.10, -0.10, 0.42), (0.05, 0.075, 0.21), (0.45, -0.9, 0.0)),  # right ear, lying back
    ((-0.36, 0.03, -0.02), (0.09, 0.09, 0.09), (0.0, 0.0, 0.0)),  # tail
    ((0.25, 0.12, -0.24), (0.15, 0.065, 0.06), (0.0, 0.1, 0.15)),  # left front paw
    ((0.21, -0.14, -0.25), (0.12, 0.065, 0.06), (0.0, 0.1, -0.3)),  # right front paw
    ((-0.10, -0.21, -0.22), (0.19, 0.08, 0.09), (0.0, 0.0, -0.2)),  # right hind foot
    ((-0.14, 0.20, -0.19), (0.17, 0.08, 0.12), (0.0, 0.0, 0.3)),  # left hind foot
)
_BLEND = 60.0  # 1/m: how sharply the blobs meet


def rabbit(count: int, rng: np.random.Generator) -> Cloud:
    """Return points on a rabbit: a smooth closed surface of blended ellipsoids that no motion takes to itself.

    The points of each ellipsoid that lie inside another are left out, and the rest is projected onto the surface where
    the smooth minimum of all ellipsoid distances is zero.
    """
    areas = np.array([_mean_product(radii) for _, radii, _ in _RABBIT])
    pieces = []
    for i, (centre, radii, turn) in enumerate(_RABBIT):
        p = _ellipsoid(int(3 * count * areas[i] / areas.sum()) + 8, np.array(radii), rng)
        p = p @ exp_so3(np.array(turn)).T + np.array(centre)
        others = [_blob_distance(p, *blob)[0] for j, blob in enumerate(_RABBIT) if j != i]
        pieces.append(p[np.min(others, axis=0) > 0])
    p = np.concatenate(pieces)
    p = p[rng.choice(len(p), count, replace=len(p) < count)]
    for _ in range(4):  # Newton along the gradient
        value, gradient = _rabbit_distance(p)
        p = p - (value / np.einsum("ij,ij->i", gradient, gradient))[:, None] * gradient
    return p


def vase(count: int, rng: np.random.Generator) -> Cloud:
    """Return points on a surface of revolution about z: no cloud of it can tell how far it was turned."""
    z = np.linspace(-0.45, 0.45, 400)
    area = _vase_radius(z) * np.hypot(1.0, np.gradient(_vase_radius(z), z))
    height = np.interp(rng.random(count), np.cumsum(area) / area.sum(), z)
    angle = rng.uniform(0.0, 2.0 * np.pi, count)
    radius = _vase_radius(height)
    return np.column_stack([radius * np.cos(angle), radius * np.sin(angle), height])


def corner(count: int, rng: np.random.Generator) -> Cloud:
    """Return points on a floor and a wall that meet along x, 2 m long: nothing holds a slide along x but the ends."""
    floor = np.arange(count) < 0.55 * count
    x, s = rng.uniform(-1.0, 1.0, count), rng.uniform(0.0, 0.8, count)
    return np.column_stack([x, np.where(floor, s, 0.0) - 0.3, np.where(floor, 0.0, s) - 0.3])


SHAPES = {"rabbit": rabbit, "vase": vase, "corner": corner}


def pair(
    shape: str,
    count: int,
    T_target_source: Float[np.ndarray, "4 4"],
    rng: np.random.Generator,
    *,
    overlap: float = 1.0,
    noise: float = 0.0,
    outliers: float = 0.0,
) -> Pair:
    """Return two scans of a shape, each of its own random points, the second in its own frame.

    Args:
        shape: One of `SHAPES`.
        count: Points of each scan.
        T_target_source: The true motion.
        rng: Draws points, noise and outliers.
        overlap: Share of the source scan that the target scan saw too; the two lose opposite ends along x.
        noise: Standard deviation of each coordinate, in both scans, metres.
        outliers: Share of the source points that lie anywhere in twice the shape's box.

    Raises:
        ValueError: If the shape is unknown, or a share is out of range.
    """
    if shape not in SHAPES or not 0 < overlap <= 1 or not 0 <= outliers < 1 or count < 1:
        raise ValueError(f"shape {shape!r}, count {count}, overlap {overlap}, outliers {outliers}")
    cut = (1.0 - overlap) / (2.0 - overlap)  # each scan keeps 1 - cut of the shape; 1 - 2 cut of it is in both
    more = int(np.ceil(count / (1.0 - cut)))
    first, second = (SHAPES[shape](more, rng) for _ in range(2))  # both in the target frame
    first = first[np.argsort(first[:, 0], kind="stable")[:count]]
    second = second[np.argsort(-second[:, 0], kind="stable")[:count]]
    first, second = (rng.permutation(p) + noise * rng.standard_normal(p.shape) for p in (first, second))
    is_outlier = np.arange(count) < round(outliers * count)
    low, high = second.min(axis=0), second.max(axis=0)
    anywhere = rng.uniform(low - 0.5 * (high - low), high + 0.5 * (high - low), (count, 3))
    second = np.where(is_outlier[:, None], anywhere, second)
    return Pair(first, apply(inverse(T_target_source), second), T_target_source, is_outlier)


def _vase_radius(z: np.ndarray) -> np.ndarray:
    return 0.24 + 0.10 * np.sin(6.0 * z + 0.6) - 0.08 * z


def _ellipsoid(count: int, radii: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    """Return about half as many points as asked for, uniform on an ellipsoid: sphere points kept by their area."""
    u = rng.standard_normal((count, 3))
    u /= np.linalg.norm(u, axis=1, keepdims=True)
    stretch = np.linalg.norm(u / radii, axis=1) * radii.min()
    return (u * radii)[rng.random(count) < stretch]


def _blob_distance(p: np.ndarray, centre: tuple, radii: tuple, turn: tuple) -> tuple[np.ndarray, np.ndarray]:
    """Return roughly the signed distance to an ellipsoid, and its gradient."""
    R = exp_so3(np.array(turn))
    q = (p - np.array(centre)) @ R / np.array(radii)
    norm = np.maximum(np.linalg.norm(q, axis=1), 1e-9)
    scale = min(radii)
    return scale * (norm - 1.0), scale * (q / norm[:, None] / np.array(radii)) @ R.T


def _rabbit_distance(p: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the smooth minimum of the blobs' distances, and its gradient."""
    found = [_blob_distance(p, *blob) for blob in _RABBIT]
    values, gradients = np.stack([v for v, _ in found]), np.stack([g for _, g in found])
    least = values.min(axis=0)
    weights = np.exp(-_BLEND * (values - least))
    total = weights.sum(axis=0)
    return least - np.log(total) / _BLEND, np.einsum("bi,bij->ij", weights / total, gradients)


def _mean_product(radii: tuple[float, float, float]) -> float:
    """Return a number in proportion to an ellipsoid's area, roughly (Thomsen)."""
    a, b, c = radii
    return (((a * b) ** 1.6 + (a * c) ** 1.6 + (b * c) ** 1.6) / 3) ** (1 / 1.6)
