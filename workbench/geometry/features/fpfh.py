"""Fast point feature histograms: how the normals around a point turn, as 33 numbers.

Reference: Rusu, Blodow and Beetz, Fast Point Feature Histograms (FPFH) for 3D Registration, ICRA
2009, sections II and III.
"""

from collections.abc import Callable

import numpy as np
import scipy
from jaxtyping import Float, Int

BINS = 11
TIE = 1e-12  # normals that are as near to the line, but for rounding
LOW = np.array([-np.pi, -1.0, -1.0])
HIGH = np.array([np.pi, 1.0, 1.0])

PairAngles = Callable[[np.ndarray, np.ndarray, np.ndarray, np.ndarray], np.ndarray]
"""pair_angles(p_i, n_i, p_j, n_j) -> the three angles of each pair, (k, 3)."""


def pair_angles(  # noqa: PLR0917
    p_i: Float[np.ndarray, "k 3"],
    n_i: Float[np.ndarray, "k 3"],
    p_j: Float[np.ndarray, "k 3"],
    n_j: Float[np.ndarray, "k 3"],
) -> Float[np.ndarray, "k 3"]:
    """Return of each pair how the second normal turns against a frame at the first point.

    Source is the point whose normal is nearer to the line between the two, the first where both are
    as near. With its normal u, the unit line d from it to the other point, v = (d x u) / |d x u|
    and w = u x v, and the other's normal n, a row holds theta = atan2(w n, u n), alpha = v n and
    phi = u d. All are 0 where the line runs along u, or the points coincide.
    Reference: Rusu, Blodow and Beetz 2009, eq. 1 and 2.

    Examples:
        >>> flat, tilted = np.array([[0.0, 0, 1]]), np.array([[0.0, 0.6, 0.8]])
        >>> pair_angles(np.zeros((1, 3)), flat, np.array([[0.0, 1, 0]]), tilted).round(3).tolist()
        [[0.644, 0.0, -0.6]]
    """
    line = p_j - p_i
    lengths = np.sqrt(np.einsum("ij,ij->i", line, line))
    d = line / np.where(lengths > 0, lengths, 1.0)[:, None]
    first, second = np.einsum("ij,ij->i", n_i, d), np.einsum("ij,ij->i", n_j, d)
    swap = np.abs(first) < np.abs(second) - TIE
    phi = np.where(swap, -second, first)  # u d
    other = np.where(swap, -first, second)  # n d
    aligned = np.einsum("ij,ij->i", n_i, n_j)  # u n
    # Swaps of d and of the normals change its sign, each once
    triple = np.einsum("ij,ij->i", np.cross(d, n_i), n_j)
    sine = np.sqrt(np.maximum(1.0 - phi * phi, 0.0))  # |d x u|
    framed = (sine > 1e-7) & (lengths > 0)
    sine = np.where(framed, sine, 1.0)
    theta = np.arctan2((other - phi * aligned) / sine, aligned)
    return np.where(framed[:, None], np.column_stack([theta, triple / sine, phi]), 0.0)


def pairs_within(p: Float[np.ndarray, "n 3"], radius: float) -> Int[np.ndarray, "k 2"]:
    """Return the index pairs i < j of points up to `radius` apart, metres."""
    return scipy.spatial.KDTree(p).query_pairs(radius, output_type="ndarray").astype(np.intp)


def fpfh(
    p: Float[np.ndarray, "n 3"],
    n: Float[np.ndarray, "n 3"],
    radius: float,
    *,
    pair_angles: PairAngles = pair_angles,
) -> Float[np.ndarray, "n 33"]:
    """Return one descriptor per point: its histograms, and those of neighbours by nearness.

    Rows are 33 numbers, none negative; zeros without neighbours within `radius`, m. A neighbour
    counts by one over its squared distance, as in PCL and Open3D; the paper (eq. 3) writes one over
    the distance. `pair_angles` is asked once for each pair, or twice where both normals are as near
    to the line. Which of the two sides the normals face counts.
    """
    count = len(p)
    pairs = pairs_within(p, radius)
    i, j = pairs.T
    line = p[j] - p[i]
    squared = np.einsum("ij,ij->i", line, line)
    apart = squared > 0
    if not apart.all():
        i, j, line, squared = i[apart], j[apart], line[apart], squared[apart]
    bins = _bins(np.asarray(pair_angles(p[i], n[i], p[j], n[j]), float))
    back = bins
    first, second = (np.abs(np.einsum("ij,ij->i", n[k], line)) for k in (i, j))
    tied = np.flatnonzero(np.abs(first - second) <= TIE * np.sqrt(squared))
    if len(tied):  # each point is its own source then, as where two points have one normal
        back = bins.copy()
        i_tied = i[tied]
        j_tied = j[tied]
        back[tied] = _bins(
            np.asarray(pair_angles(p[j_tied], n[j_tied], p[i_tied], n[i_tied]), float)
        )
    size = count * BINS
    own = np.empty((count, 3 * BINS))
    for k in range(3):  # a pair counts at both of its points
        both = np.bincount(i * BINS + bins[:, k], minlength=size) + np.bincount(
            j * BINS + back[:, k], minlength=size
        )
        own[:, k * BINS : (k + 1) * BINS] = both.reshape(count, BINS)
    degrees = np.bincount(i, minlength=count) + np.bincount(j, minlength=count)
    own *= (100.0 / np.maximum(degrees, 1))[:, None]
    weights = scipy.sparse.csr_array((1.0 / squared, (i, j)), shape=(count, count))
    around = (weights @ own + weights.T @ own).reshape(count, 3, BINS)
    sums = around.sum(axis=2, keepdims=True)
    return own + (around * (100.0 / np.where(sums > 0, sums, 1.0))).reshape(count, -1)


def _bins(angles: np.ndarray) -> np.ndarray:
    with np.errstate(invalid="ignore"):
        scaled = np.floor((angles - LOW) * (BINS / (HIGH - LOW)))
    return np.clip(np.nan_to_num(scaled), 0, BINS - 1).astype(np.intp)
