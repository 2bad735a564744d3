"""What winner_takes_all is graded by besides the checks that a student sees."""

import numpy as np

from lessons.disparity.exercises import GRADERS, textures
from lessons.disparity.exercises.winner_takes_all import WINNER_HINT, map_verdict, valleys
from workbench.algorithms.stereo import cost_volume
from workbench.exercise import Function, Verdict, band, check, worst


@check(2, public=False)
def two_boards(candidate: Function) -> Verdict:
    """On the costs of two pictures of a near and a far board, both are found."""
    boards = [textures(GRADERS() + k, 8, 28, shift) for k, shift in enumerate((3, 9))]
    left, right = (np.concatenate(halves) for halves in zip(*boards, strict=True))
    got = candidate(cost_volume.sad_cost_volume(left, right, 12, 3))[:, 9:]
    off = np.abs(got - np.repeat([[3], [9]], 8, axis=0)) > 1
    y, x = np.unravel_index(int(np.argmax(off)), off.shape)
    told = f"At (y, x) = ({y}, {x + 9}) yours is {got[y, x]}, right is {3 if y < 8 else 9}."
    hint = f"The far board is at 3 px, the near one at 9 px. {told} {WINNER_HINT}"
    return band("Pixels off by over 1 px", 100 * float(off.mean()), "%", good=5, fair=20, hint=hint)


@check(2, public=False)
def infinite_costs(candidate: Function) -> Verdict:
    """An infinite cost never wins, not over 10¹², but where all are: there it is 0, in a single
    slice too.
    """
    cost, _ = valleys(GRADERS() + 1, (8, 6, 10))
    d, _, x = np.indices(cost.shape)
    cost[x < d] = np.inf
    cost[:, 2, 3:5] = np.inf
    hint = "inf is worse than any number."
    single = np.where(np.arange(12).reshape(1, 3, 4) % 3 == 0, np.inf, 1.0)
    verdicts = [
        map_verdict(candidate(c), np.argmin(c, axis=0), hint=hint) for c in (cost, 1e12 * cost)
    ]
    return worst(
        [*verdicts, map_verdict(candidate(single), np.zeros((3, 4), int), "A single slice: ", hint)]
    )


@check(2, public=False)
def only_the_order_counts(candidate: Function) -> Verdict:
    """Scaled, shifted or turned round along d, the same costs win."""
    cost, d = valleys(GRADERS() + 2, (7, 8, 5))
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
    """Whole numbers up to 65,535, negative ones, equal ones, and a volume of a single slice, are
    fine.
    """
    cost = np.random.default_rng(GRADERS() + 3).integers(250, 2**16, (20, 6, 4)).astype(np.uint16)
    single = map_verdict(
        candidate(cost[:1].astype(float)), np.zeros((6, 4), int), "A single slice: "
    )
    signed = np.random.default_rng(GRADERS() + 4).integers(-9, 9, (6, 5, 7))
    few = np.random.default_rng(GRADERS() + 5).integers(0, 3, (9, 6, 5)).astype(np.uint8)
    cases = (
        (cost, "Whole numbers: "),
        (signed, "Whole numbers of either sign: "),
        (few, "Equal whole numbers: "),
    )
    return worst(
        [*(map_verdict(candidate(c), np.argmin(c, axis=0), label) for c, label in cases), single]
    )
