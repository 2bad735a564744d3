"""Disparity maps: chosen from costs, checked, refined between pixels, smoothed and filled.

A map is for the left picture, pixels: d = x_left - x_right. Costs are as in `cost_volume`.
"""

from collections.abc import Iterator

import numpy as np
from jaxtyping import Bool, Float, Int, Real, UInt

WholeMap = Int[np.ndarray, "h w"]


def winner_takes_all(cost: Real[np.ndarray, "d h w"]) -> WholeMap:
    """Return the disparity of the lowest cost at every pixel; the smallest of several.

    Reference: Scharstein and Szeliski, IJCV 2002, section 3.3.

    Examples:
        >>> cost = np.array([[[3.0, 1.0]], [[2.0, 1.0]]])  # two disparities, 1 x 2 pixels
        >>> winner_takes_all(cost).tolist()
        [[1, 0]]
    """
    *_, winner = winners(cost)
    return winner.astype(np.int16 if winner.dtype == np.uint8 else np.intp)


def winners(cost: Real[np.ndarray, "d h w"]) -> Iterator[UInt[np.ndarray, "h w"]]:
    """Yield `winner_takes_all` of the first slice, of the first two, and so on.

    It is one array, which the next slice changes.
    """
    lowest = cost[0].copy()
    number = np.uint8 if len(cost) <= 2**8 else np.uint16
    winner = np.zeros(lowest.shape, number)
    yield winner
    for d in range(1, len(cost)):
        better = (cost[d] < lowest).view(np.uint8)
        # d grows, so the latest winner is the largest
        np.maximum(winner, better * number(d), out=winner)
        np.minimum(lowest, cost[d], out=lowest)
        yield winner


def seen_from_right(cost: Real[np.ndarray, "d h w"]) -> Real[np.ndarray, "d h w"]:
    """Return the same costs by right pixel: right (x, y) at d was compared with left (x + d, y)."""
    worst = np.inf if cost.dtype.kind == "f" else np.iinfo(cost.dtype).max
    turned = np.full_like(cost, worst)
    w = cost.shape[2]
    for d in range(len(cost)):
        turned[d, :, : w - d] = cost[d, :, d:]
    return turned


def agree(
    left_disparity: WholeMap, right_disparity: WholeMap, tolerance: int = 1
) -> Bool[np.ndarray, "h w"]:
    """Return whether each left pixel's partner has it as its own, within `tolerance` pixels.

    Occluded pixels fail, for the right picture shows something nearer there; so do most wrong
    matches.

    Reference: Hirschmueller, PAMI 2008, section 2.3.
    """
    w = left_disparity.shape[1]
    partner = np.arange(w) - left_disparity
    inside = (partner >= 0) & (partner < w)
    back = np.take_along_axis(right_disparity, np.where(inside, partner, 0), axis=1)
    return inside & (np.abs(back - left_disparity) <= tolerance)


def sub_pixel(cost: Real[np.ndarray, "d h w"], disparity: WholeMap) -> Float[np.ndarray, "h w"]:
    """Return disparities at the lowest point of the parabola through a cost and the two beside it.

    No disparity moves by more than half a pixel. At either end of the range, beside an infinite
    cost, and where the three costs have no valley, it stays whole.

    Reference: Scharstein and Szeliski, IJCV 2002, section 3.4.
    """
    middle = np.clip(disparity, 1, max(len(cost) - 2, 1)).astype(np.intp)
    if len(cost) < 3:
        return disparity.astype(float)
    before, here, after = (
        np.take_along_axis(cost, (middle + k)[None], axis=0)[0].astype(float) for k in (-1, 0, 1)
    )
    valley = (
        (middle == disparity) & (here <= before) & (here <= after) & np.isfinite(before + after)
    )
    valley &= before + after > 2.0 * here
    before, here, after = (
        np.where(valley, values, flat)
        for values, flat in ((before, 1.0), (here, 0.0), (after, 1.0))
    )
    return disparity + (before - after) / (2.0 * (before - 2.0 * here + after))


def fill(
    disparity: Float[np.ndarray, "h w"], known: Bool[np.ndarray, "h w"]
) -> Float[np.ndarray, "h w"]:
    """Return the map, unknown pixels given the smaller of the known ones to their left and right.

    A region seen by one camera only lies behind what hides it from the other, so the background's
    disparity, the smaller, is continued. Rows without any known pixel stay as they are.

    Reference: Hirschmueller, PAMI 2008, section 2.5.3, along rows only.
    """
    w = disparity.shape[1]
    columns = np.arange(w)
    left = np.maximum.accumulate(np.where(known, columns, -1), axis=1)
    right = np.minimum.accumulate(np.where(known, columns, w)[:, ::-1], axis=1)[:, ::-1]
    from_left, from_right = (
        np.where(exists, np.take_along_axis(disparity, np.where(exists, column, 0), axis=1), np.inf)
        for exists, column in ((left >= 0, left), (right < w, right))
    )
    background = np.minimum(from_left, from_right)
    return np.where(known | np.isinf(background), disparity, background)


def median3(values: Float[np.ndarray, "h w"]) -> Float[np.ndarray, "h w"]:
    """Return the median over each 3 x 3 window, border pixels repeated.

    With each column sorted, it is the median of three: the largest low, the median mid, the
    smallest high (Smith, Implementing median filters in XC4000E FPGAs, XCELL 23, 1996).
    """
    h, w = values.shape
    padded = np.pad(values, 1, mode="edge")
    low, mid, high = _sorted3(padded[:h], padded[1 : h + 1], padded[2:])
    lows, mids, highs = (
        (line[:, :w], line[:, 1 : w + 1], line[:, 2:]) for line in (low, mid, high)
    )
    largest_low = np.maximum(np.maximum(lows[0], lows[1]), lows[2])
    smallest_high = np.minimum(np.minimum(highs[0], highs[1]), highs[2])
    return _sorted3(largest_low, _sorted3(*mids)[1], smallest_high)[1]


def _sorted3(
    a: np.ndarray, b: np.ndarray, c: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    low, high = np.minimum(a, b), np.maximum(a, b)
    return np.minimum(low, c), np.maximum(low, np.minimum(high, c)), np.maximum(high, c)
