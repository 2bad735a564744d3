"""Curvature of a triangle mesh by angle defects and cotangents.

Signs: normals point outward; H and the principal curvatures are positive where the surface bends
away from its normal, so that a sphere of radius r has k1 = k2 = H = 1/r. Turning all normals round
changes the sign of H, k1 and k2, never that of K = k1 k2. On the border of an open mesh K and H are
not defined by these formulas and are nan. H, k1 and k2 are in 1/m, K in 1/m^2.
Reference: Meyer, Desbrun, Schroeder and Barr, Discrete differential-geometry operators for
triangulated 2-manifolds, Visualization and Mathematics III, 2003.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float, Int

from workbench.geometry.meshes.laplacian import mixed_areas_of
from workbench.geometry.meshes.triangles import (
    Corners,
    corners,
    edges,
    euler_characteristic,
    normals_at_vertices,
    on_boundary,
)

Points = Float[np.ndarray, "v 3"]
Faces = Int[np.ndarray, "f 3"]
PerVertex = Float[np.ndarray, " v"]


@dataclass(frozen=True, eq=False)
class Curvatures:
    """The mixed Voronoi area at each vertex, m^2, its angle defect, normal and curvatures."""

    areas: PerVertex
    defects: PerVertex
    normals: Points
    border: Bool[np.ndarray, " v"]
    gaussian: PerVertex
    mean: PerVertex
    k1: PerVertex
    k2: PerVertex


def curvatures(p: Points, faces: Faces) -> Curvatures:
    """Return K, H and the principal curvatures at every vertex, in one pass over the corners."""
    measured = corners(p, faces)
    border = on_boundary(faces, len(p))
    areas, normals = mixed_areas_of(measured), normals_at_vertices(measured)
    defects = _angle_defects(measured, border)
    gaussian = _per_area(defects, areas, border)
    mean = mean_from_normals(_mean_curvature_normals(measured, areas, border), normals)
    return Curvatures(
        areas, defects, normals, border, gaussian, mean, *principal_curvatures(gaussian, mean)
    )


def angle_defects(p: Points, faces: Faces) -> PerVertex:
    """Return how much the angles around each vertex miss 2 pi, or pi on the border, radians.

    This is the integral of K over the vertex' area, or the turning of the border curve. All of them
    add up to 2 pi chi (Gauss-Bonnet; Meyer et al. 2003, equation 9).

    Examples:
        >>> p = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
        >>> faces = np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
        >>> (angle_defects(p, faces) / np.pi).round(3).tolist()  # 4 pi in all
        [0.5, 1.167, 1.167, 1.167]
    """
    return _angle_defects(corners(p, faces), on_boundary(faces, len(p)))


def gaussian_curvature(p: Points, faces: Faces) -> PerVertex:
    """Return K = angle defect / mixed area; nan on the border (Meyer et al. 2003, equation 9)."""
    measured = corners(p, faces)
    border = on_boundary(faces, len(p))
    return _per_area(_angle_defects(measured, border), mixed_areas_of(measured), border)


def mean_curvature_normals(p: Points, faces: Faces) -> Points:
    """Return 2 H n: sum_j (cot a_ij + cot b_ij) (p_i - p_j) / (2 A_i) (Meyer et al., eq. 8)."""
    measured = corners(p, faces)
    return _mean_curvature_normals(measured, mixed_areas_of(measured), on_boundary(faces, len(p)))


def mean_curvature(p: Points, faces: Faces) -> PerVertex:
    """Return H: half the mean-curvature normal's length along the outward normal."""
    return curvatures(p, faces).mean


def mean_from_normals(mean_normals: Points, normals: Points) -> PerVertex:
    """Return H from 2 H n and outward unit normals, without what is not along n."""
    return np.einsum("vx,vx->v", mean_normals, normals) / 2


def principal_curvatures(gaussian: PerVertex, mean: PerVertex) -> tuple[PerVertex, PerVertex]:
    """Return k1 >= k2 = H +- sqrt(H^2 - K); a negative H^2 - K counts as 0 (Meyer et al., 5.1)."""
    spread = np.sqrt(np.maximum(mean**2 - gaussian, 0))
    return mean + spread, mean - spread


