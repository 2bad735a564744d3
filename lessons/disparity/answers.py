"""Wrong answers that students give to the exercises of this lesson, and right ones that are written differently."""

from collections.abc import Callable

import numpy as np

from workbench.exercise.model import Mistake

# depth_from_disparity -------------------------------------------------------------------------------------------------


def proportional(d: np.ndarray, f: float, baseline: float) -> np.ndarray:
    """Depth grows with the disparity."""
    return baseline * d / f


def upside_down(d: np.ndarray, f: float, baseline: float) -> np.ndarray:
    """One over the depth."""
    return d / (f * baseline)


def baseline_forgotten(d: np.ndarray, f: float, baseline: float) -> np.ndarray:
    """Depth in baselines."""
    return np.where(d >= 0, f / np.abs(d), np.nan)


def f_forgotten(d: np.ndarray, f: float, baseline: float) -> np.ndarray:
    """Metres over pixels."""
    return np.where(d >= 0, baseline / np.abs(d), np.nan)


def whole_pixels(d: np.ndarray, f: float, baseline: float) -> np.ndarray:
    """Drops what is between the pixels."""
    d = np.round(d)
    return np.where(d >= 0, f * baseline / np.abs(d), np.nan)


def zero_is_unknown(d: np.ndarray, f: float, baseline: float) -> np.ndarray:
    """Takes 0 for missing."""
    return np.where(d > 0, f * baseline / d, np.nan)


def zero_for_all_else(d: np.ndarray, f: float, baseline: float) -> np.ndarray:
    """Gives a depth of 0 to whatever is not positive."""
    return np.where(d > 0, f * baseline / d, 0.0)


def zero_made_small(d: np.ndarray, f: float, baseline: float) -> np.ndarray:
    """Keeps the division from its infinity."""
    return f * baseline / np.maximum(d, 1e-6)


def behind_the_cameras(d: np.ndarray, f: float, baseline: float) -> np.ndarray:
    """Divides whatever comes."""
    return f * baseline / d


def sign_dropped(d: np.ndarray, f: float, baseline: float) -> np.ndarray:
    """Takes the disparity's size."""
    return f * baseline / np.abs(d)


def unknown_is_zero(d: np.ndarray, f: float, baseline: float) -> np.ndarray:
    """Gives unknown disparities the value 0."""
    d = np.nan_to_num(d)
    return np.where(d >= 0, f * baseline / np.abs(d), np.nan)


DEPTH_MISTAKES = (
    Mistake(
        "proportional",
        proportional,
        "Your depth grows with the disparity. It is the other way round: near things jump further. Z = f B / d.",
    ),
    Mistake("upside down", upside_down, "You returned 1 / Z. By similar triangles Z / B = f / d, so that Z = f B / d."),
    Mistake(
        "baseline forgotten",
        baseline_forgotten,
        "You returned f / d: the depth in baselines. Multiply by the baseline, and it is in metres.",
    ),
    Mistake(
        "f forgotten",
        f_forgotten,
        "You returned B / d, metres per pixel. Multiply by the focal length, which is in pixels too: Z = f B / d.",
    ),
    Mistake(
        "whole pixels",
        whole_pixels,
        "You rounded the disparity to whole pixels. Far away that costs metres: at 20 m, 4.2 px instead of 4 is one metre.",
    ),
    Mistake(
        "0 is unknown",
        zero_is_unknown,
        "All is right but d = 0, for which you returned nan. Parallel rays are no missing measurement: the point is "
        "infinitely far, return inf.",
    ),
    Mistake(
        "0 for all else",
        zero_for_all_else,
        "Where d is not positive you returned a depth of 0, which is at the camera. d = 0 is infinitely far (inf); nan and "
        "negative disparities are unknown (nan).",
    ),
    Mistake(
        "0 made small",
        zero_made_small,
        "You replaced small disparities by a tiny positive number: the depth is then a made-up one. Let d = 0 give inf, and "
        "negative ones nan.",
    ),
    Mistake(
        "behind the cameras",
        behind_the_cameras,
        "All is right but negative disparities, which you turned into points behind the cameras. Nothing that both see "
        "causes one: return nan.",
    ),
    Mistake(
        "sign dropped",
        sign_dropped,
        "All is right but negative disparities, whose sign you dropped. Nothing in front of both cameras causes one, it is "
        "a wrong match: return nan.",
    ),
    Mistake(
        "unknown made 0",
        unknown_is_zero,
        "All is right but unknown disparities (nan), which you took for 0, infinitely far. Unknown stays unknown: return "
        "nan.",
    ),
)


