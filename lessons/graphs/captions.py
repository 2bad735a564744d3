"""The captions: what a step did, with its numbers."""

import numpy as np

from lessons.graphs.measures import (
    apart,
    from_clean,
    predicted,
    reached,
    right,
    tone,
    two_sides,
    volume_share,
)
from lessons.graphs.state import Grown, Matrix, Mode, State
from workbench.algorithms.graphs.diffusion import Heat, Smoothed
from workbench.algorithms.graphs.spectral_cut import Cut
from workbench.algorithms.learning.graph_network import Layer, Trained
from workbench.certain import sure
from workbench.geometry.graphs import cut_weight, degrees, edges_of
from workbench.numerals import brief, counted, fixed_or_power, percent
from workbench.scene import Caption


def caption(state: State) -> Caption:
    """Return what happened in this step and why."""
    return Caption(_text(state), tone(state))


def _text(state: State) -> str:
    result = state.now
    match result:
        case Grown():
            return _grown(state, result)
        case Matrix():
            return _matrix(state, result)
        case Mode():
            return _mode(state, result)
        case Cut():
            return _cut(state, result)
        case Heat():
            return _heat(state, result)
        case Smoothed():
            return _smoothed(state, result)
        case Layer():
            return _layer(state, result)
        case Trained():
            return _trained(state, result)


def _grown(state: State, grown: Grown) -> str:
    edges = counted(len(edges_of(grown.adjacency)), "edge")
    pieces = counted(grown.count, "component")
    if not grown.k:
        text = (
            f"{state.subject.name[0].upper()}{state.subject.name[1:]}:"
            f" {counted(len(state.subject.p), 'node')}, {edges}"
        )
        return f"{text}, {pieces}." + (
            "" if grown.count == 1 else " An edge joins two components, or closes a cycle."
        )
    named = "its nearest neighbour" if grown.k == 1 else f"its {grown.k} nearest neighbours"
    text = (
        f"Every point names {named}; {percent(grown.one_way, 0)} of the namings are not returned."
    )
    kept = {
        "union": "if either end names the other",
        "mutual": "only if both ends do",
        "directed": "one way",
    }
    largest = int(np.count_nonzero(grown.parts == 0))
    sizes = "" if grown.count == 1 else f", the largest of {counted(largest, 'node')}"
    return f"{text} An edge is kept {kept[state.params.join]}: {edges}, {pieces}{sizes}."


def _matrix(state: State, matrix: Matrix) -> str:
    L = matrix.laplacian.matrix
    v = state.vertex
    called = state.subject.called(v)
    d = brief(float(L[[v], [v]].sum()))
    entries = counted(len(edges_of(state.adjacency)), "edge")
    if matrix.part == "adjacency":
        filled = state.adjacency.nnz / state.adjacency.shape[0] ** 2
        kind = (
            "the cotangent weight of its edge"
            if state.params.laplacian == "cotangent"
            else "the weight of its edge"
        )
        return (
            f"A: the entry of two nodes is {kind}, else 0. {entries} fill {percent(filled, 1)} of"
            " the matrix."
        )
    if matrix.part == "degrees":
        return (
            f"D: on the diagonal the sum of each row of A, the degree. That of node {called} is"
            f" {d}."
        )
    if matrix.part == "laplacian":
        sums = float(np.abs(L @ np.ones(L.shape[0])).max())
        row = f"row {called} holds {d} on the diagonal, and minus its weights"
        return f"L = D − A: {row}. Every row adds up to {brief(round(sums, 9))}."
    x = state.subject.p[:, 0]
    if matrix.part == "applied":
        return (
            f"L x adds up by how much a node is above its neighbours: {brief(float((L @ x)[v]))} at"
            f" node {called}. Over all nodes xᵀ L x = {brief(float(x @ (L @ x)))} is the sum of the"
            " edges' squared differences."
        )
    a, b = edges_of(state.adjacency).T
    places = np.arange(len(matrix.order)), np.argsort(matrix.order)
    before, after = (brief(float(np.abs(place[a] - place[b]).mean()), 2) for place in places)
    return (
        "The same matrix with its nodes in the order of the second eigenvector of L: joined nodes"
        f" come to stand together, {after} places apart on average, where it was {before}."
    )


