"""Lens distortion: where radial and tangential terms move a ray, and how to move it back.

All functions act on normalised image coordinates `xy_camera` = (X/Z, Y/Z), never on pixels. With r²
= x² + y² and q = (p2, p1) the model (Brown, Close-range camera calibration, 1971; OpenCV's first
five coefficients, signs and order) is

    xy' = xy g(r²) + 2 (q·xy) xy + q r²,    g(s) = 1 + k1 s + k2 s² + k3 s³.                     (1)

It is the gradient of a function, so its Jacobian is symmetric; on a disc where that Jacobian is
positive definite the model is one-to-one. `invertible_radius` is the radius of the largest such
disc, and `undistort` answers inside it.
"""

import functools
import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from jaxtyping import Bool, Float

CHUNK = 8192  # rows per pass: ten columns of this length stay in a core's second-level cache
NEWTON_STEPS = 6
DAMPED_STEPS = 60
SOLVED = 1e-13  # largest residual of a solved row, in normalised units (focal lengths)


class Distortion(NamedTuple):
    """The coefficients of a lens, in OpenCV's order; all zero keeps straight lines straight."""

    k1: float = 0.0
    k2: float = 0.0
    p1: float = 0.0
    p2: float = 0.0
    k3: float = 0.0


NONE = Distortion()


def distort(  # noqa: PLR0917
    xy_camera: Float[np.ndarray, "n 2"],
    k1: float = 0.0,
    k2: float = 0.0,
    p1: float = 0.0,
    p2: float = 0.0,
    k3: float = 0.0,
) -> Float[np.ndarray, "n 2"]:
    """Return where the lens puts each ideal image point (eq. 1).

    A negative k1 bends straight lines outwards (barrel), a positive one inwards (pincushion).
    Beyond `invertible_radius` the polynomial folds back: the values mean nothing for a real lens.
    """
    out = np.empty_like(xy_camera, dtype=float)
    for rows in chunks(len(xy_camera)):
        x, y = columns(xy_camera[rows])
        out[rows, 0], out[rows, 1] = bend(x, y, k1, k2, p1, p2, k3)
    return out


def undistort(xy_distorted: Float[np.ndarray, "n 2"], lens: Distortion) -> Float[np.ndarray, "n 2"]:
    """Return the ideal point that the lens moved to each given point, to 1e-13, by Newton's method.

    NaN where no point inside `invertible_radius` is moved there.
    Reference: Nocedal and Wright, Numerical Optimization, 2nd ed., 11.1 (Newton) and 11.2 (damped).

    Examples:
        >>> lens = Distortion(k1=-0.2)
        >>> xy_camera = np.array([[0.3, 0.1]])
        >>> bool(np.allclose(undistort(distort(xy_camera, *lens), lens), xy_camera))
        True
    """
    radius = invertible_radius(lens)
    out = np.array(xy_distorted, dtype=float)
    if not any(lens):
        return out
    for rows in chunks(len(out)):
        target_x, target_y = columns(out[rows])
        x, y, solved = _newton(target_x, target_y, lens)
        solved &= x * x + y * y < radius * radius
        left = np.flatnonzero(~solved)
        if len(left):
            x[left], y[left] = _damped_newton(target_x[left], target_y[left], lens, radius=radius)
        out[rows, 0], out[rows, 1] = x, y
    return out


def is_invertible(xy_camera: Float[np.ndarray, "n 2"], lens: Distortion) -> Bool[np.ndarray, " n"]:
    """Return which ideal points lie in the disc where the lens is one-to-one; NaN rows do not."""
    radius = invertible_radius(lens)
    return np.einsum("ni,ni->n", xy_camera, xy_camera) < radius * radius


@functools.lru_cache(maxsize=256)
def invertible_radius(lens: Distortion) -> float:
    """Return the radius of the largest disc of ideal points on which the lens model is one-to-one.

    Infinity where the model never folds. Along a ray at angle φ from q = (p2, p1), in the frame of
    that ray, with a = |q| cos φ and b = |q| sin φ, the Jacobian of eq. 1 is [[A + 6 a r, 2 b r], [2
    b r, g + 2 a r]] with A = d(r g)/dr. The disc ends at the first r at which its determinant is
    zero for some φ: at φ = π, or where the determinant, quadratic in a, has its minimum.
    """
    k1, k2, p1, p2, k3 = lens
    r = np.polynomial.Polynomial([0.0, 1.0])
    g = np.polynomial.Polynomial([1.0, 0.0, k1, 0.0, k2, 0.0, k3])
    stretch = (r * g).deriv()
    q = math.hypot(p1, p2)
    folds = [*_positive_roots(stretch - 6 * q * r), *_positive_roots(g - 2 * q * r)]
    if q > 0:
        slope = 2 * stretch + 6 * g
        inner = stretch * g - slope**2 / 64 - 4 * (q * r) ** 2
        folds += [root for root in _positive_roots(inner) if abs(slope(root)) <= 32 * q * root]
    return min(folds, default=math.inf)


