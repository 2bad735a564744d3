"""Affine and projective maps as 4x4 matrices: built from factors, and told apart.

A map acts on columns (x, y, z, w): a point has w = 1, a direction w = 0. Factors compose to the
left: `B @ A` does A first. Metres and radians; every factor but a translation leaves the origin
where it is.

Reference: Hartley and Zisserman, Multiple View Geometry in Computer Vision, 2nd ed., 2004,
sections 2.4 and 3.4 (the hierarchy of transformations that `Kind` follows).
"""

from enum import Enum

import numpy as np
from jaxtyping import Float

from workbench.geometry.motions.rigid import motion
from workbench.geometry.motions.rotations import Axis, rotation_about

Map = Float[np.ndarray, "4 4"]


class Kind(Enum):
    """What a 4x4 does, from what keeps most to what keeps least."""

    IDENTITY = "identity"
    RIGID = "rigid motion"
    MIRRORED = "mirrored rigid motion"
    SIMILARITY = "similarity"
    AFFINE = "affine map"
    PROJECTIVE = "projective map"


def translation(offset: Float[np.ndarray, "3"]) -> Map:
    """Return the map that moves every point by an offset in metres, and no direction."""
    return motion(np.eye(3), offset)


def rotation(axis: Axis, angle: float) -> Map:
    """Return the rotation about a coordinate axis by an angle in radians."""
    return motion(rotation_about(axis, angle), np.zeros(3))


def scaling(factors: Float[np.ndarray, "3"]) -> Map:
    """Return the map that multiplies x, y, z by a factor each; negative mirrors, zero flattens."""
    return motion(np.diag(factors), np.zeros(3))


def shear(along: Axis, across: Axis, amount: float) -> Map:
    """Return the map that shifts points along one axis by `amount` times their coordinate across.

    Raises:
        ValueError: If the two axes are the same; that would be a scaling.
    """
    if along == across:
        raise ValueError(f"a shear needs two different axes, not {along} twice")
    A = np.eye(4)
    A["xyz".index(along), "xyz".index(across)] = amount
    return A


def reflection(normal: Float[np.ndarray, "3"]) -> Map:
    """Return the mirror image in the plane through the origin with this normal of any length.

    Raises:
        ValueError: If the normal is zero or not finite.
    """
    squared = normal @ normal
    if not 0.0 < squared < np.inf:
        raise ValueError(f"the normal {normal} gives no mirror plane")
    return motion(np.eye(3) - 2.0 / squared * np.outer(normal, normal), np.zeros(3))


def perspective(slope: Float[np.ndarray, "3"]) -> Map:
    """Return the projective map by w = 1 + slope . p: lines along d meet at d / (slope . d)."""
    H = np.eye(4)
    H[3, :3] = slope
    return H


def homogeneous(p: Float[np.ndarray, "n 3"], w: float = 1.0) -> Float[np.ndarray, "n 4"]:
    """Return rows (x, y, z, w): w = 1 for points, w = 0 for directions."""
    return np.column_stack([p, np.full(len(p), w)])


def from_homogeneous(p_h: Float[np.ndarray, "n 4"]) -> Float[np.ndarray, "n 3"]:
    """Return the points that rows (x, y, z, w) stand for: each divided by its w.

    Raises:
        ValueError: If a w is zero: that row is a direction, a point at infinity.
    """
    w = p_h[:, 3:]
    if (w == 0).any():
        raise ValueError(f"row {int(np.argmax(w[:, 0] == 0))} has w = 0: a direction is no point")
    return p_h[:, :3] / w


def transform(H: Map, p: Float[np.ndarray, "n 3"]) -> Float[np.ndarray, "n 3"]:
    """Return points under any 4x4, a projective one included.

    Raises:
        ValueError: If a point goes to infinity.
    """
    return from_homogeneous(homogeneous(p) @ H.T)


def transform_directions(A: Map, v: Float[np.ndarray, "n 3"]) -> Float[np.ndarray, "n 3"]:
    """Return directions (w = 0) under an affine map; normals need the inverse transpose instead."""
    return v @ A[:3, :3].T


def is_affine(H: Map) -> bool:
    """Return whether a map keeps parallel lines parallel: its last row is 0 0 0 1."""
    return bool(np.array_equal(H[3], (0, 0, 0, 1)))


def kind_of(H: Map, tolerance: float = 1e-9) -> Kind:
    """Return the narrowest kind of a 4x4, up to a tolerance; a similarity may mirror as well."""
    if np.abs(H[3] - (0, 0, 0, 1)).max() > tolerance:
        return Kind.PROJECTIVE
    if np.abs(H - np.eye(4)).max() <= tolerance:
        return Kind.IDENTITY
    G = H[:3, :3].T @ H[:3, :3]
    squared_scale = np.trace(G) / 3.0
    if squared_scale <= tolerance or np.abs(G - squared_scale * np.eye(3)).max() > tolerance * max(
        squared_scale, 1.0
    ):
        return Kind.AFFINE
    if abs(squared_scale - 1.0) > tolerance:
        return Kind.SIMILARITY
    return Kind.RIGID if np.linalg.det(H[:3, :3]) > 0 else Kind.MIRRORED
