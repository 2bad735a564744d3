"""Triangle meshes as two arrays: what holds at faces, corners, edges, vertices and borders.

`p` are vertex positions in metres, one row per vertex; `faces` names three vertices per face,
counterclockwise seen from outside. Corner k of a face is opposite its edge k. No function here
checks its mesh: `check_mesh` does, once, where a mesh enters.
Reference: Thuermer and Wuethrich, Computing vertex normals from polygonal facets, JGT 3(1), 1998.
"""

from dataclasses import dataclass

import numpy as np
import scipy
from jaxtyping import Bool, Float, Int, Shaped

from workbench.errors import InputError
from workbench.geometry.graphs import graph_of

Points = Float[np.ndarray, "v 3"]
Faces = Int[np.ndarray, "f 3"]

# Faces measured at once, so that what is computed from them stays in the processor's cache.
BLOCK = 8192


@dataclass(frozen=True, eq=False)
class Corners:
    """The measures of which formulas on a mesh are made: corner k of face i in row k, column i.

    `edges` are opposite each corner, counterclockwise (x, y, z first); `dots` the products of the
    two edges that leave it; `normals` point outwards, as long as twice the area; `count` the
    vertices.
    """

    vertices: Int[np.ndarray, "3 f"]
    edges: Float[np.ndarray, "3 3 f"]
    dots: Float[np.ndarray, "3 f"]
    normals: Float[np.ndarray, "3 f"]
    double_areas: Float[np.ndarray, " f"]
    count: int

    @property
    def angles(self) -> Float[np.ndarray, "3 f"]:
        """The inner angle at every corner, radians; without area 0, 0 and pi, or 0 three times."""
        return np.arctan2(self.double_areas, self.dots)

    @property
    def cotangents(self) -> Float[np.ndarray, "3 f"]:
        """The cotangent of every angle; 0 in a face without area, which then counts for nothing."""
        area = self.double_areas
        return self.dots * np.divide(1.0, area, out=np.zeros_like(area), where=area > 0)

    @property
    def squared_edges(self) -> Float[np.ndarray, "3 f"]:
        """The squared length of the edge opposite every corner, m^2."""
        return self.dots[[1, 2, 0]] + self.dots[[2, 0, 1]]

    def sums(self, values: Float[np.ndarray, "3 f"]) -> Float[np.ndarray, " v"]:
        """Return at every vertex the sum of what stands at its corners."""
        return np.bincount(self.vertices.ravel(), values.ravel(), self.count)


def corners(p: Points, faces: Faces) -> Corners:
    """Return the measures at all corners of a mesh, in one pass."""
    f = len(faces)
    vertices = np.ascontiguousarray(faces.T)
    edge = np.empty((3, 3, f))
    dots = np.empty((3, f))
    normals = np.empty((3, f))
    for start in range(0, f, BLOCK):
        block = slice(start, start + BLOCK)
        a, b, c = np.take(p, vertices[:, block], axis=0).transpose(0, 2, 1)
        bc, ca, ab = c - b, a - c, b - a
        for k, (own, after, before) in enumerate(((bc, ca, ab), (ca, ab, bc), (ab, bc, ca))):
            edge[:, k, block] = own
            dots[k, block] = -np.einsum("xf,xf->f", after, before)
        for k, (y, z) in enumerate(((1, 2), (2, 0), (0, 1))):
            normals[k, block] = ab[y] * bc[z] - ab[z] * bc[y]
    return Corners(
        vertices, edge, dots, normals, np.sqrt(np.einsum("xf,xf->f", normals, normals)), len(p)
    )


def face_angles(p: Points, faces: Faces) -> Float[np.ndarray, "f 3"]:
    """Return the inner angles of each face, radians; a row adds up to pi unless it is a point."""
    return np.ascontiguousarray(corners(p, faces).angles.T)


