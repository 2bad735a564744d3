"""Write the choice: at every pixel the disparity whose cost is lowest. The lesson chooses with it
after every slice and every path, for the left picture and, to check, for the right one.
"""

import numpy as np
from jaxtyping import Int, Real

from lessons.disparity.exercises import STUDENTS
from workbench.algorithms.stereo import disparity_map
from workbench.exercise import (
    Function,
    Verdict,
    alternative,
    band,
    check,
    contract,
    full,
    left_alone,
    mistake,
)


@contract(
    slot="choose",
    examples=(
        ("winner_takes_all(np.array([[[4.0, 4.0, 7.0]], [[np.inf, 0.0, 7.0]]]))", "[[0, 1, 0]]"),
        ("winner_takes_all(np.array([[[9, 2]], [[3, 5]], [[6, 1]]]))", "[[1, 2]]"),
    ),
)
def winner_takes_all(cost: Real[np.ndarray, "d h w"]) -> Int[np.ndarray, "h w"]:
    """Return the disparity of the lowest cost at every pixel.

    Args:
        cost: cost[d, y, x] says how badly left pixel (y, x) matches at disparity d = 0, 1, 2, ...;
            low is alike. Floats or whole numbers, of any sign; inf where there is nothing to
            compare with. None is nan.

    Returns:
        Disparities, pixels, whole numbers (an integer type), in a new array. Of several equal costs
        the smallest disparity wins. A pixel whose costs are all inf gets 0. With a single slice all
        get 0.
    """
    return disparity_map.winner_takes_all(cost)


WINNER_HINT = "At each pixel: the d for which cost[d, y, x] is lowest."


def valleys(seed: int, shape: tuple[int, int, int]) -> tuple[np.ndarray, np.ndarray]:
    """Return rugged costs with one lowest cost per pixel, and the disparities at which these
    are.
    """
    rng = np.random.default_rng(seed)
    d = rng.integers(0, shape[0], shape[1:])
    cost = rng.uniform(5.0, 60.0, shape)
    np.put_along_axis(cost, d[None], rng.uniform(0.5, 4.0, (1, *shape[1:])), axis=0)
    return cost, d


def map_verdict(
    got: np.ndarray, right: np.ndarray, label: str = "", hint: str = WINNER_HINT
) -> Verdict:
    """Judge disparities by the share of wrong pixels, per cent, and name the first of them."""
    wrong = got != right
    if not wrong.any():
        return full(f"{label}{wrong.size} of {wrong.size} pixels are right.")
    y, x = (int(i) for i in np.argwhere(wrong)[0])
    message = f"At (y, x) = ({y}, {x}) yours is {got[y, x]}, right is {right[y, x]}. {hint}"
    return band(
        f"{label}wrong pixels" if label else "Wrong pixels",
        100 * float(wrong.mean()),
        "%",
        good=0,
        fair=5,
        hint=message,
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
    return map_verdict(
        candidate(cost), np.argmin(cost, axis=0), hint="Of equal costs the first one wins."
    )


@check(1)
def costs_are_left_alone(candidate: Function) -> Verdict:
    """The costs that come in are not changed."""
    cost, d = valleys(STUDENTS + 2, (5, 4, 6))
    return left_alone(candidate, map_verdict(candidate(cost), d))


@mistake("You took the highest cost, the worst match. A cost is low where two pixels fit.")
def highest_wins(cost: np.ndarray) -> np.ndarray:
    """The worst match."""
    return np.argmax(cost, axis=0)


@mistake(
    "All is right but ties: of several equal costs you took the largest disparity, the contract"
    " asks for the smallest. Let a later one win only where it is lower (<, not <=)."
)
def last_of_several(cost: np.ndarray) -> np.ndarray:
    """The largest disparity of those with the lowest cost."""
    return len(cost) - 1 - np.argmin(cost[::-1], axis=0)


@mistake("You returned the lowest cost itself. Asked for is the disparity at which it is.")
def lowest_cost(cost: np.ndarray) -> np.ndarray:
    """The cost, not where it is."""
    return np.min(cost, axis=0)


@mistake("Your disparities are all one too large: cost[0] is that of disparity 0.")
def counted_from_1(cost: np.ndarray) -> np.ndarray:
    """Slices counted from 1."""
    return np.argmin(cost, axis=0) + 1


@mistake(
    "You never choose 0. That is a disparity as good as any, of what is very far away; it does not"
    " mean missing."
)
def zero_left_out(cost: np.ndarray) -> np.ndarray:
    """Never chooses 0."""
    return np.argmin(cost[1:], axis=0) + 1 if len(cost) > 1 else np.zeros(cost.shape[1:], int)


@mistake(
    "You replaced infinite costs by 0, so that they win. They mark what the right picture does not"
    " show: leave them."
)
def infinity_wins(cost: np.ndarray) -> np.ndarray:
    """Takes what cannot be compared for a perfect match."""
    return np.argmin(np.where(np.isinf(cost), 0, cost), axis=0)


@mistake(
    "You stopped where the cost first rises. Curves have many valleys, and a later one may be"
    " deeper: look at all."
)
def first_valley(cost: np.ndarray) -> np.ndarray:
    """Stops where the cost first rises."""
    winner = np.zeros(cost.shape[1:], int)
    falling = np.ones(cost.shape[1:], bool)
    for d in range(1, len(cost)):
        falling &= cost[d] < cost[d - 1]
        winner[falling] = d
    return winner


@mistake(
    "You looked for the lowest cost along a row of the picture. The disparity is the first axis:"
    " axis=0."
)
def along_columns(cost: np.ndarray) -> np.ndarray:
    """The best column of every row of every slice."""
    return np.argmin(cost, axis=2)


@mistake(
    "You looked for the lowest cost of the whole volume. Each pixel has its own: np.argmin(cost,"
    " axis=0)."
)
def one_for_all_pixels(cost: np.ndarray) -> np.ndarray:
    """The best cell of the whole volume."""
    return np.full(cost.shape[1:], np.unravel_index(np.argmin(cost), cost.shape)[0])


@alternative
def winner_by_sorting(cost: np.ndarray) -> np.ndarray:
    """The first in a stable order."""
    return np.argsort(cost, axis=0, kind="stable")[0]


@alternative
def winner_slice_by_slice(cost: np.ndarray) -> np.ndarray:
    """A better slice overwrites."""
    winner = np.zeros(cost.shape[1:], np.int32)
    lowest = cost[0].astype(float)
    for d, piece in enumerate(cost):
        better = piece < lowest
        winner[better] = d
        lowest[better] = piece[better]
    return winner