def jacobian(xy_camera: Float[np.ndarray, "n 2"], lens: Distortion) -> Float[np.ndarray, "n 2 2"]:
    """Return the derivative of `distort` at each point; it is symmetric."""
    x, y = columns(xy_camera)
    xx, xy, yy = _slopes(x, y, *lens)
    return np.stack([xx, xy, xy, yy], axis=-1).reshape(-1, 2, 2)


def chunks(n: int) -> Iterator[slice]:
    """Yield slices over n rows, each short enough to stay in the cache."""
    return (slice(start, start + CHUNK) for start in range(0, n, CHUNK))


def columns(rows: Float[np.ndarray, "n d"]) -> Float[np.ndarray, "d n"]:
    """Return the columns of a few rows, each contiguous."""
    return np.ascontiguousarray(rows.T, dtype=float)


def bend(  # noqa: PLR0917
    x: Float[np.ndarray, " n"],
    y: Float[np.ndarray, " n"],
    k1: float,
    k2: float,
    p1: float,
    p2: float,
    k3: float,
) -> tuple[Float[np.ndarray, " n"], Float[np.ndarray, " n"]]:
    """Return x' and y' of eq. 1, from columns."""
    s = x * x + y * y
    factor = 1.0 + s * (k1 + s * (k2 + s * k3))
    if p1 or p2:
        factor += 2.0 * (p2 * x + p1 * y)
        return factor * x + p2 * s, factor * y + p1 * s
    return factor * x, factor * y


def _slopes(x, y, k1: float, k2: float, p1: float, p2: float, k3: float):  # noqa: PLR0917
    """Return d x'/d x, d x'/d y = d y'/d x and d y'/d y of eq. 1."""
    s = x * x + y * y
    factor = 1.0 + s * (k1 + s * (k2 + s * k3))
    growth = 2.0 * (k1 + s * (2.0 * k2 + s * (3.0 * k3)))
    u, v = growth * x + 4.0 * p2, growth * y + 4.0 * p1
    factor += 2.0 * (p2 * x + p1 * y)
    return factor + x * u, x * v - 2.0 * p1 * x + 2.0 * p2 * y, factor + y * v


def _newton(target_x, target_y, lens: Distortion):
    """Take plain Newton steps from the targets; return x, y and which rows have arrived."""
    x, y = target_x.copy(), target_y.copy()
    with np.errstate(all="ignore"):
        for _ in range(NEWTON_STEPS):
            bent_x, bent_y = bend(x, y, *lens)
            bent_x -= target_x
            bent_y -= target_y
            xx, xy, yy = _slopes(x, y, *lens)
            determinant = xx * yy - xy * xy
            x -= (yy * bent_x - xy * bent_y) / determinant
            y -= (xx * bent_y - xy * bent_x) / determinant
            if np.abs(bent_x).max() < 1e-8 and np.abs(bent_y).max() < 1e-8:
                break  # quadratic: the step just taken has squared this residual
        bent_x, bent_y = bend(x, y, *lens)
        solved = np.hypot(bent_x - target_x, bent_y - target_y) < SOLVED * (
            1 + np.hypot(target_x, target_y)
        )
    return x, y, solved


def _damped_newton(target_x, target_y, lens: Distortion, *, radius: float):
    """Descend from the middle within the disc, halving steps that do not; NaN: no answer."""
    x, y, length = np.zeros_like(target_x), np.zeros_like(target_x), np.ones_like(target_x)
    size = np.hypot(target_x, target_y)
    miss = size.copy()
    with np.errstate(all="ignore"):
        for _ in range(DAMPED_STEPS):
            miss_x, miss_y = _miss(x, y, target_x, target_y=target_y, lens=lens)
            xx, xy, yy = _slopes(x, y, *lens)
            reach = length / (xx * yy - xy * xy)
            next_x = x - reach * (yy * miss_x - xy * miss_y)
            next_y = y - reach * (xx * miss_y - xy * miss_x)
            next_miss = np.hypot(*_miss(next_x, next_y, target_x, target_y=target_y, lens=lens))
            good = (next_x * next_x + next_y * next_y < radius * radius) & (next_miss < miss)
            x[good], y[good], miss[good] = next_x[good], next_y[good], next_miss[good]
            length = np.where(good, np.minimum(1.0, 2.0 * length), 0.5 * length)
            if (miss < SOLVED * (1 + size)).all():
                break
    lost = ~(miss < SOLVED * (1 + size))
    x[lost], y[lost] = np.nan, np.nan
    return x, y


def _miss(x, y, target_x, *, target_y, lens: Distortion):
    bent_x, bent_y = bend(x, y, *lens)
    return bent_x - target_x, bent_y - target_y


def _positive_roots(polynomial: np.polynomial.Polynomial) -> list[float]:
    """Return the real positive roots, rising; rounding may split a double root."""
    roots = polynomial.trim(0.0).roots()
    real = roots[np.abs(roots.imag) < 1e-7 * (1 + np.abs(roots.real))].real
    return sorted(float(root) for root in real if root > 0)