def face_areas(p: Points, faces: Faces) -> Float[np.ndarray, " f"]:
    """Return the area of every face, m^2.

    Examples:
        >>> face_areas(
        ...     np.array([[0.0, 0, 0], [2, 0, 0], [0, 1, 0]]), np.array([[0, 1, 2]])
        ... ).tolist()
        [1.0]
    """
    return corners(p, faces).double_areas / 2


def face_normals(p: Points, faces: Faces) -> Float[np.ndarray, "f 3"]:
    """Return the outward unit normal of every face; zero where a face has no area."""
    return _unit(corners(p, faces).normals.T)


def vertex_normals(p: Points, faces: Faces) -> Float[np.ndarray, "v 3"]:
    """Return unit normals at the vertices: the face normals around, weighted by their angle there.

    They do not depend on how a flat piece was cut into triangles. Zero without faces.
    """
    return normals_at_vertices(corners(p, faces))


def normals_at_vertices(measured: Corners) -> Float[np.ndarray, "v 3"]:
    """Return the angle-weighted unit normals of corners that were measured already."""
    angles = measured.angles
    area = measured.double_areas
    unit = measured.normals * np.divide(1.0, area, out=np.zeros_like(area), where=area > 0)
    return _unit(np.stack([measured.sums(angles * unit[k]) for k in range(3)], axis=1))


def edges(faces: Faces) -> Int[np.ndarray, "e 2"]:
    """Return every undirected edge once, its smaller vertex first, in ascending order."""
    keys = np.sort(edge_keys(half_edges(faces)))  # several times as fast as `np.unique`
    return _split(keys[np.diff(keys, prepend=-1) > 0])


def boundary_edges(faces: Faces) -> Int[np.ndarray, "b 2"]:
    """Return the edges that have a face on one side only, in the direction of that face."""
    half = half_edges(faces)
    _, first, times = np.unique(edge_keys(half), return_index=True, return_counts=True)
    return half[np.sort(first[times == 1])]


def on_boundary(faces: Faces, count: int) -> Bool[np.ndarray, " {count}"]:
    """Return for each of `count` vertices whether it lies on the border of an oriented mesh."""
    # Going round a closed fan every neighbour follows once and precedes once, so that the sum of
    # (next - previous) is 0; round an open fan it is the first neighbour minus the last. Whole
    # numbers below 2^53 add up exactly.
    following, preceding = faces[:, [1, 2, 0]], faces[:, [2, 0, 1]]
    return np.bincount(faces.ravel(), (following - preceding).ravel(), count) != 0


def adjacency(faces: Faces, count: int) -> "scipy.sparse.csr_array":
    """Return the `count` x `count` matrix with a 1 where an edge joins two vertices."""
    return graph_of(edges(faces), count)


def one_ring(faces: Faces, vertex: int) -> tuple[Int[np.ndarray, " k"], Int[np.ndarray, " n"]]:
    """Return the faces around a vertex and its neighbours, both counterclockwise.

    On the border there is one more neighbour than faces, first and last being border vertices.

    Raises:
        ValueError: If the vertex has no face, or its faces are not one fan.
    """
    around, corner = np.nonzero(faces == vertex)
    if not len(around):
        raise ValueError(f"vertex {vertex} belongs to no face")
    start, end = faces[around, (corner + 1) % 3], faces[around, (corner + 2) % 3]
    leaving = {int(a): i for i, a in enumerate(start)}
    first = [int(a) for a in start if a not in set(end.tolist())]
    ring = [first[0] if first else int(start[0])]
    order = []
    while ring[-1] in leaving:
        order.append(leaving.pop(ring[-1]))
        ring.append(int(end[order[-1]]))
    if len(order) < len(around) or len(first) > 1:
        raise ValueError(f"the {len(around)} faces at vertex {vertex} are not one fan")
    return around[order], np.array(ring if first else ring[:-1])


