"""What each stage computes: its steps as states, by the functions in the slots."""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from itertools import pairwise
from typing import Any, Protocol

import numpy as np
import scipy

from lessons.graphs.state import ITERATIONS, PAIRS, Grown, Matrix, Mode, Now, Params, State, Subject
from workbench.algorithms.graphs.diffusion import heat, smooth
from workbench.algorithms.graphs.spectral_cut import spectral_cut
from workbench.algorithms.learning.graph_network import GcnLayer, spread, train
from workbench.certain import as_a
from workbench.errors import InputError
from workbench.geometry.graphs import Sparse
from workbench.geometry.graphs import adjacency as graphs
from workbench.geometry.graphs.spectra import Laplacian
from workbench.geometry.meshes.laplacian import cotangent_laplacian, mixed_areas
from workbench.tracing import traced

MOST_DENSE = 2000  # nodes of which whole matrices are made: 32 MB each
TAUBIN = 0.526  # the share of the way back: 1 / 0.5 - 1 / 0.526 = 0.099 is where smoothing begins
HIDDEN, EVERY = 8, 10


@dataclass(frozen=True, kw_only=True)
class Functions:
    """What students may write."""

    laplacian: Callable[[np.ndarray], np.ndarray]
    knn_adjacency: Callable[[np.ndarray, int], np.ndarray]
    gcn_layer: GcnLayer


def graph_steps(params: Params, subject: Subject, functions: Functions) -> Iterator[Grown]:
    """Yield the graph as it grows: neighbour by neighbour, or as a list of edges is read."""
    sizes = range(1, params.k + 1) if subject.edges is None else range(5)
    return grow(params, subject, functions, sizes=sizes)


@traced
def grow(
    params: Params, subject: Subject, functions: Functions, *, sizes: Iterable[int]
) -> Iterator[Grown]:
    """Yield graphs of so many neighbours per point, or of so many quarters of the given edges."""
    for size in sizes:
        if subject.edges is None:
            rows, _ = graphs.neighbours(subject.p, size)
            directed = graphs.directed_graph(rows)
            adjacency = joined(params, subject, directed, functions=functions, k=size)
        else:
            part = len(subject.edges) * size // 4
            adjacency = directed = graphs.graph_of(
                subject.edges[:part], len(subject.p), subject.weights[:part]
            )
        parts = graphs.components(adjacency)
        yield Grown(
            k=size if subject.edges is None else 0,
            adjacency=adjacency,
            directed=directed,
            parts=parts,
        )


def joined(
    params: Params, subject: Subject, directed: Sparse, *, functions: Functions, k: int
) -> Sparse:
    """Return the graph of who names whom, joined as the params say; the union by the function in
    the slot.
    """
    if params.join != "union" or len(subject.p) > MOST_DENSE:
        return graphs.joined(directed, params.join)
    return graphs.sparse(_finite("knn_adjacency", functions.knn_adjacency(subject.p, k)))


def adjacency_of(params: Params, subject: Subject, functions: Functions) -> Sparse:
    """Return the whole graph.

    Raises:
        InputError: If it is directed: Laplacians of directed graphs are another story.
    """
    if subject.edges is not None:
        return graphs.graph_of(subject.edges, len(subject.p), subject.weights)
    if params.join == "directed":
        raise InputError(
            "a one-way graph has no symmetric Laplacian: set join to union or mutual, or stage to"
            " graph"
        )
    rows, _ = graphs.neighbours(subject.p, params.k)
    return joined(params, subject, graphs.directed_graph(rows), functions=functions, k=params.k)


def laplacian_of(
    params: Params, subject: Subject, adjacency: Sparse, *, functions: Functions
) -> Laplacian:
    """Return the chosen Laplacian; that of a graph by the function in the slot.

    Raises:
        InputError: If cotangents are asked for without triangles.
    """
    if params.laplacian == "cotangent":
        if not len(subject.faces):
            raise InputError(
                "cotangents need triangles: set graph to sphere or rabbit mesh, or take another"
                " laplacian"
            )
        return Laplacian(
            cotangent_laplacian(subject.p, subject.faces), mixed_areas(subject.p, subject.faces)
        )
    if adjacency.shape[0] <= MOST_DENSE:
        matrix = graphs.sparse(_finite("laplacian", functions.laplacian(adjacency.toarray())))
    else:
        matrix = graphs.laplacian(adjacency)
    d = graphs.degrees(adjacency)
    return Laplacian(
        matrix, np.where(d > 0, d, 1.0) if params.laplacian == "normalised" else np.ones(len(d))
    )


