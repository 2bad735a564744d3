"""The cotangent Laplacian of a triangle mesh and the area that belongs to each vertex."""

import numpy as np
import scipy
from jaxtyping import Float, Int

from workbench.geometry.graphs.spectra import Laplacian, smallest_eigenpairs
from workbench.geometry.meshes.triangles import Corners, corners

Points = Float[np.ndarray, "v 3"]
Faces = Int[np.ndarray, "f 3"]
ROUNDING = 1e-9  # of a weight; weights have no unit


def cotangent_laplacian(p: Points, faces: Faces) -> "scipy.sparse.csr_array":
    """Return L with (L u)_i = sum_j w_ij (u_i - u_j), w = (cot a + cot b) / 2, semidefinite.

    a and b are the two angles opposite edge ij; on the border there is one. L u is minus the
    integral of the Laplace-Beltrami of u over each vertex' area. A face without area counts for
    nothing.
    Reference: Pinkall and Polthier, Computing discrete minimal surfaces and their conjugates, 1993,
    4.
    """
    return cotangent_laplacian_of(corners(p, faces))


def cotangent_laplacian_of(measured: Corners) -> "scipy.sparse.csr_array":
    """Return the cotangent Laplacian of corners that were measured already."""
    n = measured.count
    a, b = measured.vertices[[1, 2, 0]].ravel(), measured.vertices[[2, 0, 1]].ravel()
    weights = measured.cotangents.ravel() / 2
    diagonal = np.bincount(a, weights, n) + np.bincount(b, weights, n)
    rows, columns = np.concatenate([a, b, np.arange(n)]), np.concatenate([b, a, np.arange(n)])
    values = np.concatenate([-weights, -weights, diagonal])
    return scipy.sparse.csr_array((values, (rows, columns)), shape=(n, n))


def negative_weights(measured: Corners) -> int:
    """Return how many edges have a negative weight, so that heat may fall below 0."""
    L = scipy.sparse.triu(cotangent_laplacian_of(measured), 1)
    return int(np.count_nonzero(L.data > ROUNDING))


def mixed_areas(p: Points, faces: Faces) -> Float[np.ndarray, " v"]:
    """Return the part of the surface that belongs to each vertex, m^2, of the whole area.

    A face is shared out along the bisectors of its edges (Voronoi); of an obtuse one half goes to
    the obtuse corner and a quarter to each of the others.
    Reference: Meyer et al., Discrete differential-geometry operators, 2003, figure 4.
    """
    return mixed_areas_of(corners(p, faces))


def mixed_areas_of(measured: Corners) -> Float[np.ndarray, " v"]:
    """Return the mixed areas of corners that were measured already."""
    # Meyer (7): the corner's part is (|edge j|^2 cot j + |edge k|^2 cot k) / 8, j and k being the
    # other two corners.
    parts = measured.squared_edges * measured.cotangents / 8
    shares = parts[[1, 2, 0]] + parts[[2, 0, 1]]
    corner, face = np.nonzero(measured.dots < 0)
    shares[:, face] = measured.double_areas[face] / 8
    shares[corner, face] = measured.double_areas[face] / 4
    return measured.sums(shares)


def mixed_cell(p: Points, faces: Faces, vertex: int) -> Float[np.ndarray, "f 4 3"]:
    """Return the mixed area of a vertex piece by piece: its part of each of the faces around."""
    pieces = []
    for face in faces:
        k = int(np.flatnonzero(face == vertex)[0])
        a, b, c = p[np.roll(face, -k)]
        pieces.append(np.stack([a, (a + b) / 2, _cell_corner(a, b, c), (a + c) / 2]))
    return np.array(pieces)


def _cell_corner(a: np.ndarray, b: np.ndarray, c: np.ndarray) -> np.ndarray:
    """Return the corner of a's area across from a: the circumcentre, or a point on an edge."""
    u, v = b - a, c - a
    if u @ v < 0:
        return (b + c) / 2
    if (a - b) @ (c - b) < 0 or (a - c) @ (b - c) < 0:
        return a + (u + v) / 4
    w = np.cross(u, v)
    return a + (np.cross(w, u) * (v @ v) + np.cross(v, w) * (u @ u)) / (2 * w @ w)


def vertex_pushes(
    here: Float[np.ndarray, "3"], ring: Float[np.ndarray, "k 3"], area: float
) -> Float[np.ndarray, "k 3"]:
    """Return what each neighbour in a ring adds to 2 H n of an inner vertex (Meyer et al., 8)."""
    weight = np.zeros(len(ring))
    for other in (np.roll(ring, 1, axis=0), np.roll(ring, -1, axis=0)):
        a, b = here - other, ring - other
        weight += np.einsum("nx,nx->n", a, b) / np.linalg.norm(np.cross(a, b), axis=1)
    return weight[:, None] * (here - ring) / (2 * area)


def eigenpairs(
    p: Points, faces: Faces, count: int
) -> tuple[Float[np.ndarray, " {count}"], Float[np.ndarray, "v {count}"]]:
    """Return the smallest eigenvalues, 1/m^2, and functions of L u = lambda M u, M the mixed areas.

    The functions are orthonormal over the surface, U^T M U = 1; those of equal eigenvalues may come
    in any rotation. On an open mesh the slope across the border is zero.

    Raises:
        ValueError: If `count` is not below the number of vertices.

    Examples:
        >>> p = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])  # a tetrahedron
        >>> values, _ = eigenpairs(p, np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]), 2)
        >>> bool(abs(values[0]) < 1e-9), bool(values[1] > 1)
        (True, True)
    """
    if not 0 < count < len(p):
        raise ValueError(f"asked for {count} eigenpairs of a mesh with {len(p)} vertices")
    areas = mixed_areas(p, faces)
    values, vectors = smallest_eigenpairs(
        Laplacian(cotangent_laplacian(p, faces), areas).symmetric(),
        count,
        shift=-1e-2 * 4 * np.pi / float(areas.sum()),
    )
    return values, vectors / np.sqrt(areas)[:, None]
