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
    now = state.now
    match now:
        case Grown():
            return _grown(state, now)
        case Matrix():
            return _matrix(state, now)
        case Mode():
            return _mode(state, now)
        case Cut():
            return _cut(state, now)
        case Heat():
            return _heat(state, now)
        case Smoothed():
            return _smoothed(state, now)
        case Layer():
            return _layer(state, now)
        case Trained():
            return _trained(state, now)


def _grown(state: State, now: Grown) -> str:
    edges = counted(len(edges_of(now.adjacency)), "edge")
    pieces = counted(now.count, "component")
    if not now.k:
        text = (
            f"{state.subject.name[0].upper()}{state.subject.name[1:]}:"
            f" {counted(len(state.subject.p), 'node')}, {edges}"
        )
        return f"{text}, {pieces}." + (
            "" if now.count == 1 else " An edge joins two components, or closes a cycle."
        )
    named = "its nearest neighbour" if now.k == 1 else f"its {now.k} nearest neighbours"
    text = f"Every point names {named}; {percent(now.one_way, 0)} of the namings are not returned."
    kept = {
        "union": "if either end names the other",
        "mutual": "only if both ends do",
        "directed": "one way",
    }
    largest = int(np.count_nonzero(now.parts == 0))
    sizes = "" if now.count == 1 else f", the largest of {counted(largest, 'node')}"
    return f"{text} An edge is kept {kept[state.params.join]}: {edges}, {pieces}{sizes}."


def _matrix(state: State, now: Matrix) -> str:
    L, v = now.laplacian.matrix, state.vertex
    called, d = state.subject.called(v), brief(float(L[[v], [v]].sum()))
    entries = counted(len(edges_of(state.adjacency)), "edge")
    if now.part == "adjacency":
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
    if now.part == "degrees":
        return (
            f"D: on the diagonal the sum of each row of A, the degree. That of node {called} is"
            f" {d}."
        )
    if now.part == "laplacian":
        sums = float(np.abs(L @ np.ones(L.shape[0])).max())
        row = f"row {called} holds {d} on the diagonal, and minus its weights"
        return f"L = D − A: {row}. Every row adds up to {brief(round(sums, 9))}."
    x = state.subject.p[:, 0]
    if now.part == "applied":
        return (
            f"L x adds up by how much a node is above its neighbours: {brief(float((L @ x)[v]))} at"
            f" node {called}. Over all nodes xᵀ L x = {brief(float(x @ (L @ x)))} is the sum of the"
            " edges' squared differences."
        )
    a, b = edges_of(state.adjacency).T
    places = np.arange(len(now.order)), np.argsort(now.order)
    before, after = (brief(float(np.abs(place[a] - place[b]).mean()), 2) for place in places)
    return (
        "The same matrix with its nodes in the order of the second eigenvector of L: joined nodes"
        f" come to stand together, {after} places apart on average, where it was {before}."
    )


def _mode(state: State, now: Mode) -> str:
    if now.spectra:
        told = " and ".join(
            f"of {name} {_both([each[k] for each in now.spectra])}"
            for k, name in enumerate(("A", "L = D − A"))
        )
        return (
            f"Two graphs of {counted(len(now.spectra[0][0]), 'node')} each. Eigenvalues {told}."
            f" Drawn: eigenvector {now.index + 1} of the two taken as one graph, λ ="
            f" {brief(now.values[now.index])}."
        )
    value, number = float(now.values[now.index]), now.index + 1
    text = f"Eigenvector {number}: λ = {brief(value)}"
    true = state.subject.eigenvalues
    if (
        len(true) > now.index
        and state.params.laplacian != "normalised"
        and (state.subject.of_surface or state.params.laplacian == "plain")
    ):
        text += f", the truth is {brief(float(true[now.index]))}"
    zeros = int(
        np.count_nonzero(np.abs(now.values) < 1e-9 * max(1.0, float(np.abs(now.values).max())))
    )
    if now.index < zeros:
        why = (
            "it is constant"
            if zeros == 1
            else f"{zeros} components give {zeros} zeros, in any mixture of their constants"
        )
        return f"{text}: {why}."
    changes = _sign_changes(state, now)
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


def _sign_changes(state: State, now: Mode) -> int:
    above = now.functions[:, now.index] > 0
    a, b = edges_of(state.adjacency).T
    return int(np.count_nonzero(above[a] != above[b]))


def _cut(state: State, now: Cut) -> str:
    n = len(state.subject.p)
    if now.phase == "graph":
        return (
            f"The graph: {counted(n, 'node')}, {counted(len(edges_of(now.adjacency)), 'edge')}."
            " Where is it thin?"
        )
    if now.phase == "fiedler":
        zeros = int(
            np.count_nonzero(now.eigenvalues < 1e-9 * max(float(degrees(now.adjacency).max()), 1.0))
        )
        if zeros < 2:
            rest = f"λ₂ = {brief(float(now.eigenvalues[1]))}. It changes little along edges."
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
    sizes = f"{counted(int(now.side.sum()), 'node')} against {n - int(now.side.sum()):,}"
    cost = f"{brief(now.cut)} {'edge is' if now.cut == 1 else 'edges are'} cut"
    if state.params.weighted and state.params.graph == "karate":
        cost = f"edges of weight {brief(now.cut)} are cut"
    share = (
        f"conductance {brief(now.conductance, 2)}"
        if np.isfinite(now.conductance)
        else "conductance 0/0"
    )
    text = f"{sizes}, {cost}, {share}."
    if now.phase == "sign":
        return f"Cut by sign: {text}{_sides(state)}"
    if now.phase == "sweep":
        return f"One of the {n - 1:,} cuts along the vector, after node {now.k + 1:,}: {text}"
    return (
        "The cut of least conductance along the vector:"
        f" {text}{_sides(state)}{_by_sign(state, now)}"
    )


