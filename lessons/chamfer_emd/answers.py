"""Wrong answers that students give to the exercises of this lesson, and right ones that are written differently."""

import itertools

import numpy as np

from workbench.exercise.model import Mistake


def all_distances(p_a: np.ndarray, p_b: np.ndarray) -> np.ndarray:
    """Return the distance of every point of a to every point of b, (n, m)."""
    return np.sqrt(np.sum((p_a[:, None] - p_b[None]) ** 2, axis=2))


def rows_of_both(p_a: np.ndarray, p_b: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return both clouds as if row k of one belonged to row k of the other, the shorter one over again."""
    k = np.arange(max(len(p_a), len(p_b)))
    return p_a[k % len(p_a)], p_b[k % len(p_b)]


# one_sided ------------------------------------------------------------------------------------------------------------


def other_side(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """From b to a."""
    return np.mean(all_distances(p_a, p_b).min(axis=0) ** 2)


def both_sides(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """The two-sided distance."""
    return side(p_a, p_b) + side(p_b, p_a)


def side_of_distances(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """Metres."""
    return np.mean(all_distances(p_a, p_b).min(axis=1))


def side_as_a_sum(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """Grows with the count."""
    return np.sum(all_distances(p_a, p_b).min(axis=1) ** 2)


def side_over_the_other_count(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """Divides by m."""
    return side_as_a_sum(p_a, p_b) / len(p_b)


def side_over_coordinates(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """Takes the mean over x, y and z too."""
    return float(np.mean((p_a - p_b[all_distances(p_a, p_b).argmin(axis=1)]) ** 2))


def side_of_mean_distance(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """Squares after the mean."""
    return float(side_of_distances(p_a, p_b) ** 2)


def side_of_the_worst(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """The largest instead of the mean."""
    return np.max(all_distances(p_a, p_b).min(axis=1) ** 2)


def side_to_everyone(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """Takes the mean over all pairs."""
    return float(np.mean(all_distances(p_a, p_b) ** 2))


def side_to_the_centroid(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """Compares with the middle of b."""
    return np.mean(np.sum((p_a - p_b.mean(axis=0)) ** 2, axis=1))


def paired_by_row(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """Mean square of index pairs."""
    a, b = rows_of_both(p_a, p_b)
    return np.mean(np.sum((a - b) ** 2, axis=1))


def side_one_to_one(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """Every point of b only once, as long as there are any."""
    D, total = all_distances(p_a, p_b), 0.0
    for row in D:
        j = int(np.argmin(row)) if np.isfinite(row).any() else -1
        total += row[j] ** 2 if j >= 0 else 0.0
        D[:, j] = np.inf if j >= 0 else D[:, j]
    return total / len(p_a)


def side_expanded(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """Uses |a|^2 + |b|^2 - 2 a b, where far from the origin all digits cancel."""
    squares = (p_a**2).sum(1)[:, None] + (p_b**2).sum(1) - 2 * p_a @ p_b.T
    return np.mean(np.maximum(squares, 0.0).min(axis=1))


ONE_SIDED_MISTAKES = (
    Mistake(
        "other side",
        other_side,
        "You measured from b to a: how far the points of b are from a. The two sides differ. Asked for is the mean over the "
        "points of a.",
    ),
    Mistake(
        "both sides",
        both_sides,
        "You added both sides. That is the two-sided Chamfer distance; here only the side from a to b is asked for.",
    ),
    Mistake(
        "not squared",
        side_of_distances,
        "You took the mean of the distances, in metres. The definition asked for takes their squares, in square metres.",
    ),
    Mistake(
        "sum for mean",
        side_as_a_sum,
        "You summed where the mean is asked for: twice as many points on the same shape double your number. Divide by n.",
    ),
    Mistake(
        "divided by the other count",
        side_over_the_other_count,
        "You divided by m, the count of b. The mean runs over the points of a: divide by n.",
    ),
    Mistake(
        "mean over coordinates",
        side_over_coordinates,
        "Your number is a third of the right one: the mean ran over x, y and z too. Sum the three squares of a point, then "
        "take the mean over the points.",
    ),
    Mistake(
        "squared after the mean",
        side_of_mean_distance,
        "You took the mean of the distances and squared it. Square each distance first: the mean of squares is larger.",
    ),
    Mistake(
        "largest for mean",
        side_of_the_worst,
        "You returned the largest nearest distance (squared): that is Hausdorff's idea. Chamfer takes the mean over the "
        "points of a.",
    ),
    Mistake(
        "mean over all pairs",
        side_to_everyone,
        "You took the mean over all pairs of points. Each point of a looks at its nearest point of b only: the minimum over "
        "b comes first.",
    ),
    Mistake(
        "distance to the centroid",
        side_to_the_centroid,
        "You measured to the centroid of b. Each point of a has a nearest point of b of its own.",
    ),
    Mistake(
        "paired by row",
        paired_by_row,
        "You paired points with the same row number. The order of rows means nothing: find for each point of a the nearest "
        "of b.",
    ),
    Mistake(
        "one to one",
        side_one_to_one,
        "You give every point of b away only once. Nearest neighbours are not one to one: many points of a may share one.",
    ),
    Mistake(
        "squares expanded",
        side_expanded,
        "You use |a|^2 + |b|^2 - 2 a·b. Far from the origin these cancel and leave no digits: subtract the points first.",
    ),
)


def side(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """All pairs in one array."""
    if len(p_a) == 0 or len(p_b) == 0:
        raise ValueError("no points")
    return np.sum((p_a[:, None] - p_b[None]) ** 2, axis=2).min(axis=1).mean()


def side_one_by_one(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """Loops over a."""
    if min(len(p_a), len(p_b)) == 0:
        raise ValueError("no points")
    return sum(float(np.min(np.sum((p_b - a) ** 2, axis=1))) for a in p_a) / len(p_a)


def side_with_a_tree(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """Asks a k-d tree."""
    from scipy.spatial import cKDTree

    if not (len(p_a) and len(p_b)):
        raise ValueError("a cloud is empty")
    d, _ = cKDTree(p_b).query(p_a)
    return float(np.mean(np.square(d)))


# chamfer --------------------------------------------------------------------------------------------------------------


def distances(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """Metres."""
    return side_of_distances(p_a, p_b) + side_of_distances(p_b, p_a)


def sums(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """Grows with the counts."""
    return side_as_a_sum(p_a, p_b) + side_as_a_sum(p_b, p_a)


def sum_of_distances(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """Both at once."""
    D = all_distances(p_a, p_b)
    return D.min(axis=1).sum() + D.min(axis=0).sum()


def one_mean_of_all(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """One mean over the points of both clouds."""
    return sums(p_a, p_b) / (len(p_a) + len(p_b))


def counts_swapped(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """Divides each side by the other's count."""
    return side_over_the_other_count(p_a, p_b) + side_over_the_other_count(p_b, p_a)


def halved(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """The mean of the sides."""
    return both_sides(p_a, p_b) / 2


def larger_side(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """The maximum of the sides."""
    return max(side(p_a, p_b), side(p_b, p_a))


def same_side_twice(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """Forgets to change the clouds over."""
    return 2 * side(p_a, p_b)


def root(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """The root of the sides' mean squares."""
    return np.sqrt(side(p_a, p_b)) + np.sqrt(side(p_b, p_a))


def squared_hausdorff(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """The largest nearest distance, squared."""
    return max(side_of_the_worst(p_a, p_b), side_of_the_worst(p_b, p_a))


def over_coordinates(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """Takes the means over x, y and z too."""
    return both_sides(p_a, p_b) / 3


def expanded(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """Uses |a|^2 + |b|^2 - 2 a b."""
    return side_expanded(p_a, p_b) + side_expanded(p_b, p_a)


CHAMFER_MISTAKES = (
    Mistake(
        "only from a",
        side,
        "You measured from a to b only. This side does not see what a lacks; add the side from b to a.",
    ),
    Mistake(
        "only from b",
        other_side,
        "You measured from b to a only. This side does not see what a has too much; add the side from a to b.",
    ),
    Mistake(
        "not squared",
        distances,
        "You took means of distances, in metres. The definition asked for takes means of squares, in square metres.",
    ),
    Mistake(
        "sums for means",
        sums,
        "You summed where means are asked for: twice as many points on the same shapes double your number. Divide one side "
        "by n, the other by m.",
    ),
    Mistake(
        "sums of distances",
        sum_of_distances,
        "You summed distances. That definition exists too, but the one asked for takes means of squares.",
    ),
    Mistake(
        "one mean of all",
        one_mean_of_all,
        "You took one mean over the points of both clouds, so that the larger cloud counts more. Take a mean for each side, "
        "then add the two.",
    ),
    Mistake(
        "counts swapped",
        counts_swapped,
        "You divided each side by the count of the other cloud. The side from a to b has n terms, the one back has m.",
    ),
    Mistake(
        "halved",
        halved,
        "Your number is half of the right one: you took the mean of both sides. The definition asked for adds them.",
    ),
    Mistake(
        "larger side",
        larger_side,
        "You took the larger of the two sides, as Hausdorff does. The definition asked for adds them.",
    ),
    Mistake(
        "same side twice",
        same_side_twice,
        "You counted the side from a to b twice. For the way back the minimum runs over a: swap the clouds, or the axis.",
    ),
    Mistake(
        "roots of the means",
        root,
        "You took the root of each side's mean square. The definition asked for stays in square metres.",
    ),
    Mistake(
        "largest for mean",
        squared_hausdorff,
        "You returned the square of the largest nearest distance: that is Hausdorff's. Chamfer takes means.",
    ),
    Mistake(
        "mean over coordinates",
        over_coordinates,
        "Your number is a third of the right one: the mean ran over x, y and z too. Sum the three squares of a point, then "
        "take the mean over the points.",
    ),
    Mistake(
        "paired by row",
        paired_by_row,
        "You paired points with the same row number. The order of rows means nothing: find the nearest point for each.",
    ),
    Mistake(
        "squares expanded",
        expanded,
        "You use |a|^2 + |b|^2 - 2 a·b. Far from the origin these cancel and leave no digits: subtract the points first.",
    ),
)


def chamfer_at_once(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """Both minima of one array."""
    if min(len(p_a), len(p_b)) == 0:
        raise ValueError("no points")
    squares = np.sum((p_a[:, None] - p_b[None]) ** 2, axis=2)
    return squares.min(axis=1).mean() + squares.min(axis=0).mean()


def chamfer_one_by_one(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """Side by side, point by point."""
    return side_one_by_one(p_a, p_b) + side_one_by_one(p_b, p_a)


def chamfer_with_trees(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """Two k-d trees."""
    return side_with_a_tree(p_a, p_b) + side_with_a_tree(p_b, p_a)


# earth_movers ---------------------------------------------------------------------------------------------------------


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


def by_index(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """Row k to row k."""
    a, b = repeated(p_a, p_b)
    return np.linalg.norm(a - b, axis=1).mean()


def nearest_neighbours(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """Mean distance to the nearest, from a."""
    return side_of_distances(p_a, p_b)


def nearest_both_ways(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """Chamfer of distances, halved."""
    return distances(p_a, p_b) / 2


def greedy_by_row(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """First come, first served."""
    a, b = repeated(p_a, p_b)
    D, total = all_distances(a, b), 0.0
    for row in D:
        j = int(np.argmin(row))
        total += row[j]
        D[:, j] = np.inf
    return total / len(a)


def greedy_by_distance(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """The closest pair first."""
    a, b = repeated(p_a, p_b)
    D, total = all_distances(a, b), 0.0
    for _ in a:
        i, j = np.unravel_index(np.argmin(D), D.shape)
        total += D[i, j]
        D[i], D[:, j] = np.inf, np.inf
    return total / len(a)


def sorted_along_x(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """What is right on a line."""
    a, b = repeated(p_a, p_b)
    return np.linalg.norm(a[np.argsort(a[:, 0])] - b[np.argsort(b[:, 0])], axis=1).mean()


def total_distance(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """The sum over the points of a."""
    return len(p_a) * earth_movers_of_copies(p_a, p_b)


def mean_of_squares(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """Square metres."""
    a, b = repeated(p_a, p_b)
    squares = all_distances(a, b) ** 2
    return squares[matched(squares)].mean()


def root_mean_square(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """The other Wasserstein distance."""
    return np.sqrt(mean_of_squares(p_a, p_b))


def matched_by_squares(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """The matching of least squares, measured in metres."""
    a, b = repeated(p_a, p_b)
    D = all_distances(a, b)
    return D[matched(D**2)].mean()


def points_left_out(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """Rectangular assignment."""
    D = all_distances(p_a, p_b)
    return D[matched(D)].mean()


def blurred(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """Sinkhorn with a blur of 5 % of the largest distance."""
    D = all_distances(p_a, p_b)
    blur = 0.05 * D.max() + 1e-12
    K, u, v = np.exp(-D / blur), np.ones(len(p_a)), np.ones(len(p_b))
    for _ in range(100):
        u = 1 / len(p_a) / (K @ v)
        v = 1 / len(p_b) / (K.T @ u)
    return float(np.sum(u[:, None] * K * v * D))


def between_centroids(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """The least that any matching can cost."""
    return float(np.linalg.norm(p_a.mean(axis=0) - p_b.mean(axis=0)))


EARTH_MOVERS_MISTAKES = (
    Mistake(
        "paired by row",
        by_index,
        "You paired points with the same row number. The order of rows means nothing: search for the matching with the "
        "least total distance.",
    ),
    Mistake(
        "nearest neighbours",
        nearest_neighbours,
        "You took the distance to the nearest point. Several points of a then share one of b; the earth mover's distance "
        "matches one to one.",
    ),
    Mistake(
        "nearest both ways",
        nearest_both_ways,
        "You took nearest neighbours both ways: that is a Chamfer distance, blind to density. Match one to one.",
    ),
    Mistake(
        "greedy by row",
        greedy_by_row,
        "You gave each point of a, row by row, the nearest partner that was left. Who comes late has far to go: the best "
        "matching has the least total.",
    ),
    Mistake(
        "closest pair first",
        greedy_by_distance,
        "You matched the closest pair first, then the next closest. A short pair early can force a long one late: only the "
        "total counts.",
    ),
    Mistake(
        "sorted along x",
        sorted_along_x,
        "You sorted both clouds along x and paired them. That is the best matching on a line only; in space, assign.",
    ),
    Mistake(
        "sum for mean",
        total_distance,
        "You returned the total distance. Each cloud has mass 1, each point of a carries 1 / n of it: divide by n.",
    ),
    Mistake(
        "squares",
        mean_of_squares,
        "You minimised squares and returned their mean, in square metres. The earth mover's distance sums plain distances, "
        "in metres.",
    ),
    Mistake(
        "root mean square",
        root_mean_square,
        "You minimised squares and took the root: that is the 2-Wasserstein distance. The earth mover's distance is the "
        "mean of plain distances.",
    ),
    Mistake(
        "matched by squares",
        matched_by_squares,
        "You measure distances, but of the matching that is best for squares. Minimise what you measure: distances.",
    ),
    Mistake(
        "points left out",
        points_left_out,
        "All is right but unequal counts: a rectangular assignment leaves points of the larger cloud out. Repeat points "
        "until both clouds have the same count.",
    ),
    Mistake(
        "blurred",
        blurred,
        "You used Sinkhorn with a blur of 5 % of the largest distance. Fast is not exact: entropy spreads the plan. "
        "Solve the assignment.",
    ),
    Mistake(
        "between centroids",
        between_centroids,
        "You measured between the centroids. That is the least any matching can cost, and exact only for clouds that are "
        "shifted copies.",
    ),
)


def earth_movers_of_copies(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """Repeats points until the counts are equal, then assigns."""
    from scipy.optimize import linear_sum_assignment

    a, b = repeated(p_a, p_b)
    D = np.sqrt(((a[:, None] - b) ** 2).sum(-1))
    i, j = linear_sum_assignment(D)
    return float(D[i, j].sum() / len(a))


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
    found = linprog(D.ravel(), A_eq=sums, b_eq=np.r_[np.full(n, 1 / n), np.full(m, 1 / m)], method="highs")
    return float(found.fun or 0.0)
