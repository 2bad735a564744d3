"""Lines in the plane and planes in space: from the fewest points, from many, and distances.

Convention: a line is (a, b, c) and a plane (a, b, c, d), a unit normal followed by an offset in
metres; a point is on it where `p @ normal + offset = 0`, and the value of that sum is its signed
distance.
"""

import numpy as np
from jaxtyping import Float, Shaped

_FLAT = 1e-9


def line_from_points(p: Float[np.ndarray, "*k 2 2"]) -> Float[np.ndarray, "*k 3"]:
    """Return the line through each two points, its normal to the left; NaN where they coincide."""
    v = p[..., 1, :] - p[..., 0, :]
    normal = _unit(np.stack([-v[..., 1], v[..., 0]], axis=-1), smallest=0.0)
    return _through(normal, p.mean(axis=-2))


def plane_from_points(p: Float[np.ndarray, "*k 3 3"]) -> Float[np.ndarray, "*k 4"]:
    """Return the plane through each three points, counter-clockwise seen from its normal's side.

    NaN on one line: where the area is below a billionth of the squared longest side.

    Examples:
        >>> plane_from_points(np.array([[0.0, 0, 2], [1, 0, 2], [0, 1, 2]])).tolist()  # z = 2
        [0.0, 0.0, 1.0, -2.0]
    """
    v, w = p[..., 1, :] - p[..., 0, :], p[..., 2, :] - p[..., 0, :]
    normal = v[..., [1, 2, 0]] * w[..., [2, 0, 1]] - v[..., [2, 0, 1]] * w[..., [1, 2, 0]]
    normal = _unit(normal, smallest=_FLAT * _squared_extent(p))
    return _through(normal, p.mean(axis=-2))


def fit_hyperplane(
    p: Float[np.ndarray, "n d"], weights: Float[np.ndarray, " n"] | None = None
) -> Float[np.ndarray, " d+1"]:
    """Return the line (d = 2) or plane (d = 3) of least weighted squared perpendicular distances.

    The largest entry of the normal is positive. One of many where the points leave a choice.
    Reference: Pearson, On lines and planes of closest fit to systems of points in space, 1901.

    Raises:
        ValueError: If fewer than d points have a positive weight.
    """
    weights = np.ones(len(p)) if weights is None else weights
    if np.count_nonzero(weights > 0.0) < p.shape[1]:
        raise ValueError(
            f"{p.shape[1]} points with a positive weight are needed, got"
            f" {np.count_nonzero(weights > 0.0)}"
        )
    center = weights @ p / weights.sum()
    v = np.ascontiguousarray((p - center).T)
    normal = np.linalg.eigh((v * weights) @ v.T)[1][:, 0]
    normal = normal * np.sign(normal[np.argmax(np.abs(normal))])
    return np.append(normal, -normal @ center)


def fit_hyperplanes(
    p: Float[np.ndarray, "*k n d"], weights: Shaped[np.ndarray, "*k m n"]
) -> Float[np.ndarray, "*k m d+1"]:
    """Return `fit_hyperplane` of the same points under each row of weights; NaN where it raises.

    Args:
        p: The points, metres; of one cloud, or of many with as many points each.
        weights: Of each fit a weight for each point, or whether it counts.
    """
    d = p.shape[-1]
    few = np.count_nonzero(weights > 0, axis=-1) < d
    q = np.moveaxis(p, -1, 0).copy()  # x of all points, y of all, ...
    middle = q.mean(axis=-1, keepdims=True)  # about it, sums of squares lose no digits
    q -= middle
    products = [a * b for a in q for b in q]
    summed = np.stack([np.ones_like(q[0]), *q, *products], axis=-2)
    sums = weights.astype(float, copy=False) @ summed.swapaxes(-1, -2)
    total = np.where(few, 1.0, sums[..., 0])[..., None]
    mean = sums[..., 1 : d + 1] / total
    scatter = (sums[..., d + 1 :] / total).reshape(*few.shape, d, d)
    normal = np.linalg.eigh(scatter - mean[..., :, None] * mean[..., None, :])[1][..., 0]
    largest = np.abs(normal).argmax(axis=-1)[..., None]
    normal = normal * np.sign(np.take_along_axis(normal, largest, axis=-1))
    normal = np.where(few[..., None], np.nan, normal)
    return _through(normal, mean + np.moveaxis(middle, 0, -1))


def regression_line(p: Float[np.ndarray, "n 2"], on: int) -> Float[np.ndarray, "3"]:
    """Return the line of least squared distances along one axis, column `on` being exact.

    Errors of variance σ² there make the slope too small, by v / (v + σ²), v being that of true
    values.
    Reference: Fuller, Measurement error models, 1987, section 1.1.
    """
    q = p - p.mean(axis=0)
    slope = q[:, on] @ q[:, 1 - on] / (q[:, on] @ q[:, on])
    normal = np.array([-slope, 1.0]) if on == 0 else np.array([1.0, -slope])
    normal = normal / np.linalg.norm(normal)
    return np.append(normal, -normal @ p.mean(axis=0))


def line_angle(line: Float[np.ndarray, "3"]) -> float:
    """Return how steep a line of the plane is, radians above -pi/2 up to pi/2.

    Examples:
        >>> line_angle(np.array([-1.0, 1.0, 5.0])) / np.pi  # y = x - 5
        0.25
    """
    a, b, _ = line
    return float(np.arctan2(-a * np.sign(b), abs(b)) if b else np.pi / 2.0)


def hyperplane_distances(
    hyperplane: Float[np.ndarray, "*k c"], p: Float[np.ndarray, "*j n d"]
) -> Float[np.ndarray, "*k n"]:
    """Return each point's signed distance from each line or plane, in the input's precision.

    Of many clouds, each has its own rows of lines or planes.
    """
    return hyperplane[..., :-1] @ p.swapaxes(-1, -2) + hyperplane[..., -1:]


def angle_between_planes(
    plane_a: Float[np.ndarray, " d"], plane_b: Float[np.ndarray, " d"]
) -> float:
    """Return the unsigned angle between two planes or lines, from 0 to a right angle, radians.

    Examples:
        >>> floor, wall = np.array([0.0, 0.0, 1.0, 0.0]), np.array([-1.0, 0.0, 0.0, 2.0])
        >>> round(angle_between_planes(floor, wall) / np.pi, 6)
        0.5
    """
    n_a, n_b = plane_a[:-1], plane_b[:-1]
    along = n_b * np.copysign(1.0, n_a @ n_b)
    return float(2.0 * np.arctan2(np.linalg.norm(n_a - along), np.linalg.norm(n_a + along)))


def _through(normal: np.ndarray, p: np.ndarray) -> np.ndarray:
    return np.concatenate([normal, -(normal * p).sum(-1, keepdims=True)], axis=-1)


def _unit(v: np.ndarray, smallest: float | np.ndarray) -> np.ndarray:
    """Return the vectors at length one; NaN for those not longer than `smallest`."""
    length = np.sqrt(np.square(v).sum(-1))
    return v / np.where(length > smallest, length, np.nan)[..., None]


def _squared_extent(p: np.ndarray) -> np.ndarray:
    """Return the largest squared side of each triangle."""
    return np.asarray(np.square(p - p[..., [2, 0, 1], :]).sum(-1).max(-1))
