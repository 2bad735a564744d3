"""The exercises of this lesson: a plane through three points, the points near it, and how many samples to draw."""

import numpy as np
from jaxtyping import Float

from lessons.ransac import answers
from workbench.algorithms import ransac, scores
from workbench.exercise.judging import left_alone, worst
from workbench.exercise.model import Exercise, Function, Verdict, band, check, fail, full, partial
from workbench.exercise.sandbox import StudentError
from workbench.geometry import lines_planes
from workbench.geometry.motions import exp_so3

STUDENTS, GRADERS = 53, 7411  # seeds of what a student sees run, and of what only a grader does
NO_UNIT = 1e-5  # how far a normal's length may be from 1: rounding, also of single precision

# plane_from_points ----------------------------------------------------------------------------------------------------


def plane_from_points(p: Float[np.ndarray, "3 3"]) -> Float[np.ndarray, "4"]:
    """Return the plane through three points.

    Args:
        p: The three points, one per row, metres. Any place, any size: sides of a micrometre or of a kilometre.

    Returns:
        (a, b, c, d) with a unit normal n = (a, b, c) and d in metres, so that n . p + d is a point's signed distance and 0
        for the three. Either side may be the normal's: (a, b, c, d) and (-a, -b, -c, -d) are the same plane.
        Points on one line, or coinciding, have many planes: return four nan, do not raise. They count as such where
        the cross product of two sides is shorter than a billionth of the squared longest side: rounding leaves less.
    """
    return lines_planes.plane_from_points(p)


NORMAL_HINT = "The normal is at right angles to the sides, such as p[1] - p[0] and p[2] - p[0]."
OFFSET_HINT = "n . p + d is 0 at each of the points."
NAN_HINT = "How small an area counts as none depends on the sides: compare it with the squared longest one."


def a_triangle(rng: np.random.Generator, size: float = 1.0) -> np.ndarray:
    """Return three points that are far from being on one line, aside from the origin."""
    sides = np.array([[0.0, 0.0], [1.0, 0.1], [0.3, 0.8]]) + rng.uniform(-0.2, 0.2, (3, 2))
    R = exp_so3(rng.normal(size=3))
    return size * (np.column_stack([sides, np.zeros(3)]) @ R.T + rng.uniform(-1.0, 1.0, 3))


def plane_verdict(got: np.ndarray, right: np.ndarray, p: np.ndarray, what: str) -> Verdict:
    """Judge a plane by its unit normal, up to sign, in degrees, and by its distance to points of the right one, in metres.

    Args:
        got: The answer.
        right: The right plane.
        p: Points on it, metres. Distances are judged by how far apart these are.
        what: How the message begins.
    """
    if not np.isfinite(got).all():
        return fail(f"{what}: you returned {np.array2string(got, precision=3)}, but there is one plane. {NAN_HINT}")
    length, size = float(np.linalg.norm(got[:3])), float(np.ptp(p, axis=0).max())
    if abs(length - 1.0) > NO_UNIT:
        said = f"Your normal is {length:.3g} long and not 1, so distances come out {length:.3g} times as large."
        return fail(f"{what}: {said}")
    degrees = float(np.degrees(np.arctan2(np.linalg.norm(np.cross(got[:3], right[:3])), abs(got[:3] @ right[:3]))))
    away = float(np.abs(p @ got[:3] + got[3]).max())
    turned = band(f"{what}: normal off by", round(degrees, 9), "degrees", good=0.01, fair=1.0, hint=NORMAL_HINT)
    unit = 10.0 ** round(np.log10(size))
    away = away if away > 1e-9 * unit else 0.0  # rounding is not worth reading
    moved = band(f"{what}: plane off the points by", away, "m", good=1e-6 * unit, fair=1e-2 * unit, hint=OFFSET_HINT)
    return worst((turned, moved))


def found(candidate: Function, p: np.ndarray, what: str) -> Verdict:
    """Judge the plane through three points that have one."""
    return plane_verdict(candidate(p), plane_from_points(p), p, what)


