"""Write one layer of a graph convolutional network: every node gathers from itself and its
neighbours, a matrix mixes what came, and what is negative becomes 0. The lesson spreads labels and
trains networks with your layer.
"""

import numpy as np
from jaxtyping import Float

from lessons.graphs.exercises import STUDENTS, matrix_verdict, weighted
from workbench.exercise import Function, Verdict, alternative, check, contract, left_alone, mistake
from workbench.geometry.graphs import adjacency as graphs

Inputs = tuple[np.ndarray, np.ndarray, np.ndarray]


def inputs(seed: int, count: int, a: int = 3, b: int = 4, chance: float = 0.5) -> Inputs:
    """Return a weighted graph without lone nodes, features of both signs, and weights of both
    signs.
    """
    rng = np.random.default_rng(seed)
    adjacency = weighted(seed, count, chance)
    row = np.arange(count - 1)
    adjacency[row, row + 1] = adjacency[row + 1, row] = 1.0
    return adjacency, rng.normal(size=(count, a)), rng.normal(size=(a, b))


@contract(
    slot="gcn_layer",
    preset="layer",
    examples=(
        (
            "gcn_layer(np.array([[0.0, 1], [1, 0]]), np.array([[2.0], [4.0]]), np.array([[1.0]]))",
            "[[3], [3]]",
        ),
        (
            "gcn_layer(np.zeros((2, 2)), np.array([[2.0], [-4.0]]), np.array([[1.0, -1.0]]))",
            "[[2, 0], [0, 4]]",
        ),
    ),
)
def gcn_layer(
    adjacency: Float[np.ndarray, "n n"],
    features: Float[np.ndarray, "n a"],
    weights: Float[np.ndarray, "a b"],
) -> Float[np.ndarray, "n b"]:
    """Return ReLU(D^(-1/2) (A + I) D^(-1/2) X W), D being the diagonal matrix of the row sums of A
    + I.

    Args:
        adjacency: A, symmetric, without negative entries, 0 on the diagonal.
        features: X, one row per node.
        weights: W, from old features to new ones.

    Returns:
        New features, one row per node, none negative: ReLU keeps what is above 0 and makes the rest
        0. A node without edges gathers from itself alone. The inputs stay as they are.
    """
    return graphs.gcn_layer(adjacency, features, weights)


HINT = (
    "Add the identity to A, divide by the roots of both row sums, multiply by X and W, and cut off"
    " below 0."
)


def found(candidate: Function, given: Inputs, case: str = "") -> Verdict:
    """Judge a layer entry by entry."""
    return matrix_verdict(candidate(*given), graphs.gcn_layer(*given), HINT, case)


@check(2)
def two_friends(candidate: Function) -> Verdict:
    """Two nodes with an edge share what they have: each weighs half."""
    return found(
        candidate, (np.array([[0.0, 1], [1, 0]]), np.array([[2.0, 1.0], [4.0, -3.0]]), np.eye(2))
    )


@check(2)
def a_star(candidate: Function) -> Verdict:
    """In a star the middle and the ends have other degrees: an entry is 1 over the root of their
    product.
    """
    star = np.zeros((5, 5))
    star[0, 1:] = star[1:, 0] = 1.0
    rng = np.random.default_rng(STUDENTS)
    return found(candidate, (star, rng.normal(size=(5, 3)), rng.normal(size=(3, 2))))


@check(1)
def inputs_are_left_alone(candidate: Function) -> Verdict:
    """The matrices that come in are not changed."""
    return left_alone(candidate, found(candidate, inputs(STUDENTS + 1, 8)))


def layer(gathers: np.ndarray, features: np.ndarray, weights: np.ndarray) -> np.ndarray:
    """Return ReLU(M X W)."""
    return np.maximum(gathers @ features @ weights, 0.0)


@mistake(
    "You left out the self-loops: a node does not hear itself, and one without edges divides by 0."
    " Take A + I."
)
def no_self_loops(adjacency: np.ndarray, features: np.ndarray, weights: np.ndarray) -> np.ndarray:
    """D^(-1/2) A D^(-1/2)."""
    root = 1 / np.sqrt(adjacency.sum(axis=1))
    return layer(root[:, None] * adjacency * root, features, weights)