def _by_sign(state: State, now: Cut) -> str:
    """Return how many the sign had right, where that were more."""
    if not len(state.subject.classes):
        return ""
    before = int(
        np.count_nonzero(two_sides(now.fiedler > 0, state.subject.classes) == state.subject.classes)
    )
    edges = brief(cut_weight(now.adjacency, now.fiedler > 0))
    if before <= sure(right(state)):
        return ""
    return (
        f" By sign it was {before:,}, for a cut of {edges}: the least conductance need not be the"
        " truth."
    )


def _sides(state: State) -> str:
    correct, n = right(state), len(state.subject.p)
    if correct is None:
        return ""
    wrong = np.flatnonzero(predicted(state) != state.subject.classes)
    named = (
        f" (not {', '.join(state.subject.called(int(i)) for i in wrong)})"
        if 0 < len(wrong) <= 3
        else ""
    )
    return f" {correct:,} of {n:,} nodes are on their true side{named}."


def _heat(state: State, now: Heat) -> str:
    if now.step == 0:
        dt = f"{state.params.step_size:g} / λmax"
        return (
            f"All heat is at node {state.subject.called(state.vertex)}. A step is u ← u − dt L u"
            f" with dt = {dt}."
        )
    hottest, touched = float(np.abs(now.u).max()), int(np.count_nonzero(now.u))
    if hottest > 1.0 + 1e-9:
        return (
            f"Step {now.step}: the largest heat is {_size(hottest)}, where 1 was put in. dt is"
            " above 2 / λmax: the fastest eigenvector grows at every step and changes its sign."
        )
    n = len(now.u)
    where = (
        f"{touched:,} of {counted(n, 'node')} have some" if touched < n else "all nodes have some"
    )
    return (
        f"Step {now.step}: largest heat {_size(hottest)}, {where}; off the exact heat by"
        f" {_size(now.error)} at most."
    )


def _size(value: float) -> str:
    return (
        "less than 0.00001"
        if value < 1e-5
        else fixed_or_power(value, 0)
        if value >= 1000
        else brief(value, 2)
    )


def _smoothed(state: State, now: Smoothed) -> str:
    share, off = volume_share(state), from_clean(state, now.p)
    volume = f", {percent(share, 0)} of the volume" if np.isfinite(share) else ""
    if now.step == 0:
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
        f"Round {now.step}: every node went {way}. {brief(off, 2)} mean edges (RMS) from the clean"
        f" places{volume}."
    )


def _layer(state: State, now: Layer) -> str:
    n, v = len(state.subject.p), state.vertex
    called = state.subject.called(v)
    if now.features.shape[1] != 2:
        return _readout(state, now)
    if now.part == "input":
        one, other = (state.subject.called(i) for i in state.subject.labelled)
        return (
            f"Only two nodes have a label: node {one} says (1, 0), node {other} says (0, 1). All"
            " others say (0, 0)."
        )
    if now.part == "loops":
        count = int(np.count_nonzero(now.matrix[v]))
        return (
            f"A + I: every node also hears itself. Node {called} gathers from"
            f" {counted(count, 'node')}."
        )
    if now.part == "normalised":
        return (
            f"Each entry over the roots of both degrees, loops counted: node {called} counts itself"
            f" {brief(now.matrix[v, v])}; its weights add up to {brief(now.matrix[v].sum())}."
        )
    if now.part == "gathered":
        said = ", ".join(brief(x, 2) for x in now.features[v])
        return (
            f"Gathered: node {called} has ({said}). W is the identity here and nothing is negative,"
            " so ReLU leaves it."
        )
    heard, correct = int(np.count_nonzero(reached(state))), right(state)
    text = (
        f"Layer {now.layer}: the labels have reached {'all' if heard == n else f'{heard:,} of'}"
        f" {n:,} nodes"
    )
    text += "" if correct is None else f"; {correct:,} are right"
    return f"{text}. {percent(apart(state))} of the features still tell nodes apart."


def _readout(state: State, now: Layer) -> str:
    classes = state.subject.classes
    sums = [now.features[classes == which].sum(axis=0) for which in (0, 1)]
    gap, size = float(np.abs(sums[0] - sums[1]).max()), float(np.abs(sums).max())
    if now.layer == 0:
        return (
            "Two graphs, and every node begins with the same four features, all 1. Does any layer"
            " tell the graphs apart?"
        )
    if now.part != "layer":
        return f"{_part(now)} Both graphs' features are summed up in the table."
    same = gap <= 1e-9 * max(size, 1.0)
    told = (
        "are the same: these messages cannot tell the graphs apart"
        if same
        else f"differ by up to {brief(gap, 2)}"
    )
    return f"Layer {now.layer}, with weights by chance: the sums over the two graphs {told}."


def _part(now: Layer) -> str:
    return {
        "loops": "A + I: every node also hears itself.",
        "normalised": "Each entry over the roots of both degrees.",
        "gathered": "Every node has gathered from its neighbours.",
    }[now.part]


def _trained(state: State, now: Trained) -> str:
    correct, n = right(state), len(state.subject.p)
    layers = counted(max(state.params.layers, 1), "layer")
    text = (
        f"Iteration {now.iteration} of a network of {layers}: loss {brief(max(now.loss, 0.0), 2)}"
        " on the two labels"
    )
    return f"{text}." if correct is None else f"{text}, {correct:,} of {n:,} nodes right."
