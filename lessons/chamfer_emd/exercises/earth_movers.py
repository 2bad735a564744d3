"""Write the exact earth mover's distance: the mean distance under the best one-to-one matching. The
right flow goes down your function; only a true matching spreads the cloud evenly over the target.
"""

import itertools

import numpy as np
from jaxtyping import Float

from lessons.chamfer_emd.exercises import (
    PAIR,
    STUDENTS,
    Cloud,
    all_distances,
    two_clouds,
    value_verdict,
)
from lessons.chamfer_emd.exercises import chamfer as two
from lessons.chamfer_emd.exercises import one_sided as one
from workbench.algorithms.transport import exact as transport
from workbench.exercise import (
    Function,
    Verdict,
    alternative,
    check,
    contract,
    left_alone,
    mistake,
    worst,
)


@contract(
    slot="earth_movers",
    forbid=("scipy.stats",),
    examples=(
        (f"earth_movers({PAIR}, np.array([[1.0, 0, 0.5], [0, 0, 0.5]]))", "0.5"),
        (f"earth_movers({PAIR}, np.array([[0.0, 0, 0]]))", "0.5"),
    ),
)
def earth_movers(p_a: Float[np.ndarray, "n 3"], p_b: Float[np.ndarray, "m 3"]) -> float:
    """Return the earth mover's distance: the mean distance travelled under the best one-to-one
    matching.

    For n = m: min over all permutations of (1 / n) sum_i |a_i - b_perm(i)|, exact, with plain
    distances (no squares). The best permutation is an assignment problem;
    scipy.optimize.linear_sum_assignment solves it.

    Each cloud weighs 1, each of its points the same share. Where the counts differ, points are
    split: repeat every point of a and of b so often that both clouds have as many points as the
    least common multiple of n and m, and match those.

    Args:
        p_a: n points, metres; the order of rows means nothing.
        p_b: m points in the same frame; the counts may differ.

    Returns:
        Metres. The same with a and b exchanged; 0 only where both clouds have the same points with
        the same shares.

    Raises:
        ValueError: If a cloud has no points.
    """
    return transport.earth_movers(p_a, p_b)


MOVER_HINT = "The one-to-one matching with the least total of plain distances; their mean."


def mover_found(candidate: Function, p_a: Cloud, p_b: Cloud, label: str = "") -> Verdict:
    """Judge by ours, which is exact."""
    return value_verdict(
        candidate(p_a, p_b), transport.earth_movers(p_a, p_b), "m", MOVER_HINT, label
    )


@check(2)
def short_pairs_can_cost(candidate: Function) -> Verdict:
    """Points at 0 and 1 m go to 0.9 and 1.9 m: 0.9 m each, though 1 and 0.9 are so close."""
    p_a = np.array([[0.0, 0, 0], [1, 0, 0]])
    p_b = np.array([[0.9, 0, 0], [1.9, 0, 0]])
    return value_verdict(candidate(p_a, p_b), 0.9, "m", MOVER_HINT)


@check(2)
def two_lumps(candidate: Function) -> Verdict:
    """Two clouds of 40 points have the distance of their best matching, whichever comes first."""
    p_a, p_b = two_clouds(STUDENTS + 20, 40, 40)
    return worst(
        (mover_found(candidate, p_a, p_b, "a, b: "), mover_found(candidate, p_b, p_a, "b, a: "))
    )


@check(1)
def shares_are_split(candidate: Function) -> Verdict:
    """Two points at 0 and 3 m, three at 0, 1 and 3 m: half a metre, and nobody is left out."""
    p_a = np.array([[0.0, 0, 0], [3, 0, 0]])
    p_b = np.array([[3.0, 0, 0], [0, 0, 0], [1, 0, 0]])
    hint = (
        "A sixth of the mass goes 1 m, a sixth 2 m: take each point of a three times, each of b"
        " twice."
    )
    return value_verdict(candidate(p_a, p_b), 0.5, "m", hint)


