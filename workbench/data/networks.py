"""Graphs with known answers: clubs, lumps with a bridge, rings, grids, pairs hard to tell apart.

Places are metres, flat ones at z = 0.
"""

from dataclasses import dataclass, field

import numpy as np
from jaxtyping import Float, Int

from workbench.geometry.graphs import graph_of, hops
from workbench.geometry.graphs.embedding import stress_layout

# Actor: neighbours of a higher number x in how many contexts outside the club the two met.
_KARATE = (
    "0:1x4 2x5 3x3 4x3 5x3 6x3 7x2 8x2 10x2 11x3 12x1 13x3 17x2 19x2 21x2 31x2; 1:2x6 3x3 7x4 13x5"
    " 17x1 19x2 21x2 30x2; 2:3x3 7x4 8x5 9x1 13x3 27x2 28x2 32x2; 3:7x3 12x3 13x3; 4:6x2 10x3;"
    " 5:6x5 10x3 16x3; 6:16x3; 8:30x3 32x3 33x4; 9:33x2; 13:33x3; 14:32x3 33x2; 15:32x3 33x4;"
    " 18:32x1 33x2; 19:33x1; 20:32x3 33x1; 22:32x2 33x3; 23:25x5 27x4 29x3 32x5 33x4; 24:25x2 27x3"
    " 31x2; 25:31x7; 26:29x4 33x2; 27:33x4; 28:31x2 33x2; 29:32x4 33x2; 30:32x3 33x3; 31:32x4 33x4;"
    " 32:33x5; "
)
_RIGHT = np.array([1.0, 0.0, 0.0])
_WITH_THE_INSTRUCTOR = (0, 1, 2, 3, 4, 5, 6, 7, 8, 10, 11, 12, 13, 16, 17, 19, 21)


@dataclass(frozen=True, eq=False, kw_only=True)
class Network:
    """A graph whose nodes have places to be drawn at.

    Attributes:
        edges: Each edge once.
        classes: Which of two groups each node truly belongs to; empty where there is no such truth.
        eigenvalues: Of the unweighted Laplacian in closed form, ascending; empty where there is
            none.
    """

    p: Float[np.ndarray, "n 3"]
    edges: Int[np.ndarray, "e 2"]
    weights: Float[np.ndarray, " e"]
    classes: Int[np.ndarray, " _"] = field(default_factory=lambda: np.empty(0, int))
    eigenvalues: Float[np.ndarray, " _"] = field(default_factory=lambda: np.empty(0))


def karate(weighted: bool = False) -> Network:
    """Return Zachary's karate club: 34 members, 78 friendships, and the club each joined.

    Class 0 joined the instructor's (node 0, "Mr. Hi"), class 1 the officers' (node 33). Node 8
    sided with the officers and yet joined the instructor's club: its class is 0. Weights are in how
    many contexts two members met.

    Reference: Zachary, An information flow model for conflict and fission in small groups, Journal
    of Anthropological Research 33, 1977, figures 1 to 3, tables 1 and 3; the corrected matrix of 78
    edges, as networkx has it.
    """
    rows = [row.split(":") for row in "".join(_KARATE).split("; ") if row]
    table = np.array(
        [(int(a), *map(int, pair.split("x"))) for a, others in rows for pair in others.split()]
    )
    edges = table[:, :2]
    weights = table[:, 2].astype(float)
    classes = np.ones(34, dtype=int)
    classes[list(_WITH_THE_INSTRUCTOR)] = 0
    return Network(
        p=drawn(edges, 34),
        edges=edges,
        weights=weights if weighted else np.ones(len(edges)),
        classes=classes,
    )


def drawn(
    edges: Int[np.ndarray, "e 2"], count: int, width: float = 2.4
) -> Float[np.ndarray, "n 3"]:
    """Return places in the plane for nodes: as far apart as they are in edges, `width` m at most.

    Nodes out of each other's reach count as two edges farther apart than any others.
    """
    if count < 2:
        return np.zeros((count, 3))
    apart = hops(graph_of(edges, count))
    known = apart[np.isfinite(apart)].max()
    xy = stress_layout(np.where(np.isfinite(apart), apart, known + 2.0), 2)
    xy = xy - (xy.min(axis=0) + xy.max(axis=0)) / 2
    return np.column_stack([xy * width / max(np.ptp(xy, axis=0).max(), 1e-9), np.zeros(count)])


