"""Distances between points, some of them no metrics; the scatter for Mahalanobis; rms.

A covariance C is positive definite; functions that find it is not raise ValueError.
Reference: Deza and Deza, Encyclopedia of distances, 4th ed., 2016, chapters 1, 17 and 19;
Mahalanobis, On the generalised distance in statistics, 1936.
"""

import math
from collections.abc import Callable
from typing import Literal

import numpy as np
import scipy
from jaxtyping import Float

Metric = Literal[
    "euclid", "manhattan", "chebyshev", "p", "p-sum", "squared", "cosine", "mahalanobis"
]
Distance = Callable[[np.ndarray, np.ndarray], np.ndarray]
Points = Float[np.ndarray, "n d"]
Covariance = Float[np.ndarray, "d d"]


def distance_of(
    metric: Metric, *, order: float = 2.0, covariance: Covariance | None = None
) -> Distance:
    """Return the function that gives distances of points row by row, or to a single row.

    `p` is (sum |x|^p)^(1/p), p being `order`, no metric below 1; `p-sum` leaves out the root;
    `cosine` is one minus the cosine at the origin. The covariance is the identity by default.
    """
    match metric:
        case "euclid":
            return lambda a, b: np.linalg.norm(a - b, axis=-1)
        case "manhattan":
            return lambda a, b: np.abs(a - b).sum(axis=-1)
        case "chebyshev":
            return lambda a, b: np.abs(a - b).max(axis=-1)
        case "p":
            return lambda a, b: (np.abs(a - b) ** order).sum(axis=-1) ** (1 / order)
        case "p-sum":
            return lambda a, b: (np.abs(a - b) ** order).sum(axis=-1)
        case "squared":
            return lambda a, b: ((a - b) ** 2).sum(axis=-1)
        case "cosine":
            return cosine_distance
        case "mahalanobis":
            if covariance is None:
                return distance_of("euclid")
            W = whitening(covariance)
            return lambda a, b: np.linalg.norm((a - b) @ W.T, axis=-1)


def cosine_distance(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Return 1 - cos of the angle between vectors, row by row; 1 where either has no length."""
    size = np.linalg.norm(a, axis=-1) * np.linalg.norm(b, axis=-1)
    dots = (a * b).sum(axis=-1)
    return 1.0 - np.divide(dots, size, out=np.zeros_like(dots), where=size > 0)


def mahalanobis(
    p: Points, mean: Float[np.ndarray, " d"], covariance: Covariance
) -> Float[np.ndarray, " n"]:
    """Return points' distances from the mean in standard deviations along them, sqrt(v^T C^-1 v).

    Examples:
        >>> p = np.array([[1.0, -1.0], [1.0, 1.0]])
        >>> mahalanobis(p, np.zeros(2), np.array([[1.0, 0.9], [0.9, 1.0]])).round(2).tolist()
        [4.47, 1.03]
    """
    white = (p - mean) @ whitening(covariance).T
    return np.sqrt(np.einsum("nd,nd->n", white, white))


def rms(values: Float[np.ndarray, "*n"]) -> float:
    """Return the root mean square, NaN for no values.

    Examples:
        >>> rms(np.array([3.0, 4.0, 0.0, 0.0]))
        2.5
    """
    # not values @ values: BLAS wakes its threads for a long dot product, which takes 300 times as
    # long
    # the sum over the size is what np.mean gives, without its looks at what it is given
    return math.sqrt((values * values).sum() / values.size) if len(values) else float("nan")


def whitening(covariance: Covariance) -> Covariance:
    """Return the lower triangular W with W C W^T = I: W v has v's length in standard deviations.

    Raises:
        ValueError: If the covariance is not positive definite.
    """
    try:
        lower = np.linalg.cholesky(covariance)
    except np.linalg.LinAlgError:
        raise ValueError(
            "the covariance is not positive definite: some direction has no variance"
        ) from None
    return scipy.linalg.solve_triangular(lower, np.eye(len(covariance)), lower=True)


def radius_of_share(share: float, dims: int) -> float:
    """Return how far from the mean a share of a normal distribution lies, in its deviations."""
    return float(np.sqrt(2 * scipy.special.gammaincinv(dims / 2, share)))


def share_within(radius: float, dims: int) -> float:
    """Return the share of a normal distribution within so many standard deviations of its mean."""
    return float(scipy.special.gammainc(dims / 2, radius**2 / 2))


def mean_and_covariance(p: Points) -> tuple[Float[np.ndarray, " d"], Covariance]:
    """Return the mean and the sample covariance, over n - 1, of at least two points."""
    mean = p.mean(axis=0)
    v = p - mean
    return mean, v.T @ v / (len(p) - 1)


def robust_mean_and_covariance(
    p: Points, rng: np.random.Generator, *, starts: int = 30, steps: int = 20
) -> tuple[Float[np.ndarray, " d"], Covariance]:
    """Return mean and covariance of the half with the smallest covariance determinant (MCD).

    Every start draws d + 1 points; a C-step takes the half that is nearest by Mahalanobis, and
    never raises the determinant. The result is scaled to the median distance of a normal
    distribution; mean and covariance of all points within its 97.5 % radius are returned.
    Reference: Rousseeuw and Van Driessen, A fast algorithm for the MCD estimator, 1999.

    Raises:
        ValueError: If half of the points lie in a hyperplane.
    """
    n, d = p.shape
    half = (n + d + 1) // 2
    kept = np.argsort(rng.random((starts, n)), axis=1)[:, : d + 1]
    for _ in range(steps):
        sets = p[kept]
        means = sets.mean(axis=1)
        v = sets - means[:, None]
        covariances = np.einsum("snd,sne->sde", v, v) / (kept.shape[1] - 1)
        # A start may be flat
        covariances += np.eye(d) * 1e-12 * np.trace(covariances, axis1=1, axis2=2).max()
        v = p - means[:, None]
        squares = np.einsum("snd,sdn->sn", v, np.linalg.solve(covariances, v.transpose(0, 2, 1)))
        nearer = np.sort(np.argpartition(squares, half - 1, axis=1)[:, :half], axis=1)
        if nearer.shape == kept.shape and (nearer == kept).all():
            break
        kept = nearer
    estimates = [mean_and_covariance(p[rows]) for rows in kept]
    mean, covariance = min(estimates, key=lambda estimate: float(np.linalg.det(estimate[1])))
    if not np.linalg.det(covariance) > 1e-12 * (np.trace(covariance) / d) ** d:
        raise ValueError("half of the points lie in a hyperplane: no robust covariance")
    within = mahalanobis(p, mean, covariance)
    covariance = covariance * (np.median(within) / radius_of_share(0.5, d)) ** 2
    return mean_and_covariance(p[mahalanobis(p, mean, covariance) <= radius_of_share(0.975, d)])


def triangle_excess(
    distance: Distance, a: Points, b: Points, *, c: Points
) -> tuple[Float[np.ndarray, " n"], Float[np.ndarray, "n 3"]]:
    """Return how much longer a-c is than a-b-c, as in no metric, and the distances ab, bc, ac."""
    ab, bc, ac = distance(a, b), distance(b, c), distance(a, c)
    return ac - ab - bc, np.column_stack([ab, bc, ac])
