"""Write the Laplacian of a weighted graph from its adjacency matrix. What you return is what the
lesson's spectra, cuts and heat are computed from: watch the eigenvalues, and whether a constant
still costs nothing.
"""

import numpy as np
from jaxtyping import Float

from lessons.graphs.exercises import STUDENTS, matrix_verdict, weighted
from workbench.exercise import Function, Verdict, alternative, check, contract, left_alone, mistake
from workbench.geometry.graphs import adjacency as graphs


@contract(
    slot="laplacian",
    forbid=("scipy.sparse.csgraph",),
    examples=(
        (
            "laplacian(np.array([[0.0, 1, 0], [1, 0, 1], [0, 1, 0]]))",
            "[[1, -1, 0], [-1, 2, -1], [0, -1, 1]]",
        ),
        ("laplacian(np.array([[0.0, 2.5], [2.5, 0]]))", "[[2.5, -2.5], [-2.5, 2.5]]"),
    ),
)
def laplacian(adjacency: Float[np.ndarray, "n n"]) -> Float[np.ndarray, "n n"]:
    """Return L = D - A, D being the diagonal matrix of the degrees, the sums of weights at each
    node.

    Args:
        adjacency: A, symmetric, without negative entries, 0 on the diagonal. A[i, j] is the weight
            of the edge between nodes i and j, 0 where there is none; weights are any positive
            numbers.

    Returns:
        (L u)[i] is the sum over j of A[i, j] (u[i] - u[j]). Every row adds up to 0; the row of a
        node without edges is 0. Nothing is divided by the degrees. The input stays as it is.
    """
    return graphs.laplacian(adjacency)


HINT = "L = D - A, with the row sums of A on the diagonal of D."


def found(candidate: Function, adjacency: np.ndarray, case: str = "") -> Verdict:
    """Judge a Laplacian entry by entry."""
    return matrix_verdict(candidate(adjacency), graphs.laplacian(adjacency), HINT, case)


@check(2)
def a_path_of_four(candidate: Function) -> Verdict:
    """Four nodes in a row, all weights 1: degrees 1, 2, 2, 1."""
    return found(candidate, np.eye(4, k=1) + np.eye(4, k=-1))


@check(2)
def weights_count(candidate: Function) -> Verdict:
    """A degree is a sum of weights, not a number of neighbours."""
    return found(candidate, weighted(STUDENTS, 6))


@check(1)
def adjacency_is_left_alone(candidate: Function) -> Verdict:
    """The matrix that comes in is not changed."""
    return left_alone(candidate, found(candidate, weighted(STUDENTS + 1, 5)))


@mistake(
    "You returned A - D. The Laplacian is D - A: degrees on the diagonal are positive, its"
    " eigenvalues not negative."
)
def sign(adjacency: np.ndarray) -> np.ndarray:
    """A - D."""
    return -graphs.laplacian(adjacency)


@mistake(
    "You counted neighbours on the diagonal. Where edges have weights, a degree is their sum:"
    " adjacency.sum(axis=1)."
)
def neighbours_counted(adjacency: np.ndarray) -> np.ndarray:
    """The number of neighbours for the sum of their weights."""
    return np.diag((adjacency > 0).sum(axis=1).astype(float)) - adjacency


@mistake(
    "You returned D + A, the signless Laplacian. A constant then costs twice the degree; L = D - A."
)
def signless(adjacency: np.ndarray) -> np.ndarray:
    """D + A."""
    return np.diag(adjacency.sum(axis=1)) + adjacency


@mistake(
    "You divided each row by its degree: that is the random-walk Laplacian. Asked for is D - A"
    " itself."
)
def divided_by_degrees(adjacency: np.ndarray) -> np.ndarray:
    """I - D^(-1) A."""
    d = adjacency.sum(axis=1)
    return graphs.laplacian(adjacency) / np.where(d > 0, d, 1.0)[:, None]


@mistake(
    "You returned the symmetric normalised Laplacian, 1 on its diagonal. Asked for is D - A itself."
)
def normalised(adjacency: np.ndarray) -> np.ndarray:
    """D^(-1/2) L D^(-1/2)."""
    d = adjacency.sum(axis=1)
    root = np.sqrt(np.where(d > 0, d, 1.0))
    return graphs.laplacian(adjacency) / root[:, None] / root


@mistake(
    "You took every edge for one of weight 1, on the diagonal and beside it. Keep the weights of A."
)
def weights_ignored(adjacency: np.ndarray) -> np.ndarray:
    """The Laplacian of the graph without its weights."""
    return graphs.laplacian((adjacency > 0).astype(float))


@mistake("You returned the degrees alone, D. The weights are still to be taken off: L = D - A.")
def degrees_alone(adjacency: np.ndarray) -> np.ndarray:
    """D."""
    return np.diag(adjacency.sum(axis=1))


@alternative
def by_incidence(adjacency: np.ndarray) -> np.ndarray:
    """B W B^T, B having a column per edge: +1 at one end, -1 at the other."""
    a, b = np.nonzero(np.triu(adjacency))
    incidence = np.zeros((len(adjacency), len(a)))
    incidence[a, np.arange(len(a))] = 1.0
    incidence[b, np.arange(len(a))] = -1.0
    return incidence * adjacency[a, b] @ incidence.T


@alternative
def in_loops(adjacency: np.ndarray) -> np.ndarray:
    """Entry by entry."""
    n = len(adjacency)
    L = np.zeros((n, n))
    for i in range(n):
        for j in range(n):
            if i != j:
                L[i, j] -= adjacency[i, j]
                L[i, i] += adjacency[i, j]
    return L
