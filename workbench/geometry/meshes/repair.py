"""Mends a triangle mesh without moving a point of it: repeats, turned faces, touching sheets.

What cannot be mended is left as it is, for `workbench.geometry.meshes.check_mesh` to name.
"""

import numpy as np
import scipy
from jaxtyping import Float, Int

from workbench.geometry.meshes.triangles import corner_fans, distinct_rows, half_edges, twins

Points = Float[np.ndarray, "v 3"]
Faces = Int[np.ndarray, "f 3"]


def without_repeats(faces: Faces) -> Int[np.ndarray, "g 3"]:
    """Return the faces without those that name the same three vertices in the same sense again."""
    first = np.argmin(faces, axis=1)[:, None]
    started_alike = np.take_along_axis(faces, (first + np.arange(3)) % 3, axis=1)
    kept, _ = distinct_rows(started_alike)
    return faces[np.sort(kept)]


def oriented(faces: Faces) -> Faces:
    """Return the faces, as few turned as possible, so that neighbours agree which side is outside.

    A piece with one side only, and a mesh with more than two faces at an edge, stay as they are.
    """
    half, f = half_edges(faces), len(faces)
    edge, twin = twins(half)
    if (twin[:-1] == edge[1:]).any():
        return faces
    # Each face twice, as it is (i) and turned (i + f); an edge joins those that agree. Half-edge
    # k*f + i is one of face i.
    agree = half[edge, 0] != half[twin, 0]
    a = np.concatenate([edge % f, edge % f + f])
    b = np.where(agree, twin % f, twin % f + f)
    b = np.concatenate([b, (b + f) % (2 * f)])
    links = scipy.sparse.coo_array((np.ones(len(a), dtype=bool), (a, b)), shape=(2 * f, 2 * f))
    count, piece = scipy.sparse.csgraph.connected_components(links, directed=False)
    as_they_are = np.bincount(piece[:f], minlength=count)
    turn = (as_they_are[piece[f:]] > as_they_are[piece[:f]]) & (piece[:f] != piece[f:])
    # Either side of the piece will do
    tie = (as_they_are[piece[f:]] == as_they_are[piece[:f]]) & (piece[f:] < piece[:f])
    return np.where((turn | tie)[:, None], faces[:, ::-1], faces)


def split_where_sheets_touch(p: Points, faces: Faces) -> tuple[Float[np.ndarray, "u 3"], Faces]:
    """Return the mesh with a vertex for each fan of faces that meet in one; new ones come last."""
    fan_vertex, fan = corner_fans(faces)
    # The first fan of each vertex keeps it, the others get new ones.
    order = np.argsort(fan_vertex, kind="stable")
    more = order[1:][np.diff(fan_vertex[order]) == 0]
    name = fan_vertex.copy()
    name[more] = len(p) + np.arange(len(more))
    return np.concatenate([p, p[fan_vertex[more]]]), name[fan].reshape(3, -1).T
