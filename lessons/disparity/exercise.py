"""The exercises of this lesson: depth from disparity, the costs of all shifts, and the shift that wins."""

import numpy as np
from jaxtyping import Float, Int, Real

from lessons.disparity import answers
from workbench.algorithms import cost_volume, disparity_map
from workbench.exercise.judging import left_alone, refused, worst
from workbench.exercise.model import Exercise, Function, Verdict, band, check, fail, full, partial
from workbench.geometry import stereo

STUDENTS, GRADERS = 31, 9241  # seeds of what a student sees run, and of what only a grader does

# depth_from_disparity -------------------------------------------------------------------------------------------------


def depth_from_disparity(d: Float[np.ndarray, "..."], f: float, baseline: float) -> Float[np.ndarray, "..."]:
    """Return the depth that each disparity stands for, metres along the optical axis.

    Two cameras look along the same direction, the right one `baseline` to the right of the left one. A point at depth Z is
    d pixels further left in the right picture. Similar triangles give Z / baseline = f / d.

    Args:
        d: Disparities, x in the left picture less x in the right one, pixels; an array of any shape, fractions included.
            nan is unknown.
        f: Focal length of both cameras, pixels.
        baseline: Distance between the cameras, metres.

    Returns:
        Depths, metres, in a new array of the same shape. 0 gives inf: the rays are parallel, the point is infinitely far.
        nan gives nan. A negative disparity gives nan: nothing in front of both cameras causes one.
    """
    return stereo.depth_from_disparity(d, f, baseline)


DEPTH_HINT = "Z = f B / d: the nearer, the larger the shift."


def depth_verdict(got: np.ndarray, right: np.ndarray, what: str = "") -> Verdict:
    """Judge depths by the largest relative error, per cent, and say where it is."""
    off = np.abs(got - right) / right
    i = np.unravel_index(np.argmax(np.where(np.isfinite(off), off, np.inf)), off.shape)
    hint = f"{float(right[i]):.4g} m came out as {float(got[i]):.4g} m. {DEPTH_HINT}"
    return band(
        f"{what}largest error" if what else "Largest error", 100 * float(off[i]), "%", good=0.01, fair=5, hint=hint
    )


@check(2)
def near_and_far(candidate: Function) -> Verdict:
    """With f = 700 px and a baseline of 0.12 m, 84, 16.8 and 4.2 px are 1, 5 and 20 m."""
    return depth_verdict(candidate(np.array([84.0, 16.8, 4.2]), 700.0, 0.12), np.array([1.0, 5.0, 20.0]))


@check(2)
def half_the_shift(candidate: Function) -> Verdict:
    """Over a whole map, half the disparity is twice the depth."""
    d = np.random.default_rng(STUDENTS).uniform(2.0, 60.0, (6, 8))
    Z = candidate(d, 400.0, 0.2)
    return worst((depth_verdict(Z, 80.0 / d), depth_verdict(candidate(d / 2, 400.0, 0.2), 160.0 / d, "Half: ")))


@check(1)
def disparities_are_left_alone(candidate: Function) -> Verdict:
    """The disparities that come in are not changed."""
    d = np.random.default_rng(STUDENTS + 1).uniform(1.0, 30.0, 20)
    return left_alone(candidate, depth_verdict(candidate(d, 500.0, 0.1), 50.0 / d))


@check(3, public=False)
def two_cameras(candidate: Function) -> Verdict:
    """Points seen by two cameras come back to the depths at which they are."""
    rng = np.random.default_rng(GRADERS)
    verdicts = []
    for f, baseline in ((350.0, 0.06), (1200.0, 0.54)):
        x, Z = rng.uniform(-1, 1, 40), rng.uniform(0.8, 40.0, 40)
        seen_left, seen_right = f * x / Z, f * (x - baseline) / Z
        verdicts.append(depth_verdict(candidate(seen_left - seen_right, f, baseline), Z))
    return worst(verdicts)


@check(1, public=False)
def smaller_pictures(candidate: Function) -> Verdict:
    """In pictures shrunk four times, f and d shrink, and the depth is the same."""
    d = np.random.default_rng(GRADERS + 1).uniform(3.0, 80.0, (3, 4, 2))
    return worst(depth_verdict(candidate(d / k, 900.0 / k, 0.15), 135.0 / d, f"1/{k} size: ") for k in (1, 4))


