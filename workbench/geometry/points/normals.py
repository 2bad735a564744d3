"""Normals of a point cloud: the direction of least spread of each point's neighbours.

Reference: Hoppe, DeRose, Duchamp, McDonald and Stuetzle, Surface reconstruction from unorganized
points, 1992, section 3.2.
"""

import os
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import scipy
from jaxtyping import Float, Int

from workbench.geometry.points.nearest import tree_for_many

CHUNK = 4096
ALONE = 1000  # points up to which threads cost more than they save
LINE = 0.2


def point_normals(
    p: Float[np.ndarray, "n 3"],
    k: int = 16,
    viewpoint: Float[np.ndarray, "3"] | None = None,
    *,
    spread: bool = False,
) -> Float[np.ndarray, "n 3"]:
    """Return one unit normal per point, by principal components of its k nearest, itself included.

    Normals face the viewpoint, or away from the mean. With `spread` those of points whose
    neighbours lie along a line (the second variance at most a fifth
    of the largest) are 0, unless all are. Hoppe et al. 1992, 3.2.

    Raises:
        ValueError: If there are fewer than 3 points, k is below 3, or a coordinate is not finite.
    """
    return Normals(p, k, viewpoint, spread=spread).at(np.arange(len(p)))


class Normals:
    """The normals of a cloud, each computed when it is first asked for: those of `point_normals`.

    `tree` is the cloud's, where it has one already.

    Raises:
        ValueError: As `point_normals`.
    """

    def __init__(
        self,
        p: Float[np.ndarray, "n 3"],
        k: int = 16,
        viewpoint: Float[np.ndarray, "3"] | None = None,
        *,
        spread: bool = False,
        tree: "scipy.spatial.KDTree | None" = None,
    ) -> None:
        if len(p) < 3 or k < 3:
            raise ValueError(
                f"normals need at least 3 points and 3 neighbours, not {len(p)} and {k}"
            )
        if not np.isfinite(p).all():
            raise ValueError("a point is not finite; drop such points first")
        self._p = p
        self._k = min(k, len(p))
        self._outwards = p - p.mean(axis=0) if viewpoint is None else viewpoint - p
        self._spread = spread
        self._tree = tree or tree_for_many(p)
        self._normals = np.empty_like(p, dtype=float)
        self._line = np.ones(len(p), bool)  # unless known better
        self._known = np.zeros(len(p), bool)

    def at(self, rows: Int[np.ndarray, "m"]) -> Float[np.ndarray, "m 3"]:
        """Return the normals of these points."""
        self._compute(rows)
        normals = self._normals.take(rows, axis=0)
        if not self._spread:
            return normals
        if self._line.all():  # of those known: whether all are decides what counts
            self._compute(np.arange(len(self._p)))
        line = self._line
        return normals * (line if line.all() else ~line).take(rows)[:, None]

    def _compute(self, rows: np.ndarray) -> None:
        wanted = np.zeros(len(self._p), bool)
        wanted[rows] = True
        wanted &= ~self._known
        for chunk, covariances in _neighbourhoods(self._p, self._tree, self._k, wanted=wanted):
            normals, self._line[chunk] = _directions(covariances)
            inwards = np.einsum("ij,ij->i", normals, self._outwards[chunk]) < 0
            self._normals[chunk] = np.where(inwards[:, None], -normals, normals)
        self._known |= wanted  # last, for whoever asks meanwhile


def surface_variation(p: Float[np.ndarray, "n 3"]) -> float:
    """Return lambda_0 / (lambda_0 + lambda_1 + lambda_2) of the covariance: 0 flat, at most 1/3.

    Reference: Pauly, Gross and Kobbelt, Efficient simplification of point-sampled surfaces, 2002,
    4.
    """
    values = np.linalg.eigvalsh(np.cov(p.T))
    return float(values[0] / values.sum()) if values.sum() > 0 else 0.0


