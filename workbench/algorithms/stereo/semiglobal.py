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

CELLS_TOGETHER = 2**21  # of a volume: up to here directions are walked together


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
        """Return the narrowest number type that holds the sum of so many path costs, and P1."""
        most = paths * (self.top + self.P2) + self.P1
        if self.whole and most < 2**8:
            return np.dtype(np.uint8)
        if self.whole and most < 2**16:
            return np.dtype(np.uint16)
        return np.dtype(np.float32)


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
    across = sweep(by_column(cost), (0,), jumps)
    yield from (across[right, down].transpose(1, 2, 0) for down, right in DIRECTIONS[:2])
    del across
    along = {}
    to_come = list(DIRECTIONS[2:])
    for shifts in ((0, 1, -1),) if cost.size < CELLS_TOGETHER else ((0,), (1,), (-1,)):
        along |= sweep(by_row(cost), shifts, jumps)
        while to_come and to_come[0] in along:
            yield along.pop(to_come.pop(0)).transpose(1, 0, 2)


def path_costs(cost: Costs, direction: tuple[int, int], jumps: Jumps) -> Costs:
    """Return the path costs L_r(p, d) of one direction (rows down, columns right), by eq. 13."""
    down, right = direction
    if down:
        return sweep(by_row(cost), (right,), jumps)[direction].transpose(1, 0, 2)
    return sweep(by_column(cost), (0,), jumps)[right, down].transpose(1, 2, 0)


def sweep(
    cost: Real[np.ndarray, "n d w"], shifts: tuple[int, ...], jumps: Jumps
) -> dict[tuple[int, int], Real[np.ndarray, "n d w"]]:
    """Return the path costs by way (1: from the first line on, -1: back from the last) and shift:
    how many pixels to the right a path goes from one line to the next, 0, 1 or -1.

    All are walked side by side. With rise(d) = L(d) - min L of the pixel before, eq. 13 reads
    L(d) = C(d) + min(rise(d), rise(d +- 1) + P1, P2); it never exceeds top + P2, so bytes often do.
    A line is laid out flat, by d, then way, then pixel, with room for one d more at both ends: then
    every neighbour is the same array at another offset.
    """
    n, disparities, w = cost.shape
    kind = jumps.type_of_sum(1)
    P1 = kind.type(jumps.P1)
    lines = np.empty((n, disparities, 2, w), kind)
    lines[:, :, 0] = cost
    lines[:, :, 1] = lines[::-1, :, 0]
    limit = np.full((len(shifts), disparities, 2, w), jumps.P2, kind)
    for i, shift in enumerate(shifts):
        if shift:  # a path begins at the border, whatever lies before its first pixel in the layout
            limit[i, ..., 0 if shift > 0 else -1] = 0

    step = 2 * w  # to the next d
    cells = disparities * step
    first = step + 1
    rise = np.full((len(shifts), first + cells + first), jumps.P2, kind)
    rise[:, first : first + cells] = 0
    same, lower, higher = (
        rise[:, first + offset : first + offset + cells].reshape(limit.shape)
        for offset in (0, -step, step)
    )
    after = [  # where the pixels of the next line look for the rise of this one
        rise[i, first + shift : first + shift + cells].reshape(disparities, 2, w)
        for i, shift in enumerate(shifts)
    ]
    paths = np.empty((n, *limit.shape), kind)
    for C, L in zip(lines, paths, strict=True):
        np.minimum(lower, higher, out=L)
        L += P1
        np.minimum(L, same, out=L)
        np.minimum(L, limit, out=L)
        L += C  # L_r(p, d), eq. 13
        least = np.minimum.reduce(L, axis=1, keepdims=True)
        for i, rises in enumerate(after):
            np.subtract(L[i], least[i], out=rises)
    return {
        (way, shift): paths[::way, i, :, k]
        for i, shift in enumerate(shifts)
        for k, way in enumerate((1, -1))
    }


def energy(cost: Costs, disparity: Real[np.ndarray, "h w"], P1: float, *, P2: float) -> float:
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
    left = max(-right, 0)
    stop = w - max(right, 0)
    return values[: h - down, left:stop], values[down:, left + right : stop + right]