@check(3, public=False)
def infinite_and_unknown(candidate: Function) -> Verdict:
    """0 is infinitely far, nan stays nan, and a negative disparity is nan."""
    wanted = ((0.0, np.inf), (np.nan, np.nan), (-3.5, np.nan))
    wrong = []
    for d, right in wanted:
        got = float(candidate(np.array([d, 10.0]), 500.0, 0.1)[0])
        if not (got == right or (np.isnan(got) and np.isnan(right))):
            wrong.append(f"d = {d:g} gave {got:.3g} m, {right:g} was asked for")
    if not wrong:
        return full("0 gives inf, nan gives nan, -3.5 gives nan.")
    said = "; ".join(wrong) + "."
    return partial((3 - len(wrong)) / 3, said) if len(wrong) < 3 else fail(said)


# sad_cost_volume ------------------------------------------------------------------------------------------------------


def sad_cost_volume(
    left: Real[np.ndarray, "h w"], right: Real[np.ndarray, "h w"], max_disparity: int, window: int
) -> Float[np.ndarray, "d h w"]:
    """Return how badly every left pixel matches each of its candidates in the right picture.

    cost[d, y, x] is the sum, over a window around the pixel, of the absolute differences |left(y, x) - right(y, x - d)|.
    In steps: for each d take the differences of the columns that both have, x = d .. w - 1 of the left and 0 .. w - 1 - d of
    the right picture. Then sum these over the window. Where that reaches over the border of the slice of differences,
    the border's cells are repeated, as np.pad(..., mode="edge") does.

    Args:
        left: Grey picture of the left camera: floats, or bytes (uint8), whose differences wrap round.
        right: Grey picture of the right camera, of the same size; rows correspond.
        max_disparity: Largest shift that is tried, pixels; d runs from 0 to this, both included.
        window: Side of the square window, pixels, odd; 1 is the pixel alone.

    Returns:
        The costs as floats, (max_disparity + 1, h, w), in a new array. Where x < d the right picture shows nothing to
        compare with: the cost is inf.

    Raises:
        ValueError: If the pictures differ in size, the window is not odd and positive, or max_disparity is not below the
            width.
    """
    return cost_volume.sad_cost_volume(left.astype(float), right.astype(float), max_disparity, window)


VOLUME_HINT = "cost[d, y, x] sums |left(y, x) - right(y, x - d)| over the window."
Pair = tuple[np.ndarray, np.ndarray]


def textures(seed: int, h: int = 12, w: int = 20, shift: int = 4) -> Pair:
    """Return two noisy pictures; what the left one shows in column x is in column x - shift of the right one."""
    rng = np.random.default_rng(seed)
    scene = rng.uniform(10.0, 240.0, (h, w + shift))
    return scene[:, :w] + rng.normal(0, 3, (h, w)), scene[:, shift:] + rng.normal(0, 3, (h, w))


def cells_verdict(
    got: np.ndarray, right: np.ndarray, where: np.ndarray | None = None, what: str = "", hint: str = VOLUME_HINT
) -> Verdict:
    """Judge costs by the share of wrong cells, per cent, and name the first of them.

    Args:
        got: The answer.
        right: The right one.
        where: Which cells are judged; all that have a finite cost where it is not given.
        what: How the message begins.
        hint: What to look at where it is wrong.
    """
    judged = np.isfinite(right) if where is None else where & np.isfinite(right)
    near = 1e-6 * float(right[judged].max())
    with np.errstate(invalid="ignore"):
        wrong = judged & ~(np.abs(got - right) <= near)
    if not wrong.any():
        return full(f"{what}{judged.sum()} of {judged.sum()} costs are right.")
    d, y, x = (int(i) for i in np.argwhere(wrong)[0])
    first = f"cost[{d}, {y}, {x}] is {got[d, y, x]:.4g}, not {right[d, y, x]:.4g}"
    said = f"{what}{wrong.sum()} of {judged.sum()} costs are wrong; {first}. {hint}"
    return partial(0.5, said) if wrong.sum() <= 0.05 * judged.sum() else fail(said)


def inner(right: np.ndarray, window: int) -> np.ndarray:
    """Return which cells have a window that lies inside their slice."""
    d, y, x = np.indices(right.shape)
    reach, (_, h, w) = window // 2, right.shape
    return (y >= reach) & (y < h - reach) & (x >= d + reach) & (x < w - reach)


