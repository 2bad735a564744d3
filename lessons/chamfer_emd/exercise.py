"""The exercises of this lesson: one side of Chamfer, both sides, earth mover's distance. Judged by relative error."""

import numpy as np
from jaxtyping import Float

from lessons.chamfer_emd import answers
from workbench.algorithms import transport
from workbench.exercise.judging import left_alone, refused, worst
from workbench.exercise.model import Exercise, Function, Verdict, check, fail, full, partial
from workbench.geometry import shape_distances
from workbench.geometry.motions import apply, exp_so3, motion

STUDENTS, GRADERS = 53, 7718  # seeds of what a student sees run, and of what only a grader does

Cloud = np.ndarray
ZERO = 1e-7  # metres, or square metres: what counts as 0


def value_verdict(got: float, right: float, unit: str, hint: str, what: str = "") -> Verdict:
    """Judge a distance by its relative error: all points up to 0.01 %, half up to 1 %; a distance of 0 by itself."""
    yours = f"{what}yours" if what else "Yours"
    if right == 0.0:
        if abs(got) <= ZERO:
            return full(f"{what}{got:.2g} {unit}, as good as 0.")
        return fail(f"{yours} is {got:.4g} {unit}, right is 0. {hint}")
    off = 100 * abs(got - right) / right
    if off <= 0.01:
        return full(f"{what}{got:.4g} {unit}, right within 0.01 %.")
    said = f"{yours} is {got:.5g} {unit}, right is {right:.5g} {unit}: {off:.3g} % off"
    if off <= 1:
        return partial(0.5, f"{said}, close; full marks need 0.01 %. {hint}")
    return fail(f"{said}. {hint}")


def two_clouds(seed: int, n: int, m: int) -> tuple[Cloud, Cloud]:
    """Return n and m points of two lumps, half a metre in size, that overlap."""
    rng = np.random.default_rng(seed)
    return rng.normal(size=(n, 3)) * [0.5, 0.3, 0.2], rng.normal(size=(m, 3)) * [0.3, 0.5, 0.2] + [0.3, -0.1, 0.2]


def moved_together(seed: int, p_a: Cloud, p_b: Cloud, metres: float) -> tuple[Cloud, Cloud]:
    """Return both clouds after one random turn, and a shift by this far."""
    w, v = np.random.default_rng(seed).normal(size=(2, 3))
    T = motion(exp_so3(w), metres * v / np.linalg.norm(v))
    return apply(T, p_a), apply(T, p_b)


def reordered(seed: int, p: Cloud) -> Cloud:
    """Return the points in another order."""
    return np.random.default_rng(seed).permutation(p)


def no_points_refused(candidate: Function) -> Verdict:
    """Judge calls with an empty cloud on either side, or on both."""
    none, some = np.empty((0, 3)), np.ones((4, 3))
    calls = ((none, some, "An empty p_a"), (some, none, "An empty p_b"), (none, none, "Two empty clouds"))
    return worst(refused(candidate, p_a, p_b, what=what) for p_a, p_b, what in calls)


# one_sided ------------------------------------------------------------------------------------------------------------


def one_sided(p_a: Float[np.ndarray, "n 3"], p_b: Float[np.ndarray, "m 3"]) -> float:
    """Return the one-sided Chamfer distance from a to b, as a mean of squares.

    (1 / n) sum_i min_j |a_i - b_j|^2: each point of a looks for the nearest point of b; the mean of the squared distances.

    Args:
        p_a: The points that look, metres; the order of rows means nothing.
        p_b: The points they look at, in the same frame; the counts may differ.

    Returns:
        Square metres. It is 0 where every point of a is a point of b, however much of b has no point of a near it: swap
        the clouds, and you get another number. Several points of a may share a nearest point; where two points of b are
        equally near, the distance is the same by either.

    Raises:
        ValueError: If a cloud has no points.
    """
    return shape_distances.one_sided(p_a, p_b)


SIDE_HINT = "Mean over the points of a of the squared distance to the nearest point of b."


def side_found(candidate: Function, p_a: Cloud, p_b: Cloud, what: str = "") -> Verdict:
    """Judge one side by ours."""
    return value_verdict(candidate(p_a, p_b), shape_distances.one_sided(p_a, p_b), "m²", SIDE_HINT, what)


