"""Points and lines drawn by chance: volumes by hits, areas by crossings. Metres.

Reference: Pharr, Jakob and Humphreys, Physically Based Rendering, 4th ed., 2.1 (Monte Carlo), 8.5
(stratified), 8.7 (Sobol), A.5.1 (triangles). Santalo, Integral Geometry and Geometric Probability,
1976, chapter 12: lines in space.
"""

from typing import Literal

import numpy as np
import scipy
from jaxtyping import Bool, Float, Int

Points = Float[np.ndarray, "v 3"]
Faces = Int[np.ndarray, "f 3"]
Draw = Literal["random", "stratified", "Sobol"]

_PAIRS = 50_000  # pairs of a line and a face that are looked at together
_BITS = 32
# Of each axis: degree, coefficients and first m of Joe and Kuo
_SOBOL = ((0, 0, (1,)), (1, 0, (1,)), (2, 1, (1, 3)))


def points_on_faces(
    p: Points, faces: Faces, u: Float[np.ndarray, "n 3"]
) -> Float[np.ndarray, "n 3"]:
    """Return points on a mesh, one per row of numbers from 0 to 1, spread evenly as those are."""
    k, shares = places_on_faces(p, faces, u)
    a, b, c = p[faces[k]].transpose(1, 0, 2)
    return shares[:, :1] * a + shares[:, 1:2] * b + shares[:, 2:] * c


def places_on_faces(
    p: Points, faces: Faces, u: Float[np.ndarray, "n 3"]
) -> tuple[Int[np.ndarray, " n"], Float[np.ndarray, "n 3"]]:
    """Return on which faces such points lie, and the shares of the corners in each point.

    The first number picks the face by area; with s the square root of the second and t the third,
    the point is (1 - s) a + s (1 - t) b + s t c.
    """
    a, b, c = p[faces].transpose(1, 0, 2)
    n = np.cross(b - a, c - a)
    reached = np.cumsum(np.sqrt(np.einsum("fx,fx->f", n, n)))
    last = np.searchsorted(reached, reached[-1])  # face with an area
    k = np.minimum(np.searchsorted(reached, u[:, 0] * reached[-1], side="right"), last)
    s = np.sqrt(u[:, 1])
    t = u[:, 2]
    return k, np.stack([1 - s, s * (1 - t), s * t], axis=1)


def unit_points(
    count: int, dimension: int, draw: Draw, *, rng: np.random.Generator
) -> Float[np.ndarray, "n d"]:
    """Return points in the unit cube: on their own, one in each of equal cubes, or Sobol's.

    Their number is the nearest power k^d for cubes, of two for Sobol: the sequence is even then.
    Sobol's binary digits are flipped by chance.

    Raises:
        ValueError: If more than three dimensions of the sequence of Sobol are asked for.
    """
    if draw == "random":
        return rng.random((count, dimension))
    if draw == "stratified":
        side = max(1, round(count ** (1 / dimension)))
        cube = np.stack(
            np.meshgrid(*[np.arange(side)] * dimension, indexing="ij"), axis=-1
        ).reshape(-1, dimension)
        return (cube + rng.random(cube.shape)) / side
    digits = sobol(2 ** max(0, round(np.log2(count))), dimension)
    return ((digits ^ rng.integers(0, 2**_BITS, dimension)) + 0.5) / 2.0**_BITS


def sobol(count: int, dimension: int) -> Int[np.ndarray, "n d"]:
    """Return the first points of the sequence of Sobol in up to 3 dimensions, times 2^32.

    Any 2^k from a multiple of 2^k on lie one in each of 2^k equal boxes, cut by powers of two.
    Reference: Joe and Kuo, Constructing Sobol sequences with better two-dimensional projections,
    2008.

    Raises:
        ValueError: If there are more dimensions.
    """
    if dimension > len(_SOBOL):
        raise ValueError(f"{dimension} dimensions; direction numbers are listed for {len(_SOBOL)}")
    k = np.arange(count, dtype=np.int64)  # 32 bits are too few for the direction numbers
    gray = k ^ (k >> 1)
    points = np.zeros((count, dimension), dtype=np.int64)
    for axis, (degree, middle, m) in enumerate(_SOBOL[:dimension]):
        v = [m[i] << (_BITS - 1 - i) for i in range(len(m))]
        for i in range(len(m), _BITS):
            v.append(v[i - degree] ^ (v[i - degree] >> degree) if degree else 1 << (_BITS - 1 - i))
            for j in range(1, degree):
                v[i] ^= (middle >> (degree - 1 - j) & 1) * v[i - j]
        for bit in range(max(count - 1, 1).bit_length()):
            points[:, axis] ^= (gray >> bit & 1) * v[bit]
    return points