def no_plane(got: np.ndarray, what: str) -> Verdict:
    """Judge the answer to points that have many planes."""
    unknown = int(np.isnan(got).sum())
    if unknown == len(got):
        return full(f"{what}: four nan.")
    said = f"{what}: you returned {np.array2string(got, precision=3)}, four nan were asked for. Many planes fit."
    return partial(0.5, said) if unknown else fail(said)


@check(2)
def floor_and_slope(candidate: Function) -> Verdict:
    """The plane of a floor 0.8 m up, and of a roof that rises 3 m over 4 m, is found."""
    floor = np.array([[0.0, 0.0, 0.8], [2.0, 0.0, 0.8], [0.0, 1.0, 0.8]])
    roof = np.array([[0.0, 0.0, 2.0], [4.0, 0.0, 5.0], [0.0, 3.0, 2.0]])
    return worst(
        (
            plane_verdict(candidate(floor), np.array([0.0, 0.0, 1.0, -0.8]), floor, "Floor"),
            plane_verdict(candidate(roof), np.array([-0.6, 0.0, 0.8, -1.6]), roof, "Roof"),
        )
    )


@check(2)
def three_points_anywhere(candidate: Function) -> Verdict:
    """Planes in any direction go through their three points."""
    rng = np.random.default_rng(STUDENTS)
    return worst(found(candidate, a_triangle(rng), f"Triangle {k}") for k in (1, 2, 3))


@check(1)
def points_on_a_line(candidate: Function) -> Verdict:
    """Three points on one line, and points that coincide, give four nan."""
    line = np.array([[1.0, 2.0, 0.0], [2.0, 4.0, 1.0], [4.0, 8.0, 3.0]])
    return worst(
        (
            no_plane(candidate(line), "(1, 2, 0), (2, 4, 1), (4, 8, 3) are on one line"),
            no_plane(candidate(line[[0, 1, 1]]), "Two points coincide"),
        )
    )


@check(1)
def points_are_left_alone(candidate: Function) -> Verdict:
    """The points that come in are not changed."""
    return left_alone(candidate, found(candidate, a_triangle(np.random.default_rng(STUDENTS + 1)), "A triangle"))


@check(2, public=False)
def moved_and_turned(candidate: Function) -> Verdict:
    """Points that are turned and moved take their plane along, whichever of them comes first."""
    rng, verdicts = np.random.default_rng(GRADERS), []
    for k in range(3):
        p, R, t = a_triangle(rng), exp_so3(rng.normal(size=3)), rng.uniform(-3.0, 3.0, 3)
        plane, moved = candidate(p), p @ R.T + t
        taken = np.append(R @ plane[:3], plane[3] - R @ plane[:3] @ t)
        verdicts += [
            found(candidate, p, "Before the move"),
            plane_verdict(candidate(moved), taken, moved, "Turned and moved"),
        ]
        verdicts.append(found(candidate, np.roll(p, k, axis=0)[::-1].copy(), "In another order"))
    return worst(verdicts)


@check(2, public=False)
def upright_and_through_the_origin(candidate: Function) -> Verdict:
    """A wall, which has no height over the floor, and planes through the origin are found."""
    rng = np.random.default_rng(GRADERS + 10)
    wall = np.array([[0.5, -1.0, 0.0], [2.0, 1.0, 0.0], [0.5, -1.0, 2.4]])
    through = a_triangle(rng)
    through[2] = 0.7 * through[0] - 0.4 * through[1]
    corner = a_triangle(rng)
    corner[0] = 0.0
    verdicts = [plane_verdict(candidate(wall), np.array([0.8, -0.6, 0.0, -1.0]), wall, "Wall")]
    for p, what in ((through, "A plane through the origin"), (corner, "The origin is one of the points")):
        verdicts.append(found(candidate, p, what))
    return worst(verdicts)


