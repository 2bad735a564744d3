"""Evenly spread clouds of known shapes, and what can be done to them: grow, bunch, bulge, lose a
part, a point, the order.

A shape is a map from t in [0, 1) to points, so that the same shape can be taken with any density
along t. Metres, about a metre in radius. Flat shapes stand upright in the plane y = 0, +Z up.
"""

from collections.abc import Callable
from typing import Literal

import numpy as np
import scipy
from jaxtyping import Float

Shape = Literal["ring", "two discs", "spiral", "sphere", "torus"]
Cloud = Float[np.ndarray, "n 3"]

SHAPES: tuple[Shape, ...] = ("ring", "two discs", "spiral", "sphere", "torus")
_GOLDEN = np.pi * (3 - np.sqrt(5))  # the angle between neighbours of a sunflower


def shape_at(shape: Shape, t: Float[np.ndarray, "n"], count: int) -> Cloud:
    """Return the points of a shape at parameters t, taken modulo 1.

    Args:
        shape: Which one. Equal steps of t cover equal lengths of ring and spiral, and equal areas
            of the others.
        t: Where, from 0 to 1.
        count: Of how many even points the winding of discs, sphere and torus is made.
    """
    t = np.mod(t, 1.0)
    zero = np.zeros_like(t)
    turn = _GOLDEN * count * t
    if shape == "ring":
        return np.column_stack([np.cos(2 * np.pi * t), zero, np.sin(2 * np.pi * t)])
    if shape == "two discs":
        right = t >= 0.5
        r = 0.42 * np.sqrt(2 * t - right)
        x = np.where(right, 0.55, -0.55)
        return np.column_stack([x + r * np.cos(turn), zero, r * np.sin(turn)])
    if shape == "spiral":
        r = 0.15 + 0.85 * _where_reached(
            t, lambda s: np.hypot(0.85, 4.5 * np.pi * (0.15 + 0.85 * s))
        )
        angle = 4.5 * np.pi * (r - 0.15) / 0.85
        return np.column_stack([r * np.cos(angle), zero, r * np.sin(angle)])
    if shape == "sphere":
        z = 1 - 2 * t
        r = np.sqrt(1 - z * z)
        return np.column_stack([r * np.cos(turn), r * np.sin(turn), z])
    around = 2 * np.pi * t
    tube = (
        2
        * np.pi
        * _where_reached(
            np.mod(turn / (2 * np.pi), 1.0), lambda s: 0.7 + 0.3 * np.cos(2 * np.pi * s)
        )
    )
    r = 0.7 + 0.3 * np.cos(tube)
    return np.column_stack([r * np.cos(around), r * np.sin(around), 0.3 * np.sin(tube)])


def spread(shape: Shape, count: int) -> Cloud:
    """Return `count` points spread evenly over a shape."""
    return shape_at(shape, (np.arange(count) + 0.5) / count, count)


def bunched(shape: Shape, count: int, share: float, *, width: float = 0.04) -> Cloud:
    """Return `count` points of a shape of which a share is crowded into the first `width` of it,
    the rest even.

    Every part of the shape keeps some points near it, so that nearest neighbours hardly notice.
    """
    crowd = min(round(share * count), count - 1)
    even = (np.arange(count - crowd) + 0.5) / (count - crowd)
    return shape_at(
        shape, np.concatenate([even, width * np.arange(crowd) / max(crowd - 1, 1)]), count
    )


def crowded(p: Cloud, share: float, part: float = 0.04) -> Cloud:
    """Return as many points of any cloud, a share of them crowded on the `part` of it nearest to
    its highest point.
    """
    crowd = min(round(share * len(p)), len(p) - 1)
    even = np.linspace(0, len(p) - 1, len(p) - crowd).round().astype(int)
    near = _nearest_to(p, p[np.argmax(p[:, 2])], round(part * len(p)))
    return p[np.concatenate([even, np.resize(near, crowd)])]


def grown(p: Cloud, share: float) -> Cloud:
    """Return the cloud larger by a share of its size, about its middle."""
    middle = p.mean(axis=0)
    return middle + (1 + share) * (p - middle)


def bumped(p: Cloud, height: float, part: float = 0.125) -> Cloud:
    """Return the cloud with that part of its points which is nearest to its highest one pushed
    outward by `height`.

    Every pushed point moves by `height` metres away from the middle of the cloud.
    """
    middle = p.mean(axis=0)
    pushed = _nearest_to(p, p[np.argmax(p[:, 2])], round(part * len(p)))
    v = p[pushed] - middle
    out = p.copy()
    out[pushed] += height * v / np.maximum(np.linalg.norm(v, axis=1, keepdims=True), 1e-12)
    return out


def part_missing(p: Cloud, share: float) -> Cloud:
    """Return as many points, all of them points of the cloud, but none from the share of it with
    the largest x.

    Points that are left take the places of the missing ones, in turn, so that some count several
    times.
    """
    left = np.argsort(p[:, 0], kind="stable")[: max(round((1 - share) * len(p)), 1)]
    return p[np.resize(left, len(p))]


def with_outlier(p: Cloud, distance: float) -> Cloud:
    """Return the cloud with its highest point lifted by `distance` metres."""
    out = p.copy()
    out[np.argmax(p[:, 2]), 2] += distance
    return out


def shuffled(p: Cloud, share: float, rng: np.random.Generator) -> Cloud:
    """Return the same points with a share of the rows in another order."""
    rows = rng.permutation(len(p))[: round(share * len(p))]
    out = p.copy()
    out[rows] = p[np.roll(rows, 1)]
    return out


def doubled(p: Cloud, share: float) -> Float[np.ndarray, "k 3"]:
    """Return the cloud and once more a share of its points, those with the smallest x: other
    weights, no other place.
    """
    again = np.argsort(p[:, 0], kind="stable")[: round(share * len(p))]
    return np.concatenate([p, p[again]])


def blob(count: int, radius: float, flat: bool, *, rng: np.random.Generator) -> Cloud:
    """Return points spread at random over a disc, or a ball, left of and a little above the
    origin.
    """
    v = rng.normal(size=(count, 3))
    if flat:
        v[:, 1] = 0.0
    r = radius * rng.random(count) ** (1 / 2 if flat else 1 / 3)
    return np.array([-0.25, 0.0, 0.1]) + r[:, None] * v / np.linalg.norm(v, axis=1, keepdims=True)


def _nearest_to(p: np.ndarray, p_centre: np.ndarray, count: int) -> np.ndarray:
    return np.argsort(np.linalg.norm(p - p_centre, axis=1), kind="stable")[: max(count, 1)]


def _where_reached(share: np.ndarray, density: Callable[[np.ndarray], np.ndarray]) -> np.ndarray:
    """Return where from 0 to 1 a quantity with that density reaches a share of its total."""
    s = np.linspace(0.0, 1.0, 2001)
    total = scipy.integrate.cumulative_trapezoid(density(s), s, initial=0)
    return np.interp(share, total / total[-1], s)
