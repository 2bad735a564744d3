"""Write Mahalanobis' distance: how many standard deviations a point is from the mean, along its own
direction. What you return decides which points are flagged, and which landmark a measurement is
taken for.
"""

import numpy as np
import scipy
from jaxtyping import Float

from lessons.distances.exercises import STUDENTS, values_verdict
from workbench.exercise import Function, Verdict, alternative, check, contract, left_alone, mistake
from workbench.geometry.points import metrics


@contract(
    slot="mahalanobis",
    preset="whiten",
    forbid=("scipy.spatial.distance",),
    examples=(
        (
            (
                "mahalanobis(np.array([[1.0, -1], [1, 1]]), np.zeros(2), np.array([[1, 0.9], [0.9,"
                " 1]]))"
            ),
            "[4.4721, 1.0260]",
        ),
        (
            "mahalanobis(np.array([[5.0, 2]]), np.array([1.0, 2]), np.array([[4.0, 0], [0, 1]]))",
            "[2]",
        ),
    ),
)
def mahalanobis(
    p: Float[np.ndarray, "n d"], mean: Float[np.ndarray, " d"], covariance: Float[np.ndarray, "d d"]
) -> Float[np.ndarray, " n"]:
    """Return sqrt((x - mean)^T C^-1 (x - mean)) for every row x of p.

    Args:
        p: Points, one per row, of any dimension d.
        mean: Where distances are taken from. It is not the mean of p.
        covariance: C, symmetric and positive definite. It is not the covariance of p.

    Returns:
        One distance per point, 0 at the mean. The inputs stay as they are.
    """
    return metrics.mahalanobis(p, mean, covariance)


HINT = "sqrt(v @ inv(C) @ v) for each v = x - mean."


def scattered(seed: int, count: int, dims: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return points, a mean and a covariance with unequal variances and correlations."""
    rng = np.random.default_rng(seed)
    A = rng.normal(size=(dims, dims)) * rng.uniform(0.3, 2.0, dims)
    C = np.round(A @ A.T + 0.2 * np.eye(dims), 3)
    return np.round(rng.normal(0, 2, (count, dims)), 3), np.round(rng.normal(0, 2, dims), 2), C


def found(
    candidate: Function, case: tuple[np.ndarray, np.ndarray, np.ndarray], label: str = ""
) -> Verdict:
    """Judge the distances of one case."""
    return values_verdict(candidate(*case), metrics.mahalanobis(*case), HINT, label)


@check(2)
def across_and_along(candidate: Function) -> Verdict:
    """With a correlation of 0.9, (1, −1) is 4.47 away and (1, 1) is 1.03."""
    C = np.array([[1.0, 0.9], [0.9, 1.0]])
    return found(candidate, (np.array([[1.0, -1.0], [1.0, 1.0], [0.0, 0.0]]), np.zeros(2), C))


@check(2)
def from_the_given_mean(candidate: Function) -> Verdict:
    """Distances are from the mean that comes in, whatever the points are."""
    return found(candidate, scattered(STUDENTS, 6, 2))


@check(1)
def inputs_are_left_alone(candidate: Function) -> Verdict:
    """Points, mean and covariance are not changed."""
    return left_alone(candidate, found(candidate, scattered(STUDENTS + 1, 5, 3)))


@mistake(
    "You returned the squared distance. Take the root: only then it is a metric, and counts"
    " standard deviations."
)
def squared(p: np.ndarray, mean: np.ndarray, covariance: np.ndarray) -> np.ndarray:
    """Without the root."""
    return metrics.mahalanobis(p, mean, covariance) ** 2


@mistake(
    "You multiplied by the covariance itself. Its inverse belongs there: a step along a wide"
    " direction counts less."
)
def not_inverted(p: np.ndarray, mean: np.ndarray, covariance: np.ndarray) -> np.ndarray:
    """C for its inverse."""
    v = p - mean
    return np.sqrt(np.einsum("ni,ij,nj->n", v, covariance, v))


@mistake(
    "You used the variances alone, the diagonal of C. The correlations are what makes the ellipse"
    " slant."
)
def diagonal_only(p: np.ndarray, mean: np.ndarray, covariance: np.ndarray) -> np.ndarray:
    """Each axis over its own standard deviation."""
    return np.linalg.norm((p - mean) / np.sqrt(np.diag(covariance)), axis=1)


@mistake("You did not take off the mean. Distances are from the mean, not from the origin.")
def from_the_origin(p: np.ndarray, mean: np.ndarray, covariance: np.ndarray) -> np.ndarray:
    """From the origin."""
    return metrics.mahalanobis(p, np.zeros_like(mean), covariance)


@mistake(
    "You took Euclid's distance; the covariance plays no part in it. Put its inverse between v"
    " and v."
)
def euclid(p: np.ndarray, mean: np.ndarray, covariance: np.ndarray) -> np.ndarray:
    """Euclid's."""
    return np.linalg.norm(p - mean, axis=1)


@mistake(
    "You inverted C entry by entry. Its inverse is that of a matrix: np.linalg.inv, or solve C x"
    " = v."
)
def entries_inverted(p: np.ndarray, mean: np.ndarray, covariance: np.ndarray) -> np.ndarray:
    """1 / C."""
    v = p - mean
    return np.sqrt(
        np.abs(np.einsum("ni,ij,nj->n", v, 1 / np.where(covariance == 0, np.inf, covariance), v))
    )


@mistake(
    "You divided by the variances where standard deviations belong, and left out the correlations:"
    " use inv(C)."
)
def over_variances(p: np.ndarray, mean: np.ndarray, covariance: np.ndarray) -> np.ndarray:
    """Each axis over its variance."""
    return np.linalg.norm((p - mean) / np.diag(covariance), axis=1)


@alternative
def by_solving(p: np.ndarray, mean: np.ndarray, covariance: np.ndarray) -> np.ndarray:
    """Solves C x = v."""
    v = p - mean
    return np.sqrt((v * np.linalg.solve(covariance, v.T).T).sum(axis=1))


@alternative
def by_scipy(p: np.ndarray, mean: np.ndarray, covariance: np.ndarray) -> np.ndarray:
    """The library's, point by point."""
    inverse = np.linalg.inv(covariance)
    return np.array([scipy.spatial.distance.mahalanobis(x, mean, inverse) for x in p])


@alternative
def by_eigenvectors(p: np.ndarray, mean: np.ndarray, covariance: np.ndarray) -> np.ndarray:
    """Turned to the axes and scaled."""
    variances, axes = np.linalg.eigh(covariance)
    return np.linalg.norm((p - mean) @ axes / np.sqrt(variances), axis=1)
