"""Least-squares alignment of paired points: rigid, similarity, affine, and point to plane.

Pairs are rows of `p_target` and `p_source`, each in its own frame, with one weight of at least zero
per pair, all equal when left out. Functions of pairs raise ValueError where there are none, their
numbers differ, a number is not finite, or weights are not usable. Moments are taken about the first
pair and in chunks that stay in cache: about the origin they would lose all digits for clouds far
from it (a degree of rotation at an offset of 1e6), and centring whole copies first takes three
times as long.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float

from workbench.geometry.motions.rigid import apply, exp_so3, motion, rotation_angle

CHUNK = 8192


def align_rigid(
    p_target: Float[np.ndarray, "n 3"],
    p_source: Float[np.ndarray, "n 3"],
    weights: Float[np.ndarray, "n"] | None = None,
) -> Float[np.ndarray, "4 4"]:
    """Return the rigid T_target_source that minimises the sum of squared distances between pairs.

    The result is always a rotation (determinant +1), also for noisy flat or mirrored points.
    Collinear points leave the turn about their line open and one pair leaves all of it; any one
    solution is returned.
    Reference: Umeyama, Least-squares estimation of transformation parameters between two point
    patterns, 1991, eq. 39-43 with scale 1; Kabsch 1976 and 1978.

    Examples:
        >>> p_source = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]])
        >>> T_target_source = align_rigid(p_source + np.array([2.0, 0.0, 0.0]), p_source)
        >>> bool(np.allclose(T_target_source[:3], [[1, 0, 0, 2], [0, 1, 0, 0], [0, 0, 1, 0]]))
        True
    """
    m = _moments(p_target, p_source, weights)
    R, _ = _rotation(m.cross)
    return motion(R, m.mean_target - R @ m.mean_source)  # eq. 41


def align_similarity(
    p_target: Float[np.ndarray, "n 3"],
    p_source: Float[np.ndarray, "n 3"],
    weights: Float[np.ndarray, "n"] | None = None,
) -> Float[np.ndarray, "4 4"]:
    """Return the T_target_source of rotation, one scale and translation that fits pairs best.

    Source points that all coincide give scale 1 (Umeyama 1991, eq. 39-43).

    Examples:
        >>> p_source = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]])
        >>> align_similarity(3.0 * p_source, p_source).diagonal().round(6).tolist()
        [3.0, 3.0, 3.0, 1.0]
    """
    m = _moments(p_target, p_source, weights)
    R, explained = _rotation(m.cross)
    scale = _scale(m, explained)
    return motion(scale * R, m.mean_target - scale * R @ m.mean_source)


def similarity_scale(
    p_target: Float[np.ndarray, "n 3"], p_source: Float[np.ndarray, "n 3"]
) -> float:
    """Return how many times larger the target is than the source, by least squares.

    Noise in the source makes it too small (regression dilution: Fuller, Measurement Error Models,
    1987, 1.1.1). Source points that all coincide give 1 (Umeyama 1991, eq. 42).

    Examples:
        >>> round(similarity_scale(2.5 * np.eye(3) + 1.0, np.eye(3)), 6)
        2.5
    """
    m = _moments(p_target, p_source, None)
    return _scale(m, _rotation(m.cross)[1])


def align_affine(
    p_target: Float[np.ndarray, "n 3"],
    p_source: Float[np.ndarray, "n 3"],
    weights: Float[np.ndarray, "n"] | None = None,
) -> Float[np.ndarray, "4 4"]:
    """Return the affine T_target_source that fits pairs best.

    Directions which the source points do not span (flat or collinear clouds) are left as they are:
    the normal equations A C_ss = C_ts are solved for A - I.
    """
    m = _moments(p_target, p_source, weights)
    A = np.eye(3) + (m.cross - m.source) @ np.linalg.pinv(m.source, rcond=1e-12, hermitian=True)
    return motion(A, m.mean_target - A @ m.mean_source)


def point_to_plane_step(
    p_target: Float[np.ndarray, "n 3"],
    p_source: Float[np.ndarray, "n 3"],
    n_target: Float[np.ndarray, "n 3"],
) -> Float[np.ndarray, "4 4"]:
    """Return the small motion that brings points closest to the tangent planes at their partners.

    Minimises the sum of ((p_source + w x p_source + v - p_target) . n_target)^2, all in the target
    frame, and returns the proper rotation by w with v, to be composed on the left. Directions in
    which the planes hold nothing (sliding along a plane, turning a sphere) get no motion.
    Reference: Low, Linear least-squares optimization for point-to-plane ICP surface registration,
    2004, eq. 8-10; the error is that of Chen and Medioni 1992.

    Raises:
        ValueError: If there are no pairs, their numbers differ, or a number is not finite.
    """
    _check_pairs(p_target, p_source)
    # one line per coordinate: sums over short rows take three times as long
    p, q, n = (np.ascontiguousarray(v.T) for v in (p_source, p_target, n_target))
    centre = p.mean(axis=1)
    normal_matrix = np.zeros((6, 6))
    right_side = np.zeros(6)
    for some in chunks(len(p_source)):
        x, y, z = p[:, some] - centre[:, None]
        a, b, c = n[:, some]
        # Eq. 8: p x n and n of each pair
        jacobian = np.stack([y * c - z * b, z * a - x * c, x * b - y * a, a, b, c])
        gap = ((q[:, some] - p[:, some]) * n[:, some]).sum(axis=0)
        normal_matrix += jacobian @ jacobian.T
        right_side += jacobian @ gap
    if not (np.isfinite(normal_matrix).all() and np.isfinite(right_side).all()):
        raise ValueError("a point or a normal is not a finite number")
    size = np.sqrt(np.trace(normal_matrix[:3, :3]) / len(p_source)) or 1.0
    unit = np.array([size, size, size, 1.0, 1.0, 1.0])  # metres out of the rank decision
    # Eq. 10
    x = (
        np.linalg.lstsq(normal_matrix / np.outer(unit, unit), right_side / unit, rcond=1e-12)[0]
        / unit
    )
    R = exp_so3(x[:3])
    return motion(R, centre + x[3:] - R @ centre)


def nearest_rotation(A: Float[np.ndarray, "*k 3 3"]) -> Float[np.ndarray, "*k 3 3"]:
    """Return a rotation nearest to each matrix in the least-squares sense."""
    U, _, Vt = np.linalg.svd(A)
    U[..., 2] *= np.sign(np.linalg.det(U) * np.linalg.det(Vt))[..., None]  # no reflection
    return U @ Vt


def degrees_between(T: Float[np.ndarray, "n n"], other: Float[np.ndarray, "n n"]) -> float:
    """Return the angle between two maps' nearest rotations, 3x3 or 4x4, degrees in [0, 180]."""
    R, R_other = nearest_rotation(T[:3, :3]), nearest_rotation(other[:3, :3])
    return float(np.degrees(rotation_angle(R @ R_other.T)))


