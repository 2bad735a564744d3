"""Which points to try next, by chance alone or the most trusted first, and when to stop.

`size` is the number of rows in a sample; more `quality` is more trust.
"""

from collections.abc import Iterator
from itertools import count
from math import ceil

import numpy as np
from jaxtyping import Bool, Float, Int
from scipy.special import bdtrc

FEWEST_TRUSTED = 20
AHEAD = 64  # samples that are drawn at once


def uniform_samples(
    n: int, size: int, rng: np.random.Generator
) -> Iterator[Int[np.ndarray, " size"]]:
    """Yield samples of `size` different rows out of n, all sets equally likely, without end.

    Some are drawn ahead, so `rng` is for these samples alone.

    Raises:
        ValueError: If there are fewer rows than a sample needs.
    """
    if n <= 4 * size:
        while True:
            yield draw_samples(n, size, 1, rng=rng)[0]
    while True:
        rows = rng.integers(n, size=(AHEAD, size))
        ordered = np.sort(rows, axis=1)
        # a sample with a row twice is drawn again: the next one stands in for it
        yield from rows[(ordered[:, 1:] != ordered[:, :-1]).all(axis=1)]


def prosac_samples(
    quality: Float[np.ndarray, " n"],
    size: int,
    rng: np.random.Generator,
    *,
    grown_after: int = 20_000,
) -> Iterator[Int[np.ndarray, "..."]]:
    """Yield samples of the most trusted rows, from a pool that grows until it holds all rows.

    After `grown_after` draws the samples are as uniform as RANSAC's.

    Raises:
        ValueError: If there are fewer rows than a sample needs.

    Reference: Chum and Matas, Matching with PROSAC, CVPR 2005, section 2.1, eq. 3 (growth) and
    algorithm 1. There the pool stops growing at the termination length; here it goes on.
    """
    n = len(quality)
    order = np.argsort(-quality, kind="stable")
    _check(n, size)
    pool = size
    until = 1
    draws = grown_after * float(np.prod([(size - i) / (n - i) for i in range(size)]))
    for t in count(1):
        if t > until and pool < n:
            grown = draws * (pool + 1) / (pool + 1 - size)  # eq. 3
            pool = pool + 1
            until = until + ceil(grown - draws)
            draws = grown
        if t > until:  # every row is in the pool: uniform from here on
            yield order[draw_samples(n, size, 1, rng=rng)[0]]
        else:
            yield order[np.append(draw_samples(pool - 1, size - 1, 1, rng=rng)[0], pool - 1)]


def termination_length(
    inliers: Bool[np.ndarray, " n"],
    quality: Float[np.ndarray, " n"],
    size: int,
    *,
    by_chance: float = 0.05,
    doubt: float = 0.05,
) -> tuple[int, float]:
    """Return how many of the most trusted rows have the largest share of inliers, and this share.

    Asked how many samples this share needs, PROSAC's stopping rule answers with the fewest
    (maximality). Only lengths count at which a wrong model would hardly have so many inliers
    (non-randomness), from FEWEST_TRUSTED rows on, or from all where there are fewer: of less rows a
    few lucky ones end the run. Where no length counts, both numbers are 0.

    Args:
        size: Rows in a sample; these are near the model in any case.
        by_chance: How likely a row is near a wrong model.
        doubt: How likely a wrong model may have so many inliers.

    Reference: Chum and Matas, Matching with PROSAC, CVPR 2005, section 2.2 (stopping criterion; the
    tail of the binomial distribution exactly). FEWEST_TRUSTED: Raguram et al., USAC, 2013.

    Examples:
        >>> termination_length(np.arange(100) < 30, -np.arange(100.0), 4)
        (30, 1.0)
    """
    agreeing = np.cumsum(inliers[np.argsort(-quality, kind="stable")])
    n = np.arange(1, len(agreeing) + 1)
    # of at least so many beside the sample
    chance = bdtrc(agreeing - size - 1.0, np.maximum(n - size, 1), by_chance)
    counts = (n >= min(FEWEST_TRUSTED, len(n))) & (n > size) & (agreeing > size) & (chance < doubt)
    if not counts.any():
        return 0, 0.0
    share = np.where(counts, agreeing / n, 0.0)
    length = int(np.flatnonzero(share == share.max())[-1]) + 1
    return length, float(share.max())


def draw_samples(
    n: int, size: int, samples: int, *, rng: np.random.Generator
) -> Int[np.ndarray, "samples size"]:
    """Return so many samples of `size` different rows out of n, each in random order.

    Raises:
        ValueError: If there are fewer rows than a sample needs.
    """
    _check(n, size)
    if n <= 4 * size:
        return np.argsort(rng.random((samples, n)), axis=1)[:, :size]
    rows = rng.integers(n, size=(samples, size))
    while True:
        ordered = np.sort(rows, axis=1)
        repeated = (ordered[:, 1:] == ordered[:, :-1]).any(axis=1)
        if not repeated.any():
            return rows
        rows[repeated] = rng.integers(n, size=(np.count_nonzero(repeated), size))


def _check(n: int, size: int) -> None:
    if n < size:
        raise ValueError(f"a sample needs {size} points, there are only {n}")