@check(3)
def single_pixels(candidate: Function) -> Verdict:
    """With a window of 1, each cost is the difference of two pixels, d columns apart."""
    left, right = textures(STUDENTS)
    return cells_verdict(candidate(left, right, 6, 1), sad_cost_volume(left, right, 6, 1))


@check(2)
def windows_inside(candidate: Function) -> Verdict:
    """With windows of 3 and 5 that lie inside, each cost is the sum of all differences in it."""
    verdicts = []
    for window in (3, 5):
        left, right = textures(STUDENTS + window)
        wanted = sad_cost_volume(left, right, 5, window)
        got = candidate(left, right, 5, window)
        verdicts.append(cells_verdict(got, wanted, inner(wanted, window), f"Window {window}: "))
    return worst(verdicts)


@check(1)
def nothing_to_compare_with(candidate: Function) -> Verdict:
    """Where x < d the cost is infinite."""
    left, right = textures(STUDENTS + 1)
    return _infinite(candidate(left, right, 6, 3))


def _infinite(cost: np.ndarray) -> Verdict:
    d, _, x = np.indices(cost.shape)
    finite = (x < d) & ~np.isposinf(cost)
    if not finite.any():
        return full(f"All {(x < d).sum()} such costs are inf.")
    k, y, u = (int(i) for i in np.argwhere(finite)[0])
    return fail(
        f"{finite.sum()} of {(x < d).sum()} such costs are not inf: cost[{k}, {y}, {u}] is {cost[k, y, u]:.4g}, "
        f"but the right picture has no column {u - k}."
    )


@check(1)
def pictures_are_left_alone(candidate: Function) -> Verdict:
    """The pictures that come in are not changed."""
    left, right = textures(STUDENTS + 2)
    return left_alone(candidate, cells_verdict(candidate(left, right, 4, 1), sad_cost_volume(left, right, 4, 1)))


@check(2, public=False)
def mirrored(candidate: Function) -> Verdict:
    """With both pictures mirrored and exchanged, the same pairs of pixels have the same costs."""
    left, right = textures(GRADERS, 10, 17)
    cost = candidate(left, right, 5, 3)
    turned = candidate(right[:, ::-1].copy(), left[:, ::-1].copy(), 5, 3)
    back = np.full_like(cost, np.inf)
    for d in range(len(cost)):  # left x and right x - d are columns w - 1 - x and w - 1 - x + d of the mirrored pair
        back[d, :, d:] = turned[d, :, d:][:, ::-1]
    wanted = sad_cost_volume(left, right, 5, 3)
    there, again = cells_verdict(cost, wanted), cells_verdict(back, wanted, what="Mirrored and mapped back: ")
    return worst((there, again))


@check(1, public=False)
def brighter_pictures(candidate: Function) -> Verdict:
    """Twice the contrast doubles all costs, and the same light added to both changes none."""
    left, right = textures(GRADERS + 1, 9, 15)
    wanted = sad_cost_volume(left, right, 4, 3)
    where = inner(wanted, 3)
    double = cells_verdict(candidate(2 * left, 2 * right, 4, 3), 2 * wanted, where, "Twice the contrast: ")
    light = cells_verdict(candidate(left + 40, right + 40, 4, 3), wanted, where, "40 levels brighter: ")
    return worst((double, light))


@check(2, public=False)
def windows_over_the_border(candidate: Function) -> Verdict:
    """A window that reaches over the border of its slice repeats the border's cells."""
    left, right = textures(GRADERS + 2)
    wanted = sad_cost_volume(left, right, 4, 5)
    hint = "Take the differences of the columns that both have, pad these by repeating their border, then sum."
    return cells_verdict(candidate(left, right, 4, 5), wanted, ~inner(wanted, 5), hint=hint)


@check(1, public=False)
def byte_pictures(candidate: Function) -> Verdict:
    """Pictures of bytes (uint8) give the same costs as floats."""
    left, right = (np.rint(np.clip(picture, 0, 255)).astype(np.uint8) for picture in textures(GRADERS + 3))
    wanted = sad_cost_volume(left, right, 5, 3)
    hint = "In uint8, 3 - 5 is 254: convert to float before you subtract."
    return cells_verdict(candidate(left, right, 5, 3), wanted, inner(wanted, 3), hint=hint)


