"""What a mesh is kept smooth by while it is fitted: energies of its vertices with their gradients.

References: Wang et al., Pixel2Mesh, ECCV 2018, section 3.4 (Laplacian, edges, normals). Nealen et
al., Laplacian mesh optimization, 2006, section 2 (the uniform Laplacian).
"""

import numpy as np
import scipy
from jaxtyping import Float, Int

from workbench.geometry.meshes.triangles import adjacency, half_edges, twins

Points = Float[np.ndarray, "v 3"]
Energy = tuple[float, Points]
_NO_AREA = 1e-12  # m², of twice a face


def umbrella(faces: Int[np.ndarray, "f 3"], count: int) -> "scipy.sparse.csr_array":
    """Return the uniform Laplacian (v, v): the mean of a vertex' neighbours minus itself."""
    beside = adjacency(faces, count).astype(float)
    degree = np.maximum(beside.sum(axis=1), 1)
    return scipy.sparse.csr_array(
        scipy.sparse.diags_array(1 / degree) @ beside - scipy.sparse.eye_array(count)
    )


def laplacian_energy(p: Points, L: "scipy.sparse.csr_array") -> Energy:
    """Return the mean squared length of L p, m², and its gradient."""
    v = L @ p
    return float((v * v).sum() / len(p)), 2 / len(p) * (L.T @ v)


def edge_energy(p: Points, edges: Int[np.ndarray, "e 2"]) -> Energy:
    """Return the mean squared length of the edges, m², and its gradient."""
    v = p[edges[:, 0]] - p[edges[:, 1]]
    slope = 2 / len(edges) * v
    return float((v * v).sum() / len(edges)), scattered(
        np.concatenate([slope, -slope]), edges.T.ravel(), len(p)
    )


def normal_energy(
    p: Points, faces: Int[np.ndarray, "f 3"], pairs: Int[np.ndarray, "e 2"]
) -> Energy:
    """Return the mean of 1 - n · m over pairs of faces with normals n and m, and its gradient."""
    a, b, c = (p[faces[:, k]] for k in range(3))
    N = np.cross(b - a, c - a)
    length = np.maximum(np.linalg.norm(N, axis=1, keepdims=True), _NO_AREA)
    n = N / length
    n_first, n_second = n[pairs[:, 0]], n[pairs[:, 1]]
    by_n = scattered(np.concatenate([n_second, n_first]) / -len(pairs), pairs.T.ravel(), len(faces))
    by_N = np.where(length > _NO_AREA, by_n - n * (n * by_n).sum(axis=1, keepdims=True), 0) / length
    by_b = np.cross(c - a, by_N)
    by_c = np.cross(by_N, b - a)
    slope = scattered(np.concatenate([-by_b - by_c, by_b, by_c]), faces.T.ravel(), len(p))
    return float((1 - (n_first * n_second).sum(axis=1)).mean()), slope


def face_pairs(faces: Int[np.ndarray, "f 3"]) -> Int[np.ndarray, "e 2"]:
    """Return for every edge with two faces which they are."""
    return np.stack(twins(half_edges(faces)), axis=1) % len(faces)


def fold_angles(
    p: Points, faces: Int[np.ndarray, "f 3"], pairs: Int[np.ndarray, "e 2"]
) -> Float[np.ndarray, " e"]:
    """Return by how much each edge between two faces, turned alike, is folded: 0 flat, pi shut."""
    a, b, c = (p[faces[:, k]] for k in range(3))
    N = np.cross(b - a, c - a)
    N_first, N_second = N[pairs[:, 0]], N[pairs[:, 1]]
    return np.arctan2(
        np.linalg.norm(np.cross(N_first, N_second), axis=1), (N_first * N_second).sum(axis=1)
    )


def scattered(
    values: Float[np.ndarray, "k 3"], rows: Int[np.ndarray, " k"], count: int
) -> Float[np.ndarray, "{count} 3"]:
    """Return the sum of the values that belong to each row."""
    return np.stack(
        [np.bincount(rows, values[:, axis], minlength=count) for axis in range(3)], axis=1
    )