@mistake(
    "You divided each row by its sum, a mean over neighbours. Asked for is symmetric: D^(-1/2) on"
    " both sides."
)
def row_mean(adjacency: np.ndarray, features: np.ndarray, weights: np.ndarray) -> np.ndarray:
    """D^(-1) (A + I)."""
    looped = adjacency + np.eye(len(adjacency))
    return layer(looped / looped.sum(axis=1, keepdims=True), features, weights)


@mistake(
    "You left out the ReLU: negative entries are still there. np.maximum(..., 0) makes them 0."
)
def no_relu(adjacency: np.ndarray, features: np.ndarray, weights: np.ndarray) -> np.ndarray:
    """Negative entries stay."""
    return graphs.propagation(adjacency) @ features @ weights


@mistake("Your degrees are those of A, without the loops that you added. Sum the rows of A + I.")
def degrees_without_loops(
    adjacency: np.ndarray, features: np.ndarray, weights: np.ndarray
) -> np.ndarray:
    """A + I, divided by the degrees of A."""
    root = 1 / np.sqrt(adjacency.sum(axis=1))
    return layer(root[:, None] * (adjacency + np.eye(len(adjacency))) * root, features, weights)


@mistake(
    "You added up A + I without dividing: nodes with many neighbours grow large. Divide by the"
    " roots of both degrees."
)
def not_normalised(adjacency: np.ndarray, features: np.ndarray, weights: np.ndarray) -> np.ndarray:
    """(A + I) X W."""
    return layer(adjacency + np.eye(len(adjacency)), features, weights)


@mistake(
    "You divided by the whole degrees on both sides. The exponent is -1/2 on each: divide by their"
    " square roots."
)
def whole_degrees(adjacency: np.ndarray, features: np.ndarray, weights: np.ndarray) -> np.ndarray:
    """D^(-1) (A + I) D^(-1)."""
    looped = adjacency + np.eye(len(adjacency))
    d = looped.sum(axis=1)
    return layer(looped / d[:, None] / d, features, weights)


@mistake("Your ReLU comes before W. It is the last step: what W makes negative becomes 0.")
def relu_too_early(adjacency: np.ndarray, features: np.ndarray, weights: np.ndarray) -> np.ndarray:
    """ReLU(A_hat X) W."""
    return np.maximum(graphs.propagation(adjacency) @ features, 0.0) @ weights


@mistake(
    "You counted neighbours for degrees. Where edges have weights, sum these: (A + I).sum(axis=1)."
)
def neighbours_counted(
    adjacency: np.ndarray, features: np.ndarray, weights: np.ndarray
) -> np.ndarray:
    """The number of neighbours for the sum of weights."""
    looped = adjacency + np.eye(len(adjacency))
    root = 1 / np.sqrt((looped > 0).sum(axis=1))
    return layer(root[:, None] * looped * root, features, weights)


@alternative
def by_diagonal_matrices(
    adjacency: np.ndarray, features: np.ndarray, weights: np.ndarray
) -> np.ndarray:
    """As the formula is written."""
    looped = adjacency + np.identity(len(adjacency))
    D = np.diag(looped.sum(axis=1) ** -0.5)
    Z = D @ looped @ D @ features @ weights
    return Z * (Z > 0)


@alternative
def node_by_node(adjacency: np.ndarray, features: np.ndarray, weights: np.ndarray) -> np.ndarray:
    """Every node gathers for itself."""
    n = len(adjacency)
    mixed = features @ weights
    d = 1.0 + adjacency.sum(axis=1)
    out = np.zeros((n, weights.shape[1]))
    for i in range(n):
        out[i] = mixed[i] / d[i]
        for j in np.flatnonzero(adjacency[i]):
            out[i] += adjacency[i, j] * mixed[j] / np.sqrt(d[i] * d[j])
    return np.clip(out, 0.0, None)