def depth_one_by_one(d: np.ndarray, f: float, baseline: float) -> np.ndarray:
    """A case after the other, number by number."""
    depth = []
    for shift in d.ravel().tolist():
        if shift > 0:
            depth.append(f * baseline / shift)
        else:
            depth.append(float("inf") if shift == 0 else float("nan"))
    return np.array(depth).reshape(d.shape)


def depth_by_masks(d: np.ndarray, f: float, baseline: float) -> np.ndarray:
    """From the angle between the two rays, into an array of nan."""
    depth = np.full(d.shape, np.nan)
    depth[d == 0] = np.inf
    depth[d > 0] = baseline / (d[d > 0] / f)
    return depth


# sad_cost_volume ------------------------------------------------------------------------------------------------------


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
    if left.shape != right.shape or window < 1 or window % 2 == 0 or not 0 <= max_disparity < left.shape[1]:
        raise ValueError("sizes, window or range")


def other_direction(left: np.ndarray, right: np.ndarray, max_disparity: int, window: int) -> np.ndarray:
    """right(x + d)."""
    return volume(left[:, ::-1], right[:, ::-1], max_disparity, window)[:, :, ::-1]


def seen_from_right(left: np.ndarray, right: np.ndarray, max_disparity: int, window: int) -> np.ndarray:
    """The costs of the right picture's pixels."""
    return volume(right[:, ::-1], left[:, ::-1], max_disparity, window)[:, :, ::-1]


def rolled_round(left: np.ndarray, right: np.ndarray, max_disparity: int, window: int) -> np.ndarray:
    """np.roll: what leaves on one side comes back on the other."""
    refuse(left, right, max_disparity, window)
    return np.array([windowed(difference(left, np.roll(right, d, axis=1)), window) for d in range(max_disparity + 1)])


def free_where_unseen(left: np.ndarray, right: np.ndarray, max_disparity: int, window: int) -> np.ndarray:
    """0 where there is nothing to compare with."""
    return volume(left, right, max_disparity, window, outside=0.0)


def squares(left: np.ndarray, right: np.ndarray, max_disparity: int, window: int) -> np.ndarray:
    """SSD."""
    return volume(left, right, max_disparity, window, compare=lambda a, b: difference(a, b) ** 2)


def signed(left: np.ndarray, right: np.ndarray, max_disparity: int, window: int) -> np.ndarray:
    """The differences with their signs."""
    return volume(left, right, max_disparity, window, compare=lambda a, b: a.astype(float) - b)


def averaged(left: np.ndarray, right: np.ndarray, max_disparity: int, window: int) -> np.ndarray:
    """The mean over the window."""
    return volume(left, right, max_disparity, window) / window**2


def wrapping(left: np.ndarray, right: np.ndarray, max_disparity: int, window: int) -> np.ndarray:
    """Subtracts bytes as they come."""
    return volume(left, right, max_disparity, window, compare=lambda a, b: np.abs(a - b).astype(float))


def zeros_around(left: np.ndarray, right: np.ndarray, max_disparity: int, window: int) -> np.ndarray:
    """Windows that reach over the border sum fewer cells."""

    def add_up(image: np.ndarray, window: int) -> np.ndarray:
        r = window // 2
        return windowed(np.pad(image, r), window)[r : r + image.shape[0], r : r + image.shape[1]]

    return volume(left, right, max_disparity, window, add_up=add_up)


def pictures_padded(left: np.ndarray, right: np.ndarray, max_disparity: int, window: int) -> np.ndarray:
    """Repeats the border of the pictures, not that of the slice."""
    r, (h, w) = window // 2, left.shape
    wide, other = (
        np.pad(picture.astype(float), ((r, r), (r + max_disparity, r)), mode="edge") for picture in (left, right)
    )
    cost = np.full((max_disparity + 1, h, w), np.inf)
    for d in range(max_disparity + 1):
        off = np.abs(wide[:, max_disparity:] - other[:, max_disparity - d : other.shape[1] - d])
        sums = np.lib.stride_tricks.sliding_window_view(off, (window, window)).sum(axis=(2, 3))
        cost[d, :, d:] = sums[:, d:]
    return cost


def window_ignored(left: np.ndarray, right: np.ndarray, max_disparity: int, window: int) -> np.ndarray:
    """One pixel at a time."""
    return volume(left, right, max_disparity, window, add_up=lambda image, _: image)


def window_for_radius(left: np.ndarray, right: np.ndarray, max_disparity: int, window: int) -> np.ndarray:
    """A window of 2 window + 1."""
    return volume(left, right, max_disparity, 2 * window + 1)


