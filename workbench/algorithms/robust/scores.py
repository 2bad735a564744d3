"""How good a candidate is, from the distances of all points to it: more is better, for every score.

A score takes the distances, never negative, of n points to one candidate, or to k in rows.
"""

from collections.abc import Callable

import numpy as np
from jaxtyping import Float, Shaped

from workbench.geometry.shapes.lines_planes import hyperplane_distances

Distances = Float[np.ndarray, "*k n"]

Score = Callable[[np.ndarray, float], np.ndarray]
"""score(distances, inlier_distance) -> one number per row of distances."""


def count_score(distances: Distances, inlier_distance: float) -> Shaped[np.ndarray, "*k"]:
    """Return the number of points within the inlier distance: the score of RANSAC.

    Reference: Fischler and Bolles, Random Sample Consensus, 1981, section II.
    """
    return np.asarray(np.count_nonzero(distances <= inlier_distance, axis=-1))


def msac_score(distances: Distances, inlier_distance: float) -> Shaped[np.ndarray, "*k"]:
    """Return the sum of 1 - (distance / inlier distance)² over the points within that distance.

    It is n minus the truncated sum of squares of the paper, in units of the squared inlier
    distance.

    Reference: Torr and Zisserman, MLESAC, 2000, section 4, eq. 16 and 17.
    """
    shares = distances / np.asarray(inlier_distance, distances.dtype)
    np.multiply(shares, shares, out=shares)
    return np.asarray(np.maximum(1 - shares, 0, out=shares).sum(axis=-1))


def mlesac_score(
    distances: Distances, inlier_distance: float, *, span: float, steps: int = 4
) -> Shaped[np.ndarray, "*k"]:
    """Return how much likelier the distances are than if all points were outliers, as a logarithm.

    Inliers are normal around the model, 95 % of them within the inlier distance; outliers are
    anywhere in a window of width `span`, in the same unit. The share of inliers is found by `steps`
    rounds of expectation maximisation.

    Reference: Torr and Zisserman, MLESAC, 2000, section 5, eq. 18 to 20.
    """
    sigma = inlier_distance / 1.96
    ratio = np.exp(-0.5 * np.square(distances / sigma)) * (span / (np.sqrt(2.0 * np.pi) * sigma))
    share = np.full((*distances.shape[:-1], 1), 0.5)
    for _ in range(steps):
        share = (share * ratio / (share * ratio + 1.0 - share)).mean(axis=-1, keepdims=True)
    return np.asarray(np.log(share * ratio + 1.0 - share).sum(axis=-1))


def count_inliers(
    plane: Float[np.ndarray, "4"], p: Float[np.ndarray, "n 3"], inlier_distance: float
) -> int:
    """Return how many points lie within a distance of a plane, on either side, metres.

    The plane is (a, b, c, d) with a unit normal.
    """
    return int(np.count_nonzero(np.abs(hyperplane_distances(plane, p)) <= inlier_distance))