@check(2)
def side_of_few_points(candidate: Function) -> Verdict:
    """Three points look at two: squares of 1, 1 and 4 m² have a mean of 2 m²."""
    p_a, p_b = np.array([[1.0, 0, 0], [0, 0, 1], [5, 2, 0]]), np.array([[0.0, 0, 0], [5, 0, 0]])
    return value_verdict(candidate(p_a, p_b), 2.0, "m²", SIDE_HINT)


@check(2)
def there_and_back(candidate: Function) -> Verdict:
    """From a to b and from b to a are two numbers, and both are right."""
    p_a, p_b = two_clouds(STUDENTS, 40, 90)
    return worst((side_found(candidate, p_a, p_b, "From a to b: "), side_found(candidate, p_b, p_a, "From b to a: ")))


@check(1)
def a_part_lies_on_the_whole(candidate: Function) -> Verdict:
    """A part of a cloud is 0 from the whole; the whole is not 0 from its part."""
    whole, _ = two_clouds(STUDENTS + 1, 60, 1)
    part = reordered(STUDENTS, whole[whole[:, 0] < 0])
    return worst((side_found(candidate, part, whole, "Part: "), side_found(candidate, whole, part, "Whole: ")))


@check(1)
def clouds_of_a_side_are_left_alone(candidate: Function) -> Verdict:
    """The clouds that come in are not changed."""
    return left_alone(candidate, side_found(candidate, *two_clouds(STUDENTS + 2, 20, 30)))


@check(2, public=False)
def side_of_uneven_clouds(candidate: Function) -> Verdict:
    """Few points that look at many, many at few, and a single one each are all measured."""
    sizes = ((5, 200), (200, 5), (1, 30), (30, 1), (1, 1))
    return worst(
        side_found(candidate, *two_clouds(GRADERS + k, n, m), f"{n} points to {m}: ") for k, (n, m) in enumerate(sizes)
    )


@check(2, public=False)
def side_grows_with_the_square(candidate: Function) -> Verdict:
    """Three times the size is nine times the distance; every point of a twice is the same distance."""
    p_a, p_b = two_clouds(GRADERS + 10, 50, 40)
    right = shape_distances.one_sided(p_a, p_b)
    three = value_verdict(candidate(3 * p_a, 3 * p_b), 9 * right, "m²", SIDE_HINT, "Three times the size: ")
    twice = value_verdict(candidate(np.vstack([p_a, p_a]), p_b), right, "m²", SIDE_HINT, "Points of a twice: ")
    return worst((three, twice))


@check(2, public=False)
def side_of_moved_clouds(candidate: Function) -> Verdict:
    """In another order of rows, turned, and a thousand kilometres away, the distance is the same."""
    p_a, p_b = two_clouds(GRADERS + 20, 60, 60)
    right = shape_distances.one_sided(p_a, p_b)
    mixed = candidate(reordered(GRADERS, p_a), reordered(GRADERS + 1, p_b))
    away = candidate(*moved_together(GRADERS, p_a, p_b, 1e6))
    return worst(
        (
            value_verdict(mixed, right, "m²", SIDE_HINT, "Other order: "),
            value_verdict(away, right, "m²", "Subtract before you square. " + SIDE_HINT, "Far away: "),
        )
    )


@check(1, public=False)
def side_without_points(candidate: Function) -> Verdict:
    """A cloud without points is refused."""
    return no_points_refused(candidate)


# chamfer --------------------------------------------------------------------------------------------------------------


def chamfer(p_a: Float[np.ndarray, "n 3"], p_b: Float[np.ndarray, "m 3"]) -> float:
    """Return the two-sided Chamfer distance: mean of squares, both sides added.

    (1 / n) sum_i min_j |a_i - b_j|^2 + (1 / m) sum_j min_i |a_i - b_j|^2. "Chamfer" names several numbers; this one takes a
    mean (not a sum) of squared distances (not distances) on each side, and adds the sides (no half, no maximum).

    Args:
        p_a: n points, metres; the order of rows means nothing.
        p_b: m points in the same frame; the counts may differ.

    Returns:
        Square metres. The same with a and b exchanged; 0 where each point of either cloud is a point of the other, even
        where one has it twice.

    Raises:
        ValueError: If a cloud has no points.
    """
    return shape_distances.chamfer(p_a, p_b)


