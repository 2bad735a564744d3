"""Semi-global matching: smooth a cost volume along eight straight paths and add the paths up.

The map sought minimises E(D) = sum_p C(p, D_p) + sum over neighbours of P1 [|step| = 1] + P2
[|step| > 1]: a slope of one disparity is cheap, a jump costs P2 however high it is. In two
dimensions that is NP-hard; along one line it is a shortest path, and the sum over eight lines that
meet in a pixel approximates the minimum. Infinite cells of C count as the worst finite one.

Reference: Hirschmueller, Stereo processing by semiglobal matching and mutual information, PAMI
2008, section 2.2; equation numbers are that paper's.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from jaxtyping import Real

from workbench.tracing import traced

Costs = Real[np.ndarray, "d h w"]

DIRECTIONS = ((0, 1), (0, -1), (1, 0), (-1, 0), (1, 1), (-1, -1), (1, -1), (-1, 1))
"""The eight steps (rows down, columns right) from one pixel of a path to the next."""

CELLS_TOGETHER = 2**21  # of a volume: up to here all slopes are walked together


@dataclass(frozen=True, eq=False)
class PathSum:
    """The path costs of all directions so far.

    Attributes:
        direction: The step (rows down, columns right) of the direction just added.
        path: L_r(p, d), its own path costs.
        total: S(p, d), the sum over the directions so far.
    """

    direction: tuple[int, int]
    path: Costs
    total: Costs


@traced
def semi_global(cost: Costs, P1: float, P2: float) -> Iterator[PathSum]:
    """Yield the sum of path costs after each of the eight directions.

    P1 and P2 are rounded where the cost is whole numbers.

    Raises:
        ValueError: Unless 0 <= P1 <= P2.
    """
    cost, jumps = prepare(cost, P1, P2)
    total = np.zeros(cost.shape, jumps.type_of_sum(len(DIRECTIONS)))
    for direction, path in zip(DIRECTIONS, _all_paths(cost, jumps), strict=True):  # L_r, eq. 13
        total = total + path  # S = sum over r of L_r, eq. 14
        yield PathSum(direction, path, total)


@dataclass(frozen=True)
class Jumps:
    """The penalties, and the largest matching cost; no path cost is above top + P2."""

    P1: float
    P2: float
    top: float
    whole: bool

    def type_of_sum(self, paths: int) -> np.dtype:
        """Return the narrowest number type that holds the sum of so many path costs."""
        most = paths * (self.top + self.P2)
        whole = np.uint8 if most < 2**8 else np.uint16 if most < 2**16 else np.float32
        return np.dtype(whole if self.whole else np.float32)


def prepare(cost: Costs, P1: float, P2: float) -> tuple[Costs, Jumps]:
    """Return the cost for the sweeps: whole numbers as they are, others as finite float32.

    Raises:
        ValueError: Unless 0 <= P1 <= P2.
    """
    if not 0 <= P1 <= P2:
        raise ValueError(f"the penalties must satisfy 0 <= P1 <= P2, got {P1} and {P2}")
    if cost.dtype.kind == "u":
        return cost, Jumps(float(round(P1)), float(round(P2)), float(cost.max()), True)
    top = _largest_finite(cost)
    return np.minimum(cost, top).astype(np.float32), Jumps(P1, P2, top, False)


def _all_paths(cost: Costs, jumps: Jumps) -> Iterator[Costs]:
    """Yield the path costs of all directions, in their order."""
    for both in sweep(by_column(cost), (0,), jumps):
        yield from (path.transpose(1, 2, 0) for path in both)
    slopes = (0, 1, -1)
    for some in (slopes,) if cost.size < CELLS_TOGETHER else tuple((slope,) for slope in slopes):
        for both in sweep(by_row(cost), some, jumps):
            yield from (path.transpose(1, 0, 2) for path in both)


def path_costs(cost: Costs, direction: tuple[int, int], jumps: Jumps) -> Costs:
    """Return the path costs L_r(p, d) of one direction (rows down, columns right), by eq. 13."""
    down, right = direction
    if down:
        ends = next(sweep(by_row(cost), (right * down,), jumps))
        return ends[0 if down > 0 else 1].transpose(1, 0, 2)
    ends = next(sweep(by_column(cost), (0,), jumps))
    return ends[0 if right > 0 else 1].transpose(1, 2, 0)


def sweep(
    cost: Real[np.ndarray, "n d w"], slopes: tuple[int, ...], jumps: Jumps
) -> Iterator[tuple[np.ndarray, np.ndarray]]:
    """Yield of each slope the path costs (n, d, w) from the first line on, and back from the last.

    A slope is how many columns right the path goes per line: 0, 1 or -1; back it is the other way.
    All are walked side by side. With carried(d) = min(L(d) - min L, P2) of the pixel before, eq. 13
    reads L(d) = C(d) + min(carried(d), carried(d +- 1) + P1); it never exceeds top + P2, so bytes
    often do. A line is laid out flat, d by d, with one spare column and a spare d at both ends:
    then every neighbour is the same array at another offset.
    """
    n, disparities, w = cost.shape
    row = w + 1
    start, stop = row + 1, row + 1 + disparities * row
    padded = np.zeros((n, disparities, row), jumps.type_of_sum(1))
    padded[..., :w] = cost
    P1 = padded.dtype.type(jumps.P1)
    limit = np.full((disparities, row), jumps.P2, padded.dtype)
    limit[:, w] = 0  # nothing is carried from beyond the border: a path begins there
    carried = np.zeros((len(slopes), 2, stop + row + 1), padded.dtype)
    carried[..., :row], carried[..., stop:] = jumps.P2, jumps.P2
    same, lower, higher = (
        carried[..., start + shift : stop + shift].reshape(*carried.shape[:2], disparities, row)
        for shift in (0, -row, row)
    )
    after = [  # where the pixels of the next line look for what this one carries
        (here, carried[*here, start + shift : stop + shift].reshape(disparities, row))
        for i, slope in enumerate(slopes)
        for here, shift in (((i, 0), slope), ((i, 1), -slope))
    ]
    paths = np.empty((n, len(slopes), 2, disparities, row), padded.dtype)
    above = np.empty_like(paths[0])
    for line, L in enumerate(paths):
        np.minimum(lower, higher, out=L)
        L += P1
        np.minimum(L, same, out=L)
        L[:, 0] += padded[line]  # L_r(p, d), eq. 13
        L[:, 1] += padded[-1 - line]
        np.subtract(L, np.minimum.reduce(L, axis=2, keepdims=True), out=above)
        for here, carries in after:
            np.minimum(above[here], limit, out=carries)
    for i in range(len(slopes)):
        yield paths[:, i, 0, :, :w], paths[::-1, i, 1, :, :w]


def energy(cost: Costs, disparity: Real[np.ndarray, "h w"], P1: float, P2: float) -> float:
    """Return E(D) of eq. 11 per known pixel of a disparity map.

    Every pair among the eight neighbours counts once, at the nearest whole disparity; NaN is
    unknown and left out.
    """
    known = np.isfinite(disparity)
    if not known.any():
        return 0.0
    nearest = np.rint(np.where(known, disparity, 0)).astype(np.intp)
    matching = np.take_along_axis(cost, nearest[None], axis=0)[0][known]
    total = float(np.minimum(matching, _largest_finite(cost)).sum(dtype=float))
    for down, right in ((0, 1), (1, 0), (1, 1), (1, -1)):
        a, b = _neighbours(nearest, down, right)
        step = np.abs(a - b)[np.logical_and(*_neighbours(known, down, right))]
        total += P1 * float(np.count_nonzero(step == 1)) + P2 * float(np.count_nonzero(step > 1))
    return total / float(known.sum())


def by_row(volume: np.ndarray) -> np.ndarray:
    """Return a view of a volume (d, h, w) as its rows (h, d, w)."""
    return volume.transpose(1, 0, 2)


def by_column(volume: np.ndarray) -> np.ndarray:
    """Return a view of a volume (d, h, w) as its columns (w, d, h)."""
    return volume.transpose(2, 0, 1)


def _largest_finite(cost: np.ndarray) -> float:
    if cost.dtype.kind == "u":
        return float(cost.max())
    return float(np.max(cost, initial=0.0, where=np.isfinite(cost)))


def _neighbours(values: np.ndarray, down: int, right: int) -> tuple[np.ndarray, np.ndarray]:
    """Return the values of both pixels of all pairs that are one such step apart."""
    h, w = values.shape
    left, stop = max(-right, 0), w - max(right, 0)
    return values[: h - down, left:stop], values[down:, left + right : stop + right]
