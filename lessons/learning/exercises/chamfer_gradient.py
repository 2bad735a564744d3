"""Write the gradient of the Chamfer distance by the points of the first cloud. Sets of points and
meshes of the lesson then learn by it: a wrong sign shows at once, a missing side only where points
are missing.
"""

import numpy as np
import scipy
from jaxtyping import Float

from lessons.learning.exercises import STUDENTS, entries_verdict
from workbench.exercise import Function, Verdict, alternative, check, contract, left_alone, mistake
from workbench.geometry.points import shape_distances

HINT = "2/n (p_i − its nearest q), plus 2/m (p_i − q_j) for every q_j whose nearest is p_i."


@contract(
    slot="chamfer_gradient",
    preset="smeared",
    examples=(
        ("chamfer_gradient(array([[0., 0., 0.]]), array([[1., 0., 0.]]))", "[[-4, 0, 0]]"),
        (
            "chamfer_gradient(array([[0., 0., 0.]]), array([[1., 0., 0.], [0., 2., 0.]]))",
            "[[-3, -2, 0]]",
        ),
    ),
)
def chamfer_gradient(
    p: Float[np.ndarray, "n 3"], q: Float[np.ndarray, "m 3"]
) -> Float[np.ndarray, "n 3"]:
    """Return the gradient of the Chamfer distance by the points of p.

    The distance is (1 / n) sum_i min_j |p_i - q_j|^2 + (1 / m) sum_j min_i |p_i - q_j|^2. Each
    minimum is taken by one pair, and only the pairs count: several q may have the same nearest p.

    Args:
        p: n points, metres.
        q: m points in the same frame; the counts may differ, neither is 0.

    Returns:
        One row for each point of p, metres. The inputs stay as they are.
    """
    return shape_distances.chamfer_gradient(p, q)


def clouds(seed: int, n: int, m: int) -> tuple[np.ndarray, np.ndarray]:
    """Return two clouds that overlap."""
    rng = np.random.default_rng(seed)
    return rng.normal(size=(n, 3)), rng.normal(size=(m, 3)) * 0.8 + [0.4, 0, 0]


def found(candidate: Function, p: np.ndarray, q: np.ndarray, case: str = "") -> Verdict:
    """Judge all rows by ours."""
    return entries_verdict(candidate(p, q), shape_distances.chamfer_gradient(p, q), HINT, case)


@check(2)
def one_point_and_two(candidate: Function) -> Verdict:
    """One point between two: both pull, the nearer one twice."""
    return found(
        candidate, np.array([[0.2, 0.0, 0.0]]), np.array([[1.0, 0.5, 0.0], [-1.0, 0.0, 0.3]])
    )


@check(2)
def as_the_distance_changes(candidate: Function) -> Verdict:
    """A small step of all points changes the distance by as much as the gradient says."""
    p, q = clouds(STUDENTS, 20, 25)
    v = np.random.default_rng(STUDENTS).normal(size=p.shape)
    ahead, behind = (shape_distances.chamfer(p + t * v, q) for t in (1e-6, -1e-6))
    right = (ahead - behind) / 2e-6
    told = float((candidate(p, q) * v).sum())
    return entries_verdict(np.array([round(told, 9)]), np.array([right]), HINT, "Change per step: ")


@check(2)
def many_with_one_nearest(candidate: Function) -> Verdict:
    """Where twelve points of q have the same nearest point of p, all of them pull at it."""
    return found(candidate, *clouds(STUDENTS + 1, 5, 60))


@check(1)
def clouds_are_left_alone(candidate: Function) -> Verdict:
    """The clouds that come in are not changed."""
    return left_alone(candidate, found(candidate, *clouds(STUDENTS + 2, 8, 8)))


