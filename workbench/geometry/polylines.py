"""Outlines as the segments they are drawn with: polylines, pairs of points, rectangles, circles."""

import numpy as np
from jaxtyping import Float


def segments(p: Float[np.ndarray, "n d"], *, closed: bool = False) -> Float[np.ndarray, "m 2 d"]:
    """Return the segments from each point to the next; closed, also from the last to the first."""
    if closed:
        return np.stack([p, np.roll(p, -1, axis=0)], axis=1)
    return np.stack([p[:-1], p[1:]], axis=1)


def between(
    p: Float[np.ndarray, "*n d"], q: Float[np.ndarray, "*k d"]
) -> Float[np.ndarray, "m 2 d"]:
    """Return the segments from points to partners in the same rows; a single one serves all.

    Examples:
        >>> between(np.array([0.0, 0.0]), np.array([1.0, 2.0])).tolist()
        [[[0.0, 0.0], [1.0, 2.0]]]
    """
    return np.stack(np.broadcast_arrays(np.atleast_2d(p), np.atleast_2d(q)), axis=1)


def at_height(p: Float[np.ndarray, "*n d"], height: float = 0.0) -> Float[np.ndarray, "*n 3"]:
    """Return points of the plane in space at a height; what is in space already stays as it is.

    Examples:
        >>> at_height(np.array([[1.0, 2.0]]), 3.0).tolist()
        [[1.0, 2.0, 3.0]]
    """
    return (
        p if p.shape[-1] == 3 else np.concatenate([p, np.full((*p.shape[:-1], 1), height)], axis=-1)
    )


def rectangle(
    low: Float[np.ndarray, "2"], high: Float[np.ndarray, "2"]
) -> Float[np.ndarray, "4 2"]:
    """Return the corners of an upright rectangle, the lowest first, then the next along x."""
    (x0, y0), (x1, y1) = low, high
    return np.array([[x0, y0], [x1, y0], [x1, y1], [x0, y1]], float)


def circle(pieces: int = 64) -> Float[np.ndarray, "n 2"]:
    """Return points of the unit circle from +x counterclockwise, the first again at the end."""
    turn = np.linspace(0.0, 2.0 * np.pi, pieces + 1)
    return np.column_stack([np.cos(turn), np.sin(turn)])


def sphere_rings(
    centre: Float[np.ndarray, "3"], radius: float, pieces: int = 64
) -> Float[np.ndarray, "n 2 3"]:
    """Return three great circles of a sphere and two circles of latitude, as segments."""
    c, s = circle(pieces).T
    zero = np.zeros(pieces + 1)
    rings = [
        np.column_stack([c, s, zero]),
        np.column_stack([c, zero, s]),
        np.column_stack([zero, c, s]),
    ]
    rings += [np.column_stack([0.8 * c, 0.8 * s, zero + z]) for z in (-0.6, 0.6)]
    return np.concatenate([segments(centre + radius * ring) for ring in rings])


def near_arc(
    circle: Float[np.ndarray, "3"], reach: float, pieces: int = 96
) -> Float[np.ndarray, "n 2"]:
    """Return points of a circle (x, y, ±r), or of a large one the arc nearest to the origin."""
    radius = max(abs(float(circle[2])), 1e-9)
    half = min(np.pi, reach / radius)
    turn = np.arctan2(-circle[1], -circle[0]) + np.linspace(-half, half, pieces + 1)
    return circle[:2] + radius * np.column_stack([np.cos(turn), np.sin(turn)])


def cylinder_rings(
    p_axis: Float[np.ndarray, "3"], R_world_cylinder: Float[np.ndarray, "3 3"], radius: float
) -> Float[np.ndarray, "n 2 3"]:
    """Return three rings of a cylinder, two radii long, and six lines along its z, as segments."""
    ring = radius * circle(48) @ R_world_cylinder[:, :2].T + p_axis
    up = radius * R_world_cylinder[:, 2]
    rings = np.concatenate([segments(ring + k * up) for k in (-1.0, 0.0, 1.0)])
    return np.concatenate([rings, between(ring[::8] - up, ring[::8] + up)])


def fan(corners: int) -> np.ndarray:
    """Return the triangles (n - 2, 3) of a convex polygon with n corners, all from the first."""
    k = np.arange(1, corners - 1)
    return np.column_stack([np.zeros_like(k), k, k + 1])