CHAMFER_HINT = "Each side is a mean over its own points of squared nearest distances; add the two."


def chamfer_found(candidate: Function, p_a: Cloud, p_b: Cloud, what: str = "") -> Verdict:
    """Judge both sides by ours."""
    return value_verdict(candidate(p_a, p_b), shape_distances.chamfer(p_a, p_b), "m²", CHAMFER_HINT, what)


@check(2)
def both_sides_of_few_points(candidate: Function) -> Verdict:
    """Three points and two: 2 m² from a to b and 2.5 m² from b to a are 4.5 m²."""
    p_a, p_b = np.array([[1.0, 0, 0], [0, 0, 1], [5, 2, 0]]), np.array([[0.0, 0, 0], [5, 0, 0]])
    return value_verdict(candidate(p_a, p_b), 4.5, "m²", f"From b to a the squares are 1 and 4. {CHAMFER_HINT}")


@check(2)
def both_ways_round(candidate: Function) -> Verdict:
    """Clouds of 40 and 90 points have one distance, whichever comes first."""
    p_a, p_b = two_clouds(STUDENTS + 10, 40, 90)
    return worst((chamfer_found(candidate, p_a, p_b, "a, b: "), chamfer_found(candidate, p_b, p_a, "b, a: ")))


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


@check(2, public=False)
def uneven_clouds(candidate: Function) -> Verdict:
    """A side with few points weighs as much as one with many: 5 and 200 points, 1 and 30, 1 and 1."""
    sizes = ((5, 200), (200, 5), (1, 30), (1, 1))
    return worst(
        chamfer_found(candidate, *two_clouds(GRADERS + 30 + k, n, m), f"{n} and {m} points: ")
        for k, (n, m) in enumerate(sizes)
    )


@check(2, public=False)
def the_same_points(candidate: Function) -> Verdict:
    """Equal points are 0 apart, in another order and some of them twice; a missing half is not 0, seen from either side."""
    p, _ = two_clouds(GRADERS + 40, 50, 1)
    more, half = reordered(GRADERS, np.vstack([p, p[:20]])), p[p[:, 0] < 0]
    return worst(
        (
            chamfer_found(candidate, p, more, "Equal points: "),
            chamfer_found(candidate, p, half, "Half missing in b: "),
            chamfer_found(candidate, half, p, "Half missing in a: "),
        )
    )


@check(2, public=False)
def moved_clouds(candidate: Function) -> Verdict:
    """In another order of rows, turned, and a thousand kilometres away, the distance is the same."""
    p_a, p_b = two_clouds(GRADERS + 50, 60, 60)
    right = shape_distances.chamfer(p_a, p_b)
    mixed = candidate(reordered(GRADERS, p_a), reordered(GRADERS + 1, p_b))
    away = candidate(*moved_together(GRADERS, p_a, p_b, 1e6))
    return worst(
        (
            value_verdict(mixed, right, "m²", CHAMFER_HINT, "Other order: "),
            value_verdict(away, right, "m²", "Subtract before you square. " + CHAMFER_HINT, "Far away: "),
        )
    )


@check(1, public=False)
def clouds_without_points(candidate: Function) -> Verdict:
    """A cloud without points is refused."""
    return no_points_refused(candidate)


# earth_movers ---------------------------------------------------------------------------------------------------------


def earth_movers(p_a: Float[np.ndarray, "n 3"], p_b: Float[np.ndarray, "m 3"]) -> float:
    """Return the earth mover's distance: the mean distance travelled under the best one-to-one matching.

    For n = m: min over all permutations of (1 / n) sum_i |a_i - b_perm(i)|, exact, with plain distances (no squares). The
    best permutation is an assignment problem; scipy.optimize.linear_sum_assignment solves it.

    Each cloud weighs 1, each of its points the same share. Where the counts differ, points are split: repeat every point of
    a and of b so often that both clouds have as many points as the least common multiple of n and m, and match those.

    Args:
        p_a: n points, metres; the order of rows means nothing.
        p_b: m points in the same frame; the counts may differ.

    Returns:
        Metres. The same with a and b exchanged; 0 only where both clouds have the same points with the same shares.

    Raises:
        ValueError: If a cloud has no points.
    """
    return transport.earth_movers(p_a, p_b)


