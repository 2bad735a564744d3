"""Cylinders in space: distances of points from them, and their derivatives.

Convention: (x, y, z, u, v, w, r): a point of the axis, its unit direction, and the radius, metres.
Sliding the point along the axis, or scaling the direction, changes nothing, so a small step has
five numbers: two shifts across the axis (metres), two tilts of it (radians), and the change of
radius.
Reference: Lukács, Martin and Marshall, Faithful least-squares fitting of spheres, cylinders, cones
and tori, 1998.
"""

import numpy as np
from jaxtyping import Float

from workbench.geometry.motions import across


def linearise_cylinder(
    cylinder: Float[np.ndarray, "*k 7"], p: Float[np.ndarray, "*m n 3"]
) -> tuple[Float[np.ndarray, "*r n"], Float[np.ndarray, "*r n 5"]]:
    """Return signed distances of points from cylinders and their slopes by a small step."""
    n_axis = cylinder[..., 3:6]
    u, v = across(n_axis)
    w = p - cylinder[..., None, :3]
    along = (w * n_axis[..., None, :]).sum(-1)
    out = w - along[..., None] * n_axis[..., None, :]
    length = np.sqrt(np.square(out).sum(-1))
    out = out / np.where(length > 0.0, length, np.inf)[..., None]
    by_u, by_v = (out * u[..., None, :]).sum(-1), (out * v[..., None, :]).sum(-1)
    slopes = np.stack(
        [-by_u, -by_v, -along * by_u, -along * by_v, np.full(length.shape, -1.0)], axis=-1
    )
    return length - cylinder[..., 6:], slopes


def retract_cylinder(
    cylinder: Float[np.ndarray, "*k 7"], step: Float[np.ndarray, "*k 5"]
) -> Float[np.ndarray, "*k 7"]:
    """Return the cylinder that a small step leads to; its direction stays a unit vector."""
    u, v = across(cylinder[..., 3:6])
    p_axis = cylinder[..., :3] + step[..., 0:1] * u + step[..., 1:2] * v
    n_axis = cylinder[..., 3:6] + step[..., 2:3] * u + step[..., 3:4] * v
    n_axis = n_axis / np.linalg.norm(n_axis, axis=-1, keepdims=True)
    return np.concatenate([p_axis, n_axis, cylinder[..., 6:] + step[..., 4:]], axis=-1)
