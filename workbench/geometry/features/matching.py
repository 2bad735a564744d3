"""Which descriptors belong together: the nearest, and which of these a filter keeps.

References: Lowe, Distinctive Image Features from Scale-Invariant Keypoints, 2004, 7.1 (the ratio);
Deriche et al., Robust recovery of the epipolar geometry, 1994 (both ways round).
"""

from dataclasses import dataclass
from typing import Literal

import numpy as np
from jaxtyping import Bool, Float, Int

Filter = Literal["nearest", "ratio", "mutual", "both"]
_CELLS = 4_000_000  # distances at a time


@dataclass(frozen=True, eq=False)
class NearestDescriptors:
    """The nearest descriptor of the other set, both ways, and how far the two nearest are."""

    index: Int[np.ndarray, " n"]
    distance: Float[np.ndarray, " n"]
    second: Float[np.ndarray, " n"]
    back: Int[np.ndarray, " m"]

    def kept(self, how: Filter, ratio: float) -> Bool[np.ndarray, " n"]:
        """Return which nearest ones a filter keeps; `ratio` is between unsquared distances."""
        keep = np.ones(len(self.index), bool)
        if how in ("ratio", "both"):
            keep &= self.distance < ratio * self.second
        if how in ("mutual", "both"):
            keep &= self.back[self.index] == np.arange(len(self.index))
        return keep


def nearest_both_ways(
    a: Float[np.ndarray, "n d"], b: Float[np.ndarray, "m d"]
) -> NearestDescriptors:
    """Return the nearest descriptors of two sets, by Euclid's distance, the first of equal ones.

    Raises:
        ValueError: If a set is empty.
    """
    if not len(a) or not len(b):
        raise ValueError("there is nothing to match: a set of descriptors is empty")
    n, m = len(a), len(b)
    index, next_to_it = np.empty(n, np.intp), np.empty(n, np.intp)
    back, least = np.zeros(m, np.intp), np.full(m, np.inf)
    centre = b.mean(axis=0)  # a common offset costs digits below
    given = (a, b)
    a, b = (a - centre, b - centre)
    squares = np.einsum("ij,ij->i", b, b)
    for start in range(0, n, max(1, _CELLS // m)):
        rows = slice(start, min(n, start + max(1, _CELLS // m)))
        some = a[rows]
        cost = squares - 2.0 * some @ b.T + np.einsum("ij,ij->i", some, some)[:, None]
        here = np.arange(len(some))
        columns = cost.argmin(axis=0)
        lower = cost[columns, np.arange(m)]
        back = np.where(lower < least, columns + start, back)
        least = np.minimum(lower, least)
        index[rows] = cost.argmin(axis=1)
        cost[here, index[rows]] = np.inf
        next_to_it[rows] = cost.argmin(axis=1)
    # of the two nearest all digits: whether one is less than a share of the other is not left to
    # rounding
    distance, second = (np.linalg.norm(given[0] - given[1][k], axis=1) for k in (index, next_to_it))
    if m == 1:
        return NearestDescriptors(index, distance, np.full(n, np.inf), back)
    turned = (second < distance) | ((second == distance) & (next_to_it < index))
    index = np.where(turned, next_to_it, index)
    return NearestDescriptors(
        index, np.minimum(distance, second), np.maximum(distance, second), back
    )


def mutual_matches(
    a: Float[np.ndarray, "n d"], b: Float[np.ndarray, "m d"], ratio: float
) -> Int[np.ndarray, " n"]:
    """Return the nearest of b for each of a, or -1 where it fails the ratio or is not mutual.

    Raises:
        ValueError: If a set is empty.

    Examples:
        >>> a, b = np.array([[0.0], [5.0], [5.2]]), np.array([[0.3], [5.1], [9.0]])
        >>> mutual_matches(a, b, 0.9).tolist()
        [0, 1, -1]
    """
    nearest = nearest_both_ways(a, b)
    return np.where(nearest.kept("both", ratio), nearest.index, -1)


def filtered(
    nearest: NearestDescriptors,
    how: Filter,
    ratio: float,
    *,
    mutual: Int[np.ndarray, " n"] | None = None,
) -> Int[np.ndarray, "k 2"]:
    """Return rows (index in the first set, index in the second) of the matches a filter keeps.

    `mutual`, somebody's `mutual_matches`, is taken where `how` is both.

    Raises:
        ValueError: If that answer names what is not there.
    """
    kept = np.where(nearest.kept(how, ratio), nearest.index, -1)
    if how == "both" and mutual is not None:
        kept = np.asarray(mutual).astype(int)
        if kept.shape != nearest.index.shape or (kept >= len(nearest.back)).any():
            raise ValueError(
                "mutual_matches has to give one index, or -1, for every descriptor of the first set"
            )
    rows = np.flatnonzero(kept >= 0)
    return np.column_stack([rows, kept[rows]])