@dataclass(frozen=True)
class MotionError:
    """How far a motion is from the true one, degrees and metres; all NaN where that is unknown.

    `translation` is that of the points' mean; `displacement`, their root mean square distance from
    where they belong, holds all of the error, also a wrong scale.
    """

    rotation: float
    translation: float
    displacement: float


def motion_error(
    T: Float[np.ndarray, "4 4"],
    T_true: Float[np.ndarray, "4 4"] | None,
    p: Float[np.ndarray, "n 3"],
) -> MotionError:
    """Return how far a map is from the true one, if known, told by where it brings points."""
    if T_true is None:
        return MotionError(np.nan, np.nan, np.nan)
    off = apply(T, p) - apply(T_true, p)
    displacement = np.sqrt(np.einsum("ij,ij->", off, off) / len(off))
    return MotionError(
        degrees_between(T, T_true), float(np.linalg.norm(off.mean(axis=0))), float(displacement)
    )


def rmse(
    T: Float[np.ndarray, "4 4"],
    p_target: Float[np.ndarray, "n 3"],
    p_source: Float[np.ndarray, "n 3"],
) -> float:
    """Return the root mean square distance between pairs, m, after an affine T_target_source."""
    return float(np.sqrt(np.mean(np.sum((p_target - apply(T, p_source)) ** 2, axis=1))))


@dataclass(frozen=True, eq=False)
class _Moments:
    """Weighted means and second moments about them."""

    mean_target: np.ndarray
    mean_source: np.ndarray
    cross: np.ndarray
    source: np.ndarray


def _moments(p_target: np.ndarray, p_source: np.ndarray, weights: np.ndarray | None) -> _Moments:
    _check_pairs(p_target, p_source)
    if weights is not None and len(weights) != len(p_source):
        raise ValueError(f"{len(weights)} weights for {len(p_source)} pairs")
    if weights is not None and not np.all(weights >= 0):
        raise ValueError("weights must be numbers of at least zero")
    # A pair without weight may be anywhere
    start = 0 if weights is None else int(np.argmax(weights > 0))
    first_target, first_source = p_target[start], p_source[start]
    total = 0.0
    sum_target = np.zeros(3)
    sum_source = np.zeros(3)
    cross, source = np.zeros((3, 3)), np.zeros((3, 3))
    for rows in chunks(len(p_source)):
        a, b = p_target[rows] - first_target, p_source[rows] - first_source
        w = np.ones(len(a)) if weights is None else weights[rows]
        wb = b if weights is None else w[:, None] * b
        total += w.sum()
        sum_target += w @ a
        sum_source += w @ b
        cross += a.T @ wb
        source += b.T @ wb
    if not total > 0:
        raise ValueError("all weights are zero")
    mean_target, mean_source = sum_target / total, sum_source / total
    cross = cross / total - np.outer(mean_target, mean_source)
    source = source / total - np.outer(mean_source, mean_source)
    if not (np.isfinite(cross).all() and np.isfinite(source).all()):
        raise ValueError("a point or a weight is not a finite number")
    return _Moments(first_target + mean_target, first_source + mean_source, cross, source)


def _rotation(cross: np.ndarray) -> tuple[np.ndarray, float]:
    """Return the rotation nearest to a cross-covariance, and trace(D S) (Umeyama, eq. 40-43)."""
    U, D, Vt = np.linalg.svd(cross)
    S = np.array([1.0, 1.0, np.sign(np.linalg.det(U) * np.linalg.det(Vt))])  # eq. 43: no reflection
    return (U * S) @ Vt, float(D @ S)


def _scale(m: _Moments, explained: float) -> float:
    """Return trace(D S) over the source's variance (Umeyama, eq. 42), or 1 for a single place."""
    spread = np.trace(m.source)
    return float(explained / spread) if spread > 0 else 1.0


def _check_pairs(p_target: np.ndarray, p_source: np.ndarray) -> None:
    if len(p_target) != len(p_source):
        raise ValueError(
            f"pairs need as many target points as source points, not {len(p_target)} and"
            f" {len(p_source)}"
        )
    if len(p_source) == 0:
        raise ValueError("no pairs to align")


def chunks(n: int) -> list[slice]:
    """Return slices of so many rows, each short enough to stay in the processor's cache."""
    return [slice(i, i + CHUNK) for i in range(0, n, CHUNK)]
