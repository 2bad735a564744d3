"""The earth mover's distance, exact: the one-to-one matching with the least total distance.

Clouds are in one frame, metres. Each has mass 1, every point the same share; where the counts
differ a point's mass is split among several.

References: Rubner, Tomasi and Guibas, The earth mover's distance, 2000; Crouse, On implementing 2D
rectangular assignment algorithms, 2016 (scipy's solver); Peyre and Cuturi, Computational optimal
transport, 2019, sections 2.3 and 3.
"""

import functools
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import scipy
from jaxtyping import Bool, Float, Int

from workbench.algorithms.transport.sinkhorn import check_cost, kernel, sinkhorn, tight_potentials
from workbench.geometry.points.nearest import check_clouds

Cloud = Float[np.ndarray, "n 3"]

FEW_COPIES = 250
# entries of the cost where the counts differ: a linear programme, a few seconds
MOST_UNEQUAL = 250_000

_BLURS = ((0.05, 5), (0.01, 10), (0.002, 25))  # share of the median cost, sweeps
_FINER_BLURS = ((0.05, 20), (0.02, 30), (0.01, 50), (0.005, 80), (0.002, 100))
# of a linear programme: pairs up to which all are taken at once; else of each row and column at
# first, and in each of the rounds after
_FEW_PAIRS = 2_000
_FIRST = 12
_MORE = 12
# exponent of a sweep's scalings, 1 to below 2: at 1 the solver takes up to four times as long
_RELAXATION = 1.6
# columns that are cheapest to no row, since rows contend for the others: so many, and such a share
# of all, from which potentials gain more than they cost
_FEWEST = 90
_CONTESTED = 0.35


@dataclass(frozen=True, eq=False)
class TransportPlan:
    """A transport plan: pairs of a point of a and one of b, the mass that moves, and how far.

    Attributes:
        i_a, i_b: The pairs, as indices into the clouds, sorted by i_a.
        mass: Moved along each pair; all masses sum to 1.
        distances: Between the two points of each pair, metres.
    """

    i_a: Int[np.ndarray, "k"]
    i_b: Int[np.ndarray, "k"]
    mass: Float[np.ndarray, "k"]
    distances: Float[np.ndarray, "k"]

    @property
    def cost(self) -> float:
        """Mass times distance, summed, metres: the earth mover's distance if it is the best one."""
        return float(self.mass @ self.distances)


def earth_movers(p_a: Float[np.ndarray, "n 3"], p_b: Float[np.ndarray, "m 3"]) -> float:
    """Return the mean distance travelled under the best one-to-one matching, metres.

    It is a metric between clouds of equal mass.

    Raises:
        ValueError: If a cloud is empty or not finite, or counts differ and are too large.

    Reference: Fan, Su and Guibas, A Point Set Generation Network, 2017, equation 2, as a mean.

    Examples:
        >>> p_a = np.array([[0.0, 0, 0], [1, 0, 0]])
        >>> earth_movers(p_a, p_a[::-1] + np.array([0.0, 0.0, 0.5]))  # rows in any order
        0.5
    """
    return best_matching(p_a, p_b).cost


def earth_movers_gradient(p_a: Cloud, p_b: Float[np.ndarray, "m 3"]) -> Cloud:
    """Return the gradient of `earth_movers` by p_a: unit vectors from the partners times mass.

    A pair that coincides has no direction and counts as zero, which is one of its subgradients.
    """
    best = best_matching(p_a, p_b)
    v = p_a[best.i_a] - p_b[best.i_b]
    v *= np.divide(
        best.mass, best.distances, out=np.zeros_like(best.mass), where=best.distances > 0
    )[:, None]
    return np.stack(
        [np.bincount(best.i_a, v[:, axis], minlength=len(p_a)) for axis in range(3)], axis=1
    )


def blurred_earth_movers(
    p_a: Float[np.ndarray, "n 3"],
    p_b: Float[np.ndarray, "m 3"],
    regularisation: float,
    *,
    max_sweeps: int = 10_000,
    tolerance: float = 1e-9,
) -> float:
    """Return the mean distance under Sinkhorn's blurred plan, metres: never below `earth_movers`.

    A plan whose sums are not yet right to `tolerance` may cost too little by the missing mass.

    Raises:
        ValueError: If a cloud is empty or not finite, or the regularisation is not positive.
    """
    check_clouds(p_a, p_b)
    distances = scipy.spatial.distance.cdist(p_a, p_b)
    return sinkhorn(distances, regularisation, max_sweeps=max_sweeps, tolerance=tolerance).cost(
        distances
    )


