"""The whole way from two pictures to disparities and depths, in steps.

Pictures are grey, of one size, rows correspond. Maps are for the left picture, pixels: d = x_left -
x_right. NaN is unknown; 0 is a disparity like any other, that of something infinitely far.

Reference: Scharstein and Szeliski, A taxonomy and evaluation of dense two-frame stereo
correspondence algorithms, IJCV 2002, section 3; Hirschmueller, PAMI 2008, section 2.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from enum import Enum
from typing import TypeAlias

import numpy as np
from jaxtyping import Bool, Float, Real

from workbench.algorithms.stereo.cost_volume import CostVolume, sad_cost_volume
from workbench.algorithms.stereo.disparity_map import (
    agree,
    fill,
    median3,
    seen_from_right,
    sub_pixel,
    winner_takes_all,
    winners,
)
from workbench.algorithms.stereo.semiglobal import semi_global
from workbench.geometry.cameras.stereo import depth_from_disparity, depth_uncertainty
from workbench.tracing import traced

Choose: TypeAlias = Callable[[np.ndarray], np.ndarray]
"""choose(cost (d, h, w)) -> disparity (h, w), whole pixels."""

Penalties: TypeAlias = Callable[[np.ndarray], tuple[float, float]]
"""penalties(cost (d, h, w)) -> P1, P2."""

DepthOf: TypeAlias = Callable[[np.ndarray, float, float], np.ndarray]
"""depth_of(disparity, f in pixels, baseline in metres) -> depth in metres."""


class Stage(Enum):
    """What a step of `match` has just done."""

    COMPARE = "compared one more disparity"
    AGGREGATE = "summed the costs over a window"
    PATHS = "added the paths of one direction"
    CHECK = "checked left against right"
    REFINE = "refined between pixels"
    SMOOTH = "took the median of neighbours"


@dataclass(frozen=True, eq=False)
class Matching:
    """A step of `match`.

    Attributes:
        cost: The volume the map was chosen from; while comparing, its disparities so far.
        matched: Which pixels are left by the check against the right picture; before it, all.
        summed: C(p, d), the matching costs summed over the window; None while comparing.
        jumps: P1 and P2, zeros without paths.
        done: How many disparities were compared, or directions added, so far.
        direction: The direction (rows down, columns right) just added, if one was.
    """

    stage: Stage
    cost: Real[np.ndarray, "d h w"]
    disparity: Float[np.ndarray, "h w"]
    matched: Bool[np.ndarray, "h w"]
    summed: Real[np.ndarray, "d h w"] | None = None
    jumps: tuple[float, float] = (0.0, 0.0)
    done: int = 0
    direction: tuple[int, int] | None = None


def usual_penalties(cost: Real[np.ndarray, "d h w"], smoothness: float) -> tuple[float, float]:
    """Return P1 = P2 / 3 and P2 = `smoothness` times the median cost, of any unit."""
    some = cost[:, ::3, ::3]
    P2 = smoothness * float(np.median(some[np.isfinite(some)]))
    return P2 / 3.0, P2


@traced
def match(
    left: Real[np.ndarray, "h w"],
    right: Real[np.ndarray, "h w"],
    max_disparity: int,
    *,
    window: int,
    penalties: Penalties | None,
    compare: CostVolume = sad_cost_volume,
    choose: Choose | None = None,
) -> Iterator[Matching]:
    """Yield the disparity of every left pixel as it is found, stage by stage.

    `penalties` gives P1 and P2 of the semi-global paths by the summed costs; None leaves them out.
    `choose` is called with all slices so far after each. None is `winner_takes_all`, which is not:
    it goes on from where it was.
    """
    everywhere = np.ones(left.shape, bool)
    single = compare(left, right, max_disparity, 1)
    slices = range(1, max_disparity + 2)
    maps = winners(single) if choose is None else (choose(single[:done]) for done in slices)
    for done, chosen in zip(slices, maps, strict=True):
        cost = single[:done]
        yield Matching(Stage.COMPARE, cost, chosen.astype(float), everywhere, done=done)

    choose = choose or winner_takes_all
    cost = summed = single if window == 1 else compare(left, right, max_disparity, window)
    jumps = (0.0, 0.0) if penalties is None else penalties(summed)
    chosen = choose(cost)
    yield Matching(Stage.AGGREGATE, cost, chosen.astype(float), everywhere, summed, jumps)

    for done, paths in enumerate(semi_global(summed, *jumps) if penalties else (), 1):
        cost = paths.total
        chosen = choose(cost)
        disparity = chosen.astype(float)
        way = paths.direction
        yield Matching(Stage.PATHS, cost, disparity, everywhere, summed, jumps, done, way)

    winner = chosen.astype(int)
    matched = agree(winner, choose(seen_from_right(cost)).astype(int))
    yield Matching(Stage.CHECK, cost, np.where(matched, winner, np.nan), matched, summed, jumps)

    refined = sub_pixel(cost, winner)
    yield Matching(Stage.REFINE, cost, np.where(matched, refined, np.nan), matched, summed, jumps)

    smooth = median3(fill(refined, matched))
    yield Matching(Stage.SMOOTH, cost, np.where(matched, smooth, np.nan), matched, summed, jumps)


@dataclass(frozen=True, eq=False)
class Depths:
    """A step of `reconstruct`: depths and what a disparity error makes of them, metres."""

    depth: Float[np.ndarray, "h w"]
    uncertainty: Float[np.ndarray, "h w"] | None = None


@traced
def reconstruct(
    disparity: Float[np.ndarray, "h w"],
    f: float,
    baseline: float,
    *,
    disparity_error: float,
    depth_of: DepthOf = depth_from_disparity,
) -> Iterator[Depths]:
    """Yield the depths of a disparity map, then the same with their uncertainty.

    Args:
        disparity: Pixels, doffs added where the principal points differ.
        f: Focal length, pixels.
        baseline: Distance between the cameras, metres.
        disparity_error: Of each disparity, pixels.
    """
    Z = depth_of(disparity, f, baseline)  # Z = f B / d
    yield Depths(Z)

    # |dZ/dd| sigma_d = Z² / (f B) sigma_d
    uncertainty = depth_uncertainty(Z, f, baseline, disparity_error=disparity_error)
    yield Depths(Z, uncertainty)