def _nearest(p: np.ndarray, q: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    D = scipy.spatial.distance.cdist(p, q)
    return D.argmin(axis=1), D.argmin(axis=0)


def _there(p: np.ndarray, q: np.ndarray) -> np.ndarray:
    return 2 * (p - q[_nearest(p, q)[0]])


def _back(p: np.ndarray, q: np.ndarray) -> np.ndarray:
    j = _nearest(p, q)[1]
    g = np.zeros_like(p)
    np.add.at(g, j, 2 * (p[j] - q))
    return g


@mistake(
    "You have the side from p to q alone. Points of q that no p is nearest to pull as well: add the"
    " other side."
)
def one_sided(p: np.ndarray, q: np.ndarray) -> np.ndarray:
    """Only from p to q."""
    return _there(p, q) / len(p)


@mistake(
    "You have the side from q to p alone. Every point of p is also drawn to its own nearest q: add"
    " that side."
)
def only_back(p: np.ndarray, q: np.ndarray) -> np.ndarray:
    """Only from q to p."""
    return _back(p, q) / len(q)


@mistake(
    "g[j] += ... keeps only the last of several equal indices. np.add.at, or np.bincount, adds all"
    " of them."
)
def duplicates_lost(p: np.ndarray, q: np.ndarray) -> np.ndarray:
    """Adds through an index with repeats."""
    g = _there(p, q) / len(p)
    j = _nearest(p, q)[1]
    g[j] += 2 * (p[j] - q) / len(q)
    return g


@mistake(
    "Your sign is the other way round: a gradient points to where the distance grows, away from the"
    " partners."
)
def sign_reversed(p: np.ndarray, q: np.ndarray) -> np.ndarray:
    """The way down."""
    return -shape_distances.chamfer_gradient(p, q)


@mistake("You lost the factor 2: the derivative of |p − q|² by p is 2 (p − q).")
def without_the_two(p: np.ndarray, q: np.ndarray) -> np.ndarray:
    """Half of it."""
    return shape_distances.chamfer_gradient(p, q) / 2


@mistake("You took sums for means: divide the side from p by n, and the side from q by m.")
def sums_for_means(p: np.ndarray, q: np.ndarray) -> np.ndarray:
    """Not divided."""
    return _there(p, q) + _back(p, q)


@mistake(
    "You divided each side by the count of the other cloud. The side from p has n terms, that from"
    " q has m."
)
def counts_swapped(p: np.ndarray, q: np.ndarray) -> np.ndarray:
    """Divides by m for n."""
    return _there(p, q) / len(q) + _back(p, q) / len(p)


@mistake("You divided both sides by n. The side from q to p is a mean over the m points of q.")
def both_by_the_first_count(p: np.ndarray, q: np.ndarray) -> np.ndarray:
    """Divides by n twice."""
    return (_there(p, q) + _back(p, q)) / len(p)


@mistake(
    "You took unit vectors: that is the gradient of distances. This distance has their squares."
)
def of_distances(p: np.ndarray, q: np.ndarray) -> np.ndarray:
    """Without squares."""
    i, j = _nearest(p, q)
    v = p - q[i]
    w = p[j] - q
    g = np.zeros_like(p)
    np.add.at(g, j, w / np.maximum(np.linalg.norm(w, axis=1, keepdims=True), 1e-12) / len(q))
    return v / np.maximum(np.linalg.norm(v, axis=1, keepdims=True), 1e-12) / len(p) + g


@alternative
def with_loops(p: np.ndarray, q: np.ndarray) -> np.ndarray:
    """Point by point."""
    g = np.zeros(p.shape)
    for i in range(len(p)):
        j = int(((q - p[i]) ** 2).sum(axis=1).argmin())
        g[i] += 2 * (p[i] - q[j]) / len(p)
    for j in range(len(q)):
        i = int(((p - q[j]) ** 2).sum(axis=1).argmin())
        g[i] += 2 * (p[i] - q[j]) / len(q)
    return g


@alternative
def by_two_matrices(p: np.ndarray, q: np.ndarray) -> np.ndarray:
    """Both assignments as matrices of zeros and ones."""
    D = ((p[:, None] - q[None]) ** 2).sum(axis=2)
    from_p = D.argmin(axis=1)[:, None] == np.arange(len(q))
    from_q = D.argmin(axis=0)[None] == np.arange(len(p))[:, None]
    weights = 2 * (from_p / len(p) + from_q / len(q))
    return (weights[:, :, None] * (p[:, None] - q[None])).sum(axis=1)
