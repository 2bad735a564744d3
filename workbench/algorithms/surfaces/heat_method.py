"""Geodesic distance by heat: let it flow, keep its direction, find the function that rises so.

A mesh is given by its `measured` corners: as they stand in space (`corners`), or each triangle laid
out for itself (`intrinsic_delaunay`). The time is in m^2; the paper takes the squared mean length
of the edges.

Reference: Crane, Weischedel and Wardetzky, Geodesics in heat: a new approach to computing distance
based on heat flow, ACM Transactions on Graphics 32, 2013, sections 2 and 3.
"""

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from typing import Literal

import numpy as np
import scipy
from jaxtyping import Float, Int

from workbench.geometry.meshes import Corners, edges
from workbench.geometry.meshes.laplacian import cotangent_laplacian_of, mixed_areas_of
from workbench.tracing import traced

Points = Float[np.ndarray, "v 3"]
Faces = Int[np.ndarray, "f 3"]
# of the Laplacian's diagonal, so that it can be factored: constants cost next to nothing
SHIFT = 1e-10


def mean_edge_length(p: Points, faces: Faces) -> float:
    """Return the mean length of the edges, m.

    >>> p = np.array([[0.0, 0, 0], [3, 0, 0], [0, 4, 0]])
    >>> mean_edge_length(p, np.array([[0, 1, 2]]))
    4.0
    """
    a, b = edges(faces).T
    return float(np.linalg.norm(p[a] - p[b], axis=1).mean())


class HeatMethod:
    """A mesh made ready for distances by heat: its two matrices, factored once for any source.

    Heat does not leave over a border.
    """

    def __init__(self, measured: Corners, time: float) -> None:
        self.measured, self.time = measured, time
        areas = mixed_areas_of(measured)
        L = cotangent_laplacian_of(measured)
        shift = SHIFT * float(L.diagonal().mean())
        self._flow = _factored(time * L + scipy.sparse.diags_array(areas))  # (3): A + t L
        self._rise = _factored(L + shift * scipy.sparse.eye_array(measured.count))

    def heat(self, sources: Int[np.ndarray, " s"]) -> Float[np.ndarray, "v s"]:
        """Return every vertex's heat, a column per source, one implicit step after a unit there."""
        unit = np.zeros((self.measured.count, len(sources)))
        unit[sources, np.arange(len(sources))] = 1.0
        return self._flow.solve(unit)

    def directions(self, heat: Float[np.ndarray, " v"]) -> Float[np.ndarray, "f 3"]:
        """Return on every face the unit vector X along which heat falls; zero where it does not."""
        return directions_of(self.measured, heat)

    def distances(
        self, directions: Float[np.ndarray, "f 3"], source: int
    ) -> Float[np.ndarray, " v"]:
        """Return the function that rises along X, 0 at the source, m: L phi = -div X (3.2)."""
        phi = self._rise.solve(-_divergence(self.measured, directions))
        return phi - phi[source]

    def between(self, sources: Int[np.ndarray, " s"]) -> Float[np.ndarray, "s s"]:
        """Return the distances from each source (row) to each source (column)."""
        columns = self.heat(sources).T
        rows = [
            self.distances(self.directions(u), int(s))
            for u, s in zip(columns, sources, strict=True)
        ]
        return np.stack(rows)[:, sources]


@dataclass(frozen=True, eq=False, kw_only=True)
class HeatState:
    """What is known after a phase; what comes later is empty.

    Attributes:
        u: The heat of every vertex.
        X: On every face the unit vector along which it falls.
        d: The distance of every vertex, m.
    """

    phase: Literal["flow", "directions", "distances"]
    u: Float[np.ndarray, " v"]
    X: Float[np.ndarray, "f 3"] = field(default_factory=lambda: np.empty((0, 3)))
    d: Float[np.ndarray, " _"] = field(default_factory=lambda: np.empty(0))


@traced
def heat_method(measured: Corners, source: int, time: float) -> Iterator[HeatState]:
    """Yield heat that has flowed for a time, its directions, and the distances by them."""
    method = HeatMethod(measured, time)
    u = method.heat(np.array([source]))[:, 0]  # (A + t L) u = 1 at the source
    yield (state := HeatState(phase="flow", u=u))
    X = method.directions(u)  # X = -grad u / |grad u|
    yield (state := replace(state, phase="directions", X=X))
    d = method.distances(X, source)  # L phi = -div X
    yield replace(state, phase="distances", d=d)


def _factored(matrix: "scipy.sparse.csr_array") -> "scipy.sparse.linalg.SuperLU":
    # A symmetric matrix with a symmetric order and no pivoting: several times faster than the
    # defaults.
    return scipy.sparse.linalg.splu(
        matrix.tocsc(),
        permc_spec="MMD_AT_PLUS_A",
        diag_pivot_thresh=0.0,
        options={"SymmetricMode": True},
    )


def directions_of(measured: Corners, u: Float[np.ndarray, " v"]) -> Float[np.ndarray, "f 3"]:
    """Return -grad u / |grad u|, u linear on each face: grad u = sum_k u_k (N x e_k) / 2 A."""
    e = measured.edges
    N = measured.normals
    at = u[measured.vertices]
    level = np.abs(at).max(axis=0)
    # far away heat is all but 0, its direction is not
    at = np.divide(at, level, out=np.zeros_like(at), where=level > 0)
    v = np.einsum("kf,xkf->xf", at, e)
    X = -np.stack([N[1] * v[2] - N[2] * v[1], N[2] * v[0] - N[0] * v[2], N[0] * v[1] - N[1] * v[0]])
    size = np.sqrt(np.einsum("xf,xf->f", X, X))
    return np.divide(X, size, out=np.zeros_like(X), where=size > 0).T


def _divergence(measured: Corners, X: np.ndarray) -> np.ndarray:
    """Return the divergence about each vertex: 1/2 sum of cot a (e_1 . X) + cot b (e_2 . X)."""
    # edge k goes from corner k + 1 to corner k + 2
    along = np.einsum("xkf,fx->kf", measured.edges, X)
    weighted = measured.cotangents * along / 2
    return measured.sums(weighted[[2, 0, 1]] - weighted[[1, 2, 0]])