@check(1, public=False)
def what_makes_no_sense(candidate: Function) -> Verdict:
    """Pictures of two sizes, an even window, and shifts beyond the width are refused."""
    left, right = textures(GRADERS + 4, 8, 12)
    return worst(
        (
            refused(candidate, left, right[:, 1:].copy(), 3, 3, what="A right picture that is one column narrower"),
            refused(candidate, left, right, 3, 4, what="A window of 4"),
            refused(candidate, left, right, 12, 3, what="max_disparity = 12 for pictures 12 px wide"),
        )
    )


# winner_takes_all -----------------------------------------------------------------------------------------------------


def winner_takes_all(cost: Real[np.ndarray, "d h w"]) -> Int[np.ndarray, "h w"]:
    """Return the disparity of the lowest cost at every pixel.

    Args:
        cost: cost[d, y, x] says how badly left pixel (y, x) matches at disparity d = 0, 1, 2, ...; low is alike. Floats or
            whole numbers, of any sign; inf where there is nothing to compare with. None is nan.

    Returns:
        Disparities, pixels, whole numbers (an integer type), in a new array. Of several equal costs the smallest disparity
        wins. A pixel whose costs are all inf gets 0. With a single slice all get 0.
    """
    return disparity_map.winner_takes_all(cost)


WINNER_HINT = "At each pixel: the d for which cost[d, y, x] is lowest."


def valleys(seed: int, shape: tuple[int, int, int]) -> tuple[np.ndarray, np.ndarray]:
    """Return rugged costs with one lowest cost per pixel, and the disparities at which these are."""
    rng = np.random.default_rng(seed)
    d = rng.integers(0, shape[0], shape[1:])
    cost = rng.uniform(5.0, 60.0, shape)
    np.put_along_axis(cost, d[None], rng.uniform(0.5, 4.0, (1, *shape[1:])), axis=0)
    return cost, d


def map_verdict(got: np.ndarray, right: np.ndarray, what: str = "", hint: str = WINNER_HINT) -> Verdict:
    """Judge disparities by the share of wrong pixels, per cent, and name the first of them."""
    wrong = got != right
    if not wrong.any():
        return full(f"{what}{wrong.size} of {wrong.size} pixels are right.")
    y, x = (int(i) for i in np.argwhere(wrong)[0])
    said = f"At (y, x) = ({y}, {x}) yours is {got[y, x]}, right is {right[y, x]}. {hint}"
    return band(
        f"{what}wrong pixels" if what else "Wrong pixels", 100 * float(wrong.mean()), "%", good=0, fair=5, hint=said
    )


@check(3)
def deepest_valley(candidate: Function) -> Verdict:
    """On rugged costs the lowest one wins at every pixel."""
    cost, d = valleys(STUDENTS, (9, 7, 11))
    return map_verdict(candidate(cost), d)


@check(1)
def equal_costs(candidate: Function) -> Verdict:
    """Of several equal costs the smallest disparity wins."""
    cost = np.random.default_rng(STUDENTS + 1).integers(1, 4, (8, 5, 6)).astype(float)
    return map_verdict(candidate(cost), np.argmin(cost, axis=0), hint="Of equal costs the first one wins.")


@check(1)
def costs_are_left_alone(candidate: Function) -> Verdict:
    """The costs that come in are not changed."""
    cost, d = valleys(STUDENTS + 2, (5, 4, 6))
    return left_alone(candidate, map_verdict(candidate(cost), d))


@check(2, public=False)
def two_boards(candidate: Function) -> Verdict:
    """On the costs of two pictures of a near and a far board, both are found."""
    boards = [textures(GRADERS + k, 8, 28, shift) for k, shift in enumerate((3, 9))]
    left, right = (np.concatenate(halves) for halves in zip(*boards, strict=True))
    got = candidate(cost_volume.sad_cost_volume(left, right, 12, 3))[:, 9:]
    off = np.abs(got - np.repeat([[3], [9]], 8, axis=0)) > 1
    hint = f"The near one is at 9 px, the far one at 3 px. {WINNER_HINT}"
    return band("Pixels off by over 1 px", 100 * float(off.mean()), "%", good=5, fair=20, hint=hint)


@check(2, public=False)
def infinite_costs(candidate: Function) -> Verdict:
    """An infinite cost never wins, but where all are: there it is 0."""
    cost, _ = valleys(GRADERS + 1, (8, 6, 10))
    d, _, x = np.indices(cost.shape)
    cost[x < d] = np.inf
    cost[:, 2, 3:5] = np.inf
    return map_verdict(candidate(cost), np.argmin(cost, axis=0), hint="inf is worse than any number.")


