"""Maps at every window and at every price of a jump, and how many of their pixels are wrong."""

import functools

import numpy as np

from lessons.disparity.pairs import taken
from workbench.algorithms.stereo.cost_volume import box_sums, sad_cost_volume
from workbench.algorithms.stereo.disparity import usual_penalties
from workbench.algorithms.stereo.disparity_map import winner_takes_all
from workbench.algorithms.stereo.semiglobal import semi_global
from workbench.data.views.stereo import StereoPair, grey
from workbench.scene import Role

WINDOWS = (1, 3, 5, 7, 9, 11, 15, 21)
PRICES = (0.0, 0.1, 0.2, 0.3, 0.5, 0.7, 1.0, 1.5, 2.0, 3.0, 4.0)
PRICED: dict[str, Role] = {
    "repeated pattern": "wrong",
    "plain wall": "target",
    "spheres": "truth",
}


def smoothed(cost: np.ndarray, price: float) -> np.ndarray:
    """Return the map of the lowest costs, after eight paths where a jump has a price."""
    if price > 0:
        for paths in semi_global(cost, *usual_penalties(cost, price)):
            cost = paths.total
    return winner_takes_all(cost)


@functools.lru_cache(maxsize=16)
def wrong_over_windows(scene: str, noise: float, seed: int) -> np.ndarray:
    """Return the share of wrong pixels (%) at each of WINDOWS, without paths."""
    pair = taken(scene, 150.0, 0.1, noise=noise, seed=seed)
    maps = winners_by_window(grey(pair.left), grey(pair.right), 31)
    return np.array([_off(pair, winner) for winner in maps])


def winners_by_window(left: np.ndarray, right: np.ndarray, max_disparity: int) -> np.ndarray:
    """Return the map of the lowest sums of absolute differences for each of WINDOWS.

    Shift by shift, so that the running sums of one serve all windows. Brightness is whole
    thousandths, and a sum and its shift are one number: the least of these tells both. 32 bits hold
    it for differences up to 255 at the largest window and 32 shifts.
    """
    h, w = left.shape
    shifts = max_disparity + 1
    a, b = (np.rint(1000 * picture).astype(np.int32) for picture in (left, right))
    least = np.full((len(WINDOWS), h, w), np.iinfo(np.uint32).max, np.uint32)
    for d in range(shifts):
        off = shifts * np.abs(a[:, d:] - b[:, : w - d]).astype(np.uint32)
        for cost, best in zip(box_sums(off, WINDOWS), least[..., d:], strict=True):
            np.minimum(best, cost + np.uint32(d), out=best)
    return (least % shifts).astype(int)


@functools.lru_cache(maxsize=16 * len(PRICED) * len(PRICES))
def wrong_at_price(scene: str, seed: int, price: float) -> float:
    """Return the share of wrong pixels (%) at one price, with a noise of 4 and a window of 3."""
    pair, cost = _compared(scene, seed)
    return _off(pair, smoothed(cost, price))


@functools.lru_cache(maxsize=len(PRICED))
def _compared(scene: str, seed: int) -> tuple[StereoPair, np.ndarray]:
    pair = taken(scene, 150.0, 0.1, noise=4.0, seed=seed)
    return pair, sad_cost_volume(grey(pair.left), grey(pair.right), 31, 3)


def _off(pair: StereoPair, disparity: np.ndarray) -> float:
    assert pair.disparity is not None
    return 100.0 * float((np.abs(disparity - pair.disparity) > 1.0)[pair.visible].mean())
