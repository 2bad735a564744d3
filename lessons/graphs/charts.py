"""What stands beside the picture: the matrix, the spectrum, cuts, error to the truth, and one node
in numbers.
"""

import numpy as np

from lessons.graphs.measures import apart, from_clean, reached, right, volume_share
from lessons.graphs.state import Grown, Matrix, Mode, State
from workbench.algorithms.graphs.diffusion import Heat, Smoothed
from workbench.algorithms.graphs.spectral_cut import Cut
from workbench.algorithms.learning.graph_network import Layer, Trained
from workbench.geometry.graphs import Sparse, degrees
from workbench.numerals import brief
from workbench.scene import Chart, Field, Picture, Primitive, Table

LARGEST = 120  # pixels of a picture of a matrix
FLOOR = 1e-16
ROWS = 12
HEAT = Chart("Heat")
LOSS = Chart("Loss")
COMPONENTS = Chart("Components")
CONDUCTANCE = Chart("Conductance")
DEGREES = Chart("Degrees", "neighbours", "nodes")
ONE_WAY = Chart("One-way", unit="%")
OF_A, OF_L = Chart("Eigenvalues of A", "number"), Chart("Eigenvalues of L", "number")
EIGENVALUES = Chart("Eigenvalues", "number", "λ")
ERROR = Chart("Error to the truth", unit="%")
SORTED = Chart("Fiedler vector, sorted", "node in its order")
CUTS = Chart("Conductance of the cuts", "nodes on the near side")
RIGHT, SMOOTHED = Chart("Right", unit="%"), Chart("Over-smoothing", unit="%")
OFF, VOLUME = Chart("Error to the truth", unit="edges"), Chart("Volume", unit="%")


def beside(state: State) -> dict[str, Primitive]:
    """Return the charts, pictures and tables of a step."""
    result = state.now
    match result:
        case Grown():
            return _grown(result)
        case Matrix():
            return {"matrix": _picture(result), "node table": _node_table(state, result)}
        case Mode():
            return _spectrum(state, result)
        case Cut():
            return _cut(state, result)
        case Heat():
            return {
                "error": HEAT.scalar(
                    max(result.error, FLOOR), "error to the exact heat", "truth", log=True
                ),
                "hottest": HEAT.scalar(
                    max(float(np.abs(result.u).max()), FLOOR), "largest heat", log=True
                ),
            }
        case Smoothed():
            return _smoothed(state, result)
        case Layer():
            return _layer(state, result)
        case Trained():
            return _right(state) | {"loss": LOSS.scalar(result.loss, "loss of the two labels")}


def _grown(grown: Grown) -> dict[str, Primitive]:
    d = degrees(grown.adjacency.astype(bool).astype(float))
    counts = np.bincount(d.astype(int))
    scene: dict[str, Primitive] = {
        "components": COMPONENTS.scalar(float(grown.count), "components", "wrong", log=True),
        "degrees": DEGREES.bars(
            np.arange(len(counts), dtype=float), counts.astype(float), "nodes", "target"
        ),
    }
    if grown.k:
        scene["one-way"] = ONE_WAY.scalar(100 * grown.one_way, "neighbours not returned")
    return scene


def _picture(matrix: Matrix) -> Picture:
    """Return a matrix as a picture, of a large one the entry of largest size in every block."""
    values = _blocks(matrix.shown)
    reach = max(float(np.abs(values).max()), 1e-9)
    title = {
        "adjacency": "A",
        "degrees": "D",
        "laplacian": "L = D − A",
        "applied": "L = D − A",
        "ordered": "L, reordered",
    }
    return Picture(Field(values, -reach, reach, "entries", map="diverging"), title[matrix.part])


