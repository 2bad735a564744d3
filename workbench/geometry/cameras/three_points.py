"""Where a camera was that saw three known points: the P3P problem, for many samples at once.

Notation: `n_camera` are the unit rays on which `p_world`, metres, are seen; s the lengths of the
three rays; a, b, c the sides of the triangle of the points, opposite to the first, second and
third; u = s2 / s1 and v = s3 / s1. A sample may have several solutions: with them comes the sample
of each.
Reference: Haralick, Lee, Ottenberg and Nölle, Review and Analysis of Solutions of the Three Point
Perspective Pose Estimation Problem, 1994, sections 2 and 3.1 (Grunert 1841).
"""

import numpy as np
from jaxtyping import Float, Int

from workbench.geometry.two_views.homography import homogeneous

_REAL = 1e-6  # an imaginary part below this share of a root is rounding
# How well, in shares of a triangle's largest side squared, the law of cosines has to hold
_SOLVED = 1e-9
_OPPOSITE = ((1, 2), (0, 2), (0, 1))  # the ends of the sides a, b, c
_BAD = 1e300
_TWOFOLD, _SAME = 1e-5, 1e-6


def unit_rays(xy: Float[np.ndarray, "*k 2"]) -> Float[np.ndarray, "*k 3"]:
    """Return the unit vectors, in the camera's frame, of normalised image coordinates.

    Examples:
        >>> unit_rays(np.array([[0.0, 0.0], [0.75, 0.0]])).round(6).tolist()
        [[0.0, 0.0, 1.0], [0.6, 0.0, 0.8]]
    """
    v_camera = homogeneous(xy)
    return v_camera / np.linalg.norm(v_camera, axis=-1, keepdims=True)


def quartics(
    p_world: Float[np.ndarray, "k 3 3"], n_camera: Float[np.ndarray, "k 3 3"]
) -> Float[np.ndarray, "k 5"]:
    """Return Grunert's quartics in v = s3 / s1, highest power first (Haralick et al., eq. 9)."""
    return _quartics(*_sides_and_cosines(p_world, n_camera))


def three_point_lengths(
    p_world: Float[np.ndarray, "k 3 3"], n_camera: Float[np.ndarray, "k 3 3"]
) -> tuple[Float[np.ndarray, "m 3"], Int[np.ndarray, " m"]]:
    """Return all lengths of three rays, metres, that put the points as far apart as they are.

    Lengths are positive, up to four rows for a sample, none for points in one place or on one line.
    Reference: Haralick et al. 1994, eq. 8 and 9, and Newton steps on their eq. 1 to 3.
    """
    sides, cosines = _sides_and_cosines(p_world, n_camera)
    with np.errstate(all="ignore"):
        coefficients = _quartics(sides, cosines)
        companion = np.zeros((len(p_world), 4, 4))
        companion[:, 1:, :3] = np.eye(3)
        companion[:, :, 3] = -coefficients[:, :0:-1] / coefficients[:, :1]
        usable = np.isfinite(companion[:, :, 3]).all(axis=1) & (
            np.abs(companion[:, :, 3]).max(axis=1) < _BAD
        )
        roots = np.linalg.eigvals(np.where(usable[:, None, None], companion, 0.0))
        v = roots.real
        real = usable[:, None] & (np.abs(roots.imag) < _REAL * (1.0 + np.abs(v))) & (v > 0.0)
        of_sample, root = np.nonzero(real)
        v = v[of_sample, root]
        (a2, b2, c2), (cos_a, cos_b, cos_c) = sides[:, of_sample], cosines[:, of_sample]
        p = (a2 - c2) / b2
        q = 2.0 * (cos_c - v * cos_a)
        s1 = np.sqrt(b2 / (1.0 + v * v - 2.0 * v * cos_b))
        u = ((p - 1.0) * v * v - 2.0 * p * cos_b * v + 1.0 + p) / q
        twofold = np.flatnonzero(np.abs(q) < _TWOFOLD)  # both u of the side c belong to this v
        apart = np.sqrt(np.maximum(cos_c**2 - 1.0 + c2 / s1**2, 0.0))[twofold]
        u[twofold] = cos_c[twofold] + apart
        rows = np.concatenate([np.arange(len(u)), twofold])
        u = np.concatenate([u, cos_c[twofold] - apart])
        v = v[rows]
        s1 = s1[rows]
        of_sample = of_sample[rows]
        s, left = _polished(
            np.stack([s1, u * s1, v * s1], axis=1), sides[:, of_sample], cosines[:, of_sample]
        )
        largest = np.max(sides[:, of_sample], axis=0, initial=0.0)
        kept = (s > 0.0).all(axis=1) & (left < _SOLVED * largest) & (u > 0.0)
    for sample in np.unique(of_sample[len(of_sample) - len(twofold) :]):
        same = np.flatnonzero(kept & (of_sample == sample))
        for k, row in enumerate(same):
            kept[row] = (
                not (np.abs(s[same[:k]] - s[row]) < _SAME * s[row])
                .all(axis=1)[kept[same[:k]]]
                .any()
            )
    order = np.flatnonzero(kept)[np.argsort(of_sample[kept], kind="stable")]
    return s[order], of_sample[order]


