"""How often a mesh winds around a point, hence which are inside: by vertical rays or solid angles.

A ray upwards leaves the mesh through faces that look up (+1) and enters it through faces that look
down (-1); the sum over all faces above a point is the winding number. Every edge decides by its own
two ends on which side of it a ray passes, so that two faces never both claim a ray through their
common edge, nor both miss it.
Reference: Sunday, Inclusion of a point in a polygon, 2001 (winding number by edge crossings).
Jacobson, Kavan and Sorkine-Hornung, Robust inside-outside segmentation using generalized winding
numbers, SIGGRAPH 2013. Van Oosterom and Strackee, The solid angle of a plane triangle, IEEE Trans.
Biomed. Eng. 30, 1983.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float, Int

Points = Float[np.ndarray, "v 3"]
Faces = Int[np.ndarray, "f 3"]
Queries = Float[np.ndarray, "n 3"]

_PAIRS = 1_000_000  # pairs of a ray and a face that are looked at together
_MOST_CELLS = 256


@dataclass(frozen=True, eq=False)
class ColumnIndex:
    """A mesh sorted into square columns along z: each knows the faces whose box touches it.

    `faces` lists those of column 0, of column 1, and so on; each column's begin at `first`.
    """

    corners: Float[np.ndarray, "f 3 3"]
    low: Float[np.ndarray, "2"]
    size: Float[np.ndarray, "2"]
    cells: int
    faces: Int[np.ndarray, " m"]
    first: Int[np.ndarray, " c"]


def columns(p: Points, faces: Faces) -> ColumnIndex:
    """Return a mesh sorted into columns, for `windings`; worth it once for many points."""
    corners = p[faces]
    low, high = corners[:, :, :2].min(axis=1), corners[:, :, :2].max(axis=1)
    floor, roof = low.min(axis=0), high.max(axis=0)
    cells = int(np.clip(1.5 * np.sqrt(len(faces)), 1, _MOST_CELLS))
    size = np.maximum((roof - floor) * (1 + 1e-12) / cells, 1e-300)
    first, last = (np.clip(((end - floor) / size).astype(int), 0, cells - 1) for end in (low, high))
    face, across = spread_boxes(last - first + 1)
    i, j = (first[face] + across).T
    place = i * cells + j
    order = np.argsort(place, kind="stable")
    begins = np.searchsorted(place[order], np.arange(cells * cells + 1))
    return ColumnIndex(corners, floor, size, cells, face[order], begins)


def windings(mesh: ColumnIndex, q: Queries) -> Int[np.ndarray, " n"]:
    """Return the winding number of a closed mesh around each point: 1 inside, 0 outside.

    Where the mesh is open it holds only below what is there of it.
    """
    cell = np.floor((q[:, :2] - mesh.low) / mesh.size).astype(np.intp)
    over = ((cell >= 0) & (cell < mesh.cells)).all(axis=1)
    place = np.where(over, cell[:, 0] * mesh.cells + cell[:, 1], 0)
    counts = np.where(over, mesh.first[place + 1] - mesh.first[place], 0)
    total = np.zeros(len(q), dtype=np.intp)
    tops = mesh.corners[:, :, 2].max(axis=1, initial=-np.inf)
    for rows in _blocks(counts):
        ray, k = spread_boxes(counts[rows, None])
        ray = ray + rows.start
        face = mesh.faces[mesh.first[place[ray]] + k[:, 0]]
        above = np.flatnonzero(tops[face] > q[ray, 2])
        ray, face = ray[above], face[above]
        sign, height = crossings(mesh.corners[face], q[ray, :2])
        np.add.at(total, ray, np.where(height > q[ray, 2], sign, 0))
    return total


def inside(p: Points, faces: Faces, q: Queries) -> Bool[np.ndarray, " n"]:
    """Return which points a closed mesh winds around, in either sense, or any of several solids."""
    return windings(columns(p, faces), q) != 0


def crossings(
    corners: Float[np.ndarray, "n 3 3"], xy: Float[np.ndarray, "n 2"]
) -> tuple[Int[np.ndarray, " n"], Float[np.ndarray, " n"]]:
    """Return 1 (up), -1 (down) or 0 for vertical lines through triangles, and their heights."""
    x, y = xy.T
    (ax, bx, cx), (ay, by, cy) = np.ascontiguousarray(corners[:, :, :2].transpose(2, 1, 0))
    sign = np.zeros(len(xy), dtype=np.intp)
    for (ux, uy), (vx, vy) in (((ax, ay), (bx, by)), ((bx, by), (cx, cy)), ((cx, cy), (ax, ay))):
        above = vy > y
        spans = (uy > y) != above
        upwards = above[spans]
        lower_x, upper_x = np.where(upwards, (ux[spans], vx[spans]), (vx[spans], ux[spans]))
        lower_y, upper_y = np.where(upwards, (uy[spans], vy[spans]), (vy[spans], uy[spans]))
        right = (
            lower_x + (y[spans] - lower_y) / (upper_y - lower_y) * (upper_x - lower_x) > x[spans]
        )
        sign[spans] += right * np.where(upwards, 1, -1)
    height = np.zeros(len(xy))
    hit = sign != 0
    a, b, c = corners[hit].transpose(1, 0, 2)
    n = np.cross(b - a, c - a)
    off = n[:, 0] * (x[hit] - a[:, 0]) + n[:, 1] * (y[hit] - a[:, 1])
    plane = a[:, 2] - off / np.where(n[:, 2] == 0, 1.0, n[:, 2])
    lowest, highest = (end(end(a[:, 2], b[:, 2]), c[:, 2]) for end in (np.minimum, np.maximum))
    # Of an upright face, which is hit by rounding alone
    height[hit] = np.clip(plane, lowest, highest)
    return sign, height


def winding_numbers(p: Points, faces: Faces, q: Queries) -> Float[np.ndarray, " n"]:
    """Return the generalised winding number at each point: the solid angle of all faces over 4 pi.

    Of a closed mesh it is whole; of an open one more than one half means inside.

    Examples:
        >>> p = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
        >>> faces = np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
        >>> winding_numbers(p, faces, np.array([[0.2, 0.2, 0.2], [1.0, 1.0, 1.0]])).round(
        ...     9
        ... ).tolist()
        [1.0, 0.0]
    """
    total = np.empty(len(q))
    block = max(1, _PAIRS // 4 // max(len(faces), 1))
    for start in range(0, len(q), block):
        a, b, c = p[faces].transpose(1, 0, 2)[:, None] - q[start : start + block, None]
        la, lb, lc = (np.linalg.norm(v, axis=2) for v in (a, b, c))
        ab, bc, ca = (np.einsum("nfx,nfx->nf", u, v) for u, v in ((a, b), (b, c), (c, a)))
        volume = np.einsum("nfx,nfx->nf", a, np.cross(b, c))
        total[start : start + block] = np.arctan2(
            volume, la * lb * lc + ab * lc + bc * la + ca * lb
        ).sum(axis=1)
    return total / (2 * np.pi)


def spread_boxes(
    counts: Int[np.ndarray, "n d"],
) -> tuple[Int[np.ndarray, " m"], Int[np.ndarray, "m d"]]:
    """Return every cell of some boxes: which box it is of, and its place in it along each axis.

    Examples:
        >>> spread_boxes(np.array([[1], [2]]))[0].tolist()
        [0, 1, 1]
    """
    many = counts.prod(axis=1)
    row = np.repeat(np.arange(len(counts)), many)
    k = np.arange(len(row)) - np.repeat(np.cumsum(many) - many, many)
    places = []
    for axis in reversed(range(counts.shape[1])):
        k, place = np.divmod(k, counts[row, axis])
        places.append(place)
    return row, np.stack(places[::-1], axis=1)


def _blocks(counts: Int[np.ndarray, " n"]) -> Iterator[slice]:
    """Yield ranges of rows that together have not many more than _PAIRS counts."""
    ends = np.cumsum(counts)
    start = 0
    while start < len(counts):
        before = ends[start - 1] if start else 0
        stop = max(start + 1, int(np.searchsorted(ends, before + _PAIRS, side="right")))
        yield slice(start, stop)
        start = stop
