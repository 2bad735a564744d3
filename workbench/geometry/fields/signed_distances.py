"""How far a point is from a surface, negative inside: closed forms, or triangles of a mesh.

Reference: Quilez, Distance functions, iquilezles.org/articles/distfunctions (box, torus). Ericson,
Real-Time Collision Detection, 2005, 5.1.5 (a point and a triangle), 6.2 (boxes in boxes).
"""

from dataclasses import dataclass

import numpy as np
import scipy
from jaxtyping import Float, Int

from workbench.geometry.meshes.containment import ColumnIndex, columns, windings

Points = Float[np.ndarray, "v 3"]
Faces = Int[np.ndarray, "f 3"]
Queries = Float[np.ndarray, "n 3"]

# looked at together, so that what they need stays near the processor
_BLOCK = 4_000  # points
_PAIRS = 16_000  # of a point and a triangle
# In which coordinates are summed; rounding, and so every recording, depends on it
_ORDER = (0, 2, 1)


def box_sdf(p: Queries, half_size: Float[np.ndarray, "3"]) -> Float[np.ndarray, " n"]:
    """Return the signed distance to a box about the origin, its edges along the axes, m.

    Examples:
        >>> box_sdf(np.array([[0.0, 0, 0], [4, 5, 0]]), np.array([1.0, 1.0, 1.0])).tolist()
        [-1.0, 5.0]
    """
    beyond = np.abs(p) - half_size
    outside = np.maximum(beyond, 0)
    return np.sqrt(np.einsum("nx,nx->n", outside, outside)) + np.minimum(beyond.max(axis=1), 0)


def torus_sdf(p: Queries, ring: float, tube: float) -> Float[np.ndarray, " n"]:
    """Return the signed distance to a torus around z, m, with the radii of ring and tube.

    Examples:
        >>> torus_sdf(np.array([[1.0, 0, 0], [0, 0, 0]]), 1.0, 0.4).tolist()
        [-0.4, 0.6]
    """
    return np.hypot(np.hypot(p[:, 0], p[:, 1]) - ring, p[:, 2]) - tube


@dataclass(frozen=True, eq=False)
class FaceTree:
    """A mesh sorted for distances: boxes around all faces, around both halves, and so on.

    `corners` (corner, coordinate, triangle) are in the order of the last boxes, the last repeated
    up to a power of two. `boxes` holds for each level the lowest and highest corners (2, 3,
    2^level); box k holds boxes 2k and 2k + 1 of the next level. `columns` is None of a mesh that is
    not closed. Triangles come last: that is several times as fast to gather from as rows of three.
    """

    corners: Float[np.ndarray, "3 3 f"]
    boxes: tuple[Float[np.ndarray, "2 3 _"], ...]
    middles: "scipy.spatial.cKDTree"
    columns: ColumnIndex | None


def face_tree(p: Points, faces: Faces, *, closed: bool) -> FaceTree:
    """Return a mesh sorted for `mesh_sdf`, worth it for many points; a closed one has an inside."""
    depth = max(len(faces) - 1, 0).bit_length()
    face = np.minimum(np.arange(2**depth), len(faces) - 1)
    middles = p[faces].mean(axis=1).take(face, axis=0)
    for level in range(depth):  # each group in halves, along the longest side of its middles
        groups = middles.reshape(2**level, -1, 3)
        axis = np.ptp(groups, axis=1).argmax(axis=1)
        order = np.take_along_axis(groups, axis[:, None, None], axis=2)[:, :, 0].argsort(axis=1)
        place = (order + np.arange(2**level)[:, None] * order.shape[1]).ravel()
        face = face.take(place)
        middles = middles.take(place, axis=0)
    corners = p[faces].take(face, axis=0)
    boxes = [np.stack([corners.min(axis=1), corners.max(axis=1)])]
    for _ in range(depth):
        low, high = boxes[-1].reshape(2, -1, 2, 3)
        boxes.append(np.stack([low.min(axis=1), high.max(axis=1)]))
    return FaceTree(
        np.ascontiguousarray(corners.transpose(1, 2, 0)),
        tuple(np.ascontiguousarray(level.transpose(0, 2, 1)) for level in boxes[::-1]),
        scipy.spatial.cKDTree(middles),
        columns(p, faces) if closed else None,
    )