def principal_directions(p: Points, faces: Faces, normals: Points) -> tuple[Points, Points]:
    """Return unit tangents along k1 and k2, of the tensor B that fits the edges' curvatures best.

    An edge along d has kappa = 2 (p_i - p_j) . n / |p_i - p_j|^2, and B minimises sum_j (d_j^T B
    d_j - kappa_j)^2 (Meyer et al., 5.3, equal weights). Signs mean nothing.
    """
    a, b = edges(faces).T
    i, j = np.concatenate([a, b]), np.concatenate([b, a])
    step = p[i] - p[j]
    right, up = tangents(normals)
    x, y = np.einsum("ex,ex->e", step, right[i]), np.einsum("ex,ex->e", step, up[i])
    flat = np.maximum(x**2 + y**2, np.finfo(float).tiny)
    kappa = 2 * np.einsum("ex,ex->e", step, normals[i]) / np.einsum("ex,ex->e", step, step)
    # d^T B d = (B11 + B22) / 2 + (B11 - B22) / 2 cos 2t + B12 sin 2t, t being the direction's
    # angle.
    terms = np.stack([np.ones(len(i)), (x**2 - y**2) / flat, 2 * x * y / flat])
    left = np.zeros((len(p), 3, 3))
    for a in range(3):
        for b in range(a, 3):
            left[:, a, b] = left[:, b, a] = np.bincount(i, terms[a] * terms[b], len(p))
    # Two edges, or edges along two lines, leave B open; a touch on the diagonal then takes the
    # smallest one.
    left[:, range(3), range(3)] += 1e-9 * np.maximum(left[:, 0, :1], 1.0)
    sums = np.stack([np.bincount(i, term * kappa, len(p)) for term in terms], axis=1)
    _, cosine, sine = np.linalg.solve(left, sums[:, :, None])[:, :, 0].T
    return along(np.arctan2(sine, cosine) / 2, right, up)


def tangents(normals: Points) -> tuple[Points, Points]:
    """Return two unit vectors per normal which with it form a right-handed frame."""
    # Duff et al., Building an orthonormal basis, revisited, JCGT 6(1), 2017, listing 3.
    x, y, z = normals.T
    sign = np.copysign(1.0, z)
    a = -1 / (sign + z)
    b = x * y * a
    return np.stack([1 + sign * x * x * a, sign * b, -sign * x], 1), np.stack(
        [b, sign + y * y * a, -y], 1
    )


def along(angles: PerVertex, right: Points, up: Points) -> tuple[Points, Points]:
    """Return the tangents at these angles from `right` towards `up`, and a quarter turn further."""
    c, s = np.cos(angles)[:, None], np.sin(angles)[:, None]
    return c * right + s * up, c * up - s * right


def gauss_bonnet(p: Points, faces: Faces) -> tuple[float, float]:
    """Return the sum of all angle defects, and 2 pi chi, which it must equal: both in radians.

    Examples:
        >>> p = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])  # a tetrahedron
        >>> total, expected = gauss_bonnet(
        ...     p, np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
        ... )
        >>> round(total / np.pi, 6), round(expected / np.pi, 6)
        (4.0, 4.0)
    """
    return float(angle_defects(p, faces).sum()), 2 * np.pi * euler_characteristic(faces)


def _angle_defects(measured: Corners, border: Bool[np.ndarray, " v"]) -> PerVertex:
    return np.where(border, np.pi, 2 * np.pi) - measured.sums(measured.angles)


def _mean_curvature_normals(
    measured: Corners, areas: PerVertex, border: Bool[np.ndarray, " v"]
) -> Points:
    # Every edge pushes its two ends apart by its cotangent: at each corner the edge that ends
    # there, less the one that leaves.
    total = np.empty((3, len(areas)))
    cotangents = measured.cotangents
    for x in range(3):
        push = measured.edges[x] * cotangents
        total[x] = measured.sums(push[[1, 2, 0]] - push[[2, 0, 1]])
    return _per_area(total, 2 * areas, border).T


def _per_area(
    totals: Float[np.ndarray, "*k v"], areas: PerVertex, border: Bool[np.ndarray, " v"]
) -> Float[np.ndarray, "*k v"]:
    return np.divide(totals, areas, out=np.full(totals.shape, np.nan), where=~border & (areas > 0))
