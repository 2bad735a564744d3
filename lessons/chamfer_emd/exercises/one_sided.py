"""Write one side of the Chamfer distance, from a to b. It fills two rows of the lesson's table, and
the left flow goes down your function where it lowers one side: choose the preset missing or idle to
watch yours.
"""

import numpy as np
from jaxtyping import Float

from lessons.chamfer_emd.exercises import (
    PAIR,
    STUDENTS,
    Cloud,
    all_distances,
    reordered,
    rows_of_both,
    two_clouds,
    value_verdict,
)
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
from workbench.geometry.points import shape_distances


@contract(
    slot="one_sided",
    examples=(
        (f"one_sided({PAIR}, np.array([[0.0, 0, 0]]))", "0.5"),
        (f"one_sided(np.array([[0.0, 0, 0]]), {PAIR})", "0"),
    ),
)
def one_sided(p_a: Float[np.ndarray, "n 3"], p_b: Float[np.ndarray, "m 3"]) -> float:
    """Return the one-sided Chamfer distance from a to b, as a mean of squares.

    (1 / n) sum_i min_j |a_i - b_j|^2: each point of a looks for the nearest point of b; the mean of
    the squared distances.

    Args:
        p_a: The points that look, metres; the order of rows means nothing.
        p_b: The points they look at, in the same frame; the counts may differ.

    Returns:
        Square metres. It is 0 where every point of a is a point of b, however much of b has no
        point of a near it: swap the clouds, and you get another number. Several points of a may
        share a nearest point; where two points of b are equally near, the distance is the same by
        either.

    Raises:
        ValueError: If a cloud has no points.
    """
    return shape_distances.one_sided(p_a, p_b)


SIDE_HINT = "Mean over the points of a of the squared distance to the nearest point of b."


def side_found(candidate: Function, p_a: Cloud, p_b: Cloud, label: str = "") -> Verdict:
    """Judge one side by ours."""
    return value_verdict(
        candidate(p_a, p_b), shape_distances.one_sided(p_a, p_b), "m²", SIDE_HINT, label
    )


@check(2)
def side_of_few_points(candidate: Function) -> Verdict:
    """Three points look at two: squares of 1, 1 and 4 m² have a mean of 2 m²."""
    p_a = np.array([[1.0, 0, 0], [0, 0, 1], [5, 2, 0]])
    p_b = np.array([[0.0, 0, 0], [5, 0, 0]])
    return value_verdict(candidate(p_a, p_b), 2.0, "m²", SIDE_HINT)


@check(2)
def there_and_back(candidate: Function) -> Verdict:
    """From a to b and from b to a are two numbers, and both are right."""
    p_a, p_b = two_clouds(STUDENTS, 40, 90)
    return worst(
        (
            side_found(candidate, p_a, p_b, "From a to b: "),
            side_found(candidate, p_b, p_a, "From b to a: "),
        )
    )


@check(1)
def a_part_lies_on_the_whole(candidate: Function) -> Verdict:
    """A part of a cloud is 0 from the whole; the whole is not 0 from its part."""
    whole, _ = two_clouds(STUDENTS + 1, 60, 1)
    part = reordered(STUDENTS, whole[whole[:, 0] < 0])
    return worst(
        (
            side_found(candidate, part, whole, "Part: "),
            side_found(candidate, whole, part, "Whole: "),
        )
    )


@check(1)
def clouds_of_a_side_are_left_alone(candidate: Function) -> Verdict:
    """The clouds that come in are not changed."""
    return left_alone(candidate, side_found(candidate, *two_clouds(STUDENTS + 2, 20, 30)))