def mesh_sdf(mesh: FaceTree, q: Queries) -> Float[np.ndarray, " n"]:
    """Return the distance to the nearest triangle, m, negative where a closed mesh winds around."""
    distances = mesh_distance(mesh, q)
    if mesh.columns is None:
        return distances
    return np.where(windings(mesh.columns, q) != 0, -distances, distances)


def mesh_distance(mesh: FaceTree, q: Queries) -> Float[np.ndarray, " n"]:
    """Return the distance to the nearest triangle, m."""
    near = np.asarray(mesh.middles.query(q)[1], dtype=np.intp).reshape(-1)
    columns_of_q = np.ascontiguousarray(q.T)
    best = _squared_distances(columns_of_q, mesh.corners.take(near, axis=2))
    for start in range(0, len(q), _BLOCK):
        rows = np.arange(start, min(start + _BLOCK, len(q)))
        box = np.zeros(len(rows), dtype=np.intp)
        for level, (low, high) in enumerate(mesh.boxes):
            if level:
                rows = np.repeat(rows, 2)
                box = np.repeat(2 * box, 2)
                box[1::2] += 1
            kept = np.flatnonzero(
                _squared_beyond(columns_of_q, rows, low, high=high, box=box) < best.take(rows)
            )
            rows, box = rows.take(kept), box.take(kept)
        for first in range(0, len(rows), _PAIRS):
            some = slice(first, first + _PAIRS)
            nearer = _squared_distances(
                columns_of_q.take(rows[some], axis=1), mesh.corners.take(box[some], axis=2)
            )
            np.minimum.at(best, rows[some], nearer)
    return np.sqrt(best)


def _squared_beyond(
    q: np.ndarray, rows: np.ndarray, low: np.ndarray, *, high: np.ndarray, box: np.ndarray
) -> np.ndarray:
    """Return squared distances of points to boxes, pair by pair."""
    total = np.zeros(len(rows))
    for axis in _ORDER:
        at, below, above = q[axis].take(rows), low[axis].take(box), high[axis].take(box)
        np.subtract(below, at, out=below)
        np.subtract(at, above, out=above)
        beyond = np.maximum(np.maximum(below, above, out=below), 0.0, out=below)
        total += np.multiply(beyond, beyond, out=beyond)
    return total


def _squared_distances(q: np.ndarray, corners: np.ndarray) -> np.ndarray:
    """Return squared distances (n,) of points (3, n) to triangles (3, 3, n), pair by pair."""
    a, b, c = corners
    n = _cross(b - a, c - a)
    size = _dot(n, n)
    over = size > 0
    best = np.full(len(size), np.inf)
    for start, end in ((a, b), (b, c), (c, a)):
        edge, away = end - start, q - start
        square = _dot(edge, edge)
        along = _dot(away, edge) / np.where(square > 0, square, 1.0)
        rest = away - np.clip(along, 0, 1) * edge
        best = np.minimum(best, _dot(rest, rest))
        over &= _dot(_cross(edge, away), n) >= 0
    return np.where(over, _dot(q - a, n) ** 2 / np.where(size > 0, size, 1.0), best)


def _dot(u: np.ndarray, v: np.ndarray) -> np.ndarray:
    first, *rest = _ORDER
    total = u[first] * v[first]
    for axis in rest:
        total += u[axis] * v[axis]
    return total


def _cross(u: np.ndarray, v: np.ndarray) -> np.ndarray:
    (ux, uy, uz), (vx, vy, vz) = u, v
    return np.stack([uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx])