MOVER_HINT = "The one-to-one matching with the least total of plain distances; their mean."


def mover_found(candidate: Function, p_a: Cloud, p_b: Cloud, what: str = "") -> Verdict:
    """Judge by ours, which is exact."""
    return value_verdict(candidate(p_a, p_b), transport.earth_movers(p_a, p_b), "m", MOVER_HINT, what)


@check(2)
def short_pairs_can_cost(candidate: Function) -> Verdict:
    """Points at 0 and 1 m go to 0.9 and 1.9 m: 0.9 m each, though 1 and 0.9 are so close."""
    p_a, p_b = np.array([[0.0, 0, 0], [1, 0, 0]]), np.array([[0.9, 0, 0], [1.9, 0, 0]])
    return value_verdict(candidate(p_a, p_b), 0.9, "m", MOVER_HINT)


@check(2)
def two_lumps(candidate: Function) -> Verdict:
    """Two clouds of 40 points have the distance of their best matching, whichever comes first."""
    p_a, p_b = two_clouds(STUDENTS + 20, 40, 40)
    return worst((mover_found(candidate, p_a, p_b, "a, b: "), mover_found(candidate, p_b, p_a, "b, a: ")))


@check(1)
def shares_are_split(candidate: Function) -> Verdict:
    """Two points at 0 and 3 m, three at 0, 1 and 3 m: half a metre, and nobody is left out."""
    p_a, p_b = np.array([[0.0, 0, 0], [3, 0, 0]]), np.array([[3.0, 0, 0], [0, 0, 0], [1, 0, 0]])
    hint = "A sixth of the mass goes 1 m, a sixth 2 m: take each point of a three times, each of b twice."
    return value_verdict(candidate(p_a, p_b), 0.5, "m", hint)


@check(1)
def twice_as_large(candidate: Function) -> Verdict:
    """Twice the size is twice the distance."""
    p_a, p_b = two_clouds(STUDENTS + 21, 25, 25)
    return value_verdict(candidate(2 * p_a, 2 * p_b), 2 * transport.earth_movers(p_a, p_b), "m", MOVER_HINT)


@check(1)
def movers_clouds_are_left_alone(candidate: Function) -> Verdict:
    """The clouds that come in are not changed."""
    return left_alone(candidate, mover_found(candidate, *two_clouds(STUDENTS + 22, 15, 15)))


@check(2, public=False)
def shifted_copies(candidate: Function) -> Verdict:
    """A cloud and its copy, shifted by 0.7 m and with its rows in another order, are 0.7 m apart; unshifted 0."""
    p, _ = two_clouds(GRADERS + 60, 50, 1)
    copy = reordered(GRADERS, p)
    v = 0.7 * np.array([2.0, -1.0, 2.0]) / 3
    shifted = value_verdict(candidate(p, copy + v), 0.7, "m", MOVER_HINT, "Shifted: ")
    return worst((shifted, value_verdict(candidate(p, copy), 0.0, "m", MOVER_HINT, "Other order: ")))


@check(2, public=False)
def bunched_points(candidate: Function) -> Verdict:
    """Nine of ten points bunched at one place are far from an even ring, though each gap is short."""
    rng = np.random.default_rng(GRADERS + 70)
    angles = np.linspace(0, 2 * np.pi, 40, endpoint=False)
    even = np.column_stack([np.cos(angles), np.sin(angles), 0 * angles])
    bunched = reordered(GRADERS, np.where(np.arange(40)[:, None] % 10 == 0, even, even[:1]))
    return mover_found(candidate, bunched + 0.01 * rng.normal(size=even.shape), even)