def _mode(state: State, mode: Mode) -> str:
    if mode.spectra:
        told = " and ".join(
            f"of {name} {_both([each[k] for each in mode.spectra])}"
            for k, name in enumerate(("A", "L = D − A"))
        )
        return (
            f"Two graphs of {counted(len(mode.spectra[0][0]), 'node')} each. Eigenvalues {told}."
            f" Drawn: eigenvector {mode.index + 1} of the two taken as one graph, λ ="
            f" {brief(mode.values[mode.index])}."
        )
    value = float(mode.values[mode.index])
    number = mode.index + 1
    text = f"Eigenvector {number}: λ = {brief(value)}"
    true = state.subject.eigenvalues
    if (
        len(true) > mode.index
        and state.params.laplacian != "normalised"
        and (state.subject.of_surface or state.params.laplacian == "plain")
    ):
        text += f", the truth is {brief(float(true[mode.index]))}"
    zeros = int(
        np.count_nonzero(np.abs(mode.values) < 1e-9 * max(1.0, float(np.abs(mode.values).max())))
    )
    if mode.index < zeros:
        why = (
            "it is constant"
            if zeros == 1
            else f"{zeros} components give {zeros} zeros, in any mixture of their constants"
        )
        return f"{text}: {why}."
    changes = _sign_changes(state, mode)
    return (
        f"{text}. Slow first: {changes} of the {counted(len(edges_of(state.adjacency)), 'edge')}"
        " join two signs."
    )


def _both(spectra: list[np.ndarray]) -> str:
    """Return the eigenvalues of two graphs, once where they are the same."""
    lists = [
        ", ".join(brief(round(float(value), 9) + 0.0) for value in values) for values in spectra
    ]
    return (
        f"{lists[0]} for both"
        if lists[0] == lists[1]
        else f"{lists[0]} for the first, {lists[1]} for the second"
    )


def _sign_changes(state: State, mode: Mode) -> int:
    above = mode.functions[:, mode.index] > 0
    a, b = edges_of(state.adjacency).T
    return int(np.count_nonzero(above[a] != above[b]))


def _cut(state: State, cut: Cut) -> str:
    n = len(state.subject.p)
    if cut.phase == "graph":
        return (
            f"The graph: {counted(n, 'node')}, {counted(len(edges_of(cut.adjacency)), 'edge')}."
            " Where is it thin?"
        )
    if cut.phase == "fiedler":
        zeros = int(
            np.count_nonzero(cut.eigenvalues < 1e-9 * max(float(degrees(cut.adjacency).max()), 1.0))
        )
        if zeros < 2:
            rest = f"λ₂ = {brief(float(cut.eigenvalues[1]))}. It changes little along edges."
            return f"The second eigenvector of L, after the constant one: {rest}"
        pieces = (
            "0 twice: the graph has no path from one part to another"
            if zeros == 2
            else "0 three times or more"
        )
        left = "one value on each part" if zeros == 2 else "a mixture that is not determined"
        return (
            f"The smallest eigenvalue of L is {pieces}. A solver returns any mixture of the parts'"
            f" constants; with the constant of all nodes taken out, what is left is {left}."
        )
    sizes = f"{counted(int(cut.side.sum()), 'node')} against {n - int(cut.side.sum()):,}"
    cost = f"{brief(cut.cut)} {'edge is' if cut.cut == 1 else 'edges are'} cut"
    if state.params.weighted and state.params.graph == "karate":
        cost = f"edges of weight {brief(cut.cut)} are cut"
    share = (
        f"conductance {brief(cut.conductance, 2)}"
        if np.isfinite(cut.conductance)
        else "conductance 0/0"
    )
    text = f"{sizes}, {cost}, {share}."
    if cut.phase == "sign":
        return f"Cut by sign: {text}{_sides(state)}"
    if cut.phase == "sweep":
        return f"One of the {n - 1:,} cuts along the vector, after node {cut.k + 1:,}: {text}"
    return (
        "The cut of least conductance along the vector:"
        f" {text}{_sides(state)}{_by_sign(state, cut)}"
    )


def _by_sign(state: State, cut: Cut) -> str:
    """Return how many the sign had right, where that were more."""
    if not len(state.subject.classes):
        return ""
    before = int(
        np.count_nonzero(two_sides(cut.fiedler > 0, state.subject.classes) == state.subject.classes)
    )
    edges = brief(cut_weight(cut.adjacency, cut.fiedler > 0))
    if before <= sure(right(state)):
        return ""
    return (
        f" By sign it was {before:,}, for a cut of {edges}: the least conductance need not be the"
        " truth."
    )


def _sides(state: State) -> str:
    correct = right(state)
    n = len(state.subject.p)
    if correct is None:
        return ""
    wrong = np.flatnonzero(predicted(state) != state.subject.classes)
    named = (
        f" (not {', '.join(state.subject.called(int(i)) for i in wrong)})"
        if 0 < len(wrong) <= 3
        else ""
    )
    return f" {correct:,} of {n:,} nodes are on their true side{named}."


