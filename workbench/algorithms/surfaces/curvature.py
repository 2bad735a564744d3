"""Curvature of a mesh, one quantity after the other, at one vertex and at all of them.

Reference: Meyer, Desbrun, Schroeder and Barr, Discrete differential-geometry operators for
triangulated 2-manifolds, Visualization and Mathematics III, 2003. Equation numbers below are
theirs.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace
from typing import Literal

import numpy as np
from jaxtyping import Float, Int

from workbench.geometry.meshes import curvature, euler_characteristic, one_ring, vertex_normals
from workbench.geometry.meshes.curvature import (
    mean_from_normals,
    principal_curvatures,
    principal_directions,
)
from workbench.geometry.meshes.laplacian import mixed_areas
from workbench.geometry.meshes.quadric_fit import Quadrics, fit_quadrics
from workbench.tracing import traced

Points = Float[np.ndarray, "v 3"]
Faces = Int[np.ndarray, "f 3"]

Defects = Callable[[np.ndarray, np.ndarray], np.ndarray]
"""angle_defects(p, faces) -> (v,), radians."""
Gaussian = Callable[[np.ndarray, np.ndarray], np.ndarray]
"""gaussian_curvature(p, faces) -> (v,), 1/m^2."""
MeanNormals = Callable[[np.ndarray, np.ndarray], np.ndarray]
"""mean_curvature_normals(p, faces) -> (v, 3): 2 H n, 1/m."""

# What a later stage measures is empty until then.
PerVertex = Float[np.ndarray, " _"]
Vectors = Float[np.ndarray, "_ 3"]
Indices = Int[np.ndarray, " _"]

Stage = Literal[
    "mesh", "ring", "defect", "gaussian", "normal", "mean", "principal", "quadric", "total"
]


def _nothing() -> PerVertex:
    return np.empty(0)


def _no_vectors() -> Vectors:
    return np.empty((0, 3))


def _no_indices() -> Indices:
    return np.empty(0, dtype=int)


@dataclass(frozen=True, eq=False)
class Measured:
    """What is known after a stage; what comes later is empty. Lengths in metres, angles in radians.

    Attributes:
        ring_faces, ring: The faces around the vertex and its neighbours, counterclockwise.
        angles: The angle at the vertex in each of these faces.
        defects: 2 pi, or pi on the border, less the angles around each vertex.
        areas: The mixed area of each vertex, m^2.
        K: Gaussian curvature, 1/m^2.
        normals_2H: The mean-curvature normal 2 H n, 1/m.
        H: Mean curvature, 1/m.
        k1, k2: Principal curvatures, 1/m.
        along_k1, along_k2: Their directions, unit tangents.
        quadrics: A quadric fitted around each vertex, the other way to measure.
        total: The sum of all defects.
        chi: V - E + F.
    """

    stage: Stage
    p: Points
    faces: Faces
    normals: Points
    vertex: int
    ring_faces: Indices = field(default_factory=_no_indices)
    ring: Indices = field(default_factory=_no_indices)
    angles: PerVertex = field(default_factory=_nothing)
    defects: PerVertex = field(default_factory=_nothing)
    areas: PerVertex = field(default_factory=_nothing)
    K: PerVertex = field(default_factory=_nothing)
    normals_2H: Vectors = field(default_factory=_no_vectors)
    H: PerVertex = field(default_factory=_nothing)
    k1: PerVertex = field(default_factory=_nothing)
    k2: PerVertex = field(default_factory=_nothing)
    along_k1: Vectors = field(default_factory=_no_vectors)
    along_k2: Vectors = field(default_factory=_no_vectors)
    quadrics: Quadrics | None = None
    total: float = float("nan")
    chi: int = 0


@traced
def measure_curvature(
    p: Points,
    faces: Faces,
    vertex: int,
    *,
    angle_defects: Defects = curvature.angle_defects,
    gaussian_curvature: Gaussian = curvature.gaussian_curvature,
    mean_curvature_normals: MeanNormals = curvature.mean_curvature_normals,
) -> Iterator[Measured]:
    """Yield what is known about a mesh's curvature, one quantity more at a time.

    The mesh is one that `check_mesh` accepts, metres, counterclockwise seen from outside; the ring
    of `vertex` is looked at closely.
    """
    normals = vertex_normals(p, faces)
    state = Measured("mesh", p, faces, normals, vertex)
    yield state

    ring_faces, ring = one_ring(faces, vertex)
    angles = angles_at(p, vertex, ring)
    yield (
        state := replace(
            state, stage="ring", ring_faces=ring_faces, ring=ring, angles=angles[: len(ring_faces)]
        )
    )

    defects = angle_defects(p, faces)  # (9), numerator: 2 pi - sum of angles; pi on the border
    yield (state := replace(state, stage="defect", defects=defects))

    areas = mixed_areas(p, faces)  # figure 4
    K = gaussian_curvature(p, faces)  # (9): defect / area
    yield (state := replace(state, stage="gaussian", areas=areas, K=K))

    # (8): sum of (cot a + cot b) (p_i - p_j) / 2 area
    normals_2H = mean_curvature_normals(p, faces)
    yield (state := replace(state, stage="normal", normals_2H=normals_2H))

    # half its length, with the sign of the side it points to
    H = mean_from_normals(normals_2H, normals)
    yield (state := replace(state, stage="mean", H=H))

    k1, k2 = principal_curvatures(K, H)  # section 5.1: H +- sqrt(H^2 - K)
    along_k1, along_k2 = principal_directions(p, faces, normals)  # section 5.3
    yield (
        state := replace(
            state, stage="principal", k1=k1, k2=k2, along_k1=along_k1, along_k2=along_k2
        )
    )

    quadrics = fit_quadrics(p, faces)  # another way: a smooth patch through two rings
    yield (state := replace(state, stage="quadric", quadrics=quadrics))

    total = float(defects.sum())  # Gauss-Bonnet: 2 pi chi, whatever the mesh
    chi = euler_characteristic(faces)
    yield replace(state, stage="total", total=total, chi=chi)


def angles_at(p: Points, vertex: int, ring: Int[np.ndarray, " n"]) -> Float[np.ndarray, " n"]:
    """Return the angles in [0, pi] at a vertex between each neighbour of its ring and the next.

    The last is between the last neighbour and the first.
    """
    a = p[ring] - p[vertex]
    b = np.roll(a, -1, axis=0)
    return np.arctan2(np.linalg.norm(np.cross(a, b), axis=1), np.einsum("nx,nx->n", a, b))