@check(2, public=False)
def unequal_counts(candidate: Function) -> Verdict:
    """Where counts differ no point is left out: 10 and 20, 12 and 8, 1 and 9, and a point that counts twice."""
    verdicts = []
    for k, (n, m) in enumerate(((10, 20), (12, 8), (1, 9))):
        p_a, p_b = two_clouds(GRADERS + 80 + k, n, m)
        verdicts.append(mover_found(candidate, p_a, p_b, f"{n} and {m} points: "))
    p, _ = two_clouds(GRADERS + 90, 7, 1)
    return worst((*verdicts, mover_found(candidate, p, np.vstack([p, p[:1]]), "A point twice: ")))


@check(1, public=False)
def movers_far_away(candidate: Function) -> Verdict:
    """Turned, and a thousand kilometres away, the distance is the same."""
    p_a, p_b = two_clouds(GRADERS + 100, 30, 30)
    right = transport.earth_movers(p_a, p_b)
    return value_verdict(candidate(*moved_together(GRADERS, p_a, p_b, 1e6)), right, "m", MOVER_HINT)


@check(1, public=False)
def nothing_to_move(candidate: Function) -> Verdict:
    """A cloud without points is refused."""
    return no_points_refused(candidate)


PAIR = "np.array([[0.0, 0, 0], [1, 0, 0]])"

EXERCISES = (
    Exercise(
        name="chamfer",
        lesson="chamfer_emd",
        slot="chamfer",
        reference=chamfer,
        task="Write the two-sided Chamfer distance in the definition that the lesson uses: mean of squares, both sides "
        "added. The left flow goes down your function: where its values are wrong, watch where it leads.",
        checks=(
            both_sides_of_few_points,
            both_ways_round,
            twice_the_size,
            clouds_are_left_alone,
            uneven_clouds,
            the_same_points,
            moved_clouds,
            clouds_without_points,
        ),
        mistakes=answers.CHAMFER_MISTAKES,
        alternatives=(answers.chamfer_at_once, answers.chamfer_one_by_one, answers.chamfer_with_trees),
        examples=(
            (f"chamfer({PAIR}, np.array([[0.0, 0, 0]]))", "0.5"),
            (f"chamfer({PAIR}, np.array([[0.0, 0, 2], [1, 0, 2], [1, 0, 2]]))", "8"),
        ),
    ),
    Exercise(
        name="earth_movers",
        lesson="chamfer_emd",
        slot="earth_movers",
        reference=earth_movers,
        task="Write the exact earth mover's distance: the mean distance under the best one-to-one matching. The right flow "
        "goes down your function; only a true matching spreads the cloud evenly over the target.",
        checks=(
            short_pairs_can_cost,
            two_lumps,
            shares_are_split,
            twice_as_large,
            movers_clouds_are_left_alone,
            shifted_copies,
            bunched_points,
            unequal_counts,
            movers_far_away,
            nothing_to_move,
        ),
        mistakes=answers.EARTH_MOVERS_MISTAKES,
        alternatives=(answers.earth_movers_of_copies, answers.earth_movers_by_programme),
        examples=(
            (f"earth_movers({PAIR}, np.array([[1.0, 0, 0.5], [0, 0, 0.5]]))", "0.5"),
            (f"earth_movers({PAIR}, np.array([[0.0, 0, 0]]))", "0.5"),
        ),
    ),
    Exercise(
        name="one_sided",
        lesson="chamfer_emd",
        slot="one_sided",
        reference=one_sided,
        task="Write one side of the Chamfer distance, from a to b. It fills two rows of the lesson's table, and the left "
        "flow goes down your function where it lowers one side: choose the preset missing or idle to watch yours.",
        checks=(
            side_of_few_points,
            there_and_back,
            a_part_lies_on_the_whole,
            clouds_of_a_side_are_left_alone,
            side_of_uneven_clouds,
            side_grows_with_the_square,
            side_of_moved_clouds,
            side_without_points,
        ),
        mistakes=answers.ONE_SIDED_MISTAKES,
        alternatives=(answers.side, answers.side_one_by_one, answers.side_with_a_tree),
        examples=(
            (f"one_sided({PAIR}, np.array([[0.0, 0, 0]]))", "0.5"),
            (f"one_sided(np.array([[0.0, 0, 0]]), {PAIR})", "0"),
        ),
    ),
)
