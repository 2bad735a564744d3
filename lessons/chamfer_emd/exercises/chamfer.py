"""Write the two-sided Chamfer distance in the definition that the lesson uses: mean of squares,
both sides added. The left flow goes down your function: where its values are wrong, watch where it
leads.
"""

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
from lessons.chamfer_emd.exercises import one_sided as one
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
    slot="chamfer",
    examples=(
        (f"chamfer({PAIR}, np.array([[0.0, 0, 0]]))", "0.5"),
        (f"chamfer({PAIR}, np.array([[0.0, 0, 2], [1, 0, 2], [1, 0, 2]]))", "8"),
    ),
)
def chamfer(p_a: Float[np.ndarray, "n 3"], p_b: Float[np.ndarray, "m 3"]) -> float:
    """Return the two-sided Chamfer distance: mean of squares, both sides added.

    (1 / n) sum_i min_j |a_i - b_j|^2 + (1 / m) sum_j min_i |a_i - b_j|^2. "Chamfer" names several
    numbers; this one takes a mean (not a sum) of squared distances (not distances) on each side,
    and adds the sides (no half, no maximum).

    Args:
        p_a: n points, metres; the order of rows means nothing.
        p_b: m points in the same frame; the counts may differ.

    Returns:
        Square metres. The same with a and b exchanged; 0 where each point of either cloud is a
        point of the other, even where one has it twice.

    Raises:
        ValueError: If a cloud has no points.
    """
    return shape_distances.chamfer(p_a, p_b)


CHAMFER_HINT = "Each side is a mean over its own points of squared nearest distances; add the two."


def chamfer_found(candidate: Function, p_a: Cloud, p_b: Cloud, label: str = "") -> Verdict:
    """Judge both sides by ours."""
    return value_verdict(
        candidate(p_a, p_b), shape_distances.chamfer(p_a, p_b), "m²", CHAMFER_HINT, label
    )


@check(2)
def both_sides_of_few_points(candidate: Function) -> Verdict:
    """Three points and two: 2 m² from a to b and 2.5 m² from b to a are 4.5 m²."""
    p_a = np.array([[1.0, 0, 0], [0, 0, 1], [5, 2, 0]])
    p_b = np.array([[0.0, 0, 0], [5, 0, 0]])
    return value_verdict(
        candidate(p_a, p_b), 4.5, "m²", f"From b to a the squares are 1 and 4. {CHAMFER_HINT}"
    )


@check(2)
def both_ways_round(candidate: Function) -> Verdict:
    """Clouds of 40 and 90 points have one distance, whichever comes first."""
    p_a, p_b = two_clouds(STUDENTS + 10, 40, 90)
    return worst(
        (chamfer_found(candidate, p_a, p_b, "a, b: "), chamfer_found(candidate, p_b, p_a, "b, a: "))
    )


@check(1)
def twice_the_size(candidate: Function) -> Verdict:
    """Twice the size is four times the distance."""
    p_a, p_b = two_clouds(STUDENTS + 11, 30, 50)
    right = 4 * shape_distances.chamfer(p_a, p_b)
    return value_verdict(candidate(2 * p_a, 2 * p_b), right, "m²", CHAMFER_HINT)


@check(1)
def clouds_are_left_alone(candidate: Function) -> Verdict:
    """The clouds that come in are not changed."""
    return left_alone(candidate, chamfer_found(candidate, *two_clouds(STUDENTS + 12, 20, 30)))


