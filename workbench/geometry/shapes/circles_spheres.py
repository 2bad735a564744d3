"""Circles in the plane and spheres in space: from the fewest points, from many, and distances.

Convention: the centre, then the radius, in metres: a circle is (x, y, r), a sphere (x, y, z, r).
Distances are signed, negative inside.
Reference: Gander, Golub and Strebel, Least-squares fitting of circles and ellipses, 1994.
"""

import numpy as np
from jaxtyping import Float

from workbench.geometry.refinement import levenberg_marquardt

_FLAT = 1e-9


def circle_from_points(p: Float[np.ndarray, "*k 3 2"]) -> Float[np.ndarray, "*k 3"]:
    """Return the circle through each three points; a row of NaN where they lie on one line."""
    v, w = p[..., 1, :] - p[..., 0, :], p[..., 2, :] - p[..., 0, :]
    area = v[..., 0] * w[..., 1] - v[..., 1] * w[..., 0]
    vv, ww = np.square(v).sum(-1), np.square(w).sum(-1)
    twice = 2.0 * np.where(np.abs(area) > _FLAT * np.maximum(vv, ww), area, np.nan)
    arm = (
        np.stack([w[..., 1] * vv - v[..., 1] * ww, v[..., 0] * ww - w[..., 0] * vv], axis=-1)
        / twice[..., None]
    )
    return _with_radius(p[..., 0, :], arm)


def sphere_from_points(p: Float[np.ndarray, "*k 4 3"]) -> Float[np.ndarray, "*k 4"]:
    """Return the sphere through each four points; a row of NaN where they lie in one plane."""
    u, v, w = (p[..., i, :] - p[..., 0, :] for i in (1, 2, 3))
    uu, vv, ww = (np.square(side).sum(-1) for side in (u, v, w))
    volume = (u * np.cross(v, w)).sum(-1)
    broad = np.abs(volume) > _FLAT * np.maximum(np.maximum(uu, vv), ww) ** 1.5
    twice = 2.0 * np.where(broad, volume, np.nan)
    arm = (
        uu[..., None] * np.cross(v, w)
        + vv[..., None] * np.cross(w, u)
        + ww[..., None] * np.cross(u, v)
    )
    return _with_radius(p[..., 0, :], arm / twice[..., None])


def costs_of_centers(
    p: Float[np.ndarray, "n d"], p_centers: Float[np.ndarray, "k d"]
) -> Float[np.ndarray, " k"]:
    """Return for each centre the sum of squared distances to its best sphere (Gander et al., 3)."""
    columns = np.ascontiguousarray(p_centers.T)
    ways, squares = np.zeros(len(p_centers)), np.zeros(len(p_centers))
    for point in p:
        square = np.square(columns - point[:, None]).sum(axis=0)
        ways += np.sqrt(square)
        squares += square
    return np.maximum(squares - ways * ways / len(p), 0.0)


def fit_sphere(
    p: Float[np.ndarray, "n d"],
    weights: Float[np.ndarray, " n"] | None = None,
    start: Float[np.ndarray, " d+1"] | None = None,
) -> Float[np.ndarray, " d+1"]:
    """Return the circle or sphere with the smallest weighted sum of squared distances.

    Levenberg-Marquardt goes on from `start`, by default the algebraic fit, which makes short arcs
    too small. Points of a line or a plane give a very large one, or NaN.
    Reference: Kåsa, A circle fitting procedure and its error analysis, 1976 (the start); Gander et
    al., 3.

    Raises:
        ValueError: If fewer than d + 1 points have a positive weight.
    """
    weights = np.ones(len(p)) if weights is None else weights
    if np.count_nonzero(weights > 0.0) <= p.shape[1]:
        raise ValueError(
            f"{p.shape[1] + 1} points with a positive weight are needed, got"
            f" {np.count_nonzero(weights > 0.0)}"
        )
    root = np.sqrt(weights)
    origin = weights @ p / weights.sum()
    q = p - origin
    if start is None:
        rows = np.column_stack([2.0 * q, np.ones(len(q))]) * root[:, None]
        solution = np.linalg.lstsq(rows, root * np.square(q).sum(1), rcond=None)[0]
        radius = np.sqrt(max(solution[-1] + solution[:-1] @ solution[:-1], 0.0))
        start = np.append(solution[:-1], radius)
    else:
        start = np.append(start[:-1] - origin, start[-1])

    def linearise(sphere: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        residuals, jacobian = linearise_sphere(sphere, q)
        return root * residuals, root[:, None] * jacobian

    sphere = levenberg_marquardt(linearise, np.add, start)
    return np.append(sphere[:-1] + origin, abs(sphere[-1]))


def linearise_sphere(
    sphere: Float[np.ndarray, "*k c"], p: Float[np.ndarray, "*m n d"]
) -> tuple[Float[np.ndarray, "*r n"], Float[np.ndarray, "*r n c"]]:
    """Return signed distances from spheres, and their slopes by centre and radius (Gander, 3)."""
    v = p - sphere[..., None, :-1]
    length = np.sqrt(np.square(v).sum(-1))
    slopes = -v / np.where(length > 0.0, length, np.inf)[..., None]
    return length - sphere[..., -1:], np.concatenate(
        [slopes, np.full((*length.shape, 1), -1.0)], axis=-1
    )


def sphere_distances(
    sphere: Float[np.ndarray, "*k c"], p: Float[np.ndarray, "n d"]
) -> Float[np.ndarray, "*k n"]:
    """Return each point's signed distance from each sphere, in the precision of the input."""
    squared = np.square(p[:, 0] - sphere[..., 0:1])
    for axis in range(1, p.shape[1]):
        squared += np.square(p[:, axis] - sphere[..., axis : axis + 1])
    return np.sqrt(squared) - sphere[..., -1:]


def _with_radius(origin: np.ndarray, arm: np.ndarray) -> np.ndarray:
    return np.concatenate([origin + arm, np.sqrt(np.square(arm).sum(-1, keepdims=True))], axis=-1)
