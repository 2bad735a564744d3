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
    order = np.arange(len(p))
    lows, highs = [low], [high]
    axes, cuts, children, spans, depths = [-1], [0.0], [[-1, -1]], [(0, len(p))], [0]
    cell = 0
    while cell < len(spans):
        first, last = spans[cell]
        rows = order[first:last]
        if last - first > leaf:
            block = p[rows]
            axis = int(np.argmax(block.max(axis=0) - block.min(axis=0)))
            middle = (last - first) // 2
            rows = rows[np.argpartition(block[:, axis], middle)]
            order[first:last] = rows
            cut = float(p[rows[middle], axis])
            axes[cell], cuts[cell], children[cell] = axis, cut, [len(spans), len(spans) + 1]
            for span, ends, others in (
                ((first, first + middle), highs, lows),
                ((first + middle, last), lows, highs),
            ):
                bounded = ends[cell].copy()
                bounded[axis] = cut
                ends.append(bounded)
                others.append(others[cell])
                spans.append(span)
                axes.append(-1)
                cuts.append(0.0)
                children.append([-1, -1])
                depths.append(depths[cell] + 1)
        cell += 1
    spans = np.array(spans)
    return Tree(
        p=p[order],
        axis=np.array(axes),
        cut=np.array(cuts),
        children=np.array(children),
        first=spans[:, 0],
        last=spans[:, 1],
        low=np.array(lows),
        high=np.array(highs),
        depth=np.array(depths),
    )


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
    first, last, at = tree.first.tolist(), tree.last.tolist(), q.tolist()
    best, nearest, looked = np.inf, -1, 0
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
            best, nearest = float(away[k]), first[cell] + k
        while waiting and waiting[-1][1] >= best:
            passed += (waiting.pop()[0],)
        yield Visit(cell=cell, looked=looked, nearest=nearest, distance=best**0.5, passed=passed)


def looked_at(tree: Tree, q: Float[np.ndarray, "m d"]) -> Float[np.ndarray, " m"]:
    """Return how many points the search looks at for each query."""
    return np.array([float([visit.looked for visit in search(tree, one)][-1]) for one in q])
