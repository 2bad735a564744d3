"""Marching cubes and marching squares: the surface, or the lines, between nodes of a grid that are
inside and nodes that are not.

Every cell looks at its own corners alone. A vertex is on every edge of the grid whose two ends
differ; where on the edge is for the caller to say. On each face of a cell, segments cut off the
corners that are inside; joined, they are loops around the cell, and each loop is filled by
triangles. Two cells see the same segments on the face that they share, so the surface has no hole.

The paper lists 15 patterns up to symmetry and joins the corners of an ambiguous face (two inside,
at opposite corners) in one way in some and in another in others, which leaves holes. Here a face
always keeps its inside corners apart, so that one rule makes the table of all 256 patterns.

References: Lorensen and Cline, Marching cubes: a high resolution 3D surface construction
algorithm, SIGGRAPH 1987, sections 4 and 5; Duerst, Additional reference to marching cubes, Computer
Graphics 22(2), 1988, on the holes; Montani, Scateni and Scopigno, A modified look-up table for
implicit disambiguation of marching cubes, The Visual Computer 10, 1994, on the rule.
"""

import functools
import itertools
from collections.abc import Iterator

import numpy as np
from jaxtyping import Bool, Int

Nodes = Int[np.ndarray, "v d"]

_SQUARE = (0b00, 0b01, 0b11, 0b10)
"""The corners of a face in order; bit 0 of a corner is along its first axis, bit 1 along its
second.
"""


def marching_cubes(
    inside: Bool[np.ndarray, "x y z"],
) -> tuple[Nodes, Nodes, Int[np.ndarray, "f 3"]]:
    """Return the surface between inside and outside: of each vertex the two nodes that it is
    between, and the faces, outwards.

    The first node of the two has the smaller index. The surface is closed but for where it meets
    the border of the grid, and every inner edge has two faces.

    Examples:
        >>> inside = np.zeros((3, 3, 3), dtype=bool)
        >>> inside[1, 1, 1] = True
        >>> low, high, faces = marching_cubes(inside)
        >>> len(low), len(faces)
        (6, 8)
    """
    low, high, names = _crossed_edges(inside)
    corners = [np.array([c & 1, c >> 1 & 1, c >> 2]) for c in range(8)]
    pattern = _patterns(inside, corners)
    cells = np.argwhere((pattern > 0) & (pattern < 255))
    triangles, begins = _triangle_table()
    of_cell = pattern[tuple(cells.T)]
    first = begins[of_cell]
    count = begins[of_cell + 1] - first
    cell = np.repeat(np.arange(len(cells)), count)
    row = np.arange(len(cell)) - np.repeat(np.cumsum(count) - count, count) + first[cell]
    corner, axis = triangles[row].transpose(2, 0, 1)  # of each vertex: where its edge begins
    at = cells[cell][:, None] + np.array(corners)[corner]
    return low, high, names[axis, at[..., 0], at[..., 1], at[..., 2]]


def marching_squares(
    inside: Bool[np.ndarray, "y x"],
) -> tuple[Nodes, Nodes, Int[np.ndarray, "s 2"]]:
    """Return the lines between inside and outside: of each vertex the two nodes that it is between,
    and the segments, inside to their left where the first axis points right and the second up.

    Examples:
        >>> low, high, segments = marching_squares(np.array([[True, False], [True, False]]))
        >>> low.tolist(), high.tolist(), segments.tolist()
        ([[0, 0], [1, 0]], [[0, 1], [1, 1]], [[1, 0]])
    """
    low, high, names = _crossed_edges(inside)
    corners = [np.array([c & 1, c >> 1]) for c in range(4)]
    pattern = _patterns(inside, corners)
    found = [np.empty((0, 2), np.intp)]
    for case in range(1, 15):
        cells = np.argwhere(pattern == case)
        for segment in _cut(case, _SQUARE):
            ends = []
            for corner, axis in segment:
                y, x = (cells + corners[corner]).T
                ends.append(names[axis, y, x])
            found.append(np.stack(ends, axis=1))
    return low, high, np.concatenate(found)


def closed_lines(segments: Int[np.ndarray, "s 2"]) -> list[Int[np.ndarray, " n"]]:
    """Return segments joined to lines that end where they began: vertices in the order of the
    segments, none twice.

    Raises:
        ValueError: If a line is open, as those are that reach the border of their grid.
    """
    after = dict(segments.tolist())
    lines = []
    while after:
        start = min(after)
        line = [start]
        while (vertex := after.pop(line[-1], None)) != start:
            if vertex is None:
                raise ValueError("a line does not end where it began")
            line.append(vertex)
        lines.append(np.array(line, np.intp))
    return lines