def vertices_within(
    edges: Int[np.ndarray, "e 2"], vertex: int, steps: int
) -> Int[np.ndarray, " n"]:
    """Return the vertices at most so many edges away from one, itself included, ascending."""
    a, b = edges.T
    near = np.zeros(max(int(edges.max(initial=-1)), vertex) + 1, dtype=bool)
    near[vertex] = True
    for _ in range(steps):
        touched = near[a] | near[b]
        near[a[touched]] = near[b[touched]] = True
    return np.flatnonzero(near)


def euler_characteristic(faces: Faces) -> int:
    """Return chi = V - E + F, counting the vertices in use: 2 - 2g for genus g.

    Examples:
        >>> euler_characteristic(np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]))
        2
    """
    return len(np.unique(faces)) - len(edges(faces)) + len(faces)


def distinct_rows(
    rows: Shaped[np.ndarray, "n d"],
) -> tuple[Int[np.ndarray, " u"], Int[np.ndarray, " n"]]:
    """Return where each distinct row is found first, in order, and of each row which it is.

    `np.unique` finds the same, but its sorting lets no other thread run.

    Examples:
        >>> distinct_rows(np.array([[2, 0], [1, 5], [2, 0]]))
        (array([1, 0]), array([1, 0, 1]))
    """
    order = np.argsort(rows[:, 0])
    new = np.ones(len(rows), dtype=bool)
    leading = rows[order, 0]
    # where no first number is there twice, all rows are distinct, and the others need no sorting
    if not (leading[1:] > leading[:-1]).all():
        order = np.lexsort(rows.T[::-1])
        in_order = rows[order]
        new[1:] = (in_order[1:] != in_order[:-1]).any(axis=1)
    name = np.empty(len(rows), dtype=np.intp)
    name[order] = np.cumsum(new) - 1
    return order[new], name


def welded(p: Points, faces: Faces) -> tuple[Float[np.ndarray, "u 3"], Int[np.ndarray, "g 3"]]:
    """Return the mesh with one vertex per place, without collapsed faces and unused vertices."""
    first, name = distinct_rows(p)
    at, faces = p[first], name[faces]
    a, b, c = faces.T
    faces = faces[(a != b) & (b != c) & (c != a)]
    used = np.zeros(len(at), dtype=bool)
    used[faces] = True
    return at[used], (np.cumsum(used) - 1)[faces]


def check_mesh(p: Points, faces: Faces) -> None:
    """Raise InputError, with what to mend, for a mesh on which curvature has no meaning.

    Raises:
        InputError: If the mesh is empty, names vertices that are not there, is not finite, has
            faces without area, edges with more than two faces, faces that disagree which side is
            outside, vertices where sheets only touch, or vertices without faces.
    """
    if len(p) == 0 or len(faces) == 0:
        raise InputError(
            f"the mesh is empty: {len(p)} vertices and {len(faces)} faces; a point cloud has no"
            " faces to use"
        )
    if not np.isfinite(p).all():
        bad = int(np.argmin(np.isfinite(p).all(axis=1)))
        raise InputError(f"vertex {bad} of the mesh is not finite; remove or repair it")
    if faces.min() < 0 or faces.max() >= len(p):
        raise InputError(
            f"a face names vertex {int(faces.max())}, but the mesh has {len(p)} vertices, counted"
            " from 0"
        )
    _check_faces(p, faces)
    _check_edges(faces)
    _check_vertices(p, faces)


def _check_faces(p: Points, faces: Faces) -> None:
    measured = corners(p, faces)
    longest = measured.squared_edges.max(axis=0)
    flat = np.flatnonzero(measured.double_areas <= 1e-12 * longest)
    if len(flat):
        raise InputError(
            f"{len(flat)} of {len(faces)} faces have no area (the first is face {flat[0]}); remove"
            " or merge them first"
        )