@mistake(
    "You measured from b to a: how far the points of b are from a. The two sides differ. Asked for"
    " is the mean over the points of a."
)
def other_side(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """From b to a."""
    return np.mean(all_distances(p_a, p_b).min(axis=0) ** 2)


@mistake(
    "You added both sides. That is the two-sided Chamfer distance; here only the side from a to b"
    " is asked for."
)
def both_sides(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """The two-sided distance."""
    return side(p_a, p_b) + side(p_b, p_a)


@mistake(
    "You took the mean of the distances, in metres. The definition asked for takes their squares,"
    " in square metres."
)
def not_squared(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """Metres."""
    return np.mean(all_distances(p_a, p_b).min(axis=1))


@mistake(
    "You summed where the mean is asked for: twice as many points on the same shape double your"
    " number. Divide by n."
)
def sum_for_mean(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """Grows with the count."""
    return np.sum(all_distances(p_a, p_b).min(axis=1) ** 2)


@mistake("You divided by m, the count of b. The mean runs over the points of a: divide by n.")
def divided_by_the_other_count(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """Divides by m."""
    return sum_for_mean(p_a, p_b) / len(p_b)


@mistake(
    "Your number is a third of the right one: the mean ran over x, y and z too. Sum the three"
    " squares of a point, then take the mean over the points."
)
def mean_over_coordinates(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """Takes the mean over x, y and z too."""
    return float(np.mean((p_a - p_b[all_distances(p_a, p_b).argmin(axis=1)]) ** 2))


@mistake(
    "You took the mean of the distances and squared it. Square each distance first: the mean of"
    " squares is larger."
)
def squared_after_the_mean(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """Squares after the mean."""
    return float(not_squared(p_a, p_b) ** 2)


@mistake(
    "You returned the largest nearest distance (squared): that is Hausdorff's idea. Chamfer takes"
    " the mean over the points of a."
)
def largest_for_mean(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """The largest instead of the mean."""
    return np.max(all_distances(p_a, p_b).min(axis=1) ** 2)


@mistake(
    "You took the mean over all pairs of points. Each point of a looks at its nearest point of b"
    " only: the minimum over b comes first."
)
def mean_over_all_pairs(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """Takes the mean over all pairs."""
    return float(np.mean(all_distances(p_a, p_b) ** 2))


@mistake("You measured to the centroid of b. Each point of a has a nearest point of b of its own.")
def distance_to_the_centroid(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """Compares with the middle of b."""
    return np.mean(np.sum((p_a - p_b.mean(axis=0)) ** 2, axis=1))


@mistake(
    "You paired points with the same row number. The order of rows means nothing: find for each"
    " point of a the nearest of b."
)
def paired_by_row(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """Mean square of index pairs."""
    a, b = rows_of_both(p_a, p_b)
    return np.mean(np.sum((a - b) ** 2, axis=1))


@mistake(
    "You give every point of b away only once. Nearest neighbours are not one to one: many points"
    " of a may share one."
)
def one_to_one(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """Every point of b only once, as long as there are any."""
    D = all_distances(p_a, p_b)
    total = 0.0
    for row in D:
        j = int(np.argmin(row)) if np.isfinite(row).any() else -1
        total += row[j] ** 2 if j >= 0 else 0.0
        D[:, j] = np.inf if j >= 0 else D[:, j]
    return total / len(p_a)


@mistake(
    "You use |a|^2 + |b|^2 - 2 a·b. Far from the origin these cancel and leave no digits: subtract"
    " the points first."
)
def squares_expanded(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """Uses |a|^2 + |b|^2 - 2 a b, where far from the origin all digits cancel."""
    squares = (p_a**2).sum(1)[:, None] + (p_b**2).sum(1) - 2 * p_a @ p_b.T
    return np.mean(np.maximum(squares, 0.0).min(axis=1))


@alternative
def side(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """All pairs in one array."""
    if len(p_a) == 0 or len(p_b) == 0:
        raise ValueError("no points")
    return np.sum((p_a[:, None] - p_b[None]) ** 2, axis=2).min(axis=1).mean()


@alternative
def side_one_by_one(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """Loops over a."""
    if min(len(p_a), len(p_b)) == 0:
        raise ValueError("no points")
    return sum(float(np.min(np.sum((p_b - a) ** 2, axis=1))) for a in p_a) / len(p_a)


@alternative
def side_with_a_tree(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """Asks a k-d tree."""
    from scipy.spatial import cKDTree

    if not (len(p_a) and len(p_b)):
        raise ValueError("a cloud is empty")
    d, _ = cKDTree(p_b).query(p_a)
    return float(np.mean(np.square(d)))