def volume_by_chance(inside: Bool[np.ndarray, " n"], box_volume: float) -> tuple[float, float]:
    """Return the volume of which these points of a box lie inside, and its (binomial) error, m^3.

    Raises:
        ValueError: If there are no points.
    """
    if len(inside) == 0:
        raise ValueError("no points were thrown")
    share = float(np.mean(inside))
    return box_volume * share, box_volume * float(np.sqrt(share * (1 - share) / len(inside)))


def ball_share(dimension: int) -> float:
    """Return the share of the cube [-1, 1]^d that its inscribed ball fills.

    Examples:
        >>> round(ball_share(3), 4)  # pi / 6
        0.5236
    """
    return float(
        np.exp(dimension / 2 * np.log(np.pi) - scipy.special.gammaln(dimension / 2 + 1))
        / 2.0**dimension
    )


def lines_through_ball(
    count: int, centre: Float[np.ndarray, "3"], radius: float, *, rng: np.random.Generator
) -> Float[np.ndarray, "n 2 3"]:
    """Return the ends of chords of a ball, all lines that meet it being as likely, m."""
    ends = rng.standard_normal((count, 2, 3))
    return centre + radius * ends / np.linalg.norm(ends, axis=2, keepdims=True)


def line_crossings(
    p: Points, faces: Faces, ends: Float[np.ndarray, "n 2 3"]
) -> tuple[Int[np.ndarray, " c"], Float[np.ndarray, "c 3"]]:
    """Return which segments cross the mesh, once for each face that they cross, and where."""
    a, b, c = p[faces].transpose(1, 0, 2)
    middle = (a + b + c) / 3
    squared_radius = np.max(
        [((corner - middle) ** 2).sum(axis=1) for corner in (a, b, c)], axis=0
    ) * (1 + 1e-9)
    squared_middle = (middle**2).sum(axis=1)
    start = ends[:, 0]
    along = ends[:, 1] - ends[:, 0]
    unit = along / np.linalg.norm(along, axis=1, keepdims=True)
    lines = []
    places = []
    block = max(1, _PAIRS // len(faces))
    for first in range(0, len(ends), block):
        rows = slice(first, first + block)
        o, d = start[rows], unit[rows]
        ahead = d @ middle.T - np.einsum("nx,nx->n", o, d)[:, None]
        squared_gap = squared_middle - 2 * (o @ middle.T) + (o**2).sum(axis=1)[:, None] - ahead**2
        line, face = np.nonzero(squared_gap <= squared_radius)
        at, met = _met(start[first + line], along[first + line], a[face], b=b[face], c=c[face])
        lines.append(first + line[met])
        places.append(at[met])
    return np.concatenate([np.empty(0, int), *lines]), np.concatenate([np.empty((0, 3)), *places])


def _met(start: np.ndarray, along: np.ndarray, a: np.ndarray, *, b: np.ndarray, c: np.ndarray):
    """Return where segments meet triangles, and whether (Moeller and Trumbore 1997)."""
    ab, ac, to_start = b - a, c - a, start - a
    h, q = np.cross(along, ac), np.cross(to_start, ab)
    det = np.einsum("nx,nx->n", ab, h)
    over = 1 / np.where(det == 0, np.inf, det)
    u, v, t = (over * np.einsum("nx,nx->n", *two) for two in ((to_start, h), (along, q), (ac, q)))
    return start + t[:, None] * along, (det != 0) & (u >= 0) & (v >= 0) & (u + v <= 1) & (
        t >= 0
    ) & (t <= 1)