def _check_edges(faces: Faces) -> None:
    half = half_edges(faces)
    keys, times = np.unique(edge_keys(half), return_counts=True)
    if (times > 2).any():
        a, b = _split(keys[times > 2])[0]
        raise InputError(
            f"the mesh is not a surface: {int((times > 2).sum())} edges have more than two faces"
            f" (the first joins vertices {a} and {b}); split or remove the extra faces"
        )
    directed, times = np.unique(
        half[:, 0] * (int(faces.max()) + 1) + half[:, 1], return_counts=True
    )
    if (times > 1).any():
        a, b = divmod(int(directed[times > 1][0]), int(faces.max()) + 1)
        raise InputError(
            f"neighbouring faces disagree which side is outside (at the edge of vertices {a} and"
            f" {b}); make the faces' orientation consistent"
        )


def _check_vertices(p: Points, faces: Faces) -> None:
    used = np.zeros(len(p), dtype=bool)
    used[faces] = True
    if not used.all():
        raise InputError(
            f"{int((~used).sum())} vertices belong to no face (the first is {int(np.argmin(used))})"
        )
    fan_vertex, _ = corner_fans(faces)
    if len(fan_vertex) > len(p):
        touching = np.flatnonzero(np.bincount(fan_vertex, minlength=len(p)) > 1)
        raise InputError(
            f"the mesh is not a surface: at {len(touching)} vertices sheets only touch (the first"
            f" is vertex {touching[0]}); split these vertices"
        )


def corner_fans(faces: Faces) -> tuple[Int[np.ndarray, " n"], Int[np.ndarray, " c"]]:
    """Return the vertex of every fan, and the fan of every corner: all corners 0, then 1, then 2.

    A fan is a set of corners at one vertex, each sharing an edge with the next; a surface has one.
    """
    half, f = half_edges(faces), len(faces)
    edge, twin = twins(half)
    # Half-edge k*f + i leaves corner k+1 of face i for corner k+2; its twin runs the other way if
    # the two faces agree.

    def corner(h: np.ndarray, step: int) -> np.ndarray:
        return (h // f + step) % 3 * f + h % f

    agree = half[edge, 0] != half[twin, 0]
    a = np.concatenate([corner(edge, 1), corner(edge, 2)])
    leaves, arrives = corner(twin, 1), corner(twin, 2)
    b = np.concatenate([np.where(agree, arrives, leaves), np.where(agree, leaves, arrives)])
    links = scipy.sparse.coo_array((np.ones(len(a), dtype=bool), (a, b)), shape=(3 * f, 3 * f))
    count, fan = scipy.sparse.csgraph.connected_components(links, directed=False)
    fan_vertex = np.zeros(count, dtype=np.intp)
    fan_vertex[fan] = faces.T.ravel()
    return fan_vertex, fan


def half_edges(faces: Faces) -> Int[np.ndarray, "h 2"]:
    """Return edge 0 of all faces, then edge 1, then edge 2, each in the direction of its face."""
    return np.concatenate([faces[:, [1, 2]], faces[:, [2, 0]], faces[:, [0, 1]]])


def twins(half: Int[np.ndarray, "h 2"]) -> tuple[Int[np.ndarray, " t"], Int[np.ndarray, " t"]]:
    """Return which half-edges share an undirected edge with which, in pairs."""
    keys = edge_keys(half)
    order = np.argsort(keys, kind="stable")
    same = np.flatnonzero(np.diff(keys[order]) == 0)
    return order[same], order[same + 1]


def edge_keys(half: Int[np.ndarray, "h 2"]) -> Int[np.ndarray, " h"]:
    """Return one whole number per undirected edge, which sorts much faster than rows."""
    return half.min(axis=1).astype(np.int64) << 32 | half.max(axis=1).astype(np.int64)


def _split(keys: Int[np.ndarray, " e"]) -> Int[np.ndarray, "e 2"]:
    return np.stack([keys >> 32, keys & 0xFFFFFFFF], axis=1).astype(np.intp)


def _unit(v: Float[np.ndarray, "n 3"]) -> Float[np.ndarray, "n 3"]:
    length = np.sqrt(np.einsum("nk,nk->n", v, v))[:, None]
    return np.divide(v, length, out=np.zeros_like(v), where=length > 0)
