"""The cost volume: how badly every left pixel matches each of its candidates in the right picture.

`cost[d, y, x]` compares the window around left (x, y) with the window around right (x - d, y), for
d = 0 .. max_disparity; low is alike. So `cost[d]` is an image: the left picture against the right
one shifted by d. Where x < d the right picture has no such pixel; those cells hold a cost that no
comparison exceeds (infinity for floats), so that they never win alone. A window that reaches over
the border of a slice counts the border's cells again.

Pictures are grey, of one size, rows correspond: floats of any range, or uint8, for which the sums
are exact whole numbers of the narrowest type. A window is the odd side of a square, pixels.

Reference: Scharstein and Szeliski, A taxonomy and evaluation of dense two-frame stereo
correspondence algorithms, IJCV 2002, sections 3.1 (matching cost) and 3.2 (aggregation); costs
compared in Hirschmueller and Scharstein, PAMI 2009.
"""

import functools
from collections.abc import Callable, Iterator, Sequence
from typing import TypeAlias

import numpy as np
from jaxtyping import Real, UInt8, UInt32

Costs = Real[np.ndarray, "d h w"]
Grey = Real[np.ndarray, "h w"]

CostVolume: TypeAlias = Callable[[np.ndarray, np.ndarray, int, int], np.ndarray]
"""cost_volume(left, right, max_disparity, window) -> cost (max_disparity + 1, h, w)."""

CENSUS_BITS = 24
"""Bits of the census code: the neighbours in a 5 x 5 window."""


def sad_cost_volume(left: Grey, right: Grey, max_disparity: int, window: int = 1) -> Costs:  # noqa: PLR0917
    """Return the sum of absolute grey differences over a window: cheap, and needs equal exposure.

    Raises:
        ValueError: If the sizes differ, the window is not odd and positive, or the shift exceeds
            the width.

    Examples:
        >>> right = np.array([[0, 9, 0, 0]], dtype=np.uint8)
        >>> left = np.array([[0, 0, 9, 0]], dtype=np.uint8)  # the bright pixel moved right by one
        >>> sad_cost_volume(left, right, max_disparity=1)[:, 0, 2].tolist()
        [9, 0]
    """
    return _windowed(
        left, right, max_disparity, window=window, difference=_absolute_difference, largest=255
    )


def ssd_cost_volume(left: Grey, right: Grey, max_disparity: int, window: int = 1) -> Costs:  # noqa: PLR0917
    """Return the sum of squared grey differences over a window; outliers weigh more.

    Raises:
        ValueError: As `sad_cost_volume`.
    """
    return _windowed(
        left, right, max_disparity, window=window, difference=_squared_difference, largest=255**2
    )


def census_cost_volume(left: Grey, right: Grey, max_disparity: int, window: int = 1) -> Costs:  # noqa: PLR0917
    """Return the number of bits in which the census codes differ, summed over a window.

    Only the order of grey values within a window matters. The costs are whole numbers (24 per pixel
    of the window at most) for pictures of every type.

    Raises:
        ValueError: As `sad_cost_volume`.

    Reference: Zabih and Woodfill, Non-parametric local transforms for computing visual
    correspondence, ECCV 1994.
    """
    return _windowed(
        census(left),
        census(right),
        max_disparity,
        window=window,
        difference=_hamming,
        largest=CENSUS_BITS,
    )


def ncc_cost_volume(left: Grey, right: Grey, max_disparity: int, window: int = 3) -> Costs:  # noqa: PLR0917
    """Return 1 - the normalised correlation of the windows: 0 (alike up to exposure) to 2.

    A window without contrast correlates with nothing: its cost is 1. One pixel has no correlation,
    so a window of 1 is taken as 3.

    Raises:
        ValueError: As `sad_cost_volume`.
    """
    _check(left, right, max_disparity, window=window)
    window = max(window, 3)
    # keeps the sums small
    a, b = (picture - picture.mean() for picture in (left.astype(float), right.astype(float)))
    h, w = left.shape
    cost = np.full((max_disparity + 1, h, w), np.inf)
    energy_a, energy_b = (box_sum(picture * picture, window, float) for picture in (a, b))
    contrast_a, contrast_b = (
        np.maximum(energy - box_sum(picture, window, float) ** 2 / window**2, 0.0)
        for energy, picture in ((energy_a, a), (energy_b, b))
    )
    mean_a, mean_b = (box_sum(picture, window, float) / window for picture in (a, b))
    floor = 1e-9 * max(energy_a.max(), energy_b.max(), 1e-300)
    for d in range(max_disparity + 1):
        together = (
            box_sum(a[:, d:] * b[:, : w - d], window, float) - mean_a[:, d:] * mean_b[:, : w - d]
        )
        contrast = contrast_a[:, d:] * contrast_b[:, : w - d]
        known = (contrast_a[:, d:] > floor) & (contrast_b[:, : w - d] > floor)
        correlation = np.where(known, together / np.sqrt(np.where(known, contrast, 1.0)), 0.0)
        cost[d, :, d:] = 1.0 - np.clip(correlation, -1.0, 1.0)
    return cost