def _heat(state: State, heat: Heat) -> str:
    if heat.step == 0:
        dt = f"{state.params.step_size:g} / λmax"
        return (
            f"All heat is at node {state.subject.called(state.vertex)}. A step is u ← u − dt L u"
            f" with dt = {dt}."
        )
    hottest = float(np.abs(heat.u).max())
    touched = int(np.count_nonzero(heat.u))
    if hottest > 1.0 + 1e-9:
        return (
            f"Step {heat.step}: the largest heat is {_size(hottest)}, where 1 was put in. dt is"
            " above 2 / λmax: the fastest eigenvector grows at every step and changes its sign."
        )
    n = len(heat.u)
    where = (
        f"{touched:,} of {counted(n, 'node')} have some" if touched < n else "all nodes have some"
    )
    return (
        f"Step {heat.step}: largest heat {_size(hottest)}, {where}; off the exact heat by"
        f" {_size(heat.error)} at most."
    )


def _size(value: float) -> str:
    if value < 1e-5:
        return "less than 0.00001"
    return fixed_or_power(value, 0) if value >= 1000 else brief(value, 2)


def _smoothed(state: State, smoothed: Smoothed) -> str:
    share = volume_share(state)
    off = from_clean(state, smoothed.p)
    volume = f", {percent(share, 0)} of the volume" if np.isfinite(share) else ""
    if smoothed.step == 0:
        return (
            f"The nodes with noise: {brief(off, 2)} mean edges (RMS) from where they should"
            f" be{volume}."
        )
    way = "half way to the mean of its neighbours"
    if state.params.filter == "taubin":
        way += ", and then a little more than half the way back"
    else:
        assert isinstance(state.first, Smoothed)
        before = from_clean(state, state.first.p)
        way += "" if off <= before else f"; the noise alone was {brief(before, 2)}"
    return (
        f"Round {smoothed.step}: every node went {way}. {brief(off, 2)} mean edges (RMS) from the"
        f" clean places{volume}."
    )


def _layer(state: State, layer: Layer) -> str:
    n = len(state.subject.p)
    v = state.vertex
    called = state.subject.called(v)
    if layer.features.shape[1] != 2:
        return _readout(state, layer)
    if layer.part == "input":
        first, other = (state.subject.called(i) for i in state.subject.labelled)
        return (
            f"Only two nodes have a label: node {first} says (1, 0), node {other} says (0, 1). All"
            " others say (0, 0)."
        )
    if layer.part == "loops":
        count = int(np.count_nonzero(layer.matrix[v]))
        return (
            f"A + I: every node also hears itself. Node {called} gathers from"
            f" {counted(count, 'node')}."
        )
    if layer.part == "normalised":
        return (
            f"Each entry over the roots of both degrees, loops counted: node {called} counts itself"
            f" {brief(layer.matrix[v, v])}; its weights add up to {brief(layer.matrix[v].sum())}."
        )
    if layer.part == "gathered":
        features = ", ".join(brief(x, 2) for x in layer.features[v])
        return (
            f"Gathered: node {called} has ({features}). W is the identity here and nothing is"
            " negative, so ReLU leaves it."
        )
    heard = int(np.count_nonzero(reached(state)))
    correct = right(state)
    text = (
        f"Layer {layer.layer}: the labels have reached {'all' if heard == n else f'{heard:,} of'}"
        f" {n:,} nodes"
    )
    text += "" if correct is None else f"; {correct:,} are right"
    return f"{text}. {percent(apart(state))} of the features still tell nodes apart."


def _readout(state: State, layer: Layer) -> str:
    classes = state.subject.classes
    sums = [layer.features[classes == which].sum(axis=0) for which in (0, 1)]
    gap = float(np.abs(sums[0] - sums[1]).max())
    size = float(np.abs(sums).max())
    if layer.layer == 0:
        return (
            "Two graphs, and every node begins with the same four features, all 1. Does any layer"
            " tell the graphs apart?"
        )
    if layer.part != "layer":
        return f"{_part(layer)} Both graphs' features are summed up in the table."
    same = gap <= 1e-9 * max(size, 1.0)
    told = (
        "are the same: these messages cannot tell the graphs apart"
        if same
        else f"differ by up to {brief(gap, 2)}"
    )
    return f"Layer {layer.layer}, with weights by chance: the sums over the two graphs {told}."


def _part(layer: Layer) -> str:
    return {
        "loops": "A + I: every node also hears itself.",
        "normalised": "Each entry over the roots of both degrees.",
        "gathered": "Every node has gathered from its neighbours.",
    }[layer.part]


def _trained(state: State, trained: Trained) -> str:
    correct = right(state)
    n = len(state.subject.p)
    layers = counted(max(state.params.layers, 1), "layer")
    text = (
        f"Iteration {trained.iteration} of a network of {layers}: loss"
        f" {brief(max(trained.loss, 0.0), 2)} on the two labels"
    )
    return f"{text}." if correct is None else f"{text}, {correct:,} of {n:,} nodes right."
