"""What one step looks like: nodes in the colours of what was computed, edges, and those that are
cut.
"""

import numpy as np

from lessons.graphs.captions import caption
from lessons.graphs.charts import beside
from lessons.graphs.measures import predicted, reached
from lessons.graphs.state import Grown, Matrix, Mode, State
from workbench.algorithms.graphs.diffusion import Heat, Smoothed
from workbench.algorithms.graphs.spectral_cut import Cut
from workbench.algorithms.learning.graph_network import Layer, Trained
from workbench.geometry.graphs import edges_of
from workbench.geometry.polylines import between
from workbench.scene import Classes, Color, Field, Mesh, Points, Primitive, Role, Scene, Segments

MOST_EDGES = 12_000
PARTS: tuple[tuple[Role, ...], tuple[str, ...]] = (
    ("target", "other", "highlight", "wrong"),
    ("largest component", "second largest", "third", "smaller ones"),
)
SIDES: tuple[tuple[Role, ...], tuple[str, ...]] = (("target", "source"), ("one side", "other side"))
TOLD: tuple[tuple[Role, ...], tuple[str, ...]] = (
    ("target", "source", "neutral"),
    ("says one group", "says the other", "says nothing"),
)


def draw(state: State) -> Scene:
    """Return the picture of one step."""
    subject, result = state.subject, state.now
    p = result.p if isinstance(result, Smoothed) else subject.p
    color = _color(state)
    scene: dict[str, Primitive] = {"caption": caption(state)}
    if not (
        len(subject.faces) and isinstance(result, Smoothed)
    ):  # a surface that moves is enough to send
        scene["nodes"] = Points(p, color, subject.radius, name="nodes")
    if len(subject.faces):
        scene["surface"] = Mesh(p, subject.faces, color, name="surface")
    scene |= _edges(state, p) | _marks(state, p)
    return scene | beside(state)


def _color(state: State) -> Color:
    result = state.now
    match result:
        case Grown():
            return Classes(np.minimum(result.parts, 3), *PARTS)
        case Matrix():
            return _matrix_color(state, result)
        case Mode():
            return _signed(result.functions[:, result.index], f"eigenvector {result.index + 1}")
        case Heat():
            largest = max(float(np.abs(result.u).max()), 1e-300)
            return Field(result.u / largest, -1.0, 1.0, "heat over the largest", map="diverging")
        case Smoothed():
            off = np.linalg.norm(result.p - state.subject.p, axis=1)
            return Field(
                1000 * off, 0.0, float(1000 * off.max()) or 1.0, "distance to the clean place", "mm"
            )
        case Cut():
            if result.phase == "graph":
                return "target"
            return (
                _signed(result.fiedler, "Fiedler vector")
                if result.phase == "fiedler"
                else Classes(predicted(state), *SIDES)
            )
        case Layer() if result.features.shape[1] != 2:
            total = np.round(result.features.sum(axis=1), 9)
            return Field(total, 0.0, float(total.max()) or 1.0, "sum of a node's features")
        case Layer() | Trained():
            told = predicted(state)
            return Classes(np.where(told < 0, 2, told), *TOLD)


def _signed(values: np.ndarray, title: str) -> Field:
    reach = max(float(np.abs(values).max(initial=0.0)), 1e-9)
    return Field(values, -reach, reach, title, map="diverging")


def _matrix_color(state: State, matrix: Matrix) -> Color:
    if matrix.part == "applied":
        return _signed(matrix.laplacian(state.subject.p[:, 0]), "L applied to x")
    if matrix.part == "ordered":
        place = np.argsort(matrix.order).astype(float)
        return Field(place, 0.0, max(len(place) - 1.0, 1.0), "place in the new order")
    if matrix.part == "degrees":
        d = matrix.laplacian.matrix.diagonal()
        return Field(d, 0.0, max(float(d.max()), 1e-9), "degree")
    return "target"


def _edges(state: State, p: np.ndarray) -> dict[str, Primitive]:
    """Draw the edges: one-way ones of a growing graph apart, and those that a cut goes through."""
    result = state.now
    edges = edges_of(state.adjacency)
    p = p + below(state)
    if len(edges) > MOST_EDGES or (
        len(state.subject.faces) and not isinstance(result, Cut | Grown)
    ):
        return {}
    if isinstance(result, Grown) and result.k:
        mutual = result.directed.minimum(result.directed.T).tocsr()
        both = np.isin(edges @ [len(p), 1], edges_of(mutual) @ [len(p), 1])
        return {
            "edges": Segments(
                p[edges[both]], "correspondence", 1.5, name="edges named from both ends"
            ),
            "one-way edges": Segments(p[edges[~both]], "source", 1.5, name="named from one end"),
        }
    if isinstance(result, Cut) and len(result.side):
        through = result.side[edges[:, 0]] != result.side[edges[:, 1]]
        return {
            "edges": Segments(p[edges[~through]], "correspondence", 1.2, opacity=0.6, name="edges"),
            "cut edges": Segments(p[edges[through]], "wrong", 4.0, name="edges that are cut"),
        }
    return {"edges": Segments(p[edges], "correspondence", 1.2, opacity=0.6, name="edges")}


def _marks(state: State, p: np.ndarray) -> dict[str, Primitive]:
    """Draw rims: of the node that is looked at, of labelled nodes, and of nodes that are told
    wrongly.
    """
    result = state.now
    subject = state.subject
    scene = dict[str, Primitive]()
    under = below(state)
    if isinstance(result, Matrix | Heat | Layer):
        node = state.vertex
        scene["vertex"] = Points(
            p[[node]] + under,
            "highlight",
            1.7 * subject.radius,
            name=f"node {subject.called(node)}",
        )
        near = state.adjacency[[node]].indices
        if isinstance(result, Matrix | Layer) and len(near):
            scene["its edges"] = Segments(
                between(p[node], p[near]) + 2 * under, "highlight", 3.0, name="its edges"
            )
    told = predicted(state)
    classes = subject.classes
    if len(told) and len(classes) and not isinstance(result, Cut):
        misses = (told != classes) & (told >= 0) & reached(state)
        if misses.any():
            scene["misses"] = Points(
                p[misses] + under, "wrong", 1.5 * subject.radius, name="told wrongly"
            )
    if isinstance(result, Trained) or (isinstance(result, Layer) and result.features.shape[1] == 2):
        ends = list(subject.labelled)
        scene["labelled"] = Points(
            p[ends] + 2 * under, "truth", 1.9 * subject.radius, name="nodes with a label"
        )
    return scene


def below(state: State) -> np.ndarray:
    """Return how far what lies behind the nodes of a flat graph is drawn below them."""
    return np.array([0.0, 0.0, -0.5 * state.subject.radius if state.subject.flat else 0.0])
