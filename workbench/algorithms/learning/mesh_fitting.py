"""Moves a mesh's vertices until points on it lie where given points lie, held by smoothness terms.

Reference: Wang et al., Pixel2Mesh, ECCV 2018, section 3.4. Ravi et al., Accelerating 3D deep
learning with PyTorch3D, 2020, tutorial "Deform a source mesh to form a target mesh".
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from jaxtyping import Float, Int
from scipy.spatial.distance import directed_hausdorff

from workbench.algorithms.learning.perceptron import descend
from workbench.algorithms.learning.set_regression import ChamferGradient
from workbench.geometry.meshes import edges as edges_of
from workbench.geometry.meshes.mesh_energies import (
    edge_energy,
    face_pairs,
    fold_angles,
    laplacian_energy,
    normal_energy,
    scattered,
    umbrella,
)
from workbench.geometry.points.sampling import places_on_faces, points_on_faces
from workbench.geometry.points.shape_distances import chamfer, chamfer_gradient, nearest_both_ways
from workbench.tracing import traced

Term = Literal["laplacian", "normal", "edge"]

SAMPLES = 800
MEASURED = 3000
RATE = 0.03
FINE = 20_000
"""Points on the mesh for the distance of what is farthest from it: far fewer miss thin parts."""


@dataclass(frozen=True, eq=False, kw_only=True)
class MeshFitted:
    """A mesh after some updates.

    Attributes:
        loss: Chamfer distance to the given points, m², the mean since the last state.
        to_given: Chamfer distance of many points on it to the given points, m².
        to_truth: The same to points on the true surface; NaN where none are known.
        farthest: How far the true surface is from the mesh at most, m; NaN where it is not known.
        folded: The share of its edges that are folded by more than a right angle.
    """

    updates: int
    loss: float
    p: Float[np.ndarray, "v 3"]
    to_given: float
    to_truth: float
    farthest: float
    folded: float


@traced
def fit_mesh(
    p: Float[np.ndarray, "v 3"],
    faces: Int[np.ndarray, "f 3"],
    given: Float[np.ndarray, "n 3"],
    *,
    truth: Float[np.ndarray, "m 3"],
    weights: Mapping[Term, float],
    counts: Sequence[int],
    rng: np.random.Generator,
    chamfer_gradient: ChamferGradient = chamfer_gradient,
) -> Iterator[MeshFitted]:
    """Yield a mesh as it descends the Chamfer distance to given points, plus energies.

    Args:
        truth: Points on the true surface, only looked at; empty where it is not known.
        weights: Of the energies.
        counts: After how many updates a state is yielded.
    """
    count = len(p)
    p = p.copy()
    L = umbrella(faces, count)
    edges = edges_of(faces)
    pairs = face_pairs(faces)
    # the same at every state, so that curves do not tremble
    u = np.random.default_rng(0).random((3, MEASURED)).T

    def gradient() -> tuple[float, np.ndarray]:
        k, shares = places_on_faces(p, faces, rng.random((3, SAMPLES)).T)
        corners = faces[k]
        q = np.einsum("nk,nkx->nx", shares, p[corners])
        by_q = np.asarray(chamfer_gradient(q, given), float)
        slope = scattered(
            (shares[:, :, None] * by_q[:, None]).reshape(-1, 3), corners.ravel(), count
        )
        if weights["laplacian"]:
            slope += weights["laplacian"] * laplacian_energy(p, L)[1]
        if weights["normal"]:
            slope += weights["normal"] * normal_energy(p, faces, pairs)[1]
        if weights["edge"]:
            slope += weights["edge"] * edge_energy(p, edges)[1]
        return chamfer(q, given), slope

    fine = np.random.default_rng(0).random((FINE, 3))
    for updates, loss in descend(p, gradient, counts, rate=RATE):
        q = points_on_faces(p, faces, u)
        off = nearest_both_ways(q, truth) if len(truth) else None
        yield MeshFitted(
            updates=updates,
            loss=loss,
            p=p.copy(),
            to_given=chamfer(q, given),
            to_truth=off.chamfer() if off else float("nan"),
            farthest=float(directed_hausdorff(truth, points_on_faces(p, faces, fine))[0])
            if off
            else float("nan"),
            folded=float((fold_angles(p, faces, pairs) > np.pi / 2).mean()),
        )
