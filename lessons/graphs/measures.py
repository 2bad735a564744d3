"""What is read off a step: who is where, how far from the truth it is, and whether that is well."""

from typing import Literal

import numpy as np

from lessons.graphs.stages import edge_length
from lessons.graphs.state import State
from workbench.algorithms.graphs.diffusion import Heat, Smoothed
from workbench.algorithms.graphs.spectral_cut import Cut
from workbench.algorithms.learning.graph_network import Layer, Trained
from workbench.geometry.graphs import degrees
from workbench.geometry.meshes.invariants import signed_volume

Tone = Literal["info", "good", "wrong"]
WELL, BADLY = 0.9, 0.75  # shares of the nodes that are on their right side


def predicted(state: State) -> np.ndarray:
    """Return the class that a step gives each node, 0 or 1, and -1 where it gives none; none at all
    before it tells.
    """
    result = state.now
    if isinstance(result, Cut) and len(result.side):
        return two_sides(result.side, state.subject.classes)
    if isinstance(result, Layer) and result.features.shape[1] == 2:
        difference = result.features[:, 1] - result.features[:, 0]
        known = np.abs(difference) > 1e-9 * np.abs(result.features).max(initial=0.0)
        return np.where(known, (difference > 0).astype(int), -1)
    if isinstance(result, Trained):
        return result.scores.argmax(axis=1)
    return np.empty(0, int)


def two_sides(side: np.ndarray, classes: np.ndarray) -> np.ndarray:
    """Return a cut as classes: a cut does not say which side is which, so the better way round is
    taken.
    """
    sides = side.astype(int)
    if len(classes) and np.mean(sides == classes) < 0.5:
        return 1 - sides
    return sides


def reached(state: State) -> np.ndarray:
    """Return which nodes have any feature."""
    return (
        np.abs(state.now.features).sum(axis=1) > 0
        if isinstance(state.now, Layer)
        else np.ones(len(state.subject.p), bool)
    )


def right(state: State) -> int | None:
    """Return how many nodes a step puts where they truly belong; None where nobody knows or nothing
    was said.
    """
    told = predicted(state)
    classes = state.subject.classes
    return int(np.count_nonzero(told == classes)) if len(told) and len(classes) else None


def apart(state: State) -> float:
    """Return how much nodes still differ: the share of the features that is not along the square
    roots of degrees.

    Layers take all features to that direction, which tells of a node no more than how many
    neighbours it has.
    """
    assert isinstance(state.now, Layer)
    along = np.sqrt(degrees(state.adjacency) + 1)
    features = state.now.features
    rest = features - np.outer(along, along @ features) / (along @ along)
    size = np.linalg.norm(features)
    return float(np.linalg.norm(rest) / size) if size > 0 else 0.0


def volume_share(state: State) -> float:
    """Return the volume of a mesh as a share of the clean one's; NaN without a mesh that has
    one.
    """
    assert isinstance(state.now, Smoothed)
    if not len(state.subject.faces):
        return float("nan")
    clean = signed_volume(state.subject.p, state.subject.faces)
    return (
        signed_volume(state.now.p, state.subject.faces) / clean
        if abs(clean) > 1e-12
        else float("nan")
    )


def from_clean(state: State, p: np.ndarray) -> float:
    """Return the RMS distance of vertices from where they were before the noise, in mean edges."""
    return float(np.sqrt(((p - state.subject.p) ** 2).sum(axis=1).mean())) / edge_length(
        state.subject, state.adjacency
    )


def tone(state: State) -> Tone:
    """Return whether a step is right or wrong about what is known to be true, or claims nothing."""
    result = state.now
    if isinstance(result, Heat):
        if np.abs(result.u).max() > 1.0 + 1e-9:
            return "wrong"
        return "good" if state.last and result.error < 0.01 else "info"
    if isinstance(result, Smoothed):
        if not state.last:
            return "info"
        assert isinstance(state.first, Smoothed)
        start = from_clean(state, state.first.p)
        end = from_clean(state, result.p)
        if end > start:
            return "wrong"
        return "good" if end < 0.9 * start else "info"
    correct = right(state)
    n = len(state.subject.p)
    if correct is None or not (state.last or (isinstance(result, Cut) and result.phase == "sign")):
        return "info"
    if correct >= WELL * n:
        return "good"
    return "wrong" if correct < BADLY * n else "info"