def disparity_last(left: np.ndarray, right: np.ndarray, max_disparity: int, window: int) -> np.ndarray:
    """cost[y, x, d]."""
    return np.moveaxis(volume(left, right, max_disparity, window), 0, 2)


def one_slice_less(left: np.ndarray, right: np.ndarray, max_disparity: int, window: int) -> np.ndarray:
    """range(max_disparity)."""
    return volume(left, right, max_disparity, window)[:max_disparity]


def even_windows_too(left: np.ndarray, right: np.ndarray, max_disparity: int, window: int) -> np.ndarray:
    """Makes an even window odd."""
    return volume(left, right, max_disparity, window | 1)


VOLUME_MISTAKES = (
    Mistake(
        "other direction",
        other_direction,
        "You compare left (x) with right (x + d). The right camera stands to the right, so that things are further left in "
        "its picture: right (x - d).",
    ),
    Mistake(
        "seen from the right",
        seen_from_right,
        "Your costs are those of the right picture's pixels: right (x) against left (x + d). cost[d, y, x] belongs to left "
        "pixel x, against right (x - d).",
    ),
    Mistake(
        "rolled round",
        rolled_round,
        "You rolled the right picture round: its last columns come in again on the left. Where x < d it shows nothing to "
        "compare with: the cost is inf.",
    ),
    Mistake(
        "free where unseen",
        free_where_unseen,
        "Your cost is 0 where x < d. There is nothing to compare with, and 0 is the best cost there is: it would win. Use "
        "inf.",
    ),
    Mistake("squares", squares, "You summed squared differences: that is SSD. SAD sums absolute ones."),
    Mistake(
        "signed differences",
        signed,
        "You summed the differences with their signs: too bright here and too dark there cancel. Take absolute values "
        "first.",
    ),
    Mistake(
        "mean", averaged, "You took the mean over the window. The contract asks for the sum: window² times as much."
    ),
    Mistake(
        "bytes wrap round",
        wrapping,
        "You subtracted bytes: in uint8, 3 - 5 is 254. Convert the pictures to float before you subtract.",
    ),
    Mistake(
        "zeros around",
        zeros_around,
        "Your windows count 0 beyond the border, which makes matches there look better than they are. Repeat the border's "
        "cells (np.pad in mode edge).",
    ),
    Mistake(
        "pictures padded",
        pictures_padded,
        "You repeated the border of the pictures, so that a window near x = d compares columns that do not match. Take the "
        "differences first, then repeat the border of their slice.",
    ),
    Mistake(
        "window ignored",
        window_ignored,
        "You compare single pixels whatever the window. Sum the differences over window x window pixels.",
    ),
    Mistake(
        "window for radius",
        window_for_radius,
        "Your window is 2 window + 1 wide. `window` is its whole side, not its reach: it reaches window // 2 each way.",
    ),
    Mistake(
        "disparity last",
        disparity_last,
        "Your volume has the disparity as last axis. The contract asks for cost[d, y, x]: np.moveaxis(cost, 2, 0).",
    ),
    Mistake(
        "last slice missing",
        one_slice_less,
        "Your volume ends at max_disparity - 1: range(n) stops before n. There are max_disparity + 1 slices, from 0.",
    ),
    Mistake(
        "even windows",
        even_windows_too,
        "All is right but that you accept even windows, which have no middle pixel: raise a ValueError.",
    ),
)