def _blocks(matrix: Sparse) -> np.ndarray:
    n = matrix.shape[0]
    entries = matrix.tocoo()
    size = -(-n // LARGEST)
    side = -(-n // size)
    values = np.zeros(side * side)
    # the largest of a block is written last, and stays
    order = np.argsort(np.abs(entries.data), kind="stable")
    values[((entries.row // size) * side + entries.col // size)[order]] = entries.data[order]
    return values.reshape(side, side)


def _node_table(state: State, matrix: Matrix) -> Table:
    """Return the row of L of the node that is looked at, applied to the places along x."""
    node = state.vertex
    x = state.subject.p[:, 0]
    row = matrix.laplacian.matrix[[node]].tocoo()
    others = [
        (int(j), -float(w)) for j, w in zip(row.col, row.data, strict=True) if j != node and w != 0
    ]
    rows = [
        (
            f"to node {state.subject.called(j)}",
            brief(w),
            brief(x[node] - x[j]),
            brief(w * (x[node] - x[j])),
        )
        for j, w in others[:ROWS]
    ]
    if len(others) > ROWS:
        rows.append((f"and {len(others) - ROWS} more", "", "", ""))
    total = float((matrix.laplacian.matrix @ x)[node])
    rows.append(("sum", brief(sum(w for _, w in others)), "", brief(total)))
    return Table(
        f"Row {state.subject.called(node)} of L x",
        ("", "weight", "x − x′ (m)", "product"),
        tuple(rows),
    )


def _spectrum(state: State, mode: Mode) -> dict[str, Primitive]:
    scene: dict[str, Primitive] = {}
    if mode.spectra:
        for k, chart in enumerate((OF_A, OF_L)):
            for which, (spectrum, role) in enumerate(
                zip(mode.spectra, ("target", "source"), strict=True)
            ):
                values = np.round(spectrum[k], 9) + 0.0
                x = np.arange(len(values)) + 1.0 + 0.15 * which
                name = f"{'left' if which == 0 else 'right'} graph"
                scene[f"{chart.title} {name}"] = chart.dots(x, values, name, role)
        return scene
    number = np.arange(len(mode.values)) + 1.0
    count = len(mode.values)
    values = np.round(mode.values, 9) + 0.0
    mark = mode.index + 1.0
    scene["eigenvalues"] = EIGENVALUES.dots(number, values, "of the graph", marks=(mark,))
    true = state.subject.eigenvalues[:count]
    if len(true) == count and state.params.laplacian in (
        ("plain", "cotangent") if state.subject.of_surface else ("plain",)
    ):
        name = "of the surface" if state.subject.of_surface else "in closed form"
        scene["true eigenvalues"] = EIGENVALUES.curve(
            number, np.round(true, 9) + 0.0, name, "truth"
        )
        here = float(true[mode.index])
        error = 100 * abs(mode.values[mode.index] - here) / here if here > 1e-9 else np.nan
        scene["error"] = ERROR.scalar(round(float(error), 6), "error of this eigenvalue", "truth")
    return scene


def _cut(state: State, cut: Cut) -> dict[str, Primitive]:
    scene = _right(state)
    if np.isfinite(cut.conductance):
        scene["conductance"] = CONDUCTANCE.scalar(cut.conductance, "conductance")
    if len(cut.fiedler):
        values = np.sort(cut.fiedler)
        x = np.arange(len(values)) + 1.0
        zero = float(np.count_nonzero(values <= 0)) + 0.5
        scene["sorted"] = SORTED.curve(
            x, np.round(values, 9) + 0.0, "Fiedler vector", "highlight", marks=(zero,)
        )
    if len(cut.conductances):
        x = np.arange(len(cut.conductances)) + 1.0
        mark = () if cut.k < 0 else (cut.k + 1.0,)
        scene["cuts"] = CUTS.curve(
            x, cut.conductances, "cut edges over the smaller side's degrees", marks=mark
        )
    return scene


def _right(state: State) -> dict[str, Primitive]:
    correct = right(state)
    if correct is None:
        return {}
    return {
        "right": RIGHT.scalar(
            100 * correct / len(state.subject.p), "nodes on their true side", "truth"
        )
    }


def _smoothed(state: State, smoothed: Smoothed) -> dict[str, Primitive]:
    off = from_clean(state, smoothed.p)
    share = volume_share(state)
    scene: dict[str, Primitive] = {
        "error": OFF.scalar(off, "RMS distance to the clean places", "truth")
    }
    if np.isfinite(share):
        scene["volume"] = VOLUME.scalar(100 * share, "volume")
    return scene


def _layer(state: State, layer: Layer) -> dict[str, Primitive]:
    scene = _right(state)
    if layer.features.shape[1] == 2:
        share = 100 * np.mean(reached(state))
        scene["reached"] = RIGHT.scalar(
            float(share), "nodes that a label has reached", "correspondence"
        )
    scene["apart"] = SMOOTHED.scalar(
        100 * apart(state), "what still differs between nodes", "highlight"
    )
    if len(state.subject.classes) and layer.features.shape[1] != 2:
        sums = [layer.features[state.subject.classes == which].sum(axis=0) for which in (0, 1)]
        rows = tuple(
            (f"feature {k + 1}", brief(a), brief(b))
            for k, (a, b) in enumerate(zip(*sums, strict=True))
        )
        scene["readout"] = Table("Sum over the nodes", ("", "left graph", "right graph"), rows)
    else:
        scene["sum table"] = _sum_table(state, layer)
    return scene


def _sum_table(state: State, layer: Layer) -> Table:
    """Return what a node gathers in the first layer, or what it has after a later one."""
    node = state.vertex
    row = layer.matrix[state.vertex]
    near = np.flatnonzero(row)
    header = ("from", "weight", "feature 1", "feature 2")
    if layer.layer <= 1 and layer.part != "layer":
        source = state.first.features if isinstance(state.first, Layer) else layer.features
        rows = [
            (f"node {state.subject.called(j)}", brief(row[j]), *(brief(v) for v in source[j]))
            for j in near[:ROWS]
        ]
        if len(near) > ROWS:
            rows.append((f"and {len(near) - ROWS} more", "", "", ""))
        if layer.part == "gathered":
            rows.append(("sum", "", *(brief(v) for v in layer.features[node])))
        return Table(f"What node {state.subject.called(node)} gathers", header, tuple(rows))
    rows = [(f"node {state.subject.called(node)}", "", *(brief(v) for v in layer.features[node]))]
    return Table(f"What node {state.subject.called(node)} gathers", header, tuple(rows))