def best_matching(p_a: Float[np.ndarray, "n 3"], p_b: Float[np.ndarray, "m 3"]) -> TransportPlan:
    """Return a matching with the least total distance.

    Raises:
        ValueError: If a cloud is empty or not finite, or counts differ and are too large.
    """
    check_clouds(p_a, p_b)
    a, b = ((np.asarray(p, float).tobytes(), p.shape) for p in (p_a, p_b))
    return _matched(a, b)


@functools.lru_cache(maxsize=8)
def _matched(a: tuple[bytes, tuple[int, ...]], b: tuple[bytes, tuple[int, ...]]) -> TransportPlan:
    """Return the best matching of clouds, each as bytes and shape; kept: who asks how far two
    clouds are apart asks for it again.
    """
    p_a, p_b = (np.frombuffer(content).reshape(shape) for content, shape in (a, b))
    distances = scipy.spatial.distance.cdist(p_a, p_b)
    if len(p_a) == len(p_b):
        i_a, i_b = best_assignment(distances)
        mass = np.full(len(p_a), 1 / len(p_a))
    else:
        i_a, i_b, mass = best_plan(distances)
    plan = TransportPlan(i_a, i_b, mass, distances[i_a, i_b])
    for array in (plan.i_a, plan.i_b, plan.mass, plan.distances):
        array.setflags(write=False)
    return plan


def best_assignment(
    cost: Float[np.ndarray, "n m"],
) -> tuple[Int[np.ndarray, "n"], Int[np.ndarray, "n"]]:
    """Return rows and columns of the one-to-one assignment with the least total cost.

    Subtracting a number from a row or a column changes every assignment's total alike. Numbers
    close to the optimal dual potentials leave costs of which the best assignment uses only
    near-zeros, which the solver finds several times sooner; blurred transport gives such numbers
    cheaply. Where nearly each row has a cheapest column of its own the solver is quick without
    them.

    Raises:
        ValueError: If the cost is empty, not square, not finite or too large.
    """
    check_cost(cost)
    if cost.shape[0] != cost.shape[1]:
        raise ValueError(
            f"one to one needs as many columns as rows, not {cost.shape[0]} x {cost.shape[1]}"
        )
    share = contested(cost)
    if share >= _CONTESTED and share * len(cost) >= _FEWEST:
        f, g = tight_potentials(cost, blurred_potentials(cost))
        cost = cost - f[:, None]
        cost -= g
    i, j = scipy.optimize.linear_sum_assignment(cost)
    return i.astype(np.intp), j.astype(np.intp)  # int64 even where indices have 32 bits


