"""Graphs that people bring as lists of edges: two names per line, and a weight if they like."""

import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from jaxtyping import Float, Int

from workbench.apart import apart
from workbench.data.files.reading import text_rows
from workbench.errors import InputError

MOST_EDGES = 200_000
KINDS = (".csv", ".txt", ".tsv", ".edges", ".edgelist")


@dataclass(frozen=True, eq=False)
class EdgeList:
    """The edges of a file: nodes numbered in the order in which they are named first.

    Attributes:
        edges: Each edge once, smaller number first; one listed several times has the summed weight.
        weights: One per edge; 1 where the file has none.
    """

    names: tuple[str, ...]
    edges: Int[np.ndarray, "e 2"]
    weights: Float[np.ndarray, " e"]


@apart
def read_edges(path: Path, most_nodes: int) -> EdgeList:
    """Return the edges of a text file: per line two names, maybe a weight, by commas or blanks.

    Lines that begin with # or %, empty ones, a first line of words and edges from a node to itself
    are left out. Directions do not matter. More than `most_nodes` nodes are refused.

    Raises:
        InputError: If the file is missing, of another kind, not understood, or too large.
    """
    rows = text_rows(path, "edges", KINDS, comments="#%")
    if len(rows) > MOST_EDGES:
        raise InputError(f"{path.name}: {len(rows):,} lines; at most {MOST_EDGES:,} edges are read")
    number: dict[str, int] = {}
    weights: dict[tuple[int, int], float] = {}
    for i, line in rows:
        cells = [
            cell.strip().strip("\"'")
            for cell in re.split(r"[,;\t]" if re.search(r"[,;\t]", line) else r"\s+", line.strip())
        ]
        if i == rows[0][0] and [cell.lower() for cell in cells[:2]] in (
            ["source", "target"],
            ["from", "to"],
        ):
            continue
        a, b, weight = _row(cells, path.name, i)
        first, second = (number.setdefault(name, len(number)) for name in (a, b))
        if first != second:
            edge = min(first, second), max(first, second)
            weights[edge] = weights.get(edge, 0.0) + weight
    if not weights:
        raise InputError(
            f"{path.name}: no edge between two nodes; a line has two names and maybe a weight"
        )
    if len(number) > most_nodes:
        raise InputError(f"{path.name}: {len(number):,} nodes; at most {most_nodes:,} are laid out")
    return EdgeList(tuple(number), np.array(list(weights)), np.array(list(weights.values())))


def _row(cells: list[str], name: str, line: int) -> tuple[str, str, float]:
    """Return both names and the weight of a line."""
    if len(cells) not in (2, 3) or not all(cells[:2]):
        raise InputError(
            f"{name}, line {line}: {len(cells)} entries; two names and maybe a weight are wanted"
        )
    try:
        weight = float(cells[2]) if len(cells) == 3 else 1.0
    except ValueError:
        raise InputError(
            f"{name}, line {line}: the weight {cells[2][:20]!r} is no number"
        ) from None
    if not (np.isfinite(weight) and weight > 0):
        raise InputError(f"{name}, line {line}: the weight is {weight:g}; weights are positive")
    return cells[0], cells[1], weight
