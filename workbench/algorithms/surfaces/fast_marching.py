"""Fast marching on a square grid: a front that accepts nodes in the order of their distance.

Nodes are accepted band by band instead of one by one. Within a band the update is repeated until
nothing falls: the upwind equation has one solution, whatever the order, so that the values are
those of the one-by-one front.

Reference: Sethian, A fast marching level set method for monotonically advancing fronts, PNAS 93,
1996; Kim, An O(N) level set method for eikonal equations, SIAM J. Sci. Comput. 22, 2001 (groups of
nodes).
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float

from workbench.tracing import traced

Update = Callable[[np.ndarray, np.ndarray, float], np.ndarray]
Grid = Float[np.ndarray, "n m"]


def eikonal_update(
    a: Float[np.ndarray, " n"], b: Float[np.ndarray, " n"], h: float
) -> Float[np.ndarray, " n"]:
    """Return u of (u - a)^2 + (u - b)^2 = h^2, not below a or b: the distance of nodes.

    a is the smaller distance of the neighbours left and right, inf where neither has one, b of
    those above and below; one of the two is finite. Where they differ by the spacing h or more, the
    front comes along one axis: u = min(a, b) + h.

    Examples:
        >>> eikonal_update(np.array([1.0, 0.0]), np.array([1.0, 2.0]), 1.0).round(4).tolist()
        [1.7071, 1.0]
    """
    low = np.minimum(a, b)
    apart = np.minimum(np.maximum(a, b) - low, h)
    # apart = h, the front along one axis, gives low + h too: the root of h * h is h
    return low + (apart + np.sqrt(2 * h * h - apart * apart)) / 2


@dataclass(frozen=True, eq=False)
class March:
    """The front after a band.

    Attributes:
        d: Distances so far: final where accepted, tentative on trial, inf beyond.
        reach: Up to where all are accepted.
    """

    d: Grid
    accepted: Bool[np.ndarray, "n m"]
    reach: float

    @property
    def trial(self) -> Bool[np.ndarray, "n m"]:
        """Which nodes have a distance that may still fall."""
        return np.isfinite(self.d) & ~self.accepted


@traced
def march(
    start: Grid,
    free: Bool[np.ndarray, "n m"],
    h: float,
    *,
    band: float,
    update: Update = eikonal_update,
) -> Iterator[March]:
    """Yield the front from the nodes whose distance is known, until all in reach are accepted.

    Args:
        start: Distances of the first nodes, inf elsewhere: 0 at a source, or exact ones in a disc.
        free: Where the front can go.
        h: Spacing of the grid.
        band: How far the front goes from one state to the next.
        update: As `eikonal_update`. What is no number, or below both neighbours, is not taken.
    """
    n, m = start.shape
    # a rim that is never reached spares questions at the border
    d = np.full((n + 2, m + 2), np.inf)
    d[1:-1, 1:-1] = start
    inner = np.zeros((n + 2, m + 2), bool)
    inner[1:-1, 1:-1] = free
    flat = d.ravel()
    width = m + 2
    rows = slice(width, -width)  # without the rim's: places are counted in these
    own = flat[rows]
    open_ = (inner & ~np.isfinite(d)).ravel()[rows]  # may still fall; what was given stays
    steps = np.array([0, 2 * width, width - 1, width + 1])[:, None]  # to the neighbours, in flat
    left, right, below, above = (flat[step:] for step in steps.ravel())
    asked = np.zeros(flat.shape, bool)
    passed = -np.inf
    reach = 0.0
    yield March(start.copy(), np.isfinite(start), reach)
    while True:
        reach += band
        changed = np.flatnonzero((own > passed) & (own <= reach))
        for _ in range(n * m):  # values below the reach spread until none falls
            asked[steps + changed] = True
            at = (asked[rows] & open_).nonzero()[0]  # each once
            asked.fill(False)
            if not len(at):
                break
            a = np.minimum(left.take(at), right.take(at))
            b = np.minimum(below.take(at), above.take(at))
            updated = np.asarray(update(a, b, h), float)
            falls = updated < own.take(at) - 1e-12 * h
            falls &= updated >= np.minimum(a, b)
            fallen = at.compress(falls)
            lower = updated.compress(falls)
            own[fallen] = lower
            changed = fallen.compress(lower <= reach)
        passed = reach
        distances = d[1:-1, 1:-1].copy()
        yield March(distances, distances <= reach, reach)
        if not (np.isfinite(distances) & (distances > reach)).any():
            return
