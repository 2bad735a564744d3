"""Write the cost volume: at every pixel, for every shift, the sum of absolute differences over a
window. The lesson shows it slice by slice, and everything after it (paths, check, depth) follows
from your costs.
"""

from collections.abc import Callable

import numpy as np
from jaxtyping import Float, Real

from lessons.disparity.exercises import STUDENTS, cells_verdict, inner, textures
from workbench.algorithms.stereo import cost_volume
from workbench.exercise import (
    Function,
    Verdict,
    alternative,
    check,
    contract,
    fail,
    full,
    left_alone,
    mistake,
    number,
    worst,
)

SMALL_PAIR = "np.array([[1.0, 5.0, 9.0]]), np.array([[5.0, 9.0, 2.0]])"


@contract(
    slot="cost_volume",
    examples=(
        (f"sad_cost_volume({SMALL_PAIR}, 1, 1)", "[[[4, 4, 7]], [[np.inf, 0, 0]]]"),
        (f"sad_cost_volume({SMALL_PAIR}, 1, 3)", "[[[36, 45, 54]], [[np.inf, 0, 0]]]"),
    ),
)
def sad_cost_volume(
    left: Real[np.ndarray, "h w"], right: Real[np.ndarray, "h w"], max_disparity: int, window: int
) -> Float[np.ndarray, "d h w"]:
    """Return how badly every left pixel matches each of its candidates in the right picture.

    cost[d, y, x] is the sum, over a window around the pixel, of the absolute differences |left(y,
    x) - right(y, x - d)|. In steps: for each d take the differences of the columns that both have,
    x = d .. w - 1 of the left and 0 .. w - 1 - d of the right picture. Then sum these over the
    window. Where that reaches over the border of the slice of differences, the border's cells are
    repeated, as np.pad(..., mode="edge") does.

    Args:
        left: Grey picture of the left camera: floats, or bytes (uint8), whose differences wrap
            round.
        right: Grey picture of the right camera, of the same size; rows correspond.
        max_disparity: Largest shift that is tried, pixels; d runs from 0 to this, both included.
        window: Side of the square window, pixels, odd; 1 is the pixel alone.

    Returns:
        The costs as floats, (max_disparity + 1, h, w), in a new array. Where x < d the right
        picture shows nothing to compare with: the cost is inf.

    Raises:
        ValueError: If the pictures differ in size, the window is not odd and positive, or
            max_disparity is not below the width.
    """
    return cost_volume.sad_cost_volume(
        left.astype(float), right.astype(float), max_disparity, window
    )


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
        f"{finite.sum()} of {(x < d).sum()} of them are not: cost[{k}, {y}, {u}] is"
        f" {number(cost[k, y, u])}, right is inf: the right picture has no column {u - k}."
    )


@check(1)
def pictures_are_left_alone(candidate: Function) -> Verdict:
    """The pictures that come in are not changed."""
    left, right = textures(STUDENTS + 2)
    return left_alone(
        candidate, cells_verdict(candidate(left, right, 4, 1), sad_cost_volume(left, right, 4, 1))
    )


