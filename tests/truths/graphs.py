"""What is true of a graph and of what a step made of it, by dense matrices and walking, apart from
the lesson's core.
"""

from collections.abc import Callable
from typing import Any

import numpy as np

from lessons.graphs.state import State
from workbench.algorithms.graphs.spectral_cut import Cut
from workbench.algorithms.learning.graph_network import Layer, Trained


def kept(work: Callable[[Any], Any]) -> Callable[[Any], Any]:
    """Keep what was made of the last matrix: the steps of a run share it, and often the runs of
    other seeds.
    """
    last: list[Any] = [None, None]

    def found(adjacency: Any) -> Any:
        content = adjacency.shape, adjacency.indices.tobytes(), adjacency.data.tobytes()
        if last[0] != content:
            last[:] = content, work(adjacency)
        return last[1]

    return found


dense = kept(lambda adjacency: adjacency.toarray())
ends = kept(lambda adjacency: np.nonzero(np.triu(adjacency.toarray(), 1)))


def A(state: State) -> np.ndarray:
    return dense(state.adjacency)


def told(state: State) -> np.ndarray:
    """The class that each node is given, of a cut the better way round; -1 where none is."""
    result = state.now
    classes = state.subject.classes
    if isinstance(result, Cut):
        side = result.side.astype(int)
        return (
            side
            if not len(classes) or np.sum(side == classes) >= np.sum(side != classes)
            else 1 - side
        )
    if isinstance(result, Trained):
        return np.argmax(result.scores, axis=1)
    assert isinstance(result, Layer)
    a, b = result.features.T
    return np.where(
        np.isclose(a, b, rtol=0, atol=1e-9 * np.abs(result.features).max()),
        -1,
        np.where(b > a, 1, 0),
    )


def correct(state: State) -> int:
    return int(np.sum(told(state) == state.subject.classes))


def off(state: State, p: np.ndarray) -> float:
    """RMS distance from the clean places, in mean edges."""
    i, j = ends(state.adjacency)
    clean = state.subject.p
    return float(
        np.sqrt(np.mean(np.sum((p - clean) ** 2, axis=1)))
        / np.mean(np.linalg.norm(clean[i] - clean[j], axis=1))
    )


def volume(p: np.ndarray, faces: np.ndarray) -> float:
    return float(np.linalg.det(p[faces]).sum() / 6)


@kept
def modes(adjacency):
    a = adjacency.toarray()
    return np.linalg.eigh(np.diag(a.sum(axis=1)) - a)


def parts(adjacency: np.ndarray) -> list[int]:
    """The sizes of the components, by walking."""
    a, b = np.nonzero(adjacency)
    friends = [
        set(some.tolist()) for some in np.split(b, np.searchsorted(a, np.arange(1, len(adjacency))))
    ]
    left = set(range(len(adjacency)))
    sizes = []
    while left:
        front = {left.pop()}
        seen = 1
        while front:
            node = front.pop()
            near_by = friends[node] & left
            left -= near_by
            front |= near_by
            seen += len(near_by)
        sizes.append(seen)
    return sorted(sizes, reverse=True)
