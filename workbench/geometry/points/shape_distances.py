"""Distances between two clouds that match each point to the nearest of the other cloud.

All compare p_a (n, 3) with p_b (m, 3), metres, one frame, in any order of rows; the mean square of
index pairs is the exception, and here to be seen failing. A cloud that is empty or not finite
raises ValueError. Distances that match one to one are in `workbench.algorithms.transport`.
Reference: Fan, Su and Guibas, A Point Set Generation Network, 2017, equation 1.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

import numpy as np
import scipy
from jaxtyping import Float, Int

from workbench.geometry.points.nearest import check_clouds, tree_of

Cloud = Float[np.ndarray, "n 3"]
Definition = Literal["mean of squares", "mean of distances", "sum of squares", "sum of distances"]

DEFINITIONS: dict[Definition, Callable[[np.ndarray], float]] = {
    "mean of squares": lambda d: float(d @ d / len(d)),
    "mean of distances": lambda d: float(d.mean()),
    "sum of squares": lambda d: float(d @ d),
    "sum of distances": lambda d: float(d.sum()),
}
"""What one side of a Chamfer distance makes of its nearest distances: square metres or metres."""

_LARGE = 4000  # points from which threads and an order of queries gain more than they cost


@dataclass(frozen=True, eq=False)
class NearestPoints:
    """The nearest point of the other cloud for each point, and the distance, both ways."""

    a_to_b: Int[np.ndarray, "n"]
    b_to_a: Int[np.ndarray, "m"]
    d_a: Float[np.ndarray, "n"]
    d_b: Float[np.ndarray, "m"]

    def chamfer(self, definition: Definition = "mean of squares") -> float:
        """Return the two-sided Chamfer distance in one of its definitions: side a plus side b."""
        return DEFINITIONS[definition](self.d_a) + DEFINITIONS[definition](self.d_b)

    def one_sided(self, definition: Definition = "mean of squares") -> float:
        """Return the one-sided Chamfer distance from a to b in one of its definitions."""
        return DEFINITIONS[definition](self.d_a)

    def hausdorff(self) -> float:
        """Return the largest of all nearest distances of both sides, metres."""
        return float(max(self.d_a.max(), self.d_b.max()))

    def f_score(self, max_distance: float) -> float:
        """Return the harmonic mean of the shares within a distance (Knapitsch et al. 2017, 3.3)."""
        precision, recall = (float(np.mean(d <= max_distance)) for d in (self.d_a, self.d_b))
        return 2 * precision * recall / (precision + recall) if precision + recall > 0 else 0.0


def nearest_both_ways(
    p_a: Float[np.ndarray, "n 3"], p_b: Float[np.ndarray, "m 3"]
) -> NearestPoints:
    """Return the nearest neighbour of every point of each cloud in the other."""
    check_clouds(p_a, p_b)
    tree_a, tree_b = tree_of(p_a), tree_of(p_b)
    a_to_b, d_a = _query(tree_b, p_a, tree_a)
    b_to_a, d_b = _query(tree_a, p_b, tree_b)
    return NearestPoints(a_to_b, b_to_a, d_a, d_b)


def one_sided(p_a: Float[np.ndarray, "n 3"], p_b: Float[np.ndarray, "m 3"]) -> float:
    """Return the mean, over the points of a, of the squared distance to the nearest point of b."""
    check_clouds(p_a, p_b)
    _, d = _query(tree_of(p_b), p_a)
    return DEFINITIONS["mean of squares"](d)


def chamfer(p_a: Float[np.ndarray, "n 3"], p_b: Float[np.ndarray, "m 3"]) -> float:
    """Return the two-sided Chamfer distance of squares and means: from a to b plus from b to a.

    Fan et al., with means for sums. It is no metric, since the triangle inequality fails.

    Examples:
        >>> p_a = np.array([[0.0, 0, 0], [1, 0, 0]])
        >>> chamfer(p_a, p_a + np.array([0.0, 0.0, 0.5]))  # 0.25 m² from each side
        0.5
    """
    return nearest_both_ways(p_a, p_b).chamfer()


def chamfer_gradient(p_a: Cloud, p_b: Float[np.ndarray, "m 3"]) -> Cloud:
    """Return the gradient of `chamfer` by p_a, metres; at a kink, for the neighbour taken."""
    near = nearest_both_ways(p_a, p_b)
    slope = 2 / len(p_a) * (p_a - p_b[near.a_to_b])
    v = 2 / len(p_b) * (p_a[near.b_to_a] - p_b)
    for axis in range(3):
        slope[:, axis] += np.bincount(near.b_to_a, v[:, axis], minlength=len(p_a))
    return slope


def one_sided_gradient(p_a: Cloud, p_b: Float[np.ndarray, "m 3"]) -> Cloud:
    """Return the gradient of `one_sided` from a to b by p_a, metres."""
    check_clouds(p_a, p_b)
    a_to_b, _ = _query(tree_of(p_b), p_a)
    return 2 / len(p_a) * (p_a - p_b[a_to_b])


def hausdorff(p_a: Float[np.ndarray, "n 3"], p_b: Float[np.ndarray, "m 3"]) -> float:
    """Return the Hausdorff distance, m: the largest of all nearest distances, both ways."""
    return nearest_both_ways(p_a, p_b).hausdorff()


def f_score(
    p_a: Float[np.ndarray, "n 3"], p_b: Float[np.ndarray, "m 3"], max_distance: float
) -> float:
    """Return the F-score, 0 to 1, of two clouds at a distance in metres; see `Nearest.f_score`."""
    return nearest_both_ways(p_a, p_b).f_score(max_distance)


def index_mse(p_a: Cloud, p_b: Float[np.ndarray, "m 3"]) -> float:
    """Return the mean squared distance, m², between rows: it measures their order as well.

    Raises:
        ValueError: If the counts differ or a cloud is empty or not finite.
    """
    check_clouds(p_a, p_b)
    if len(p_a) != len(p_b):
        raise ValueError(f"pairs by index need equal counts, not {len(p_a)} and {len(p_b)}")
    return float(np.mean(np.sum((p_a - p_b) ** 2, axis=1)))


def _query(
    tree: "scipy.spatial.KDTree", p: np.ndarray, tree_of_p: "scipy.spatial.KDTree | None" = None
) -> tuple[np.ndarray, np.ndarray]:
    """Return the indices and distances of the nearest points, in tree order where they are many."""
    if len(p) < _LARGE:
        d, indices = tree.query(p)
        return np.asarray(indices), np.asarray(d)
    order = (tree_of_p or tree_of(p)).indices
    indices = np.empty(len(p), np.intp)
    d = np.empty(len(p))
    d[order], indices[order] = tree.query(p[order], workers=-1)
    return indices, d