def matrix_steps(
    params: Params, subject: Subject, adjacency: Sparse, *, functions: Functions
) -> Iterator[Now]:
    """Yield A, D, L = D - A, L applied to a function of the nodes, and L with its nodes in a better
    order.
    """
    laplacian = laplacian_of(params, subject, adjacency, functions=functions)
    return matrices(laplacian, len(subject.p))


@traced
def matrices(laplacian: Laplacian, count: int) -> Iterator[Matrix]:
    """Yield the parts of a Laplacian as matrices."""
    as_numbered = np.arange(count)
    L = laplacian.matrix
    degrees = scipy.sparse.diags_array(L.diagonal()).tocsr()
    weights = (degrees - L).tocsr()  # A; of a mesh the cotangent weights
    yield Matrix(part="adjacency", laplacian=laplacian, shown=weights, order=as_numbered)
    yield Matrix(part="degrees", laplacian=laplacian, shown=degrees, order=as_numbered)
    yield Matrix(part="laplacian", laplacian=laplacian, shown=L, order=as_numbered)
    yield Matrix(part="applied", laplacian=laplacian, shown=L, order=as_numbered)
    _, fiedler = laplacian.second()
    # nodes that are joined have similar values, and come to stand together
    order = np.argsort(fiedler, kind="stable")
    yield Matrix(part="ordered", laplacian=laplacian, shown=L[order][:, order], order=order)


def spectrum_steps(
    params: Params, subject: Subject, adjacency: Sparse, *, functions: Functions
) -> Iterator[Now]:
    """Yield eigenvectors one by one, slow ones first."""
    laplacian = laplacian_of(params, subject, adjacency, functions=functions)
    pair = spectra(params, subject, adjacency)
    return modes(
        laplacian, min(params.modes, len(subject.p)), of_unit_sphere(params, subject), pair=pair
    )


@traced
def modes(laplacian: Laplacian, count: int, relative: bool, *, pair: tuple) -> Iterator[Mode]:
    """Yield the slowest eigenvectors of a Laplacian, its eigenvalues as ratios where only these
    mean something.
    """
    values, functions = laplacian.smallest(count)
    if relative and count > 3:
        values = values * 2 / values[1:4].mean()  # the first three of a sphere are 2
    for index in range(count):
        yield Mode(index=index, values=values, functions=functions, spectra=pair)


def of_unit_sphere(params: Params, subject: Subject) -> bool:
    """Tell whether eigenvalues of a graph are to be compared with those of a surface: up to a
    factor.
    """
    return subject.of_surface and params.laplacian != "cotangent"


def spectra(
    params: Params, subject: Subject, adjacency: Sparse
) -> tuple[tuple[np.ndarray, np.ndarray], ...]:
    """Return of a pair of graphs the eigenvalues of A and of L of each."""
    if params.graph not in PAIRS or not len(subject.classes):
        return ()
    dense = [
        adjacency.toarray()[np.ix_(rows, rows)]
        for rows in (subject.classes == 0, subject.classes == 1)
    ]
    return tuple((np.linalg.eigvalsh(A), np.linalg.eigvalsh(graphs.laplacian(A))) for A in dense)


def cut_steps(
    params: Params, subject: Subject, adjacency: Sparse, *, functions: Functions
) -> Iterator[Now]:
    """Yield the Fiedler vector and the cuts that it gives."""
    laplacian = laplacian_of(params, subject, adjacency, functions=functions)
    return spectral_cut(adjacency, laplacian)


def heat_steps(
    params: Params, subject: Subject, adjacency: Sparse, *, functions: Functions
) -> Iterator[Now]:
    """Yield heat that flows from the node that is looked at."""
    laplacian = laplacian_of(params, subject, adjacency, functions=functions)
    u = np.zeros(len(subject.p))
    u[subject.front if params.vertex < 0 else params.vertex % len(u)] = 1.0
    dt = params.step_size / max(laplacian.largest(), 1e-12)
    return heat(u, laplacian, dt, steps=params.steps)