def difference(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """|a - b|."""
    return np.abs(a.astype(float) - b.astype(float))


def windowed(image: np.ndarray, window: int) -> np.ndarray:
    """The sum over the window, border cells repeated."""
    padded = np.pad(image, window // 2, mode="edge")
    return np.lib.stride_tricks.sliding_window_view(padded, (window, window)).sum(axis=(2, 3))


def volume(
    left: np.ndarray,
    right: np.ndarray,
    max_disparity: int,
    window: int,
    *,
    compare: Callable[[np.ndarray, np.ndarray], np.ndarray] = difference,
    add_up: Callable[[np.ndarray, int], np.ndarray] = windowed,
    outside: float = np.inf,
) -> np.ndarray:
    """The cost volume, with one thing or another replaced."""
    h, w = left.shape
    refuse(left, right, max_disparity, window)
    cost = np.full((max_disparity + 1, h, w), outside)
    for d in range(max_disparity + 1):
        cost[d, :, d:] = add_up(compare(left[:, d:], right[:, : w - d]), window)
    return cost


def refuse(left: np.ndarray, right: np.ndarray, max_disparity: int, window: int) -> None:
    """Raise a ValueError where the contract asks for one."""
    if (
        left.shape != right.shape
        or window < 1
        or window % 2 == 0
        or not 0 <= max_disparity < left.shape[1]
    ):
        raise ValueError("sizes, window or range")


@mistake(
    "You compare left (x) with right (x + d). The right camera stands to the right, so that things"
    " are further left in its picture: right (x - d)."
)
def other_direction(
    left: np.ndarray, right: np.ndarray, max_disparity: int, window: int
) -> np.ndarray:
    """right(x + d)."""
    return volume(left[:, ::-1], right[:, ::-1], max_disparity, window)[:, :, ::-1]


@mistake(
    "Your costs are those of the right picture's pixels: right (x) against left (x + d). cost[d, y,"
    " x] belongs to left pixel x, against right (x - d)."
)
def seen_from_the_right(
    left: np.ndarray, right: np.ndarray, max_disparity: int, window: int
) -> np.ndarray:
    """The costs of the right picture's pixels."""
    return volume(right[:, ::-1], left[:, ::-1], max_disparity, window)[:, :, ::-1]


@mistake(
    "You rolled the right picture round: its last columns come in again on the left. Where x < d it"
    " shows nothing to compare with: the cost is inf."
)
def rolled_round(
    left: np.ndarray, right: np.ndarray, max_disparity: int, window: int
) -> np.ndarray:
    """np.roll: what leaves on one side comes back on the other."""
    refuse(left, right, max_disparity, window)
    return np.array(
        [
            windowed(difference(left, np.roll(right, d, axis=1)), window)
            for d in range(max_disparity + 1)
        ]
    )


@mistake(
    "Your cost is 0 where x < d. There is nothing to compare with, and 0 is the best cost there is:"
    " it would win. Use inf."
)
def free_where_unseen(
    left: np.ndarray, right: np.ndarray, max_disparity: int, window: int
) -> np.ndarray:
    """0 where there is nothing to compare with."""
    return volume(left, right, max_disparity, window, outside=0.0)


@mistake("You summed squared differences: that is SSD. SAD sums absolute ones.")
def squares(left: np.ndarray, right: np.ndarray, max_disparity: int, window: int) -> np.ndarray:
    """SSD."""
    return volume(left, right, max_disparity, window, compare=lambda a, b: difference(a, b) ** 2)


@mistake(
    "You summed the differences with their signs: too bright here and too dark there cancel. Take"
    " absolute values first."
)
def signed_differences(
    left: np.ndarray, right: np.ndarray, max_disparity: int, window: int
) -> np.ndarray:
    """The differences with their signs."""
    return volume(left, right, max_disparity, window, compare=lambda a, b: a.astype(float) - b)


@mistake("You took the mean over the window. The contract asks for the sum: window² times as much.")
def mean(left: np.ndarray, right: np.ndarray, max_disparity: int, window: int) -> np.ndarray:
    """The mean over the window."""
    return volume(left, right, max_disparity, window) / window**2


@mistake(
    "You subtracted bytes: in uint8, 3 - 5 is 254. Convert the pictures to float before you"
    " subtract."
)
def bytes_wrap_round(
    left: np.ndarray, right: np.ndarray, max_disparity: int, window: int
) -> np.ndarray:
    """Subtracts bytes as they come."""
    return volume(
        left, right, max_disparity, window, compare=lambda a, b: np.abs(a - b).astype(float)
    )


@mistake(
    "Your windows count 0 beyond the border, which makes matches there look better than they are."
    " Repeat the border's cells (np.pad in mode edge)."
)
def zeros_around(
    left: np.ndarray, right: np.ndarray, max_disparity: int, window: int
) -> np.ndarray:
    """Windows that reach over the border sum fewer cells."""

    def add_up(image: np.ndarray, window: int) -> np.ndarray:
        r = window // 2
        return windowed(np.pad(image, r), window)[r : r + image.shape[0], r : r + image.shape[1]]

    return volume(left, right, max_disparity, window, add_up=add_up)


@mistake(
    "You repeated the border of the pictures, so that a window near x = d compares columns that do"
    " not match. Take the differences first, then repeat the border of their slice."
)
def pictures_padded(
    left: np.ndarray, right: np.ndarray, max_disparity: int, window: int
) -> np.ndarray:
    """Repeats the border of the pictures, not that of the slice."""
    r = window // 2
    h, w = left.shape
    wide, other = (
        np.pad(picture.astype(float), ((r, r), (r + max_disparity, r)), mode="edge")
        for picture in (left, right)
    )
    cost = np.full((max_disparity + 1, h, w), np.inf)
    for d in range(max_disparity + 1):
        off = np.abs(wide[:, max_disparity:] - other[:, max_disparity - d : other.shape[1] - d])
        sums = np.lib.stride_tricks.sliding_window_view(off, (window, window)).sum(axis=(2, 3))
        cost[d, :, d:] = sums[:, d:]
    return cost


@mistake(
    "You compare single pixels whatever the window. Sum the differences over window x window"
    " pixels."
)
def window_ignored(
    left: np.ndarray, right: np.ndarray, max_disparity: int, window: int
) -> np.ndarray:
    """One pixel at a time."""
    return volume(left, right, max_disparity, window, add_up=lambda image, _: image)


@mistake(
    "Your window is 2 window + 1 wide. `window` is its whole side, not its reach: it reaches window"
    " // 2 each way."
)
def window_for_radius(
    left: np.ndarray, right: np.ndarray, max_disparity: int, window: int
) -> np.ndarray:
    """A window of 2 window + 1."""
    return volume(left, right, max_disparity, 2 * window + 1)


@mistake(
    "Your volume has the disparity as last axis. The contract asks for cost[d, y, x]:"
    " np.moveaxis(cost, 2, 0)."
)
def disparity_last(
    left: np.ndarray, right: np.ndarray, max_disparity: int, window: int
) -> np.ndarray:
    """cost[y, x, d]."""
    return np.moveaxis(volume(left, right, max_disparity, window), 0, 2)


@mistake(
    "Your volume ends at max_disparity - 1: range(n) stops before n. There are max_disparity + 1"
    " slices, from 0."
)
def last_slice_missing(
    left: np.ndarray, right: np.ndarray, max_disparity: int, window: int
) -> np.ndarray:
    """range(max_disparity)."""
    return volume(left, right, max_disparity, window)[:max_disparity]


@mistake(
    "All is right but that you accept even windows, which have no middle pixel: raise a ValueError."
)
def even_windows(
    left: np.ndarray, right: np.ndarray, max_disparity: int, window: int
) -> np.ndarray:
    """Makes an even window odd."""
    return volume(left, right, max_disparity, window | 1)


@alternative
def volume_by_shifts(
    left: np.ndarray, right: np.ndarray, max_disparity: int, window: int
) -> np.ndarray:
    """One pixel of the window after the other, indices kept inside the slice."""
    h, w = left.shape
    reach = window // 2
    if left.shape != right.shape:
        raise ValueError("sizes")
    if window <= 0 or not window & 1:
        raise ValueError("window")
    if max_disparity not in range(w):
        raise ValueError("range")
    a = np.asarray(left, float)
    b = np.asarray(right, float)
    cost = np.zeros((max_disparity + 1, h, w))
    y, x = np.mgrid[:h, :w]
    for d in range(max_disparity + 1):
        for up in range(-reach, reach + 1):
            for aside in range(-reach, reach + 1):
                row = np.clip(y + up, 0, h - 1)
                column = np.clip(x + aside, d, w - 1)
                cost[d] += abs(a[row, column] - b[row, column - d])
        cost[d, x < d] = np.inf
    return cost


@alternative
def volume_by_running_sums(
    left: np.ndarray, right: np.ndarray, max_disparity: int, window: int
) -> np.ndarray:
    """Differences of the sums over all cells above and to the left."""
    h, w = left.shape
    if (
        right.shape != (h, w)
        or window % 2 != 1
        or window < 1
        or max_disparity < 0
        or max_disparity >= w
    ):
        raise ValueError("pictures of one size, an odd window, and shifts within the picture")
    cost = np.full((max_disparity + 1, h, w), np.inf)
    for d in range(max_disparity + 1):
        off = np.abs(left[:, d:].astype(float) - right[:, : w - d].astype(float))
        off = np.pad(off, window // 2, mode="edge")
        sums = np.pad(off.cumsum(axis=0).cumsum(axis=1), ((1, 0), (1, 0)))
        cost[d, :, d:] = (
            sums[window:, window:]
            - sums[:-window, window:]
            - sums[window:, :-window]
            + sums[:-window, :-window]
        )
    return cost