@mistake(
    "You measured from a to b only. This side does not see what a lacks; add the side from b to a."
)
def only_from_a(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """Leaves out the way back."""
    return one.side(p_a, p_b)


@mistake(
    "You measured from b to a only. This side does not see what a has too much; add the side from a"
    " to b."
)
def only_from_b(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """Leaves out the way there."""
    return one.other_side(p_a, p_b)


@mistake(
    "You took means of distances, in metres. The definition asked for takes means of squares, in"
    " square metres."
)
def not_squared(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """Metres."""
    return one.not_squared(p_a, p_b) + one.not_squared(p_b, p_a)


@mistake(
    "You summed where means are asked for: twice as many points on the same shapes double your"
    " number. Divide one side by n, the other by m."
)
def sums_for_means(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """Grows with the counts."""
    return one.sum_for_mean(p_a, p_b) + one.sum_for_mean(p_b, p_a)


@mistake(
    "You summed distances. That definition exists too, but the one asked for takes means of"
    " squares."
)
def sums_of_distances(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """Both at once."""
    D = all_distances(p_a, p_b)
    return D.min(axis=1).sum() + D.min(axis=0).sum()


@mistake(
    "You took one mean over the points of both clouds, so that the larger cloud counts more. Take a"
    " mean for each side, then add the two."
)
def one_mean_of_all(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """One mean over the points of both clouds."""
    return sums_for_means(p_a, p_b) / (len(p_a) + len(p_b))


@mistake(
    "You divided each side by the count of the other cloud. The side from a to b has n terms, the"
    " one back has m."
)
def counts_swapped(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """Divides each side by the other's count."""
    return one.divided_by_the_other_count(p_a, p_b) + one.divided_by_the_other_count(p_b, p_a)


@mistake(
    "Your number is half of the right one: you took the mean of both sides. The definition asked"
    " for adds them."
)
def halved(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """The mean of the sides."""
    return one.both_sides(p_a, p_b) / 2


@mistake(
    "You took the larger of the two sides, as Hausdorff does. The definition asked for adds them."
)
def larger_side(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """The maximum of the sides."""
    return max(one.side(p_a, p_b), one.side(p_b, p_a))


@mistake(
    "You counted the side from a to b twice. For the way back the minimum runs over a: swap the"
    " clouds, or the axis."
)
def same_side_twice(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """Forgets to change the clouds over."""
    return 2 * one.side(p_a, p_b)


@mistake(
    "You took the root of each side's mean square. The definition asked for stays in square metres."
)
def roots_of_the_means(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """The root of the sides' mean squares."""
    return np.sqrt(one.side(p_a, p_b)) + np.sqrt(one.side(p_b, p_a))


@mistake(
    "You returned the square of the largest nearest distance: that is Hausdorff's. Chamfer takes"
    " means."
)
def largest_for_mean(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """The largest nearest distance, squared."""
    return max(one.largest_for_mean(p_a, p_b), one.largest_for_mean(p_b, p_a))


@mistake(
    "Your number is a third of the right one: the mean ran over x, y and z too. Sum the three"
    " squares of a point, then take the mean over the points."
)
def mean_over_coordinates(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """Takes the means over x, y and z too."""
    return one.both_sides(p_a, p_b) / 3


@mistake(
    "You paired points with the same row number. The order of rows means nothing: find the nearest"
    " point for each."
)
def paired_by_row(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """Mean square of index pairs."""
    return one.paired_by_row(p_a, p_b)


@mistake(
    "You use |a|^2 + |b|^2 - 2 a·b. Far from the origin these cancel and leave no digits: subtract"
    " the points first."
)
def squares_expanded(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """Uses |a|^2 + |b|^2 - 2 a b."""
    return one.squares_expanded(p_a, p_b) + one.squares_expanded(p_b, p_a)


@alternative
def chamfer_at_once(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """Both minima of one array."""
    if min(len(p_a), len(p_b)) == 0:
        raise ValueError("no points")
    squares = np.sum((p_a[:, None] - p_b[None]) ** 2, axis=2)
    return squares.min(axis=1).mean() + squares.min(axis=0).mean()


@alternative
def chamfer_one_by_one(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """Side by side, point by point."""
    return one.side_one_by_one(p_a, p_b) + one.side_one_by_one(p_b, p_a)


@alternative
def chamfer_with_trees(p_a: np.ndarray, p_b: np.ndarray) -> float:
    """Two k-d trees."""
    return one.side_with_a_tree(p_a, p_b) + one.side_with_a_tree(p_b, p_a)
