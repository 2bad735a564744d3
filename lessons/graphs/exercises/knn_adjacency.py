"""Write the graph of nearest neighbours of a cloud: an edge wherever one point is among the k
nearest others of the other. The lesson grows its graphs with your function, colours their pieces,
and cuts them.
"""

import numpy as np
from jaxtyping import Float

from lessons.graphs.exercises import STUDENTS, matrix_verdict
from workbench.exercise import Function, Verdict, alternative, check, contract, left_alone, mistake
from workbench.geometry.graphs import adjacency as graphs


def cloud(seed: int, count: int, d: int = 3) -> np.ndarray:
    """Return points in two lumps of different density, so that many namings are not returned."""
    rng = np.random.default_rng(seed)
    p = rng.normal(size=(count, d)) * np.where(np.arange(count) < count // 2, 0.2, 1.0)[:, None]
    return p + np.where(np.arange(count) < count // 2, 0.0, 1.5)[:, None]


@contract(
    slot="knn_adjacency",
    examples=(
        (
            "knn_adjacency(np.array([[0.0, 0, 0], [1, 0, 0], [3, 0, 0], [7, 0, 0]]), 1)",
            "[[0, 1, 0, 0], [1, 0, 1, 0], [0, 1, 0, 1], [0, 0, 1, 0]]",
        ),
        (
            "knn_adjacency(np.array([[0.0, 0, 0], [1, 0, 0], [3, 0, 0]]), 2)",
            "[[0, 1, 1], [1, 0, 1], [1, 1, 0]]",
        ),
    ),
)
def knn_adjacency(p: Float[np.ndarray, "n d"], k: int) -> Float[np.ndarray, "n n"]:
    """Return the symmetric adjacency matrix of the k-nearest-neighbour graph, entries 0 or 1.

    There is an edge between two points where either of them is among the k nearest others of the
    other.

    Args:
        p: Points, one row each, metres. Distances that would compete for the last place are never
            equal.
        k: How many neighbours each point names, 0 < k < n.

    Returns:
        A[i, j] = A[j, i] = 1 for an edge, else 0. The diagonal is 0: a point is not its own
        neighbour, also where another lies at its place. Every row has k ones or more. The input
        stays as it is.
    """
    return graphs.knn_adjacency(p, k)


HINT = "An edge where i names j or j names i; nobody names itself."


def found(candidate: Function, p: np.ndarray, k: int, case: str = "") -> Verdict:
    """Judge a graph entry by entry, and say which of its promises it breaks."""
    got = candidate(p, k)
    right = graphs.knn_adjacency(p, k)
    loops = int(np.count_nonzero(np.diag(got)))
    lopsided = int(np.count_nonzero(got != got.T))
    hint = HINT
    if loops:
        hint = f"{loops} points are their own neighbours. {HINT}"
    elif lopsided:
        hint = f"{lopsided} entries differ from the transposed ones. {HINT}"
    return matrix_verdict(got, right, hint, case)


@check(2)
def four_on_a_line(candidate: Function) -> Verdict:
    """At 0, 1, 3 and 7 m, each with its nearest: 1 names 0 and is named by 3, 3 is named by 7."""
    return found(candidate, np.array([[0.0, 0, 0], [1, 0, 0], [3, 0, 0], [7, 0, 0]]), 1)


@check(2)
def two_lumps(candidate: Function) -> Verdict:
    """40 points of two densities with four neighbours each: a naming that is not returned is an
    edge too.
    """
    return found(candidate, cloud(STUDENTS, 40), 4)


@check(1)
def points_are_left_alone(candidate: Function) -> Verdict:
    """The points that come in are not changed."""
    return left_alone(candidate, found(candidate, cloud(STUDENTS + 1, 15), 3))


def ranks(p: np.ndarray) -> np.ndarray:
    """Return for every point all points in the order of their distance, itself among them, ties by
    number.
    """
    return np.argsort(np.linalg.norm(p[:, None] - p, axis=2), axis=1, kind="stable")


def joined(rows: np.ndarray) -> np.ndarray:
    """Return the symmetric graph of who names whom."""
    named = np.zeros((len(rows), len(rows)))
    np.put_along_axis(named, rows, 1.0, axis=1)
    return np.maximum(named, named.T)


@mistake(
    "Each point found itself first and used up one of its k neighbours. Ask for k + 1 and leave the"
    " point itself out."
)
def itself_counted(p: np.ndarray, k: int) -> np.ndarray:
    """The k nearest, of which the point is one; the diagonal is cleared."""
    adjacency = joined(ranks(p)[:, :k])
    np.fill_diagonal(adjacency, 0.0)
    return adjacency


@mistake(
    "Each point is its own neighbour and takes one of the k places: the diagonal is 1. Nobody names"
    " itself here."
)
def loops_that_take_a_place(p: np.ndarray, k: int) -> np.ndarray:
    """The k nearest, of which the point is one."""
    return joined(ranks(p)[:, :k])


@mistake(
    "The edges are right, but the diagonal is 1: a point is not its own neighbour. Set it to 0."
)
def loops_kept(p: np.ndarray, k: int) -> np.ndarray:
    """Right but for the diagonal."""
    return np.maximum(graphs.knn_adjacency(p, k), np.eye(len(p)))


@mistake(
    "Your matrix is not symmetric: you kept who names whom. An edge has no direction: take the"
    " maximum with A.T."
)
def one_way(p: np.ndarray, k: int) -> np.ndarray:
    """Who names whom."""
    return graphs.directed_graph(graphs.neighbours(p, k)[0]).toarray()


@mistake(
    "You kept an edge only where both points name each other. Asked for is an edge where either"
    " does: `or`, not `and`."
)
def mutual(p: np.ndarray, k: int) -> np.ndarray:
    """The mutual graph: some points keep fewer than k."""
    named = one_way(p, k)
    return named * named.T


@mistake(
    "You added A and A.T: where both name each other the entry is 2. Entries are 0 or 1: take the"
    " maximum."
)
def added_up(p: np.ndarray, k: int) -> np.ndarray:
    """A + A.T."""
    named = one_way(p, k)
    return named + named.T


@mistake("Your entries are distances. Asked for is 1 for every edge, whatever its length.")
def lengths(p: np.ndarray, k: int) -> np.ndarray:
    """Lengths for ones."""
    return graphs.knn_adjacency(p, k) * np.linalg.norm(p[:, None] - p, axis=2)


@mistake("You took the points that are farthest, not nearest: the sort goes the other way.")
def farthest(p: np.ndarray, k: int) -> np.ndarray:
    """The last k of the order."""
    return joined(ranks(p)[:, -k:])


@mistake(
    "You average the two directions: an edge that one end names is 0.5. Either naming makes a whole"
    " edge, 1."
)
def averaged(p: np.ndarray, k: int) -> np.ndarray:
    """(A + A.T) / 2."""
    return added_up(p, k) / 2


@mistake(
    "All is right but where two points lie at one place: the first column of a search is then not"
    " always the point itself. Leave it out by its number, not by its place."
)
def first_column_dropped(p: np.ndarray, k: int) -> np.ndarray:
    """Takes the first of the order for the point itself."""
    return joined(ranks(p)[:, 1 : k + 1])


@alternative
def by_kth_distance(p: np.ndarray, k: int) -> np.ndarray:
    """Everything up to the k-th smallest distance, of either end."""
    apart = ((p[:, None] - p) ** 2).sum(axis=2)
    np.fill_diagonal(apart, np.inf)
    named = apart <= np.partition(apart, k - 1, axis=1)[:, k - 1 : k]
    return (named | named.T).astype(float)


@alternative
def by_sorting(p: np.ndarray, k: int) -> np.ndarray:
    """All distances, infinite to oneself."""
    apart = np.linalg.norm(p[:, None] - p, axis=2)
    np.fill_diagonal(apart, np.inf)
    return joined(np.argsort(apart, axis=1)[:, :k])