@check(2, public=False)
def only_the_order_counts(candidate: Function) -> Verdict:
    """Scaled, shifted or turned round along d, the same costs win."""
    cost, d = valleys(GRADERS + 2, (7, 8, 5))
    last = len(cost) - 1
    return worst(
        (
            map_verdict(candidate(3 * cost + 7), d, "3 cost + 7: "),
            map_verdict(candidate(cost - 100), d, "cost - 100: "),
            map_verdict(candidate(cost[::-1].copy()), last - d, "Turned round along d: "),
        )
    )


@check(1, public=False)
def whole_numbers_and_one_slice(candidate: Function) -> Verdict:
    """Whole numbers up to 65,535, and a volume of a single slice, are fine."""
    cost = np.random.default_rng(GRADERS + 3).integers(250, 2**16, (20, 6, 4)).astype(np.uint16)
    single = map_verdict(candidate(cost[:1].astype(float)), np.zeros((6, 4), int), "A single slice: ")
    return worst((map_verdict(candidate(cost), np.argmin(cost, axis=0), "Whole numbers: "), single))


SMALL_PAIR = "np.array([[1.0, 5.0, 9.0]]), np.array([[5.0, 9.0, 2.0]])"

EXERCISES = (
    Exercise(
        name="depth_from_disparity",
        lesson="disparity",
        slot="depth",
        reference=depth_from_disparity,
        task="Write what turns a disparity into a depth. The lesson builds the cloud of points with it, from the map of "
        "every step; what is infinitely far or unknown must stay so, or the cloud shows points that nobody saw.",
        checks=(
            near_and_far,
            half_the_shift,
            disparities_are_left_alone,
            two_cameras,
            smaller_pictures,
            infinite_and_unknown,
        ),
        mistakes=answers.DEPTH_MISTAKES,
        alternatives=(answers.depth_one_by_one, answers.depth_by_masks),
        examples=(
            ("depth_from_disparity(np.array([84.0, 16.8, 4.2]), 700.0, 0.12)", "[1, 5, 20]"),
            (
                "depth_from_disparity(np.array([[8.0, 0.0], [np.nan, -2.0]]), 100.0, 0.2)",
                "[[2.5, np.inf], [nan, nan]]",
            ),
        ),
    ),
    Exercise(
        name="sad_cost_volume",
        lesson="disparity",
        slot="cost_volume",
        reference=sad_cost_volume,
        task="Write the cost volume: at every pixel, for every shift, the sum of absolute differences over a window. The "
        "lesson shows it slice by slice, and everything after it (paths, check, depth) follows from your costs.",
        checks=(
            single_pixels,
            windows_inside,
            nothing_to_compare_with,
            pictures_are_left_alone,
            mirrored,
            brighter_pictures,
            windows_over_the_border,
            byte_pictures,
            what_makes_no_sense,
        ),
        mistakes=answers.VOLUME_MISTAKES,
        alternatives=(answers.volume_by_running_sums, answers.volume_by_shifts),
        examples=(
            (f"sad_cost_volume({SMALL_PAIR}, 1, 1)", "[[[4, 4, 7]], [[np.inf, 0, 0]]]"),
            (f"sad_cost_volume({SMALL_PAIR}, 1, 3)", "[[[36, 45, 54]], [[np.inf, 0, 0]]]"),
        ),
    ),
    Exercise(
        name="winner_takes_all",
        lesson="disparity",
        slot="choose",
        reference=winner_takes_all,
        task="Write the choice: at every pixel the disparity whose cost is lowest. The lesson chooses with it after every "
        "slice and every path, for the left picture and, to check, for the right one.",
        checks=(
            deepest_valley,
            equal_costs,
            costs_are_left_alone,
            two_boards,
            infinite_costs,
            only_the_order_counts,
            whole_numbers_and_one_slice,
        ),
        mistakes=answers.WINNER_MISTAKES,
        alternatives=(answers.winner_by_sorting, answers.winner_slice_by_slice),
        examples=(
            ("winner_takes_all(np.array([[[4.0, 4.0, 7.0]], [[np.inf, 0.0, 7.0]]]))", "[[0, 1, 0]]"),
            ("winner_takes_all(np.array([[[9, 2]], [[3, 5]], [[6, 1]]]))", "[[1, 2]]"),
        ),
    ),
)
