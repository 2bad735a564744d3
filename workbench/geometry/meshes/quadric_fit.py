"""Curvature of a triangle mesh by a quadric fitted to the neighbourhood of each vertex.

Angle defects and cotangents read the curvature off the shape of a few triangles, and on an
irregular mesh their error stays however fine it gets. A smooth function fitted to a neighbourhood
depends on the vertices alone: its error falls with their size.
"""

from dataclasses import dataclass

import numpy as np
import scipy
from jaxtyping import Float, Int

from workbench.geometry.meshes.curvature import along, principal_curvatures, tangents
from workbench.geometry.meshes.triangles import adjacency, vertex_normals

Points = Float[np.ndarray, "v 3"]
Faces = Int[np.ndarray, "f 3"]
PerVertex = Float[np.ndarray, " v"]

# Vertices fitted at once, so that their neighbourhoods stay in the processor's cache.
BLOCK = 1024
UNKNOWNS = 6


@dataclass(frozen=True, eq=False)
class Quadrics:
    """The height c0 + c1 x + c2 y + c3 x^2 + c4 xy + c5 y^2 over each vertex' tangent plane, m.

    x, y and height run along `right`, `up` and `normals` from the vertex. Coefficients are nan
    where nothing could be fitted; `neighbours` counts the vertices of each fit, its own included.
    """

    coefficients: Float[np.ndarray, "v 6"]
    right: Points
    up: Points
    normals: Points
    neighbours: Int[np.ndarray, " v"]

    def curvatures(self) -> tuple[PerVertex, PerVertex]:
        """Return K in 1/m^2 and H in 1/m (do Carmo, Curves and Surfaces, 3.3, example 5)."""
        _, fx, fy, a, fxy, b = self.coefficients.T
        fxx = 2 * a
        fyy = 2 * b
        w2 = 1 + fx**2 + fy**2
        gaussian = (fxx * fyy - fxy**2) / w2**2
        mean = -((1 + fy**2) * fxx - 2 * fx * fy * fxy + (1 + fx**2) * fyy) / (2 * w2**1.5)
        return gaussian, mean

    def principal_curvatures(self) -> tuple[PerVertex, PerVertex]:
        """Return k1 >= k2, 1/m."""
        return principal_curvatures(*self.curvatures())

    def principal_directions(self) -> tuple[Points, Points]:
        """Return unit tangents along k1 and k2, in the almost level plane of the frame."""
        _, _, _, a, fxy, b = self.coefficients.T
        # The height bends least downwards, thus away from the normal most, where its second
        # derivative is least.
        return along(np.arctan2(-fxy, b - a) / 2, self.right, self.up)


def fit_quadrics(p: Points, faces: Faces, rings: int = 2) -> Quadrics:
    """Return a quadric at every vertex, by least squares over vertices up to `rings` edges away.

    A neighbour at distance r counts exp(-(r / r_rms)^2), r_rms being the root mean square of all of
    them. More rings forgive more noise and blur more; 2 give about 18 neighbours. With fewer than
    six vertices in reach, or all of them on a conic, the row is nan.
    Reference: Cazals and Pouget, Estimating differential quantities using polynomial fitting of
    osculating jets, 2005, theorem 3 (degree 2: K and H converge with the distance).

    Raises:
        ValueError: If `rings` is below 1.
    """
    if rings < 1:
        raise ValueError(f"a fit needs at least the first ring, not {rings}")
    normals = vertex_normals(p, faces)
    right, up = tangents(normals)
    first, neighbour = _neighbourhoods(faces, len(p), rings)
    coefficients = np.empty((len(p), UNKNOWNS))
    for start in range(0, len(p), BLOCK):
        block = slice(start, min(start + BLOCK, len(p)))
        frames = np.stack([right[block], up[block], normals[block]])
        pairs = slice(first[block.start], first[block.stop])
        offsets = first[block.start : block.stop + 1] - first[block.start]
        coefficients[block] = _fit(p[block], p[neighbour[pairs]], frames, offsets=offsets)
    return Quadrics(coefficients, right, up, normals, np.diff(first))


def _fit(
    p: Points,
    p_neighbours: Float[np.ndarray, "e 3"],
    frames: Float[np.ndarray, "3 v 3"],
    *,
    offsets: Int[np.ndarray, " w"],
) -> Float[np.ndarray, "v 6"]:
    """Solve the normal equations of vertices whose neighbours stand one after the other."""
    times = np.diff(offsets)
    starts = offsets[:-1]
    step = p_neighbours - np.repeat(p, times, axis=0)
    x, y, height = (np.einsum("ek,ek->e", step, np.repeat(axis, times, axis=0)) for axis in frames)
    # Lengths in units of the neighbourhood's radius keep the six columns equally large.
    radius = np.sqrt(np.add.reduceat(x**2 + y**2, starts) / times)
    radius[radius == 0] = 1.0
    x, y, height = (v / np.repeat(radius, times) for v in (x, y, height))
    columns = np.stack([np.ones(len(x)), x, y, x * x, x * y, y * y])
    weighted = columns * np.exp(-(x * x + y * y))
    left = np.empty((UNKNOWNS, UNKNOWNS, len(p)))
    right = np.empty((UNKNOWNS, len(p)))
    for a in range(UNKNOWNS):
        right[a] = np.add.reduceat(weighted[a] * height, starts)
        for b in range(a + 1):
            left[a, b] = np.add.reduceat(weighted[a] * columns[b], starts)
    powers = radius ** np.array([1, 0, 0, -1, -1, -1])[:, None]
    return (_solve(left, right) * powers).T


def _solve(
    left: Float[np.ndarray, "k k v"], right: Float[np.ndarray, "k v"]
) -> Float[np.ndarray, "k v"]:
    """Solve v symmetric positive definite systems at once by Cholesky; nan where singular."""
    k = len(left)
    factor, unknown = np.zeros_like(left), np.array(right)
    for j in range(k):
        pivot = left[j, j] - (factor[j, :j] ** 2).sum(axis=0)
        factor[j, j] = np.sqrt(np.where(pivot > 1e-9 * left[j, j], pivot, np.nan))
        for i in range(j + 1, k):
            factor[i, j] = (left[i, j] - (factor[i, :j] * factor[j, :j]).sum(axis=0)) / factor[j, j]
    for i in range(k):
        unknown[i] = (unknown[i] - (factor[i, :i] * unknown[:i]).sum(axis=0)) / factor[i, i]
    for i in reversed(range(k)):
        unknown[i] = (unknown[i] - (factor[i + 1 :, i] * unknown[i + 1 :]).sum(axis=0)) / factor[
            i, i
        ]
    return unknown


def _neighbourhoods(
    faces: Faces, count: int, rings: int
) -> tuple[Int[np.ndarray, " w"], Int[np.ndarray, " e"]]:
    """Return where each vertex' list of vertices within `rings` edges starts, and the lists."""
    reach = ring = (adjacency(faces, count) + scipy.sparse.eye_array(count)).tocsr()
    for _ in range(rings - 1):
        reach = reach @ ring
    return reach.indptr, reach.indices