def census(picture: Grey) -> UInt32[np.ndarray, "h w"]:
    """Return a 24-bit code: whether each neighbour in a 5 x 5 window is darker than the pixel."""
    h, w = picture.shape
    padded = _edged(picture, 2)
    neighbours = [(dy, dx) for dy in range(5) for dx in range(5) if (dy, dx) != (2, 2)]
    code = np.zeros((h, w), np.uint32)
    # eight bits at a time in bytes, which numpy handles four times as fast
    for start in range(0, CENSUS_BITS, 8):
        byte = np.zeros((h, w), np.uint8)
        for dy, dx in neighbours[start : start + 8]:
            byte += byte  # a shift by one bit takes eight times as long
            byte |= (padded[dy : dy + h, dx : dx + w] < picture).view(np.uint8)
        code = (code << np.uint32(8)) | byte
    return code


def box_sum(image: Grey, window: int, dtype: type | np.dtype) -> Grey:
    """Return the sum over the window around every pixel; border pixels stand in beyond it.

    `dtype` has to hold window² values.
    """
    return next(box_sums(image.astype(dtype, copy=False), (window,)))


def box_sums(image: Grey, windows: Sequence[int]) -> Iterator[Grey]:
    """Yield the sum over the window around every pixel, for each of these windows.

    Running sums over 1, 2, 4, 8, ... pixels are joined, rows first and then columns: the work grows
    with the logarithm of the window, and floats lose nothing to cancellation. The image's type has
    to hold the sums.
    """
    most = max(windows)
    if most == 1:
        yield from (image for _ in windows)
        return
    padded = _edged(image, most // 2)
    doubled = _doubled(padded, most)
    for window in windows:
        spare = (most - window) // 2
        rows = _joined(doubled, window, range(spare, spare + len(image)))
        columns = rows[:, spare : padded.shape[1] - spare].T
        yield _joined(_doubled(columns, window), window, range(image.shape[1])).T


def _edged(image: np.ndarray, margin: int) -> np.ndarray:
    """Return np.pad(image, margin, mode="edge"), which takes five times as long."""
    h, w = image.shape
    padded = np.empty((h + 2 * margin, w + 2 * margin), image.dtype)
    rows = padded[margin : margin + h]
    rows[:, :margin] = image[:, :1]
    rows[:, margin + w :] = image[:, -1:]
    rows[:, margin : margin + w] = image
    padded[:margin] = rows[0]
    padded[margin + h :] = rows[-1]
    return padded


def _doubled(image: np.ndarray, most: int) -> list[np.ndarray]:
    """Return the sums of 1, 2, 4, ... successive rows, up to so many."""
    sums = [image]
    length = 1
    while 2 * length <= most:
        sums.append(sums[-1][:-length] + sums[-1][length:])
        length *= 2
    return sums


def _joined(doubled: list[np.ndarray], window: int, starts: range) -> np.ndarray:
    """Return the sums of `window` successive rows from each start on, of sums by doubling."""
    done = starts.start
    parts = []
    for k in range(window.bit_length()):
        if window & (1 << k):
            parts.append(doubled[k][done : done + len(starts)])
            done += 1 << k
    return functools.reduce(np.add, parts)


def _windowed(
    left: np.ndarray,
    right: np.ndarray,
    max_disparity: int,
    *,
    window: int,
    difference: Callable[[np.ndarray, np.ndarray], np.ndarray],
    largest: int,
) -> np.ndarray:
    """Sum a difference over a window, for every disparity; `largest` bounds whole numbers."""
    _check(left, right, max_disparity, window=window)
    h, w = left.shape
    whole = left.dtype.kind == "u" and right.dtype.kind == "u"
    worst = largest * window**2 if whole else np.inf
    cost = np.empty((max_disparity + 1, h, w), np.min_scalar_type(worst) if whole else float)
    for d in range(max_disparity + 1):
        cost[d, :, d:] = box_sum(difference(left[:, d:], right[:, : w - d]), window, cost.dtype)
        cost[d, :, :d] = worst
    return cost


def _absolute_difference(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    if a.dtype.kind == "f":
        return np.abs(a - b)
    return np.maximum(a, b) - np.minimum(a, b)  # |a - b| that does not wrap around in uint8


def _squared_difference(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    difference = _absolute_difference(a, b)
    if difference.dtype == np.uint8:
        difference = difference.astype(np.uint16)
    return difference * difference


def _hamming(
    a: UInt32[np.ndarray, "h w"], b: UInt32[np.ndarray, "h w"]
) -> UInt8[np.ndarray, "h w"]:
    return np.bitwise_count(a ^ b)


def _check(left: np.ndarray, right: np.ndarray, max_disparity: int, *, window: int) -> None:
    if left.shape != right.shape:
        raise ValueError(f"the two pictures differ in size: {left.shape} and {right.shape}")
    if window < 1 or window % 2 == 0:
        raise ValueError(
            f"a window has a middle pixel, so its side is odd and positive, not {window}"
        )
    if not 0 <= max_disparity < left.shape[1]:
        raise ValueError(
            f"disparities up to {max_disparity} px in pictures {left.shape[1]} px wide"
        )
