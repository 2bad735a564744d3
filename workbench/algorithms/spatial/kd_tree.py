"""A k-d tree: points cut at the median of their box's longest side, and the nearest one found.

Reference: Friedman, Bentley and Finkel, An algorithm for finding best matches in logarithmic
expected time, ACM TOMS 3(3), 1977. Arya and Mount, Algorithms for fast vector quantization, DCC
1993: the distance to a cell, one axis at a time.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int

from workbench.tracing import traced

LEAF = 8  # points at most in a cell that is not cut


@dataclass(frozen=True, eq=False, kw_only=True)
class Tree:
    """A k-d tree over n points of d coordinates, m cells; cell 0 is the whole, children come later.

    Attributes:
        p: The points, in such an order that those of a cell stand together.
        axis: Along which coordinate a cell is cut; -1 where it is not.
        cut: Where.
        children: The cells below and above the cut; -1 where there are none.
        first, last: Where the points of a cell begin in `p`, and where they end.
        low, high: The lowest and the highest corner of each cell.
        depth: How many cuts are above each cell.
    """

    p: Float[np.ndarray, "n d"]
    axis: Int[np.ndarray, " m"]
    cut: Float[np.ndarray, " m"]
    children: Int[np.ndarray, "m 2"]
    first: Int[np.ndarray, " m"]
    last: Int[np.ndarray, " m"]
    low: Float[np.ndarray, "m d"]
    high: Float[np.ndarray, "m d"]
    depth: Int[np.ndarray, " m"]


def build_tree(
    p: Float[np.ndarray, "n d"],
    low: Float[np.ndarray, " d"],
    high: Float[np.ndarray, " d"],
    *,
    leaf: int = LEAF,
) -> Tree:
    """Return the k-d tree of points between two corners; a cell of more than `leaf` points is cut.

    Raises:
        ValueError: If there are no points.
    """
    if len(p) == 0:
        raise ValueError("no points to sort into a tree")
    columns = np.ascontiguousarray(p.T)
    order = np.arange(len(p))
    first = np.array([0])
    last = np.array([len(p)])
    known = 0
    low, high = low[None], high[None]
    levels = []
    while len(first):  # all cells of one depth
        axis, cut = _cut_cells(columns, order, first, last=last, leaf=leaf)
        parents = np.flatnonzero(axis >= 0)
        known += len(first)
        children = np.full((len(first), 2), -1)
        children[parents] = known + np.arange(2 * len(parents)).reshape(-1, 2)
        depth = np.full(len(first), len(levels))
        levels.append((axis, cut, children, first, last, low, high, depth))
        first, last, along = first[parents], last[parents], axis[parents]
        middle = first + (last - first) // 2
        first, last = np.stack([first, middle], axis=1), np.stack([middle, last], axis=1)
        low, high = low[parents].repeat(2, axis=0), high[parents].repeat(2, axis=0)
        pair = 2 * np.arange(len(parents))
        high[pair, along] = low[pair + 1, along] = cut[parents]
        first, last = first.ravel(), last.ravel()
    names = ("axis", "cut", "children", "first", "last", "low", "high", "depth")
    columns = (np.concatenate(parts) for parts in zip(*levels, strict=True))
    return Tree(p=p[order], **dict(zip(names, columns, strict=True)))


def _cut_cells(
    columns: np.ndarray, order: np.ndarray, first: np.ndarray, *, last: np.ndarray, leaf: int
) -> tuple[np.ndarray, np.ndarray]:
    """Return the axis (-1 where there is none) and place of the cells' cuts, and sort `order`.

    Cells of one size, of which a depth has two at most, are cut side by side. The points come as
    columns: the least and largest along a row of a block are found in a tenth of the time.
    """
    sizes = last - first
    axis = np.full(len(first), -1)
    cut = np.zeros(len(first))
    for size in np.unique(sizes[sizes > leaf]).tolist():
        cells = np.flatnonzero(sizes == size)
        span = first[cells, None] + np.arange(size)
        rows = order[span]
        block = columns.take(rows, axis=1)  # (d, cells, size), and laid out so
        along = np.argmax(block.max(axis=2) - block.min(axis=2), axis=0)
        values = block[along, np.arange(len(cells))]
        sorted_at_middle = np.argpartition(values, size // 2, axis=1)
        rows = np.take_along_axis(rows, sorted_at_middle, axis=1)
        order[span], axis[cells] = rows, along
        cut[cells] = columns[along, rows[:, size // 2]]
    return axis, cut


@dataclass(frozen=True, eq=False, kw_only=True)
class Visit:
    """A cell whose points were looked at, one by one.

    Attributes:
        looked: How many points were looked at so far.
        nearest: The row in the tree's points of the nearest so far.
        passed: Which cells were passed over on the way back up: they are farther than that.
    """

    cell: int
    looked: int
    nearest: int
    distance: float
    passed: tuple[int, ...]


@traced
def search(tree: Tree, q: Float[np.ndarray, " d"]) -> Iterator[Visit]:
    """Yield the cells that a search for the nearest point looks into: first down, then back up."""
    axes, cuts, children = tree.axis.tolist(), tree.cut.tolist(), tree.children.tolist()
    first = tree.first.tolist()
    last = tree.last.tolist()
    at = q.tolist()
    best = np.inf
    nearest = -1
    looked = 0
    passed: tuple[int, ...] = ()
    # cell, its squared distance, axis by axis
    waiting: list[tuple[int, float, dict[int, float]]] = [(0, 0.0, {})]
    while waiting:
        cell, squared, parts = waiting.pop()
        while axes[cell] >= 0:
            axis = axes[cell]
            beyond = at[axis] - cuts[cell]
            near, far = children[cell] if beyond < 0 else children[cell][::-1]
            part = beyond * beyond
            waiting.append((far, squared - parts.get(axis, 0.0) + part, parts | {axis: part}))
            cell = near
        v = tree.p[first[cell] : last[cell]] - q
        away = np.einsum("nd,nd->n", v, v)
        k = int(away.argmin())
        looked += len(away)
        if away[k] < best:
            best = float(away[k])
            nearest = first[cell] + k
        while waiting and waiting[-1][1] >= best:
            passed += (waiting.pop()[0],)
        yield Visit(cell=cell, looked=looked, nearest=nearest, distance=best**0.5, passed=passed)


def looked_at(tree: Tree, q: Float[np.ndarray, "m d"]) -> Float[np.ndarray, " m"]:
    """Return how many points the search looks at for each query."""
    return np.array([float([visit.looked for visit in search(tree, query)][-1]) for query in q])