def smooth_steps(
    params: Params, subject: Subject, adjacency: Sparse, *, functions: Functions
) -> Iterator[Now]:
    """Yield the nodes' places, roughened by noise, as they are smoothed."""
    if (graphs.degrees(adjacency) <= 0).any():
        raise InputError(
            "a node without neighbours has no mean to move to: raise k, or take another graph"
        )
    sigma = params.noise * edge_length(subject, adjacency)
    noise = sigma * np.random.default_rng(params.seed + 1).standard_normal(subject.p.shape)
    if subject.flat:
        noise[:, 2] = 0.0
    outward = TAUBIN if params.filter == "taubin" else 0.0
    return smooth(subject.p + noise, adjacency, params.steps, outward=outward)


def edge_length(subject: Subject, adjacency: Sparse) -> float:
    """Return the mean length of the edges, metres."""
    a, b = graphs.edges_of(adjacency).T
    return float(np.linalg.norm(subject.p[a] - subject.p[b], axis=1).mean()) if len(a) else 1.0


def network_steps(
    params: Params, subject: Subject, adjacency: Sparse, *, functions: Functions
) -> Iterator[Now]:
    """Yield a network's features: two labels that spread, or of a pair of graphs what messages make
    of equal nodes.
    """
    dense = _dense(adjacency)
    if params.graph in PAIRS and len(subject.classes):
        features = np.ones((len(dense), 4))
        rng = np.random.default_rng(params.seed)
        weights = [rng.normal(size=(4, 4)) for _ in range(params.layers)]
    else:
        features = _labels(subject)
        weights = [np.eye(2)] * params.layers
    return spread(dense, features, weights, gcn_layer=functions.gcn_layer)


def training_steps(
    params: Params, subject: Subject, adjacency: Sparse, *, functions: Functions
) -> Iterator[Now]:
    """Yield a network of one layer or more while it learns two labels, every tenth iteration."""
    dense = _dense(adjacency)
    rng = np.random.default_rng(params.seed)
    n = len(subject.p)
    sizes = [n, *[HIDDEN] * (max(params.layers, 1) - 1), 2]
    weights = [rng.normal(size=(a, b)) * np.sqrt(2 / (a + b)) for a, b in pairwise(sizes)]
    steps = train(
        dense,
        np.eye(n),
        weights,
        labelled=np.array(subject.labelled),
        classes=np.array([0, 1]),
        iterations=ITERATIONS,
        gcn_layer=functions.gcn_layer,
    )
    return (trained for trained in steps if trained.iteration % EVERY == 0)


def _labels(subject: Subject) -> np.ndarray:
    features = np.zeros((len(subject.p), 2))
    features[subject.labelled, (0, 1)] = 1.0
    return features


def _dense(adjacency: Sparse) -> np.ndarray:
    if adjacency.shape[0] > MOST_DENSE:
        raise InputError(
            f"{adjacency.shape[0]:,} nodes; networks are computed on at most {MOST_DENSE:,}"
        )
    return adjacency.toarray()


def _finite(name: str, answer: Any) -> np.ndarray:
    matrix = np.asarray(answer, dtype=float)
    if not np.isfinite(matrix).all():
        raise InputError(f"{name} returned values that are not finite")
    return matrix


def states(params: Params, subject: Subject, functions: Functions) -> Iterator[State]:
    """Yield what a stage yields as states; all but the growing graph are about a whole one."""
    first = whole = None
    if params.stage == "graph":
        steps = graph_steps(params, subject, functions)
    else:
        whole = adjacency_of(params, subject, functions)
        steps = STAGES[params.stage](params, subject, whole, functions=functions)
    for step in steps:
        first = step if first is None else first
        graph = as_a(Grown, step).adjacency if whole is None else whole
        yield State(params=params, subject=subject, adjacency=graph, now=step, first=first)


class Stage(Protocol):
    """Yields what a stage shows of a graph whose adjacency is known."""

    def __call__(
        self, params: Params, subject: Subject, adjacency: Sparse, *, functions: Functions
    ) -> Iterator[Now]:
        """Yield it step by step."""
        ...


STAGES: dict[str, Stage] = {
    "matrix": matrix_steps,
    "spectrum": spectrum_steps,
    "cut": cut_steps,
    "heat": heat_steps,
    "smooth": smooth_steps,
    "network": network_steps,
    "training": training_steps,
}