def _crossed_edges(inside: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return both ends of every edge that is crossed, and by axis and first end its number."""
    names = np.full((inside.ndim, *inside.shape), -1, np.intp)
    low: list[np.ndarray] = []
    high: list[np.ndarray] = []
    count = 0
    for axis in range(inside.ndim):
        first = np.argwhere(np.diff(inside, axis=axis))
        names[axis][tuple(first.T)] = count + np.arange(len(first))
        low.append(first)
        high.append(first + np.eye(inside.ndim, dtype=np.intp)[axis])
        count += len(first)
    return np.concatenate(low), np.concatenate(high), names


def _patterns(inside: np.ndarray, corners: list[np.ndarray]) -> np.ndarray:
    """Return of every cell which of its corners are inside, corner c as bit c."""
    pattern = np.zeros(np.maximum(np.array(inside.shape) - 1, 0), np.intp)
    for c, corner in enumerate(corners):
        here = tuple(slice(k, n - 1 + k) for k, n in zip(corner, inside.shape, strict=True))
        pattern |= inside[here].astype(np.intp) << c
    return pattern


# the table -------------------------------------------------------------------------------------

Edge = tuple[int, int]
"""An edge of a cell: the corner where it begins, and the axis along which it runs."""
Triangle = tuple[Edge, Edge, Edge]
"""Its vertices, by the edges that they are on."""


def _cut(case: int, face: tuple[int, ...]) -> list[tuple[Edge, Edge]]:
    """Return the segments on a face of a cell that cut off its inside corners, each run of
    neighbours by one segment, which has them to its left where the face is walked around
    counterclockwise.
    """
    inside = [bool(case >> corner & 1) for corner in face]
    segments = []
    for i in range(4):
        if inside[i] and not inside[i - 1]:  # a run of inside corners begins here
            last = i
            while inside[(last + 1) % 4]:
                last += 1
            enters = _edge(face[i - 1], face[i])
            leaves = _edge(face[last % 4], face[(last + 1) % 4])
            segments.append((leaves, enters))
    return segments


def _edge(a: int, b: int) -> Edge:
    return min(a, b), (a ^ b).bit_length() - 1


def _faces() -> list[tuple[int, ...]]:
    """Return the corners of a cell's six faces, counterclockwise seen from outside."""
    faces = []
    for axis in range(3):
        second = 1 << (axis + 1) % 3
        third = 1 << (axis + 2) % 3
        square = tuple((c & 1) * second | (c >> 1) * third for c in _SQUARE)
        faces += [tuple(c | 1 << axis for c in square), square[::-1]]
    return faces


def _loops(case: int) -> list[list[Edge]]:
    """Return the segments on all faces of a cell, joined to loops that run counterclockwise seen
    from where it is not inside.

    Every edge that is crossed has a segment that arrives on one of its faces, and one that leaves
    on the other.
    """
    after = {end: start for face in _faces() for start, end in _cut(case, face)}
    loops = []
    while after:
        start = min(after)
        loop = [start]
        while (edge := after.pop(loop[-1])) != start:
            loop.append(edge)
        loops.append(loop)
    return loops


def _filled(loop: list[Edge]) -> list[Triangle]:
    """Return a loop as triangles: of all ways without a new side on a face of the cell, where the
    next cell may have one too, the one of largest area, vertices in the middles of edges.

    So do the tables in use; other ways make the surface of voxels up to 0.7 % smaller.
    """
    turned = (loop[k:] + loop[:k] for k in range(len(loop)))
    loop = min(turned, key=_steps)  # a turned pattern is filled in the turned way
    sides = {frozenset(pair) for pair in itertools.pairwise([*loop, loop[0]])}

    def is_inner(way: list[Triangle]) -> bool:
        pairs = (pair for triangle in way for pair in itertools.combinations(triangle, 2))
        return not any(_share_a_face(*pair) for pair in pairs if frozenset(pair) not in sides)

    ways = [way for way in _triangulations(loop) if is_inner(way)]
    return max(reversed(ways), key=lambda way: round(sum(map(_area, way)), 9))


def _triangulations(loop: list[Edge]) -> Iterator[list[Triangle]]:
    """Yield every way to fill a loop by triangles: one on the side from its last vertex to its
    first, and what is left on both sides of that.
    """
    if len(loop) < 3:
        yield []
    for k in range(1, len(loop) - 1):
        for before in _triangulations(loop[: k + 1]):
            for behind in _triangulations(loop[k:]):
                yield [(loop[0], loop[k], loop[-1]), *before, *behind]


@functools.cache
def _middle(edge: Edge) -> np.ndarray:
    corner, axis = edge
    return np.array([(corner >> k & 1) + 0.5 * (k == axis) for k in range(3)])


def _steps(loop: list[Edge]) -> list[float]:
    """Return the lengths of the sides of a loop but the last."""
    ends = [_middle(edge) for edge in loop]
    return [round(float(np.linalg.norm(b - a)), 9) for a, b in itertools.pairwise(ends)]


@functools.cache
def _area(triangle: Triangle) -> float:
    a, b, c = (_middle(edge) for edge in triangle)
    return 0.5 * float(np.linalg.norm(np.cross(b - a, c - a)))


@functools.cache
def _share_a_face(one: Edge, other: Edge) -> bool:
    ends = [{corner, corner | 1 << axis} for corner, axis in (one, other)]
    return any(ends[0] | ends[1] <= set(face) for face in _faces())


@functools.cache
def _triangle_table() -> tuple[Int[np.ndarray, "t 3 2"], Int[np.ndarray, "257"]]:
    """Return the triangles of all 256 patterns one after the other, and where those of each begin;
    a vertex is the edge that it is on.
    """
    rows: list[Triangle] = []
    begins = [0]
    for case in range(256):
        rows += [triangle for loop in _loops(case) for triangle in _filled(loop)]
        begins.append(len(rows))
    return np.array(rows, np.intp), np.array(begins, np.intp)