def _neighbourhoods(
    p: np.ndarray, tree: "scipy.spatial.KDTree", k: int, *, wanted: np.ndarray
) -> Iterator[tuple[np.ndarray, np.ndarray]]:
    """Yield wanted rows of p and the covariances of their k nearest, in chunks for the cache, which
    a thread for each processor takes in turn.
    """
    order = tree.indices[wanted[tree.indices]]  # so that consecutive queries touch the same leaves
    coordinates = np.ascontiguousarray(p.T)

    def of_chunk(rows: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        neighbours = np.asarray(tree.query(p[rows], k=k)[1])
        return rows, _covariances(coordinates, rows, neighbours)

    chunks = [order[start : start + CHUNK] for start in range(0, len(order), CHUNK)]
    threads = os.cpu_count() or 1
    if threads == 1 or len(order) <= ALONE:
        yield from map(of_chunk, chunks)
        return
    with ThreadPoolExecutor(threads) as pool:
        yield from pool.map(of_chunk, chunks)


def _covariances(coordinates: np.ndarray, rows: np.ndarray, neighbours: np.ndarray) -> np.ndarray:
    """Return xx, yy, zz, xy, xz, yz of each neighbourhood, summed about the point itself first."""
    nearest = neighbours.T.copy()  # sums over long lines take half the time of sums over short ones
    v = [own.take(nearest) - own[rows] for own in coordinates]
    total = [own.sum(axis=0) for own in v]
    pairs = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))
    return np.stack(
        [np.einsum("ij,ij->j", v[a], v[b]) - total[a] * total[b] / len(nearest) for a, b in pairs]
    )


def _directions(covariances: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return of neighbourhoods the unit vectors of least spread, and which lie along a line.

    On a line, as on one ring of a lidar scan, the second variance is at most a fifth of the
    largest, and a normal means nothing. The vector is the longest cross product of two rows of
    C - root I, where root is the least of the characteristic polynomial; where that is short (two
    small eigenvalues nearly equal), `eigh` decides.
    """
    c = covariances / np.maximum(covariances[:3].sum(axis=0), np.finfo(float).tiny)
    root, largest = _extreme_roots(c)
    on_a_line = c[:3].sum(axis=0) - root - largest <= LINE * largest
    a, b, d, e, f, g = c
    a, b, d = a - root, b - root, d - root
    products = np.stack(  # rows (a e f), (e b g), (f g d) crossed in pairs
        [
            np.stack([e * g - f * b, f * e - a * g, a * b - e * e]),
            np.stack([e * d - f * g, f * f - a * d, a * g - e * f]),
            np.stack([b * d - g * g, g * f - e * d, e * g - b * f]),
        ]
    )
    squares = np.einsum("ijk,ijk->ik", products, products)
    vectors, most = products[0], squares[0]
    for other, square in zip(products[1:], squares[1:], strict=True):
        vectors = np.where(square > most, other, vectors)
        most = np.maximum(square, most)
    longest = np.sqrt(most)
    vectors = (vectors / np.maximum(longest, 1e-300)).T
    unsure = longest < 1e-5
    if unsure.any():
        matrices = covariances[:, unsure][[0, 3, 4, 3, 1, 5, 4, 5, 2]].T.reshape(-1, 3, 3)
        vectors[unsure] = np.linalg.eigh(matrices)[1][:, :, 0]
    return vectors, on_a_line


def _extreme_roots(c: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the least and the largest eigenvalue, by the roots of the characteristic polynomial.

    Reference: Smith, Eigenvalues of a symmetric 3 x 3 matrix, 1961.
    """
    a, b, d, e, f, g = c
    third = (a + b + d) / 3.0
    a, b, d = a - third, b - third, d - third
    radius = np.sqrt(
        np.maximum((a * a + b * b + d * d + 2.0 * (e * e + f * f + g * g)) / 6.0, 1e-60)
    )
    det = a * (b * d - g * g) - e * (e * d - f * g) + f * (e * g - b * f)
    half_det = 0.5 * det / (radius * radius * radius)  # a power takes ten times as long
    turn = np.arccos(np.clip(half_det, -1.0, 1.0)) / 3.0
    least = third + 2.0 * radius * np.cos(turn + 2.0 * np.pi / 3.0)
    return least, third + 2.0 * radius * np.cos(turn)
