"""Eigenvalues and eigenvectors of Laplacians, whichever graph or mesh they belong to.

Reference: von Luxburg, A tutorial on spectral clustering, Statistics and Computing 17, 2007,
section 3.
"""

from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
import scipy
from jaxtyping import Float

DENSE = 300
"""Up to so many nodes all eigenvectors of a dense matrix cost less than a few of a sparse one."""
SHIFT = 1e-4
"""How far below 0 the matrix is inverted, as a share of its mean diagonal."""
ZERO = 1e-9
"""Up to this share of the largest entry of the diagonal an eigenvalue is 0."""
Sparse: TypeAlias = scipy.sparse.csr_array


@dataclass(frozen=True, eq=False)
class Laplacian:
    """An operator M^(-1) L on functions of the nodes, L being symmetric with L 1 = 0.

    `mass`, the diagonal of M, is 1 for the plain graph Laplacian, the degrees for the normalised
    (random walk) one (1 at a node without edges), the vertices' areas for the cotangent Laplacian.
    """

    matrix: Sparse
    mass: Float[np.ndarray, " n"]

    def __call__(self, u: np.ndarray) -> np.ndarray:
        """Return M^(-1) L u: by how much each node is above its neighbours."""
        return (self.matrix @ u) / (self.mass if u.ndim == 1 else self.mass[:, None])

    def symmetric(self) -> Sparse:
        """Return M^(-1/2) L M^(-1/2), which is symmetric and has the same eigenvalues."""
        scale = scipy.sparse.diags_array(1 / np.sqrt(self.mass))
        return (scale @ self.matrix @ scale).tocsr()

    def largest(self) -> float:
        """Return the largest eigenvalue: explicit steps of heat must be shorter than 2 over it."""
        matrix = self.symmetric()
        if matrix.shape[0] <= DENSE:
            return float(np.linalg.eigvalsh(matrix.toarray())[-1])
        largest = scipy.sparse.linalg.eigsh(
            matrix, 1, which="LA", v0=_start(matrix.shape[0]), return_eigenvectors=False, tol=1e-6
        )
        return float(largest[0])

    def smallest(
        self, count: int
    ) -> tuple[Float[np.ndarray, " {count}"], Float[np.ndarray, "n {count}"]]:
        """Return the smallest eigenvalues, ascending, and functions: L u = lambda M u, u^T M u = 1.

        Functions of equal eigenvalues may come in any rotation, and every one with either sign.

        Raises:
            ValueError: If `count` is not between 1 and the number of nodes.
        """
        if not 0 < count <= len(self.mass):
            raise ValueError(f"asked for {count} eigenvectors of {len(self.mass)} nodes")
        values, vectors = smallest_eigenpairs(self.symmetric(), count)
        return values, vectors / np.sqrt(self.mass)[:, None]

    def second(
        self, count: int = 2
    ) -> tuple[Float[np.ndarray, " {count}"], Float[np.ndarray, " n"]]:
        """Return the smallest eigenvalues, and a function of the second orthogonal to constants.

        Where 0 is double, the graph being in two pieces, it has one value on each piece; with more
        it is not determined.

        Raises:
            ValueError: If `count` is not between 2 and the number of nodes.
        """
        values, functions = self.smallest(max(count, 2))
        zeros = int(
            np.count_nonzero(
                np.abs(values) < ZERO * max(float(self.matrix.diagonal().max()), 1e-300)
            )
        )
        if zeros < 2:
            return values, functions[:, 1]
        of_zero = functions[:, :zeros]
        left = of_zero - (self.mass @ of_zero) / self.mass.sum()
        sizes = self.mass @ left**2
        most = int(np.argmax(sizes))
        return values, left[:, most] / np.sqrt(sizes[most])


def smallest_eigenpairs(
    matrix: Sparse, count: int, shift: float | None = None
) -> tuple[Float[np.ndarray, " {count}"], Float[np.ndarray, "n {count}"]]:
    """Return the smallest eigenvalues, ascending, and unit eigenvectors of a semidefinite matrix.

    The first entry of a vector that is more than half as large as its largest is positive.
    It is inverted at `shift` below 0: the closer to the eigenvalues, the fewer solves.

    Raises:
        LinAlgError: If the matrix has negative eigenvalues or is not symmetric.
    """
    n = matrix.shape[0]
    if n <= DENSE or count >= n - 1:
        values, vectors = np.linalg.eigh(matrix.toarray())
        return values[:count], _turned(vectors[:, :count])
    at = -SHIFT * float(matrix.diagonal().mean()) if shift is None else shift
    shifted = (matrix - at * scipy.sparse.eye_array(n)).tocsc()
    try:
        # A symmetric matrix with a symmetric order and no pivoting: several times faster than the
        # defaults.
        factor = scipy.sparse.linalg.splu(
            shifted,
            permc_spec="MMD_AT_PLUS_A",
            diag_pivot_thresh=0.0,
            options={"SymmetricMode": True},
        )
        inverse = scipy.sparse.linalg.LinearOperator(matrix.shape, matvec=factor.solve, dtype=float)
        values, vectors = scipy.sparse.linalg.eigsh(
            matrix, count, sigma=at, OPinv=inverse, v0=_start(n)
        )
    # A singular factor, or no convergence: the matrix is none that was asked for
    except RuntimeError as error:
        raise np.linalg.LinAlgError(str(error)) from None
    order = np.argsort(values)
    return values[order], _turned(vectors[:, order])


def _turned(vectors: np.ndarray) -> np.ndarray:
    """Return vectors with the sign that `smallest_eigenpairs` says, the same on every machine."""
    sizes = np.abs(vectors)
    first = (sizes > 0.5 * sizes.max(axis=0)).argmax(axis=0)
    return vectors * np.where(vectors[first, np.arange(vectors.shape[1])] < 0, -1.0, 1.0)


def _start(n: int) -> np.ndarray:
    """Return a start that is nowhere near a few eigenvectors, the same at every call."""
    return np.sin(np.arange(n) ** 2.0)