def motions_from_lengths(
    p_world: Float[np.ndarray, "m 3 3"],
    n_camera: Float[np.ndarray, "m 3 3"],
    s: Float[np.ndarray, "m 3"],
) -> Float[np.ndarray, "m 4 4"]:
    """Return the T_camera_world from three points to the ends of their rays; NaN on one line."""
    p_camera = n_camera * s[..., None]
    T = np.zeros((len(s), 4, 4))
    with np.errstate(all="ignore"):
        R = _frames(p_camera) @ np.swapaxes(_frames(p_world), -1, -2)
    T[:, :3, :3] = R
    T[:, 3, 3] = 1.0
    T[:, :3, 3] = p_camera.mean(axis=1) - (R @ p_world.mean(axis=1)[..., None])[..., 0]
    return T


def p3p(
    p_world: Float[np.ndarray, "k 3 3"], xy: Float[np.ndarray, "k 3 2"]
) -> tuple[Float[np.ndarray, "m 4 4"], Int[np.ndarray, " m"]]:
    """Return all T_camera_world from which three points are seen at these normalised coordinates.

    None to four motions for a sample, mostly two, each with all three points in front.

    Examples:
        >>> p_world = np.array([[[0.0, 1, 0], [-0.8, -0.6, 0], [0.8, -0.6, 0]]])
        >>> p_camera = p_world + [0.0, 0.0, 2.0]
        >>> Ts_camera_world, of_sample = p3p(p_world, p_camera[..., :2] / p_camera[..., 2:])
        >>> bool(np.abs(Ts_camera_world[:, :3, 3] - [0.0, 0.0, 2.0]).max(axis=1).min() < 1e-9)
        True
    """
    n_camera = unit_rays(xy)
    s, of_sample = three_point_lengths(p_world, n_camera)
    Ts = motions_from_lengths(p_world[of_sample], n_camera[of_sample], s)
    kept = np.isfinite(Ts).all(axis=(1, 2))
    return Ts[kept], of_sample[kept]


def solution_counts(
    p_world: Float[np.ndarray, "k 3 3"], xy: Float[np.ndarray, "k 3 2"]
) -> Int[np.ndarray, "5"]:
    """Return how many of the samples have none, one, ..., four solutions."""
    _, of_sample = p3p(p_world, xy)
    return np.bincount(np.bincount(of_sample, minlength=len(p_world)), minlength=5)


def _sides_and_cosines(p_world: np.ndarray, n_camera: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the squared sides a, b, c (3, k), and the cosines between the rays to their ends."""
    sides = np.stack([np.square(p_world[:, i] - p_world[:, j]).sum(axis=-1) for i, j in _OPPOSITE])
    return sides, np.stack([(n_camera[:, i] * n_camera[:, j]).sum(axis=-1) for i, j in _OPPOSITE])


def _quartics(sides: np.ndarray, cosines: np.ndarray) -> np.ndarray:
    (a2, b2, c2), (cos_a, cos_b, cos_c) = sides, cosines
    with np.errstate(all="ignore"):
        p = (a2 - c2) / b2
        q = (a2 + c2) / b2
        r = (b2 - c2) / b2
        w = (b2 - a2) / b2
        A4 = (p - 1) ** 2 - 4 * c2 / b2 * cos_a**2
        A3 = 4 * (p * (1 - p) * cos_b - (1 - q) * cos_a * cos_c + 2 * c2 / b2 * cos_a**2 * cos_b)
        A2 = 2 * (
            p**2
            - 1
            + 2 * p**2 * cos_b**2
            + 2 * r * cos_a**2
            - 4 * q * cos_a * cos_b * cos_c
            + 2 * w * cos_c**2
        )
        A1 = 4 * (-p * (1 + p) * cos_b + 2 * a2 / b2 * cos_c**2 * cos_b - (1 - q) * cos_a * cos_c)
        A0 = (1 + p) ** 2 - 4 * a2 / b2 * cos_c**2
    return np.stack([A4, A3, A2, A1, A0], axis=-1)


def _polished(
    s: np.ndarray, sides: np.ndarray, cosines: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Take Newton steps on the law of cosines; return the lengths and what is left of it."""
    left = np.full(len(s), np.inf)
    for _ in range(3):
        ends = [
            (s[:, i], s[:, j], cosine) for (i, j), cosine in zip(_OPPOSITE, cosines, strict=True)
        ]
        g = np.stack(
            [
                x * x + y * y - 2 * x * y * cosine - side
                for (x, y, cosine), side in zip(ends, sides, strict=True)
            ]
        )
        left = np.abs(g).max(axis=0, initial=0.0)
        J = np.zeros((len(s), 3, 3))
        for row, ((i, j), (x, y, cosine)) in enumerate(zip(_OPPOSITE, ends, strict=True)):
            J[:, row, i], J[:, row, j] = 2 * (x - y * cosine), 2 * (y - x * cosine)
        good = (np.abs(np.linalg.det(J)) > 1e-12) & np.isfinite(J).all(axis=(1, 2))
        step = np.linalg.solve(np.where(good[:, None, None], J, np.eye(3)), g.T[..., None])[..., 0]
        s = np.where(good[:, None], s - step, s)
    return s, left


def _frames(p: np.ndarray) -> np.ndarray:
    """Return the axes of each triangle: along its first side, in its plane, and across."""
    e1 = p[:, 1] - p[:, 0]
    e1 = e1 / np.linalg.norm(e1, axis=1, keepdims=True)
    e3 = np.cross(e1, p[:, 2] - p[:, 0])
    e3 = e3 / np.linalg.norm(e3, axis=1, keepdims=True)
    return np.stack([e1, np.cross(e3, e1), e3], axis=2)
