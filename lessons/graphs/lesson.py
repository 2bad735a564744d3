"""A cloud whose points know their neighbours is a matrix, and its slow eigenvectors cut and smooth.

What it teaches: "neighbour of" is not mutual; L = D - A measures how far each node is above its
neighbours, its second eigenvector finds the bridge, though not always by its sign; steps of L
smooth until they shrink or explode; and a layer of a graph network is one such step and a learned
matrix, so that many layers make all nodes alike.
"""

from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np

from lessons.graphs.draw import draw
from lessons.graphs.presets import BALL, PRESETS, QUESTIONS, VIEW
from lessons.graphs.stages import Functions, states
from lessons.graphs.state import Params, State
from lessons.graphs.subjects import subject_of
from workbench.algorithms.learning.graph_network import GcnLayer
from workbench.errors import InputError
from workbench.geometry.graphs import adjacency as graphs
from workbench.lesson import Lesson, Sweep

OfMatrix = Callable[[np.ndarray], np.ndarray]
Neighbours = Callable[[np.ndarray, int], np.ndarray]


def run(
    params: Params,
    *,
    laplacian: OfMatrix = graphs.laplacian,
    knn_adjacency: Neighbours = graphs.knn_adjacency,
    gcn_layer: GcnLayer = graphs.gcn_layer,
) -> Iterator[State]:
    """Yield the steps of one stage; above 2,000 nodes, too many for dense matrices, without these
    functions.
    """
    functions = Functions(laplacian=laplacian, knn_adjacency=knn_adjacency, gcn_layer=gcn_layer)
    try:
        yield from states(params, subject_of(params), functions)
    except np.linalg.LinAlgError:
        raise InputError(
            "of this matrix no eigenvectors were found: is it symmetric, and are its rows' sums 0?"
        ) from None


lesson = Lesson(
    name="graphs",
    title="Graphs and their spectra",
    summary="Join neighbouring points and write the edges into a matrix. It finds thin places "
    "and smooths noise.",
    page=Path(__file__).with_name("page.md"),
    params=Params,
    run=run,
    draw=draw,
    order=1900,
    chapter="Connect",
    minutes=25,
    needs=("distances",),
    view=VIEW,
    view_for=lambda params: BALL if params.mesh or params.cloud else None,
    presets=PRESETS,
    questions=QUESTIONS,
    first_step=-1,
    opening=0,
    sweeps=(Sweep("share", (0.5, 0.6, 0.7, 0.8, 0.9, 0.95)),),
    telling="Conductance of the cuts",
)