@check(2, public=False)
def small_large_and_far(candidate: Function) -> Verdict:
    """Sides of a micrometre and of a kilometre, and triangles a kilometre away, have a plane too."""
    rng = np.random.default_rng(GRADERS + 20)
    verdicts = [found(candidate, a_triangle(rng, size), f"Sides of {size:g} m") for size in (1e-3, 1e-6, 1e3)]
    far = a_triangle(rng) + np.array([800.0, -600.0, 50.0])
    thin = np.array([[0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [0.5, 1e-4, 1.0]])
    verdicts.append(found(candidate, far, "1 km away"))
    verdicts.append(found(candidate, thin, "1 m long and 0.1 mm high"))
    return worst(verdicts)


@check(2, public=False)
def nearly_on_a_line(candidate: Function) -> Verdict:
    """Points on one line but for rounding give four nan, near and a kilometre apart."""
    rng, verdicts = np.random.default_rng(GRADERS + 30), []
    for size in (1.0, 1e3, 1e-3):
        direction, start = rng.normal(size=(2, 3))
        p = size * (start + np.outer([0.1, 0.7, -0.9], direction))
        verdicts.append(no_plane(candidate(p), f"On one line but for rounding, {size:g} m in size"))
    return worst(verdicts)


# count_inliers --------------------------------------------------------------------------------------------------------


def count_inliers(plane: Float[np.ndarray, "4"], p: Float[np.ndarray, "n 3"], inlier_distance: float) -> int:
    """Return how many points are near a plane, on both its sides.

    Args:
        plane: (a, b, c, d) with a unit normal n = (a, b, c), d in metres: n . p + d is a point's signed distance.
        p: The points, one per row, metres; there may be none (n = 0).
        inlier_distance: How far from the plane an inlier may be, metres, measured at a right angle to it. A point exactly
            this far is an inlier.

    Returns:
        A whole number from 0 to n (an int). A point with a nan is near nothing, and nothing is near a plane of four nan,
        which stands for a degenerate sample: these count 0.
    """
    return scores.count_inliers(plane, p, inlier_distance)


COUNT_HINT = "An inlier has |n . p + d| <= inlier_distance."


def a_layer(rng: np.random.Generator, n: int = 240) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return a plane, points around it, and their signed distances by which they were made."""
    R, foot = exp_so3(rng.normal(size=3)), rng.uniform(-1.0, 1.0, 3)
    signed = rng.uniform(-0.4, 0.6, n)
    p = foot + np.column_stack([rng.uniform(-1.5, 1.5, (n, 2)), signed]) @ R.T
    return np.append(R[:, 2], -R[:, 2] @ foot), p, signed


def count_verdict(got: int, right: int, n: int, what: str, hint: str = COUNT_HINT) -> Verdict:
    """Judge a count: all for the exact one, half where at most one point in a hundred is too many or too few."""
    if got == right:
        return full(f"{what}: {got} of {n} points are inliers.")
    said = f"{what}: you count {got} of {n} points, {right} are inliers. {hint}"
    return partial(0.5, said) if abs(got - right) <= 0.01 * n else fail(said)


@check(2)
def above_and_below_a_table(candidate: Function) -> Verdict:
    """Around a table 0.75 m up, points above and below it are counted at 1, 5 and 30 cm."""
    heights = np.array([-0.75, -0.4, -0.2, -0.04, -0.004, 0.0, 0.007, 0.03, 0.045, 0.25, 0.5, 0.9])
    p = np.column_stack([np.linspace(-1.0, 1.0, 12), np.cos(np.arange(12.0)), 0.75 + heights])
    plane = np.array([0.0, 0.0, 1.0, -0.75])
    return worst(
        count_verdict(candidate(plane, p, t), right, 12, f"Within {t:g} m")
        for t, right in ((0.01, 3), (0.05, 6), (0.3, 8))
    )


@check(2)
def slanted_planes(candidate: Function) -> Verdict:
    """Around slanted planes the points within 2 and 10 cm, at right angles, are counted."""
    rng, verdicts = np.random.default_rng(STUDENTS + 20), []
    for _ in range(2):
        plane, p, signed = a_layer(rng)
        for t in (0.02, 0.1):
            right = int((np.abs(signed) <= t).sum())
            verdicts.append(count_verdict(candidate(plane, p, t), right, len(p), f"Within {t:g} m of a slanted plane"))
    return worst(verdicts)


@check(1)
def cloud_is_left_alone(candidate: Function) -> Verdict:
    """The plane and the points that come in are not changed."""
    plane, p, signed = a_layer(np.random.default_rng(STUDENTS + 30), 50)
    right = int((np.abs(signed) <= 0.12).sum())
    return left_alone(candidate, count_verdict(candidate(plane, p, 0.12), right, 50, "Within 0.12 m"))


@check(2, public=False)
def turned_over(candidate: Function) -> Verdict:
    """The same plane with its normal turned over, and the points in another order, give the same count."""
    rng = np.random.default_rng(GRADERS + 40)
    plane, p, signed = a_layer(rng)
    right, other = int((np.abs(signed) <= 0.07).sum()), p[rng.permutation(len(p))]
    return worst(
        (
            count_verdict(candidate(plane, p, 0.07), right, len(p), "Within 0.07 m"),
            count_verdict(candidate(-plane, p, 0.07), right, len(p), "The normal turned over"),
            count_verdict(candidate(plane, other, 0.07), right, len(p), "The points in another order"),
        )
    )


@check(2, public=False)
def cloud_and_plane_moved(candidate: Function) -> Verdict:
    """A cloud and its plane that are turned, moved and scaled together keep their count."""
    rng, verdicts = np.random.default_rng(GRADERS + 50), []
    for scale in (1.0, 12.0, 0.05):
        plane, p, signed = a_layer(rng)
        R, t = exp_so3(rng.normal(size=3)), rng.uniform(-4.0, 4.0, 3)
        moved = np.append(R @ plane[:3], scale * (plane[3] - R @ plane[:3] @ t))
        got = candidate(moved, scale * (p @ R.T + t), scale * 0.05)
        right = int((np.abs(signed) <= 0.05).sum())
        verdicts.append(count_verdict(got, right, len(p), f"Turned, moved, {scale:g} times as large"))
    return worst(verdicts)


@check(1, public=False)
def just_on_the_limit(candidate: Function) -> Verdict:
    """A point exactly as far as the inlier distance is an inlier, on both sides."""
    heights = np.array([1.5, 0.5, 1.0, 1.75, 0.25, -2.0, -2.5])
    p = np.column_stack([np.arange(7.0), np.zeros(7), heights])
    hint = "Use <=, not <."
    return count_verdict(candidate(np.array([0.0, 0.0, 1.0, -1.0]), p, 0.5), 3, 7, "Two exactly on the limit", hint)


@check(1, public=False)
def nothing_to_count(candidate: Function) -> Verdict:
    """No points, a plane of four nan, and a point with a nan count 0."""
    plane, p, signed = a_layer(np.random.default_rng(GRADERS + 60), 20)
    right = int((np.abs(signed[1:]) <= 0.3).sum())
    p[0, 1] = np.nan
    hint = f"{COUNT_HINT} That is never true of nan."
    return worst(
        (
            count_verdict(candidate(plane, np.empty((0, 3)), 0.3), 0, 0, "No points"),
            count_verdict(candidate(np.full(4, np.nan), p[1:], 0.3), 0, 19, "A plane of four nan", hint),
            count_verdict(candidate(plane, p, 0.3), right, 20, "One of them with a nan", hint),
        )
    )


# iterations_needed ----------------------------------------------------------------------------------------------------


def iterations_needed(inlier_ratio: float, sample_size: int, confidence: float) -> float:
    """Return how many samples must be drawn to draw, with this confidence, at least one that holds no outlier.

    It is the smallest whole number N, at least 1, for which N samples all hold an outlier with a probability of at most
    1 - confidence. Points are drawn independently: each is an inlier with probability inlier_ratio.

    Args:
        inlier_ratio: The share w of inliers among all points, from 0 to 1.
        sample_size: The number s of points in one sample, 1 or more.
        confidence: Strictly between 0 and 1, such as 0.99.

    Returns:
        The number as an int or a float without a fraction. Where all points are inliers it is 1. Where none is, it is
        inf (np.inf). Also where only one sample in 1e18 is clean it is right to six digits: 1 - x loses those of so small
        an x, and np.log1p(-x), which is log(1 - x), keeps them.
    """
    return float(ransac.iterations_needed(inlier_ratio, sample_size, confidence))


NEEDED_HINT = "One sample is clean with probability w^s; N are all spoilt with (1 - w^s)^N."


def needed_verdict(candidate: Function, w: float, s: int, confidence: float, hint: str = NEEDED_HINT) -> Verdict:
    """Judge a number of samples: all for the smallest that is enough, half where it is one off."""
    got, right = float(candidate(w, s, confidence)), iterations_needed(w, s, confidence)
    case = f"{100 * w:g} % inliers, {s} in a sample, {100 * confidence:g} % confidence"
    if got == right:
        return full(f"{case}: {right:.12g} {'sample' if right == 1.0 else 'samples'}.")
    said = f"{case}: you say {got:.12g}, right is {right:.12g}."
    if got < 1.0:
        return fail(f"{said} Nobody can do with less than one sample. {hint}")
    if got < right < np.inf:
        spoilt, allowed = np.exp(got * np.log1p(-(w**s))), 1.0 - confidence
        if spoilt > 1.01 * allowed:
            said += (
                f" After yours all are spoilt in {100 * spoilt:.3g} % of the runs, {100 * allowed:.3g} % is allowed."
            )
    return partial(0.5, f"{said} Round up.") if abs(got - right) <= 1.0 else fail(f"{said} {hint}")


def a_case(rng: np.random.Generator) -> tuple[float, int, float]:
    """Return an inlier ratio, a sample size and a confidence for which no rounding decides the answer."""
    while True:
        w, s, confidence = round(rng.uniform(0.2, 0.9), 3), int(rng.integers(2, 8)), round(rng.uniform(0.6, 0.999), 3)
        exact = np.log1p(-confidence) / np.log1p(-(w**s))
        if exact > 2.0 and 0.05 < exact % 1.0 < 0.95:
            return w, s, confidence


@check(3)
def planes_at_99_percent(candidate: Function) -> Verdict:
    """A plane at 50, 30 and 20 % inliers needs 35, 169 and 574 samples for 99 % confidence."""
    return worst(needed_verdict(candidate, w, 3, 0.99) for w in (0.5, 0.3, 0.2))


@check(2)
def larger_samples(candidate: Function) -> Verdict:
    """At 50 % inliers, samples of 1, 4 and 7 points need 7, 72 and 588 draws."""
    return worst(needed_verdict(candidate, 0.5, s, 0.99) for s in (1, 4, 7))


@check(1)
def no_outliers(candidate: Function) -> Verdict:
    """Where all points are inliers one sample is enough."""
    hint = "Each sample is clean: log(1 - w^s) is -inf here, so answer before you divide."
    return worst(needed_verdict(candidate, 1.0, s, confidence, hint) for s, confidence in ((3, 0.99), (7, 0.6)))


@check(3, public=False)
def the_smallest_that_is_enough(candidate: Function) -> Verdict:
    """N samples are all spoilt in at most the share of runs that the confidence leaves, N - 1 in more."""
    rng = np.random.default_rng(GRADERS + 70)
    return worst(needed_verdict(candidate, *a_case(rng)) for _ in range(8))


@check(2, public=False)
def more_confidence(candidate: Function) -> Verdict:
    """Each further nine of confidence, 90, 99 and 99.9 %, asks for as many samples again."""
    hint = "Halving 1 - confidence adds the same number of samples each time. Is it log(1 - confidence)?"
    return worst(needed_verdict(candidate, 0.4, 4, confidence, hint) for confidence in (0.6, 0.9, 0.99, 0.999))


@check(1, public=False)
def no_inliers(candidate: Function) -> Verdict:
    """Where no point is an inlier no number is enough: inf."""
    return worst(needed_verdict(candidate, 0.0, s, 0.99, "w^s is 0: answer np.inf then.") for s in (3, 4))


@check(1, public=False)
def rarely_clean(candidate: Function) -> Verdict:
    """Where one sample in 1e18 is clean, the number is right to six digits."""
    hint = "1 - 1e-18 is 1 to the computer, and its log is 0: use np.log1p(-x) for log(1 - x)."
    right = iterations_needed(0.01, 9, 0.99)
    try:
        got = float(candidate(0.01, 9, 0.99))
    except StudentError as error:
        if error.kind != "result":
            raise
        return fail(f"{error}; right is {right:.7g}. {hint}")
    what = f"1 % inliers, 9 in a sample: you say {got:.7g}, right is {right:.7g}; off by"
    return band(what, 100 * abs(got - right) / right, "%", good=1e-4, fair=1.0, hint=hint)


EXERCISES = (
    Exercise(
        name="plane_from_points",
        lesson="ransac",
        slot="plane_from_points",
        reference=plane_from_points,
        task="Write the guess: the plane through a sample of three points. The lesson draws it in purple for every sample "
        "and counts who is near it. It is used where the model is a plane, as in the default run; the preset 'Three points "
        "on one line' shows what becomes of a sample that has none.",
        checks=(
            floor_and_slope,
            three_points_anywhere,
            points_on_a_line,
            points_are_left_alone,
            moved_and_turned,
            upright_and_through_the_origin,
            small_large_and_far,
            nearly_on_a_line,
        ),
        mistakes=answers.PLANE_MISTAKES,
        alternatives=(answers.plane_by_svd, answers.plane_by_hand, answers.plane_by_minors),
        examples=(
            ("plane_from_points(np.array([[0.0, 0, 2], [1, 0, 2], [0, 1, 2]]))", "[0, 0, 1, -2]"),
            ("plane_from_points(np.array([[0.0, 0, 0], [1, 1, 1], [3, 3, 3]]))", "[nan, nan, nan, nan]"),
        ),
    ),
    Exercise(
        name="count_inliers",
        lesson="ransac",
        slot="count_inliers",
        reference=count_inliers,
        task="Write the vote: how many points are within the inlier distance of a plane. With the score 'count' your number "
        "decides which sample is the best so far, and its share of all points how many samples are still needed. It is "
        "used where the model is a plane, as in the default run.",
        checks=(
            above_and_below_a_table,
            slanted_planes,
            cloud_is_left_alone,
            turned_over,
            cloud_and_plane_moved,
            just_on_the_limit,
            nothing_to_count,
        ),
        mistakes=answers.COUNT_MISTAKES,
        alternatives=(answers.count_one_by_one, answers.count_in_homogeneous_coordinates),
        examples=(
            (
                "count_inliers(np.array([0.0, 0, 1, -2]), np.array([[5.0, 1, 2.1], [0, 0, 1.9], [0, 0, 0]]), 0.2)",
                "2",
            ),
            ("count_inliers(np.array([0.6, 0, 0.8, 0]), np.array([[1.0, 0, 0], [0, 9, 0.5]]), 0.5)", "1"),
        ),
    ),
    Exercise(
        name="iterations_needed",
        lesson="ransac",
        slot="iterations_needed",
        reference=iterations_needed,
        task="Write the rule that ends the search: how many samples until one of them is probably free of outliers. The "
        "lesson asks it after every new best, with the share of inliers of the best so far, for planes and all other "
        "models, and stops when so many are drawn.",
        checks=(
            planes_at_99_percent,
            larger_samples,
            no_outliers,
            the_smallest_that_is_enough,
            more_confidence,
            no_inliers,
            rarely_clean,
        ),
        mistakes=answers.NEEDED_MISTAKES,
        alternatives=(answers.needed_with_math, answers.needed_by_halving),
        examples=(
            ("iterations_needed(0.5, 3, 0.99)", "35"),
            ("iterations_needed(0.0, 3, 0.99)", "np.inf"),
        ),
    ),
)
