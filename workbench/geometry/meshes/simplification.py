"""Meshes with fewer or more faces: vertices of one cell made one, edges halved.

Reference: Rossignac and Borrel, Multi-resolution 3D approximations for rendering complex scenes,
1993.
"""

import numpy as np
from jaxtyping import Float, Int

from workbench.geometry.meshes.repair import without_repeats
from workbench.geometry.meshes.triangles import edge_keys, half_edges, welded

Points = Float[np.ndarray, "v 3"]
Faces = Int[np.ndarray, "f 3"]


def clustered(
    p: Points, faces: Faces, spacing: float
) -> tuple[Float[np.ndarray, "u 3"], Int[np.ndarray, "g 3"]]:
    """Return a mesh with all vertices of one cell at their mean; it need not be a surface."""
    cell = np.floor((p - p.min(axis=0)) / spacing).astype(np.intp)
    _, name = np.unique(cell, axis=0, return_inverse=True)
    name = name.reshape(-1)
    count = np.bincount(name)
    means = np.stack([np.bincount(name, p[:, k]) / count for k in range(3)], axis=1)
    placed, faces = welded(means[name], faces)
    return placed, without_repeats(faces)


def halved(p: Points, faces: Faces) -> tuple[Float[np.ndarray, "u 3"], Int[np.ndarray, "g 3"]]:
    """Return a mesh in which every edge has a vertex in its middle, and every face became four."""
    half = half_edges(faces)
    _, first, name = np.unique(edge_keys(half), return_index=True, return_inverse=True)
    middle = len(p) + name.reshape(3, -1)  # of the edges opposite corners a, b, c
    a, b, c = faces.T
    bc, ca, ab = middle
    four = [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
    cut = np.concatenate([np.stack(corners, axis=1) for corners in four])
    return np.concatenate([p, p[half[first]].mean(axis=1)]), cut