@check(1)
def twice_as_large(candidate: Function) -> Verdict:
    """Twice the size is twice the distance."""
    p_a, p_b = two_clouds(STUDENTS + 21, 25, 25)
    return value_verdict(
        candidate(2 * p_a, 2 * p_b), 2 * transport.earth_movers(p_a, p_b), "m", MOVER_HINT
    )


@check(1)
def movers_clouds_are_left_alone(candidate: Function) -> Verdict:
    """The clouds that come in are not changed."""
    return left_alone(candidate, mover_found(candidate, *two_clouds(STUDENTS + 22, 15, 15)))


def repeated(p_a: np.ndarray, p_b: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return both clouds with each point as often as makes the counts equal."""
    if min(len(p_a), len(p_b)) == 0:
        raise ValueError("no points")
    k = int(np.lcm(len(p_a), len(p_b)))
    return np.repeat(p_a, k // len(p_a), axis=0), np.repeat(p_b, k // len(p_b), axis=0)


def matched(cost: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return rows and columns of the cheapest assignment."""
    from scipy.optimize import linear_sum_assignment

    return linear_sum_assignment(cost)


@mistake(
    "You paired points with the same row number. The order of rows means nothing: search for the"
    " matching with the least total distance."
)
def paired_by_row(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """Row k to row k."""
    a, b = repeated(p_a, p_b)
    return np.linalg.norm(a - b, axis=1).mean()


@mistake(
    "You took the distance to the nearest point. Several points of a then share one of b; the earth"
    " mover's distance matches one to one."
)
def nearest_neighbours(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """Mean distance to the nearest, from a."""
    return one.not_squared(p_a, p_b)


@mistake(
    "You took nearest neighbours both ways: that is a Chamfer distance, blind to density. Match one"
    " to one."
)
def nearest_both_ways(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """Chamfer of distances, halved."""
    return two.not_squared(p_a, p_b) / 2


@mistake(
    "You gave each point of a, row by row, the nearest partner that was left. Who comes late has"
    " far to go: the best matching has the least total."
)
def greedy_by_row(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """First come, first served."""
    a, b = repeated(p_a, p_b)
    D = all_distances(a, b)
    total = 0.0
    for row in D:
        j = int(np.argmin(row))
        total += row[j]
        D[:, j] = np.inf
    return total / len(a)


@mistake(
    "You matched the closest pair first, then the next closest. A short pair early can force a long"
    " one late: only the total counts."
)
def closest_pair_first(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """The closest pair first."""
    a, b = repeated(p_a, p_b)
    D = all_distances(a, b)
    total = 0.0
    for _ in a:
        i, j = np.unravel_index(np.argmin(D), D.shape)
        total += D[i, j]
        D[i], D[:, j] = np.inf, np.inf
    return total / len(a)


@mistake(
    "You sorted both clouds along x and paired them. That is the best matching on a line only; in"
    " space, assign."
)
def sorted_along_x(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """What is right on a line."""
    a, b = repeated(p_a, p_b)
    return np.linalg.norm(a[np.argsort(a[:, 0])] - b[np.argsort(b[:, 0])], axis=1).mean()


@mistake(
    "You returned the total distance. Each cloud has mass 1, each point of a carries 1 / n of it:"
    " divide by n."
)
def sum_for_mean(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """The sum over the points of a."""
    return len(p_a) * earth_movers_of_copies(p_a, p_b)


@mistake(
    "You minimised squares and returned their mean, in square metres. The earth mover's distance"
    " sums plain distances, in metres."
)
def squares(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """Square metres."""
    a, b = repeated(p_a, p_b)
    squares = all_distances(a, b) ** 2
    return squares[matched(squares)].mean()


@mistake(
    "You minimised squares and took the root: that is the 2-Wasserstein distance. The earth mover's"
    " distance is the mean of plain distances."
)
def root_mean_square(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """The other Wasserstein distance."""
    return np.sqrt(squares(p_a, p_b))


@mistake(
    "You measure distances, but of the matching that is best for squares. Minimise what you"
    " measure: distances."
)
def matched_by_squares(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """The matching of least squares, measured in metres."""
    a, b = repeated(p_a, p_b)
    D = all_distances(a, b)
    return D[matched(D**2)].mean()


@mistake(
    "All is right but unequal counts: a rectangular assignment leaves points of the larger cloud"
    " out. Repeat points until both clouds have the same count."
)
def points_left_out(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """Rectangular assignment."""
    D = all_distances(p_a, p_b)
    return D[matched(D)].mean()


@mistake(
    "You used Sinkhorn with a blur of 5 % of the largest distance. Fast is not exact: entropy"
    " spreads the plan. Solve the assignment."
)
def blurred(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """Sinkhorn with a blur of 5 % of the largest distance."""
    D = all_distances(p_a, p_b)
    blur = 0.05 * D.max() + 1e-12
    K = np.exp(-D / blur)
    u = np.ones(len(p_a))
    v = np.ones(len(p_b))
    for _ in range(100):
        u = 1 / len(p_a) / (K @ v)
        v = 1 / len(p_b) / (K.T @ u)
    return float(np.sum(u[:, None] * K * v * D))


@mistake(
    "You measured between the centroids. That is the least any matching can cost, and exact only"
    " for clouds that are shifted copies."
)
def between_centroids(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """The least that any matching can cost."""
    return float(np.linalg.norm(p_a.mean(axis=0) - p_b.mean(axis=0)))


@alternative
def by_shortest_ways(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """Matches row after row: each takes the shortest way to a free column, over columns that change
    their rows (Kuhn).
    """
    if min(len(p_a), len(p_b)) == 0:
        raise ValueError("no points")
    n = int(np.lcm(len(p_a), len(p_b)))
    a, b = np.repeat(p_a, n // len(p_a), axis=0), np.repeat(p_b, n // len(p_b), axis=0)
    D = np.sqrt(((a[:, None] - b) ** 2).sum(axis=-1))
    row_of = np.full(n, -1)
    price = np.zeros(n)
    paid = np.zeros(n)
    for row in range(n):
        way = np.full(n, np.inf)
        before = np.full(n, -1)
        done = np.zeros(n, bool)
        here = row
        column = -1
        length = 0.0
        while here >= 0:
            further = length + D[here] - paid[here] - price
            shorter = ~done & (further < way)
            way[shorter] = further[shorter]
            before[shorter] = column
            column = int(np.where(done, np.inf, way).argmin())
            length = way[column]
            here = row_of[column]
            done[column] = True
        paid[row] += length
        changed = done & (row_of >= 0)
        paid[row_of[changed]] += length - way[changed]
        price[done] += way[done] - length
        while column >= 0:
            row_of[column] = row if before[column] < 0 else row_of[before[column]]
            column = before[column]
    return float(D[row_of, np.arange(n)].mean())


@alternative
def earth_movers_of_copies(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """Repeats points until the counts are equal, then assigns."""
    from scipy.optimize import linear_sum_assignment

    a, b = repeated(p_a, p_b)
    D = np.sqrt(((a[:, None] - b) ** 2).sum(-1))
    i, j = linear_sum_assignment(D)
    return float(D[i, j].sum() / len(a))


@alternative
def earth_movers_by_programme(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """A linear programme over all plans, whose rows and columns sum to the masses."""
    from scipy.optimize import linprog

    n, m = len(p_a), len(p_b)
    if n * m == 0:
        raise ValueError("an empty cloud")
    D = all_distances(p_a, p_b)
    sums = np.zeros((n + m, n * m))
    for i, j in itertools.product(range(n), range(m)):
        sums[i, i * m + j] = sums[n + j, i * m + j] = 1.0
    optimum = linprog(
        D.ravel(), A_eq=sums, b_eq=np.r_[np.full(n, 1 / n), np.full(m, 1 / m)], method="highs"
    )
    return float(optimum.fun or 0.0)
