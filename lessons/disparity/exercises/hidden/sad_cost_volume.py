"""What sad_cost_volume is graded by besides the checks that a student sees."""

import numpy as np

from lessons.disparity.exercises import GRADERS, cells_verdict, inner, textures
from lessons.disparity.exercises.sad_cost_volume import sad_cost_volume
from workbench.exercise import Function, Verdict, check, refused, worst


@check(2, public=False)
def mirrored(candidate: Function) -> Verdict:
    """Mirrored and exchanged, the same pairs of pixels have the same costs; one shift, and all that
    fit, are tried.
    """
    left, right = textures(GRADERS(), 10, 17)
    cost = candidate(left, right, 5, 3)
    turned = candidate(right[:, ::-1].copy(), left[:, ::-1].copy(), 5, 3)
    back = np.full_like(cost, np.inf)
    for d in range(
        len(cost)
    ):  # left x and right x - d are columns w - 1 - x and w - 1 - x + d of the mirrored pair
        back[d, :, d:] = turned[d, :, d:][:, ::-1]
    wanted = sad_cost_volume(left, right, 5, 3)
    verdicts = [
        cells_verdict(cost, wanted),
        cells_verdict(back, wanted, label="Mirrored and mapped back: "),
    ]
    for largest in (0, 16):
        wanted = sad_cost_volume(left, right, largest, 3)
        verdicts.append(
            cells_verdict(
                candidate(left, right, largest, 3), wanted, label=f"Shifts up to {largest}: "
            )
        )
    return worst(verdicts)


@check(1, public=False)
def brighter_pictures(candidate: Function) -> Verdict:
    """Twice the contrast doubles all costs, and the same light added to both changes none."""
    left, right = textures(GRADERS() + 1, 9, 15)
    wanted = sad_cost_volume(left, right, 4, 3)
    where = inner(wanted, 3)
    double = cells_verdict(
        candidate(2 * left, 2 * right, 4, 3), 2 * wanted, where, "Twice the contrast: "
    )
    light = cells_verdict(
        candidate(left + 40, right + 40, 4, 3), wanted, where, "40 levels brighter: "
    )
    return worst((double, light))


@check(2, public=False)
def windows_over_the_border(candidate: Function) -> Verdict:
    """A window that reaches over the border of its slice repeats the border's cells, also one
    larger than the picture.
    """
    left, right = textures(GRADERS() + 2)
    wanted = sad_cost_volume(left, right, 4, 5)
    hint = (
        "Take the differences of the columns that both have, pad these by repeating their border,"
        " then sum."
    )
    verdicts = [cells_verdict(candidate(left, right, 4, 5), wanted, ~inner(wanted, 5), hint=hint)]
    for window in (7, 15):
        wanted = sad_cost_volume(left, right, 4, window)
        verdicts.append(
            cells_verdict(
                candidate(left, right, 4, window), wanted, label=f"Window {window}: ", hint=hint
            )
        )
    return worst(verdicts)


@check(1, public=False)
def byte_pictures(candidate: Function) -> Verdict:
    """Pictures of bytes (uint8) give the same costs as floats."""
    left, right = (
        np.rint(np.clip(picture, 0, 255)).astype(np.uint8) for picture in textures(GRADERS() + 3)
    )
    wanted = sad_cost_volume(left, right, 5, 3)
    hint = "In uint8, 3 - 5 is 254: convert to float before you subtract."
    return cells_verdict(candidate(left, right, 5, 3), wanted, hint=hint)


@check(1, public=False)
def what_makes_no_sense(candidate: Function) -> Verdict:
    """Pictures of two sizes, windows that are even or not positive, and shifts beyond the width are
    refused.
    """
    left, right = textures(GRADERS() + 4, 8, 12)
    return worst(
        (
            refused(
                candidate,
                left,
                right[:, 1:].copy(),
                3,
                3,
                what="A right picture that is one column narrower",
            ),
            refused(
                candidate,
                left,
                right[1:].copy(),
                3,
                3,
                what="A right picture that is one row lower",
            ),
            *(
                refused(candidate, left, right, 3, window, what=f"A window of {window}")
                for window in (4, 0, -3)
            ),
            *(
                refused(candidate, left, right, d, 3, what=f"max_disparity = {d} for 12 px")
                for d in (12, 20)
            ),
        )
    )
