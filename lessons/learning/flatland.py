"""A flat world of three coloured discs, and cameras around it whose photographs are one row of
pixels.

Reference: Abbott, Flatland, 1884, section 1: how its people see.
"""

import functools

import numpy as np
from jaxtyping import Float

from workbench.geometry.cameras.volume_rendering import ray_weights, samples_on, seen

DISCS = np.array([[-0.35, 0.20, 0.28], [0.40, 0.35, 0.20], [0.15, -0.40, 0.25]])  # x, y, radius (m)
COLORS = np.array([[0.90, 0.30, 0.10], [0.10, 0.40, 0.90], [0.20, 0.80, 0.30]])
DENSITY = 25.0  # in the discs, 1/m
DISTANCE, HALF_VIEW = 2.0, 25.0  # of the cameras, m and degrees
REACH = (0.9, 3.1)  # from a camera, m: all discs lie between
_FINE = 300


def medium(
    p: Float[np.ndarray, "*n 2"],
) -> tuple[Float[np.ndarray, "*n"], Float[np.ndarray, "*n 3"]]:
    """Return density (1/m) and colour at points of the plane: every disc has darker and lighter
    slices.
    """
    density = np.zeros(p.shape[:-1])
    color = np.zeros((*p.shape[:-1], 3))
    for (x, y, radius), own in zip(DISCS, COLORS, strict=True):
        right, up = p[..., 0] - x, p[..., 1] - y
        inside = right**2 + up**2 < radius**2
        slices = 0.75 + 0.25 * np.sign(np.sin(6 * np.arctan2(up[inside], right[inside])))
        density[inside] = DENSITY
        color[inside] = own * slices[:, None]
    return density, color


def rays_of(angle: float, pixels: int) -> tuple[Float[np.ndarray, "w 2"], Float[np.ndarray, "w 2"]]:
    """Return where the rays of a camera begin and their unit directions; it stands on a circle and
    looks at the middle.

    Args:
        angle: Where on the circle, radians.
        pixels: How many rays.
    """
    p = DISTANCE * np.array([np.cos(angle), np.sin(angle)])
    ahead = -p / DISTANCE
    right = np.array([-p[1], p[0]]) / DISTANCE
    d = ahead + np.tan(np.radians(HALF_VIEW)) * np.linspace(-1, 1, pixels)[:, None] * right
    return np.tile(p, (pixels, 1)), d / np.linalg.norm(d, axis=1, keepdims=True)


@functools.lru_cache(maxsize=64)
def photograph(angle: float, pixels: int) -> Float[np.ndarray, "w 3"]:
    """Return what a camera sees of the discs before a white background, 0 to 1; read-only."""
    q, spacing = samples_on(*rays_of(angle, pixels), REACH, count=_FINE)
    density, color = medium(q)
    image = seen(ray_weights(density, spacing), color)
    image.flags.writeable = False
    return image