def volume_by_running_sums(left: np.ndarray, right: np.ndarray, max_disparity: int, window: int) -> np.ndarray:
    """Differences of the sums over all cells above and to the left."""
    h, w = left.shape
    if right.shape != (h, w) or window % 2 != 1 or window < 1 or max_disparity < 0 or max_disparity >= w:
        raise ValueError("pictures of one size, an odd window, and shifts within the picture")
    cost = np.full((max_disparity + 1, h, w), np.inf)
    for d in range(max_disparity + 1):
        off = np.abs(left[:, d:].astype(float) - right[:, : w - d].astype(float))
        off = np.pad(off, window // 2, mode="edge")
        sums = np.pad(off.cumsum(axis=0).cumsum(axis=1), ((1, 0), (1, 0)))
        cost[d, :, d:] = (
            sums[window:, window:] - sums[:-window, window:] - sums[window:, :-window] + sums[:-window, :-window]
        )
    return cost


def volume_by_shifts(left: np.ndarray, right: np.ndarray, max_disparity: int, window: int) -> np.ndarray:
    """One pixel of the window after the other, indices kept inside the slice."""
    (h, w), reach = left.shape, window // 2
    if left.shape != right.shape:
        raise ValueError("sizes")
    if window <= 0 or not window & 1:
        raise ValueError("window")
    if max_disparity not in range(w):
        raise ValueError("range")
    a, b, cost = np.asarray(left, float), np.asarray(right, float), np.zeros((max_disparity + 1, h, w))
    y, x = np.mgrid[:h, :w]
    for d in range(max_disparity + 1):
        for up in range(-reach, reach + 1):
            for aside in range(-reach, reach + 1):
                row, column = np.clip(y + up, 0, h - 1), np.clip(x + aside, d, w - 1)
                cost[d] += abs(a[row, column] - b[row, column - d])
        cost[d, x < d] = np.inf
    return cost


# winner_takes_all -----------------------------------------------------------------------------------------------------


def highest_wins(cost: np.ndarray) -> np.ndarray:
    """The worst match."""
    return np.argmax(cost, axis=0)


def last_of_several(cost: np.ndarray) -> np.ndarray:
    """The largest disparity of those with the lowest cost."""
    return len(cost) - 1 - np.argmin(cost[::-1], axis=0)


def lowest_cost(cost: np.ndarray) -> np.ndarray:
    """The cost, not where it is."""
    return np.min(cost, axis=0)


def counted_from_one(cost: np.ndarray) -> np.ndarray:
    """Slices counted from 1."""
    return np.argmin(cost, axis=0) + 1


def zero_left_out(cost: np.ndarray) -> np.ndarray:
    """Never chooses 0."""
    return np.argmin(cost[1:], axis=0) + 1 if len(cost) > 1 else np.zeros(cost.shape[1:], int)


def infinity_wins(cost: np.ndarray) -> np.ndarray:
    """Takes what cannot be compared for a perfect match."""
    return np.argmin(np.where(np.isinf(cost), 0, cost), axis=0)


def first_valley(cost: np.ndarray) -> np.ndarray:
    """Stops where the cost first rises."""
    winner = np.zeros(cost.shape[1:], int)
    falling = np.ones(cost.shape[1:], bool)
    for d in range(1, len(cost)):
        falling &= cost[d] < cost[d - 1]
        winner[falling] = d
    return winner


def along_columns(cost: np.ndarray) -> np.ndarray:
    """The best column of every row of every slice."""
    return np.argmin(cost, axis=2)


def over_everything(cost: np.ndarray) -> np.ndarray:
    """The best cell of the whole volume."""
    return np.full(cost.shape[1:], np.unravel_index(np.argmin(cost), cost.shape)[0])


WINNER_MISTAKES = (
    Mistake(
        "highest wins", highest_wins, "You took the highest cost, the worst match. A cost is low where two pixels fit."
    ),
    Mistake(
        "last of several",
        last_of_several,
        "All is right but ties: of several equal costs you took the largest disparity, the contract asks for the smallest. "
        "Let a later one win only where it is lower (<, not <=).",
    ),
    Mistake(
        "lowest cost", lowest_cost, "You returned the lowest cost itself. Asked for is the disparity at which it is."
    ),
    Mistake(
        "counted from 1", counted_from_one, "Your disparities are all one too large: cost[0] is that of disparity 0."
    ),
    Mistake(
        "0 left out",
        zero_left_out,
        "You never choose 0. That is a disparity as good as any, of what is very far away; it does not mean missing.",
    ),
    Mistake(
        "infinity wins",
        infinity_wins,
        "You replaced infinite costs by 0, so that they win. They mark what the right picture does not show: leave them.",
    ),
    Mistake(
        "first valley",
        first_valley,
        "You stopped where the cost first rises. Curves have many valleys, and a later one may be deeper: look at all.",
    ),
    Mistake(
        "along columns",
        along_columns,
        "You looked for the lowest cost along a row of the picture. The disparity is the first axis: axis=0.",
    ),
    Mistake(
        "one for all pixels",
        over_everything,
        "You looked for the lowest cost of the whole volume. Each pixel has its own: np.argmin(cost, axis=0).",
    ),
)


def winner_by_sorting(cost: np.ndarray) -> np.ndarray:
    """The first in a stable order."""
    return np.argsort(cost, axis=0, kind="stable")[0]


def winner_slice_by_slice(cost: np.ndarray) -> np.ndarray:
    """A better slice overwrites."""
    winner, lowest = np.zeros(cost.shape[1:], np.int32), cost[0].astype(float)
    for d, piece in enumerate(cost):
        better = piece < lowest
        winner[better], lowest[better] = d, piece[better]
    return winner