def dumbbell(
    count: int, share: float, bridge: int, *, rng: np.random.Generator
) -> tuple[np.ndarray, np.ndarray]:
    """Return points of two round lumps, 2 m apart, with a row between them; and 0 left, 1 right.

    Args:
        share: What part of the points is on the left.
        bridge: How many points the row has; 0 leaves a gap, half a metre wider.
    """
    left = round(share * count)
    lumps = rng.normal(size=(count, 2)) * 0.25 + np.where(np.arange(count) < left, -1.0, 1.0)[
        :, None
    ] * [
        1.0 if bridge else 1.25,
        0,
    ]
    row = np.column_stack([np.linspace(-0.8, 0.8, bridge), 0.02 * rng.normal(size=bridge)])
    xy = np.concatenate([lumps, row])
    classes = np.concatenate([np.arange(count) >= left, row[:, 0] > 0]).astype(int)
    return np.column_stack([xy, np.zeros(len(xy))]), classes


def ring(count: int) -> Network:
    """Return a cycle of nodes; the eigenvalues of its Laplacian are 2 - 2 cos(2 pi j / n).

    Reference: Spielman, Spectral and algebraic graph theory, 2019, section 6.5.
    """
    p, edges = _cycle(count, 1.0)
    values = np.sort(2 - 2 * np.cos(2 * np.pi * np.arange(count) / count))
    return Network(p=p, edges=edges, weights=np.ones(count), eigenvalues=values)


def grid(columns: int, rows: int) -> Network:
    """Return a grid of nodes; its eigenvalues are sums of two paths', 2 - 2 cos(pi j / n).

    Reference: Spielman 2019, sections 6.3 (products) and 6.6 (paths).
    """
    x, y = (part.ravel() for part in np.meshgrid(np.arange(columns), np.arange(rows)))
    node = np.arange(columns * rows)
    width = max(columns, rows)
    edges = np.concatenate([[node, node + 1], [node, node + columns]], axis=1).T
    edges = edges[np.concatenate([x < columns - 1, y < rows - 1])]
    paths = [2 - 2 * np.cos(np.pi * np.arange(n) / n) for n in (columns, rows)]
    p = np.column_stack([x - (columns - 1) / 2, y - (rows - 1) / 2, np.zeros(len(x))]) * 2 / width
    values = np.sort(np.add.outer(*paths).ravel())
    return Network(p=p, edges=edges, weights=np.ones(len(edges)), eigenvalues=values)


def star_and_square() -> Network:
    """Return a star of five nodes, class 0, and a square with a lone node: they have one spectrum.

    Reference: Cvetkovic, Doob and Sachs, Spectra of graphs, 1980, section 6.1.
    """
    square, edges = _cycle(4, 0.6)
    star = np.concatenate([[[0.0, 0, 0]], square])
    p = np.concatenate([star - 0.8 * _RIGHT, square + 0.8 * _RIGHT, [0.8 * _RIGHT]])
    edges = np.concatenate([[[0, k] for k in (1, 2, 3, 4)], edges + 5])
    return Network(p=p, edges=edges, weights=np.ones(len(edges)), classes=np.repeat([0, 1], 5))


def hexagon_and_triangles() -> Network:
    """Return a hexagon, class 0, and two triangles: every node has two neighbours.

    Reference: Xu, Hu, Leskovec and Jegelka, How powerful are graph neural networks?, ICLR 2019,
    section 5.
    """
    (hexagon, around), (triangle, third) = _cycle(6, 0.6), _cycle(3, 0.45)
    p = np.concatenate(
        [
            hexagon - 0.9 * _RIGHT,
            triangle + np.array([0.75, 0.5, 0]),
            triangle + np.array([0.75, -0.5, 0]),
        ]
    )
    edges = np.concatenate([around, third + 6, third + 9])
    return Network(p=p, edges=edges, weights=np.ones(12), classes=np.repeat([0, 1], 6))


def _cycle(count: int, radius: float) -> tuple[np.ndarray, np.ndarray]:
    turn = 2 * np.pi * np.arange(count) / count
    node = np.arange(count)
    p = radius * np.column_stack([np.cos(turn), np.sin(turn), np.zeros(count)])
    return p, np.column_stack([node, (node + 1) % count])