def best_plan(
    cost: Float[np.ndarray, "n m"],
) -> tuple[Int[np.ndarray, "k"], Int[np.ndarray, "k"], Float[np.ndarray, "k"]]:
    """Return rows, columns and masses of the cheapest plan from n equal masses to m equal masses.

    Where a few copies of rows and columns make the counts equal, their assignment is the answer;
    otherwise a linear programme is.

    Raises:
        ValueError: If the cost has more than MOST_UNEQUAL entries.

    Reference: Peyre and Cuturi 2019, equation 2.11 (the programme) and section 2.3.
    """
    n, m = cost.shape
    if cost.size > MOST_UNEQUAL:
        raise ValueError(
            f"exact transport between {n} and {m} points is too large: take equal counts, at most"
            f" {MOST_UNEQUAL:,} pairs, or blurred transport"
        )
    copies = int(np.lcm(n, m))
    # below, the assignment is the faster of the two
    if copies <= max(FEW_COPIES, 5 * np.sqrt(cost.size)):
        i, j = best_assignment(cost.repeat(copies // n, axis=0).repeat(copies // m, axis=1))
        times = np.zeros((n, m))
        np.add.at(times, (i // (copies // n), j // (copies // m)), 1)
        plan = times / copies
    else:
        plan = best_plan_by_programme(cost)
    i_a, i_b = np.nonzero(plan > 1e-9 / max(n, m))
    return i_a, i_b, plan[i_a, i_b]


def best_plan_by_programme(cost: Float[np.ndarray, "n m"]) -> Float[np.ndarray, "n m"]:
    """Return the cheapest plan by a linear programme: row and column sums are its constraints.

    It begins with the pairs that blurred transport finds likely, and takes in those whose cost is
    below the sum of the prices (dual potentials) of their row and column, until there are none:
    then no pair that was left out could make the plan cheaper.

    Raises:
        ValueError: If the solver finds no solution.

    References: Peyre and Cuturi 2019, equation 2.11 and proposition 3.3 (complementary
    slackness); Dantzig and Wolfe, Decomposition principle for linear programs, 1960 (columns by
    their prices).
    """
    taken, left = _likely(cost)
    tolerance = 1e-11 * cost.max()
    while True:
        plan, f, g = _solved(left, taken)
        left = left - f[:, None] - g  # the solver needs half as many steps where most are near zero
        gain = np.where(taken, 0.0, left)
        cheap = gain < -tolerance
        if not cheap.any():
            return plan
        taken |= cheap & _lowest(gain, _MORE)


def _likely(
    cost: Float[np.ndarray, "n m"],
) -> tuple[Bool[np.ndarray, "n m"], Float[np.ndarray, "n m"]]:
    """Return the pairs that a programme begins with, and the costs less potentials near the best.

    All pairs of few; else those that are near the best by blurred potentials, and enough of others
    that some plan exists.
    """
    n, m = cost.shape
    if cost.size <= _FEW_PAIRS:
        return np.ones(cost.shape, bool), cost
    f, g = tight_potentials(cost, blurred_potentials(cost, _FINER_BLURS))
    left = cost - f[:, None] - g
    likely = _lowest(left, _FIRST)
    ends = np.union1d(np.arange(n) * m, np.arange(m) * n)  # both masses laid along one line, n m
    likely[ends // m, ends // n] = True
    return likely, left


def _lowest(values: Float[np.ndarray, "n m"], count: int) -> Bool[np.ndarray, "n m"]:
    """Return which entries are among so many lowest of their row or of their column."""
    is_low = np.zeros(values.shape, bool)
    for axis in (0, 1):
        few = min(count, values.shape[axis])
        lowest = np.argpartition(values, few - 1, axis).take(np.arange(few), axis)
        np.put_along_axis(is_low, lowest, True, axis)
    return is_low


def _solved(
    cost: Float[np.ndarray, "n m"], taken: Bool[np.ndarray, "n m"]
) -> tuple[Float[np.ndarray, "n m"], Float[np.ndarray, "n"], Float[np.ndarray, "m"]]:
    """Return the cheapest plan that uses these pairs alone, and its dual potentials."""
    n, m = cost.shape
    i, j = np.nonzero(taken)
    pair = np.arange(len(i))
    places = np.concatenate([i, n + j]), np.concatenate([pair, pair])
    sums: Any = scipy.sparse.csc_array((np.ones(2 * len(i)), places), shape=(n + m, len(i)))
    masses = np.concatenate([np.full(n, 1 / n), np.full(m, 1 / m)])
    solved: Any = scipy.optimize.linprog(
        cost[i, j], A_eq=sums, b_eq=masses, method="highs-ds", options={"presolve": False}
    )
    if solved.x is None:
        raise ValueError(
            f"the transport between {n} and {m} points was not solved: {solved.message}"
        )
    plan = np.zeros(cost.shape)
    plan[i, j] = solved.x
    return plan, solved.eqlin.marginals[:n], solved.eqlin.marginals[n:]


def contested(cost: Float[np.ndarray, "n m"]) -> float:
    """Return the share of the columns that are the cheapest of no row."""
    return 1 - len(np.unique(cost.argmin(axis=1))) / cost.shape[1]


def blurred_potentials(
    cost: Float[np.ndarray, "n m"], blurs: Sequence[tuple[float, int]] = _BLURS
) -> Float[np.ndarray, "m"]:
    """Return column potentials near the best: overrelaxed Sinkhorn sweeps at ever smaller blur.

    Args:
        blurs: Each a share of the median cost, and its sweeps.

    Single precision will do, since any numbers leave the best assignment the best. The products are
    taken row by row (`vecdot`), because a matrix product that is spread over threads waits for all
    of them on a machine with other work.

    Reference: Thibault, Chizat, Dossal and Papadakis, Overrelaxed Sinkhorn-Knopp algorithm for
    regularized optimal transport, 2021, equation 12.
    """
    rough = cost.astype(np.float32)
    typical = np.median(rough[:: 1 + len(rough) // 300])
    g = np.zeros(rough.shape[1], np.float32)
    rows_to_a_column = len(rough) / len(g)
    for blur, sweeps in blurs if typical > 0 else ():
        regularisation = float(blur * typical)
        f, g = tight_potentials(rough, g)
        K = kernel(rough, f, g, regularisation=regularisation)
        K_transposed = np.ascontiguousarray(K.T)
        u, v = np.ones_like(f), np.ones_like(g)
        with np.errstate(over="ignore", divide="ignore", invalid="ignore"):
            for _ in range(sweeps):
                u *= (u * np.vecdot(K, v)) ** -_RELAXATION
                v *= (v * np.vecdot(K_transposed, u) / rows_to_a_column) ** -_RELAXATION
        # overrelaxed scalings may run away; what was found before will do
        if not (np.isfinite(v) & (v > 0)).all():
            break
        g = g + regularisation * np.log(v)
    return g.astype(float)
